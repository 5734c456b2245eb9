"""How a form of the crushing model is drawn: its colour, and where it is admissible.

The form on the front is drawn over the others, and wider. A form is drawn dashed and faint from
where crushing by it would cost elastic energy, and dashed where it yields beyond the measured law.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping
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

_SHORT = 50.0  # ends of an axis that has few decades
# Where a form yields at larger elastic strains than any packing had.
_EXTRAPOLATED = "beyond the measured law"
_BEYOND: dict[str, Any] = {"ls": (0, (5, 1.5)), "label": _EXTRAPOLATED}
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


def draw_form(
    ax: Axes, rows: Table, model: Mapping, x: NDArray, y: NDArray, *, at_yield: bool = False
) -> NDArray:
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
    at_yield : bool
        Whether it is told at the elastic strain of yield: then it is dashed where that is larger
        than any that was measured.

    Returns
    -------
    ndarray of bool, shape (rows,)
        Where it is admissible.
    """
    name = rows["form"].iloc[0]
    begin = model["forms"][name]["inadmissible_from"]
    admissible = np.full(len(rows), True) if begin is None else rows["crushing"].to_numpy() < begin
    style = {"color": FORMS[name], "lw": width(name, model), "gid": name}
    kept = int(admissible.sum())
    beyond = (beyond_law(rows, model) & np.isfinite(y))[:kept] & at_yield
    if kept:
        solid = np.where(beyond, np.nan, y[:kept])
        ax.plot(x[:kept], solid, label=FORM_LABELS[name], **style)
    if beyond.any():
        # Up to the points beside, so that the line has no gaps.
        around = beyond.copy()
        around[1:] |= beyond[:-1]
        around[:-1] |= beyond[1:]
        ax.plot(x[:kept], np.where(around, y[:kept], np.nan), **style | _BEYOND)
    if kept < len(rows):
        first = max(kept - 1, 0)
        faint = {"ls": (0, (3, 2)), "lw": 0.8, "alpha": 0.45, "gid": None}
        ax.plot(x[first:], y[first:], **style | faint)
    return admissible


def beyond_law(rows: Table, model: Mapping) -> NDArray:
    """Return where a form yields at an elastic strain larger than any that was measured.

    Parameters
    ----------
    rows : DataFrame
        Of one form in `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    ndarray of bool, shape (rows,)
    """
    return rows["yield_elastic_strain"].to_numpy() > model["largest_strain"]


def width(name: str, model: Mapping) -> float:
    """Return how wide a form is drawn: the one on the front wider."""
    return 2.0 if name == model["form"] else 1.0


def form_handles(
    model: Mapping, shown: Collection[str], snaps: bool = True, beyond: bool = False
) -> list[Line2D]:
    """Return what a legend of forms shows, and what dashed lines and marks mean.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.
    shown : collection of str
        Names of forms.
    snaps : bool
        Whether jumps under stress are marked.
    beyond : bool
        Whether a line is dashed beyond the measured law.

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
    if beyond:
        handles.append(Line2D([], [], color="0.3", lw=1.2, **_BEYOND))
    if snaps and any(form["snaps"] for form in forms.values()):
        handles.append(Line2D([], [], color="0.5", **SNAP, label="under stress C jumps"))
    return handles


def extrapolates(panels: Iterable[Axes]) -> bool:
    """Return whether a line in one of the panels is dashed, beyond the measured law.

    Parameters
    ----------
    panels : iterable of Axes
    """
    return any(line.get_label() == _EXTRAPOLATED for ax in panels for line in ax.lines)


def plain_decades(axis: Axis) -> None:
    """Write the marks of a logarithmic axis as plain numbers, more of them on a short one."""
    low, high = sorted(axis.get_view_interval())
    steps = (1.0, 2.0, 5.0) if high < _SHORT * low else (1.0,)
    axis.set_major_locator(LogLocator(subs=steps, numticks=12 if len(steps) > 1 else 6))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
