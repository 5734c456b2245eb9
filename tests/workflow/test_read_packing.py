"""Packings of another code through the workflow, beside a sample that is compressed here."""

import shutil

import numpy as np
import pytest

from branchcrush.files.dictionary import result_files
from branchcrush.files.tables import read_json, read_table
from tests.workflow.conftest import ROOT
from tests.workflow.notebooks import executed_beside

CONFIG = """\
samples:
  others:
    packing:
      format: liggghts
      grains: [grains.dump, grains.dump]
      contacts: [contacts.dump, contacts.dump]
      keywords: [pos, id, force, delta]
    boundary: periodic
    contact: {law: linear, normal_stiffness: 1.0e6}
figures: {dpi: 60}
"""
# Of the edge of the cube in the files [m].
HALF = "0.00394359"
TARGETS = [
    "results/others/certificate.json",
    "results/others/sharing.json",
    "results/figures/others/view.json",
]


def copied(study):
    source = ROOT / "tests/data/readers/cross_check"
    shutil.copy(source / "liggghts_grains.dump", study.folder / "grains.dump")
    shutil.copy(source / "liggghts_contacts.dump", study.folder / "contacts.dump")
    study.configure(CONFIG)


def tilted(study):
    """Describe the same lattice by a cell that is tilted by its edge: nothing else may change."""
    grains = study.folder / "grains.dump"
    cube = "ITEM: BOX BOUNDS pp pp pp\n" + 3 * f"-{HALF} {HALF}\n"
    text = grains.read_text()
    assert text.count(cube) == 2
    bounds = [f"-{HALF} {3 * float(HALF)} {2 * float(HALF)}", *2 * [f"-{HALF} {HALF} 0"]]
    tilt = "\n".join(["ITEM: BOX BOUNDS xy xz yz pp pp pp", *bounds, ""])
    grains.write_text(text.replace(cube, tilt))


def test_a_packing_of_another_code_is_analysed_as_one_of_this(study):
    copied(study)
    tilted(study)
    run = study.snakemake(*TARGETS)
    assert run.returncode == 0, run.stdout + run.stderr
    results = study.folder / "results" / "others"
    certificate = read_json(results / "certificate.json")
    assert certificate["verdict"] == "certified with notes"
    assert certificate["limits"]["inertial_number"] is None
    notes = [note["finding"] for note in certificate["notes"]]
    assert any("made by another code" in note for note in notes)
    assert any("packings 1, 2: positions have" in note for note in notes)
    fit = read_json(results / "energy_split.json")
    assert 1.0 < fit["exponent"] < 5.0 and fit["seeds"] == 2
    # The grading is that of the grains.
    grading = read_json(results / "grading.json")
    assert grading["representativity"]["grains"] == 200
    radii = read_table(results / "radii.csv")["radius_m"]
    assert len(radii) == 400
    assert grading["target"]["D_max_m"] == pytest.approx(2.0 * radii.max())
    shared = read_json(results / "sharing.json")["end"]
    assert shared["stress"] and shared["forces"] and "reason" not in shared
    # Both of its frames are drawn, in the cell of the files.
    view = read_json(study.folder / "results" / "figures" / "others" / "view.json")["header"]
    assert [row["label"] for row in view["states"]] == ["first frame", "densest frame"]
    row = view["states"][-1]
    assert row["grains"] == 200
    assert row["contacts"] == read_json(results / "seed_1" / "reading.json")["contacts"] > 200
    assert view["periodic"] == [True, True, True]
    cell = 2 * float(HALF) * np.array([[1, 0, 0], [1, 1, 0], [0, 0, 1]])
    np.testing.assert_allclose(row["cell_m"], cell, atol=1e-12)
    for path in (results / "seed_1").iterdir():
        name = path.relative_to(study.folder / "results").as_posix()
        assert any(file.matches(name) for file in result_files()), name
    cells = executed_beside(study.folder / "results", study.folder / "project")
    assert "sample others: 2 packings" in cells[0].outputs[0].data["text/plain"]
    again = study.snakemake("--dry-run", *TARGETS)
    assert "Nothing to be done" in again.stdout + again.stderr


def test_files_that_do_not_fit_end_the_run_with_what_is_wrong(study):
    copied(study)
    text = (study.folder / "contacts.dump").read_text()
    (study.folder / "contacts.dump").write_text(text[: len(text) * 9 // 10])
    run = study.snakemake("results/others/seed_1/path.csv")
    assert run.returncode == 1
    assert "contacts.dump" in run.stdout + run.stderr
    assert "breaks off" in run.stdout + run.stderr
    assert "Traceback" not in run.stdout + run.stderr
