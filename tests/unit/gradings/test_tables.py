"""Gradings from sieve curves and from densities at a few radii."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import GradingError
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.tables import from_density, from_histogram, from_percent_finer


def test_sieve_curve_goes_through_its_points():
    opening, percent = [0.1, 0.2, 0.5, 1.0, 4.0], [0.0, 12.0, 40.0, 88.0, 100.0]
    grading = from_percent_finer(opening, percent)
    assert_allclose(100 * grading.mass_cdf(opening), percent, rtol=1e-12)
    assert_allclose(grading.mass_ppf(np.array(percent) / 100), opening, rtol=1e-12)


def test_two_sieves_are_uniform_in_the_logarithm_by_mass():
    grading, radius = from_percent_finer([1.0, 100.0], [0.0, 100.0]), np.geomspace(1.0, 100.0, 9)
    assert_allclose(grading.mass_cdf(radius), np.linspace(0, 1, 9), rtol=1e-12)
    # By number the density goes as R^-4.
    assert_allclose(grading.number_cdf(radius), (1 - radius**-3) / (1 - 1e-6), rtol=1e-12)


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
    result, expected = from_density([1.0, 9.0], [7.0, 7.0], "mass"), uniform(1.0, 9.0, "mass")
    radius = np.linspace(1.0, 9.0, 7)
    assert_allclose(result.number_cdf(radius), expected.number_cdf(radius), rtol=1e-12)


def test_range_without_density_at_the_end_of_a_table_is_left_out():
    assert from_density([1, 2, 3, 4, 5], [0, 0, 1, 0, 0], "number").support() == (2.0, 4.0)
    assert from_density([1, 2, 3], [1, 1, 1], "number", 1.5, 9.0).support() == (1.5, 3.0)


@pytest.mark.parametrize(
    "refused",
    [
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
def test_unusable_table_is_refused(refused):
    with pytest.raises(GradingError):
        refused()


def test_channels_hold_their_shares_evenly_on_their_scale():
    edges, shares = [1.0, 2.0, 4.0, 8.0], [0.0, 30.0, 90.0]
    for by in ("number", "mass"):
        log = from_histogram(edges, shares, by)
        linear = from_histogram(edges, shares, by, scale="linear")
        for grading, middle in ((log, 2 * 2**0.5), (linear, 3.0)):
            finer = getattr(grading, f"{by}_cdf")
            assert_allclose(finer([2.0, middle, 4.0, 8.0]), [0, 0.125, 0.25, 1], atol=1e-12)
    assert from_histogram(edges, shares, "mass", 3.0).support() == (3.0, 8.0)


def test_density_per_logarithm_is_drawn_straight_over_the_logarithm():
    flat = from_density([1.0, 100.0], [1.0, 1.0], "mass", per="log_size")
    assert_allclose(flat.mass_cdf([10.0, 31.6227766]), [0.5, 0.75], atol=1e-9)
    rising = from_density([1.0, 100.0], [0.0, 1.0], "mass", per="phi")
    assert_allclose(rising.mass_cdf(10.0), 0.25, atol=1e-12)


@pytest.mark.parametrize("shares", [[0.0, 0.0], [1.0, -1.0], [1.0], [1.0, float("nan")]])
def test_what_are_no_channels_is_refused(shares):
    with pytest.raises(GradingError):
        from_histogram([1.0, 2.0, 4.0], shares, "mass")
