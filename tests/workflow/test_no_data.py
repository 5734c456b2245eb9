"""Samples that give no data: the study goes on, and every page says why."""

import re

import pytest
from matplotlib import image

from branchcrush.files.dictionary import result_files
from branchcrush.files.tables import read_json, read_table
from branchcrush.study.summary import summary
from tests.pages import lost_links, said

NO_DATA = """\
samples:
  alike:
    grading: {form: single, size: diameter, unit: mm, value: 1}
    grains: 40
    allow_unrepresentative: true
    boundary: periodic
    contact: {law: hertz, young_modulus: 7.0e+10, poisson_ratio: 0.2}
    loading:
      mean_stress: {from: 1.0e+6, to: 1.0e+7, states: 2}
      approach_solid_fraction: 0.5
      unloading: true
      quality: draft
    seeds: 1
    refined_seeds: 0
  loose:
    grading: {form: uniform, basis: mass, size: radius, unit: mm, min: 0.2, max: 1}
    grains: 40
    allow_unrepresentative: true
    boundary: periodic
    loading: {solid_fraction: 0.5, approach_solid_fraction: 0.4, states: 2, unloading: true,
      quality: draft}
    seeds: 1
    refined_seeds: 0
figures: {dpi: 60}
"""
ONE_LENGTH = "a power law needs finite energy at two or more branch lengths"
NO_LOAD = (
    "no packing is certified at the end of its loading: 0 of 1 carry load there, at a solid "
    "fraction of 0.5000"
)


@pytest.fixture(scope="module")
def no_data(new_project, tmp_path_factory):
    """Grains of one length of branch, and grains that never carry load: run to the end as well."""
    study = new_project(tmp_path_factory.mktemp("no_data"))
    study.configure(NO_DATA)
    run = study.snakemake()
    assert run.returncode == 0, run.stdout + run.stderr
    return study.folder / "results"


def test_a_stress_path_goes_to_every_stress_and_back(no_data):
    path = read_table(no_data / "alike/seed_1/path.csv")
    assert path["leg"].tolist() == ["loading"] * 4 + ["unloading"]
    assert path["mean_stress_Pa"].iloc[2:].tolist() == pytest.approx([1e6, 1e7, 1e6], rel=0.01)
    states = read_table(no_data / "alike/certificate.csv")
    assert states["certified"].tolist() == [False, False, True, True, True]
    jamming = read_table(no_data / "alike/jamming.csv").iloc[0]
    way_in, way_back = jamming.filter(like="jamming_solid_fraction")
    assert 0.5 < way_in < path["solid_fraction"][2]
    assert way_back == pytest.approx(way_in, abs=0.01)
    unloading = read_json(no_data / "alike/certificate.json")["unloading"]
    assert 0 < unloading["work_returned_share"] < unloading["energy_returned_share"] <= 1 + 1e-6


def test_samples_without_data_say_why_and_the_study_goes_on(no_data):
    table = read_table(no_data / "comparison.csv").set_index("sample")
    assert table["reason"].to_dict() == {"alike": ONE_LENGTH, "loose": NO_LOAD}
    assert table["verdict"].to_dict() == {"alike": "certified with notes", "loose": "not certified"}
    assert table[["exponent", "theta"]].isna().all(axis=None)
    assert table["seeds_certified"].to_dict() == {"alike": 1, "loose": 0}
    for name, text in (("alike", ONE_LENGTH), ("loose", NO_LOAD)):
        for kind in ("energy_split", "thermodynamics"):
            assert read_json(no_data / name / f"{kind}.json")["reason"] == text
            assert read_table(no_data / name / f"{kind}.csv")["reason"].tolist() == [text]
        assert read_table(no_data / name / "crushing_forms.csv")["reason"].tolist() == [text]
    # Grains of one size still have branches.
    assert read_table(no_data / "alike/branch_lengths.csv")["branches"].sum() > 40
    assert read_json(no_data / "loose/branch_lengths.json")["reason"] == NO_LOAD
    assert summary(no_data).splitlines()[:2] == [
        f"alike: certified with notes, no exponent: {ONE_LENGTH}",
        f"loose: not certified, no exponent: {NO_LOAD}",
    ]


def test_the_report_shows_the_reasons_and_the_figures_that_there_are(no_data):
    page = (no_data / "report.html").read_text(encoding="utf-8")
    for text in (ONE_LENGTH, NO_LOAD):
        assert f"No exponent: {text}." in page
        assert f"No curves: {text}." in page
    assert "1 of 1 packings carry no load at the end of their loading" in page
    # Grading, packing and path of both; certificate, branches, network of the grains of one size.
    assert page.count("data:image/png;base64,") == 10 + 6
    assert not re.search(r"\bnan\b|\bNone\b|https?://", said(page))
    assert lost_links(no_data / "report.html") == []
    for name, number in (("alike", 18), ("loose", 18), ("findings", 6)):
        figures = list((no_data / "figures" / name).glob("*.png"))
        assert len(figures) == number
        for figure in figures:
            assert (image.imread(figure)[..., :3].min(axis=-1) < 0.9).any(), figure


def test_findings_keep_what_grains_of_one_size_do_tell(no_data):
    rows = read_table(no_data / "findings.csv").set_index("sample")
    assert rows["reason"].to_dict() == {"alike": ONE_LENGTH, "loose": NO_LOAD}
    assert 4 < rows.loc["alike", "coordination_number_end"] < 14
    assert rows.loc["alike", "sharing_index"] == pytest.approx(0, abs=1e-9)
    known = ["boundary", "contact_law", "verdict", "verdict_reasons", "reason"]
    assert rows.loc["loose"].drop(known).isna().all()
    assert rows.loc["loose", "verdict"] == "not certified"
    page = (no_data / "report.html").read_text(encoding="utf-8")
    assert f"Not all is known of loose: {NO_LOAD}." in page
    assert not re.search(r"\bnan\b|\bNone\b|https?://", said(page))


def test_the_dictionary_knows_what_is_said_without_data_and_of_the_way_back(no_data):
    for path in (*no_data.rglob("*.csv"), *no_data.rglob("*.json")):
        name = path.relative_to(no_data).as_posix()
        file = next(file for file in result_files() if file.matches(name))
        known = {column.name.partition(".")[0] for column in file.columns()}
        there = read_json(path) if path.suffix == ".json" else read_table(path)
        if name != "datapackage.json":
            assert set(there) - {"provenance"} <= {one.removesuffix("[]") for one in known}, name
    way_back = read_json(no_data / "alike/certificate.json")["unloading"]
    certificate = next(file for file in result_files() if file.matches("alike/certificate.json"))
    assert {f"unloading.{key}" for key in way_back} <= {c.name for c in certificate.columns()}
