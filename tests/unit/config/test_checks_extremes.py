"""Sizes, lines, files and names that no powder has: one short message each, at once."""

import numpy as np
import pytest

from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study
from branchcrush.config.file import config_file_problem
from branchcrush.files import decoding
from branchcrush.samples.grading import grading_results
from tests.unit.config.studies import SAMPLE, SIEVE, UNIFORM, lines_of, study_of

TABLES = {
    "sieve": "{0},0\n{1},60\n{2},100\n",
    "density": "{0},1\n{1},2\n{2},1\n",
    "radii": "{0}\n{1}\n{2}\n",
    "histogram": "{0},1\n{1},3\n",
}


def of_file(form, content, folder):
    (folder / "sand.csv").write_text(content)
    others = {"radii": {"basis": "number"}, "histogram": {"sizes": "lower", "max": 3.0}}
    return {**SIEVE, "form": form, **others.get(form, {})}


@pytest.mark.parametrize("form", ["sieve", "density", "radii"])
@pytest.mark.parametrize("sizes", [("1e-12", "2e-12", "3e-12"), ("1e9", "2e9", "3e9")])
def test_sizes_of_a_file_that_no_grain_has_are_refused_as_those_of_keys_are(folder, form, sizes):
    section = of_file(form, TABLES[form].format(*sizes), folder)
    lines = lines_of(study_of(grading=section, allow_unrepresentative=True))
    assert any("must be from 1e-09 to 1000 m: check the file and the unit, mm" in x for x in lines)


@pytest.mark.parametrize("form", ["sieve", "density", "histogram"])
def test_sizes_that_differ_by_rounding_are_refused(folder, form):
    sizes = ("1", "1.0000000000000002", "3")
    section = of_file(form, TABLES[form].format(*sizes), folder)
    (line,) = lines_of(study_of(grading=section, allow_unrepresentative=True))
    assert "1 and 1.0000000000000002 are one size but for rounding: remove one" in line


def test_a_list_of_grains_that_differ_by_rounding_alone_is_of_one_size(folder):
    alike = grading_of(of_file("radii", "1.0\n" * 60 + "1.0000000000000002\n", folder))
    (radius,), (share,) = alike.discrete_part
    assert share == 1.0
    # What a job does with it.
    grading_results(alike, 61, 0.7, [np.full(61, radius)], ultimate_alpha=2.6)
    # Beside another size they are as they were written.
    three = grading_of(of_file("radii", "1.0\n1.0000000000000002\n2\n", folder))
    assert len(three.discrete_part[0]) == 3


def test_a_density_has_any_scale(folder):
    gradings = []
    for scale in ("", "e308", "e-300"):
        content = f"1,1{scale}\n2,1.5{scale}\n3,0.5{scale}\n"
        gradings.append(grading_of(of_file("density", content, folder)))
    first, *others = (grading.mass_ppf([0.1, 0.5, 0.9]) for grading in gradings)
    for other in others:
        assert other == pytest.approx(first, rel=1e-12)


@pytest.mark.parametrize("cell", ['"' + "1" * 140_000 + '"', "x" * 5_000_000, "1," * 20_000])
def test_a_line_longer_than_any_of_a_table_is_named_not_repeated(folder, cell):
    section = of_file("sieve", f"size,finer\n1,0\n{cell},50\n3,100\n", folder)
    (line,) = lines_of(study_of(grading=section, allow_unrepresentative=True))
    assert "sand.csv, line 3: has" in line and "characters" in line
    assert len(line) < 300


def test_what_is_quoted_of_wrong_lines_is_cut(folder):
    cell = "x" * 15_000
    content = "1,0\n" + f"2,{cell}\n" * 1000 + "3,100\n"
    lines = lines_of(
        study_of(grading=of_file("sieve", content, folder), allow_unrepresentative=True)
    )
    assert sum(map(len, lines)) < 50_000
    assert lines[-1].endswith("and 980 more problems")


def test_a_file_larger_than_any_table_is_refused_before_it_is_read(folder, monkeypatch):
    monkeypatch.setattr(decoding, "_LARGEST", 1000)
    section = of_file("sieve", "1,0\n" + "2,50\n" * 300 + "3,100\n", folder)
    (line,) = lines_of(study_of(grading=section, allow_unrepresentative=True))
    assert "has more than the 0.001 MB that a table may have: write it with fewer" in line


def test_a_configuration_larger_than_any_study_is_refused_before_it_is_parsed(tmp_path):
    path = tmp_path / "config.yaml"
    path.write_text("samples: [" + "1, " * 1_000_000 + "1]\n")
    assert "has more than the 0.5 MB that it may have: put lists" in config_file_problem(path)


@pytest.mark.parametrize("section", ["samples", "measured"])
def test_names_that_differ_in_capitals_only_are_refused(folder, section):
    study = study_of()
    ends = {"size": "diameter", "unit": "mm", "value": 0.02}
    material = {"before": UNIFORM, "after": {**UNIFORM, "min": 0.1}, "ultimate_smallest": ends}
    study.setdefault(section, {})
    study[section] |= {name: SAMPLE if section == "samples" else material for name in ("Oo", "oO")}
    lines = lines_of(study)
    assert any("Oo and oO differ in capitals only" in line for line in lines)


def test_other_names_stand_beside_each_other(folder):
    checked_study({"samples": {"a": SAMPLE, "a2": SAMPLE}})


def test_a_file_whose_name_is_a_pattern_of_snakemake_is_refused(folder):
    (folder / "sand{x}.csv").write_text("1,0\n2,60\n3,100\n")
    grading = {**SIEVE, "file": "sand{x}.csv"}
    (line,) = lines_of(study_of(grading=grading, allow_unrepresentative=True))
    assert "sand{x}.csv': has braces" in line and line.endswith("give the file another name")
