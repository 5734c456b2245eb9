"""Bins of branch length: where they lie, and that nothing is lost in them."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.statistics.bins import bin_edges, bin_numbers, binned_sums


def test_bins_of_the_paper_are_20_equal_ones_from_twice_the_smallest_radius():
    edges = bin_edges(5e-6, 1e-3)
    assert edges.size == 21
    assert (edges[0], edges[-1]) == (1e-5, 2e-3)
    assert_allclose(np.diff(edges), 1.99e-3 / 20, rtol=1e-12)


def test_bins_of_a_single_size_lie_a_tenth_about_its_branches():
    assert_allclose(bin_edges(1.0, 1.0, 4), [1.8, 1.9, 2.0, 2.1, 2.2], rtol=1e-14)


def test_a_value_on_an_edge_belongs_to_the_bin_above_but_for_the_last():
    assert bin_numbers([1.0, 1.5, 2.0, 2.5, 4.0], [1.0, 2.0, 4.0]).tolist() == [0, 0, 1, 1, 1]
    assert bin_numbers([-np.inf, np.inf], [1.0, 2.0, 4.0]).tolist() == [0, 1]


def test_lengths_beyond_the_ends_belong_to_the_end_bins():
    counts, total, energy = binned_sums(
        [0.9, 1.0, 2.0, 3.0, 3.1], [1.0, 2.0, 4.0, 8.0, 16.0], [1.0, 2.0, 3.0]
    )
    assert counts.tolist() == [2.0, 3.0]
    assert_allclose(total, [1.9, 8.1], rtol=1e-15)
    assert energy.tolist() == [3.0, 28.0]


def test_no_branches_leave_every_bin_empty():
    assert_array_equal(binned_sums([], [], [1.0, 2.0, 3.0]), np.zeros((3, 2)))


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32), st.integers(1, 200), st.integers(1, 40))
def test_bins_lose_no_branch_and_no_energy(seed, branches, bins):
    rng = np.random.default_rng(seed)
    length, energy = rng.uniform(0.01, 2.0, branches), rng.standard_exponential(branches)
    edges = bin_edges(0.005, 1.0, bins)
    sums = binned_sums(length, energy, edges)
    assert sums.shape == (3, bins)
    assert_allclose(sums.sum(axis=1), [branches, length.sum(), energy.sum()], rtol=1e-12)
    counts, total, _ = sums
    filled = counts > 0
    mean = total[filled] / counts[filled]
    assert np.all((edges[:-1][filled] <= mean) & (mean <= edges[1:][filled] * (1 + 1e-15)))
