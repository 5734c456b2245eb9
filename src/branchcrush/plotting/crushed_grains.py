"""Who breaks and who survives: ROC curves, hazards, the exponent along the crushing, and loads."""

import os

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from branchcrush.files.tables import Table
from branchcrush.plotting.form_lines import plain_decades
from branchcrush.plotting.style import (
    FAINT,
    MEASURED,
    MODEL,
    OTHER,
    axes,
    figure,
    grid,
    legend_above,
    reason,
)

# What the curves are drawn of, their labels and colours.
_CURVES = {
    "stress_over_strength": ("stress/strength", MODEL),
    "stress": ("stress", MEASURED),
    "largest_force": ("largest force", OTHER),
    "contacts": ("contacts", "#7d5ba6"),
    "split_energy": (r"paper's split, $\Sigma l^3$", "#c99a1a"),
}
_GROUPS = {"large": ("large grains", MEASURED), "fragments": ("fragments", MODEL)}
_NOTHING = "no grain broke"


def plot_roc(areas: Table, curves: Table, among: str = "bearing", ax: Axes | None = None) -> Axes:
    """Draw the ROC curves of some foretellers, with the areas under them.

    Parameters
    ----------
    areas, curves : DataFrame
        `crushed_predictors.csv` and `crushed_roc.csv`.
    among : str
        "all" grains above the limit, or the "bearing" ones.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, (label, color) in _CURVES.items():
        area = areas[(areas["among"] == among) & (areas["foreteller"] == name)]
        curve = curves[(curves["among"] == among) & (curves["foreteller"] == name)]
        if len(area) and np.isfinite(area["area"].iloc[0]):
            text = f"{label}: {area['area'].iloc[0]:.2f}"
            ax.plot(curve["false_alarms"], curve["found"], color=color, label=text)
    if not ax.lines:
        return reason(ax, _NOTHING)
    ax.plot([0, 1], [0, 1], color=FAINT, linestyle=":", label="by chance: 0.50")
    ax.set_xlabel("share of the spared taken for breaking [-]")
    ax.set_ylabel("share of the breaking found [-]")
    legend_above(ax, 2, "area under the curve")
    return ax


def plot_hazard(hazards: Table, by: str, ax: Axes | None = None) -> Axes:
    """Draw breakages per grain and state by contacts or by radius.

    Parameters
    ----------
    hazards : DataFrame
        `crushed_hazards.csv`.
    by : str
        "contacts" or "radius".
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    groups = _GROUPS if by == "contacts" else {"all": ("all grains", MEASURED)}
    kept = hazards[(hazards["by"] == by) & hazards["group"].isin(list(groups))]
    if not len(kept):
        return reason(ax, _NOTHING)
    lows = sorted(kept["low"].unique())
    for shift, (group, (label, color)) in enumerate(groups.items()):
        of = kept[kept["group"] == group]
        place = [lows.index(low) + 0.12 * (2 * shift - len(groups) + 1) for low in of["low"]]
        _bars(ax, place, of, "hazard", color, label, scale=100.0)
    high = dict(zip(kept["low"], kept["high"], strict=True))
    ax.set_xticks(range(len(lows)), [_class(low, high[low], by) for low in lows])
    ax.set_xlabel("contacts" if by == "contacts" else "diameter/comminution limit [-]")
    ax.set_ylabel("break until the next state [%]")
    ax.set_ylim(0.0, None)
    if len(groups) > 1:
        legend_above(ax, 2)
    return ax


def _class(low: float, high: float, by: str) -> str:
    if not np.isfinite(high):
        return f"{low:g}+"
    return f"{low:g}–{high - 1:g}" if by == "contacts" else f"{low:g}–{high:g}"


def _bars(ax, place, table, name, color, label, scale=1.0):
    value, low, high = (table[name + end].to_numpy(float) for end in ("", "_low", "_high"))
    error = np.nan_to_num(np.array([value - low, high - value])) * scale
    ax.errorbar(place, value * scale, yerr=error, fmt="o", color=color, label=label)


def plot_exponents(exponents: Table, ax: Axes | None = None) -> Axes:
    """Draw the exponent of the energy split along the crushing, beside the control's.

    Parameters
    ----------
    exponents : DataFrame
        `crushed_exponents.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    if "exponent" not in exponents or not np.isfinite(exponents["exponent"]).any():
        return reason(ax, "no loaded state bears an exponent")
    phi, seen = exponents["solid_fraction"], []
    for name, label, color in (
        ("exponent", "grains break", MODEL),
        ("control_exponent", "grains do not break", MEASURED),
    ):
        if name in exponents and np.isfinite(exponents[name]).any():
            ax.plot(phi, exponents[name], "o-", color=color, label=label)
            limits = exponents[name + "_low"], exponents[name + "_high"]
            ax.fill_between(phi, *limits, color=color, alpha=0.15, linewidth=0)
            seen.append(exponents[name])
    ax.axhline(3.0, color=FAINT, linestyle=":", label="paper, 3")
    # The bands of few seeds would leave the lines no height: they are cut.
    ax.set_ylim(min(0.0, *(one.min() for one in seen)), max(6.0, *(one.max() for one in seen)))
    ax.set_xlabel("solid fraction φ [-]")
    ax.set_ylabel("exponent n [-]")
    legend_above(ax, 3)
    return ax


def plot_loads(loads: Table, ax: Axes | None = None) -> Axes:
    """Draw the mean largest force of first grains and fragments that bear load, by their size.

    Parameters
    ----------
    loads : DataFrame
        `crushed_loads.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for kind, color, marker in (("first grains", MEASURED, "s"), ("fragments", MODEL, "o")):
        of = loads[(loads["kind"] == kind) & np.isfinite(loads["largest_force_N"])]
        if not len(of):
            continue
        force = of["largest_force_N"]
        low = np.maximum(of["largest_force_low_N"], force / 10.0)  # none below 0 on this axis
        error = np.nan_to_num(np.array([force - low, of["largest_force_high_N"] - force]))
        middle = np.sqrt(of["low"] * of["high"])
        ax.errorbar(middle, force, yerr=error, fmt=marker + "-", color=color, label=kind)
    if not ax.containers:
        return reason(ax, "no grain bears load at the end")
    ax.set_xscale("log", base=2)
    ax.set_yscale("log")
    ax.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    ax.axvline(1.0, color=FAINT, linestyle=":")
    ax.set_xlabel("diameter/comminution limit [-]")
    ax.set_ylabel("mean largest force [N]")
    plain_decades(ax.yaxis)
    legend_above(ax, 2)
    return ax


def draw_who_breaks(
    path: str | os.PathLike, dpi: int, areas: Table, curves: Table, hazards: Table
) -> Figure:
    """Draw ROC curves and hazards, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    areas, curves, hazards : DataFrame
        `crushed_predictors.csv`, `crushed_roc.csv` and `crushed_hazards.csv`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi, *grid(3, 1)) as (top, middle, bottom):
        plot_roc(areas, curves, ax=top)
        plot_hazard(hazards, "contacts", ax=middle)
        plot_hazard(hazards, "radius", ax=bottom)
    return top.figure


def draw_split_of_crushed(
    path: str | os.PathLike, dpi: int, exponents: Table, loads: Table
) -> Figure:
    """Draw the exponent along the crushing and the forces by size at its end; return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    exponents, loads : DataFrame
        `crushed_exponents.csv` and `crushed_loads.csv`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi, *grid(1, 2)) as (left, right):
        plot_exponents(exponents, ax=left)
        plot_loads(loads, ax=right)
    return left.figure
