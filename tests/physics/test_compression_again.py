"""A compression that was killed goes on from its last saved state, to the same bytes."""

import os
import random
import re
import subprocess
import sys
import time

import numpy as np
import pytest

from branchcrush.lammps import checkpoint
from branchcrush.lammps.compression import compress
from branchcrush.lammps.kept import read_kept
from branchcrush.loading.states import force_floor
from tests.physics.crushings import GLASS, LINEAR, alike, killed_after, loose, variables

DUMPS = ("particles.dump.gz", "pairs.dump.gz")
# Of each: three states, of which the last is on the way back.
CASES = {
    "to edges, walls": {"periodic": False},
    "to edges, periodic, hertz": {"periodic": True, "law": GLASS},
    "to stresses, walls, hertz": {"periodic": False, "law": GLASS, "stresses": (3e6, 2e7, 8e6)},
    "to stresses, periodic": {"periodic": True, "stresses": (1e5, 4e5, 2e5)},
}


def asked(*, stresses=(), periodic=True, law=LINEAR, grains=40):
    """Return a packing and the variables of its loading."""
    packing = loose(grains, periodic=periodic)
    given = variables(
        packing, states=2, law=law, periodic=periodic, strain_step=6e-3, unloading=True
    )
    if stresses:
        given |= {"control": "stress", "targets": list(stresses), "step_tolerance": 5e-3}
    assert given["force_floor"] == force_floor(packing.radii, law)
    return packing, given


@pytest.fixture
def run(tmp_path_factory, lammps_inputs):
    """Return a function that compresses a packing: the tables, the bytes of dumps, and the log."""

    def run(packing, given, **others):
        folder = tmp_path_factory.mktemp("compression")
        tables = compress(
            *packing, given, inputs=lammps_inputs, folder=folder, log=folder / "log", **others
        )
        return (
            tables,
            {name: (folder / name).read_bytes() for name in DUMPS},
            (folder / "log").read_text(),
        )

    return run


def same(one, other):
    return alike(one[0], other[0]) == [] and one[1] == other[1]


@pytest.mark.parametrize("case", CASES)
def test_killed_after_each_state_it_goes_on_to_the_same_bytes(run, case, tmp_path):
    packing, given = asked(**CASES[case])
    undisturbed = run(packing, given)
    assert len(undisturbed[0].path["state"]) == 2 + len(given["targets"]) == 5
    assert undisturbed[0].path["stopped"][-1] == ""
    for targets in range(4):
        with killed_after(targets):
            run(packing, given, checkpoint=tmp_path)
        again = run(packing, given, checkpoint=tmp_path)
        assert same(undisturbed, again), targets
        assert f"\nbranchcrush: continues from state {targets + 1} of 4\n" in again[2]
        # None of those that are finished is computed again.
        states = [int(state) for state in re.findall(r"^(\d+),\d+,\d+,", again[2], re.MULTILINE)]
        assert states == list(range(targets + 2, 5))
        # What it has kept is that of a whole run by now: begin anew.
        (tmp_path / "state.kept").unlink()


def test_it_may_be_killed_over_and_over(run, tmp_path):
    packing, given = asked(**CASES["to stresses, walls, hertz"])
    for targets in range(4):
        with killed_after(targets):
            run(packing, given, checkpoint=tmp_path)
    assert same(run(packing, given), run(packing, given, checkpoint=tmp_path))


def test_a_path_that_stops_on_the_way_stops_there_again(run, tmp_path):
    packing, given = asked()
    # No packing that carries load comes to rest so far.
    given |= {"largest_relaxation": 3000, "state_tolerance": 1e-18}
    undisturbed = run(packing, given)
    assert "not at rest after 3000" in undisturbed[0].path["stopped"][-1]
    with killed_after(0):
        run(packing, given, checkpoint=tmp_path)
    assert same(undisturbed, run(packing, given, checkpoint=tmp_path))


def test_states_that_take_no_time_are_not_kept(run, tmp_path, monkeypatch):
    packing, given = asked()
    monkeypatch.setattr(checkpoint, "LEAST_SECONDS", 3600.0)
    undisturbed = run(packing, given, checkpoint=tmp_path)
    assert not (tmp_path / "state.kept").exists()
    monkeypatch.setattr(checkpoint, "LEAST_SECONDS", 0.0)
    assert same(undisturbed, run(packing, given, checkpoint=tmp_path))
    assert (tmp_path / "state.kept").exists()


