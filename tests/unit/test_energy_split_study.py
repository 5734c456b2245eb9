"""The page of the study of the energy split says what its findings say."""

import shutil

import pandas as pd
import pytest

from tests.unit.studies import scripts_of


@pytest.fixture(scope="module")
def compare():
    return scripts_of("energy_split").compare


def test_the_tables_of_the_pages_are_those_of_the_findings(compare, tmp_path, monkeypatch):
    pages = {name: (compare.DOCS / name) for name in ("energy_split.md", "rods.md")}
    published = {name: page.read_text(encoding="utf-8") for name, page in pages.items()}
    (tmp_path / "results").mkdir()
    shutil.copy(compare.DOCS / "results/findings.csv", tmp_path / "results")
    monkeypatch.setattr(compare, "DOCS", tmp_path)
    for name, text in published.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    compare.main()
    for name, text in published.items():
        assert (tmp_path / name).read_text(encoding="utf-8") == text


def test_a_number_has_its_interval_wherever_the_state_stands_in_its_name(compare):
    row = {"curvature_end": -0.6, "curvature_low_end": -0.9, "curvature_high_end": -0.2}
    assert compare.cell(row, "curvature_end", 1) == "-0.6 (-0.9 to -0.2)"
    row = {"n": 3.0, "n_low": 2.5, "n_high": 3.5, "n_alone_end": 0.25}
    assert compare.cell(row, "n", 2) == "3.00 (2.50–3.50)"
    assert compare.cell(row, "n_alone_end", 2) == "0.25"
    assert compare.cell({"n": float("nan")}, "n", 2) == "–"


def test_samples_are_counted_whose_interval_tells(compare):
    row = {f"ks_{name}_near": 0.5 for name in compare.RIVALS}
    for where in ("near", "end"):
        row |= {f"curvature_{where}": 0.1, f"curvature_low_{where}": 0.05}
        row |= {f"curvature_high_{where}": 0.2, f"grain_size_over_length_high_{where}": 0.1}
        row |= {f"reduced_radius_over_length_{end}_{where}": 0.01 for end in ("low", "high")}
        row |= {f"best_predictor_{where}": "both_radii"}
    row |= {"force_tail_squared_variation_high": 1.1, "verdict": "certified with notes"}
    undecided = row | {"curvature_low_end": -0.1, "reduced_radius_over_length_low_end": -0.1}
    undecided |= {"ks_parking_near": 0.1, "verdict": "not certified"}
    one_size = undecided | {"curvature_end": float("nan"), "verdict": "certified"}
    lines = compare.counts(pd.DataFrame([row, undecided, one_size]))
    assert lines[0] == "| of 2 samples | near jamming | at the end |"
    told = {line.split(" | ")[0].strip("| "): line.split(" | ")[1:] for line in lines[2:]}
    assert told["curvature above 0"] == ["2", "1 |"]
    assert told["R\\* explains more than the branch length"] == ["2", "1 |"]
    assert told["R\\* explains less than the branch length"] == ["0", "0 |"]
    assert told["random parking is nearest to the lengths"][0] == "1"
    assert told["certified, with notes or without"] == ["", "1 |"]
