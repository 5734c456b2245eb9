"""Forces drawn from known laws: their distribution, their tail, and the length they grow with."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.forces.distribution import (
    force_by_length,
    force_distribution,
    force_network_result,
    force_tail,
    relative_forces,
    share_below_mean,
)
from branchcrush.packings.network import Network
from branchcrush.statistics.bins import bin_edges

SEEDS, CONTACTS = 8, 4000
EDGES = bin_edges(0.5, 1.0, 10)


def rng_of(seed=1):
    return np.random.default_rng(seed)


def half_normal(rng, shape):
    return np.abs(rng.standard_normal(shape)) / np.sqrt(2.0 / np.pi)


def network(radius, i, j, force):
    none = np.zeros(0)
    return Network(radius, i, j, 0.0 * force, force, 0.0 * force, none.astype(int), none, none)


def power_law_networks(rng, exponent, seeds=SEEDS, unit=1.0):
    """Networks of grains that touch at random, with exponential forces whose mean is l^m."""
    found = []
    for _ in range(seeds):
        # Few radii, so that the lengths of a bin are almost equal.
        radius = rng.choice([0.53, 0.62, 0.79, 0.96], 1000)
        i, j = rng.integers(0, radius.size, (2, CONTACTS))
        length = radius[i] + radius[j]
        force = rng.standard_exponential(CONTACTS) * length**exponent
        found.append(network(unit * radius, i, j, force))
    return found


# --- distribution --------------------------------------------------------------------------------


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.integers(2, 300), st.floats(1e-9, 1e9), st.floats(0.3, 3.0))
def test_relative_forces_have_mean_one_whatever_the_unit(seed, number, unit, width):
    force = rng_of(seed).lognormal(0.0, width, number)
    assert_allclose(relative_forces(force).mean(), 1.0, rtol=1e-12)
    assert_allclose(relative_forces(unit * force), relative_forces(force), rtol=1e-12)


def test_no_force_has_no_relative_force():
    assert relative_forces([]).size == 0


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.floats(0.1, 1.2), st.integers(1, 4))
def test_bins_are_equal_hold_all_contacts_and_end_with_the_data(seed, width, seeds):
    rng = rng_of(seed)
    forces = [relative_forces(rng.lognormal(0.0, width, 200)) for _ in range(seeds)]
    table = force_distribution(forces, resamples=10, rng=rng)
    widths = table["force_high"] - table["force_low"]
    assert_allclose(widths, widths[0])
    assert table["contacts"].sum() == 200 * seeds
    assert table["contacts"][-1] > 0
    assert_allclose(table["density"] @ widths, 1.0)


@pytest.mark.parametrize("largest", [100.1, 1e7])
def test_a_huge_force_has_one_wide_bin_of_its_own(largest):
    table = force_distribution([[1.0, largest]], rng=None)
    assert table["contacts"].size < 405
    assert table["contacts"][-1] == 1
    assert table["force_high"][-1] >= largest
    assert (table["force_high"] - table["force_low"]).min() > 0.2


def test_a_force_just_beyond_many_means_is_no_peak():
    # Its bin is as wide as the others, so one contact in a thousand has a density of 0.004.
    force = np.append(np.full(999, 1.1), 8.0 + 1e-6)
    table = force_distribution([force], rng=None)
    assert_allclose(table["density"][-1], 1.0 / 1000 / 0.25)


def test_density_of_the_wide_last_bin_is_over_its_own_width():
    # Bins of 0.25 up to 100, and one from there to the largest force.
    table = force_distribution([[1.1, 1.1, 1.1, 300.0]], rng=None)
    assert (table["force_low"][-1], table["force_high"][-1]) == (100.0, 300.0)
    assert_allclose(table["density"][-1], 0.25 / 200.0)
    assert_allclose(table["density"][4], 0.75 / 0.25)


def test_density_of_exponential_forces_is_exponential_within_its_interval():
    forces = rng_of().standard_exponential((20, CONTACTS))
    table = force_distribution(forces, rng=rng_of(2))
    low, high = np.exp(-table["force_low"]), np.exp(-table["force_high"])
    expected = (low - high) / (table["force_high"] - table["force_low"])
    many = table["contacts"] > 200
    half = (table["density_high"] - table["density_low"]) / 2.0
    error = np.sqrt(expected / (0.25 * forces.size))
    assert np.all(np.abs(table["density"] - expected)[many] < 4.5 * error[many])
    # 95 percent of some twenty bins, and 2.09 standard errors of 20 seeds.
    assert_allclose(np.mean(half[many] / error[many]), 2.09, rtol=0.25)


@pytest.mark.parametrize(
    ("draw", "share"),
    [
        (lambda rng, shape: rng.standard_exponential(shape), 1.0 - np.exp(-1.0)),
        (lambda rng, shape: rng.uniform(0.0, 2.0, shape), 0.5),
        # erf(1/sqrt(pi))
        (half_normal, 0.575062),
    ],
)
def test_share_below_the_mean_is_that_of_the_law(draw, share):
    forces = [relative_forces(force) for force in draw(rng_of(), (SEEDS, CONTACTS))]
    found = share_below_mean(forces, rng=rng_of(2))
    assert_allclose(found.estimate, share, atol=4.0 * 0.5 / np.sqrt(SEEDS * CONTACTS))
    assert found.low < found.estimate < found.high


def test_forces_of_exactly_the_mean_are_not_below_it():
    assert share_below_mean([[1.0, 1.0, 0.5, 1.5]], rng=None).estimate == 0.25


# --- tail ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [0.7, 1.0, 2.5])
@pytest.mark.parametrize("threshold", [1.0, 2.0, 3.0])
def test_an_exponential_tail_has_its_rate_at_every_threshold(rate, threshold):
    forces = rng_of().standard_exponential((SEEDS, 30_000)) / rate
    tail = force_tail(forces, threshold, rng=rng_of(2))
    above = np.exp(-rate * threshold)
    number = above * forces.size
    assert_allclose(tail["share_above"], above, atol=4.5 * np.sqrt(above / forces.size))
    assert_allclose(tail["decay_rate"], rate, rtol=4.5 / np.sqrt(number))
    # The variance of the squared variation of n exponential excesses is 4/n.
    assert_allclose(tail["squared_variation"], 1.0, atol=4.5 * np.sqrt(4.0 / number))


def test_intervals_of_exponential_tails_cover_the_truth():
    covered = np.zeros(2)
    for trial in range(100):
        forces = rng_of(trial).standard_exponential((10, 1500))
        tail = force_tail(forces, 1.0, resamples=300, rng=rng_of(trial + 1000))
        for k, name in enumerate(("decay_rate", "squared_variation")):
            covered[k] += tail[f"{name}_low"] < 1.0 < tail[f"{name}_high"]
    assert np.all(covered >= 85)


def test_a_gaussian_tail_bends_down_and_a_broad_one_does_not():
    rng = rng_of()
    for draw, sign in ((half_normal, -1.0), (lambda rng, n: rng.lognormal(-0.5, 1.0, n), 1.0)):
        forces = [relative_forces(draw(rng, 20_000)) for _ in range(SEEDS)]
        tails = [force_tail(forces, threshold, rng=rng_of(2)) for threshold in (1.0, 2.0, 3.0)]
        rates = [tail["decay_rate"] for tail in tails]
        assert np.all(np.diff(rates) * sign < 0.0)
        outside = tails[0]["squared_variation_high" if sign < 0 else "squared_variation_low"]
        assert (outside - 1.0) * sign > 0.0


def test_gaussian_tail_matches_its_integrals():
    # <(x - t)^k> above t, by quadrature of the density of the half-normal law of mean 1.
    x = np.linspace(1.0, 12.0, 400_001)
    density = np.exp(-(x**2) / np.pi) * 2.0 / np.pi
    zeroth, first, second = (np.trapezoid(density * (x - 1.0) ** k, x) for k in range(3))
    forces = half_normal(rng_of(), (SEEDS, 50_000))
    tail = force_tail(forces, 1.0, rng=rng_of(2))
    assert_allclose(tail["share_above"], zeroth, rtol=0.01)
    assert_allclose(tail["decay_rate"], zeroth / first, rtol=0.015)
    assert_allclose(tail["squared_variation"], second * zeroth / first**2 - 1.0, rtol=0.03)


def test_two_equal_excesses_have_no_variation_and_one_has_no_tail():
    tail = force_tail([[0.5, 3.0], [3.0]], 1.0, resamples=20, rng=rng_of())
    assert (tail["decay_rate"], tail["squared_variation"]) == (0.5, 0.0)
    assert_allclose(tail["share_above"], 2.0 / 3.0)
    assert np.isnan(force_tail([[0.5, 3.0]], 1.0, rng=None)["decay_rate"])
    assert np.isnan(force_tail([[0.5, 1.0]], 1.0, rng=None)["squared_variation"])


def test_a_force_of_exactly_the_threshold_is_not_above_it():
    tail = force_tail([[1.0, 1.0, 2.0, 4.0]], 1.0, rng=None)
    # Excesses of 1 and 3: mean 2, variance 1.
    assert (tail["share_above"], tail["decay_rate"], tail["squared_variation"]) == (0.5, 0.5, 0.25)


# --- length --------------------------------------------------------------------------------------


@pytest.mark.parametrize("exponent", [0.0, 1.0, 2.5])
def test_force_by_length_has_the_exponent_of_its_making(exponent):
    table, found = force_by_length(power_law_networks(rng_of(), exponent), EDGES, rng=rng_of(2))
    # A slope of exponential forces: 1/sqrt(M) over the spread of ln l, which is 0.15.
    error = 1.0 / np.sqrt(SEEDS * CONTACTS) / 0.15
    assert_allclose(found.estimate, exponent, atol=4.0 * error)
    assert found.low < found.estimate < found.high
    assert_allclose((found.high - found.low) / 2.0, 2.36 * error, rtol=0.7)
    filled = table["branches"] > 0
    assert table["branches"].sum() == SEEDS * CONTACTS
    assert_allclose(np.average(table["mean_force"][filled], weights=table["branches"][filled]), 1.0)
    assert np.all(np.isnan(table["mean_force"][~filled]))


def test_units_and_the_order_of_the_two_grains_change_nothing():
    plain = power_law_networks(rng_of(), 1.5)
    scaled = [network(2.0**-10 * seed.radius, seed.j, seed.i, 1e6 * seed.force) for seed in plain]
    table, exponent = force_by_length(plain, EDGES, rng=rng_of(2))
    other, same = force_by_length(scaled, 2.0**-10 * EDGES, rng=rng_of(2))
    assert_allclose(same, exponent, rtol=1e-8)
    assert_allclose(other["mean_force"], table["mean_force"], rtol=1e-12)


def test_grains_of_one_radius_have_no_exponent():
    i, j = rng_of().integers(0, 100, (2, 500))
    seed = network(np.ones(100), i, j, rng_of(2).standard_exponential(500))
    edges = bin_edges(1.0, 1.0, 20)
    table, exponent = force_by_length([seed, seed], edges, resamples=20, rng=rng_of())
    assert exponent is None
    assert_allclose(table["mean_force"][table["branches"] > 0], 1.0)
    assert force_network_result([seed], edges, rng=None)[1]["by_length"] == {}


# --- all of it -----------------------------------------------------------------------------------


def test_result_of_eight_forces_known_by_hand():
    # Six of 1/6 between small grains, 2.5 and 4.5 between large ones: their mean is 1.
    radius = np.repeat([0.5, 1.0], 4)
    i, j = [0, 0, 0, 1, 1, 2, 4, 5], [1, 2, 3, 2, 3, 3, 5, 6]
    seed = network(radius, np.array(i), np.array(j), 7.0 * np.array([1 / 6] * 6 + [2.5, 4.5]))
    tables, summary = force_network_result([seed] * 2, [0.9, 1.5, 2.1], rng=rng_of())
    assert_allclose(summary["share_below_mean"], 0.75)
    assert [tail["threshold"] for tail in summary["tails"]] == [1.0, 2.0, 3.0]
    # Two seeds, so two forces above the last threshold: no variation.
    assert_allclose([tail["share_above"] for tail in summary["tails"]], [0.25, 0.25, 0.125])
    assert_allclose([tail["decay_rate"] for tail in summary["tails"]], [0.4, 1 / 1.5, 1 / 1.5])
    expected = [(1.0 / 2.5) ** 2, (1.0 / 1.5) ** 2, 0.0]
    assert_allclose([tail["squared_variation"] for tail in summary["tails"]], expected, atol=1e-12)
    # 1/6 at a length of 1, 3.5 at 2.
    assert_allclose(tables["force_by_length"]["mean_force"], [1 / 6, 3.5])
    assert_allclose(summary["by_length"]["exponent"], np.log2(21.0))
    assert tables["force_distribution"]["contacts"].tolist()[:1] == [12]
    assert tables["force_distribution"]["contacts"].sum() == 16


def test_each_seed_is_divided_by_its_own_mean():
    one, other = power_law_networks(rng_of(), 1.0, seeds=2)
    other = replace(other, radius=1.1 * other.radius - 0.1)
    alike = force_network_result([one, other], EDGES, resamples=20, rng=rng_of())[0]
    loud = replace(other, force=7.0 * other.force)
    tables = force_network_result([one, loud], EDGES, resamples=20, rng=rng_of())[0]
    for table, column in (("force_distribution", "density"), ("force_by_length", "mean_force")):
        assert_allclose(tables[table][column], alike[table][column], rtol=1e-9)
