"""A compression that cannot go on ends its path and says why; one that LAMMPS stops leaves nothing.

The first kind is physics (no rest, no room, a stress out of reach): what was saved before counts.
The second is a mistake, and an exception.
"""

import re
import shutil

import numpy as np
import pytest

from branchcrush.errors import SimulationError

RADIUS = 1.0e-3
PAIR = [[-1.1 * RADIUS, 0.0, 0.0], [1.1 * RADIUS, 0.0, 0.0]], [RADIUS, RADIUS], 4.4 * RADIUS
LOADING = {
    "approach_edge": 4.0 * RADIUS,
    "targets": [3.95 * RADIUS, 3.9 * RADIUS],
    "strain_step": 0.0065,
}
DUMPS = {"particles.dump.gz", "pairs.dump.gz"}
COLUMNS = {"path", "contacts", "walls", "steps"}


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


@pytest.fixture
def stopped(compressed, frames, tmp_path):
    """Return a function that gives a path that ended before its last target, and why."""

    def run(packing=PAIR, **variables):
        run = compressed(packing, tmp_path / "run", **{**LOADING, **variables})
        path = run.path
        assert {file.name for file in run.folder.iterdir()} == DUMPS
        assert path["state"].tolist() == list(range(len(path)))
        assert len(path) < 2 + len(run.variables["targets"])
        assert (path["stopped"].iloc[:-1] == "").all()
        reason = path["stopped"].iloc[-1]
        assert re.match(r"stopped at an edge of 0\.00\d+ m: \S", reason)
        assert "\n" not in reason
        for dump in DUMPS:
            assert len(frames(run.folder / dump)) == len(path)
        for table in (run.contacts, run.walls):
            assert set(table["state"]) <= set(path["state"])
        return run, reason

    return run


def test_the_packing_of_these_tests_does_compress(compressed, tmp_path):
    run = compressed(PAIR, tmp_path / "run", **LOADING)
    assert run.path["carries_load"].iloc[-1]
    assert run.path["stopped"].tolist() == [""] * 4
    assert {path.name for path in run.folder.iterdir()} == DUMPS


def test_a_misspelt_variable_is_named(failure):
    assert failure(strain_steps=2) == "in.compress declares no variable strain_steps"


def test_every_misspelt_variable_is_named(failure):
    text = failure(step=1, drags=2)
    assert text.endswith("declares no variable drags, step")


def test_a_state_that_does_not_come_to_rest_tells_how_far_it_is_from_rest(stopped):
    # A floor so low that the packing carries load before it is loaded.
    run, reason = stopped(largest_relaxation=20, state_tolerance=1e-15, force_floor=1e-30)
    assert "not at rest after 20 force evaluations: unbalanced force ratio " in reason
    assert reason.endswith("wanted 1e-15")
    # It stopped on the approach: there is the packing, and no strain step that counts.
    assert len(run.path) == 1
    assert len(run.steps) == 0
    assert list(run.steps.columns) == STEP_COLUMNS


STEP_COLUMNS = [
    "step",
    "solid_fraction",
    "volume_m3",
    "mean_stress_Pa",
    "work_J",
    "unbalanced_force_ratio",
    "contacts",
    "force_evaluations",
]


def test_what_was_saved_before_is_the_beginning_of_the_path(compressed, stopped, tmp_path):
    whole = compressed(PAIR, tmp_path / "whole", control="stress", **{**LOADING, "targets": [1e6]})
    part, reason = stopped(control="stress", targets=[1e6, 1e7], largest_steps=8)
    assert "mean stress 1e+07 Pa not reached in 8 strain steps: " in reason
    assert len(whole.steps) < len(part.steps)
    for table in ("contacts", "walls"):
        assert getattr(whole, table).equals(getattr(part, table))
    shared = whole.path.columns.drop("stopped")
    assert whole.path[shared].equals(part.path[shared])
    for name in STEP_COLUMNS:
        assert whole.steps[name].tolist() == part.steps[name].tolist()[: len(whole.steps)]
    # The edge told is that of the last strain step.
    told = float(re.search(r"edge of (\S+) m", reason)[1])
    np.testing.assert_allclose(told, np.cbrt(part.steps["volume_m3"].iloc[-1]), rtol=1e-5)


@pytest.mark.parametrize("law", ["linear", "hertz"])
def test_a_stress_too_large_for_the_contacts_ends_with_the_reason(stopped, law):
    run, reason = stopped(law=law, control="stress", targets=[1e6, 1e12], strain_step=0.05)
    assert "mean stress 1e+12 Pa not reached before the cell is as small as its largest" in reason
    assert reason.endswith("the contacts are too soft for it")
    assert len(run.path) == 3
    np.testing.assert_allclose(run.path["mean_stress_Pa"].iloc[-1], 1e6, rtol=5e-3)
    assert run.path["leg"].tolist() == ["loading"] * 3


def test_grains_that_leave_the_cell_are_counted(stopped):
    # Contacts of a far too large time step throw the pair out; the third grain touches nothing.
    positions, radii, edge = PAIR
    corner = [1.5 * RADIUS, 1.5 * RADIUS, 1.5 * RADIUS]
    _, reason = stopped(
        ([*positions, corner], [*radii, 0.1 * RADIUS], edge), time_step=3.0, force_floor=1e-2
    )
    assert re.search(r" m: [12] grain.s. left the cell: load in more steps$", reason)


