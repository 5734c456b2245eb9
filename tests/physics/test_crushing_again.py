"""The same crushing to the same bytes: twice, stopped and gone on with, and where none breaks."""

import numpy as np
import pytest

from branchcrush.errors import SimulationError
from branchcrush.lammps.compression import compress
from branchcrush.lammps.crush import LARGEST_RELAXATION, crush
from branchcrush.lammps.progress import Progress
from tests.physics.crushings import alike, loose, rules, variables


def test_the_same_run_twice_is_the_same(crushed, usual):
    packing = loose()
    assert alike(usual, crushed(packing, variables(packing), rules())) == []


@pytest.mark.parametrize("reached", [0, 2, 3, 4])
def test_a_run_that_was_stopped_goes_on_to_the_same_bytes(
    crushed, usual, reached, tmp_path, monkeypatch
):
    note = Progress.note_state

    def note_and_die(self, crushing, targets):
        note(self, crushing, targets)
        if targets == reached:
            # What is written on after a state is cut off.
            (self.folder / "states.csv").open("a").write("9,9")
            raise RuntimeError("killed")

    packing, folder = loose(), tmp_path / "unfinished"
    given = packing, variables(packing), rules()
    with monkeypatch.context() as patch, pytest.raises(SimulationError, match="killed"):
        patch.setattr(Progress, "note_state", note_and_die)
        crushed(*given, progress=folder)
    assert alike(usual, crushed(*given, progress=folder)) == []
    assert not folder.exists()


def test_what_another_job_left_is_not_gone_on_with(crushed, usual, tmp_path, monkeypatch):
    packing, folder = loose(), tmp_path / "unfinished"
    note = Progress.note_state

    def note_and_die(self, crushing, targets):
        note(self, crushing, targets)
        raise RuntimeError("killed")

    with monkeypatch.context() as patch, pytest.raises(SimulationError):
        patch.setattr(Progress, "note_state", note_and_die)
        crushed(packing, variables(packing), rules(2e7), progress=folder)
    assert alike(usual, crushed(packing, variables(packing), rules(), progress=folder)) == []


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
