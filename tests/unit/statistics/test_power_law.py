"""Power laws fitted to data whose exponent is known, and intervals that cover it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy import stats

from branchcrush.errors import FitError
from branchcrush.statistics.bins import bin_edges, binned_sums
from branchcrush.statistics.power_law import binned_exponent, power_law_fit

EDGES = bin_edges(0.005, 1.0, 20)
CENTRES = (EDGES[1:] + EDGES[:-1]) / 2


def lengths(rng, shape):
    """Branch lengths over R_max as a dense packing has them: most near 1.4."""
    return rng.triangular(0.01, 1.4, 2.0, shape)


def gamma_sums(rng, seeds, branches, exponent):
    """Binned sums of packings whose energies vary as those of force chains do.

    All lengths of a bin are equal: the mean of l^n over a bin is not the mean of l to the n.
    """
    place = np.searchsorted(EDGES, lengths(rng, (seeds, branches))) - 1
    length = CENTRES[np.clip(place, 0, len(CENTRES) - 1)]
    energy = rng.standard_exponential(length.shape) * length ** np.reshape(exponent, (-1, 1))
    return np.stack([binned_sums(*branch, EDGES) for branch in zip(length, energy, strict=True)])


def score(length, energy, weight, law):
    """What the fit makes zero, over its weight."""
    residual = energy / (law.amplitude * length**law.exponent) - 1
    return (weight * residual * np.stack([np.ones_like(length), np.log(length)])).sum(-1) / (
        weight.sum()
    )


# --- power-law fit -------------------------------------------------------------------------------


@settings(deadline=None, max_examples=100)
@given(
    exponent=st.floats(-1, 6),
    decade=st.floats(-10, 10),
    unit=st.sampled_from([1e-6, 1e-3, 1.0, 1e3]),
    points=st.integers(2, 20),
    seed=st.integers(0, 2**32),
)
def test_exact_power_law_is_recovered_whatever_its_scale(exponent, decade, unit, points, seed):
    rng = np.random.default_rng(seed)
    relative = np.append([1.0, 1.1], rng.uniform(0.01, 2.0, points - 2))
    length, energy = relative * unit, 10**decade * relative**exponent
    fit = power_law_fit(length, energy, rng.integers(1, 1000, points))
    assert_allclose(fit.exponent, exponent, rtol=0, atol=1e-10)
    assert_allclose(fit.amplitude * length**fit.exponent, energy, rtol=1e-10)


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32), st.floats(1e-6, 1e6), st.floats(1e-12, 1e12))
def test_units_of_length_and_energy_leave_the_exponent(seed, length_unit, energy_unit):
    rng = np.random.default_rng(seed)
    length = lengths(rng, 200)
    energy = rng.standard_exponential(200) * length**3
    fit = power_law_fit(length, energy)
    other = power_law_fit(length * length_unit, energy * energy_unit)
    assert_allclose(other.exponent, fit.exponent, rtol=0, atol=1e-9)
    expected = fit.amplitude * energy_unit / length_unit**fit.exponent
    assert_allclose(other.amplitude, expected, rtol=1e-7)


def test_fit_of_scattered_energies_solves_its_equations():
    rng = np.random.default_rng(3)
    length = lengths(rng, 400)
    energy, weight = rng.standard_exponential(400) * length**2, rng.uniform(0, 3, 400)
    law = power_law_fit(length, energy, weight)
    assert_allclose(score(length, energy, weight, law), 0.0, atol=1e-10)


def test_fit_of_many_branches_finds_the_exponent_they_were_drawn_with():
    rng = np.random.default_rng(1)
    length = lengths(rng, 100_000)
    for exponent in (0.0, 3.0, 5.0):
        fit = power_law_fit(length, 7 * rng.standard_exponential(length.size) * length**exponent)
        # Three standard errors 1/(sqrt(M) s(ln l)).
        assert fit.exponent == pytest.approx(exponent, abs=3 / 100_000**0.5 / np.log(length).std())
        assert fit.amplitude == pytest.approx(7.0, rel=0.02)


def test_many_data_sets_at_once_are_fitted_as_one_by_one():
    rng = np.random.default_rng(2)
    length = CENTRES
    energy = rng.standard_exponential((3, 4, 20)) * length**3
    weight = rng.integers(1, 50, energy.shape)
    together = power_law_fit(length, energy, weight)
    assert together.exponent.shape == together.amplitude.shape == (3, 4)
    for index in np.ndindex(3, 4):
        alone = power_law_fit(length, energy[index], weight[index])
        assert_allclose(together.exponent[index], alone.exponent, rtol=1e-10)
        assert_allclose(together.amplitude[index], alone.amplitude, rtol=1e-10)


def test_weight_counts_as_that_many_branches():
    rng = np.random.default_rng(4)
    length, energy = lengths(rng, 30), rng.standard_exponential(30)
    times = rng.integers(1, 5, 30)
    repeated = power_law_fit(np.repeat(length, times), np.repeat(energy, times))
    assert_allclose(power_law_fit(length, energy, times), repeated, rtol=1e-9)


def test_many_branches_are_fitted_like_a_few_of_their_weight():
    # More than are taken at a time, and no multiple of that.
    rng = np.random.default_rng(5)
    length, energy = lengths(rng, 30), rng.standard_exponential(30)
    times = rng.integers(1, 8_000, 30)
    order = rng.permutation(times.sum())
    repeated = power_law_fit(np.repeat(length, times)[order], np.repeat(energy, times)[order])
    assert_allclose(power_law_fit(length, energy, times), repeated, rtol=1e-9)


@pytest.mark.parametrize("energy", [0.0, 1e9])
def test_points_of_no_weight_are_left_out(energy):
    fit = power_law_fit([1.0, 2.0, 3.0, 4.0], [5.0, 40.0, energy, 320.0], [2, 1, 0, 1])
    assert_allclose(fit, (5.0, 3.0), rtol=1e-10)


def test_branches_without_energy_lower_the_mean():
    # Mean energies are 1 and 8.
    fit = power_law_fit([1.0, 1.0, 2.0, 2.0], [2.0, 0.0, 16.0, 0.0])
    assert_allclose(fit, (1.0, 3.0), rtol=1e-10)


def test_energies_far_from_any_power_law_are_fitted_all_the_same():
    # Lengths 1/2, 1, 2 with weights 1, 8, 1: the equations ask E/(A l^n) to be alike at both ends,
    # so n = log4(E_3/E_1), and to be 1 in the mean.
    first, middle, last = 4.0, 0.25, 4.5
    fit = power_law_fit([0.5, 1.0, 2.0], [first, middle, last], [1, 8, 1])
    assert_allclose(fit.exponent, np.log(last / first) / np.log(4), rtol=1e-9)
    assert_allclose(fit.amplitude, (8 * middle + 2 * (first * last) ** 0.5) / 10, rtol=1e-9)


@pytest.mark.parametrize(
    ("length", "energy", "weight"),
    [
        ([1.0, 2.0, 3.0], [0.0, 0.0, 0.0], 1.0),
        ([1.0, 2.0, 3.0], [1.0, 0.0, 0.0], 1.0),
        ([1.0, 2.0, 3.0], [1.0, 8.0, 27.0], [1, 0, 0]),
        ([1.0], [1.0], 1.0),
        ([], [], 1.0),
        # Energy at one length only: no slope to find.
        ([2.0, 2.0, 2.0], [1.0, 8.0, 27.0], 1.0),
        ([1.0, 2.0, 3.0], [[1.0, 8.0, 27.0], [1.0, 0.0, 0.0]], 1.0),
    ],
)
def test_energy_at_fewer_than_two_lengths_is_refused(length, energy, weight):
    with pytest.raises(FitError, match="two or more branch lengths"):
        power_law_fit(length, energy, weight)


@pytest.mark.parametrize("energy", [np.nan, np.inf])
def test_energy_that_is_no_number_is_refused(energy):
    with pytest.raises(FitError):
        power_law_fit([1.0, 2.0, 3.0], [1.0, 8.0, energy])


# --- exponent and interval -----------------------------------------------------------------------


def test_empty_bins_do_not_change_the_exponent():
    sums = np.stack([gamma_sums(np.random.default_rng(s), 1, 300, [3.0])[0] for s in range(3)])
    wider = np.insert(sums, [0, 0, 10, 20], 0.0, axis=2)
    results = [binned_exponent(data, rng=np.random.default_rng(0)) for data in (sums, wider)]
    assert_allclose(*[fit for fit, _ in results], rtol=1e-9)
    assert_allclose(*[exponent for _, exponent in results], rtol=1e-9)


def test_bins_that_only_one_seed_fills_are_fitted():
    first = [[9.0, 4.0, 0.0], [9.0, 8.0, 0.0], [9.0, 32.0, 0.0]]
    second = [[0.0, 4.0, 2.0], [0.0, 8.0, 8.0], [0.0, 32.0, 128.0]]
    _, exponent = binned_exponent([first, second], rng=np.random.default_rng(0))
    assert_allclose(exponent, [3.0, 3.0, 3.0], rtol=1e-9)


def test_one_seed_gives_an_exponent_without_an_interval():
    sums = gamma_sums(np.random.default_rng(0), 1, 500, [3.0])
    fit, exponent = binned_exponent(sums, rng=None)
    assert exponent.estimate == fit.exponent
    assert np.isnan([exponent.low, exponent.high]).all()


def test_same_random_state_gives_the_same_interval():
    sums = gamma_sums(np.random.default_rng(0), 8, 500, [3.0])
    first, second, other = (
        binned_exponent(sums, rng=np.random.default_rng(seed))[1] for seed in (1, 1, 2)
    )
    assert first == second
    assert first.estimate == other.estimate
    assert first.low != other.low
    # The number of draws is what the limits' own scatter comes from.
    assert first.low == pytest.approx(other.low, abs=0.1 * (first.high - first.low))


def test_higher_confidence_widens_the_interval_about_the_estimate():
    sums = gamma_sums(np.random.default_rng(0), 8, 500, [3.0])
    intervals = [
        binned_exponent(sums, confidence=share, rng=np.random.default_rng(1))[1]
        for share in (0.5, 0.95)
    ]
    for estimate, low, high in intervals:
        assert low < estimate < high
        assert estimate - low == pytest.approx(high - estimate, rel=1e-9)
    narrow, wide = (interval.high - interval.low for interval in intervals)
    # Quantiles of Student's t with seven degrees of freedom.
    assert wide / narrow == pytest.approx(2.364624 / 0.711142, rel=1e-5)


def test_interval_of_two_seeds_follows_from_their_difference():
    # Two seeds are drawn as 1,1 or 1,2 or 2,1 or 2,2. Were the exponent the mean of theirs, the
    # draws would be n - d, n, n + d with 1/4, 1/2, 1/4: a deviation of d/sqrt(2).
    def seed(exponent):
        length = np.array([0.5, 1.0, 2.0])
        return np.stack([[100.0] * 3, 100 * length, 100 * length**exponent])

    _, exponent = binned_exponent(
        [seed(3 - 0.01), seed(3 + 0.01)], resamples=20_000, rng=np.random.default_rng(0)
    )
    half = 12.7062 * 0.01 / 2**0.5 * 2**0.5
    assert exponent.high - exponent.estimate == pytest.approx(half, rel=0.02)


def test_draws_are_fitted_with_the_branches_that_they_hold():
    # Seeds whose bins are off any one power law, and weigh otherwise. With E = (1 + r) l^n the fit
    # to l = 1/2, 1, 2 has the exponent n where w_1 r_1 = w_3 r_3 and the sum of w r is 0.
    length = np.array([0.5, 1.0, 2.0])

    def seed(counts, residuals, exponent):
        counts = np.array(counts, dtype=float)
        energy = counts * (1 + np.array(residuals)) * length**exponent
        return np.stack([counts, counts * length, energy])

    sums = [seed([10, 40, 20], [0.4, -0.2, 0.2], 3.0), seed([30, 20, 10], [0.1, -0.3, 0.3], 2.0)]
    for alone, exponent in zip(sums, (3.0, 2.0), strict=True):
        assert binned_exponent([alone], rng=None)[1].estimate == pytest.approx(exponent, rel=1e-9)
    _, both = binned_exponent(sums, resamples=40_000, rng=np.random.default_rng(0))
    # A quarter of the draws is the first seed twice, a quarter the second, half one of each.
    deviation = np.std([3.0, both.estimate, both.estimate, 2.0])
    half = stats.t.ppf(0.975, 1) * deviation * 2**0.5
    assert both.high - both.estimate == pytest.approx(half, rel=0.01)


def test_interval_of_gamma_energies_holds_the_exponent_they_were_drawn_with():
    rng = np.random.default_rng(6)
    length = lengths(rng, (16, 1000))
    energy = rng.standard_exponential(length.shape) * length**3
    sums = [binned_sums(*branch, EDGES) for branch in zip(length, energy, strict=True)]
    _, exponent = binned_exponent(sums, rng=rng)
    assert exponent.low < 3.0 < exponent.high
    assert exponent.high - exponent.low < 0.15


def test_interval_covers_the_exponent_of_packings_that_scatter_about_it():
    # Each packing has a force network, and so an exponent, of its own.
    rng = np.random.default_rng(20)
    trials, covered = 200, 0
    for _ in range(trials):
        sums = gamma_sums(rng, 16, 1000, rng.normal(3.0, 0.15, 16))
        _, exponent = binned_exponent(sums, resamples=300, rng=rng)
        covered += exponent.low <= 3.0 <= exponent.high
    assert 0.88 <= covered / trials <= 0.99


def test_twenty_bins_lower_the_exponent_by_less_than_0_03():
    # Over a bin the mean of l^3 is above the cube of the mean, most where bins are wide for l.
    length = lengths(np.random.default_rng(0), 200_000)
    _, exponent = binned_exponent([binned_sums(length, length**3, EDGES)], rng=None)
    assert -0.03 < exponent.estimate - 3.0 < 1e-3


def test_seeds_without_energy_are_refused():
    with pytest.raises(FitError, match="two or more branch lengths"):
        binned_exponent(np.zeros((2, 3, 5)), rng=np.random.default_rng(0))
