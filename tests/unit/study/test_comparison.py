"""The row of a sample in the table of all: its numbers, or why there are none."""

import pytest

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.study.comparison import comparison_row

CERTIFICATE = {
    "verdict": "certified with notes",
    "reasons": [],
    "seeds": 4,
    "seeds_certified": 3,
    "jamming_solid_fraction": 0.63,
    "jamming_solid_fraction_scatter": 0.002,
    "jamming_uncertainty": 0.0004,
    "dissipated_share_at_end": 0.15,
    "force_evaluations": 69000.0,
}
EXPECTED = {
    "sample": "paper",
    "verdict": "certified with notes",
    "verdict_reasons": None,
    "exponent": 3.0,
    "exponent_low": 2.9,
    "exponent_high": 3.1,
    "confidence": 0.95,
    "seeds": 4,
    "seeds_certified": 3,
    "branches": 4321,
    "solid_fraction": 0.7407,
    "jamming_solid_fraction": 0.63,
    "jamming_scatter_of_seeds": 0.002,
    "jamming_uncertainty_of_one": 0.0004,
    "mean_stress_Pa": 5.6e7,
    "elastic_energy_J_per_m3": 1e6,
    "median_overlap_over_length": 0.02,
    "coordination_number": 6.5,
    "mechanical_coordination_number": 7.5,
    "rattler_fraction": 0.12,
    "dissipated_share": 0.15,
    "theta": 0.89,
    "form": "moving_jamming",
    "admissible": False,
    "inadmissible_from": 0.55,
    "force_evaluations": 69000.0,
    "reason": None,
}
MODEL = {
    "theta": 0.89,
    "form": "moving_jamming",
    "form_reason": None,
    "admissible": False,
    "inadmissible_from": 0.55,
}


def test_row_holds_the_results_beside_the_verdict(sample):
    row = comparison_row("paper", sample().fit, MODEL, CERTIFICATE)
    assert row == EXPECTED
    assert list(row) == list(EXPECTED)


def test_row_of_a_sample_without_data_has_its_reason_and_the_same_columns():
    fit = EnergySplitFit.read({"reason": "no load"})
    row = comparison_row("loose", fit, {"reason": "no model"}, CERTIFICATE)
    assert row["reason"] == "no load"
    assert (row["seeds"], row["seeds_certified"]) == (4, 3)
    for name in ("theta", "branches", "mean_stress_Pa"):
        assert row[name] is None
    assert row["exponent"] != row["exponent"]
    assert list(row) == list(EXPECTED)


def test_row_with_an_exponent_but_no_model_says_why_there_is_no_theta(sample):
    row = comparison_row("paper", sample().fit, {"reason": "no elastic law"}, CERTIFICATE)
    assert (row["exponent"], row["theta"]) == (pytest.approx(3.0), None)
    assert row["reason"] == "no elastic law"


def test_row_without_the_form_on_the_front_says_why(sample):
    model = {**MODEL, "form": "paper", "form_reason": "coarser"}
    assert comparison_row("paper", sample().fit, model, CERTIFICATE)["reason"] == "coarser"


def test_what_takes_the_certificate_away_is_told_beside_the_verdict():
    withheld = {**CERTIFICATE, "verdict": "not certified", "reasons": ["too few", "too fast"]}
    row = comparison_row("paper", EnergySplitFit.read({"reason": "no load"}), {}, withheld)
    assert row["verdict_reasons"] == "too few; too fast" and row["reason"] == "no load"
