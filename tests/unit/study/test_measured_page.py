"""The page of measured materials: numbers, what is not determined, and why there is no fit."""

import re
from pathlib import Path

import pytest

from branchcrush.gradings.forms import uniform
from branchcrush.samples.measured import breakage_results
from branchcrush.study.measured_page import MeasuredPage, render_measured
from branchcrush.study.templates import page_template
from tests.unit.study.pictures import write_picture

ROOT = Path(__file__).parents[3]
TEMPLATE = page_template(ROOT / "workflow/report/measured.html.jinja", ROOT / "docs/glossary.md")
WAY = {"ultimate_alpha": 2.6, "ultimate_smallest": 1e-5}
FIT = {
    "points": 12,
    "confidence": 0.95,
    "better_resistance": "critical_energy",
    "elastic_strain": 0.0125,
    "elastic_strain_low": 0.011,
    "elastic_strain_high": 0.014,
    "elastic_strain_determined": True,
    "strength_exponent": 1.5,
    "strength_exponent_low": None,
    "strength_exponent_high": None,
    "strength_exponent_determined": False,
    "critical_energy_J_per_m3": 2.0e6,
    "critical_energy_low_J_per_m3": 1.0e6,
    "critical_energy_high_J_per_m3": 4.0e6,
    "critical_energy_determined": True,
    "hardening_exponent": 2.0,
    "hardening_exponent_low": 1.9,
    "hardening_exponent_high": 2.1,
    "hardening_exponent_determined": True,
    "sentences": ["The curve does not determine b & more."],
    "remarks": ["line 2 is without stress"],
} | {
    f"{name}_{what}": value
    for name in ("elastic_strain_limit", "critical_energy")
    for what, value in (("correlation", None), ("residual", 0.002), ("crushing_at_end", 0.3))
}


@pytest.fixture(scope="module")
def figure(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "figure.png"
    write_picture(path)
    return path


@pytest.fixture(scope="module")
def breakages():
    before, after = uniform(0.5e-3, 1e-3, "mass"), uniform(0.05e-3, 1e-3, "mass")
    return [breakage_results(before, grading, **WAY) for grading in (after, None)]


def text(page):
    return " ".join(re.sub(r"<[^>]+>", " ", page.partition("<body>")[2]).split())


def test_breakage_and_fit_are_on_the_page(breakages, figure):
    page = render_measured(TEMPLATE, [MeasuredPage("sand", breakages[0], figure, FIT, figure)])
    said = text(page)
    # By hand: <log10 D> of two uniform curves, 2 and 1.47 decades above 0.074 mm.
    assert "Hardin's B r 0.179" in said
    assert f"Einav's B {breakages[0]['einav_breakage']:.3f}" in said
    assert "0.0125 (0.011 to 0.014)" in said
    assert "1.50 (not determined)" in said
    assert "2 (1 to 4)" in said
    assert "that of the critical energy" in said
    assert "does not determine b &amp; more." in page
    assert page.count("data:image/png;base64,") == 2


def test_without_a_grading_after_the_test_there_is_no_table_of_breakage(breakages, figure):
    said = text(render_measured(TEMPLATE, [MeasuredPage("sand", breakages[1], figure)]))
    assert "Hardin's B" not in said and "Resistance" not in said.replace("resistance to", "")
    assert "No grading after the test is given" in said


def test_a_curve_that_cannot_be_fitted_says_why(breakages, figure):
    fit = {"reason": "4 points are needed", "remarks": []}
    page = render_measured(TEMPLATE, [MeasuredPage("sand", breakages[0], figure, fit, figure)])
    assert "No resistance: 4 points are needed." in text(page)
