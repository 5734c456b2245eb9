"""Eqs. 2 and 3 for radii that were really drawn, and the distribution of lengths counted."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.branches.lengths import (
    branch_density,
    branch_length_table,
    branch_statistics,
    length_histogram,
    number_of_grains,
)
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import single
from tests.unit.branches.length_densities import (
    RADIUS_MAX,
    any_grading,
    density_of_lengths,
    length_nodes,
    moments_of_length,
)

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


def test_table_of_one_size_has_finite_densities():
    table = branch_length_table([[2.0, 2.0]], single(1.0), np.linspace(1.8, 2.2, 21))
    measured = table["density_measured_per_m"]
    assert_allclose(table["density_random_contact_per_m"], measured, rtol=1e-9)


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
