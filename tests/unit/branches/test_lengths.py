"""Eqs. 2 to 4 against closed forms, quadrature, sampling, and radii that were really drawn."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy import stats
from scipy.interpolate import PchipInterpolator

from branchcrush.branches.lengths import (
    branch_density,
    branch_length_table,
    branch_statistics,
    length_histogram,
    number_of_grains,
    random_contact_moment,
    random_contact_shares,
)
from branchcrush.gradings.forms import fractal, lognormal, uniform
from branchcrush.gradings.mixtures import from_radii, mixture, single

RADIUS_MAX = 1e-3
GRADINGS = {
    "uniform, ratio 200": uniform(RADIUS_MAX / 200, RADIUS_MAX),
    "uniform, ratio 2": uniform(RADIUS_MAX / 2, RADIUS_MAX),
    "fractal 2.6, ratio 200": fractal(RADIUS_MAX / 200, RADIUS_MAX, 2.6),
    "fractal 2.5, ratio 1000": fractal(RADIUS_MAX / 1000, RADIUS_MAX, 2.5),
    "lognormal by mass": lognormal(RADIUS_MAX / 4, 1.7, RADIUS_MAX / 50, RADIUS_MAX, "mass"),
}
any_grading = pytest.mark.parametrize("grading", GRADINGS.values(), ids=GRADINGS)


def length_nodes(grading, points=16):
    """Return Gauss-Legendre nodes and weights over all branch lengths, and the panels' edges.

    The panels grow from 2 R_m and from the kink at R_m + R_M, where a fractal density is steep.
    """
    radius_min, radius_max = grading.support()
    span = radius_max - radius_min
    growing = np.append(0, np.geomspace(1e-5 * span, span, 30))
    low, kink = 2 * radius_min + growing, radius_min + radius_max + growing
    edges = np.append(low[:-1], kink)
    x, w = np.polynomial.legendre.leggauss(points)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (x + 1)).ravel(), (half * w).ravel(), edges


def moments_of_length(grading):
    """<l^0> to <l^3> by the moments of radius."""
    r1, r2, r3 = (grading.moment(k) for k in (1, 2, 3))
    return [1.0, 2 * r1, 2 * r2 + 2 * r1**2, 2 * r3 + 6 * r1 * r2]


def density_of_lengths(grading, length):
    """Return the convolution of Eq. 4 by tanh-sinh, another rule than the one under test."""
    start, end = grading.support()
    length = np.asarray(length)[:, None]
    low, high = np.maximum(start, length - end), np.minimum(end, length - start)
    t = np.linspace(-3.5, 3.5, 1201)
    angle = np.pi / 2 * np.sinh(t)
    half = (high - low) / 2
    radius = np.clip((low + high) / 2 + half * np.tanh(angle), low, high)
    weight = half * np.pi / 2 * np.cosh(t) / np.cosh(angle) ** 2 * (t[1] - t[0])
    other = np.clip(length - radius, start, end)
    return np.sum(weight * grading.number_pdf(radius) * grading.number_pdf(other), axis=1)


# --- Eq. 4 ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [200, 2])
def test_lengths_of_the_uniform_grading_have_a_triangular_density(ratio):
    radius_min = RADIUS_MAX / ratio
    low, mode, high = 2 * radius_min, radius_min + RADIUS_MAX, 2 * RADIUS_MAX
    edges = np.sort(np.append(np.linspace(low, high, 101), mode))
    width = mode - low
    rising = (edges - low) ** 2 / (2 * width**2)
    below = np.where(edges < mode, rising, 1 - (high - edges) ** 2 / (2 * width**2))
    shares = random_contact_shares(uniform(radius_min, RADIUS_MAX), edges)
    assert_allclose(shares, np.diff(below), rtol=1e-11, atol=1e-15)


@any_grading
def test_lengths_have_the_moments_of_the_sum_of_two_radii(grading):
    length, weight, _ = length_nodes(grading, points=9)
    low, high = (2 * radius for radius in grading.support())
    shares = random_contact_shares(grading, [low, *length, high])
    assert_allclose(shares.sum(), 1.0, rtol=1e-12)
    # Integrated by parts: <l^k> = l_m^k + int k l^(k-1) (1 - F(l)) dl.
    above = np.cumsum(shares[::-1])[::-1][1:]
    found = [low**k + weight @ (k * length ** (k - 1) * above) for k in range(4)]
    assert_allclose(found, moments_of_length(grading), rtol=1e-11)


@any_grading
def test_moments_of_length_are_those_of_the_sum_of_two_radii(grading):
    found = [random_contact_moment(grading, k) for k in range(4)]
    assert_allclose(found, moments_of_length(grading), rtol=1e-13)


@pytest.mark.parametrize("order", [-1.0, 2.4, 3.2])
@any_grading
def test_moment_of_any_order_is_that_of_the_density(grading, order):
    length, weight, _ = length_nodes(grading)
    expected = weight @ (density_of_lengths(grading, length) * length**order)
    assert_allclose(random_contact_moment(grading, order), expected, rtol=1e-9)


@any_grading
def test_no_length_is_outside_the_support(grading):
    low, high = (2 * radius for radius in grading.support())
    edges = [0.0, low / 2, low * (1 - 1e-9), low, high, high * (1 + 1e-9), 3 * high]
    shares = random_contact_shares(grading, edges)
    assert_array_equal(shares[[0, 1, 2, 4, 5]], 0.0)
    assert_allclose(shares[3], 1.0, rtol=1e-13)
    assert np.all(random_contact_shares(grading, np.linspace(low, high, 52)) > 0)


@settings(deadline=None, max_examples=30)
@given(st.floats(1.1, 500), st.none() | st.floats(0.5, 5.0), st.floats(0.001, 0.999))
def test_share_of_a_narrow_bin_is_the_convolution_of_the_radii(ratio, alpha, place):
    grading = uniform(1.0, ratio) if alpha is None else fractal(1.0, ratio, alpha)
    length = 2.0 + place * (2 * ratio - 2.0)
    edges = length + np.array([-2e-6, 2e-6]) * min(length - 2.0, 2 * ratio - length)
    kink = 1.0 + ratio
    expected = density_of_lengths(grading, [length])
    found = random_contact_shares(grading, edges) / np.diff(edges)
    # At the kink, the mean over the bin is not the value in its middle.
    near = abs(length - kink) < 1e-3 * length
    assert_allclose(found, expected, rtol=1e-2 if near else 1e-6)


@any_grading
def test_share_in_the_thin_tail_of_long_branches_keeps_its_digits(grading):
    high = 2 * grading.support()[1]
    edges = high * np.array([0.98, 1.0])
    nodes, weights = np.polynomial.legendre.leggauss(20)
    length = edges[0] + np.diff(edges) / 2 * (nodes + 1)
    expected = np.diff(edges) / 2 * (weights @ density_of_lengths(grading, length))
    assert_allclose(random_contact_shares(grading, edges), expected, rtol=1e-9)


@pytest.mark.parametrize("name", ["uniform, ratio 200", "fractal 2.6, ratio 200"])
def test_sums_of_two_drawn_radii_follow_the_shares(name):
    grading = GRADINGS[name]
    radii = grading.rvs(size=(2, 20_000), random_state=np.random.default_rng(11))
    _, _, edges = length_nodes(grading)
    shares = random_contact_shares(grading, edges)
    cumulative = PchipInterpolator(edges, np.append(0.0, shares.cumsum()))
    # 20 000 sums show a difference of 0.01 between the two distributions.
    assert stats.kstest(radii.sum(axis=0), cumulative).pvalue > 0.05


# --- Eq. 4 of single sizes -----------------------------------------------------------------------


def test_all_branches_of_one_size_are_as_long():
    edges = [1.8, 1.9, 2.0, 2.1, 2.2]
    assert random_contact_shares(single(1.0), edges).tolist() == [0, 0, 1, 0]
    # On the last edge as well, as in the histogram of the measured ones.
    assert random_contact_shares(single(1.0), [1.8, 1.9, 2.0]).tolist() == [0, 1]
    assert random_contact_moment(single(1.0), 2.5) == pytest.approx(2.0**2.5, rel=1e-15)


def test_two_sizes_have_three_lengths():
    grading = mixture([single(1.0), single(3.0)], [3.0, 1.0], "number")
    shares = random_contact_shares(grading, [2.0, 3.0, 4.0, 5.0, 6.0])
    assert_allclose(shares, [9 / 16, 0, 6 / 16, 1 / 16], rtol=1e-15)
    expected = (9 * 2**2.5 + 6 * 4**2.5 + 6**2.5) / 16
    assert_allclose(random_contact_moment(grading, 2.5), expected, rtol=1e-14)


@settings(deadline=None, max_examples=60)
@given(st.lists(st.floats(0.1, 1.0), min_size=1, max_size=12), st.integers(1, 30))
def test_lengths_on_an_edge_are_binned_as_the_measured_ones(radii, bins):
    # Edges at some of the sums, so that rounding alone could tell the sides apart.
    sums = np.add.outer(radii, radii).ravel()
    edges = np.unique(np.append(np.linspace(sums.min(), sums.max() + 0.1, bins + 1), sums[:5]))
    expected = np.histogram(sums, edges)[0] / sums.size
    assert_allclose(random_contact_shares(from_radii(radii), edges), expected, atol=1e-14)


def test_size_in_a_continuous_grading_meets_both_its_own_and_the_others():
    grading = mixture([single(2.0), uniform(1.0, 3.0)], [1.0, 3.0], "number")
    # 1/16 both single, 6/16 one of each: uniform from 3 to 5; 9/16 a triangle from 2 to 6.
    edges = np.array([2.0, 3.0, 3.5, 4.0, 4.5, 6.0])
    mixed = np.clip((edges - 3.0) / 2.0, 0, 1)
    triangle = np.where(edges <= 4, (edges - 2) ** 2 / 8, 1 - (6 - edges) ** 2 / 8)
    expected = (6 * np.diff(mixed) + 9 * np.diff(triangle)) / 16
    expected[3] += 1 / 16
    assert_allclose(random_contact_shares(grading, edges), expected, rtol=1e-12)


def test_moment_of_many_given_radii_is_the_double_sum():
    radii = np.random.default_rng(2).uniform(1.0, 50.0, 1200)
    found = random_contact_moment(from_radii(radii), 2.7)
    assert_allclose(found, np.mean(np.add.outer(radii, radii) ** 2.7), rtol=1e-11)


def test_table_of_one_size_has_finite_densities():
    table = branch_length_table([[2.0, 2.0]], single(1.0), np.linspace(1.8, 2.2, 21))
    measured = table["density_measured_per_m"]
    assert_allclose(table["density_random_contact_per_m"], measured, rtol=1e-9)


# --- Eqs. 2 and 3 --------------------------------------------------------------------------------


def test_unit_spheres_in_a_cube_of_edge_2_are_one():
    assert_allclose(number_of_grains(8.0, 6 / np.pi - 1, 1.0), 1.0, rtol=1e-14)


def test_half_of_all_contact_ends_are_branches():
    volume, void_ratio, cube, kappa = 3.0, 0.7, 1e-9, 5.2
    grains = number_of_grains(volume, void_ratio, cube)
    expected = grains * kappa / 2 / volume
    assert_allclose(branch_density(kappa, void_ratio, cube), expected, rtol=1e-14)


def drawn_sample(grading, seeds, branches=300):
    rng = np.random.default_rng(4)
    radii = [grading.rvs(size=200 + 50 * seed, random_state=rng) for seed in range(seeds)]
    lengths = [rng.choice(radius, (2, branches)).sum(axis=0) for radius in radii]
    volumes = [4 / 3 * np.pi * np.sum(radius**3) * 1.6 for radius in radii]
    return radii, lengths, volumes, [2 * branches / radius.size for radius in radii]


@any_grading
def test_number_and_density_are_identities_for_the_radii_that_were_drawn(grading):
    found = branch_statistics(*drawn_sample(grading, 3), grading)
    assert found["grains"] == (200 + 250 + 300) / 3
    assert found["branches"] == 300
    assert_allclose(found["grains_eq2"], found["grains"], rtol=1e-12)
    density = found["branch_density_per_m3"]
    assert_allclose(found["branch_density_eq3_per_m3"], density, rtol=1e-12)
    assert_allclose(found["void_ratio"], 0.6, rtol=1e-12)


def test_statistics_of_the_target_follow_from_its_moments():
    grading = uniform(1.0, 3.0)
    radii, lengths = [[1.5, 2.0, 2.5, 2.0]], [[3.5, 4.0]]
    cubes = 1.5**3 + 2 * 2.0**3 + 2.5**3
    volume = 4 / 3 * np.pi * cubes * 1.5
    found = branch_statistics(radii, lengths, [volume], [1.0], grading)
    # <R^3> of the target is 10.
    assert_allclose(found["grains_eq2_target"], cubes / 10, rtol=1e-12)
    target_density = cubes / 10 / 2 / volume
    assert_allclose(found["branch_density_eq3_target_per_m3"], target_density, rtol=1e-12)
    radius_means = [found[f"mean_radius_{k}_m{k}"] for k in (1, 2, 3)]
    assert_allclose(radius_means, [2.0, (1.5**2 + 8 + 2.5**2) / 4, cubes / 4], rtol=1e-14)
    length_means = [found[f"mean_length_{k}_m{k}"] for k in (1, 2, 3)]
    assert_allclose(length_means, [3.75, (3.5**2 + 16) / 2, (3.5**3 + 64) / 2], rtol=1e-14)
    assert_allclose([found[f"target_radius_{k}_m{k}"] for k in (1, 2, 3)], [2, 13 / 3, 10])
    expected = moments_of_length(grading)[1:]
    assert_allclose([found[f"eq4_length_{k}_m{k}"] for k in (1, 2, 3)], expected, rtol=1e-12)


def test_statistics_are_means_over_seeds():
    grading = uniform(1.0, 3.0)
    sample = drawn_sample(grading, 3)
    alone = [branch_statistics(*([part[seed]] for part in sample), grading) for seed in range(3)]
    together = branch_statistics(*sample, grading)
    assert together.keys() == alone[0].keys()
    for key, value in together.items():
        assert_allclose(value, np.mean([seed[key] for seed in alone]), rtol=1e-13)


# --- measured lengths ----------------------------------------------------------------------------


def test_every_length_is_counted_once_and_those_on_the_last_edge_too():
    counts, density = length_histogram([1.0, 2.0, 2.5, 4.0, 4.0], [1.0, 2.0, 4.0])
    assert counts.tolist() == [1, 4]
    assert_allclose(density, [0.2, 0.4], rtol=1e-15)


def test_density_of_no_branches_is_zero():
    counts, density = length_histogram([], [1.0, 2.0, 4.0])
    assert counts.tolist() == [0, 0]
    assert density.tolist() == [0.0, 0.0]


@settings(deadline=None, max_examples=30)
@given(st.lists(st.floats(1.0, 4.0), min_size=1, max_size=50), st.integers(1, 30))
def test_measured_density_integrates_to_1(lengths, bins):
    edges = np.linspace(1.0, 4.0, bins + 1)
    counts, density = length_histogram(lengths, edges)
    assert counts.sum() == len(lengths)
    assert_allclose(density @ np.diff(edges), 1.0, rtol=1e-12)


def test_table_pools_the_branches_of_all_seeds_and_takes_errors_between_them():
    edges = [2.0, 3.0, 4.0]
    table = branch_length_table([[2.5, 3.5], [2.5, 2.5, 2.5, 3.5]], uniform(1.0, 2.0), edges)
    assert_array_equal(table["length_low_m"], [2.0, 3.0])
    assert_array_equal(table["length_high_m"], [3.0, 4.0])
    assert table["branches"].tolist() == [4, 2]
    assert_allclose(table["density_measured_per_m"], [4 / 6, 2 / 6], rtol=1e-14)
    # Densities of the seeds in the first bin are 1/2 and 3/4: s = 1/4/sqrt(2), over sqrt(2) seeds.
    error = table["density_measured_standard_error_per_m"]
    assert_allclose(error, [1 / 8, 1 / 8], rtol=1e-13)
    assert_allclose(table["density_random_contact_per_m"], [0.5, 0.5], rtol=1e-12)


def test_one_seed_tells_no_standard_error():
    table = branch_length_table([[2.5, 3.5]], uniform(1.0, 2.0), [2.0, 3.0, 4.0])
    assert np.isnan(table["density_measured_standard_error_per_m"]).all()


@pytest.mark.parametrize("bins", [1, 7, 20])
@any_grading
def test_predicted_density_of_the_bins_integrates_to_1(grading, bins):
    edges = np.linspace(*(2 * radius for radius in grading.support()), bins + 1)
    table = branch_length_table([[1.5 * RADIUS_MAX]], grading, edges)
    assert_allclose(table["density_random_contact_per_m"] @ np.diff(edges), 1.0, rtol=1e-9)


@any_grading
def test_predicted_density_of_a_bin_is_the_mean_of_the_density_over_it(grading):
    nodes, weight, panels = length_nodes(grading)
    edges = panels[::10]
    table = branch_length_table([[1.5 * RADIUS_MAX]], grading, edges)
    parts = (weight * density_of_lengths(grading, nodes)).reshape(len(edges) - 1, -1)
    shares = parts.sum(axis=1)
    found = table["density_random_contact_per_m"] * np.diff(edges)
    assert_allclose(found, shares, rtol=1e-9, atol=1e-12)
