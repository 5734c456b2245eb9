"""Branch vectors and wall directions of a real run, against the positions that LAMMPS dumped."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.packings.network import VECTOR_COLUMNS

# Coordinates are a few millimetres and doubles.
ROUNDING = 1e-17
OUTWARDS = {
    f"{'-+'[side]}{'xyz'[axis]}": (axis, 2 * side - 1) for axis in range(3) for side in (0, 1)
}


@pytest.fixture(scope="module", params=["walls", "periodic"])
def loaded(request, random_grains, compressed, frames, tmp_path_factory):
    """Return the contacts, wall contacts and frame of the last state, and the edge of its cell."""
    periodic = request.param == "periodic"
    placed = random_grains(60, 2, periodic=periodic)
    run = compressed(
        placed,
        tmp_path_factory.mktemp("branches") / "run",
        boundary=request.param,
        approach_edge=0.625 * placed[2],
        targets=[0.616 * placed[2]],
        strain_step=1.0,
    )
    assert run.path["carries_load"].iloc[-1]
    frame = frames(run.folder / "particles.dump.gz")[-1]
    return run.at("contacts", -1), run.at("walls", -1), frame, float(np.ptp(frame.bounds[0]))


def test_a_branch_vector_leads_from_i_to_j_through_whole_cells_only(loaded, request):
    contacts, _, frame, edge = loaded
    place, vector = frame.vectors("x", "y", "z"), contacts[list(VECTOR_COLUMNS)].to_numpy()
    straight = place[contacts["j"]] - place[contacts["i"]]
    cells = np.round((vector - straight) / edge)
    assert_allclose(vector - straight, cells * edge, rtol=0, atol=ROUNDING)
    # Through the faces of a periodic cell some must lead, through walls none.
    assert np.any(cells != 0.0) == ("periodic" in request.node.name)


def test_a_branch_vector_is_as_long_as_the_branch_and_no_longer_than_the_radii(loaded):
    contacts, *_ = loaded
    length = np.linalg.norm(contacts[list(VECTOR_COLUMNS)], axis=1)
    assert len(length) > 100
    assert_allclose(length, contacts["branch_length_m"], rtol=1e-14)
    reach = contacts["radius_i_m"] + contacts["radius_j_m"]
    assert_allclose(reach - length, contacts["overlap_m"], rtol=0, atol=ROUNDING)


def test_a_wall_contact_points_to_its_wall(loaded, request):
    _, walls, frame, edge = loaded
    if "periodic" in request.node.name:
        assert walls.empty
        return
    assert set(walls["wall"]) == set(OUTWARDS)
    direction = walls[["direction_x", "direction_y", "direction_z"]].to_numpy()
    expected = np.zeros_like(direction)
    for row, wall in enumerate(walls["wall"]):
        axis, side = OUTWARDS[wall]
        expected[row, axis] = side
    assert_array_equal(direction, expected)
    # Along it, the grain reaches beyond the wall by its overlap.
    grain = walls["i"].to_numpy()
    centre = np.sum(frame.vectors("x", "y", "z")[grain] * direction, axis=1)
    beyond = centre + frame.columns["radius"][grain] - edge / 2.0
    assert_allclose(beyond, walls["overlap_m"], rtol=0, atol=ROUNDING)
    assert (beyond > 0.0).all()
