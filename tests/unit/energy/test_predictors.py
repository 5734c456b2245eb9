"""Predictors of energies drawn by a known law: the right one is found, and nothing from noise."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from statsmodels.genmod.families import Gamma, links
from statsmodels.genmod.generalized_linear_model import GLM

from branchcrush.energy.designs import log_length
from branchcrush.energy.predictors import PREDICTORS, branch_columns, compared_predictors

# Parameters after the scale.
LAWS = {
    "branch_length": [2.7],
    "reduced_radius": [1.6],
    "both_radii": [0.6, 2.2],
    "grain_size": [2.5],
    "length_and_ratio": [2.6, 3.1],
    "surface": [0.5, 2.5, -0.3, 0.5, 0.4],
}


def law(name, parameters, small, large):
    """Return the mean energies of a predictor, written out."""
    r, q = np.exp(small), np.exp(large)
    if name == "branch_length":
        return (r + q) ** parameters[0]
    if name == "reduced_radius":
        return (r * q / (r + q)) ** parameters[0]
    if name == "both_radii":
        return r ** parameters[0] * q ** parameters[1]
    if name == "grain_size":
        return r ** parameters[0] + q ** parameters[0]
    if name == "length_and_ratio":
        return (r + q) ** parameters[0] * (4 * r * q / (r + q) ** 2) ** parameters[1]
    terms = (small, large, small**2, small * large, large**2)
    return np.exp(sum(p * term for p, term in zip(parameters, terms, strict=True)))


def radii(rng, branches):
    """Return logarithms of the smaller and the larger radius, over the largest of all."""
    return np.sort(np.log(rng.uniform(0.03, 1.0, (2, branches))), axis=0)


def study(rng, seeds, branches, mean):
    """Return seeds whose energies are exponential about a mean of the two radii."""
    found = []
    for _ in range(seeds):
        small, large = radii(rng, branches)
        found.append((small, large, mean(small, large) * rng.exponential(size=branches)))
    return found


def by_name(found):
    return {fitted.name: fitted for fitted in found}


# --- the right predictor -------------------------------------------------------------------------


@pytest.mark.parametrize("name", LAWS)
def test_predictor_recovers_the_parameters_that_energies_were_drawn_with(name):
    seeds = study(np.random.default_rng(1), 10, 1500, lambda s, g: 3 * law(name, LAWS[name], s, g))
    entry = by_name(compared_predictors(seeds))[name]
    assert entry.formula == PREDICTORS[name].formula
    assert tuple(entry.parameters) == PREDICTORS[name].names
    for found, expected in zip(entry.parameters.values(), LAWS[name], strict=True):
        assert found.low < found.estimate < found.high
        half = (found.high - found.low) / 2
        # Four standard errors, the half width being Student's 2.26 of them.
        assert abs(found.estimate - expected) < 4 / 2.26 * half
        assert half < 0.2


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("state", [1, 2])
def test_right_predictor_explains_the_most_of_seeds_left_out(name, state):
    rng = np.random.default_rng(state)
    found = by_name(
        compared_predictors(study(rng, 10, 1500, lambda s, g: law(name, LAWS[name], s, g)))
    )
    # The quadratic holds two of the others, and comes near the rest; length and ratio hold two.
    wrong = set(LAWS) - {name, "surface", "length_and_ratio"}
    right = found[name]
    assert right.explained.low > 0.1
    for other in wrong:
        assert found[other].explained.estimate < right.explained.estimate
        if name == "branch_length":
            assert found[other].difference.high < 0.0
    if name == "branch_length":
        assert tuple(right.difference) == (0.0, 0.0, 0.0)
    else:
        assert right.difference.low > 0.0
    assert found["surface"].explained.estimate > right.explained.estimate - 0.03
    if name in ("branch_length", "reduced_radius"):
        wider = found["length_and_ratio"]
        assert wider.explained.estimate == pytest.approx(right.explained.estimate, abs=0.002)
        length, ratio = (value.estimate for value in wider.parameters.values())
        assert length == pytest.approx(LAWS[name][0], abs=0.15)
        assert ratio == pytest.approx(length if name == "reduced_radius" else 0.0, abs=0.15)


def test_energies_known_exactly_are_explained_wholly():
    rng = np.random.default_rng(2)
    for name, parameters in LAWS.items():
        seeds = [(s, g, law(name, parameters, s, g)) for s, g in (radii(rng, 50) for _ in range(4))]
        entry = by_name(compared_predictors(seeds, resamples=50))[name]
        found = [value.estimate for value in entry.parameters.values()]
        assert_allclose(found, parameters, atol=1e-7)
        assert_allclose(entry.explained.estimate, 1.0, atol=1e-9)


def test_energies_independent_of_radii_are_explained_by_nothing():
    rng, trials = np.random.default_rng(3), 40
    above, explained = dict.fromkeys(LAWS, 0), []
    for _ in range(trials):
        seeds = study(rng, 8, 200, lambda s, g: np.full(s.size, 5.0))
        for entry in compared_predictors(seeds, resamples=200):
            above[entry.name] += entry.explained.low > 0.0
            explained.append(entry.explained.estimate)
    # A share of 0.025 at most; more than 5 of 40 has a chance below 1 in 1000.
    assert max(above.values()) <= 5
    assert abs(np.mean(explained)) < 0.005
    assert np.max(np.abs(explained)) < 0.05


def test_exponent_at_equal_ratio_is_not_that_of_lengths_alone():
    # Long branches join equal grains, short ones unequal ones: n has some of the ratio in it.
    rng = np.random.default_rng(18)
    seeds = []
    for _ in range(8):
        length = rng.uniform(0.5, 2.0, 1500)
        share = np.minimum(0.5, length / 4 * rng.uniform(0.6, 1.0, length.size))
        small, large = np.log(share * length), np.log((1 - share) * length)
        mean = law("length_and_ratio", [2.5, 3.0], small, large)
        seeds.append((small, large, mean * rng.exponential(size=length.size)))
    found = by_name(compared_predictors(seeds, resamples=200))
    q, p = found["length_and_ratio"].parameters.values()
    assert q.low < 2.5 < q.high and p.low < 3.0 < p.high
    assert found["branch_length"].parameters["exponent"].low > 3.5


# --- seeds left out ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("seeds", "groups"),
    [
        (2, [[0], [1]]),
        (4, [[0], [1], [2], [3]]),
        (6, [[0, 1], [2, 3], [4], [5]]),
    ],
)
@pytest.mark.parametrize("unit", [1.0, 1e6])
def test_every_seed_is_judged_by_a_fit_that_never_saw_it(seeds, groups, unit):
    # One seed of an absurd scale spoils the fits for the others, and no fit spoils it more.
    data = study(np.random.default_rng(4), seeds, 150, lambda s, g: np.exp(2 * s + g))
    data[0] = (*data[0][:2], unit * data[0][2])

    def left_out(columns):
        total = 0.0
        for group in groups:
            fitted = [data[number] for number in range(seeds) if number not in group]
            slope, energy = (np.concatenate(x) for x in zip(*map(columns, fitted), strict=True))
            fit = GLM(energy, slope, family=Gamma(links.Log())).fit(tol=1e-13, maxiter=300)
            for number in group:
                slope, energy = columns(data[number])
                ratio = energy / np.exp(slope @ fit.params)
                total += 2 * np.sum(ratio - 1 - np.log(ratio))
        return total

    def constant(seed):
        return np.ones((seed[0].size, 1)), seed[2]

    def both_radii(seed):
        return np.stack([np.ones(seed[0].size), *seed[:2]], axis=1), seed[2]

    def length(seed):
        return np.stack([np.ones(seed[0].size), log_length(*seed[:2])], axis=1), seed[2]

    entry = by_name(compared_predictors(data, resamples=50))["both_radii"]
    nothing, by_radii, by_length = map(left_out, (constant, both_radii, length))
    assert_allclose(entry.explained.estimate, 1 - by_radii / nothing, rtol=1e-6)
    expected = (by_length - by_radii) / nothing
    assert_allclose(entry.difference.estimate, expected, rtol=1e-6)


def test_one_seed_has_parameters_without_intervals_and_explains_nothing_left_out():
    seeds = study(np.random.default_rng(5), 1, 500, lambda s, g: np.exp(3 * g))
    for entry in compared_predictors(seeds):
        for parameter in entry.parameters.values():
            assert np.isfinite(parameter.estimate)
            assert np.isnan([parameter.low, parameter.high]).all()
        assert np.isnan([*entry.explained, *entry.difference]).all()
        assert "one seed" in entry.left_out_reason


def test_energy_in_one_seed_alone_leaves_its_exponents_and_says_what_is_missing():
    seeds = study(np.random.default_rng(15), 1, 500, lambda s, g: np.exp(3 * g))
    seeds += [branch_columns([], [], [], 1.0)] * 2
    for entry in compared_predictors(seeds, resamples=50):
        assert all(np.isfinite(value.estimate) for value in entry.parameters.values())
        assert np.isnan([entry.explained.estimate, entry.difference.estimate]).all()
        assert "without some of the seeds" in entry.left_out_reason


def test_seed_that_alone_has_a_second_length_cannot_be_left_out():
    small = np.full(200, -1.0)
    energies = np.random.default_rng(16).exponential(size=(3, 200))
    seeds = [(small, small + 0.5 * (k == 1), energy) for k, energy in enumerate(energies)]
    entry = by_name(compared_predictors(seeds, resamples=50))["branch_length"]
    assert np.isfinite(entry.parameters["exponent"].estimate)
    assert "do not tell the parameters apart" in entry.left_out_reason


def test_no_energy_at_all_is_told():
    for entry in compared_predictors([branch_columns([], [], [], 1.0)] * 2):
        assert "finite energy" in entry.reason


def test_grains_of_a_single_size_give_reasons_and_no_numbers():
    equal = np.zeros(100)
    rng = np.random.default_rng(6)
    found = compared_predictors([(equal, equal, rng.exponential(size=100)) for _ in range(4)])
    assert [entry.name for entry in found] == list(PREDICTORS)
    for entry in found:
        assert (dict(entry.parameters), entry.difference, entry.exponent) == ({}, None, None)
        assert np.isnan(entry.explained).all()
        assert "do not tell the parameters apart" in entry.reason


def test_two_sizes_suffice_for_every_predictor_but_the_quadratic():
    rng = np.random.default_rng(7)
    seeds = []
    for _ in range(6):
        small, large = np.sort(np.log(rng.choice([0.3, 1.0], (2, 500))), axis=0)
        seeds.append((small, large, np.exp(large + 2 * small) * rng.exponential(size=500)))
    found = by_name(compared_predictors(seeds))
    assert "do not tell the parameters apart" in found.pop("surface").reason
    for entry in found.values():
        assert entry.explained.low > 0.0
    a, b = (value.estimate for value in found["both_radii"].parameters.values())
    # Standard errors are near 0.05.
    assert (a, b) == (pytest.approx(2.0, abs=0.2), pytest.approx(1.0, abs=0.2))


# --- columns -------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 2**32), st.floats(1e-6, 1e3), st.floats(1e-12, 1e12))
def test_units_and_the_order_of_i_and_j_change_no_exponent(state, radius_unit, energy_unit):
    rng = np.random.default_rng(state)
    seeds, other = [], []
    for _ in range(3):
        first, second = np.exp(radii(rng, 100))
        energy = rng.exponential(size=100) * (first + second) ** 3
        swapped = np.where(rng.random(100) < 0.5, [first, second], [second, first]) * radius_unit
        seeds.append(branch_columns(first, second, energy, 1.0))
        other.append(branch_columns(*swapped, energy * energy_unit, radius_unit))
    for entry, same in zip(
        *(compared_predictors(x, resamples=20) for x in (seeds, other)), strict=True
    ):
        for name, parameter in entry.parameters.items():
            assert_allclose(same.parameters[name], parameter, rtol=1e-5, atol=1e-5)
        assert_allclose(same.explained.estimate, entry.explained.estimate, atol=1e-7)


def test_branches_without_energy_are_left_out_of_the_columns():
    small, large, energy = branch_columns(
        [2.0, 1.0, 4.0, 1.0], [1.0, 1.0, 3.0, 3.0], [5.0, 0.0, 7.0, 1e-9], 4.0
    )
    assert_allclose(np.exp(small), [0.25, 0.75])
    assert_allclose(np.exp(large), [0.5, 1.0])
    assert energy.tolist() == [5.0, 7.0]
    assert_allclose(np.exp(log_length(small, large)), [0.75, 1.75])


def test_branches_with_more_than_a_hundred_millionth_of_the_mean_are_kept():
    # The mean of the four is 1.
    _, _, energy = branch_columns(np.ones(4), np.ones(4), [2.0, 2.0, 3e-8, 3e-9], 1.0)
    assert energy.tolist() == [2.0, 2.0, 3e-8]


# --- registry ------------------------------------------------------------------------------------


def test_every_predictor_has_a_look_of_its_own():
    assert list(PREDICTORS) == list(LAWS)
    for part in ("label", "color", "marker"):
        assert len({getattr(entry, part) for entry in PREDICTORS.values()}) == len(PREDICTORS)
    length = PREDICTORS["branch_length"]
    assert (length.label, length.color, length.marker) == ("branch length l", "#1f4e79", "o")


def test_exponent_is_that_of_the_branch_length_alone():
    seeds = study(np.random.default_rng(17), 3, 200, lambda s, g: (np.exp(s) + np.exp(g)) ** 3)
    by_length, *others = compared_predictors(seeds, resamples=50)
    assert by_length.exponent == by_length.parameters["exponent"].estimate
    assert by_length.exponent == pytest.approx(3.0, abs=0.5)
    assert [other.exponent for other in others] == [None] * 5
