"""What a saved state tells, from frames of a dump made up for the purpose."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.errors import SimulationError
from branchcrush.loading.states import (
    force_floor,
    law_error,
    state_contacts,
    stress_floor,
    wall_contacts,
)
from branchcrush.packings.contact_laws import HertzContact, LinearContact

RADII = np.array([1.0, 2.0, 3.0, 4.0])
LAW = LinearContact(10.0)


def pairs_of(*rows):
    """Return a frame of the pair dump from rows of id1, id2 and the vector from 2 to 1."""
    ids = np.array([row[:2] for row in rows], dtype=float)
    vector = np.array([row[2] for row in rows])
    branch = np.linalg.norm(vector, axis=1)
    overlap = RADII[ids.astype(int) - 1].sum(axis=1) - branch
    return {
        "id1": ids[:, 0],
        "id2": ids[:, 1],
        "branch": branch,
        **dict(zip(("branch_x", "branch_y", "branch_z"), vector.T, strict=True)),
        "force": LAW.stiffness * overlap,
    }


def test_contacts_are_sorted_by_grain_with_the_radii_of_both():
    pairs = pairs_of((4, 2, (5, 0, 0)), (1, 3, (0, 3.5, 0)), (2, 1, (0, 0, 2.5)))
    contacts = state_contacts(pairs, RADII, LAW)
    assert contacts["i"].tolist() == [0, 0, 1]
    assert contacts["j"].tolist() == [1, 2, 3]
    assert_array_equal(contacts["radius_i_m"], [1, 1, 2])
    assert_array_equal(contacts["radius_j_m"], [2, 3, 4])
    assert_allclose(contacts["overlap_m"], [0.5, 0.5, 1.0], rtol=1e-15)
    assert_allclose(contacts["normal_force_N"], [5, 5, 10], rtol=1e-15)
    assert_allclose(contacts["energy_J"], [1.25, 1.25, 5], rtol=1e-15)


def test_branch_vectors_point_from_i_to_j_in_the_order_of_the_contacts():
    places = np.array([[0.0, 0, 0], [1.5, 2.0, 0], [0, 0, 4.5]])
    pairs = pairs_of((3, 1, places[2] - places[0]), (1, 2, places[0] - places[1]))
    columns = state_contacts(pairs, RADII, LAW)
    assert columns["j"].tolist() == [1, 2]
    vectors = np.column_stack([columns[f"branch_{axis}"] for axis in "xyz"])
    assert vectors.tolist() == [[1.5, 2.0, 0.0], [0.0, 0.0, 4.5]]


def test_two_grains_that_touch_through_two_faces_have_two_contacts():
    # Of one length, and listed once from either side.
    pairs = pairs_of((1, 2, (2.5, 0, 0)), (2, 1, (2.5, 0, 0)), (1, 2, (0, 2.75, 0)))
    contacts = state_contacts(pairs, RADII, LAW)
    assert contacts["i"].tolist() == [0] * 3
    assert_allclose(contacts["branch_length_m"], [2.5, 2.5, 2.75])
    # Seen from the first grain the other is at -x, at +x, and at -y.
    assert contacts["branch_x"].tolist() == [-2.5, 2.5, 0.0]
    assert contacts["branch_y"].tolist() == [0.0, 0.0, -2.75]


@pytest.mark.parametrize(
    "again",
    [(1, 2, (2.5, 0, 0)), (2, 1, (-2.5, 0, 0))],
    ids=["the same way", "from the other side"],
)
def test_contact_listed_twice_is_refused(again):
    others = [(1, 2, (0, 2.5, 0)), (1, 2, (0, 0, 2.5)), (3, 4, (6, 0, 0))]
    pairs = pairs_of((1, 2, (2.5, 0, 0)), *others, again)
    with pytest.raises(SimulationError, match="twice"):
        state_contacts(pairs, RADII, LAW)


def test_state_without_contacts_has_empty_columns():
    one = pairs_of((1, 2, (2.5, 0, 0)))
    empty = {name: column[:0] for name, column in one.items()}
    assert {column.size for column in state_contacts(empty, RADII, LAW).values()} == {0}


def test_the_shorter_of_two_contacts_of_one_pair_comes_first():
    pairs = pairs_of((1, 2, (2.75, 0, 0)), (1, 2, (0, 2.5, 0)))
    assert state_contacts(pairs, RADII, LAW)["branch_length_m"].tolist() == [2.5, 2.75]


# --- walls ---------------------------------------------------------------------------------------


def frame_of(places, radii, forces):
    """Return a frame of the particle dump from places, radii and forces of walls."""
    rows = zip("xyz", np.transpose(places), np.transpose(forces), strict=True)
    columns = {"radius": np.array(radii)}
    for axis, place, force in rows:
        columns |= {axis: place, f"v_wall_f{axis}": force}
    return columns


def test_a_grain_in_a_corner_touches_three_walls():
    # In a cube of edge 10: walls at -5 and 5, and the grain 0.25, 0.5 and 0 m too near to them.
    frame = frame_of([[-4.25, 4.5, 0.0]], [1.0], [[2.0, -3.0, 0.0]])
    walls = wall_contacts(frame, 10.0)
    assert walls["i"].tolist() == [0, 0]
    assert walls["wall"].tolist() == ["-x", "+y"]
    assert walls["overlap_m"].tolist() == [0.25, 0.5]
    assert walls["normal_force_N"].tolist() == [2.0, 3.0]
    directions = np.column_stack([walls[f"direction_{axis}"] for axis in "xyz"])
    assert directions.tolist() == [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    # Of a cell about the origin, zeros have no sign that a file would keep.
    assert not np.signbit(directions[directions == 0.0]).any()


@pytest.mark.parametrize(("axis", "place"), [("x", 0), ("y", 1), ("z", 2)])
@pytest.mark.parametrize("side", [-1, 1])
def test_every_wall_has_its_name_and_points_outwards(axis, place, side):
    unit = np.eye(3)[place]
    frame = frame_of([side * 4.5 * unit] * 2, [0.5, 0.75], [0 * unit, -side * unit])
    walls = wall_contacts(frame, 10.0)
    assert walls["i"].tolist() == [1]
    assert walls["wall"].tolist() == [f"{'-+'[side > 0]}{axis}"]
    assert [walls[f"direction_{name}"][0] for name in "xyz"] == (side * unit).tolist()
    assert walls["overlap_m"].tolist() == [0.25]


def test_a_state_off_the_walls_has_empty_columns():
    walls = wall_contacts(frame_of([[0.0, 0.0, 0.0]], [1.0], [[0.0, 0.0, 0.0]]), 10.0)
    assert list(walls) == [
        "i",
        "wall",
        "direction_x",
        "direction_y",
        "direction_z",
        "overlap_m",
        "normal_force_N",
    ]
    assert {column.size for column in walls.values()} == {0}


# --- the law, and what stands for no load ---------------------------------------------------------


def test_floors_are_those_of_two_mean_grains_pressed_by_a_ten_thousandth_of_their_radius():
    # Radii 1 and 3: the mean is 2, and the reduced radius of two such grains 1.
    assert_allclose(force_floor([1.0, 3.0], LinearContact(5.0)), 5 * 2e-4, rtol=1e-14)
    hertz = 7 * 1.0**0.5 * 2e-4**1.5
    assert_allclose(force_floor([1.0, 3.0], HertzContact(7.0)), hertz, rtol=1e-14)
    # Over the section through a mean grain.
    assert_allclose(stress_floor([1.0, 3.0], HertzContact(7.0)), hertz / (4 * np.pi), rtol=1e-14)


HERTZ, GRAINS = HertzContact(2.0), np.array([4.0, 4.0, 1.0])


def pressed(force, at_wall):
    """Return a contact of grains 0 and 1, R* = 2, and one of grain 0 with a wall, R* = 4."""
    contact = {"radius_i_m": 4.0, "radius_j_m": 4.0, "overlap_m": 0.5, "normal_force_N": force}
    contacts = {name: np.array([value]) for name, value in contact.items()}
    wall = {
        "i": np.array([0]),
        "overlap_m": np.array([0.25]),
        "normal_force_N": np.array([at_wall]),
    }
    return contacts, wall


def test_forces_of_the_law_have_no_error():
    # 2 sqrt(2) 0.5^1.5 = 1, and 2 sqrt(4) 0.25^1.5 = 1/2.
    assert law_error(*pressed(1.0, 0.5), GRAINS, HERTZ) < 1e-15


def test_error_is_the_largest_difference_over_the_largest_force():
    assert_allclose(law_error(*pressed(1.0, 0.4), GRAINS, HERTZ), 0.1, rtol=1e-13)
    assert_allclose(law_error(*pressed(0.75, 0.5), GRAINS, HERTZ), 0.25 / 0.75, rtol=1e-13)
    assert_allclose(law_error(*pressed(1.25, 4.5), GRAINS, HERTZ), 4.0 / 4.5, rtol=1e-13)


def test_error_of_a_packing_without_load_is_over_the_floor():
    contacts, walls = pressed(0.0, 0.0)
    for column in (contacts["overlap_m"], walls["overlap_m"]):
        column[:] = 0.0
    walls["normal_force_N"][:] = 1e-7
    # <R> = 3: the floor is 2 sqrt(3/2) (3e-4)^1.5.
    floor = 2 * 1.5**0.5 * 3e-4**1.5
    assert_allclose(law_error(contacts, walls, GRAINS, HERTZ), 1e-7 / floor, rtol=1e-13)
