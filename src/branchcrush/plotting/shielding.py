"""How grains and branches share energy, force and stress."""

import numpy as np

from branchcrush.plotting.style import FAINT, MODEL, OTHER, STATES, axes, interval_text


def plot_branch_shielding(table, summary, ax=None):
    """Draw the energy of branches of equal length against the ratio of their radii.

    Parameters
    ----------
    table : DataFrame
        `shielding_branches.csv`.
    summary : dict
        `sharing.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for where, rows in _states(table):
        label, color = STATES[where]
        rows = rows[rows["branches"] >= 20]
        fit = summary[where]["shielding"]["branches"]
        limits = (fit[f"shielding_exponent{part}"] for part in ("", "_low", "_high"))
        _points(
            ax,
            rows["mean_radius_ratio"],
            rows,
            "energy_ratio",
            color,
            f"{label}: s = {interval_text(*limits)}",
        )
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.set(
        xlabel=r"ratio of the radii $r_{min}/r_{max}$ [-]",
        ylabel="energy over that of all of its length [-]",
    )
    ax.set(xlim=(0, 1), ylim=(0, max(2.0, ax.get_ylim()[1])))
    ax.legend(
        loc="upper left",
        title=r"bins of 20 branches or more; $E \sim l^n (r_{min}/r_{max})^s$",
        title_fontsize=6.5,
    )
    return ax


def plot_grain_shielding(table, reading="contact", ax=None):
    """Draw the energy of grains against their radius over that of their neighbours.

    Parameters
    ----------
    table : DataFrame
        `shielding_grains.csv`.
    reading : str
        contact, grain or volume.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for where, rows in _states(table):
        label, color = STATES[where]
        for counted, marker in (("all", "o"), ("load-bearing", "^")):
            part = rows[(rows["grains_counted"] == counted) & (rows["grains"] >= 10)]
            part = part[part[f"energy_per_{reading}"] > 0]
            text = label if counted == "all" else f"{label}, without rattlers"
            _points(
                ax,
                part["mean_neighbour_ratio"],
                part,
                f"energy_per_{reading}",
                color,
                text,
                marker,
                floor=1e-3,
            )
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.axhline(0.1, color=MODEL, lw=0.8, ls="--")
    ax.axvline(10.0, color=MODEL, lw=0.8, ls="--", label="the claim: below 0.1 from 10 on")
    ax.set(
        xscale="log",
        yscale="log",
        xlabel=r"radius over neighbours' mean $R/\langle R\rangle_{nb}$ [-]",
    )
    ax.set_ylabel(f"energy per {reading} over the mean [-]")
    ax.set_ylim(0.002, max(ax.get_ylim()[1], 10.0))
    ax.legend(loc="lower left")
    return ax


def plot_force_distribution(table, summary, ax=None):
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
    for where, rows in _states(table):
        label, color = STATES[where]
        rows = rows[rows["contacts"] > 0]
        x = (rows["force_low"] + rows["force_high"]) / 2.0
        _points(ax, x, rows, "density", color, label, floor=1e-6)
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
    ax.legend(loc="upper right")
    return ax


def plot_force_by_length(table, summary, radius_max, ax=None):
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
    for where, rows in _states(table):
        label, color = STATES[where]
        fit = summary[where]["forces"]["by_length"]
        if fit:
            label += (
                f": m = {interval_text(fit['exponent'], fit['exponent_low'], fit['exponent_high'])}"
            )
        rows = rows[rows["branches"] >= 20]
        x = (rows["branch_length_low_m"] + rows["branch_length_high_m"]) / 2.0 / radius_max
        _points(ax, x, rows, "mean_force", color, label)
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.set(
        xlabel=r"branch length $l/R_M$ [-]",
        ylabel=r"mean force $\langle F\rangle_l/\langle F\rangle$ [-]",
    )
    ax.set(xlim=(0, None), ylim=(0, 1.3 * ax.get_ylim()[1]))
    ax.legend(
        loc="upper left", title=r"bins of 20 branches or more; $F \sim l^m$", title_fontsize=6.5
    )
    return ax


def plot_stress_by_radius(table, radius_max, ax=None):
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
    for where, rows in _states(table):
        label, color = STATES[where]
        x = rows["mean_radius_m"] / radius_max
        _points(ax, x, rows, "stress_ratio", color, label)
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
    ax.legend(loc="upper right")
    return ax


def plot_stress_sharing(table, summary, ax=None):
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
    for where, rows in _states(table):
        label, color = STATES[where]
        stress = summary[where]["stress"]
        limits = (stress[f"sharing_index{part}"] for part in ("", "_low", "_high"))
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
    ax.legend(loc="upper left")
    return ax


def _states(table):
    return ((where, table[table["where"] == where]) for where in STATES)


def _points(ax, x, rows, column, color, label, marker="o", floor=0.0):
    """Draw points with their intervals, those below a floor cut there."""
    y, low, high = (rows[column + part] for part in ("", "_low", "_high"))
    error = None
    if low.notna().any():
        error = np.array([y - np.maximum(low, floor), high - y]).clip(0.0)
    ax.errorbar(x, y, error, fmt=marker, ms=3, color=color, lw=0.8, label=label)
