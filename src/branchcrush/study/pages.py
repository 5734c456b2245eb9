"""The pages that a person opens: a part a sample, and all samples judged together."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from jinja2 import Template
from markupsafe import Markup

from branchcrush import __version__
from branchcrush.energy.estimators import ESTIMATORS
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import Table, read_json
from branchcrush.results.sample import Sample
from branchcrush.study.crushing_words import extrapolated_from, front_rows
from branchcrush.study.front import front_sentences, study_sentences
from branchcrush.study.verdicts import GOOD_DISTANCE, verdicts

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
    row : mapping, optional
        Of `findings.csv`, None where there is no number.
    view : mapping, optional
        `view.json`, the packing of the first seed in three dimensions.
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
    row: Mapping[str, Any] = field(default_factory=dict)
    view: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        sample: Sample,
        settings: Mapping[str, Any],
        figures: Sequence[str],
        row: Mapping[str, Any],
    ) -> "SamplePage":
        """Return what the report shows of a sample, read from its files.

        Parameters
        ----------
        sample : branchcrush.results.sample.Sample
        settings : mapping
            From `config.schema.Sample.settings`.
        figures : sequence of str
            Names of those that are shown.
        row : mapping
            As `finding_records`.

        Returns
        -------
        SamplePage
        """
        drawn = {name: sample.package.figure(sample.name, name) for name in figures}
        return cls(
            sample.name,
            settings,
            sample.fit,
            model=sample.thermodynamics.summary,
            statistics=sample.branch_lengths.summary,
            certificate=sample.certificate.summary,
            grading=sample.grading.summary,
            figures=drawn,
            forms=sample.crushing_forms.data,
            row=row,
            view=read_json(sample.package.figure(sample.name, "view").with_suffix(".json")),
        )

    @property
    def sentences(self) -> list[str]:
        """What came out, in plain words."""
        return front_sentences(self.fit, self.certificate, self.model, self.row)

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


def render_report(
    template: Template,
    samples: Sequence[SamplePage],
    together: str = "",
    measured: bool = False,
) -> str:
    """Return the report as one HTML page with its figures inside.

    Parameters
    ----------
    template : Template
        From `templates.page_template`.
    samples : list of SamplePage
    together : str
        From `render_findings`; nothing where one sample has no other beside it.
    measured : bool
        Whether there is a page of measured materials to link to.

    Returns
    -------
    str

    Examples
    --------
    >>> from branchcrush.study.templates import page_environment
    >>> template = page_environment().from_string("{{ samples | length }} samples")
    >>> render_report(template, [])
    '0 samples'
    """
    # A result without data says why; the others have no reason to give.
    pages = [
        replace(
            page,
            model={**_NOT_SAID, **page.model},
            statistics={"reason": None, **page.statistics},
            row=defaultdict(lambda: None, page.row),
        )
        for page in samples
    ]
    return template.render(
        samples=pages,
        study=study_sentences([(page.name, page.fit, page.certificate) for page in pages]),
        together=Markup(together),  # by a template that escapes
        estimators=ESTIMATORS,
        measured=measured,
        version=__version__,
    )


def finding_records(rows: Table) -> list[dict[str, Any]]:
    """Return the rows of `findings.csv`, with None where there is no number or no column.

    Examples
    --------
    >>> import pandas as pd
    >>> finding_records(pd.DataFrame({"sample": ["sand"], "n": [float("nan")]}))[0]["n"] is None
    True
    """
    known = rows.astype(object).where(rows.notna(), None).to_dict("records")
    # A study of which no sample has a number has no column for it.
    return [defaultdict(lambda: None, row) for row in known]


def render_findings(template: Template, rows: Table, figures: Mapping[str, Any]) -> str:
    """Return the section in which all samples are judged together, its figures inside.

    Parameters
    ----------
    template : Template
        From `templates.page_template`.
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
    >>> from branchcrush.study.templates import page_environment
    >>> template = page_environment().from_string("{{ rows | length }} row, {{ verdicts.known }}")
    >>> render_findings(template, pd.DataFrame([row]), {})
    '1 row, []'
    """
    records = finding_records(rows)
    return template.render(
        rows=records,
        verdicts=verdicts(records),
        distance=next((d for d in (row["distance"] for row in records) if d is not None), None),
        good=GOOD_DISTANCE,
        figures=figures,
    )
