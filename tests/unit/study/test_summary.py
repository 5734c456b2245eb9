"""What a run came to, in a line for each sample."""

import pytest

from branchcrush.files.tables import provenance, write_table
from branchcrush.study.summary import summary

ROW = {
    "sample": "paper",
    "verdict": "certified with notes",
    "exponent": 3.111,
    "exponent_low": 2.99,
    "exponent_high": 3.24,
    "confidence": 0.95,
    "seeds": 16,
    "seeds_certified": 15,
    "solid_fraction": 0.7407,
    "reason": None,
}
EMPTY = dict.fromkeys(("exponent", "exponent_low", "exponent_high", "confidence", "solid_fraction"))


@pytest.fixture
def written(tmp_path):
    def lines(*rows):
        write_table(tmp_path / "comparison.csv", rows, provenance())
        return summary(tmp_path).splitlines()

    return lines


def test_sample_has_its_verdict_exponent_interval_and_the_seeds_behind_it(written):
    assert written(ROW)[0] == (
        "paper: certified with notes, n = 3.11, with 95 % confidence between 2.99 and 3.24 "
        "(15 packings), at solid fraction 0.741"
    )


def test_one_seed_has_no_interval(written):
    line = written({**ROW, "exponent_low": None, "exponent_high": None, "seeds_certified": 1})[0]
    told = "n = 3.11 (one packing: no interval), at solid fraction 0.741"
    assert line == f"paper: certified with notes, {told}"


def test_sample_without_data_says_why(written):
    loose = {**ROW, **EMPTY, "sample": "loose", "verdict": "not certified", "reason": "no load"}
    lines = written(ROW, loose)
    assert lines[0].startswith("paper: certified with notes, n = 3.11, ")
    assert lines[1] == "loose: not certified, no exponent: no load"


def test_what_takes_the_certificate_away_stands_behind_the_verdict(written):
    row = {**ROW, "verdict": "not certified", "verdict_reasons": "the stress has not converged"}
    assert written(row)[0].startswith("paper: not certified (the stress has not converged), n = ")


def test_model_without_data_leaves_the_exponent(written):
    assert "n = 3.11" in written({**ROW, "reason": "no elastic law"})[0]


def test_report_and_figures_are_named(written, tmp_path):
    assert written(ROW)[1:] == [
        f"report:   {tmp_path / 'report.html'}",
        f"figures:  {tmp_path / 'figures'}",
    ]


def test_folder_is_named_as_its_reader_sees_it(tmp_path):
    write_table(tmp_path / "comparison.csv", [ROW], provenance())
    assert summary(tmp_path, shown_as="sand/results").splitlines()[1:] == [
        "report:   sand/results/report.html",
        "figures:  sand/results/figures",
    ]
