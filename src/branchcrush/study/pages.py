"""The pages that a person opens: a part a sample, and all samples judged together."""

import base64
import io
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from jinja2 import DictLoader, Environment, StrictUndefined, Template
from markupsafe import Markup
from PIL import Image

from branchcrush import __version__
from branchcrush.energy.estimators import ESTIMATORS
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.local_exponents import trend
from branchcrush.files.dictionary import result_files
from branchcrush.files.tables import Table
from branchcrush.statistics.intervals import LIMITS, Interval, interval_text
from branchcrush.study.crushing_words import (
    extrapolated_from,
    form_rows,
    front_rows,
    share_text,
    yes_or_no,
)
from branchcrush.study.front import front_sentences, study_sentences
from branchcrush.study.glossary import read_glossary, terms_by_name, with_subscripts
from branchcrush.study.verdicts import GOOD_DISTANCE, verdicts

# What is compared with twice the strain steps: words, and the unit of the numbers.
QUANTITY_WORDS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "exponent": ("n", ""),
        "solid_fraction": ("solid fraction φ", ""),
        "mean_stress_Pa": ("mean stress", "Pa"),
        "elastic_energy_J": ("elastic energy", "J"),
        "work_J": ("work", "J"),
        "coordination_number": ("coordination number κ", ""),
        "mechanical_coordination_number": ("the same without rattlers, κ*", ""),
        "jamming_solid_fraction": ("jamming solid fraction φ_J", ""),
        "force_evaluations": ("force evaluations of a packing", ""),
    }
)
_PREFIXES = {9: "G", 6: "M", 3: "k", 0: "", -3: "m", -6: "µ", -9: "n"}
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
        From `page_template`.
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
        From `page_template`.
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


def page_template(template: str | Path, glossary: str | Path) -> Template:
    """Return the template of a page, which finds its parts beside it.

    Parameters
    ----------
    template : path-like
        Jinja source.
    glossary : path-like
        `docs/glossary.md`.

    Returns
    -------
    Template
    """
    path = Path(template)
    environment = page_environment(page_parts(path.parent))
    terms = read_glossary(Path(glossary).read_text(encoding="utf-8"))
    named = terms_by_name(terms)

    def term(name: str, shown: str | None = None) -> Markup:
        found = named[name]
        return Markup('<a class="term" href="#{}" data-meaning="{}">{}</a>').format(
            found.anchor, found.meaning, with_subscripts(shown or name)
        )

    environment.globals |= {"term": term, "glossary": terms}
    return environment.get_template(path.name)


def page_parts(folder: Path) -> dict[str, str]:
    """Return the sources that pages are made of, of a folder and of the view of grains below it.

    Parameters
    ----------
    folder : Path
        `workflow/report`.

    Returns
    -------
    dict of str to str
        Jinja source by name.
    """
    files = [*folder.iterdir(), *(folder / "viewer").iterdir()]
    kinds = (".jinja", ".css", ".js")
    return {file.name: _part(file) for file in sorted(files) if file.suffix in kinds}


def _part(file: Path) -> str:
    """Return the source of a part of a page; style and scripts are taken as they are."""
    text = file.read_text(encoding="utf-8")
    return text if file.suffix == ".jinja" else f"{{% raw %}}{text}{{% endraw %}}"


def page_environment(parts: Mapping[str, str] = MappingProxyType({})) -> Environment:
    """Return what every page is rendered with: its filters, and nothing undefined passed over.

    Parameters
    ----------
    parts : mapping of str to str
        Templates that the page imports or includes, by name, as `page_parts`.

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
        "prefixed": prefixed,
        "quantity": QUANTITY_WORDS.__getitem__,
        "share": share_text,
        "subscripts": with_subscripts,
        "tables": figure_tables,
        "trend": trend,
    }
    return environment


def prefixed(value: float | None, unit: str = "", digits: int = 3) -> str:
    """Format a number in the unit a reader wants, with a prefix; it may be missing.

    Examples
    --------
    >>> prefixed(4.455e7, "Pa"), prefixed(0.0), prefixed(0.64123, digits=4), prefixed(None)
    ('44.5 MPa', '0', '0.6412', 'none')
    """
    if value is None or value != value:
        return "none"
    power = int(f"{value:e}".partition("e")[2]) // 3 * 3 if value and unit else 0
    power = min(max(power, min(_PREFIXES)), max(_PREFIXES))
    shown = float(f"{value / 10.0**power:.{digits}g}")  # 120, where digits=2 alone gives 1.2e+02
    return f"{shown:g} {_PREFIXES[power]}{unit}".strip()


def figure_tables(figure: str) -> list[str]:
    """Return the tables that a figure shows, below `results/`; `<sample>` stands for its sample.

    Examples
    --------
    >>> figure_tables("<sample>/exponent_path")[0]
    '<sample>/energy_split_path.csv'
    """
    return [file.path for file in result_files() if figure in file.figures]


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
    """Return a picture inside the page: in 256 colours, a third of what it takes in its file."""
    with Image.open(path) as picture:
        colours = picture.convert("RGB").quantize(256, dither=Image.Dither.NONE)
    small = io.BytesIO()
    colours.save(small, "PNG", optimize=True)
    return "data:image/png;base64," + base64.b64encode(small.getvalue()).decode()


def _number(value: float | None, form: str = "%.3f") -> str:
    """Format a number that may be missing."""
    return "none" if value is None or value != value else form % value
