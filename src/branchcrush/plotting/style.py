"""How every figure looks, and how it is saved."""

import os
import sys
import textwrap
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from branchcrush.files.tables import Table
from branchcrush.plotting.saving import save

# Jobs draw into files alone. Who drew before, or a notebook, has chosen where figures are shown.
if "matplotlib.pyplot" not in sys.modules and "MPLBACKEND" not in os.environ:
    matplotlib.use("Agg")
from matplotlib import pyplot as plt

MEASURED, MODEL, OTHER, FAINT = "#1f4e79", "#c1440e", "#3a7d44", "#9aa5b1"
# What the two states are called that networks are measured in, and their colours.
STATES = {"near_jamming": ("near jamming", "#6f9bc4"), "end": ("at the end", MEASURED)}
# The forms of the crushing model: ours, the paper's and its kin, Einav's and its kin.
FORMS = {
    "moving_jamming": MODEL,
    "paper": MEASURED,
    "density": "#6f9bc4",
    "measured_contacts": "#7d5ba6",
    "einav": OTHER,
    "tengattini": "#8dbf8b",
}
# One column of a journal page, 85 mm wide; a figure of two columns is 170 mm [inch].
SIZE = (85.0 / 25.4, 66.0 / 25.4)
# Of a letter of 7 points, on average [points].
_LETTER = 4.0
# Solid fractions are drawn on an axis that is at least so wide [-].
LEAST_SPREAD = 0.05

STYLE = {
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "legend.fontsize": 6.5,
    "legend.frameon": False,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "mathtext.fontset": "dejavusans",
    # Numbers as they are: no axis whose marks are to be added to one number at its end.
    "axes.formatter.useoffset": False,
    # Letters as outlines in SVG and as TrueType in PDF: they look alike wherever they are opened.
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
    # The same data give the same bytes.
    "svg.hashsalt": "branchcrush",
}


def axes(ax: Axes | None = None) -> Axes:
    """Return the given Axes, or those of a new figure of one journal column.

    Examples
    --------
    >>> ax = axes()
    >>> axes(ax) is ax
    True
    """
    return ax if ax is not None else plt.subplots(figsize=SIZE, layout="constrained")[1]


def grid(rows: int, columns: int) -> tuple[tuple[float, float], tuple[int, int]]:
    """Return size [inch] and panels of a figure of panels of one journal column each.

    Examples
    --------
    >>> size, panels = grid(1, 2)
    >>> [round(25.4 * side, 9) for side in size], panels
    ([170.0, 66.0], (1, 2))
    """
    return (columns * SIZE[0], rows * SIZE[1]), (rows, columns)


@contextmanager
def figure(
    path: str | os.PathLike,
    dpi: int,
    size: tuple[float, float] = SIZE,
    panels: tuple[int, int] = (1, 1),
    squeeze: bool = True,
    projection: str | None = None,
) -> Iterator[Any]:
    """Draw a figure and save it: yields its Axes, one or an array of them.

    Parameters
    ----------
    path : path-like
        As `saving.save` writes it.
    dpi : int
        Dots per inch, of what is no line or letter too.
    size : tuple of float
        [inch]
    panels : tuple of int
        Rows and columns.
    squeeze : bool
        Whether one panel comes alone and one row or column as a list, or all as an array.
    projection : str, optional
        As polar.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with figure(Path(folder) / "new" / "line.png", 50) as ax:
    ...         _ = ax.plot([0, 1], [0, 1])
    ...     (Path(folder) / "new" / "line.png").exists()
    True
    """
    with plt.rc_context(STYLE):
        drawing, ax = plt.subplots(
            *panels,
            figsize=size,
            dpi=dpi,
            layout="constrained",
            squeeze=squeeze,
            subplot_kw={"projection": projection},
        )
        yield ax
        letter(drawing)
        save(drawing, path, dpi)
        plt.close(drawing)


def letter(drawing: Figure) -> list[str]:
    """Write (a), (b), (c) at the panels of a figure that has more than one, and return them.

    Parameters
    ----------
    drawing : Figure
        Scales of colour, second axes and panels without anything get none.

    Returns
    -------
    list of str

    Examples
    --------
    >>> drawing, (left, right) = plt.subplots(1, 2)
    >>> _ = left.twinx()
    >>> letter(drawing)
    ['(a)', '(b)']
    """
    places: dict[Any, Axes] = {}
    for ax in drawing.axes:
        place = ax.get_subplotspec()
        if place is None or ax.get_label() == "<colorbar>":
            continue
        if ax.axison or ax.texts or ax.images or ax.lines or ax.collections:
            places.setdefault((place.num1, place.num2), ax)
    panels = list(places.values())
    letters = [f"({chr(ord('a') + number)})" for number in range(len(panels))]
    if len(panels) < 2:
        return []
    for text, ax in zip(letters, panels, strict=True):
        beside = {"xytext": (-24, 9), "textcoords": "offset points", "ha": "right"}
        written = ax.annotate(text, (0, 1), xycoords="axes fraction", va="bottom", **beside)
        written.set(weight="bold", gid="letter")
    return letters


