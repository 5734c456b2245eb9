"""A compression that fails says so in one line, and leaves nothing that looks like a result."""

import re
import shutil

import numpy as np
import pytest

from branchcrush.errors import SimulationError

RADIUS = 1.0e-3
PAIR = [[-1.1 * RADIUS, 0.0, 0.0], [1.1 * RADIUS, 0.0, 0.0]], [RADIUS, RADIUS], 4.4 * RADIUS
LOADING = {
    "approach_edge": 4.0 * RADIUS,
    "final_edge": 3.9 * RADIUS,
    "steps": 4,
    "steps_per_state": 2,
}


@pytest.fixture
def failure(compressed, tmp_path):
    """Return a function that gives the message of a failed compression, and checks its traces."""

    def message(packing=PAIR, **variables):
        folder = tmp_path / "run"
        with pytest.raises(SimulationError) as caught:
            compressed(packing, folder, **{**LOADING, **variables})
        assert list(folder.glob("*")) == []
        text = str(caught.value)
        assert "\n" not in text
        return text

    return message


def test_the_packing_of_these_tests_does_compress(compressed, tmp_path):
    run = compressed(PAIR, tmp_path / "run", **LOADING)
    assert run.path["carries_load"].iloc[-1]
    left = {path.name for path in run.folder.iterdir()}
    assert left == {"particles.dump.gz", "pairs.dump.gz"}


def test_a_misspelt_variable_is_named(failure):
    assert failure(steps_per_stat=2) == "in.compress declares no variable steps_per_stat"


def test_every_misspelt_variable_is_named(failure):
    text = failure(step=1, drags=2)
    assert text.endswith("declares no variable drags, step")


def test_a_state_that_does_not_come_to_rest_tells_how_far_it_is_from_rest(failure):
    text = failure(largest_relaxation=20, state_tolerance=1e-12)
    assert "not at rest after 20 force evaluations: unbalanced force ratio " in text
    assert text.endswith("wanted 1e-12")
    assert text.startswith("compression stopped at an edge of 0.00")


def test_grains_that_leave_the_cell_are_counted(failure):
    # Contacts of a far too large time step throw the pair out; the third grain touches nothing.
    positions, radii, edge = PAIR
    corner = [1.5 * RADIUS, 1.5 * RADIUS, 1.5 * RADIUS]
    text = failure(
        ([*positions, corner], [*radii, 0.1 * RADIUS], edge), time_step=3.0, force_floor=1e-2
    )
    assert re.fullmatch(
        r"compression stopped at an edge of 0\.00\d+ m: [12] grain.s. left .*", text
    )


def test_grains_without_room_do_not_come_to_rest(failure):
    # Two grains leave a third no room between themselves and the wall: no balance inside exists.
    x = RADIUS * np.array([-1.05, 1.05, 2.15])
    text = failure(
        (np.column_stack([x, np.zeros((3, 2))]), RADIUS * np.array([1, 1, 0.02]), 4.4 * RADIUS),
        approach_edge=4.25 * RADIUS,
        largest_relaxation=2000,
    )
    assert "not at rest after 2000 force evaluations" in text or "left" in text


@pytest.mark.parametrize("quantity", ["position", "radius"])
def test_a_number_that_is_not_one_stops_lammps_with_its_own_first_line(failure, quantity):
    positions, radii, edge = (np.array(part) for part in PAIR)
    if quantity == "position":
        positions[0, 0] = np.nan
    else:
        radii[0] = np.nan
    # The rest of the run's variables do not depend on the radii here.
    text = failure((positions, radii, float(edge)), force_floor=1e-2, skin=1e-4)
    assert text.startswith("LAMMPS stopped: ERROR")
    assert "nan" in text
    assert text.endswith("run.log)")


def test_a_grain_outside_the_cell_stops_lammps(failure):
    positions, radii, edge = PAIR
    outside = [positions[0], [3.0 * RADIUS, 0.0, 0.0]]
    assert "Did not assign all atoms correctly" in failure((outside, radii, edge))


def test_overlapping_grains_are_not_a_packing_at_rest(failure):
    positions, radii, edge = PAIR
    text = failure(([positions[0], [0.0, 0.0, 0.0]], radii, edge))
    assert text.startswith("state 0 at solid fraction ")
    assert "unbalanced force ratio" in text


def test_a_script_that_is_missing_is_named(failure, lammps_inputs, tmp_path):
    inputs = tmp_path / "inputs"
    shutil.copytree(lammps_inputs, inputs)
    (inputs / "mod.relax").unlink()
    text = failure(inputs=inputs)
    assert text.startswith("LAMMPS stopped: ERROR")
    assert "mod.relax" in text


def test_a_failed_run_leaves_the_results_of_an_earlier_one(compressed, tmp_path):
    run = compressed(PAIR, tmp_path / "run", **LOADING)
    before = {path.name: path.read_bytes() for path in run.folder.iterdir()}
    with pytest.raises(SimulationError):
        compressed(PAIR, tmp_path / "run", **LOADING, largest_relaxation=20)
    assert {path.name: path.read_bytes() for path in run.folder.iterdir()} == before


def test_lammps_runs_again_in_the_same_process_after_a_failure(compressed, failure, tmp_path):
    failure(normal_damping="much")
    assert compressed(PAIR, tmp_path / "again", **LOADING).path["carries_load"].iloc[-1]
