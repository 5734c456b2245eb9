"""Forms of grading against their closed forms, by number and by mass."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import integrate, special, stats

from branchcrush.errors import GradingError
from branchcrush.gradings.forms import (
    fractal,
    fuller,
    lognormal,
    loguniform,
    normal,
    uniform,
    weibull,
)

RATIO = 1000.0
RADIUS = np.geomspace(1.0, RATIO, 40)
bases = pytest.mark.parametrize("by", ["number", "mass"])


def power_share(power, radius):
    """Return the share up to a radius of a density ~ R^power on [1, RATIO]."""
    if power == -1:
        return np.log(radius) / np.log(RATIO)
    return (radius ** (power + 1) - 1) / (RATIO ** (power + 1) - 1)


def assert_curves(grading, by_number, by_mass, radius=RADIUS):
    assert_allclose(grading.number_cdf(radius), by_number, rtol=1e-9, atol=1e-300)
    assert_allclose(grading.mass_cdf(radius), by_mass, rtol=1e-9, atol=1e-300)


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
    result = grading.number_cdf(RADIUS) if by == "number" else grading.mass_cdf(RADIUS)
    assert_allclose(result, cut.cdf(RADIUS), rtol=1e-9, atol=1e-14)
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
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_unusable_form_is_refused(refused):
    with pytest.raises(GradingError):
        refused()
