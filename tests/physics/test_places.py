"""LAMMPS runs wherever folders lie, whatever their names."""

import tempfile

import pytest

from branchcrush.errors import SimulationError
from branchcrush.lammps import links
from branchcrush.lammps.crush import crush
from tests.physics.crushings import loose, rules, variables


@pytest.mark.parametrize("name", ["a b", "${x}", "it's & more#1", "grün"])
def test_where_temporary_files_and_results_lie_makes_no_difference(
    tmp_path, monkeypatch, compressed, random_grains, name
):
    packing = random_grains(20, 1, periodic=True)
    asked = {
        "boundary": "periodic",
        "targets": [packing[2] * 0.7],
        "approach_edge": packing[2] * 0.8,
    }
    plain = compressed(packing, tmp_path / "plain", **asked)
    odd = tmp_path / name
    odd.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(odd))
    there = compressed(packing, odd / "results", **asked)
    assert there.path.equals(plain.path)


def test_a_crushing_runs_there_too(tmp_path, monkeypatch, lammps_inputs):
    odd = tmp_path / "a ${b}"
    odd.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(odd))
    packing = loose(20)
    asked = variables(packing, solid_fraction=0.59, states=1)
    made = crush(
        *packing, asked, rules(), seed=1, inputs=lammps_inputs, folder=odd / "f", log=odd / "log"
    )
    assert made.path["state"].size == 3


def test_where_no_folder_will_do_what_to_set_is_said(monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", "/no such/${x}")
    monkeypatch.setattr(links.os.path, "isdir", lambda folder: False)
    said = "set TMPDIR to a folder whose name has no blanks"
    with pytest.raises(SimulationError, match=said), links.linked("/", "/"):
        pass
