"""The report: samples with data, without any, with some, and of one state."""

import re
from dataclasses import replace

import pytest

from branchcrush.crushing.paper_form import admissibility_problem
from branchcrush.statistics.intervals import Interval
from tests.unit.study.pictures import write_picture
from tests.unit.study.report_parts import (
    FIGURES,
    GRADING,
    NO_FIT,
    NOTHING,
    REASON,
    STANDING,
    rendering,
    whole_fit,
)


@pytest.fixture
def fit(sample):
    return whole_fit(sample)


@pytest.fixture
def page(tmp_path, fit):
    return rendering(tmp_path, fit)


def test_page_shows_exponent_verdict_and_all_figures(page):
    html = page({})
    assert "n = 3.11 (95% interval 2.99 to 3.24) at &phi; = 0.741" in html
    assert ">Quality: certified<" in html
    assert html.count("data:image/png;base64,") == len(FIGURES)
    assert "No exponent" not in html


def test_page_links_to_that_of_measured_materials_where_there_is_one(page):
    assert "measured.html" not in page({})
    assert '<a href="measured.html">' in page({}, measured=True)


def test_page_links_to_that_of_grains_that_break_where_there_are_any(page):
    assert "crushing.html" not in page({})
    breaking = {"settings": {"breakage": {"strength": 2e7}}}
    assert '<a href="crushing.html">' in page({"name": "rock"}, {"name": "sand", **breaking})


def test_page_of_a_sample_without_data_says_why_and_shows_what_there_is(page):
    html = page({"fit": NO_FIT, "model": REASON, "statistics": REASON, "certificate": NOTHING})
    for part in ("No exponent", "No branches", "No curves"):
        assert f'<p class="note">{part}: {REASON["reason"]}.</p>' in html
    assert "<li>4 of 4 packings carry no load at the end of their loading</li>" in html
    for figure in ("grading", "packing", "loading path"):
        assert f'alt="{figure}"' in html
    for figure in ("certificate", "energy split", "branch lengths", "compression line"):
        assert f'alt="{figure}"' not in html


def test_sample_without_data_leaves_the_others_theirs(page):
    loose = {"name": "loose", "fit": NO_FIT, "model": REASON, "certificate": NOTHING}
    html = page({}, loose)
    assert '<td class="certified">certified</td> <td>3.11 (2.99 to 3.24)</td>' in html
    assert '<td class="not-certified">not certified</td> <td>none</td><td>0 of 4</td>' in html


def test_one_size_has_branches_but_no_exponent(page):
    html = page({"fit": NO_FIT, "settings": {"grading": {"form": "single"}}})
    assert "1000 grains of form single (one size)" in html
    assert 'alt="branch lengths"' in html
    assert 'alt="energy split"' not in html


def test_one_seed_has_no_interval(page, fit):
    alone = replace(fit, exponent=Interval(3.111, float("nan"), float("nan")))
    assert "n = 3.11 (one seed: no interval)" in page({"fit": alone})


def test_predictors_are_told_with_what_they_explain_or_why_they_do_not(page):
    html = page({})
    for cells in (
        "<td>branch length</td><td>formula</td> <td>3.10</td> <td>0.160 (0.150 to 0.180)</td>",
        "<td>reduced radius</td><td>formula</td> <td>2.80</td> <td>0.190 (0.180 to 0.210)</td>"
        "<td>0.030 (0.020 to 0.050)</td>",
        '<td>surface</td><td>quadratic</td> <td colspan="3">not told apart</td>',
    ):
        assert cells in html
    assert "All branches fitted at once: n = 3.10." in html
    assert "is 0.50 (0.40 to 0.70)." in html


def test_why_nothing_is_left_out_stands_in_place_of_what_is_explained(page, fit):
    length = replace(fit.end.predictors[0], left_out_reason="needs two seeds")
    html = page({"fit": replace(fit, end=replace(fit.end, predictors=(length,)))})
    assert "<td>needs two seeds</td>" in html


def test_what_n_is_a_mixture_of_is_said(page, fit):
    html = page({})
    assert "q = 2.60 (2.50 to 2.80); and at equal length unequal grains share less" in html
    assert "t = 3.20 (3.10 to 3.40), which is 1 for equal radii." in html
    # 3.111 less 2.6.
    assert "n differs from q: here by +0.51." in html
    assert (
        "the local exponent is 2.40 (2.30 to 2.60), 3.80 (3.70 to 4.00), 2.20 (2.10 to 2.40): it "
        "rises and then falls. At equal ratio it is 3.00 (2.90 to 3.20), 2.90 (2.80 to 3.10), 2.90 "
        "(2.80 to 3.10): it does not change by more than the intervals allow." in html
    )
    for words, n in (
        ("gamma regression of all branches", "3.12 (3.02 to 3.32)"),
        ("least squares on f(l), as the paper", "2.95 (2.85 to 3.15)"),
        ("straight line through ln f and ln l, unweighted", "2.74 (2.64 to 2.94)"),
    ):
        assert re.search(rf"<td>{re.escape(words)}[^<]*</td><td>{re.escape(n)}</td>", html)


