"""The tables over all samples, and the page that a person opens."""

import base64
from collections import defaultdict
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from branchcrush import __version__


def comparison_row(name, fit, model, certificate):
    """Return the row of `comparison.csv` of a sample.

    Parameters
    ----------
    name : str
    fit, model, certificate : dict
        `energy_split.json`, `thermodynamics.json` and `certificate.json`.

    Returns
    -------
    dict
        Empty where a sample has no data; `reason` then says why.
    """
    return {
        "sample": name,
        "verdict": certificate["verdict"],
        "exponent": fit.get("exponent"),
        "exponent_low": fit.get("exponent_low"),
        "exponent_high": fit.get("exponent_high"),
        "confidence": fit.get("confidence"),
        "seeds": certificate["seeds"],
        "seeds_certified": certificate["seeds_certified"],
        "branches": fit.get("branches"),
        "solid_fraction": fit.get("solid_fraction"),
        "jamming_solid_fraction": certificate["jamming_solid_fraction"],
        "jamming_scatter_of_seeds": certificate["jamming_solid_fraction_scatter"],
        "jamming_uncertainty_of_one": certificate["jamming_uncertainty"],
        "mean_stress_Pa": fit.get("mean_stress_Pa"),
        "elastic_energy_J_per_m3": fit.get("elastic_energy_J_per_m3"),
        "median_overlap_ratio": fit.get("median_overlap_ratio"),
        "coordination_number": fit.get("coordination_number"),
        "mechanical_coordination_number": fit.get("mechanical_coordination_number"),
        "rattler_fraction": fit.get("rattler_fraction"),
        "dissipated_share": certificate["dissipated_share_at_end"],
        "theta": model.get("theta"),
        "force_evaluations": certificate["force_evaluations"],
        "reason": fit.get("reason") or model.get("reason"),
    }


def render_report(template, samples):
    """Return the report as one HTML page with its figures inside.

    Parameters
    ----------
    template : str
        Jinja source.
    samples : list of dict
        name, settings, fit, model, statistics, certificate, grading and figures of each sample.

    Returns
    -------
    str
    """
    environment = Environment(autoescape=True, undefined=StrictUndefined)
    environment.filters |= {
        "image": _image,
        "interval": _interval,
        "number": _number,
        "estimate": _estimate,
    }
    # A result without data says why; the others have no reason to give.
    parts = ("fit", "model", "statistics")
    pages = [
        {**sample, **{part: {"reason": None, **sample[part]} for part in parts}}
        for sample in samples
    ]
    for page in pages:
        page["fit"]["predictors"] = [
            {"reason": None, "left_out_reason": None, **predictor}
            for predictor in page["fit"].get("predictors", [])
        ]
        page["fit"]["curvature"] = {"reason": None, **page["fit"].get("curvature", {})}
    return environment.from_string(template).render(samples=pages, version=__version__)


def render_findings(template, rows, verdicts, good, figures):
    """Return the page on which all samples are judged together, its figures inside.

    Parameters
    ----------
    template : str
        Jinja source.
    rows : list of dict
        From `study.findings.finding_row`, None where there is no number.
    verdicts : dict
        From `study.findings.verdicts`.
    good : float
        Up to which distance a prediction of branch lengths is called good [-].
    figures : dict
        Paths by name.

    Returns
    -------
    str
    """
    environment = Environment(autoescape=True, undefined=StrictUndefined)
    environment.filters |= {"image": _image, "number": _number, "estimate": _estimate}
    # A study of which no sample has a number has no column for it.
    rows = [defaultdict(lambda: None, row) for row in rows]
    return environment.from_string(template).render(
        rows=rows,
        verdicts=verdicts,
        distance=next((row["distance"] for row in rows if row["distance"] is not None), None),
        good=good,
        figures=figures,
        version=__version__,
    )


def _estimate(row, name, form="%.2f"):
    """Format an estimate with its interval."""
    value, low, high = (row.get(name + part) for part in ("", "_low", "_high"))
    if value is None or value != value:
        return "none"
    if low is None or low != low:
        return form % value
    return f"{form % value} ({form % low} to {form % high})"


def _image(path):
    return "data:image/png;base64," + base64.b64encode(Path(path).read_bytes()).decode()


def _number(value, form="%.3f"):
    """Format a number that may be missing."""
    return "none" if value is None or value != value else form % value


def _interval(fit):
    if fit["reason"]:
        return "none"
    if fit["exponent_low"] is None:
        return f"{fit['exponent']:.2f} (one seed: no interval)"
    return (
        f"{fit['exponent']:.2f} ({fit['confidence']:.0%} interval "
        f"{fit['exponent_low']:.2f} to {fit['exponent_high']:.2f})"
    )
