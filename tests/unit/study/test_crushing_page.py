"""The page of grains that break: sentences of the run's own numbers, and where there is nothing."""

import re
from pathlib import Path

import pytest

from branchcrush.files.tables import read_json, write_json
from branchcrush.study.crushing_page import CrushingPage, form_rows, leads, render_crushing
from branchcrush.study.templates import page_template
from tests.unit.samples.test_crushed import results
from tests.unit.study.pictures import write_picture

ROOT = Path(__file__).parents[3]
TEMPLATE = page_template(ROOT / "workflow/report/crushing.html.jinja", ROOT / "docs/glossary.md")
FIGURES = ("crushed_line", "crushed_gradings", "crushed_energy", "crushed_predicted", "who_breaks")


PREDICTED = {"reason": None, "sentences": ["It predicts within 20 %.", "There are walls."]}


@pytest.fixture(scope="module")
def figures(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "figure.png"
    write_picture(path)
    return dict.fromkeys(FIGURES, path)


@pytest.fixture(scope="module")
def crushed():
    return results(broken=(0, 0, 8, 16, 24, 40))


def page_of(result, figures, folder, predicted=PREDICTED):
    # As the script reads it: what is not known is null.
    write_json(folder / "crushing.json", result.summary, {})
    summary = read_json(folder / "crushing.json")
    page = CrushingPage("sand", summary, figures, result.means, result.beside, (), predicted)
    return render_crushing(TEMPLATE, [page])


def text(page):
    return " ".join(re.sub(r"<[^>]+>", " ", page.partition("<body>")[2]).split())


def test_each_figure_has_its_sentence_with_the_numbers_of_the_run(crushed, figures, tmp_path):
    page = page_of(crushed, figures, tmp_path)
    said = text(page)
    # The run is on e ~ p^-0.5, half of its mass is broken, 40 grains and 320 halves are left.
    assert "Beyond yield −d ln e/d ln p is 0.50; the" in said
    assert "b = 1, says 1/(2b) = 0.50" in said
    assert "50 % of the mass is in fragments, and 360 grains" in said
    assert "The split of the work is not checked" in said
    # Under each figure, also under one that has no sentence of its own.
    assert said.count("Comminution limit 0.25 mm; 2 seeds, none of them also") == 6
    assert page.count("data:image/png;base64,") == len(FIGURES)
    assert page.index('alt="crushed line"') < page.index('alt="who breaks"')
    assert "ε 0 = 1.25 %" in said


def test_forms_are_told_over_what_was_simulated(crushed):
    rows = {row["label"]: row for row in form_rows(crushed.means, crushed.beside)}
    last, told = crushed.means.iloc[-1], crushed.beside.groupby("form").last()
    paper = rows["paper, no branch density"]
    assert paper["stress"] == told.loc["paper", "stress_Pa"] / last["mean_stress_Pa"]
    assert paper["crushing"] == told.loc["paper", "crushing"]


def test_what_is_predicted_without_a_simulation_stands_with_its_errors_or_the_reason(
    crushed, figures, tmp_path
):
    page = page_of(crushed, figures, tmp_path)
    assert "It predicts within 20 %. There are walls." in text(page)
    assert "strengths alone: above, with the errors." in text(page)
    assert page.count('<figure class="wide"') == 2
    none = {"reason": "why", "sentences": ["Nothing is predicted: why."]}
    page = page_of(crushed, figures, tmp_path, none)
    assert "Nothing is predicted: why." in text(page)
    assert "strengths alone: not here; why stands above." in text(page)
    # A sentence needs no wide figure, of which a narrow screen shows a part.
    assert page.count('<figure class="wide"') == 1


def test_how_long_branches_are_is_told_beside_the_predictions(crushed):
    said = leads(crushed.summary)["crushed_lengths"]
    assert "a branch is 1.35 times as long as the mean grain diameter" in said
    assert re.search(r"rods that push say 1\.\d\d\.$", said)
    unknown = {**crushed.summary, "final_branch_over_diameter_by_rods": None}
    assert leads(unknown)["crushed_lengths"].endswith("says 1 of every grading.")


def test_a_form_that_says_nothing_of_the_end_has_no_row(crushed):
    beside = crushed.beside.copy()
    numbers = ["crushing", "stress_Pa", "dissipated_J_per_m3"]
    beside.loc[beside["form"] == "paper", numbers] = float("nan")
    labels = {row["label"] for row in form_rows(crushed.means, beside)}
    assert labels == {row["label"] for row in form_rows(crushed.means, crushed.beside)} - {
        "paper, no branch density"
    }


def test_where_no_grain_broke_the_page_says_so_and_shows_no_numbers(figures, tmp_path):
    said = text(page_of(results(broken=(0,) * 6), figures, tmp_path))
    assert "No grain broke: there is no breakage" in said
    assert "nan" not in said and "None" not in said
    assert "What the branch-length model predicts" not in said


def test_an_exponent_that_is_not_known_is_left_out(crushed):
    summary = {**crushed.summary, "number_exponent": None, "slope_by_number_exponent": None}
    assert "(3 − α)/b" not in leads(summary)["crushed_line"]
    assert "α" not in leads(summary)["crushed_gradings"]


def test_an_interval_is_told_unless_it_rounds_to_its_number(crushed):
    ends = {"final_grains_low": 350.0, "final_grains_high": 370.0}
    said = leads({**crushed.summary, **ends})["crushed_packing"]
    assert "to 360 (350 to 370) grains" in said
    said = leads({**crushed.summary, **dict.fromkeys(ends, 360.2)})["crushed_packing"]
    assert "to 360 grains" in said
