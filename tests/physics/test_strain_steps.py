"""One strain step: the work of its affine motion, and a fine grain that it traps."""

import itertools

import numpy as np
import pytest

from tests.physics.search import BOUNDARIES, LAWS, STIFFNESS, Search


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("law", LAWS)
def test_work_of_a_step_is_what_the_forces_of_its_affine_motion_do(
    random_grains, compressed, frames, tmp_path, boundary, law
):
    periodic = boundary == "periodic"
    placed = random_grains(60, 2, periodic=periodic)
    edges = placed[2] * np.array([0.625, 0.622, 0.619, 0.616])
    run = compressed(
        placed,
        tmp_path / "run",
        boundary=boundary,
        law=law,
        stiffness=STIFFNESS[law],
        approach_edge=float(edges[0]),
        targets=edges[1:].tolist(),
        # One step to each state.
        strain_step=1.0,
    )
    work = run.path["work_J"].to_numpy()
    states = frames(run.folder / "particles.dump.gz")[1:]
    assert run.path["carries_load"].iloc[1:].all()
    for n, (before, after) in enumerate(itertools.pairwise(edges), start=1):
        ends = [before, (before + after) / 2.0, after]
        first, middle, last = (
            Search(shrunk(states[n - 1], edge / before), periodic, law) for edge in ends
        )
        pushes = [
            search.virial() / edge for search, edge in zip((first, middle, last), ends, strict=True)
        ]
        simpson = (before - after) / 6.0 * np.dot([1.0, 4.0, 1.0], pushes)
        np.testing.assert_allclose(work[n + 1] - work[n], simpson, rtol=1e-9)
        added = sum(last.energies().values()) - sum(first.energies().values())
        # Contacts close or open within the step: a few of some hundred.
        np.testing.assert_allclose(simpson, added, rtol=2e-3)


def shrunk(frame, factor):
    """Return a frame with the cell and the grain centres scaled."""
    places = {axis: factor * frame.columns[axis] for axis in "xyz"}
    return frame._replace(bounds=factor * frame.bounds, columns={**frame.columns, **places})


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("offset", [0.01, 0.05])
def test_a_fine_grain_caught_between_a_large_one_and_a_wall_stays_inside(
    compressed, tmp_path, offset, law
):
    # One strain step closes the gap to a fortieth of the fine grain's size.
    x = 1e-3 * np.array([-offset, 1.1])
    run = compressed(
        (np.column_stack([x, np.zeros((2, 2))]), 1e-3 * np.array([1, 0.02]), 2.3e-3),
        tmp_path / "run",
        law=law,
        approach_edge=2.25e-3,
        targets=[2.001e-3],
        strain_step=1.0,
    )
    # The large grain on the left wall, the fine one between it and the right wall: 3 contacts in
    # a row share what the diameters are too long by. One force: linear, one overlap; Hertz, an
    # overlap that goes with the third root of the curvature 1/R*.
    shortening, curvature = 1e-3 * (2 * (1 + 0.02) - 2.001), np.array([1, 1 / 0.02, 1 + 1 / 0.02])
    shares = np.ones(3) if law == "linear" else np.cbrt(curvature)
    large, fine, between = shortening * shares / shares.sum()
    walls = run.at("walls", -1)
    assert list(zip(walls["i"], walls["wall"], strict=True)) == [(0, "-x"), (1, "+x")]
    np.testing.assert_allclose(walls["overlap_m"], [large, fine], rtol=1e-6)
    np.testing.assert_allclose(run.at("contacts", -1)["overlap_m"], between, rtol=1e-6)
