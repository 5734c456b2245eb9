"""The same crushing to the same bytes: twice, stopped and gone on with, and where none breaks."""

import subprocess
import sys
import time

import numpy as np
import pytest

from branchcrush.lammps.compression import compress
from branchcrush.lammps.crush import LARGEST_RELAXATION, crush
from tests.physics.crushings import alike, killed_after, loose, rules, variables


def test_the_same_run_twice_is_the_same(crushed, usual):
    packing = loose()
    assert alike(usual, crushed(packing, variables(packing), rules())) == []


@pytest.mark.parametrize("reached", [0, 2, 3, 4])
def test_a_run_that_was_stopped_goes_on_to_the_same_bytes(crushed, usual, reached, tmp_path):
    packing = loose()
    given = packing, variables(packing), rules()
    with killed_after(reached):
        crushed(*given, checkpoint=tmp_path)
    assert alike(usual, crushed(*given, checkpoint=tmp_path)) == []


def test_what_another_job_left_is_not_gone_on_with(crushed, usual, tmp_path):
    packing = loose()
    with killed_after(1):
        crushed(packing, variables(packing), rules(2e7), checkpoint=tmp_path)
    assert alike(usual, crushed(packing, variables(packing), rules(), checkpoint=tmp_path)) == []


@pytest.mark.parametrize("name", ["grains_2.kept", "breakages_3.kept", "account_1.kept"])
def test_a_table_of_a_state_that_is_damaged_is_noticed(crushed, usual, name, tmp_path):
    packing = loose()
    given = packing, variables(packing), rules()
    with killed_after(2):
        crushed(*given, checkpoint=tmp_path)
    content = bytearray((tmp_path / name).read_bytes())
    content[-30] ^= 1
    (tmp_path / name).write_bytes(content)
    assert alike(usual, crushed(*given, checkpoint=tmp_path)) == []


def test_a_run_that_ends_at_its_largest_stress_ends_there_again(crushed, usual, tmp_path):
    packing = loose()
    # Of the state that is kept last: it is not loaded any further.
    how = rules(largest_mean_stress=float(usual.path["mean_stress_Pa"][3]) * 0.999)
    given = packing, variables(packing), how
    ended = crushed(*given)
    assert "has reached largest_mean_stress" in ended.path["stopped"][-1]
    reached = len(ended.path["state"]) - 2
    with killed_after(reached):
        crushed(*given, checkpoint=tmp_path)
    assert alike(ended, crushed(*given, checkpoint=tmp_path)) == []


def test_two_ranks_that_were_stopped_go_on_to_the_same_bytes(crushed, tmp_path, lammps_inputs):
    packing = loose()
    given = packing, variables(packing, states=3), rules()
    undisturbed = crushed(*given, ranks=2)
    assert undisturbed.path["breakages"][-1] > 0
    # Ranks are processes of their own: killed from outside, once a state is kept.
    with subprocess.Popen(
        [sys.executable, "-c", CHILD, str(tmp_path), str(lammps_inputs)]
    ) as child:
        end = time.monotonic() + 100
        while not (tmp_path / "kept/account_2.kept").exists() and time.monotonic() < end:
            time.sleep(0.005)
        child.kill()
    assert (tmp_path / "kept/state.kept").exists()
    assert alike(undisturbed, crushed(*given, ranks=2, checkpoint=tmp_path / "kept")) == []


CHILD = """\
import sys
from pathlib import Path
from branchcrush.lammps.crush import crush
from tests.physics.crushings import loose, rules, variables
packing, folder = loose(), Path(sys.argv[1])
crush(*packing, variables(packing, states=3), rules(), seed=1, inputs=sys.argv[2], folder=folder,
      log=folder / "log", ranks=2, keep_dumps="none", checkpoint=folder / "kept")
"""


@pytest.mark.parametrize(
    "how", [rules(np.inf), rules(smallest_diameter=2e-3)], ids=["infinite", "limit above all"]
)
def test_grains_that_cannot_break_are_compressed(how, tmp_path, lammps_inputs):
    packing = loose()
    given = variables(packing)
    crushed = crush(
        *packing,
        given,
        how,
        seed=1,
        inputs=lammps_inputs,
        folder=tmp_path / "a",
        log=tmp_path / "log",
    )
    to_rest = {
        "step_tolerance": how.step_tolerance,
        "step_evaluations": LARGEST_RELAXATION,
        "largest_relaxation": LARGEST_RELAXATION,
    }
    plain = compress(
        *packing,
        {**given, **to_rest},
        inputs=lammps_inputs,
        folder=tmp_path / "b",
        log=tmp_path / "log",
    )
    for kind in ("path", "contacts", "walls", "steps"):
        for name, column in getattr(plain, kind).items():
            assert np.array_equal(
                column, getattr(crushed, kind)[name], equal_nan=column.dtype.kind == "f"
            ), (kind, name)
    for dump in ("particles.dump.gz", "pairs.dump.gz"):
        assert (tmp_path / "a" / dump).read_bytes() == (tmp_path / "b" / dump).read_bytes()
    assert not crushed.breakages["grain"].size