def drawn(plot: Callable[..., Axes], why: str | None, *data: Any, ax: Axes) -> Axes:
    """Draw data on an Axes, or write there why there are none, and return it.

    Parameters
    ----------
    plot : callable
        Takes the data and `ax`.
    why : str or None
        The reason of a result without data.
    *data
        For the plot.
    ax : Axes

    Returns
    -------
    Axes

    Examples
    --------
    >>> drawn(len, "no load", ax=axes()).texts[0].get_text()
    'no data: no load'
    """
    return plot(*data, ax=ax) if why is None else reason(ax, why)


def reason(ax: Axes, text: str) -> Axes:
    """Write on an Axes why there is nothing to draw, and return it."""
    width = 72.0 * ax.get_position().width * ax.figure.get_figwidth()
    lines = textwrap.fill(f"no data: {text}", max(int(width / _LETTER), 12))
    ax.text(0.5, 0.5, lines, ha="center", va="center", transform=ax.transAxes, fontsize=7)
    ax.set_axis_off()
    return ax


def widen(ax: Axes, least: float = LEAST_SPREAD) -> Axes:
    """Widen the horizontal axis about its middle to a least width, and return the Axes.

    Of one state, or of packings that differ by rounding, an axis would show the last digits.

    Parameters
    ----------
    ax : Axes
    least : float
        In units of the axis; by default for solid fractions [-].

    Returns
    -------
    Axes

    Examples
    --------
    >>> ax = axes()
    >>> _ = ax.plot([0.71, 0.71 + 1e-9], [1.0, 2.0])
    >>> [float(round(end, 6)) for end in widen(ax, 0.02).get_xlim()]
    [0.7, 0.72]
    """
    low, high = ax.get_xlim()
    if high - low < least:
        middle = (low + high) / 2.0
        ax.set_xlim(middle - least / 2.0, middle + least / 2.0)
    return ax


def legend_above(ax: Axes, columns: int = 1, title: str | None = None) -> Axes:
    """Put the legend above the panel, where no data are, and return the Axes.

    Parameters
    ----------
    ax : Axes
    columns : int
        Of entries.
    title : str, optional

    Returns
    -------
    Axes

    Examples
    --------
    >>> ax = axes()
    >>> _ = ax.plot([0, 1], [0, 1], label="line")
    >>> legend = legend_above(ax, title="what is drawn").get_legend()
    >>> bool(legend.get_window_extent().y0 >= ax.get_window_extent().y1)
    True
    """
    place = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "borderaxespad": 0.2}
    close = {"columnspacing": 1.0, "handlelength": 1.6, "alignment": "left"}
    ax.legend(ncols=columns, title=title, title_fontsize=6.5, **place, **close)
    return ax


def of_states(table: Table) -> Iterator[tuple[str, Table]]:
    """Return the rows of each state that a table of networks has, in the order of `STATES`.

    Parameters
    ----------
    table : DataFrame
        With a column `where`, of names in `STATES`.

    Returns
    -------
    iterator of (str, DataFrame)
        The name of the state and its rows.

    Examples
    --------
    >>> import pandas as pd
    >>> [where for where, _ in of_states(pd.DataFrame({"where": ["end", "end"]}))]
    ['end']
    """
    for where in STATES:
        rows = table[table["where"] == where]
        if len(rows):
            yield where, rows


def above_jamming(table: Table) -> tuple[Any, str]:
    """Return what to draw a path against, and its label: phi - phi_J, or phi where it is unknown.

    Parameters
    ----------
    table : DataFrame
        With columns solid_fraction and solid_fraction_above_jamming.

    Returns
    -------
    values : Series
        [-]
    label : str

    Examples
    --------
    >>> import pandas as pd
    >>> columns = {"solid_fraction": [0.7], "solid_fraction_above_jamming": [float("nan")]}
    >>> above_jamming(pd.DataFrame(columns))[0].tolist()
    [0.7]
    """
    above = table["solid_fraction_above_jamming"]
    if above.isna().any():
        return table["solid_fraction"], r"solid fraction $\phi$ [-]"
    return above, r"solid fraction above jamming $\phi - \phi_J$ [-]"
