"""The row of a state, of two grains in a column between walls."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.loading.path import path_row
from branchcrush.loading.states import state_contacts, wall_contacts
from branchcrush.packings.contact_laws import LinearContact

# Two grains of radius 1 in a column along x: three contacts of overlap 0.1 and force 1 each.
LAW, EDGE = LinearContact(10.0), 3.7
PARTICLES = {
    "x": np.array([-0.95, 0.95]),
    **{name: np.zeros(2) for name in ("y", "z", "v_wall_fy", "v_wall_fz", "fx")},
    "v_wall_fx": np.array([1.0, -1.0]),
    "fy": np.array([3e-3, 0.0]),
    "fz": np.array([4e-3, -1e-3]),
    "radius": np.ones(2),
}
PAIRS = {
    name: np.array([value])
    for name, value in {
        "id1": 1.0,
        "id2": 2.0,
        "branch": 1.9,
        "branch_x": -1.9,
        "branch_y": 0.0,
        "branch_z": 0.0,
        "force": 1.0,
    }.items()
}
SCALARS = {
    "state": 4,
    "edge": EDGE,
    "work": 0.4,
    "pair_pressure": 0.7,
    "kinetic_energy": 2e-6,
    "escaped": 1,
    "lost": 2,
    "evaluations": 345,
}


def row_of(periodic=False, **changed):
    contacts = state_contacts(PAIRS, PARTICLES["radius"], LAW)
    walls = wall_contacts(PARTICLES, EDGE)
    return path_row(
        {**SCALARS, **changed},
        PARTICLES,
        contacts,
        walls,
        first_edge=4.0,
        law=LAW,
        periodic=periodic,
    )


def test_row_of_a_column_between_walls_is_that_worked_out_by_hand():
    solid, area = 8 * np.pi / 3, EDGE**2
    stress = 1 / (3 * area)
    expected = {
        "state": 4,
        "linear_strain": 0.3 / 4,
        "volumetric_strain": 1 - (3.7 / 4) ** 3,
        "solid_fraction": solid / EDGE**3,
        "void_ratio": EDGE**3 / solid - 1,
        "volume_m3": EDGE**3,
        # F times the length of the column over 3V; two walls of six are pressed.
        "mean_stress_Pa": stress,
        "boundary_stress_Pa": 2 / (6 * area),
        "elastic_energy_J": 3 * 0.05,
        "work_J": 0.4,
        "dissipated_J": 0.25,
        "coordination_number": 1.0,
        "mechanical_coordination_number": 0.0,
        "rattler_fraction": 1.0,
        "mean_normal_force_N": 1.0,
        "carries_load": True,
        "unbalanced_force_ratio": (5e-3 + 1e-3) / 2,
        "inertial_number": (2 * 2e-6 / (solid * stress)) ** 0.5,
        "median_overlap_ratio": 0.1,
        "overlap_ratio_95": 0.1,
        "max_overlap_ratio": 0.1,
        "contact_law_error": 0.0,
        "escaped": 1,
        "lost": 2,
        "force_evaluations": 345,
    }
    row = row_of()
    # The order is that of the columns of path.csv.
    assert list(row) == list(expected)
    assert_allclose(list(row.values()), list(expected.values()), rtol=1e-13, atol=1e-14)


def test_boundary_of_a_periodic_cell_is_what_lammps_sums():
    assert row_of(periodic=True)["boundary_stress_Pa"] == 0.7
    assert row_of(periodic=False)["boundary_stress_Pa"] == pytest.approx(1 / (3 * EDGE**2))


def test_strain_is_counted_from_the_edge_before_loading():
    assert row_of(edge=2.0)["linear_strain"] == 0.5
    assert row_of(edge=4.0)["volumetric_strain"] == 0.0
