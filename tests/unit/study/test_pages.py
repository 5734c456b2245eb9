"""The table of all samples and the page: samples with data, without any, and with some."""

import re
from pathlib import Path

import pytest

from branchcrush.samples.certificate import LIMITS
from branchcrush.study.comparison import comparison_row
from branchcrush.study.pages import render_report

TEMPLATE = Path(__file__).parents[3] / "workflow" / "report" / "report.html.jinja"
FIGURES = re.findall(r"s\.figures\.(\w+)", TEMPLATE.read_text(encoding="utf-8"))

FIT = {
    "exponent": 3.111,
    "exponent_low": 2.99,
    "exponent_high": 3.24,
    "confidence": 0.95,
    "branches": 4321,
    "solid_fraction": 0.7407,
    "jamming_solid_fraction": 0.64,
    "mean_stress_Pa": 5.6e7,
    "elastic_energy_J_per_m3": 1e6,
    "median_overlap_over_length": 0.02,
    "coordination_number": 6.5,
    "mechanical_coordination_number": 7.5,
    "rattler_fraction": 0.1,
    "reference_length_m": 1e-3,
    "cubic_r_squared": 0.99,
    "predictors": [
        {
            "name": "branch_length",
            "formula": "A l^n",
            "exponent": 3.05,
            "parameters": {"exponent": {"estimate": 3.05, "low": 2.9, "high": 3.2}},
            "explained_deviance": 0.1605,
            "explained_deviance_low": 0.15,
            "explained_deviance_high": 0.17,
            "difference_to_branch_length": 0.0,
            "difference_to_branch_length_low": 0.0,
            "difference_to_branch_length_high": 0.0,
        },
        {"name": "surface", "formula": "quadratic", "reason": "not told apart"},
    ],
    "curvature": {"curvature": 0.46, "curvature_low": 0.22, "curvature_high": 0.7},
}
MODEL = {
    "theta": 0.891574,
    "yield_strain": 0.1015,
    "yield_stress_Pa": 6.1e6,
    "yields_on_path": True,
    "hardens_at_onset": True,
    "hardening_exponent": 2.0,
    "least_hardening_exponent": 1.39,
}
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
    "flags": [],
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
def page(tmp_path):
    """Return a function that renders samples and returns the page without its images."""
    image = tmp_path / "figure.png"
    image.write_bytes(b"pixels")

    def sample(name="paper", **parts):
        certificate = {**CERTIFICATE, **parts.pop("certificate", {})}
        settings = {**SETTINGS, **parts.pop("settings", {})}
        whole = {
            "name": name,
            "settings": settings,
            "fit": FIT,
            "model": MODEL,
            "statistics": STATISTICS,
            "certificate": certificate,
            "grading": {"target": GRADING, "realised": GRADING, "representativity": STANDING},
            "figures": dict.fromkeys(FIGURES, image),
        }
        return whole | parts

    def render(*samples):
        html = render_report(
            TEMPLATE.read_text(encoding="utf-8"), [sample(**parts) for parts in samples]
        )
        assert not re.search(r"\b(nan|None|NaN|Undefined)\b", html)
        assert html.count("<ul") == html.count("</ul>")
        assert html.count("<table") == html.count("</table>")
        return re.sub(r"\s+", " ", html)

    return render


# --- table of all samples ------------------------------------------------------------------------


def test_row_holds_the_results_beside_the_verdict():
    row = comparison_row("paper", FIT, MODEL, CERTIFICATE)
    assert (row["sample"], row["verdict"], row["reason"]) == ("paper", "certified", None)
    assert (row["exponent"], row["theta"], row["branches"]) == (3.111, 0.891574, 4321)
    assert (row["seeds"], row["seeds_certified"]) == (4, 4)
    assert row["jamming_scatter_of_seeds"] == 0.002
    assert None not in [value for key, value in row.items() if key != "reason"]


def test_row_of_a_sample_without_data_has_its_reason_and_the_same_columns():
    row = comparison_row("loose", REASON, REASON, {**CERTIFICATE, **NOTHING})
    assert row["reason"] == REASON["reason"]
    assert row["verdict"] == "not certified"
    assert (row["seeds"], row["seeds_certified"]) == (4, 0)
    assert {row[key] for key in ("exponent", "theta", "branches", "mean_stress_Pa")} == {None}
    assert list(row) == list(comparison_row("paper", FIT, MODEL, CERTIFICATE))


