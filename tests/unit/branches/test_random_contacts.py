"""Eq. 4 against closed forms, quadrature and sampling."""

from math import comb

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy import stats
from scipy.interpolate import PchipInterpolator

from branchcrush.branches.random_contacts import random_contact_moment, random_contact_shares
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import from_radii, mixture, single
from tests.unit.branches.length_densities import (
    GRADINGS,
    RADIUS_MAX,
    any_grading,
    density_of_lengths,
    length_nodes,
    moments_of_length,
)

# --- gradings with a density ---------------------------------------------------------------------


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


@pytest.mark.parametrize("order", [0.5, 2.0, 3.131])
@pytest.mark.parametrize("ratio", [2, 200, 1000])
def test_moment_of_any_order_of_the_uniform_grading_in_closed_form(ratio, order):
    low, high = RADIUS_MAX / ratio, RADIUS_MAX
    ends = (2 * high) ** (order + 2) - 2 * (low + high) ** (order + 2) + (2 * low) ** (order + 2)
    expected = ends / ((order + 1) * (order + 2) * (high - low) ** 2)
    assert_allclose(random_contact_moment(uniform(low, high), order), expected, rtol=1e-10)


@pytest.mark.parametrize("ratio", [2, 200, 1000])
def test_moment_of_pairs_of_two_gradings(ratio):
    low, alpha = RADIUS_MAX / ratio, 2.6
    flat, finer = uniform(low, RADIUS_MAX), fractal(low, RADIUS_MAX, alpha)

    def of_flat(k):
        return (RADIUS_MAX ** (k + 1) - low ** (k + 1)) / ((k + 1) * (RADIUS_MAX - low))

    def of_finer(k):
        powers = (k - alpha, -alpha)
        above, below = ((RADIUS_MAX**power - low**power) / power for power in powers)
        return above / below

    expected = sum(comb(3, k) * of_flat(k) * of_finer(3 - k) for k in range(4))
    assert_allclose(random_contact_moment(flat, 3.0, finer), expected, rtol=1e-10)
    assert_allclose(random_contact_moment(finer, 3.0, flat), expected, rtol=1e-10)


def test_moment_of_pairs_against_monte_carlo():
    low = RADIUS_MAX / 1000
    flat, finer = uniform(low, RADIUS_MAX), fractal(low, RADIUS_MAX, 2.6)
    rng = np.random.default_rng(5)
    sums = (flat.rvs(200_000, rng) + finer.rvs(200_000, rng)) ** 2.5
    error = sums.std() / np.sqrt(sums.size)
    assert abs(random_contact_moment(flat, 2.5, finer) - sums.mean()) < 4 * error


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


# --- single sizes --------------------------------------------------------------------------------


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
