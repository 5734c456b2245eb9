"""Forms of grading against closed forms by number and by mass, and what all have in common."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy import integrate, special, stats

from branchcrush.errors import GradingError
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.forms import (
    fractal,
    fuller,
    lognormal,
    loguniform,
    normal,
    uniform,
    weibull,
)
from branchcrush.gradings.mixtures import from_radii, mixture, single
from branchcrush.gradings.tables import from_density, from_percent_finer

RATIO = 1000.0
RADIUS = np.geomspace(1.0, RATIO, 40)
bases = pytest.mark.parametrize("by", ["number", "mass"])


@st.composite
def gradings(draw, unit=None):
    """Return a grading of any form; all of its sizes are multiples of the unit."""
    unit = 10.0 ** draw(st.floats(-6, 1)) if unit is None else unit
    low = unit
    high = unit * draw(st.floats(1.5, 1000))
    by = draw(st.sampled_from(["number", "mass"]))
    inside = np.sqrt(low * high)
    form = draw(st.sampled_from(sorted(FORMS)))
    return FORMS[form](low, high, inside, by, draw(st.floats(0.1, 4.0)))


def mixed(low, high, middle, by, shape):
    parts = [single(middle), fuller(low, high, shape), from_radii([low, middle, high])]
    return mixture(parts, [1.0, shape, 0.5], by)


FORMS = {
    "uniform": lambda low, high, middle, by, shape: uniform(low, high, by),
    "loguniform": lambda low, high, middle, by, shape: loguniform(low, high, by),
    "normal": lambda low, high, middle, by, shape: normal(middle, shape * low, low, high, by),
    "lognormal": lambda low, high, middle, by, shape: lognormal(middle, 1 + shape, low, high, by),
    "weibull": lambda low, high, middle, by, shape: weibull(middle, shape, low, high, by),
    "fractal": lambda low, high, middle, by, shape: fractal(low, high, shape),
    "fuller": lambda low, high, middle, by, shape: fuller(low, high, shape),
    "single": lambda low, high, middle, by, shape: single(middle),
    "radii": lambda low, high, middle, by, shape: from_radii([low, middle, middle, high]),
    "mixture": mixed,
    "sieve": lambda low, high, middle, by, shape: from_percent_finer(
        [low, middle, high], [0.0, 20.0 * shape, 100.0]
    ),
    "density": lambda low, high, middle, by, shape: from_density(
        [low, middle, high], [0.0, shape, 1.0], by
    ),
}


def power_share(power, radius):
    """Return the share up to a radius of a density ~ R^power on [1, RATIO]."""
    if power == -1:
        return np.log(radius) / np.log(RATIO)
    return (radius ** (power + 1) - 1) / (RATIO ** (power + 1) - 1)


def assert_curves(grading, by_number, by_mass, radius=RADIUS):
    assert_allclose(grading.number_cdf(radius), by_number, rtol=1e-9, atol=1e-300)
    assert_allclose(grading.mass_cdf(radius), by_mass, rtol=1e-9, atol=1e-300)


# --- closed forms --------------------------------------------------------------------------------


@bases
def test_uniform(by):
    power = 0 if by == "number" else -3
    shares = power_share(power, RADIUS), power_share(power + 3, RADIUS)
    assert_curves(uniform(1.0, RATIO, by), *shares)


@bases
def test_loguniform(by):
    power = -1 if by == "number" else -4
    shares = power_share(power, RADIUS), power_share(power + 3, RADIUS)
    assert_curves(loguniform(1.0, RATIO, by), *shares)


@pytest.mark.parametrize("alpha", [0.3, 2.5, 3.0, 5.5])
def test_fractal(alpha):
    shares = power_share(-1 - alpha, RADIUS), power_share(2 - alpha, RADIUS)
    assert_curves(fractal(1.0, RATIO, alpha), *shares)


@pytest.mark.parametrize("exponent", [0.45, 0.5, 1.0, 3.0])
def test_fuller(exponent):
    shares = power_share(exponent - 4, RADIUS), power_share(exponent - 1, RADIUS)
    assert_curves(fuller(1.0, RATIO, exponent), *shares)


@bases
def test_lognormal_has_the_same_width_by_number_and_by_mass(by):
    width, median = 2.0, 30.0
    log_width = np.log(width)
    shift = np.exp(3 * log_width**2)
    medians = (median, median * shift) if by == "number" else (median / shift, median)
    curves = [
        stats.norm.cdf(np.log(RADIUS / m) / log_width) - stats.norm.cdf(np.log(1 / m) / log_width)
        for m in medians
    ]
    shares = [curve / curve[-1] for curve in curves]
    grading = lognormal(median, width, 1.0, RATIO, by)
    assert_allclose(grading.number_cdf(RADIUS), shares[0], rtol=1e-9, atol=1e-14)
    assert_allclose(grading.mass_cdf(RADIUS), shares[1], rtol=1e-9, atol=1e-14)


def test_weibull_by_mass_is_the_law_of_rosin_and_rammler_cut_at_both_ends():
    grading = weibull(100.0, 0.8, 1.0, RATIO, "mass")
    passing = -np.expm1(-((RADIUS / 100.0) ** 0.8))
    expected = (passing - passing[0]) / (passing[-1] - passing[0])
    assert_allclose(grading.mass_cdf(RADIUS), expected, rtol=1e-9, atol=1e-14)


def test_weibull_by_number_has_the_mass_of_an_incomplete_gamma_function():
    shape, scale = 1.4, 100.0
    grading = weibull(scale, shape, 1.0, RATIO, "number")
    mass = special.gammainc(1 + 3 / shape, (RADIUS / scale) ** shape)
    assert_allclose(grading.mass_cdf(RADIUS), (mass - mass[0]) / (mass[-1] - mass[0]), rtol=1e-8)


@bases
def test_normal(by):
    mean, deviation = 400.0, 120.0
    grading = normal(mean, deviation, 1.0, RATIO, by)
    cut = stats.truncnorm((1 - mean) / deviation, (RATIO - mean) / deviation, mean, deviation)
    found = grading.number_cdf(RADIUS) if by == "number" else grading.mass_cdf(RADIUS)
    assert_allclose(found, cut.cdf(RADIUS), rtol=1e-9, atol=1e-14)
    power = 3 if by == "number" else -3

    def part(low, high):
        return integrate.quad(lambda r: r**power * cut.pdf(r), low, high, epsabs=0, limit=500)[0]

    steps = [part(low, high) for low, high in pairwise(RADIUS)]
    other = grading.mass_cdf(RADIUS) if by == "number" else grading.number_cdf(RADIUS)
    assert_allclose(other[1:], np.cumsum(steps) / np.sum(steps), rtol=1e-9)


def test_narrow_peak_in_a_wide_range_is_not_missed():
    grading = normal(1.0, 1e-6, 1e-3, 1e3)
    assert_allclose([grading.moment(k) for k in (1, 2, 3)], 1.0, rtol=1e-9)
    assert_allclose(grading.number_ppf(stats.norm.cdf([-2.0, 1.0])), [1 - 2e-6, 1 + 1e-6])


def test_single_size():
    grading = single(2.0)
    assert grading.support() == (2.0, 2.0)
    assert grading.number_cdf([1.9, 2.0, 2.1]).tolist() == [0, 1, 1]
    assert grading.mass_cdf([1.9, 2.0, 2.1]).tolist() == [0, 1, 1]
    assert grading.number_ppf([0.0, 0.5, 1.0]).tolist() == [2.0, 2.0, 2.0]
    assert grading.moment(3) == 8.0


def test_radii_count_alike():
    grading = from_radii([3.0, 1.0, 1.0, 2.0])
    assert grading.number_cdf([0.9, 1.0, 2.0, 3.0]).tolist() == [0.0, 0.5, 0.75, 1.0]
    assert_allclose(grading.mass_cdf([1.0, 2.0, 3.0]), np.array([2, 10, 37]) / 37, rtol=1e-15)
    assert grading.number_ppf([0.5, 0.51, 0.75, 0.76]).tolist() == [1.0, 2.0, 2.0, 3.0]


# --- tables --------------------------------------------------------------------------------------


def test_sieve_curve_goes_through_its_points():
    opening, percent = [0.1, 0.2, 0.5, 1.0, 4.0], [0.0, 12.0, 40.0, 88.0, 100.0]
    grading = from_percent_finer(opening, percent)
    assert_allclose(100 * grading.mass_cdf(opening), percent, rtol=1e-12)
    assert_allclose(grading.mass_ppf(np.array(percent) / 100), opening, rtol=1e-12)


def test_two_sieves_are_uniform_in_the_logarithm_by_mass():
    grading = from_percent_finer([1.0, RATIO], [0.0, 100.0])
    assert_curves(grading, power_share(-4, RADIUS), power_share(-1, RADIUS))


def test_gap_graded_soil_has_no_grains_in_the_gap():
    grading = from_percent_finer([1.0, 2.0, 8.0, 16.0], [0.0, 40.0, 40.0, 100.0])
    assert_allclose(grading.mass_cdf([2.0, 5.0, 8.0]), 0.4, rtol=1e-12)
    assert_allclose(grading.mass_ppf(0.4), 2.0, rtol=1e-6)
    radii = grading.number_ppf(np.random.default_rng(1).random(1000))
    assert not np.any((radii > 2.0 * (1 + 1e-6)) & (radii < 8.0 * (1 - 1e-6)))


def test_sieves_that_nothing_or_everything_passes_bound_nothing():
    grading = from_percent_finer([0.01, 1.0, 2.0, 4.0, 90.0], [0.0, 0.0, 50.0, 100.0, 100.0])
    assert grading.support() == (1.0, 4.0)


def test_cut_sieve_curve_is_100_percent_of_the_rest():
    opening, percent = [0.1, 0.2, 0.5, 1.0, 4.0], [5.0, 12.0, 40.0, 88.0, 95.0]
    grading = from_percent_finer(opening, percent, radius_min=0.2, radius_max=1.0)
    assert grading.support() == (0.2, 1.0)
    assert_allclose(grading.mass_cdf([0.2, 0.5, 1.0]), [0, 28 / 76, 1], atol=1e-14)


def test_density_is_straight_between_its_points():
    grading = from_density([1.0, 2.0, 4.0], [0.0, 1.0, 0.0], "number")
    assert_allclose(grading.number_pdf([1.5, 2.0, 3.0]), np.array([0.5, 1.0, 0.5]) / 1.5)
    assert_allclose(grading.number_cdf([1.5, 2.0, 3.0]), [1 / 12, 1 / 3, 5 / 6], rtol=1e-12)
    assert_allclose(grading.moment(1), 7 / 3, rtol=1e-12)


def test_density_by_mass_at_one_value_is_the_uniform_grading_by_mass():
    found, expected = from_density([1.0, 9.0], [7.0, 7.0], "mass"), uniform(1.0, 9.0, "mass")
    radius = np.linspace(1.0, 9.0, 7)
    assert_allclose(found.number_cdf(radius), expected.number_cdf(radius), rtol=1e-12)


def test_range_without_density_at_the_end_of_a_table_is_left_out():
    assert from_density([1, 2, 3, 4, 5], [0, 0, 1, 0, 0], "number").support() == (2.0, 4.0)
    assert from_density([1, 2, 3], [1, 1, 1], "number", 1.5, 9.0).support() == (1.5, 3.0)


# --- mixtures ------------------------------------------------------------------------------------


def test_two_sizes_by_number_and_by_mass():
    radius = [0.9, 1.0, 1.9, 2.0]
    sizes = [single(1.0), single(2.0)]
    by_number = mixture(sizes, [3.0, 1.0], "number")
    assert by_number.number_cdf(radius).tolist() == [0.0, 0.75, 0.75, 1.0]
    assert_allclose(by_number.mass_cdf(radius), [0, 3 / 11, 3 / 11, 1], rtol=1e-15)
    by_mass = mixture(sizes, [3.0, 1.0], "mass")
    assert by_mass.mass_cdf(radius).tolist() == [0.0, 0.75, 0.75, 1.0]
    assert_allclose(by_mass.number_cdf(radius), [0, 24 / 25, 24 / 25, 1], rtol=1e-15)


@bases
def test_mixture_is_the_weighted_mean_of_the_curves_of_its_basis(by):
    parts = [uniform(1.0, 5.0), fractal(2.0, 90.0, 2.5), single(3.0)]
    weights = np.array([0.5, 0.3, 0.2])
    radius = np.append(np.geomspace(0.9, 91.0, 50), 3.0)
    whole = mixture(parts, 7 * weights, by)
    curves = [getattr(part, f"{by}_cdf")(radius) for part in parts]
    assert_allclose(getattr(whole, f"{by}_cdf")(radius), weights @ curves, rtol=1e-12)


def test_mixture_of_parts_that_leave_a_gap():
    whole = mixture([uniform(1.0, 2.0), uniform(4.0, 5.0)], [1.0, 1.0], "number")
    assert_allclose(whole.number_cdf([1.5, 2.0, 3.0, 4.5]), [0.25, 0.5, 0.5, 0.75], rtol=1e-13)
    assert whole.number_pdf(3.0) == 0.0
    assert_allclose(whole.number_ppf([0.25, 0.75]), [1.5, 4.5], rtol=1e-13)


# --- what all forms have in common ---------------------------------------------------------------


@settings(deadline=None, max_examples=60)
@given(gradings())
def test_curves_grow_from_0_to_1(grading):
    start, end = grading.support()
    radius = np.unique(np.append(np.geomspace(start, end, 60), grading.breaks))
    for cdf in (grading.number_cdf, grading.mass_cdf):
        share = cdf(radius)
        assert cdf(start * (1 - 1e-9)) == 0.0
        assert cdf(end) == 1.0 and cdf(2 * end) == 1.0
        assert np.all((share >= 0) & (share <= 1)) and np.all(np.diff(share) > -1e-15)
        if grading.has_density:
            assert share[0] == 0.0


@settings(deadline=None, max_examples=60)
@given(gradings(), st.lists(st.floats(0, 1), min_size=1, max_size=20))
def test_quantile_is_the_first_radius_that_reaches_a_share(grading, shares):
    shares = np.array(shares)
    start, end = grading.support()
    for cdf, ppf in (
        (grading.number_cdf, grading.number_ppf),
        (grading.mass_cdf, grading.mass_ppf),
    ):
        radius = ppf(shares)
        assert np.all((radius >= start) & (radius <= end))
        assert np.all(cdf(radius * (1 + 1e-12)) >= shares - 1e-12)
        assert np.all(cdf(radius * (1 - 1e-9)) <= shares + 1e-12)


@settings(deadline=None, max_examples=60)
@given(gradings())
def test_half_of_the_mass_is_in_grains_larger_than_the_median_by_number(grading):
    assert grading.mass_ppf(0.5) >= grading.number_ppf(0.5) * (1 - 1e-12)
    radius = np.geomspace(*grading.support(), 20)
    assert np.all(grading.mass_cdf(radius) <= grading.number_cdf(radius) + 1e-13)


@settings(deadline=None, max_examples=40)
@given(gradings(), st.floats(0.1, 0.9))
def test_quadrature_agrees_with_moments_and_adds_up_over_two_parts(grading, share):
    radius, weight = grading.quadrature()
    assert_allclose(weight.sum(), 1.0, rtol=1e-12)
    for k in (-1, 1, 3, 4.5):
        assert_allclose(weight @ radius**k, grading.moment(k), rtol=1e-12)
    cut = float(grading.number_ppf(share))
    below, above = grading.quadrature(upper=cut), grading.quadrature(lower=cut)
    assert_allclose(below[1].sum(), grading.number_cdf(cut), rtol=1e-10)
    cubes = [part[1] @ part[0] ** 3 for part in (below, above)]
    assert_allclose(sum(cubes), grading.moment(3), rtol=1e-10)
    assert_allclose(cubes[0] / grading.moment(3), grading.mass_cdf(cut), rtol=1e-9)


@settings(deadline=None, max_examples=40)
@given(gradings())
def test_moments_are_those_of_the_quantiles(grading):
    # The mean over shares of the quantile's power, by the midpoint rule.
    radius = grading.number_ppf((np.arange(20_000) + 0.5) / 20_000)
    assert_allclose(np.mean(radius), grading.moment(1), rtol=5e-3)


@settings(deadline=None, max_examples=30)
@given(st.data(), st.floats(1e-3, 1e3))
def test_unit_of_length_does_not_change_the_curves(data, unit):
    form = data.draw(st.sampled_from(sorted(FORMS)))
    by = data.draw(st.sampled_from(["number", "mass"]))
    here, there = (FORMS[form](u, 50 * u, 7 * u, by, 1.5) for u in (1.0, unit))
    radius = np.geomspace(0.9, 60.0, 30)
    for name in ("number_cdf", "mass_cdf"):
        found, expected = getattr(there, name)(radius * unit), getattr(here, name)(radius)
        assert_allclose(found, expected, rtol=0, atol=1e-11)
    assert_allclose(there.moment(3), here.moment(3) * unit**3, rtol=1e-10)


def mass_density(grading, radius):
    """Return R^3 n(R)/<R^3>, what a sieve weighs."""
    return grading.number_pdf(radius) * radius**3 / grading.moment(3)


@settings(deadline=None, max_examples=40)
@given(gradings())
def test_number_to_mass_and_back_is_the_same_grading(grading):
    if not grading.has_density:
        return
    again = Grading(lambda r: mass_density(grading, r) / r**3, grading.breaks)
    radius = np.geomspace(*grading.support(), 20)
    assert_allclose(again.number_cdf(radius), grading.number_cdf(radius), rtol=1e-9, atol=1e-13)
    assert_allclose(again.mass_cdf(radius), grading.mass_cdf(radius), rtol=1e-9, atol=1e-13)


@settings(deadline=None, max_examples=40)
@given(gradings())
def test_density_is_the_slope_of_the_curve(grading):
    radius = np.geomspace(*grading.support(), 7)[1:-1]
    if not grading.has_density:
        assert np.isnan(grading.number_pdf(radius)).all()
        return
    step = 1e-5 * radius
    for cdf, pdf in (
        (grading.number_cdf, grading.number_pdf),
        (grading.mass_cdf, lambda r: mass_density(grading, r)),
    ):
        slope = (cdf(radius + step) - cdf(radius - step)) / (2 * step)
        assert_allclose(pdf(radius), slope, rtol=2e-3, atol=1e-5 / grading.support()[1])


# --- refused -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "refused",
    [
        lambda: uniform(2.0, 1.0),
        lambda: uniform(0.0, 1.0),
        lambda: uniform(1.0, 1.0),
        lambda: uniform(1.0, np.inf),
        lambda: uniform(1.0, 2.0, "volume"),
        lambda: normal(9.0, 0.1, 1.0, 2.0),
        lambda: normal(1.5, -0.1, 1.0, 2.0),
        lambda: normal(1.5, 0.1, 2.0, 1.0),
        lambda: lognormal(1.5, 1.0, 1.0, 2.0),
        lambda: weibull(1.5, 0.0, 1.0, 2.0),
        lambda: single(0.0),
        lambda: single(-1.0),
        lambda: from_radii([]),
        lambda: from_radii([1.0, np.nan]),
        lambda: mixture([single(1.0), single(2.0)], [1.0, 0.0], "mass"),
        lambda: mixture([], [], "mass"),
        lambda: mixture([single(1.0)], [1.0], "volume"),
        lambda: from_percent_finer([1.0, 2.0], [5.0, 100.0]),
        lambda: from_percent_finer([1.0, 2.0], [0.0, 99.0]),
        lambda: from_percent_finer([1.0, 2.0, 3.0], [0.0, 101.0, 100.0]),
        lambda: from_percent_finer([1.0, 2.0], [5.0, 100.0], radius_min=0.5),
        lambda: from_percent_finer([2.0, 1.0], [0.0, 100.0]),
        lambda: from_percent_finer([1.0], [100.0]),
        lambda: from_percent_finer([1.0, 2.0], [5.0, 5.0], 1.0, 2.0),
        lambda: from_percent_finer([1.0, 2.0], [0.0, 100.0], radius_min=2.0),
        lambda: from_density([1.0, 2.0], [1.0, -1.0], "number"),
        lambda: from_density([1.0, 2.0], [0.0, 0.0], "number"),
        lambda: from_density([1.0, 2.0], [1.0, np.nan], "number"),
        lambda: from_density([1.0, 2.0], [1.0, 1.0], "number", radius_min=3.0),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_unusable_grading_is_refused(refused):
    with pytest.raises(GradingError):
        refused()
