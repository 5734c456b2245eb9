"""The report: samples with data, without any, with some, and of one state."""

import re
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from branchcrush.crushing.paper_form import admissibility_problem
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.state_fit import FittedPredictor
from branchcrush.plotting.form_words import extrapolated
from branchcrush.samples.certificate import LIMITS
from branchcrush.statistics.intervals import Interval
from branchcrush.study.pages import SamplePage, render_report

TEMPLATE = Path(__file__).parents[3] / "workflow" / "report" / "report.html.jinja"
FIGURES = re.findall(r"s\.figures\.(\w+)", TEMPLATE.read_text(encoding="utf-8"))

FORM = {
    "reason": None,
    "admissible": True,
    "inadmissible_from": None,
    "hardens_at_onset": True,
    "snaps": [],
    "sentences": [],
}
MODEL = {
    "form": "moving_jamming",
    "network": "rods",
    "theta": 0.891574,
    "resistance": "critical_energy",
    "critical_energy_J_per_m3": 2e5,
    "hardening_exponent": 2.0,
    "yield_strain": 0.1015,
    "yield_stress_Pa": 6.1e6,
    "yields_on_path": True,
    "hardens_at_onset": True,
    "largest_strain": 0.115,
    "forms": {
        "moving_jamming": FORM
        | {
            "admissible": False,
            "inadmissible_from": 0.5512,
            "snaps": [0.12, 0.25],
            "sentences": ["It ends at C = 0.55.", "It snaps."],
        },
        "paper": FORM | {"theta": 0.891574},
        "density": FORM | {"theta": -0.25, "hardens_at_onset": None, "inadmissible_from": 0.0},
        "measured_contacts": {"reason": "no contacts <measured>"},
    },
}
FORMS = pd.DataFrame(
    {
        "form": ["paper"] * 2 + ["moving_jamming"] * 4,
        "crushing": [0.0, 1.0, 0.0, 0.1, 0.5, 0.6],
        "jamming_solid_fraction": [0.61, 0.61, 0.64, 0.65, 0.76, 0.77],
        "stiffness_ratio": [1.0, 0.1, 1.0, 1.15, 3.83, 4.0],
        "driving_force_over_pressure": [0.006, 0.006, 0.41, 0.4, 0.04, -0.01],
        "yield_stress_Pa": [1e6, 2e6, 3e6, 4e6, float("nan"), float("nan")],
        "yield_elastic_strain": [0.1, 0.2, 0.01, 0.02, float("nan"), float("nan")],
        "void_ratio": [0.5, 0.4, 0.54, 0.52, float("nan"), float("nan")],
    }
)
STATISTICS = {"mean_length_1_m1": 1.4e-3, "eq4_length_1_m1": 1.2e-3}
GRADING = dict.fromkeys(
    ("D_min_m", "D_max_m", "D10_m", "D30_m", "D50_m", "D60_m"), 1e-3
) | dict.fromkeys(("uniformity_coefficient", "curvature_coefficient"), 1.0)
STANDING = {
    "coarse_grains": 12.0,
    "edge_over_diameter": 6.0,
    "largest_gap_percent_mean": 1.5,
    "grains_needed": 900,
}
CERTIFICATE = {
    "verdict": "certified",
    "reasons": [],
    "notes": [],
    "seeds": 4,
    "seeds_certified": 4,
    "states": 68,
    "states_loaded": 50,
    "states_certified": 50,
    "limits": LIMITS,
    "worst": dict.fromkeys(LIMITS, 0.0),
    "dissipated_share_at_end": 0.1,
    "median_overlap_ratio_at_end": 0.01,
    "overlap_ratio_95_at_end": 0.03,
    "rattler_fraction_at_end": 0.12,
    "jamming_solid_fraction": 0.64,
    "jamming_solid_fraction_scatter": 0.002,
    "jamming_uncertainty": 0.0004,
    "jamming_solid_fraction_unloading": None,
    "force_evaluations": 69000.0,
    "unloading": None,
    "convergence": [],
}
# As a sample whose packings never carry load.
NOTHING = {
    **{key: None for key, value in CERTIFICATE.items() if isinstance(value, float)},
    "verdict": "not certified",
    "reasons": ["4 of 4 packings carry no load at the end of their loading"],
    "seeds_certified": 0,
    "states_loaded": 0,
    "worst": dict.fromkeys(LIMITS),
}
REASON = {"reason": "no packing is certified at the end of its loading"}
NO_FIT = EnergySplitFit.read(REASON)
SETTINGS = {
    "grains": 1000,
    "grading": {"form": "uniform", "basis": "number"},
    "sampling": "random",
    "boundary": "walls",
    "contact": {"law": "linear"},
    "initial_solid_fraction": 0.16,
    "loading": {"target": "edge_reduction", "value": 0.4, "unloading": False},
    "quality": "standard",
    "strain_step": 1.7e-3,
}


