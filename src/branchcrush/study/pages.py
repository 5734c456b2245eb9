"""The pages that a person opens: a part a sample, and all samples judged together."""

import base64
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from jinja2 import DictLoader, Environment, StrictUndefined

from branchcrush import __version__
from branchcrush.energy.estimators import ESTIMATORS
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.local_exponents import trend
from branchcrush.files.tables import Table
from branchcrush.statistics.intervals import LIMITS, Interval, interval_text
from branchcrush.study.crushing_words import (
    extrapolated_from,
    form_rows,
    front_rows,
    share_text,
    yes_or_no,
)
from branchcrush.study.verdicts import GOOD_DISTANCE, verdicts

# What is compared with twice the strain steps.
QUANTITY_WORDS: Mapping[str, str] = MappingProxyType(
    {
        "exponent": "n",
        "solid_fraction": "solid fraction φ",
        "mean_stress_Pa": "mean stress [Pa]",
        "elastic_energy_J": "elastic energy [J]",
        "work_J": "work [J]",
        "coordination_number": "coordination number κ",
        "mechanical_coordination_number": "the same without rattlers, κ*",
        "jamming_solid_fraction": "jamming solid fraction φ_J",
        "force_evaluations": "force evaluations of a packing",
    }
)
# What `thermodynamics.json` has a sentence for only where there is something to say.
_NOT_SAID = dict.fromkeys(("reason", "form_reason", "paper_degenerate", "untested"))


@dataclass(frozen=True)
class SamplePage:
    """What the report shows of a sample.

    Parameters
    ----------
    name : str
    settings : mapping
        From `config.schema.Sample.settings`.
    fit : EnergySplitFit
        Read from `energy_split.json`.
    model, statistics, certificate, grading : mapping
        `thermodynamics.json`, `branch_lengths.json`, `certificate.json` and `grading.json`.
    figures : mapping of str to path-like
        By name of the figure.
    forms : DataFrame
        `crushing_forms.csv`.
    """

    name: str
    settings: Mapping[str, Any]
    fit: EnergySplitFit
    model: Mapping[str, Any]
    statistics: Mapping[str, Any]
    certificate: Mapping[str, Any]
    grading: Mapping[str, Any]
    figures: Mapping[str, Any]
    forms: Table

    @property
    def one_state(self) -> bool:
        """Whether n is known in one state only, the end."""
        return self.fit.reason is None and self.fit.near_jamming is None

    @property
    def breaks(self) -> bool:
        """Whether its grains break, on a page of their own."""
        return self.settings.get("breakage") is not None

    @property
    def front(self) -> list[dict[str, Any]]:
        """The form of the crushing model on the front, along C."""
        return front_rows(self.forms, self.model)

    @property
    def extrapolated_from(self) -> float | None:
        """From which C on that form yields beyond the measured elastic strains, if it does."""
        return extrapolated_from(self.forms, self.model)


def render_report(template: str, samples: Sequence[SamplePage], measured: bool = False) -> str:
    """Return the report as one HTML page with its figures inside.

    Parameters
    ----------
    template : str
        Jinja source.
    samples : list of SamplePage
    measured : bool
        Whether there is a page of measured materials to link to.

    Returns
    -------
    str

    Examples
    --------
    >>> render_report("{{ samples | length }} samples", [])
    '0 samples'
    """
    # A result without data says why; the others have no reason to give.
    pages = [
        replace(
            page,
            model={**_NOT_SAID, **page.model},
            statistics={"reason": None, **page.statistics},
        )
        for page in samples
    ]
    page = page_environment().from_string(template)
    return page.render(samples=pages, estimators=ESTIMATORS, measured=measured, version=__version__)


def render_findings(template: str, rows: Table, figures: Mapping[str, Any]) -> str:
    """Return the page on which all samples are judged together, its figures inside.

    Parameters
    ----------
    template : str
        Jinja source.
    rows : DataFrame
        `findings.csv`.
    figures : mapping of str to path-like
        By name of the figure.

    Returns
    -------
    str

    Examples
    --------
    >>> import pandas as pd
    >>> row = {"sample": "sand", "verdict": "not certified", "exponent_at_end": float("nan")}
    >>> rows = pd.DataFrame([row])
    >>> render_findings("{{ rows | length }} sample, {{ verdicts.known | length }} known", rows, {})
    '1 sample, 0 known'
    """
    known = rows.astype(object).where(rows.notna(), None).to_dict("records")
    # A study of which no sample has a number has no column for it.
    records = [defaultdict(lambda: None, row) for row in known]
    return (
        page_environment()
        .from_string(template)
        .render(
            rows=records,
            verdicts=verdicts(known),
            distance=next((d for d in (row["distance"] for row in records) if d is not None), None),
            good=GOOD_DISTANCE,
            figures=figures,
            version=__version__,
        )
    )


def page_environment(parts: Mapping[str, str] = MappingProxyType({})) -> Environment:
    """Return what every page is rendered with: its filters, and nothing undefined passed over.

    Parameters
    ----------
    parts : mapping of str to str
        Templates that the page imports or includes, by name, as `viewer_states.viewer_parts`.

    Returns
    -------
    Environment
    """
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, loader=DictLoader(dict(parts))
    )
    environment.filters |= {
        "answer": yes_or_no,
        "estimate": _estimate,
        "exponent": _exponent,
        "form_rows": form_rows,
        "image": _image,
        "interval": _interval,
        "number": _number,
        "quantity": QUANTITY_WORDS.__getitem__,
        "share": share_text,
        "trend": trend,
    }
    return environment


def _interval(row: Mapping, name: str, where: str = "") -> Interval:
    """Return the interval of a row of the findings, its columns name, limit and state."""
    values = (row[f"{name}{limit}{where}"] for limit in LIMITS)
    return Interval(*(float("nan") if value is None else value for value in values))


def _estimate(interval: Interval | None, form: str = "%.2f") -> str:
    """Format an estimate with its interval; either may be missing."""
    if interval is None or interval.estimate != interval.estimate:
        return "none"
    if interval.low != interval.low:
        return form % interval.estimate
    return f"{form % interval.estimate} ({form % interval.low} to {form % interval.high})"


def _exponent(fit: EnergySplitFit) -> str:
    """Format n with its interval and what that is of."""
    if fit.reason is not None:
        return "none"
    if fit.exponent.low != fit.exponent.low:
        return interval_text(*fit.exponent)
    n = fit.exponent
    interval = f"{fit.confidence:.0%} interval {n.low:.2f} to {n.high:.2f}"
    return f"{n.estimate:.2f} ({interval})"


def _image(path: Any) -> str:
    return "data:image/png;base64," + base64.b64encode(Path(path).read_bytes()).decode()


def _number(value: float | None, form: str = "%.3f") -> str:
    """Format a number that may be missing."""
    return "none" if value is None or value != value else form % value
