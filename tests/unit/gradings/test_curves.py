"""Gradings against closed forms: their moments, their sieve curves, and the radii drawn."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy import stats

from branchcrush.gradings.curves import (
    grading_summary,
    grading_table,
    particle_diameter,
    realised_percent_finer,
)
from branchcrush.gradings.forms import fractal, fuller, uniform
from branchcrush.gradings.mixtures import from_radii, mixture, single

RADIUS_MAX = 1e-3
ratios = pytest.mark.parametrize("ratio", [2, 200, 1000])
alphas = pytest.mark.parametrize("alpha", [2.5, 2.6, 2.7])


@st.composite
def gradings(draw):
    radius_max = 10.0 ** draw(st.floats(-6, 2))
    radius_min = radius_max / draw(st.floats(1.2, 1000))
    alpha = draw(st.none() | st.floats(0.3, 5.5))
    if alpha is None:
        return uniform(radius_min, radius_max)
    return fractal(radius_min, radius_max, alpha)


def uniform_moment(radius_min, radius_max, k):
    """<R^k> = (R_M^(k+1) - R_m^(k+1)) / ((k+1) (R_M - R_m))"""
    difference = radius_max ** (k + 1) - radius_min ** (k + 1)
    return difference / ((k + 1) * (radius_max - radius_min))


def fractal_moment(radius_min, radius_max, alpha, k):
    """<R^k> of P = a R_m^a R^-(1+a) / (1 - (R_m/R_M)^a)"""
    scale = alpha * radius_min**alpha / (1 - (radius_min / radius_max) ** alpha)
    return scale * (radius_max ** (k - alpha) - radius_min ** (k - alpha)) / (k - alpha)


# --- uniform by number ---------------------------------------------------------------------------


@ratios
@pytest.mark.parametrize("k", [0, 1, 2, 3, 6, -0.5])
def test_moments_of_the_uniform_grading_are_those_of_its_closed_form(ratio, k):
    radius_min = RADIUS_MAX / ratio
    expected = uniform_moment(radius_min, RADIUS_MAX, k)
    assert_allclose(uniform(radius_min, RADIUS_MAX).moment(k), expected, rtol=1e-13)


@ratios
def test_mass_of_the_uniform_grading_grows_with_the_fourth_power_of_radius(ratio):
    radius_min = RADIUS_MAX / ratio
    radius = np.linspace(radius_min, RADIUS_MAX, 23)
    expected = 100 * (radius**4 - radius_min**4) / (RADIUS_MAX**4 - radius_min**4)
    finer = 100 * uniform(radius_min, RADIUS_MAX).mass_cdf(radius)
    assert_allclose(finer, expected, rtol=0, atol=1e-10)


def test_half_of_the_uniform_grains_are_smaller_than_the_middle_radius():
    assert uniform(1.0, 3.0).number_cdf(2.0) == pytest.approx(0.5, rel=1e-15)
    density = uniform(1.0, 3.0).number_pdf([0.9, 1.5, 3.1])
    assert_allclose(density, [0.0, 0.5, 0.0], rtol=1e-14)


# --- fractal -------------------------------------------------------------------------------------


@alphas
@ratios
def test_fractal_grading_is_normalised_and_has_the_moments_of_its_closed_form(ratio, alpha):
    radius_min = RADIUS_MAX / ratio
    grading = fractal(radius_min, RADIUS_MAX, alpha)
    assert_allclose(grading.moment(0), 1.0, rtol=1e-13)
    for k in (1, 2, 3):
        expected = fractal_moment(radius_min, RADIUS_MAX, alpha, k)
        assert_allclose(grading.moment(k), expected, rtol=1e-13)


@alphas
@ratios
def test_sieve_curve_of_the_fractal_grading_is_the_power_law_of_its_dimension(ratio, alpha):
    radius_min = RADIUS_MAX / ratio
    radius = np.geomspace(radius_min, RADIUS_MAX, 23)
    power, low, high = (r ** (3 - alpha) for r in (radius, radius_min, RADIUS_MAX))
    finer = 100 * fractal(radius_min, RADIUS_MAX, alpha).mass_cdf(radius)
    assert_allclose(finer, 100 * (power - low) / (high - low), rtol=0, atol=1e-10)


@alphas
def test_fractal_density_falls_with_the_power_of_one_plus_alpha(alpha):
    low, high = fractal(1.0, 200.0, alpha).number_pdf([2.0, 20.0])
    assert_allclose(low / high, 10 ** (1 + alpha), rtol=1e-12)


def test_fractal_grading_ends_at_the_radii_given():
    grading = fractal(5e-6, 1e-3, 2.6)
    assert_allclose(grading.support(), (5e-6, 1e-3), rtol=1e-15)
    assert grading.number_cdf(1e-3) == 1.0
    assert grading.number_pdf(4.9e-6) == 0.0


# --- any grading ---------------------------------------------------------------------------------


@settings(deadline=None, max_examples=40)
@given(gradings())
def test_sieve_curve_grows_from_0_to_100_percent(grading):
    start, end = grading.support()
    radius = np.geomspace(start, end, 30)
    radius[[0, -1]] = start, end
    finer = 100 * grading.mass_cdf(radius)
    assert finer[0] == 0.0
    assert finer[-1] == pytest.approx(100.0, rel=1e-15)
    assert np.all(np.diff(finer) > 0)


@settings(deadline=None, max_examples=40)
@given(gradings())
def test_fewer_percent_of_the_mass_than_of_the_number_is_finer(grading):
    radius = grading.number_ppf([0.1, 0.5, 0.9])
    assert np.all(grading.mass_cdf(radius) < grading.number_cdf(radius))


@settings(deadline=None, max_examples=40)
@given(gradings())
def test_moments_are_ordered_as_those_of_any_distribution_are(grading):
    # Lyapunov: <R^k>^(1/k) grows with k; equal only if all grains are alike.
    start, end = grading.support()
    means = [start, *(grading.moment(k) ** (1 / k) for k in (1, 2, 3, 6)), end]
    assert np.all(np.diff(means) > 0)


@settings(deadline=None, max_examples=20)
@given(gradings(), st.floats(0.05, 0.95))
def test_quadrature_over_two_parts_of_the_support_adds_up(grading, share):
    cut = float(grading.number_ppf(share))
    _, below = grading.quadrature(upper=cut)
    _, above = grading.quadrature(lower=cut)
    assert_allclose([below.sum(), above.sum()], [share, 1 - share], rtol=1e-9)


def test_all_mass_is_finer_than_a_radius_beyond_the_largest_and_none_below_the_smallest():
    assert uniform(1.0, 2.0).mass_cdf([0.5, 5.0]).tolist() == [0.0, 1.0]


@settings(deadline=None, max_examples=20)
@given(st.floats(1.2, 1000), st.none() | st.floats(0.3, 5.5), st.floats(1e-3, 1e3))
def test_unit_of_length_does_not_change_the_sieve_curve(ratio, alpha, unit):
    here, there = (
        uniform(u, ratio * u) if alpha is None else fractal(u, ratio * u, alpha)
        for u in (1.0, unit)
    )
    radius = np.geomspace(1.0, ratio, 9)
    finer = 100 * there.mass_cdf(radius * unit)
    assert_allclose(finer, 100 * here.mass_cdf(radius), rtol=0, atol=1e-9)


# --- drawn radii ---------------------------------------------------------------------------------


@pytest.mark.parametrize("grading", [uniform(5e-6, 1e-3), fractal(5e-6, 1e-3, 2.6)])
def test_drawn_radii_follow_the_cumulative_distribution(grading):
    radii = grading.rvs(size=20_000, random_state=np.random.default_rng(5))
    # 20 000 radii show a difference of 0.01 between the two distributions.
    assert stats.kstest(radii, grading.number_cdf).pvalue > 0.05
    start, end = grading.support()
    assert start <= radii.min() < radii.max() <= end


def test_radii_of_a_seed_are_always_the_same():
    first, second, other = (
        uniform(1.0, 2.0).rvs(size=5, random_state=np.random.default_rng(seed))
        for seed in (3, 3, 4)
    )
    assert_array_equal(first, second)
    assert np.all(first != other)


# --- realised curves -----------------------------------------------------------------------------


def test_realised_curves_of_three_known_grains():
    # Volumes as 1 : 8 : 27.
    by_mass, by_number = realised_percent_finer([3.0, 1.0, 2.0], [0.5, 1.0, 1.9, 2.0, 3.0, 9.0])
    assert_allclose(by_mass, np.array([0, 1, 1, 9, 36, 36]) / 0.36, rtol=1e-14)
    assert_allclose(by_number, np.array([0, 1, 1, 2, 3, 3]) / 0.03, rtol=1e-14)


def test_realised_curves_of_many_radii_approach_the_target():
    grading = uniform(5e-6, 1e-3)
    radii = grading.rvs(size=100_000, random_state=np.random.default_rng(2))
    radius = np.linspace(1e-4, 1e-3, 10)
    by_mass, by_number = realised_percent_finer(radii, radius)
    # Standard errors are below 0.2 percent.
    assert_allclose(by_mass, 100 * grading.mass_cdf(radius), atol=0.6)
    assert_allclose(by_number, 100 * grading.number_cdf(radius), atol=0.6)


def test_diameter_of_a_percentage_is_read_off_the_curve():
    # D^(1/2) runs from 1 to 3 by mass: half of it is at 2.
    assert particle_diameter(fuller(0.5, 4.5, 0.5), 50.0) == pytest.approx(4.0, rel=1e-13)
    assert particle_diameter(from_radii([1.0, 2.0]), 11.0) == 2.0
    assert particle_diameter(from_radii([1.0, 2.0]), 11.2) == 4.0


def test_median_diameter_by_mass_of_the_uniform_grading():
    # (D/D_M)^4 = 1/2
    result = particle_diameter(uniform(0.5e-6, 0.5), 50.0)
    assert result == pytest.approx(0.5**0.25, rel=1e-12)


def test_summary_of_fullers_curve_follows_from_its_formula():
    # D_x = (D_m^q + x (D_M^q - D_m^q))^(1/q)
    low, high, q = 2e-4, 2e-2, 0.45
    d10, d30, d50, d60 = (
        (low**q + x * (high**q - low**q)) ** (1 / q) for x in (0.1, 0.3, 0.5, 0.6)
    )
    result = grading_summary(fuller(low / 2, high / 2, q))
    assert_allclose([result["D_min_m"], result["D_max_m"]], [low, high], rtol=1e-15)
    diameters = [result[f"D{x}_m"] for x in (10, 30, 50, 60)]
    assert_allclose(diameters, [d10, d30, d50, d60], rtol=1e-12)
    assert result["uniformity_coefficient"] == pytest.approx(d60 / d10, rel=1e-12)
    assert result["curvature_coefficient"] == pytest.approx(d30**2 / d10 / d60, rel=1e-12)


def test_summary_of_one_size():
    result = grading_summary(single(2e-3))
    assert {result[key] for key in result if key.startswith("D")} == {4e-3}
    assert (result["uniformity_coefficient"], result["curvature_coefficient"]) == (1.0, 1.0)
    assert result["mean_radius_3_m3"] == pytest.approx(8e-9, rel=1e-15)


def test_grading_table_holds_target_and_realised_curves():
    grading = uniform(1.0, 3.0)
    table = grading_table(grading, [[1.0, 3.0], [2.0, 3.0]], points=3)
    diameter = 2 * np.array([1.0, 3**0.5, 3.0])
    assert_allclose(table["diameter_m"], diameter, rtol=1e-14)
    # Of the diameter, so that it integrates to 1 over diameters.
    assert_allclose(table["density_target_per_m"], [0.25, 0.25, 0.25], rtol=1e-14)
    by_number = [0, 50 * (3**0.5 - 1), 100]
    assert_allclose(table["percent_finer_by_number_target"], by_number, atol=1e-12)
    assert_allclose(table["percent_finer_by_mass_target"], [0, 10, 100], atol=1e-10)
    # Of the volume of the first seed 1/28 is in its small grain; the second has none so small.
    assert_allclose(table["percent_finer_by_number_realised"], [25, 25, 100], rtol=1e-14)
    assert_allclose(table["percent_finer_by_mass_realised"], [50 / 28, 50 / 28, 100], rtol=1e-14)
    assert_allclose(table["percent_finer_by_mass_realised_min"], [0, 0, 100], atol=1e-14)
    highest = [100 / 28, 100 / 28, 100]
    assert_allclose(table["percent_finer_by_mass_realised_max"], highest, rtol=1e-14)


@pytest.mark.parametrize(
    "grading", [uniform(5e-6, 1e-3), fractal(5e-6, 1e-3, 2.6), uniform(0.1, 0.3)]
)
def test_every_grain_of_a_seed_is_in_the_last_row_of_the_grading_table(grading):
    radii = np.sort(grading.rvs(size=50, random_state=np.random.default_rng(1)))
    radii[-1] = grading.support()[1]
    table = grading_table(grading, [radii])
    assert table["percent_finer_by_number_realised"][-1] == 100.0
    assert table["percent_finer_by_number_target"][-1] == 100.0


def test_grading_table_covers_the_ultimate_grading_as_well():
    ultimate = fractal(0.5, 2.0, 2.5)
    table = grading_table(uniform(1.0, 3.0), [[2.0]], ultimate, points=5)
    assert_allclose(table["diameter_m"][[0, -1]], [1.0, 6.0], rtol=1e-15)
    radius = table["diameter_m"] / 2
    for by, cdf in (("mass", ultimate.mass_cdf), ("number", ultimate.number_cdf)):
        assert_array_equal(table[f"percent_finer_by_{by}_ultimate"], 100 * cdf(radius))
    without = grading_table(uniform(1.0, 3.0), [[2.0]])
    assert not any("ultimate" in column for column in without)


def test_grading_table_of_one_size_has_its_step_in_the_middle():
    table = grading_table(single(2.0), [[2.0, 2.0]])
    assert_allclose(table["diameter_m"][[0, -1]], [3.6, 4.4], rtol=1e-14)
    for name in ("mass_target", "mass_realised", "number_target", "number_realised"):
        finer = table[f"percent_finer_by_{name}"]
        assert_array_equal(finer, np.where(table["diameter_m"] >= 4.0, 100.0, 0.0))
    assert np.isnan(table["density_target_per_m"]).all()


def test_grading_table_of_a_mixture_with_a_single_size_has_no_density():
    grading = mixture([single(1.0), uniform(1.0, 3.0)], [1.0, 1.0], "mass")
    table = grading_table(grading, [[1.0, 2.0]])
    assert np.isnan(table["density_target_per_m"]).all()
    assert table["percent_finer_by_mass_target"][0] == 0.0
    assert table["percent_finer_by_mass_target"][-1] == 100.0
