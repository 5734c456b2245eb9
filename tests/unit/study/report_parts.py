"""What the tests of the report's page render: a sample of which everything is known."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pandas as pd

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.state_fit import FittedPredictor
from branchcrush.samples.certificate import LIMITS
from branchcrush.statistics.intervals import Interval
from branchcrush.study.pages import SamplePage, render_report
from branchcrush.study.templates import page_template
from tests.unit.study.pictures import write_picture

TEMPLATE = Path(__file__).parents[3] / "workflow" / "report" / "report.html.jinja"
GLOSSARY = TEMPLATE.parents[2] / "docs" / "glossary.md"
SECTIONS = TEMPLATE.with_name("sample.html.jinja").read_text(encoding="utf-8")
FIGURES = re.findall(r'fig\("(\w+)"', SECTIONS)
TEMPLATE_OF_PAGE = page_template(TEMPLATE, GLOSSARY)

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
RODS = {
    "jamming_solid_fraction": 0.7208,
    "load_bearing_by_number": 0.23,
    "load_bearing_by_mass": 0.91,
    "finest_load_bearing_diameter_m": 3.2e-4,
}


def whole_fit(sample: Callable) -> EnergySplitFit:
    """Fits of which every number of the two states is known."""
    packings = replace(sample().fit.packings, jamming_solid_fraction=0.64)
    whole = replace(sample().fit, exponent=Interval(3.111, 2.99, 3.24), packings=packings)
    surface = FittedPredictor.without("surface", "quadratic", "not told apart")
    predictors = (*whole.end.predictors[:5], surface)
    return replace(whole, end=replace(whole.end, predictors=predictors))


def rendering(folder: Path, fit: EnergySplitFit) -> Callable:
    """Return a function that renders samples and returns the page, its white space closed up."""
    whole = page_rendering(folder, fit)
    return lambda *samples, **keys: re.sub(r"\s+", " ", whole(*samples, **keys))


def page_rendering(folder: Path, fit: EnergySplitFit) -> Callable:
    """Return a function that renders samples and returns the page as a browser takes it."""
    image = folder / "figure.png"
    write_picture(image)

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
        html = render_report(TEMPLATE_OF_PAGE, [sample(**parts) for parts in samples], **keys)
        assert not re.search(r"\b(nan|None|NaN|Undefined)\b", html)
        assert not re.search(r'(href|src)="[^"]*(<|&lt;|%3C)', html)
        assert html.count("<ul") == html.count("</ul>")
        assert html.count("<table") == html.count("</table>")
        return html

    return render
