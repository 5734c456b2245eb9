"""Estimates with their intervals: points with bars, and bands along a path."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from branchcrush.files.tables import Table
from branchcrush.statistics.intervals import interval_names


def draw_points(
    ax: Axes,
    x: ArrayLike,
    rows: Table,
    column: str,
    color: str,
    label: str | None,
    marker: str = "o",
    floor: float = 0.0,
) -> None:
    """Draw points with their intervals, those below a floor cut there.

    Parameters
    ----------
    ax : Axes
    x : array_like, shape (n,)
    rows : DataFrame, n rows
    column : str
        Of the estimate; its limits are the columns that `statistics.intervals.interval_names`
        says. Without any limit no bars are drawn.
    color, label, marker : str
    floor : float
        Where lower limits end: none goes through 0 of a logarithmic axis.

    Examples
    --------
    >>> import pandas as pd
    >>> from branchcrush.plotting.style import axes
    >>> ax, rows = axes(), pd.DataFrame({"y": [1.0], "y_low": [-1.0], "y_high": [3.0]})
    >>> draw_points(ax, [0.0], rows, "y", "black", "one", floor=0.5)
    >>> [bar.get_segments()[0][:, 1].tolist() for bar in ax.containers[0][2]]
    [[0.5, 3.0]]
    """
    y, low, high = (rows[name] for name in interval_names(column))
    error = None
    if low.notna().any():
        error = np.array([y - np.maximum(low, floor), high - y]).clip(0.0)
    ax.errorbar(x, y, error, fmt=marker, ms=3, color=color, lw=0.8, label=label)


def draw_band(
    ax: Axes,
    x: ArrayLike,
    rows: Mapping,
    column: str,
    color: str,
    label: str | None = None,
    alpha: float = 0.2,
) -> None:
    """Draw the interval of an estimate along a path: a band, or a bar where there is one state.

    Parameters
    ----------
    ax : Axes
    x : array_like, shape (n,)
    rows : DataFrame or mapping of columns, n rows
    column : str
        Of the estimate; its limits are the columns that `statistics.intervals.interval_names`
        says.
    color, label : str
    alpha : float
        Opacity of the band.

    Examples
    --------
    >>> import pandas as pd
    >>> from branchcrush.plotting.style import axes
    >>> ax, rows = axes(), pd.DataFrame({"n": [3.0], "n_low": [2.5], "n_high": [3.5]})
    >>> draw_band(ax, [0.1], rows, "n", "black")
    >>> [bar.get_segments()[0][:, 1].tolist() for bar in ax.containers[0][2]]
    [[2.5, 3.5]]
    """
    y, low, high = (np.asarray(rows[name], dtype=float) for name in interval_names(column))
    if y.size == 1:
        bars = np.array([y - low, high - y]).clip(0.0)
        ax.errorbar(x, y, bars, fmt="none", ecolor=color, lw=0.8, label=label)
    else:
        ax.fill_between(x, low, high, color=color, alpha=alpha, lw=0, label=label)