@pytest.fixture
def fit(sample):
    """Fits of which every number of the two states is known."""
    packings = replace(sample().fit.packings, jamming_solid_fraction=0.64)
    whole = replace(sample().fit, exponent=Interval(3.111, 2.99, 3.24), packings=packings)
    surface = FittedPredictor.without("surface", "quadratic", "not told apart")
    predictors = (*whole.end.predictors[:5], surface)
    return replace(whole, end=replace(whole.end, predictors=predictors))


RODS = {
    "jamming_solid_fraction": 0.7208,
    "load_bearing_by_number": 0.23,
    "load_bearing_by_mass": 0.91,
    "finest_load_bearing_diameter_m": 3.2e-4,
}


@pytest.fixture
def page(tmp_path, fit):
    """Return a function that renders samples and returns the page without its images."""
    image = tmp_path / "figure.png"
    image.write_bytes(b"pixels")

    def sample(name="paper", **parts):
        certificate = {**CERTIFICATE, **parts.pop("certificate", {})}
        settings = {**SETTINGS, **parts.pop("settings", {})}
        whole = {
            "name": name,
            "settings": settings,
            "fit": fit,
            "model": MODEL,
            "statistics": STATISTICS,
            "certificate": certificate,
            "grading": {
                "target": GRADING,
                "realised": GRADING,
                "representativity": STANDING,
                "rods": RODS,
            },
            "figures": dict.fromkeys(FIGURES, image),
            "forms": FORMS,
        }
        return SamplePage(**(whole | parts))

    def render(*samples, **keys):
        html = render_report(
            TEMPLATE.read_text(encoding="utf-8"), [sample(**parts) for parts in samples], **keys
        )
        assert not re.search(r"\b(nan|None|NaN|Undefined)\b", html)
        assert html.count("<ul") == html.count("</ul>")
        assert html.count("<table") == html.count("</table>")
        return re.sub(r"\s+", " ", html)

    return render


# --- page ----------------------------------------------------------------------------------------


def test_page_shows_exponent_verdict_and_all_figures(page):
    html = page({})
    assert "n = 3.11 (95% interval 2.99 to 3.24) at &phi; = 0.741" in html
    assert "<h3>Certificate: certified</h3>" in html
    assert html.count("data:image/png;base64,") == len(FIGURES)
    assert "No exponent" not in html


def test_page_links_to_that_of_measured_materials_where_there_is_one(page):
    assert "measured.html" not in page({})
    assert '<a href="measured.html">' in page({}, measured=True)


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
    assert '<td class="certified">certified</td> <td>3.11 (95% interval 2.99 to 3.24)</td>' in html
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
    other.write_bytes(b"other")
    html = page({}, {"name": "results", "figures": dict.fromkeys(FIGURES, other)})
    first, second = html.split('<h2 id="results">')
    assert first.count("cGl4ZWxz") == len(FIGURES) == second.count("b3RoZXI=")


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
    assert "<td>mean stress [Pa]</td><td>1 pair</td> <td>1e+06</td>" in html
    assert "<td>5e+04</td><td>0.1</td><td>converged</td>" in html


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


