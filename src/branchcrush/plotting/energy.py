"""Figures 5 and 6 of the paper, and the exponent along the loading path."""

import numpy as np
from matplotlib.axes import Axes

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.files.tables import Table
from branchcrush.plotting.intervals import draw_band
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, above_jamming, axes, widen
from branchcrush.statistics.intervals import interval_text

# Bins with fewer branches are marked with their count.
THIN = 100


def plot_energy_split(table: Table, fit: EnergySplitFit, ax: Axes | None = None) -> Axes:
    """Draw the energy-split function and its fitted power law (Fig. 5).

    Parameters
    ----------
    table : DataFrame
        `energy_split.csv`.
    fit : EnergySplitFit
        Read from `energy_split.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    empty = int((table["branches"] == 0).sum())
    table = table[table["branches"] > 0]
    x = table["branch_length_m"] / fit.reference_length
    line = np.linspace(0.0, x.max() * 1.03, 200)
    n = fit.exponent
    # From an interval that reaches below 0 a band would go up to the left, and hide the data.
    if n.low > 0:
        ax.fill_between(line, line**n.low, line**n.high, color=MODEL, alpha=0.2, lw=0)
    text = f"$(l/l_r)^n$, n = {interval_text(*n)}"
    ax.plot(line, line**n.estimate, color=MODEL, label=text)
    ax.plot(x, table["f"], "o", color=MEASURED, label=_seeds(fit))
    _mark_thin(ax, x, table["f"], table["branches"], empty)
    ax.set(xlabel=r"branch length $l/l_r$ [-]", ylabel=r"energy split $f(l)$ [-]")
    # With few seeds the band would dwarf the data.
    ax.set(xlim=(0, None), ylim=(0, 1.35 * table["f"].max()))
    ax.legend(loc="upper left", title=_title(fit), title_fontsize=6.5)
    return ax


def plot_cubic(table: Table, fit: EnergySplitFit, ax: Axes | None = None) -> Axes:
    """Draw the energy-split function against the cube of the length, with its R^2 (Fig. 6).

    Parameters
    ----------
    table, fit, ax
        As for `plot_energy_split`.

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    table = table[table["branches"] > 0]
    x = (table["branch_length_m"] / fit.reference_length) ** 3
    line = np.array([0.0, x.max() * 1.03])
    ax.plot(
        line,
        fit.cubic_slope * line,
        color=MODEL,
        label=f"f = {fit.cubic_slope:.3f} $(l/l_r)^3$, $R^2$ = {fit.cubic_r_squared:.4f}",
    )
    ax.plot(x, table["f"], "o", color=MEASURED, label=_seeds(fit))
    thin = table["branches"][table["branches"] < THIN]
    if len(thin):
        # Next to 0 they lie on top of each other, too close for a number each.
        counts = ", ".join(map(str, thin)) if len(thin) < 6 else f"{len(thin)} of them"
        ax.plot([], [], " ", label=f"bins below {THIN} branches: {counts}")
    ax.set(xlabel=r"$(l/l_r)^3$ [-]", ylabel=r"energy split $f(l)$ [-]")
    ax.set(xlim=(0, None), ylim=(0, 1.35 * table["f"].max()))
    ax.legend(loc="upper left")
    return ax


def plot_exponent_path(path: Table, fit: EnergySplitFit, ax: Axes | None = None) -> Axes:
    """Draw the exponent of the energy split along the loading path.

    Parameters
    ----------
    path : DataFrame
        `energy_split_path.csv`.
    fit : EnergySplitFit
        Read from `energy_split.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    path = path[path["exponent"].notna()]
    phi, label = above_jamming(path)
    if path["exponent_low"].notna().all():
        label_of_band = f"{fit.confidence:.0%} interval, {fit.packings.seeds} seeds"
        draw_band(ax, phi, path, "exponent", MEASURED, label_of_band)
    ax.plot(phi, path["exponent"], "o-", color=MEASURED, label="binned fit of all seeds")
    ax.axhline(PAPER_EXPONENT, color=MODEL, ls="--", lw=0.9, label="the paper's n = 3")
    ax.set(xlabel=label, ylabel="exponent n [-]")
    # With few seeds the band would dwarf the estimates.
    low, high = (
        min(PAPER_EXPONENT, path["exponent"].min()),
        max(PAPER_EXPONENT, path["exponent"].max()),
    )
    floor, ceiling = ax.get_ylim()
    ax.set_ylim(max(floor, low - 2.0), min(ceiling, high + 2.0))
    top = ax.twiny()
    top.set_xlim(widen(ax).get_xlim())
    shown = np.linspace(0, len(path) - 1, min(5, len(path))).astype(int)
    shown = _far_apart(shown, phi.to_numpy(), 0.1 * np.ptp(ax.get_xlim()))
    top.set_xticks(phi.iloc[shown], [f"{v:.3g}" for v in path["mean_stress_Pa"].iloc[shown] / 1e6])
    top.set_xlabel("mean stress [MPa]")
    top.spines["top"].set_visible(True)
    ax.legend(loc="best")
    return ax


def _far_apart(rows, places, distance):
    """Return the rows without those too near to the next, whose labels would overlap."""
    kept = []
    for row in reversed(rows):
        if not kept or abs(places[kept[-1]] - places[row]) >= distance:
            kept.append(row)
    return kept[::-1]


def _mark_thin(ax, x, y, counts, empty):
    for position, height, count in zip(x, y, counts, strict=True):
        if count < THIN:
            ax.annotate(
                f"{count}",
                (position, height),
                xytext=(0, 5),
                textcoords="offset points",
                ha="center",
                fontsize=5.5,
                color=FAINT,
            )
    if (counts < THIN).any() or empty:
        label = f"small numbers: branches in bins\nbelow {THIN}; {empty} bins are empty"
        ax.plot([], [], " ", label=label)


def _seeds(fit):
    seeds = fit.packings.seeds
    return f"{seeds} seed{'s' if seeds > 1 else ''}, bin means"


def _title(fit):
    title = rf"$\phi$ = {fit.packings.solid_fraction:.3f}"
    if not np.isfinite(fit.exponent.low):
        return title
    return f"{title}, {fit.confidence:.0%} interval"
