"""The regression of broad energies, judged by other codes, by refits and by the textbook."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.optimize import minimize
from statsmodels.genmod.families import Gamma, links
from statsmodels.genmod.generalized_linear_model import GLM

from branchcrush.energy.predictors import PREDICTORS, branch_columns
from branchcrush.errors import FitError
from branchcrush.statistics.gamma_regression import deviance, gamma_fit, parameter_intervals
from branchcrush.statistics.resampling import interval_of_refits, seed_draws

LINEAR = ["branch_length", "reduced_radius", "both_radii", "surface"]
SIZES = PREDICTORS["grain_size"].design


def design(name):
    return PREDICTORS[name].design


def drawn(rng, branches, *, name="branch_length", law=(2.0, 3.0), shape=1.0):
    """Return a seed whose energies are gamma-distributed about a law, with cv shape^-1/2."""
    small, large = np.sort(np.log(rng.uniform(0.05, 1.0, (2, branches))), axis=0)
    mean = np.exp(design(name)(np.array(law), small, large)[0])
    return small, large, mean * rng.gamma(shape, 1.0 / shape, branches)


def joined(seeds):
    return tuple(np.concatenate(columns) for columns in zip(*seeds, strict=True))


def judged(seeds, name):
    """Return the fit of another code to the same branches."""
    *columns, energy = joined(seeds)
    parameters = np.array([0.0, *design(name)(None)[1:]])
    slope = design(name)(parameters, *columns)[1]
    return GLM(energy, slope, family=Gamma(links.Log())).fit(tol=1e-13, maxiter=300)


# --- against other codes -------------------------------------------------------------------------


@pytest.mark.parametrize("name", LINEAR)
@pytest.mark.parametrize("state", range(4))
def test_linear_fit_and_deviance_are_those_of_an_independent_code(name, state):
    rng = np.random.default_rng(state)
    law = rng.normal([3.0, 2.0, 1.0, 0.1, -0.1, 0.1], 0.5)[: len(PREDICTORS[name].names) + 1]
    seeds = [
        drawn(rng, rng.integers(30, 300), name=name, law=law, shape=rng.uniform(0.5, 3.0))
        for _ in range(rng.integers(1, 6))
    ]
    expected = judged(seeds, name)
    fit = gamma_fit(seeds, design(name))
    assert_allclose(fit.parameters, expected.params, rtol=0, atol=1e-6)
    result = sum(deviance(seed, design(name), fit.parameters) for seed in seeds)
    assert_allclose(result, expected.deviance, rtol=1e-9)


@pytest.mark.parametrize("state", range(4))
def test_nonlinear_fit_minimises_the_quasi_likelihood(state):
    rng = np.random.default_rng(state)
    seeds = [drawn(rng, 300, name="grain_size", law=(1.0, rng.uniform(1, 4))) for _ in range(3)]
    small, large, energy = joined(seeds)

    def loss(theta):
        mean = np.exp(theta[0]) * (np.exp(theta[1] * small) + np.exp(theta[1] * large))
        return np.mean(np.log(mean) + energy / mean)

    options = {"xatol": 1e-9, "fatol": 1e-15, "maxiter": 2000}
    expected = minimize(loss, [0.0, 2.0], method="Nelder-Mead", options=options)
    assert_allclose(gamma_fit(seeds, SIZES).parameters, expected.x, rtol=0, atol=2e-6)


@pytest.mark.parametrize("name", PREDICTORS)
def test_derivatives_of_designs_are_those_of_finite_differences(name):
    rng = np.random.default_rng(7)
    small, large, _ = drawn(rng, 40)
    start = np.array(design(name)(None), dtype=float)
    assert start.size == len(PREDICTORS[name].names) + 1
    for _ in range(5):
        theta = start + rng.normal(0.0, 1.0, start.size)
        slope = design(name)(theta, small, large)[1]
        assert_array_equal(slope[:, 0], 1.0)
        for k, shift in enumerate(1e-5 * np.eye(start.size)):
            ends = [design(name)(theta + side * shift, small, large)[0] for side in (1, -1)]
            assert_allclose(slope[:, k], (ends[0] - ends[1]) / 2e-5, rtol=0, atol=1e-8)


# --- what is kept of each seed -------------------------------------------------------------------


@pytest.mark.parametrize("name", ["both_radii", "grain_size"])
def test_information_is_minus_the_derivative_of_each_seeds_scores(name):
    rng = np.random.default_rng(2)
    # Energies of another law, so that what they leave of the fit is not noise alone.
    seeds = [drawn(rng, 400, name="both_radii", law=(0.0, 2.0, 1.0)) for _ in range(3)]
    fit = gamma_fit(seeds, design(name))

    def score(seed, theta):
        *columns, energy = seed
        eta, slope = design(name)(theta, *columns)
        return (energy * np.exp(-eta) - 1.0) @ slope

    for seed, scores, information in zip(seeds, fit.scores, fit.information, strict=True):
        assert_allclose(scores, score(seed, fit.parameters), rtol=0, atol=1e-4)
        for k, shift in enumerate(1e-5 * np.eye(fit.parameters.size)):
            ends = [score(seed, fit.parameters + side * shift) for side in (1, -1)]
            assert_allclose(information[k], (ends[1] - ends[0]) / 2e-5, rtol=1e-5, atol=1e-3)
    assert_allclose(fit.scores.sum(axis=0), 0.0, atol=1e-4)
    assert np.any(fit.bends != 0.0) == (name == "grain_size")


def test_how_branches_are_spread_over_seeds_does_not_matter_to_the_fit():
    rng = np.random.default_rng(3)
    # More than are taken at a time, and no multiple of that.
    whole = drawn(rng, 40_001)
    order = rng.permutation(40_001)
    parts = [tuple(x[part] for x in whole) for part in np.array_split(order, 7)]
    empty = tuple(np.zeros((3, 0)))
    for name in ("branch_length", "grain_size"):
        alone, spread = (gamma_fit(s, design(name)) for s in ([whole], [*parts, empty]))
        assert_allclose(spread.parameters, alone.parameters, rtol=0, atol=1e-9)
        assert_allclose(spread.information.sum(axis=0), alone.information[0], rtol=1e-6)
        result = sum(deviance(part, design(name), alone.parameters) for part in parts)
        assert_allclose(result, deviance(whole, design(name), alone.parameters), rtol=1e-10)


@settings(deadline=None, max_examples=40)
@given(
    st.integers(0, 2**32),
    st.floats(-30, 30),
    st.floats(-6, 6),
    st.sampled_from(["branch_length", "reduced_radius", "both_radii", "grain_size"]),
)
def test_units_of_energy_and_of_radius_leave_the_exponents(state, decade, radius_decade, name):
    seeds = [drawn(np.random.default_rng(state), 200) for _ in range(2)]
    shift = np.log(10) * radius_decade
    other = [(s + shift, g + shift, e * 10**decade) for s, g, e in seeds]
    fit, moved = gamma_fit(seeds, design(name)), gamma_fit(other, design(name))
    assert_allclose(moved.parameters[1:], fit.parameters[1:], rtol=0, atol=1e-6)
    power = fit.parameters[1:].sum()
    scale = fit.parameters[0] + np.log(10) * (decade - power * radius_decade)
    assert_allclose(moved.parameters[0], scale, rtol=0, atol=1e-4)


def test_branches_without_energy_lower_the_mean():
    small = large = np.log([0.5, 0.5, 1.0, 1.0])
    fit = gamma_fit([(small, large, [2.0, 0.0, 16.0, 0.0])], design("branch_length"))
    assert_allclose(fit.parameters, [np.log(8) - 3 * np.log(2), 3.0], atol=1e-9)


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", PREDICTORS)
def test_branches_of_one_length_do_not_tell_parameters_apart(name):
    seed = (*np.log(np.full((2, 50), 0.3)), np.random.default_rng(1).exponential(size=50))
    with pytest.raises(FitError, match="do not tell the parameters apart"):
        gamma_fit([seed, seed], design(name))


def test_radii_of_one_ratio_do_not_tell_two_exponents_apart():
    large = np.log(np.random.default_rng(1).uniform(0.1, 1.0, 50))
    seed = (large - 0.7, large, np.exp(3 * large))
    assert gamma_fit([seed], design("branch_length")).parameters[1] == pytest.approx(3.0)
    with pytest.raises(FitError, match="do not tell the parameters apart"):
        gamma_fit([seed], design("both_radii"))


def test_radii_that_differ_by_a_millionth_tell_no_exponent():
    rng = np.random.default_rng(1)
    seed = (*np.log(0.3 * rng.uniform(1.0, 1.000001, (2, 500))), rng.exponential(size=500))
    with pytest.raises(FitError, match="do not tell the parameters apart"):
        gamma_fit([seed], design("branch_length"))


@pytest.mark.parametrize("energy", [[], [0.0, 0.0], [1.0, np.nan], [1.0, np.inf]])
def test_seeds_without_finite_energy_are_refused(energy):
    columns = np.log(np.linspace(0.2, 1.0, len(energy)))
    with pytest.raises(FitError, match="branches that carry finite energy"):
        gamma_fit([(columns, columns, energy)], design("branch_length"))


def test_energy_at_one_length_of_two_has_no_exponent():
    columns = np.log([0.1, 0.2])
    with pytest.raises(FitError, match=r"settle|apart"):
        gamma_fit([(columns, columns, [0.0, 1.0])], design("branch_length"))


# --- intervals -----------------------------------------------------------------------------------


def of_refits(seeds, fit, name, resamples, state):
    """Return the interval that a fit to the branches of every draw gives."""
    draws = seed_draws(len(seeds), resamples, np.random.default_rng(state))
    refits = []
    for draw in draws:
        drawn_seeds = [seeds[number] for number in np.repeat(np.arange(len(seeds)), draw)]
        refits.append(gamma_fit(drawn_seeds, design(name), fit.parameters).parameters)
    return interval_of_refits(fit.parameters, refits, len(seeds))


@pytest.mark.parametrize(("spread", "within"), [(0.1, 0.02), (1.0, 0.08), (3.0, 0.25)])
@pytest.mark.parametrize("name", ["branch_length", "both_radii", "grain_size"])
def test_one_step_gives_the_interval_of_real_refits_however_the_scales_differ(name, spread, within):
    rng = np.random.default_rng(5)
    seeds = [
        drawn(rng, 500, name="both_radii", law=(spread * scale, *rng.normal([1.0, 2.0], 0.1)))
        for scale in rng.permutation(np.linspace(-1, 1, 10))
    ]
    fit = gamma_fit(seeds, design(name))
    result = parameter_intervals(fit, resamples=100, rng=np.random.default_rng(1))
    expected = of_refits(seeds, fit, name, 100, 1)
    assert_array_equal(result.estimate, fit.parameters)
    assert_allclose(result.high - result.low, expected.high - expected.low, rtol=within)


def test_a_draw_is_one_step_of_newtons_method_from_its_own_scale():
    # Seeds whose energies differ by far and follow other laws, under a design that is not linear.
    rng, kept = np.random.default_rng(8), []
    laws = [(-1.0, 1.0, 2.0), (0.5, 2.0, 0.5), (2.0, 0.0, 3.0)]
    seeds = [drawn(rng, 200, name="both_radii", law=law) for law in laws]
    fit, states = gamma_fit(seeds, SIZES), {"resamples": 20, "rng": np.random.default_rng(1)}
    parameter_intervals(fit, lambda theta: kept.append(theta) or theta, **states)

    def score(draw, theta):
        parts = [(energy, *SIZES(theta, *columns)) for *columns, energy in seeds]
        return draw @ [(energy * np.exp(-eta) - 1.0) @ slope for energy, eta, slope in parts]

    for draw, refit in zip(seed_draws(3, 20, np.random.default_rng(1)), kept[-1], strict=True):
        relative = [energy * np.exp(-SIZES(fit.parameters, *xy)[0]) for *xy, energy in seeds]
        start = fit.parameters + np.array([np.log(draw @ np.mean(relative, axis=1) / 3), 0.0])
        shifts = 1e-5 * np.eye(2)
        slope = [(score(draw, start + x) - score(draw, start - x)) / 2e-5 for x in shifts]
        step = np.linalg.solve(np.transpose(slope), score(draw, start))
        assert_allclose(refit, start - step, atol=1e-5)


def test_wanted_functions_of_the_parameters_have_intervals_of_their_own():
    rng = np.random.default_rng(6)
    fit = gamma_fit([drawn(rng, 200) for _ in range(6)], design("branch_length"))
    plain = parameter_intervals(fit, rng=np.random.default_rng(1))
    result = parameter_intervals(fit, lambda x: 2 * x[:, 1:] + 1, rng=np.random.default_rng(1))
    assert_allclose(result, [2 * values[1:] + 1 for values in plain], rtol=1e-12)


def test_seeds_alike_leave_no_doubt_and_one_seed_no_interval():
    seed = drawn(np.random.default_rng(1), 200)
    alike = parameter_intervals(gamma_fit([seed] * 3, SIZES), rng=np.random.default_rng(1))
    assert_allclose(alike.high - alike.low, 0.0, atol=1e-6)
    one = parameter_intervals(gamma_fit([seed], SIZES), rng=None)
    assert np.isfinite(one.estimate).all()
    assert np.isnan([one.low, one.high]).all()


@pytest.mark.filterwarnings("error")
def test_draws_without_branches_or_energy_have_no_estimate():
    rng = np.random.default_rng(1)
    idle = tuple(column * factor for column, factor in zip(drawn(rng, 200), (1, 1, 0), strict=True))
    draws = seed_draws(4, 200, np.random.default_rng(1))
    for silent in (idle, tuple(np.zeros((3, 0)))):
        seeds = [drawn(rng, 200), silent, drawn(rng, 200), silent]
        refits = []
        result = parameter_intervals(
            gamma_fit(seeds, design("branch_length")),
            lambda theta, kept=refits: kept.append(theta) or theta,
            resamples=200,
            rng=np.random.default_rng(1),
        )
        loaded = draws[:, [0, 2]].sum(axis=1) > 0
        assert 0 < loaded.sum() < 200
        assert_array_equal(np.isfinite(refits[-1]).all(axis=1), loaded)
        assert np.all(result.high - result.low > 0.0)


# --- deviance ------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32), st.integers(0, 50), st.sampled_from(list(PREDICTORS)))
def test_deviance_is_the_textbook_sum_and_never_negative(state, branches, name):
    rng = np.random.default_rng(state)
    seed = drawn(rng, branches)
    theta = rng.normal(size=len(PREDICTORS[name].names) + 1)
    mean = np.exp(design(name)(theta, *seed[:-1])[0])
    expected = 2 * sum(e / m - 1 - np.log(e / m) for e, m in zip(seed[-1], mean, strict=True))
    result = deviance(seed, design(name), theta)
    assert result >= 0.0
    assert_allclose(result, expected, rtol=1e-9, atol=1e-9)


def test_energies_on_the_law_deviate_by_nothing():
    small, large, energy = branch_columns([0.2, 0.9], [0.4, 0.3], [0.6**3, 1.2**3], 1.0)
    assert deviance((small, large, energy), design("branch_length"), [0.0, 3.0]) < 1e-25
