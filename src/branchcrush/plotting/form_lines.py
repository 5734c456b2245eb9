"""How a form of the crushing model is drawn: its colour, where it is admissible, and its words.

The form on the front is drawn over the others, and wider. A form is drawn dashed and faint from
where crushing by it would cost elastic energy.
"""

from collections.abc import Collection, Iterator, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from numpy.typing import NDArray

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.tables import Table
from branchcrush.plotting.style import FORMS
from branchcrush.study.crushing_words import extrapolated_from

_SHORT = 50.0  # ends of an axis that has few decades
# Where C jumps under stress.
SNAP: dict[str, Any] = {"marker": "v", "ms": 5, "mec": "w", "mew": 0.5, "ls": "none"}


def each_form(table: Table, model: Mapping) -> Iterator[tuple[str, Table]]:
    """Return name and rows of each form in a table, the one on the front last.

    Parameters
    ----------
    table : DataFrame
        With a column `form`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    iterator of (str, DataFrame)
    """
    there = set(table["form"])
    for name in sorted(FORM_LABELS, key=lambda name: name == model["form"]):
        if name in there:
            yield name, table[table["form"] == name]


def beside_the_paper(model: Mapping) -> set[str]:
    """Return the forms that set energy free up to C = 1, the paper's, and the one on the front.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    set of str
    """
    there = {name: form for name, form in model["forms"].items() if not form.get("reason")}
    free = {name for name, form in there.items() if form["inadmissible_from"] is None}
    return free | ({"paper", model["form"]} & there.keys())


def draw_form(ax: Axes, rows: Table, model: Mapping, x: NDArray, y: NDArray) -> NDArray:
    """Draw a form, dashed and faint from the last C on at which it is admissible.

    Parameters
    ----------
    ax : Axes
    rows : DataFrame
        Of one form in `crushing_forms.csv`, by rising C.
    model : mapping
        `thermodynamics.json`.
    x, y : ndarray, shape (rows,)
        What is drawn, in the units of the axes.

    Returns
    -------
    ndarray of bool, shape (rows,)
        Where it is admissible.
    """
    name = rows["form"].iloc[0]
    begin = model["forms"][name]["inadmissible_from"]
    admissible = np.full(len(rows), True) if begin is None else rows["crushing"].to_numpy() < begin
    style = {"color": FORMS[name], "lw": width(name, model)}
    kept = int(admissible.sum())
    if kept:
        ax.plot(x[:kept], y[:kept], label=FORM_LABELS[name], **style)
    if kept < len(rows):
        first = max(kept - 1, 0)
        faint = {"ls": (0, (3, 2)), "lw": 0.8, "alpha": 0.45}
        ax.plot(x[first:], y[first:], **style | faint)
    return admissible


def width(name: str, model: Mapping) -> float:
    """Return how wide a form is drawn: the one on the front wider."""
    return 2.0 if name == model["form"] else 1.0


def form_handles(model: Mapping, shown: Collection[str], snaps: bool = True) -> list[Line2D]:
    """Return what a legend of forms shows, and what dashed lines and marks mean.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.
    shown : collection of str
        Names of forms.
    snaps : bool
        Whether jumps under stress are marked.

    Returns
    -------
    list of Line2D
    """
    forms = {name: model["forms"][name] for name in FORM_LABELS if name in shown}
    handles = [
        Line2D([], [], color=FORMS[name], lw=width(name, model), label=FORM_LABELS[name])
        for name in forms
    ]
    if any(form["inadmissible_from"] is not None for form in forms.values()):
        handles.append(Line2D([], [], color="0.5", ls="--", lw=0.9, label="not admissible"))
    if snaps and any(form["snaps"] for form in forms.values()):
        handles.append(Line2D([], [], color="0.5", **SNAP, label="under stress C jumps"))
    return handles


def form_notes(model: Mapping, shown: Collection[str]) -> list[str]:
    """Return in words by which forms crushing costs energy, and from where on.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.
    shown : collection of str
        Names of forms.

    Returns
    -------
    list of str
        A sentence, or none.

    Examples
    --------
    >>> forms = {"moving_jamming": {"inadmissible_from": 0.549}}
    >>> form_notes({"forms": forms}, ["moving_jamming"])
    ['Crushing would cost elastic energy: moving jamming point, from C = 0.55.']
    """
    costly = []
    for name in (name for name in FORM_LABELS if name in shown):
        begin = model["forms"][name]["inadmissible_from"]
        if begin is not None:
            where = "at all C" if begin == 0.0 else f"from C = {begin:.2f}"
            costly.append(f"{FORM_LABELS[name]}, {where}")
    return [f"Crushing would cost elastic energy: {'; '.join(costly)}."] if costly else []


def warnings(model: Mapping) -> list[str]:
    """Return what of the model is not to be relied on, a sentence each.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    list of str

    Examples
    --------
    >>> warnings({"paper_degenerate": "It degenerates.", "untested": "A ratio of 200. At C = 0.5"})
    ['It degenerates.', 'A ratio of 200.']
    """
    said = (model.get(key) for key in ("form_reason", "paper_degenerate", "untested"))
    return [f"{sentence.split('. ')[0].rstrip('.')}." for sentence in said if sentence]


def extrapolated(forms: Table, model: Mapping) -> list[str]:
    """Return in words from which C on the form on the front yields beyond the measured strains.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    list of str
        A sentence, or none.

    Examples
    --------
    >>> import pandas as pd
    >>> strains = {"crushing": [0.0, 0.5], "yield_elastic_strain": [0.01, 0.2]}
    >>> forms = pd.DataFrame(strains).assign(form="paper")
    >>> print(*extrapolated(forms, {"form": "paper", "largest_strain": 0.1}))
    From C = 0.50 on the front form yields at elastic strains above 10 %, beyond the measured law.
    """
    begin = extrapolated_from(forms, model)
    if begin is None:
        return []
    return [
        f"From C = {begin:.2f} on the front form yields at elastic strains above "
        f"{100 * model['largest_strain']:.2g} %, beyond the measured law."
    ]


def plain_decades(axis: Axis) -> None:
    """Write the marks of a logarithmic axis as plain numbers, more of them on a short one."""
    low, high = sorted(axis.get_view_interval())
    steps = (1.0, 2.0, 5.0) if high < _SHORT * low else (1.0,)
    axis.set_major_locator(LogLocator(subs=steps, numticks=12 if len(steps) > 1 else 6))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
