"""Measures of a state, from numbers small enough to be worked out by hand."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.loading.measures import (
    cell_measures,
    coordination_measures,
    energy_measures,
    overlap_measures,
    rest_measures,
    stress_measures,
)
from branchcrush.packings.contact_laws import HertzContact, LinearContact


def columns(**values):
    return {name: np.array(column, dtype=float) for name, column in values.items()}


def walls_of(grains, **values):
    return {"i": np.array(grains, dtype=int), **columns(**values)}


NO_WALLS = walls_of([], overlap_m=[], normal_force_N=[])
NO_CONTACTS = columns(branch_length_m=[], normal_force_N=[], energy_J=[])


# --- cell ----------------------------------------------------------------------------------------


def test_half_the_edge_is_an_eighth_of_the_volume():
    cell = cell_measures(1.0, 2.0, 0.625)
    assert cell["volume_m3"] == 1.0
    assert (cell["linear_strain"], cell["volumetric_strain"]) == (0.5, 0.875)
    assert (cell["solid_fraction"], cell["void_ratio"]) == (0.625, pytest.approx(0.6, rel=1e-14))


def test_strains_of_a_grown_cell_are_negative():
    cell = cell_measures(3.0, 2.0, 1.0)
    assert (cell["linear_strain"], cell["volumetric_strain"]) == (-0.5, 1 - 27 / 8)


# --- stress --------------------------------------------------------------------------------------


def test_stress_between_walls_is_that_of_branches_and_of_the_way_to_the_wall():
    contacts = columns(branch_length_m=[2.0, 1.0], normal_force_N=[3.0, 5.0])
    walls = walls_of([1], overlap_m=[0.25], normal_force_N=[4.0])
    # 2 x 3 + 1 x 5 + (3 - 1/4) x 4 = 22 J in a cell of 8 m3.
    stress = stress_measures(contacts, walls, np.array([1.0, 3.0]), 2.0, None)
    assert_allclose(stress["mean_stress_Pa"], 22 / 24, rtol=1e-15)


def test_boundary_stress_is_the_force_on_all_walls_over_six_faces():
    walls = walls_of([0, 0, 0], overlap_m=[0.0] * 3, normal_force_N=[3.0, 4.0, 5.0])
    stress = stress_measures(NO_CONTACTS, walls, np.array([1.0]), 2.0, None)
    assert stress["boundary_stress_Pa"] == 12 / 24


def test_boundary_stress_of_a_periodic_cell_is_the_pressure_of_the_pairs():
    stress = stress_measures(NO_CONTACTS, NO_WALLS, np.array([1.0]), 2.0, 7.0)
    assert stress == {"mean_stress_Pa": 0.0, "boundary_stress_Pa": 7.0}


# --- energy --------------------------------------------------------------------------------------


def test_a_wall_stores_the_energy_of_the_grains_own_radius():
    # K sqrt(R) overlap^1.5 = 2 x 2 x 1 = 4 N, and 2/5 of force times overlap: 1.6 J.
    walls = walls_of([1], normal_force_N=[4.0])
    energy = energy_measures(
        columns(energy_J=[1.0, 2.0]), walls, np.array([9.0, 4.0]), HertzContact(2.0), 10.0
    )
    assert_allclose(energy["elastic_energy_J"], 1 + 2 + 1.6, rtol=1e-14)
    assert energy["work_J"] == 10.0
    assert_allclose(energy["dissipated_J"], 5.4, rtol=1e-14)


def test_without_contacts_all_work_is_dissipated():
    energy = energy_measures(NO_CONTACTS, NO_WALLS, np.array([1.0]), LinearContact(1.0), 3.0)
    assert energy == {"elastic_energy_J": 0.0, "work_J": 3.0, "dissipated_J": 3.0}


# --- coordination --------------------------------------------------------------------------------

TETRAHEDRON = {"i": np.array([0, 0, 0, 1, 1, 2]), "j": np.array([1, 2, 3, 2, 3, 3])}


def test_walls_hold_grains_but_are_no_branches():
    # Four grains that all touch, and each one of the walls; a fifth touches nothing.
    numbers = coordination_measures(TETRAHEDRON, walls_of([0, 1, 2, 3]), 5)
    assert numbers == {
        "coordination_number": 12 / 5,
        "mechanical_coordination_number": (12 + 4) / 4,
        "rattler_fraction": 1 / 5,
    }


def test_with_three_contacts_each_all_grains_rattle():
    numbers = coordination_measures(TETRAHEDRON, NO_WALLS, 4)
    assert list(numbers.values()) == [3.0, 0.0, 1.0]


# --- rest ----------------------------------------------------------------------------------------

AT_REST = {"force_floor": 1.0, "kinetic_energy": 2.0, "solid_volume": 4.0, "stress": 0.25}


def test_inertial_number_is_the_speed_times_the_root_of_density_over_stress():
    # Grains of 12 kg in 4 m3, at 1 m/s, have 6 J; I = 1 m/s sqrt(3 kg/m3 / (3/4 Pa)) = 2.
    known = {**AT_REST, "kinetic_energy": 0.5 * 12.0 * 1.0**2, "stress": 0.75}
    assert rest_measures(np.array([5.0]), np.zeros((1, 3)), **known)["inertial_number"] == 2.0


@pytest.mark.parametrize(
    ("force", "loaded"), [([], False), ([0.5, 1.5], False), ([1.0, 1.5], True)]
)
def test_load_begins_above_the_floor_of_the_mean_force(force, loaded):
    measures = rest_measures(np.array(force), np.zeros((2, 3)), **AT_REST)
    assert measures["carries_load"] is loaded
    assert measures["mean_normal_force_N"] == (np.mean(force) if force else 0.0)
    assert np.isnan(measures["inertial_number"]) == (not loaded)


def test_net_forces_are_over_the_mean_force_or_the_floor():
    net_force = np.array([[3.0, 4.0, 0.0], [0.0, 0.0, 1.0]])
    measured = [
        rest_measures(np.array(force), net_force, **AT_REST)["unbalanced_force_ratio"]
        for force in ([2.0, 4.0], [0.1], [])
    ]
    assert_allclose(measured, [1.0, 3.0, 3.0], rtol=1e-15)


# --- overlaps ------------------------------------------------------------------------------------


def test_overlaps_are_over_the_smaller_radius():
    contacts = columns(overlap_m=[0.1, 0.1], radius_i_m=[1.0, 4.0], radius_j_m=[5.0, 0.5])
    overlaps = overlap_measures(contacts)
    assert_allclose(overlaps["max_overlap_ratio"], 0.2, rtol=1e-15)
    assert_allclose(overlaps["median_overlap_ratio"], 0.15, rtol=1e-15)


def test_of_101_overlaps_95_are_smaller_than_the_quantile():
    ratio = np.random.default_rng(1).permutation(101) / 1000
    overlaps = overlap_measures({"overlap_m": ratio, **columns(radius_i_m=[1.0], radius_j_m=[2.0])})
    assert_allclose(list(overlaps.values()), [0.050, 0.095, 0.100], rtol=1e-12)
    assert list(overlaps) == ["median_overlap_ratio", "overlap_ratio_95", "max_overlap_ratio"]


def test_without_contacts_there_is_no_overlap():
    none = columns(overlap_m=[], radius_i_m=[], radius_j_m=[])
    assert_array_equal(list(overlap_measures(none).values()), 0.0)
