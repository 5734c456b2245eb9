"""The page of all samples: what it says of samples with a path, of one state, and of none."""

import html
import re
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from branchcrush.statistics.intervals import Interval
from branchcrush.study.findings import finding_row
from branchcrush.study.pages import render_findings
from branchcrush.study.templates import page_template
from tests.unit.study.pictures import write_picture

TEMPLATE = Path(__file__).parents[3] / "workflow" / "report" / "together.html.jinja"
GLOSSARY = TEMPLATE.parents[2] / "docs" / "glossary.md"
FIGURES = ("exponents", "lengths", "energies", "coordination", "shielding", "forces")
INTERVALS = {"confidence": 0.95, "resamples": 100}


@pytest.fixture
def page(tmp_path):
    """Return a function that renders samples and returns the words of the page."""
    image = tmp_path / "figure.png"
    write_picture(image)

    def render(*samples, distance=0.1):
        rows = pd.DataFrame([finding_row(sample, distance, INTERVALS) for sample in samples])
        source = render_findings(
            page_template(TEMPLATE, GLOSSARY), rows, dict.fromkeys(FIGURES, image)
        )
        assert not re.search(r"\b(nan|None|NaN|Undefined)\b", source)
        assert source.count("<table") == source.count("</table>")
        figures = [f'<img alt="{alt}">' for alt in re.findall(r'alt="([^"]+)"', source)]
        words = re.sub(r"<style.*?</style>|<[^>]+>", " ", source, flags=re.S)
        return re.sub(r"\s+", " ", html.unescape(words)) + " ".join(figures)

    return render


def test_each_sample_is_counted_and_named_where_its_interval_lies(page, sample):
    text = page(
        sample("a"),
        sample("b", n=(2.5, 2.4, 2.6)),
        sample("c", n=(2.6, 2.5, 2.7)),
        sample("d", n=(3.0, 1.0, 5.0)),
    )
    assert (
        "at the end of the loading it holds 3 in 1 (a), lies below 3 in 2 (b, c), "
        "is too wide to tell in 1 (d)."
    ) in text
    assert (
        "Of 4 certified samples with data, the interval of n at φ − φ J = 0.10 holds 3 in 4" in text
    )
    # No counts of nothing.
    assert not re.search(r"\bin 0\b|\b0 of\b", text)


def test_many_samples_are_counted_and_not_named(page, sample):
    text = page(*(sample(f"s{k}") for k in range(8)))
    assert "holds 3 in 8 (8 of the table below)" in text


def test_one_state_says_what_it_can_and_cannot_tell(page, one_state):
    text = page(one_state("alone"), distance=float("nan"))
    assert "Of alone there is one loaded state, the end" in text
    assert "whether n grows with compaction" in text and "loading.mean_stress" in text
    assert (
        "Of 1 certified sample with data, the interval of n at the end of the loading holds 3"
        in text
    )
    assert "first state in which every packing carries load" not in text
    assert "where no certified sample has a state" in text
    assert 'alt="branch lengths"' not in text and 'alt="exponents"' in text
    assert not re.search(r"n at none|= none|\bin 0\b|\b0 of\b", text)


def test_one_state_beside_a_path_leaves_that_its_numbers(page, sample, one_state):
    text = page(sample("path"), one_state("alone"))
    assert "Of alone there is one loaded state" in text
    assert "at φ − φ J = 0.10 holds 3 in 1 (path)" in text
    assert "measured ones in 1 of 1 certified sample." in text
    assert 'alt="branch lengths"' in text


def test_claims_are_counted_by_their_answers(page, sample):
    text = page(
        sample("a", claim="contradicted", branch_claim="supported"),
        sample("b", branch_claim="undecided"),
    )
    assert "Per contact: contradicted in 1 (a), no such grain in 1 (b); per grain: contr" in text
    assert "less than a tenth in 1 (a), too few to tell in 1 (b)." in text


def test_bad_lengths_are_named(page, sample):
    text = page(sample("good"), sample("bad", parking=0.1))
    assert "measured ones in 1 of 2 certified samples (not in bad). By rods that push" in text
    assert "which have none either, they are in none of 2." in text


def test_what_is_not_certified_is_shown_named_and_not_counted(page, sample):
    text = page(
        sample("good"),
        sample("noted", verdict="certified with notes", parking=0.1),
        sample("bad", verdict="not certified", n=(2.5, 2.4, 2.6), parking=0.2, claim="undecided"),
    )
    assert "3 samples, 2 of them certified, with notes or without, and with data" in text
    assert "good certified noted certified with notes bad not certified seed 2: stopped" in text
    assert "Not certified, and therefore in no count below: bad, since numbers of" in text
    assert "Of 2 certified samples with data, the interval of n" in text
    assert "it holds 3 in 2 (good, noted). A power law" in text
    assert "contradicted, by the curvature of ln E in ln l at the end, in 2 of 2." in text
    assert "in 2 of 2 certified samples; Einav" in text
    assert "Best of the five: reduced radius in 2 (good, noted)." in text
    assert "in 1 of 2 certified samples (not in noted)." in text
    assert "undecided in" not in text
    # In each table it is there all the same, and marked.
    assert text.count("bad (not certified)") == 6
    assert "bad (not certified) 3 3.00 (2.90 to 3.10) 2.50 (2.40 to 2.60)" in text


def test_samples_without_a_best_predictor_are_named(page, sample):
    one_seed = sample("alone")
    end = one_seed.fit.end
    nothing = Interval(*3 * [float("nan")])
    predictors = tuple(replace(each, explained=nothing) for each in end.predictors)
    fit = replace(one_seed.fit, end=replace(end, predictors=predictors))
    text = page(sample("a"), replace(one_seed, fit=fit))
    assert "reduced radius in 1 (a); in 1 (alone) no single one, as two explain the same" in text
    assert "no single one" not in page(sample("a"))


def test_of_certified_samples_nothing_is_said_of_the_others(page, sample):
    text = page(sample("a"), sample("b", verdict="certified with notes"))
    assert "ot certified" not in text and "what takes it away" not in text


def test_without_a_certified_sample_nothing_is_counted(page, sample):
    text = page(sample("bad", verdict="not certified"))
    assert "1 sample, 0 of them certified" in text
    assert text.count("No certified sample has data: nothing is counted.") == 3
    assert "where no certified sample has a state" in text
    assert "bad (not certified) 3" in text
    assert not re.search(r"\bin 0\b|\b0 of [0-9]|in none of", text)


def test_a_second_solution_of_random_parking_is_named(page, sample):
    text = page(sample("sand"), sample("gap", solutions=2))
    assert "Of gap random parking has two solutions; the coarse one is shown" in text
    assert "The other has κ = 5.80 and 0.04 rattlers." in text
    assert "Of sand random" not in text


def test_a_study_without_any_number_says_why():
    columns = {"verdict": ["not certified"], "verdict_reasons": ["2 packings carry no load"]}
    rows = pd.DataFrame({"sample": ["loose"], "reason": ["no load"], **columns})
    source = render_findings(page_template(TEMPLATE, GLOSSARY), rows, {})
    assert "Not all is known of loose: no load." in source
    assert "2 packings carry no load" in source
    assert "1. Where n" not in source