# --- crushing ------------------------------------------------------------------------------------


def test_the_form_on_the_front_is_named_with_why_and_its_numbers(page):
    html = page({})
    assert "On the front stands the form <b>moving jamming point</b>: fines fill voids" in html
    assert "rods that push" in html and "random parking" not in html
    assert "Crushing begins at an elastic strain of 10.15 % and 6.1 MPa; the stress rises" in html
    assert "0.2 MJ/m&sup3; over (1 &minus; C)<sup>2</sup>" in html


def test_the_front_is_tabled_along_c_as_far_as_it_is_admissible(page):
    html = page({})
    assert (
        "<tr><td>0.10</td><td>0.6500</td><td>1.15</td> <td>0.4</td><td>4</td><td>0.520</td></tr>"
    ) in html
    assert "<td>0.50</td><td>0.7600</td><td>3.83</td> <td>0.04</td><td>none</td>" in html
    assert "0.7700" not in html


def test_yield_beyond_the_measured_strains_is_said(page):
    html = page({"model": {**MODEL, "largest_strain": 0.015}})
    assert "From C = 0.10 on it yields at elastic strains above 1.5 %" in html
    assert "it yields at" not in page({})


def test_page_and_figures_tell_one_c_from_which_on_the_law_is_extrapolated(page):
    # Between two rows of the page, which are tenths of C.
    crushing = [k / 50.0 for k in range(51)]
    strain = [0.01 if at < 0.615 else 0.2 for at in crushing]
    forms = pd.DataFrame({"crushing": crushing, "yield_elastic_strain": strain, "form": "paper"})
    forms = forms.assign(**dict.fromkeys(FORMS.columns.drop(list(forms)), 1.0))
    model = {**MODEL, "form": "paper"}
    (text,) = extrapolated(forms, model)
    assert text.startswith("From C = 0.62 on")
    assert "From C = 0.62 on it yields at" in page({"model": model, "forms": forms})


@pytest.mark.parametrize(
    ("hardens", "snaps", "said"),
    [
        (True, [], "the stress rises then."),
        (True, [0.12, 0.3], "rises then, and falls from C = 0.12 on: under a stress that is held"),
        (False, [0.0], "the stress falls then: under a stress that is held C snaps on there."),
    ],
)
def test_the_sentence_of_the_onset_is_what_the_table_says(page, hardens, snaps, said):
    form = {**FORM, "hardens_at_onset": hardens, "snaps": snaps}
    forms = {**MODEL["forms"], "paper": form}
    model = {**MODEL, "form": "paper", "forms": forms, "hardens_at_onset": hardens}
    assert said in page({"model": model})


def test_a_small_driving_force_keeps_its_digits(page):
    forms = FORMS.assign(driving_force_over_pressure=[0.0012345] * len(FORMS))
    assert "<td>0.00123</td>" in page({"forms": forms})


def test_a_sample_that_is_not_certified_says_so_again_beside_the_crushing_model(page):
    html = page({"certificate": {"verdict": "not certified", "reasons": ["few"]}})
    section = html[html.index("<h3>Crushing</h3>") :]
    assert "The sample is not certified" in section
    assert "is not certified" not in page({})


def test_every_form_says_whether_it_is_admissible_where_not_and_why(page):
    html = page({})
    moving = html[html.index("<tr><td>moving jamming point</td>") :]
    assert "<td>none</td><td>no</td> <td>from C = 0.55</td> <td>yes</td>" in moving
    assert "<td>at C = 0.12, 0.25</td></tr>" in moving
    # One that hardens when crushing begins may snap farther on.
    assert "<th>hardens at onset</th><th>snaps under stress</th>" in html
    assert "<td>0.892</td><td>yes</td> <td>never</td> <td>yes</td><td>never</td></tr>" in html
    assert "<td>-0.25</td><td>yes</td> <td>at all C</td> <td>never yields</td>" in html
    assert '<td class="words" colspan="5">no contacts &lt;measured&gt;</td></tr>' in html
    assert "<p><b>moving jamming point</b>: It ends at C = 0.55. It snaps.</p>" in html