def test_row_with_an_exponent_but_no_model_says_why_there_is_no_theta():
    row = comparison_row("paper", FIT, {"reason": "no elastic law"}, CERTIFICATE)
    assert (row["exponent"], row["theta"], row["reason"]) == (3.111, None, "no elastic law")


# --- page ----------------------------------------------------------------------------------------


def test_page_shows_exponent_verdict_and_all_figures(page):
    html = page({})
    assert "n = 3.11 (95% interval 2.99 to 3.24) at &phi; = 0.741" in html
    assert "<h3>Certificate: certified</h3>" in html
    assert html.count("data:image/png;base64,") == len(FIGURES)
    assert "No exponent" not in html


def test_page_of_a_sample_without_data_says_why_and_shows_what_there_is(page):
    html = page({"fit": REASON, "model": REASON, "statistics": REASON, "certificate": NOTHING})
    for part in ("No exponent", "No branches", "No curves"):
        assert f'<p class="note">{part}: {REASON["reason"]}.</p>' in html
    assert "<li>4 of 4 packings carry no load at the end of their loading</li>" in html
    for figure in ("grading", "packing", "loading path"):
        assert f'alt="{figure}"' in html
    for figure in ("certificate", "energy split", "branch lengths", "crushing model"):
        assert f'alt="{figure}"' not in html


def test_sample_without_data_leaves_the_others_theirs(page):
    loose = {"name": "loose", "fit": REASON, "model": REASON, "certificate": NOTHING}
    html = page({}, loose)
    assert '<td class="certified">certified</td> <td>3.11 (95% interval 2.99 to 3.24)</td>' in html
    assert '<td class="not-certified">not certified</td> <td>none</td><td>0 of 4</td>' in html


def test_one_size_has_branches_but_no_exponent(page):
    html = page({"fit": REASON, "settings": {"grading": {"form": "single"}}})
    assert "1000 grains of form single (one size)" in html
    assert 'alt="branch lengths"' in html
    assert 'alt="energy split"' not in html


def test_one_seed_has_no_interval(page):
    assert "n = 3.11 (one seed: no interval)" in page(
        {"fit": {**FIT, "exponent_low": None, "exponent_high": None}}
    )


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


def test_page_lists_reasons_and_flags_as_they_are(page):
    certificate = {"verdict": "flagged", "reasons": ["a < b"], "flags": ["overlaps", "few grains"]}
    html = page({"certificate": certificate})
    assert "<li>a &lt; b</li>" in html
    assert "<li>overlaps</li><li>few grains</li>" in html


def test_page_compares_both_runs_where_the_exponent_is_missing(page):
    exponent = {
        "quantity": "exponent",
        "seeds": 1,
        "value": None,
        "value_at_twice_the_steps": None,
        "difference": None,
        "standard_error_of_difference": None,
    }
    stress = {**exponent, "quantity": "mean_stress_Pa", "value": 1e6, "difference": 1234.5}
    html = page({"certificate": {"convergence": [exponent, stress]}})
    assert "with twice the strain steps, 1 seed<" in html
    assert "<td>exponent</td><td>none</td>" in html
    assert "<td>mean_stress_Pa</td><td>1e+06</td>" in html


def test_page_tells_of_the_way_back(page):
    unloading = {
        "work_returned_share": 0.6,
        "energy_returned_share": 0.95,
        "stress_lost_share": None,
        "residual_solid_fraction": 0.0065,
    }
    html = page({"certificate": {"jamming_solid_fraction_unloading": 0.65, "unloading": unloading}})
    assert "0.6500, 0.0065" in html


def test_jamming_of_the_seeds_used_may_be_unknown(page):
    html = page({"fit": {**FIT, "jamming_solid_fraction": None}})
    assert "at &phi; = 0.741, 56 MPa." in html


def test_a_grading_that_is_the_ultimate_one_never_crushes(page):
    model = {**MODEL, "theta": 0.0, "yield_strain": None, "yield_stress_Pa": None}
    html = page({"model": {**model, "yields_on_path": False}})
    assert "crushing would release nothing and never begins" in html
    assert "Crushing begins at" not in html