def test_grains_without_room_do_not_come_to_rest(stopped):
    # Two grains leave a third no room between themselves and the wall: no balance inside exists.
    x = RADIUS * np.array([-1.05, 1.05, 2.15])
    _, reason = stopped(
        (np.column_stack([x, np.zeros((3, 2))]), RADIUS * np.array([1, 1, 0.02]), 4.4 * RADIUS),
        approach_edge=4.25 * RADIUS,
        largest_relaxation=2000,
    )
    assert "not at rest after 2000 force evaluations" in reason or "left" in reason


@pytest.mark.parametrize("quantity", ["position", "radius"])
def test_a_number_that_is_not_one_stops_lammps_with_its_own_first_line(failure, quantity):
    positions, radii, edge = (np.array(part) for part in PAIR)
    if quantity == "position":
        positions[0, 0] = np.nan
    else:
        radii[0] = np.nan
    # The rest of the run's variables do not depend on the radii here.
    text = failure(
        (positions, radii, float(edge)), force_floor=1e-2, skin=1e-4, largest_radius=RADIUS
    )
    assert text.startswith("LAMMPS stopped: ERROR")
    assert "nan" in text
    assert text.endswith("run.log)")


def test_a_grain_outside_the_cell_stops_lammps(failure):
    positions, radii, edge = PAIR
    outside = [positions[0], [3.0 * RADIUS, 0.0, 0.0]]
    assert "Did not assign all atoms correctly" in failure((outside, radii, edge))


def test_overlapping_grains_are_not_a_packing_at_rest(compressed, tmp_path):
    # The path is whole; its first state says so.
    positions, radii, edge = PAIR
    path = compressed(([positions[0], [0.0, 0.0, 0.0]], radii, edge), tmp_path, **LOADING).path
    assert path["unbalanced_force_ratio"].iloc[0] > 0.1
    rest = path.iloc[1:]
    assert (rest["unbalanced_force_ratio"] <= np.where(rest["carries_load"], 1e-7, 1e-3)).all()


def test_a_script_that_is_missing_is_named(failure, lammps_inputs, tmp_path):
    inputs = tmp_path / "inputs"
    shutil.copytree(lammps_inputs, inputs)
    (inputs / "mod.relax").unlink()
    text = failure(inputs=inputs)
    assert text.startswith("LAMMPS stopped: ERROR")
    assert "mod.relax" in text


def test_an_error_leaves_the_results_of_an_earlier_run(compressed, tmp_path):
    run = compressed(PAIR, tmp_path / "run", **LOADING)
    before = {path.name: path.read_bytes() for path in run.folder.iterdir()}
    with pytest.raises(SimulationError):
        compressed(PAIR, tmp_path / "run", **LOADING, normal_damping="much")
    assert {path.name: path.read_bytes() for path in run.folder.iterdir()} == before


def test_a_dump_that_cannot_be_written_leaves_those_of_an_earlier_run(
    compressed, tmp_path, monkeypatch
):
    run = compressed(PAIR, tmp_path / "run", **LOADING)
    before = {path.name: path.read_bytes() for path in run.folder.iterdir()}

    def full_disk(plain, packed, *_):
        packed.write(plain.read(100))
        # The first dump is whole, the second breaks off.
        if "pairs" in plain.name:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr("branchcrush.lammps.files.shutil.copyfileobj", full_disk)
    with pytest.raises(OSError, match="No space left"):
        compressed(PAIR, tmp_path / "run", **LOADING)
    assert {path.name: path.read_bytes() for path in run.folder.iterdir()} == before


def test_a_path_that_stops_takes_the_place_of_an_earlier_one(compressed, stopped, tmp_path):
    before = compressed(PAIR, tmp_path / "run", **LOADING)
    sizes = {path.name: path.stat().st_size for path in before.folder.iterdir()}
    run, _ = stopped(largest_relaxation=20, state_tolerance=1e-15)
    assert all(path.stat().st_size < sizes[path.name] for path in run.folder.iterdir())


def test_lammps_runs_again_in_the_same_process_after_a_failure(compressed, failure, tmp_path):
    failure(normal_damping="much")
    assert compressed(PAIR, tmp_path / "again", **LOADING).path["carries_load"].iloc[-1]


def test_a_project_may_lie_in_a_folder_with_a_space(compressed, lammps_inputs, tmp_path):
    project = tmp_path / "my own project"
    inputs = shutil.copytree(lammps_inputs, project / "the inputs")
    run = compressed(PAIR, project / "seed 1", inputs=inputs, **LOADING)
    plain = compressed(PAIR, tmp_path / "plain", **LOADING)
    assert {path.name for path in run.folder.iterdir()} == DUMPS
    for table in COLUMNS:
        assert getattr(run, table).equals(getattr(plain, table))


def test_a_folder_may_be_told_from_where_one_is(compressed, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = compressed(PAIR, type(tmp_path)("a run/here"), **LOADING)
    assert {path.name for path in (tmp_path / "a run/here").iterdir()} == DUMPS
    assert len(run.path) == 4


def test_a_target_may_be_where_the_cell_is(compressed, tmp_path):
    # No strain is left to go: the state is saved once more.
    edges = [4.0 * RADIUS, 3.95 * RADIUS, 3.95 * RADIUS]
    path = compressed(PAIR, tmp_path, **{**LOADING, "targets": edges}).path
    np.testing.assert_array_equal(path["volume_m3"].iloc[[1, 3]], path["volume_m3"].iloc[[2, 4]])
    assert path["work_J"].iloc[3] == path["work_J"].iloc[4]