@pytest.fixture(scope="module")
def reached(tmp_path_factory, lammps_inputs):
    """Return what was asked for, an undisturbed run of it, and what one that was killed kept."""
    packing, given = asked(periodic=False)
    folder = tmp_path_factory.mktemp("reached")
    places = {"inputs": lammps_inputs, "log": folder / "log"}
    undisturbed = compress(*packing, given, folder=folder / "a", **places)
    with killed_after(2):
        compress(*packing, given, folder=folder / "b", checkpoint=folder / "kept", **places)
    return packing, given, undisturbed, folder / "kept"


@pytest.mark.parametrize("how", ["a bit", "cut off", "gone"])
@pytest.mark.parametrize(
    "name", ["state.kept", "states.csv", "steps.csv", "particles.dump", "pairs.dump"]
)
def test_what_is_damaged_is_left_and_said_so(run, reached, tmp_path, name, how):
    packing, given, undisturbed, kept = reached
    for path in kept.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    content = bytearray((kept / name).read_bytes())
    if how == "a bit":
        content[len(content) // 2] ^= 1
    elif how == "cut off":
        del content[len(content) // 2 :]
    (tmp_path / name).write_bytes(content)
    said = f"what an earlier run kept is damaged ({name}): begins anew"
    if how == "gone":
        (tmp_path / name).unlink()
        # Without a state there is nothing.
        said = said if name != "state.kept" else ""
    tables, _, log = run(packing, given, checkpoint=tmp_path)
    assert alike(undisturbed, tables) == []
    assert said in log
    assert "continues from" not in log


def test_what_is_of_another_loading_or_code_is_never_gone_on_with(run, reached, tmp_path):
    packing, given, _, kept = reached

    def log_of(positions=packing.positions, code="", **others):
        for path in kept.iterdir():
            (tmp_path / path.name).write_bytes(path.read_bytes())
        return run((positions, *packing[1:]), {**given, **others}, checkpoint=tmp_path, code=code)[
            2
        ]

    assert "continues from state 3 of 4" in log_of()
    said = "what an earlier run kept is of other settings or another version: begins anew"
    elsewhere = packing.positions.copy()
    elsewhere[0, 0] = np.nextafter(elsewhere[0, 0], 1.0)
    for log in (log_of(normal_damping=0.2), log_of(code="newer"), log_of(elsewhere)):
        assert said in log
        assert "continues from" not in log


CHILD = """\
import sys
from pathlib import Path
from branchcrush.lammps import checkpoint
from branchcrush.lammps.compression import compress
from branchcrush.lammps.kept import read_kept
from tests.physics.test_compression_again import asked
checkpoint.LEAST_SECONDS = 0.0
packing, given = asked(**eval(sys.argv[1]))
folder = Path(sys.argv[2])
compress(*packing, given, inputs=sys.argv[3], folder=folder, log=folder / "log",
         ranks=int(sys.argv[4]), checkpoint=folder / "kept")
"""


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("case", ["to edges, walls", "to stresses, periodic"])
def test_killed_at_random_moments_it_goes_on_to_the_same_bytes(
    run, lammps_inputs, tmp_path, case, ranks
):
    """Of ranks, too: the bytes are those of as many ranks."""
    settings = {**CASES[case], "grains": 100}
    undisturbed = run(*asked(**settings), ranks=ranks)
    state, rng = tmp_path / "kept/state.kept", random.Random(ranks)
    command = [sys.executable, "-c", CHILD, repr(settings), str(tmp_path), str(lammps_inputs)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    for reached in range(3):
        with subprocess.Popen([*command, str(ranks)], env=environment) as child:
            end = time.monotonic() + 200
            while targets_of(state) < reached and child.poll() is None and time.monotonic() < end:
                time.sleep(0.002)
            time.sleep(rng.uniform(0.0, 0.1))
            child.kill()
        assert targets_of(state) >= reached
    again = run(*asked(**settings), ranks=ranks, checkpoint=tmp_path / "kept")
    assert same(undisturbed, again)
    assert "\nbranchcrush: continues from state " in again[2]


def targets_of(state):
    """Return how many targets the kept state has reached, -1 where none is kept."""
    return read_kept(state)[0]["targets"] if state.exists() else -1