def test_a_degenerate_form_is_said_on_the_front_and_in_the_section(page):
    sentence = "theta is 0.99999"
    html = page({"model": {**MODEL, "paper_degenerate": sentence}})
    front, section = html.split('<h2 id="paper">')
    assert f'<p class="note"><a href="#paper">paper</a>: {sentence}</p>' in front
    assert f'<p class="note">{sentence}</p>' in section
    assert sentence not in page({})


def test_the_elastic_law_says_how_it_was_found_and_what_it_leaves_out(page):
    said = {"elasticity_sentences": ["One.", "Two."], "rearrangement": "Three.", "bands": None}
    assert "<p><b>Elastic law</b>: One. Two. Three.</p>" in page({"model": {**MODEL, **said}})
    assert "Elastic law</b>" not in page({})


def test_untested_size_ratios_are_said(page):
    html = page({"model": {**MODEL, "untested": "a ratio of 200 is untested."}})
    assert '<p class="note">a ratio of 200 is untested.</p>' in html


def test_a_chosen_form_that_is_not_there_says_why_and_shows_the_others(page):
    model = {**MODEL, "form": "measured_contacts", "form_reason": "No contacts were measured."}
    html = page({"model": model})
    assert '<p class="note">No contacts were measured.</p>' in html
    assert "chosen by <code>thermodynamics.form</code>" in html
    assert 'alt="compression line"' in html
    assert "Crushing begins at" not in html


def test_limits_are_those_of_the_sample(page):
    hertz = {"contact": {"law": "hertz"}, "boundary": "periodic"}
    html = page({"settings": hertz})
    for part in ("finer grains are stiffer", "between walls"):
        assert part in page({})
        assert part not in html


def test_a_grading_that_is_the_ultimate_one_never_crushes(page):
    model = {**MODEL, "yield_strain": None, "yield_stress_Pa": None, "yields_on_path": False}
    html = page({"model": model})
    assert "By this form crushing never begins." in html
    assert "Crushing begins at" not in html
    html = page({"model": {**model, "form": "density"}})
    assert "crushing never begins: it would cost elastic energy from the first." in html


def test_a_limit_of_elastic_strain_is_told_with_its_numbers(page):
    limit = {"resistance": "elastic_strain", "elastic_strain": 0.0125, "strength_exponent": 0.5}
    html = page({"model": {**MODEL, **limit}})
    assert "begins at 1.25 %" in html and "(strength exponent 0.5)" in html


def test_captions_follow_the_form_on_the_front(page):
    stiffer = "by the form on the front a grading that was crushed is stiffer, and jams at a larger"
    assert stiffer in page({})
    softer = "a grading that was crushed is softer, and its jamming point stays.</figcaption>"
    assert softer in page({"model": MODEL | {"form": "paper"}})
    html = page({"model": MODEL | {"form": "density"}})
    assert "whether crushing raises or lowers it.</figcaption>" in html


def test_captions_follow_the_resistance(page):
    assert "crushing goes on where driving force and resistance are equal" in page({})
    limit = {"resistance": "elastic_strain", "elastic_strain": 0.01, "strength_exponent": 0.3}
    html = page({"model": MODEL | limit})
    assert "goes on at the elastic strain of yield, and the resistance is the driving force" in html
    assert "are equal" not in html


def test_page_tells_which_grains_carry_load_by_rods(page):
    html = page({})
    assert "in a periodic cell, by rods that push" in html
    assert "0.721" in html and "<td>23, 91</td>" in html and "<td>0.32</td>" in html
    nothing = {"target": GRADING, "realised": GRADING, "representativity": STANDING}
    assert "in a periodic cell, by rods" not in page(
        {"grading": nothing | {"rods": {"reason": "none"}}}
    )
