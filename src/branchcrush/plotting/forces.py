"""Whether the contact network leans one way: the fabric of each seed beside what chance gives."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from branchcrush.files.tables import Table
from branchcrush.forces.fabric import chance_range
from branchcrush.plotting.intervals import draw_points
from branchcrush.plotting.style import FAINT, OTHER, STATES, axes, legend_above, of_states
from branchcrush.statistics.intervals import Interval, interval_text

_KINDS = {"branches": ("", "o"), "forces": ("force_", "^")}


def plot_fabric(table: Table, summary: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the deviator of the fabric of each seed against the one expected by chance.

    Parameters
    ----------
    table : DataFrame
        `fabric.csv`.
    summary : dict
        `sharing.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    largest = 0.0
    for where, (label, color) in STATES.items():
        rows = table[table["where"] == where]
        if rows.empty:
            continue
        for kind, (key, marker) in _KINDS.items():
            expected = rows[f"expected_{key}deviator"]
            ratio = summary[where]["fabric"][kind]["deviator_over_expected"]
            ax.plot(
                expected,
                rows[f"{key}deviator"],
                marker,
                ms=3,
                color=color,
                mfc=color if kind == "branches" else "none",
                label=f"{kind}, {label}: {ratio:.2f}",
            )
            largest = max(largest, float(expected.max()))
    line = np.array([0.0, 1.1 * largest])
    low, high = chance_range(1)
    ax.fill_between(
        line,
        low * line,
        high * line,
        color=FAINT,
        alpha=0.25,
        lw=0,
        label="95 % of seeds by chance",
    )
    ax.plot(line, line, color=FAINT, lw=0.8)
    ax.set(
        xlabel=r"deviator expected by chance $1/\sqrt{M}$ [-]",
        ylabel="deviator of the fabric q [-]",
        xlim=(0, line[1] or 1.0),
    )
    ax.set_ylim(0, None)
    return legend_above(ax, title="root mean square over expected")


def plot_force_distribution(table: Table, summary: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the distribution of relative forces with its tail.

    Parameters
    ----------
    table : DataFrame
        `force_distribution.csv`.
    summary : dict
        `sharing.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for where, rows in of_states(table):
        label, color = STATES[where]
        rows = rows[rows["contacts"] > 0]
        x = (rows["force_low"] + rows["force_high"]) / 2.0
        draw_points(ax, x, rows, "density", color, label, floor=1e-6)
        tail = next(t for t in summary[where]["forces"]["tails"] if t["threshold"] == 2.0)
        if tail["decay_rate"] is not None:
            line = np.linspace(2.0, max(x.max(), 3.0), 20)
            scale = tail["share_above"] * tail["decay_rate"]
            text = rf"$e^{{-\beta f}}$, $\beta$ = {tail['decay_rate']:.2f}"
            ax.plot(
                line,
                scale * np.exp(-tail["decay_rate"] * (line - 2.0)),
                color=color,
                ls="--",
                lw=0.9,
                label=text,
            )
    ax.set(
        xlabel=r"normal force $F/\langle F\rangle$ [-]",
        ylabel=r"density $P(F/\langle F\rangle)$ [-]",
        yscale="log",
    )
    ax.set(xlim=(0, None), ylim=(max(ax.get_ylim()[0], 1e-5), None))
    return legend_above(ax, 2)


def plot_force_by_length(
    table: Table, summary: Mapping, radius_max: float, ax: Axes | None = None
) -> Axes:
    """Draw the mean force against branch length.

    Parameters
    ----------
    table : DataFrame
        `force_by_length.csv`.
    summary : dict
        `sharing.json`.
    radius_max : float
        [m]
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for where, rows in of_states(table):
        label, color = STATES[where]
        fit = summary[where]["forces"]["by_length"]
        if fit:
            label += f": m = {interval_text(*Interval.read(fit, 'exponent'))}"
        rows = rows[rows["branches"] >= 20]
        x = (rows["branch_length_low_m"] + rows["branch_length_high_m"]) / 2.0 / radius_max
        draw_points(ax, x, rows, "mean_force", color, label)
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.set(
        xlabel=r"branch length $l/R_M$ [-]",
        ylabel=r"mean force $\langle F\rangle_l/\langle F\rangle$ [-]",
    )
    ax.set(xlim=(0, None), ylim=(0, None))
    return legend_above(ax, title=r"bins of 20 branches or more; $F \sim l^m$")


def plot_stress_by_radius(table: Table, radius_max: float, ax: Axes | None = None) -> Axes:
    """Draw the mean stress of grains against their radius.

    Parameters
    ----------
    table : DataFrame
        `stress_by_radius.csv`.
    radius_max : float
        [m]
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for where, rows in of_states(table):
        label, color = STATES[where]
        x = rows["mean_radius_m"] / radius_max
        draw_points(ax, x, rows, "stress_ratio", color, label)
        ax.plot(
            x,
            rows["load_bearing_stress_ratio"],
            ":",
            color=color,
            label=f"{label}, without rattlers",
        )
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.set(xlabel=r"radius $R/R_M$ [-]", ylabel="mean stress over that of all [-]")
    top = max(1.5, 1.15 * float(table["stress_ratio"].max()))
    ax.set(
        xlim=(0, 1.03),
        ylim=(0, min(max(top, 1.1 * float(table["load_bearing_stress_ratio"].max())), 3.5)),
    )
    return legend_above(ax, 2)


def plot_stress_sharing(table: Table, summary: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the share of the stress against the share of the solid volume, finest grains first.

    Parameters
    ----------
    table : DataFrame
        `stress_sharing.csv`.
    summary : dict
        `sharing.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for where, rows in of_states(table):
        label, color = STATES[where]
        stress = summary[where]["stress"]
        limits = Interval.read(stress, "sharing_index")
        ax.plot(
            rows["volume_share"],
            rows["stress_share"],
            color=color,
            label=f"{label}: I = {interval_text(*limits)}",
        )
        ax.fill_between(
            rows["volume_share"],
            rows["stress_share_low"],
            rows["stress_share_high"],
            color=color,
            alpha=0.2,
            lw=0,
        )
    ax.plot([0, 1], [0, 1], color=OTHER, ls="--", lw=0.8, label="the same stress in all grains")
    ax.set(
        xlabel="share of the solid volume, finest first [-]",
        ylabel="share of the stress [-]",
        xlim=(0, 1),
        ylim=(0, 1),
    )
    return legend_above(ax)
