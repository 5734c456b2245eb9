"""How a page is rendered: its template with the parts beside it, and the filters of all pages."""

import base64
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from jinja2 import DictLoader, Environment, StrictUndefined, Template
from markupsafe import Markup

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.local_exponents import trend
from branchcrush.files.dictionary import result_files
from branchcrush.statistics.intervals import LIMITS, Interval, interval_text
from branchcrush.study.crushing_words import form_rows, share_text, yes_or_no
from branchcrush.study.glossary import read_glossary, terms_by_name, with_subscripts

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
    """Return a picture inside the page."""
    return "data:image/png;base64," + base64.b64encode(Path(path).read_bytes()).decode()


def _number(value: float | None, form: str = "%.3f") -> str:
    """Format a number that may be missing."""
    return "none" if value is None or value != value else form % value
