"""The page of grains that break: sentences of the run's own numbers, and where there is nothing."""

import re
from pathlib import Path

import pytest

from branchcrush.files.tables import read_json, write_json
from branchcrush.study.crushing_page import CrushingPage, form_rows, leads, render_crushing
from branchcrush.study.pages import page_template
from tests.unit.samples.test_crushed import results

ROOT = Path(__file__).parents[3]
TEMPLATE = page_template(ROOT / "workflow/report/crushing.html.jinja", ROOT / "docs/glossary.md")
FIGURES = ("crushed_line", "crushed_gradings", "crushed_energy", "who_breaks")


@pytest.fixture(scope="module")
def figures(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "figure.png"
    path.write_bytes(b"png")
    return dict.fromkeys(FIGURES, path)


@pytest.fixture(scope="module")
def crushed():
    return results(broken=(0, 0, 8, 16, 24, 40))


def page_of(result, figures, folder):
    # As the script reads it: what is not known is null.
    write_json(folder / "crushing.json", result.summary, {})
    summary = read_json(folder / "crushing.json")
    page = CrushingPage("sand", summary, figures, result.means, result.beside)
    return render_crushing(TEMPLATE, [page])


def text(page):
    return " ".join(re.sub(r"<[^>]+>", " ", page.partition("<body>")[2]).split())


def test_each_figure_has_its_sentence_with_the_numbers_of_the_run(crushed, figures, tmp_path):
    page = page_of(crushed, figures, tmp_path)
    said = text(page)
    # The run is on e ~ p^-0.5, half of its mass is broken, 40 grains and 320 halves are left.
    assert "Beyond yield −d ln e/d ln p is 0.50 (0.50 to 0.50)" in said
    assert "b = 1, says 1/(2b) = 0.50" in said
    assert "50 (50 to 50) % of the mass is in fragments, and 360 (360 to 360) grains" in said
    assert "The split of the work is not checked" in said
    # Under each figure, also under one that has no sentence of its own.
    assert said.count("Comminution limit 0.25 mm; 2 seeds, none of them also") == 5
    assert page.count("data:image/png;base64,") == len(FIGURES)
    assert page.index('alt="crushed line"') < page.index('alt="who breaks"')
    assert "ε 0 = 1.25 %" in said


def test_forms_are_told_over_what_was_simulated(crushed):
    rows = {row["label"]: row for row in form_rows(crushed.means, crushed.beside)}
    last, told = crushed.means.iloc[-1], crushed.beside.groupby("form").last()
    paper = rows["paper, no branch density"]
    assert paper["stress"] == told.loc["paper", "stress_Pa"] / last["mean_stress_Pa"]
    assert paper["crushing"] == told.loc["paper", "crushing"]


def test_where_no_grain_broke_the_page_says_so_and_shows_no_numbers(figures, tmp_path):
    said = text(page_of(results(broken=(0,) * 6), figures, tmp_path))
    assert "No grain broke: there is no breakage" in said
    assert "nan" not in said and "None" not in said
    assert "What the branch-length model predicts" not in said


def test_an_exponent_that_is_not_known_is_left_out(crushed):
    summary = {**crushed.summary, "number_exponent": None, "slope_by_number_exponent": None}
    assert "(3 − α)/b" not in leads(summary)["crushed_line"]
    assert "α" not in leads(summary)["crushed_gradings"]
