"""Files and folders that a study needs are checked before any job."""

import numpy as np
import pytest

from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study
from tests.unit.config.studies import SAMPLE, SIEVE, UNIFORM, lines_of, study_of

# --- files ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "content",
    [
        "1,0\n2,60\n8,100\n",
        "opening_mm,percent\n1,0\n2,60\n8,100\n",
        "# of the river\n\n1,0\n\n2,60  # twice\n8,100\n",
        "\ufeff1,0\n2,60\n8,100\n",
        "1;0\n2;60\n8;100\n",
        "1,0;0,0\n2,0;60,0\n8;1e2\n",
        "8,100\n2,60\n1,0\n",
        "1,0\n2,60\n2,60\n8,100\n",
        "1\t0\r\n2\t60\r\n8\t100\r\n",
    ],
)
def test_every_dialect_of_a_table_gives_the_same_grading(folder, content):
    (folder / "sand.csv").write_bytes(content.encode())
    checked_study(study_of(grading=SIEVE, allow_unrepresentative=True))
    grading = grading_of(SIEVE)
    (folder / "sand.csv").write_text("1,0\n2,60\n8,100\n")
    expected = grading_of(SIEVE)
    radii = np.geomspace(0.5e-3, 4e-3, 9)
    assert grading.mass_cdf(radii).tolist() == expected.mass_cdf(radii).tolist()


def test_files_of_all_parts_of_a_mixture_are_named(folder):
    (folder / "wrong.csv").write_text("1,0\n2,110\n8,x\n")
    parts = [{**SIEVE, "file": name} for name in ("no.csv", "wrong.csv", ".")]
    components = [{"weight": 1, "grading": part} for part in parts]
    lines = lines_of(
        study_of(grading={"form": "mixture", "basis": "mass", "components": components})
    )
    place = "config: samples.mine.grading.components"
    assert [line.removeprefix(place)[:43] for line in lines] == [
        ".0.grading.file = 'no.csv': there is no suc",
        ".1.grading.file: wrong.csv, line 2: percent",
        ".1.grading.file: wrong.csv, line 3: percent",
        ".2.grading.file = '.': is a folder; give th",
    ]


@pytest.mark.parametrize("name", ["a\0b", "n" * 300, "/dev/null", "no/such.csv"])
def test_a_name_of_no_file_is_refused(folder, name):
    (line,) = lines_of(study_of(grading={**SIEVE, "file": name}))
    assert line.startswith("config: samples.mine.grading.file = '")


def test_a_missing_file_is_named_besides_another_mistake(folder):
    lines = lines_of(study_of(grading={**SIEVE, "unit": "ft"}))
    assert [line.split(" = ")[0][-12:] for line in lines] == ["grading.unit", "grading.file"]


def test_missing_files_of_a_mixture_are_named_besides_another_mistake(folder):
    parts = [{**SIEVE, "file": "no.csv"}, {**UNIFORM, "unit": "ft"}]
    components = [{"weight": 1, "grading": part} for part in parts]
    wrong, missing = lines_of(
        study_of(grading={"form": "mixture", "basis": "mass", "components": components})
    )
    assert wrong.startswith("config: samples.mine.grading.components.1.grading.unit = 'ft'")
    assert missing.startswith("config: samples.mine.grading.components.0.grading.file = 'no.csv'")


def test_a_file_that_may_not_be_read_is_named(folder, locked):
    (folder / "sand.csv").write_text("1,0\n2,60\n8,100\n")
    locked("sand.csv")
    (line,) = lines_of(study_of(grading=SIEVE))
    expected = "grading.file = 'sand.csv': cannot be read: change its permissions"
    assert line == f"config: samples.mine.{expected}"


# --- folders -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "place", ["results", "logs", "results/mine", "results/mine-refined", "results/figures/mine"]
)
def test_a_file_in_the_way_of_results_is_named(folder, place):
    (folder / place).parent.mkdir(parents=True, exist_ok=True)
    (folder / place).touch()
    expected = f"config: {place} is a file, and results need a folder there: move it"
    assert lines_of(study_of()) == [expected]


@pytest.mark.parametrize("place", ["results", "logs/mine", "results/mine-refined"])
def test_a_folder_of_results_that_may_not_be_written_is_named(folder, locked, place):
    (folder / place).mkdir(parents=True)
    locked(place)
    assert lines_of(study_of()) == [f"config: {place} cannot be written to: change its permissions"]


def test_a_study_in_a_folder_that_may_not_be_written_is_refused(folder, locked):
    locked(".")
    (line,) = lines_of(study_of())
    assert line == f"config: the folder {folder} cannot be written to: run in one of your own"


def test_a_name_that_leads_elsewhere_is_only_refused(folder):
    (folder / "results").mkdir()
    (folder / "up").touch()
    (line,) = lines_of({"samples": {"../up": SAMPLE}})
    assert "it names a folder" in line
