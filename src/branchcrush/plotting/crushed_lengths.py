"""Branch lengths while grains break, in mean diameters of the grains of the time."""

import os
from collections.abc import Mapping

from matplotlib import colormaps
from matplotlib.axes import Axes

from branchcrush.files.tables import Table
from branchcrush.plotting.form_lines import plain_decades
from branchcrush.plotting.intervals import draw_band
from branchcrush.plotting.style import FAINT, MODEL, axes, drawn, figure, legend_above

# A density that is not told from 0 on the axis.
_LEAST = 0.01
_PREDICTED = {
    "density_by_rods": ("rods that push", {"color": MODEL, "ls": "--"}),
    "density_random_contact": ("Eq. 4, any two alike", {"color": FAINT, "ls": ":"}),
}


def plot_lengths(lengths: Table, ax: Axes | None = None) -> Axes:
    """Draw the distribution of branch length at stages, and what the last grading predicts.

    Parameters
    ----------
    lengths : DataFrame
        `crushing_lengths.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    stages = lengths["state"].unique()
    for k, stage in enumerate(stages):
        rows = lengths[lengths["state"] == stage]
        # As the stages of the gradings.
        color = colormaps["viridis"](0.9 * k / max(len(stages) - 1, 1))
        ratio = _middle(rows)
        label = rf"$\phi$ = {rows['solid_fraction'].iloc[0]:.3f}"
        ax.plot(ratio, rows["density"], color=color, label=label)
        draw_band(ax, ratio, rows, "density", color, alpha=0.12)
    for name, (label, style) in _PREDICTED.items():
        if rows[name].notna().any():
            ax.plot(ratio, rows[name], label=f"{label}, at the end", gid=name, **style)
    ax.set(xscale="log", xlabel=r"branch length over mean diameter $l/\langle d \rangle$ [-]")
    ax.set(ylabel=r"density of $\ln\,l$ [-]")
    ax.set_ylim(0.0, 1.1 * lengths["density"].max())
    ends = lengths[lengths[["density", *_PREDICTED]].max(axis=1) > _LEAST]
    ax.set_xlim(
        ends["length_over_diameter_low"].min(), 1.05 * ends["length_over_diameter_high"].max()
    )
    plain_decades(ax.xaxis)
    return legend_above(ax, 2)


def draw_lengths(path: str | os.PathLike[str], dpi: int, lengths: Table, summary: Mapping) -> None:
    """Draw the branch lengths of a crushing.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    lengths : DataFrame
        `crushing_lengths.csv`.
    summary : mapping
        `crushing.json`.
    """
    none = None if len(lengths) else "no stage of the crushing has contacts"
    why = none if summary["breakages"] else "no grain broke"
    with figure(path, dpi) as ax:
        drawn(plot_lengths, why, lengths, ax=ax)


def _middle(rows: Table) -> Table:
    return (rows["length_over_diameter_low"] * rows["length_over_diameter_high"]) ** 0.5
