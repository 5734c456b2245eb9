"""Figures 3 and 7 of the paper: the grading and the distribution of branch lengths."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from numpy.typing import NDArray

from branchcrush.files.tables import Table
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, axes

# The units of a user as an axis names them [m].
_UNITS = {"cm": ("cm", 1e-2), "mm": ("mm", 1e-3), "um": ("µm", 1e-6), "inch": ("inch", 0.0254)}
_ULTIMATE, _DARK = "#b9d6bd", "#5c6873"


def plot_grading(grading: Table, ax: Axes | None = None) -> Axes:
    """Draw the sieve curve and the distribution by number: target and realised (Fig. 3).

    The ultimate grading is drawn as well if the table has it.

    Parameters
    ----------
    grading : DataFrame
        `grading.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    unit, scale = ("mm", 1e3) if grading["diameter_m"].max() >= 1e-4 else ("µm", 1e6)
    diameter = grading["diameter_m"] * scale
    low, high = (grading[f"percent_finer_by_mass_realised_{end}"] for end in ("min", "max"))
    ax.fill_between(diameter, low, high, color=MEASURED, alpha=0.2, lw=0, label="all seeds")
    for name, label, line, color in (
        ("by_mass_realised", "by mass, mean of seeds", "-", MEASURED),
        ("by_mass_target", "by mass, target", "--", MODEL),
        ("by_mass_ultimate", "by mass, ultimate", "-.", OTHER),
        ("by_number_target", "by number, target", ":", FAINT),
    ):
        column = f"percent_finer_{name}"
        if column in grading:
            ax.plot(diameter, grading[column], line, color=color, label=label)
    ax.set(xscale="log", ylabel="percent finer [%]", ylim=(0, 102))
    ax.set_xlabel(f"grain diameter D [{unit}]")
    mark_sizes(ax.xaxis, diameter.max() / diameter.min())
    # Curves by mass and by number leave different corners free.
    ax.legend(loc="best")
    return ax


def plot_preview(
    grading: Mapping[str, NDArray], unit: str, drawn: str = "drawn", ax: Axes | None = None
) -> Axes:
    """Draw a grading by mass and by number: asked for, drawn, and the ultimate one.

    Parameters
    ----------
    grading : mapping of ndarray
        `diameter_m` and the columns of percent finer as of `grading.csv`; what it lacks is not
        drawn.
    unit : str
        Of the diameters, as the user gave it; m is shown as mm or µm.
    drawn : str
        What drawn grains are called.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    size = np.asarray(grading["diameter_m"], dtype=float)
    near = "mm" if size.max() >= 1e-4 else "um"
    unit, metres = _UNITS[near if unit == "m" else unit]
    diameter = size / metres
    for name, label, line, color, width in (
        # Wide and below the others, which it may lie on.
        ("by_mass_ultimate", "by mass, ultimate", "-", _ULTIMATE, 3.0),
        ("by_mass_realised", f"by mass, {drawn}", "-", MEASURED, 1.2),
        ("by_mass_target", "by mass", "--", MODEL, 1.2),
        ("by_number_realised", f"by number, {drawn}", "-", FAINT, 0.8),
        ("by_number_target", "by number", ":", _DARK, 1.2),
    ):
        column = f"percent_finer_{name}"
        if column in grading:
            ax.plot(diameter, grading[column], line, color=color, lw=width, label=label)
    ax.set(xscale="log", ylabel="percent finer [%]", ylim=(0, 102))
    ax.set_xlabel(f"grain diameter D [{unit}]")
    mark_sizes(ax.xaxis, diameter.max() / diameter.min(), narrow=300)
    # Curves by mass and by number leave different corners free.
    ax.legend(loc="best")
    return ax


def mark_sizes(axis: Axis, ratio: float, narrow: float = 30.0) -> None:
    """Mark sizes on a logarithmic axis, with numbers as they are.

    Parameters
    ----------
    axis : Axis
    ratio : float
        Largest over smallest size on it [-].
    narrow : float
        Below which more than the decades are marked [-].
    """
    # The marks of a logarithmic axis are decades, of which narrow gradings have one or none.
    if ratio < 6:
        axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    else:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if ratio < narrow else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda size, _: f"{size:g}"))
    axis.set_minor_formatter(NullFormatter())
