"""What a saved state tells, from frames of a dump made up for the purpose."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.errors import SimulationError
from branchcrush.loading.states import state_contacts
from branchcrush.packings.contact_laws import LinearContact

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
    found = state_contacts(pairs, RADII, LAW)
    assert found["i"].tolist() == [0, 0, 1]
    assert found["j"].tolist() == [1, 2, 3]
    assert_array_equal(found["radius_i_m"], [1, 1, 2])
    assert_array_equal(found["radius_j_m"], [2, 3, 4])
    assert_allclose(found["overlap_m"], [0.5, 0.5, 1.0], rtol=1e-15)
    assert_allclose(found["normal_force_N"], [5, 5, 10], rtol=1e-15)
    assert_allclose(found["energy_J"], [1.25, 1.25, 5], rtol=1e-15)


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
    found = state_contacts(pairs, RADII, LAW)
    assert found["i"].tolist() == [0] * 3
    assert_allclose(found["branch_length_m"], [2.5, 2.5, 2.75])
    # Seen from the first grain the other is at -x, at +x, and at -y.
    assert found["branch_x"].tolist() == [-2.5, 2.5, 0.0]
    assert found["branch_y"].tolist() == [0.0, 0.0, -2.75]


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
