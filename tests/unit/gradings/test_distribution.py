"""What the gradings of all forms have in common: curves, quantiles, moments and means."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

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
        result, expected = getattr(there, name)(radius * unit), getattr(here, name)(radius)
        assert_allclose(result, expected, rtol=0, atol=1e-11)
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


# --- known gradings ------------------------------------------------------------------------------


def half_and_half():
    """Return half of the number at 2 m, half even from 1 to 3 m."""
    return mixture([single(2.0), uniform(1.0, 3.0)], [1.0, 1.0], "number")


def test_shares_between_two_radii_have_their_own_digits_in_both_tails():
    grading = loguniform(1.0, np.e)
    assert_allclose(grading.number_between(1.0, np.exp(1e-9)), 1e-9, rtol=1e-6)
    assert_allclose(grading.number_between(np.exp(1 - 1e-9), np.e), 1e-9, rtol=1e-6)
    steep = fractal(1.0, 1e6, 3.0)
    # (10^5)^-3 - (10^6)^-3, far below the rounding of a cumulative share of 1.
    assert_allclose(steep.number_between(1e5, 1e6), 1e-15 - 1e-18, rtol=1e-10)
    # From the first radius on, to the second: a size at the first does not count.
    assert_allclose(
        half_and_half().number_between([1.0, 2.0, 1.9], [2.0, 3.0, 2.0]), [0.75, 0.25, 0.525]
    )


def test_means_over_a_part_take_single_sizes_up_to_its_end():
    grading = half_and_half()

    def mean_cube(lower, upper):
        radius, weight = grading.quadrature(lower, upper)
        return weight @ radius**3

    even = {(1, 2): 15 / 16, (2, 3): 65 / 16, (1, 3): 5.0}  # 1/4 of the integral of R^3
    assert_allclose(mean_cube(None, 2.0), even[1, 2] + 4.0, rtol=1e-13)
    assert_allclose(mean_cube(2.0, None), even[2, 3], rtol=1e-13)
    assert_allclose(mean_cube(0.5, 9.0), even[1, 3] + 4.0, rtol=1e-13)
    assert_allclose(mean_cube(None, None), grading.moment(3), rtol=1e-13)


def test_means_from_below_the_smallest_size_take_it_and_from_it_on_do_not():
    grading = from_radii([1.0, 2.0])
    for lower, expected in ((None, 0.5 + 4.0), (0.5, 0.5 + 4.0), (1.0, 4.0), (2.0, 0.0)):
        radius, weight = grading.quadrature(lower)
        assert weight @ radius**3 == expected


def test_density_of_the_continuous_part_is_that_of_its_share():
    grading = half_and_half()
    assert_allclose(grading.continuous_pdf([0.9, 1.0, 2.0, 3.0, 3.1]), [0, 0.25, 0.25, 0.25, 0])
    assert np.isnan(grading.number_pdf([1.5, 2.0])).all()
    assert not grading.has_density and not grading.is_discrete
    assert from_radii([1.0]).continuous_pdf([1.0, 2.0]).tolist() == [0.0, 0.0]
