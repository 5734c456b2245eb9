"""The tables over all samples, and the page that a person opens."""

import base64
from collections import defaultdict
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from branchcrush import __version__
from branchcrush.statistics.intervals import interval_names


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
    value, low, high = (row.get(key) for key in interval_names(name))
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