def test_one_ratio_or_two_lengths_say_what_cannot_be_told(page, fit):
    end = replace(fit.end, predictors=fit.end.predictors[:4], local_exponents=())
    html = page({"fit": replace(fit, end=end)})
    assert "What n is a mixture of cannot be told" in html
    assert "too few lengths for an exponent that changes along l" in html


@pytest.mark.parametrize(
    ("loading", "advice"),
    [
        ({"target": "mean_stress", "value": [5e7]}, "give loading.mean_stress several stresses"),
        ({"target": "edge_reduction", "value": 0.4}, "raise loading.states"),
    ],
)
def test_one_state_is_said_to_be_one(page, fit, loading, advice):
    loading = {**loading, "unloading": False}
    html = page({"fit": replace(fit, near_jamming=None), "settings": {"loading": loading}})
    assert "One loaded state" in html and advice in html
    assert "it is not near jamming" in html
    assert "along the loading, and the mean length" not in html
    assert "One loaded state" not in page({})


def test_pages_of_samples_hold_their_own_figures(page, tmp_path):
    other = tmp_path / "other.png"
    write_picture(other, (40, 40, 200))
    html = page({}, {"name": "results", "figures": dict.fromkeys(FIGURES, other)})
    first, second = html.split('<h2 id="sample-results">')
    drawn, others = (
        re.findall(r"data:image/png;base64,([^\"]+)", part) for part in (first, second)
    )
    assert len(drawn) == len(others) == len(FIGURES)
    assert len(set(drawn)) == len(set(others)) == 1 and set(drawn) != set(others)


def test_page_tells_the_basis_and_the_loading_it_was_given(page):
    html = page(
        {
            "settings": {
                "grading": {"form": "fuller", "basis": "mass"},
                "contact": {"law": "hertz"},
                "loading": {"target": "mean_stress", "value": [1e6, 1e8], "unloading": True},
            }
        }
    )
    assert "1000 grains of form fuller (by mass)" in html
    assert "Hertz contacts" in html
    assert "to mean stresses of 1 to 100 MPa, quality standard" in html
    assert "and back." in html


def test_page_lists_reasons_and_notes_as_they_are(page):
    note = {"finding": "overlaps > 5 %", "effect": "n +0.01", "advice": "load less"}
    few = {**note, "finding": "few grains"}
    html = page({"certificate": {"verdict": "x", "reasons": ["a < b"], "notes": [note, few]}})
    assert "<li>a &lt; b</li>" in html
    assert (
        "<li>overlaps &gt; 5 %.<br>Likely effect: n +0.01.<br>What to do: load less.</li>" in html
    )
    assert "<li>few grains.<br>" in html


def test_page_compares_both_runs_where_the_exponent_is_missing(page):
    exponent = {
        "quantity": "exponent",
        "seeds": 1,
        "value": None,
        "value_at_twice_the_steps": None,
        "difference": None,
        "seeds_at_twice_the_steps": 2,
        "compared_by": "ensembles",
        "could_see": None,
        "tolerance": 0.1,
        "verdict": "",
    }
    stress = {**exponent, "quantity": "mean_stress_Pa", "value": 1e6, "difference": 1234.5}
    stress |= {"compared_by": "pairs", "could_see": 5e4, "verdict": "converged"}
    html = page({"certificate": {"convergence": [exponent, stress]}})
    assert "<td>n</td><td>1 against 2</td> <td>none</td>" in html
    assert "<td>mean stress</td><td>1 pair</td> <td>1 MPa</td>" in html
    assert "<td>50 kPa</td><td>100 mPa</td><td>converged</td>" in html


def test_page_tells_of_the_way_back(page):
    unloading = {
        "work_returned_share": 0.6,
        "energy_returned_share": 0.95,
        "stress_lost_share": None,
        "residual_solid_fraction": 0.0065,
    }
    html = page({"certificate": {"jamming_solid_fraction_unloading": 0.65, "unloading": unloading}})
    assert "0.6500, 0.0065" in html


def test_jamming_of_the_seeds_used_may_be_unknown(page, fit):
    unknown = replace(fit.packings, jamming_solid_fraction=float("nan"))
    html = page({"fit": replace(fit, packings=unknown)})
    assert "at &phi; = 0.741, 56 MPa." in html


def test_a_coarser_ultimate_grading_is_told_in_the_words_of_the_preview(page):
    why = admissibility_problem(1.0, 1.5)
    html = page({"model": {"reason": why}})
    assert f"No curves: {why}.".replace("<", "&lt;") in html
    assert "thermodynamics.ultimate_alpha" in html


def test_a_wide_interval_is_a_reason_like_others(page):
    reason = "too few seeds or branches to tell n"
    certificate = {"verdict": "not certified", "reasons": [reason]}
    assert f"<li>{reason}</li>" in page({"certificate": certificate})


def test_page_tells_which_grains_carry_load_by_rods(page):
    html = page({})
    assert "in a periodic cell, by rods that push" in html
    assert "0.721" in html and "<td>23, 91</td>" in html and "<td>0.32</td>" in html
    nothing = {"target": GRADING, "realised": GRADING, "representativity": STANDING}
    assert "in a periodic cell, by rods" not in page(
        {"grading": nothing | {"rods": {"reason": "none"}}}
    )
