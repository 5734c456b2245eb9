"""Curves through D10, D50 and D90: closed forms, worked out by hand."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from branchcrush.errors import GradingError
from branchcrush.gradings.forms import lognormal, weibull
from branchcrush.gradings.size_fits import fit_sizes

# Of the standard normal distribution, from a table.
Z90 = 1.2815515655446004
LASER = {10.0: 82.0, 50.0: 200.0, 90.0: 486.0}
positive = st.floats(1e-6, 1e6)


def test_lognormal_of_three_sizes_is_the_regression_worked_out_by_hand():
    # z = -Z90, 0, Z90: the median is the geometric mean of the three, the slope that of the ends.
    fit = fit_sizes("lognormal", LASER)
    assert fit.centre == pytest.approx((82 * 200 * 486) ** (1 / 3), rel=1e-12)
    assert fit.width == pytest.approx((486 / 82) ** (1 / (2 * Z90)), rel=1e-12)
    # One part of the difference between D50 and the mean of the ends is left at each end, two in
    # the middle.
    off = (math.log(82 * 486) / 2 - math.log(200)) / 3
    residuals = [math.log(a / b) for a, b in zip(fit.fitted, fit.given, strict=True)]
    assert residuals == pytest.approx([-off, 2 * off, -off], abs=1e-12)
    assert fit.root_mean_square == pytest.approx(abs(off) * math.sqrt(2), rel=1e-9)


def test_weibull_of_three_sizes_misses_what_is_lognormal_by_a_known_part():
    # x = ln(-ln(1 - q)) = -2.25037, -0.36651, 0.83403 at ln D = 4.40672, 5.29832, 6.18621.
    fit = fit_sizes("weibull", LASER)
    x = [math.log(-math.log(share)) for share in (0.9, 0.5, 0.1)]
    y = [math.log(size) for size in (82, 200, 486)]
    means = sum(x) / 3, sum(y) / 3
    slope = sum((a - means[0]) * (b - means[1]) for a, b in zip(x, y, strict=True))
    slope /= sum((a - means[0]) ** 2 for a in x)
    assert fit.width == pytest.approx(1 / slope, rel=1e-12) == pytest.approx(1.7615, abs=5e-4)
    assert fit.centre == pytest.approx(math.exp(means[1] - slope * means[0]), rel=1e-12)
    assert fit.misfits == pytest.approx([-0.0475, 0.1366, -0.0752], abs=2e-3)


@pytest.mark.parametrize("pair", [(10.0, 50.0), (10.0, 90.0), (50.0, 90.0)])
@pytest.mark.parametrize("curve", ["lognormal", "weibull"])
def test_two_sizes_are_met(curve, pair):
    fit = fit_sizes(curve, {x: LASER[x] for x in pair})
    assert fit.fitted == pytest.approx(fit.given, rel=1e-12)
    assert set(fit.report()["misfit_percent"].values()) == {0.0}


def test_sixty_three_percent_are_finer_than_the_scale_of_weibull():
    fit = fit_sizes("weibull", {10.0: (-math.log(0.9)) ** 0.5, 90.0: math.log(10) ** 0.5})
    assert (fit.centre, fit.width) == pytest.approx((1.0, 2.0), rel=1e-12)
    assert fit.sizes([100 * (1 - math.exp(-1))]) == pytest.approx([1.0], rel=1e-12)


@given(positive, st.floats(1.01, 20.0))
def test_sizes_of_a_lognormal_give_its_parameters(median, deviation):
    sizes = {50.0: median, 10.0: median * deviation**-Z90, 90.0: median * deviation**Z90}
    fit = fit_sizes("lognormal", sizes)
    assert (fit.centre, fit.width) == pytest.approx((median, deviation), rel=1e-9)
    assert fit.root_mean_square < 1e-9
    # 2.326 standard deviations to 1 and 99 percent.
    ends = median * deviation**-2.3263478740408408, median * deviation**2.3263478740408408
    assert fit.advised_ends == pytest.approx(ends, rel=1e-9)


@given(positive, st.floats(0.3, 50.0))
def test_sizes_of_a_weibull_give_its_parameters(scale, shape):
    logs = {10.0: -math.log(0.9), 50.0: math.log(2), 90.0: math.log(10)}
    fit = fit_sizes("weibull", {x: scale * log ** (1 / shape) for x, log in logs.items()})
    assert (fit.centre, fit.width) == pytest.approx((scale, shape), rel=1e-8)
    assert fit.root_mean_square < 1e-9


@given(st.floats(1e-3, 1e3), st.floats(1.0001, 1.5), st.floats(1.0001, 1.5))
def test_a_unit_changes_the_centre_alone(factor, low, high):
    sizes = {10.0: 1 / low, 50.0: 1.0, 90.0: high}
    for curve in ("lognormal", "weibull"):
        one = fit_sizes(curve, sizes)
        other = fit_sizes(curve, {x: factor * size for x, size in sizes.items()})
        assert other.centre == pytest.approx(factor * one.centre, rel=1e-9)
        assert other.width == pytest.approx(one.width, rel=1e-6)


@pytest.mark.parametrize(("curve", "form"), [("lognormal", lognormal), ("weibull", weibull)])
def test_the_grading_of_a_fit_has_its_sizes_where_it_is_hardly_cut(curve, form):
    fit = fit_sizes(curve, {10.0: 1.0, 90.0: 3.0})
    grading = form(fit.centre, fit.width, 1e-4, 100.0, "mass")
    assert grading.mass_ppf([0.1, 0.9]) == pytest.approx([1.0, 3.0], rel=1e-6)


@pytest.mark.parametrize("curve", ["lognormal", "weibull"])
def test_a_curve_that_misses_a_size_by_more_than_a_quarter_is_refused(curve):
    with pytest.raises(GradingError) as refused:
        fit_sizes(curve, {10.0: 10.0, 50.0: 200.0, 90.0: 220.0})
    for words in (f"no {curve} curve", "D50 = 200", "at most 25% apart", "form: sieve"):
        assert words in str(refused.value)


@pytest.mark.parametrize(("middle", "refused"), [(1.39, False), (1.41, True)])
def test_the_middle_of_a_lognormal_may_be_off_by_a_quarter(middle, refused):
    # D50 is missed by two thirds of its distance from the mean of the ends: 1.25^1.5 = 1.398.
    sizes = {10.0: 0.1, 50.0: middle, 90.0: 10.0}
    if refused:
        with pytest.raises(GradingError):
            fit_sizes("lognormal", sizes)
    else:
        assert fit_sizes("lognormal", sizes).misfits[1] == pytest.approx(
            middle ** (-2 / 3) - 1, rel=1e-9
        )


@pytest.mark.parametrize(
    ("sizes", "words"),
    [
        ({50.0: 1.0}, "two sizes or more"),
        ({10.0: 2.0, 50.0: 1.0}, "grow with their percentage, not D10 = 2, D50 = 1"),
        ({10.0: 1.0, 90.0: 1.0}, "grow with their percentage"),
        ({10.0: 0.0, 90.0: 1.0}, "above 0"),
    ],
)
def test_sizes_that_are_no_curve_are_refused(sizes, words):
    with pytest.raises(GradingError, match=words):
        fit_sizes("lognormal", sizes)


def test_another_curve_is_refused():
    with pytest.raises(GradingError, match="lognormal or weibull, not 'gamma'"):
        fit_sizes("gamma", LASER)
