"""Radii drawn from a grading: they follow it, meet it at the quantiles, and come in order."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy import stats

from branchcrush.errors import GradingError
from branchcrush.gradings.forms import fractal, normal, uniform
from branchcrush.gradings.mixtures import from_radii, mixture, single
from branchcrush.gradings.representativity import realised_gap
from branchcrush.gradings.sampling import METHODS, sampled_radii

GRADINGS = {
    "uniform": uniform(5e-6, 1e-3),
    "fractal": fractal(5e-6, 1e-3, 2.6),
    "normal by mass": normal(5e-4, 1e-4, 1e-4, 1e-3, "mass"),
    "two sizes": mixture([single(1e-4), single(1e-3)], [1.0, 3.0], "mass"),
    "size among others": mixture([single(5e-4), uniform(1e-4, 1e-3)], [1.0, 3.0], "number"),
}
any_grading = pytest.mark.parametrize("grading", GRADINGS.values(), ids=GRADINGS)
any_method = pytest.mark.parametrize("method", METHODS)


def generator():
    return np.random.default_rng(7)


@any_method
@any_grading
def test_grains_are_as_many_as_asked_decreasing_and_within_the_support(grading, method):
    radii = sampled_radii(grading, 257, method, generator())
    start, end = grading.support()
    assert radii.shape == (257,)
    assert np.all(np.diff(radii) <= 0)
    assert start <= radii[-1] <= radii[0] <= end


@any_grading
def test_random_radii_follow_the_grading(grading):
    radii = sampled_radii(grading, 20_000, "random", generator())
    points = np.append(grading.number_ppf(np.linspace(0.05, 0.95, 19)), grading.discrete_part[0])
    result = np.searchsorted(np.sort(radii), points, side="right") / radii.size
    # Four standard errors.
    assert_allclose(result, grading.number_cdf(points), atol=4 * 0.5 / 20_000**0.5)


def test_random_radii_of_a_continuous_grading_pass_a_test_of_their_distribution():
    radii = sampled_radii(GRADINGS["fractal"], 20_000, "random", generator())
    assert stats.kstest(radii, GRADINGS["fractal"].number_cdf).pvalue > 0.05


def test_random_radii_of_a_seed_are_always_the_same():
    first, second = (sampled_radii(uniform(1, 2), 9, "random", generator()) for _ in range(2))
    assert_array_equal(first, second)
    other = sampled_radii(uniform(1, 2), 9, "random", np.random.default_rng(8))
    assert np.all(first != other)


def test_number_quantiles_of_the_uniform_grading_are_even():
    radii = sampled_radii(uniform(1.0, 3.0), 4, "number_quantiles", None)
    assert_allclose(radii, [2.75, 2.25, 1.75, 1.25], rtol=1e-14)


@any_grading
def test_number_quantiles_have_half_a_grain_more_and_less_on_either_side(grading):
    radii = sampled_radii(grading, 100, "number_quantiles", None)[::-1]
    shares = (np.arange(100) + 0.5) / 100
    assert np.all(grading.number_cdf(radii * (1 + 1e-12)) >= shares - 1e-12)
    assert np.all(grading.number_cdf(radii * (1 - 1e-9)) <= shares + 1e-7)


@pytest.mark.parametrize("grains", [1, 7, 1000])
@pytest.mark.parametrize("name", ["uniform", "fractal", "normal by mass"])
def test_mass_quantiles_meet_the_sieve_curve_at_the_end_of_every_interval(name, grains):
    grading = GRADINGS[name]
    radii = sampled_radii(grading, grains, "mass_quantiles", None)[::-1]
    ends = grading.number_ppf(np.arange(1, grains + 1) / grains)
    mass = np.cumsum(radii**3) / (grains * grading.moment(3))
    assert_allclose(mass, grading.mass_cdf(ends), rtol=1e-10)
    assert np.all(radii[1:] >= ends[:-1]) and np.all(radii <= ends)


@any_grading
def test_mass_quantiles_have_the_volume_of_the_grading(grading):
    radii = sampled_radii(grading, 1000, "mass_quantiles", None)
    assert_allclose(np.mean(radii**3), grading.moment(3), rtol=1e-10)


def test_mass_quantiles_keep_single_sizes_and_mix_them_in_one_grain_only():
    grading = mixture([single(1.0), single(2.0)], [5.0, 3.0], "number")
    radii = sampled_radii(grading, 8, "mass_quantiles", None)
    assert_allclose(radii, [2.0] * 3 + [1.0] * 5, rtol=1e-12)
    radii = sampled_radii(grading, 4, "mass_quantiles", None)
    # The third of four intervals holds half a grain of each.
    assert_allclose(radii, [2.0, 4.5 ** (1 / 3), 1.0, 1.0], rtol=1e-12)


@any_method
def test_all_grains_of_one_size_are_exactly_it(method):
    assert set(sampled_radii(single(0.3), 1000, method, generator()).tolist()) == {0.3}


def test_quantiles_of_given_radii_are_these():
    sizes = np.random.default_rng(1).uniform(1.0, 9.0, 50)
    for method in ("number_quantiles", "mass_quantiles"):
        radii = sampled_radii(from_radii(sizes), 50, method, None)
        assert_allclose(radii, np.sort(sizes)[::-1], rtol=1e-10)


def test_mass_quantiles_are_nearest_to_the_sieve_curve():
    grading = GRADINGS["uniform"]
    gaps = [realised_gap(grading, sampled_radii(grading, 500, m, generator())) for m in METHODS]
    assert gaps[2] <= gaps[1] < gaps[0]


@any_method
def test_many_grains_take_no_time(method):
    started = time.perf_counter()
    sampled_radii(GRADINGS["fractal"], 100_000, method, generator())
    assert time.perf_counter() - started < 5.0


def test_unknown_method_is_refused():
    with pytest.raises(ValueError, match="'sobol'"):
        sampled_radii(single(1.0), 3, "sobol", None)


def test_a_list_is_taken_as_it_is():
    sizes = np.array([0.01220, 0.01445, 0.00998, 0.01220, 0.02242]) / 2
    radii = sampled_radii(from_radii(sizes), 5, "listed", None)
    assert radii.tolist() == [0.01121, 0.007225, 0.0061, 0.0061, 0.00499]


@settings(deadline=None, max_examples=50)
@given(st.lists(st.floats(1e-6, 1e3), min_size=1, max_size=300))
def test_any_list_is_taken_as_it_is(sizes):
    radii = sampled_radii(from_radii(sizes), len(sizes), "listed", None)
    assert radii.tolist() == sorted(sizes, reverse=True)


@pytest.mark.parametrize("grading", [from_radii([1.0, 2.0, 3.0]), uniform(1.0, 2.0)])
def test_what_is_no_list_of_so_many_grains_is_refused(grading):
    with pytest.raises(GradingError, match="no list of 4 grains"):
        sampled_radii(grading, 4, "listed", None)
