"""How every figure looks, and how it is saved."""

import textwrap
from contextlib import contextmanager
from pathlib import Path

import matplotlib
import numpy as np

from branchcrush.statistics.intervals import interval_names

matplotlib.use("Agg")
from matplotlib import pyplot as plt

MEASURED, MODEL, OTHER, FAINT = "#1f4e79", "#c1440e", "#3a7d44", "#9aa5b1"
# What the two states are called that networks are measured in, and their colours.
STATES = {"near_jamming": ("near jamming", "#6f9bc4"), "end": ("at the end", MEASURED)}
# One column of a journal page [inch].
SIZE = (3.5, 2.7)

_STYLE = {
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
}


def axes(ax=None):
    """Return the given Axes, or those of a new figure of one journal column."""
    return ax if ax is not None else plt.subplots(figsize=SIZE, layout="constrained")[1]


@contextmanager
def figure(path, dpi, size=SIZE, panels=(1, 1), squeeze=True):
    """Draw a figure and save it: yields its Axes, one or an array of them.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    size : tuple of float
        [inch]
    panels : tuple of int
        Rows and columns.
    squeeze : bool
        Whether one panel comes alone and one row or column as a list, or all as an array.
    """
    with plt.rc_context(_STYLE):
        drawn, ax = plt.subplots(*panels, figsize=size, layout="constrained", squeeze=squeeze)
        yield ax
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        # No date and no version of the plotting library: the same data give the same bytes.
        # A file a seventh larger than the smallest takes half the time to write.
        fast = {"compress_level": 2}
        drawn.savefig(path, dpi=dpi, metadata={"Software": None}, pil_kwargs=fast)
        plt.close(drawn)


def drawn(plot, result, *data, ax):
    """Draw a result on an Axes, or write there why there is none, and return it.

    Parameters
    ----------
    plot : callable
    result : dict
        With a key `reason` where there is nothing to draw.
    *data
        For the plot.
    ax : Axes
    """
    return reason(ax, result["reason"]) if "reason" in result else plot(*data, ax=ax)


def reason(ax, text):
    """Write on an Axes why there is nothing to draw, and return it."""
    lines = textwrap.fill(f"no data: {text}", 48)
    ax.text(0.5, 0.5, lines, ha="center", va="center", transform=ax.transAxes, fontsize=7)
    ax.set_axis_off()
    return ax


def of_states(table):
    return ((where, table[table["where"] == where]) for where in STATES)


def draw_points(ax, x, rows, column, color, label, marker="o", floor=0.0):
    """Draw points with their intervals, those below a floor cut there."""
    y, low, high = (rows[name] for name in interval_names(column))
    error = None
    if low.notna().any():
        error = np.array([y - np.maximum(low, floor), high - y]).clip(0.0)
    ax.errorbar(x, y, error, fmt=marker, ms=3, color=color, lw=0.8, label=label)
