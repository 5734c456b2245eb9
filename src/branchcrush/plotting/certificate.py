"""The certificate: how far states are from their limits, where packings jam, what steps change."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from branchcrush.files.tables import Table
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, axes, reason, widen

_PHI = r"solid fraction $\phi$ [-]"
_LOOSE = "no saved state carries load"
_QUANTITIES = {
    "exponent": "$n$",
    "mean_stress_Pa": "mean stress",
    "elastic_energy_J": "elastic energy",
    "mechanical_coordination_number": r"$\kappa^*$",
    "jamming_solid_fraction": r"$\phi_J$",
}
_DECIDED = {"converged": OTHER, "not converged": MODEL, "not decided": FAINT}
# So many tolerances away a change is drawn at the most.
_FARTHEST = 4.0


def plot_rest(states: Table, limits: Mapping[str, float], ax: Axes | None = None) -> Axes:
    """Draw what tells whether the states are at rest, each with its limit.

    Parameters
    ----------
    states : DataFrame
        `certificate.csv`.
    limits : dict
        Of `certificate.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    loaded = states[states["carries_load"]]
    if not len(loaded):
        return reason(ax, _LOOSE)
    for column, label, color in (
        ("unbalanced_force_ratio", "unbalanced force ratio", MEASURED),
        ("inertial_number", "inertial number", OTHER),
        ("stress_identity_error", "stress of branches against boundary", MODEL),
    ):
        if limits[column] is None:  # of packings that another code made, which do not tell it
            continue
        shown = loaded[column].clip(lower=1e-16)
        ax.semilogy(loaded["solid_fraction"], shown, ".", color=color, ms=3, label=label)
        ax.axhline(limits[column], color=color, ls="--", lw=0.8)
    ax.set(xlabel=_PHI, ylabel="[-], dashed: largest certified")
    low, high = ax.get_ylim()
    ax.set_ylim(low, 1e4 * high)
    ax.legend(loc="upper left")
    return widen(ax)


def plot_overlaps(states: Table, limit: float, ax: Axes | None = None) -> Axes:
    """Draw the overlaps over the smaller radius, with the value from which they are noted.

    Parameters
    ----------
    states : DataFrame
        `certificate.csv`.
    limit : float
        [-]
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    loaded = states[states["carries_load"]]
    if not len(loaded):
        return reason(ax, _LOOSE)
    for column, label, color in (
        ("max_overlap_ratio", "largest", FAINT),
        ("overlap_ratio_95", "95 % of the contacts", MODEL),
        ("median_overlap_ratio", "median", MEASURED),
    ):
        shown = 100 * loaded[column]
        ax.semilogy(loaded["solid_fraction"], shown, ".", color=color, ms=3, label=label)
    ax.axhline(100 * limit, color=MODEL, ls="--", lw=0.8, label=f"noted from {limit:.0%}")
    ax.set(xlabel=_PHI, ylabel="overlap over the smaller radius [%]")
    low, high = ax.get_ylim()
    ax.set_ylim(low, 30 * high)
    ax.legend(loc="upper left", ncols=2)
    return widen(ax)


def plot_dissipation(states: Table, ax: Axes | None = None) -> Axes:
    """Draw the share of the work that is dissipated, which never is negative.

    Parameters
    ----------
    states : DataFrame
        `certificate.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    loaded = states[states["carries_load"]]
    if not len(loaded):
        return reason(ax, _LOOSE)
    for leg, color in (("loading", MEASURED), ("unloading", OTHER)):
        part = loaded[loaded["leg"] == leg]
        if len(part):
            share = 100 * part["dissipated_share"]
            ax.plot(part["solid_fraction"], share, ".", color=color, ms=3, label=leg)
    ax.set(xlabel=_PHI, ylabel="work dissipated so far [%]", ylim=(0, None))
    ax.legend(loc="best")
    return widen(ax)


def plot_jamming(jamming: Table, ax: Axes | None = None) -> Axes:
    """Draw the jamming point of every packing with its uncertainty, in and back.

    Parameters
    ----------
    jamming : DataFrame
        `jamming.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    if jamming.filter(like="jamming_solid_fraction").isna().all(axis=None):
        return reason(ax, "in no packing do enough strain steps carry load")
    place = np.arange(len(jamming))
    for leg, color, shift in (("loading", MEASURED, -0.1), ("unloading", OTHER, 0.1)):
        phi = jamming[f"jamming_solid_fraction_{leg}"]
        if phi.notna().any():
            error = jamming[f"uncertainty_{leg}"]
            label = f"{leg}: mean {phi.mean():.4f}"
            ax.errorbar(place + shift, phi, error, fmt="o", ms=3, lw=0.8, color=color, label=label)
    shown = place[:: max(1, len(place) // 8)]
    ax.set_xticks(shown, jamming["seed"].iloc[shown])
    ax.set_xlim(-0.5, len(place) - 0.5)
    ax.set(xlabel="seed", ylabel=r"jamming solid fraction $\phi_J$ [-]")
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.35 * (high - low))
    ax.legend(loc="upper left", title="bars: one standard deviation", title_fontsize=6.5)
    return ax


def plot_convergence(rows: Sequence[Mapping[str, Any]], ax: Axes | None = None) -> Axes:
    """Draw what twice the strain steps change, over what they may, with its 95 % interval.

    A change of more than four times as much as it may be is drawn there.

    Parameters
    ----------
    rows : list of dict
        The `convergence` of `certificate.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    judged = [row for row in rows if row["verdict"]]
    if not judged:
        return reason(ax, "no packing certified with twice the strain steps too")
    ax.axvspan(-1.0, 1.0, color=FAINT, alpha=0.25, lw=0, label="allowed")
    for verdict, color in _DECIDED.items():
        places = [place for place, row in enumerate(judged) if row["verdict"] == verdict]
        change = [judged[place]["difference"] / judged[place]["tolerance"] for place in places]
        change = np.clip(change, -_FARTHEST, _FARTHEST)
        # One pair has no interval.
        bars = [
            (judged[place]["could_see"] or np.nan) / judged[place]["tolerance"] for place in places
        ]
        if places:
            ax.errorbar(change, places, xerr=bars, fmt="o", ms=3, lw=1, color=color, label=verdict)
    ax.axvline(0.0, color="black", lw=0.5)
    low, high = ax.get_xlim()
    ax.set_xlim(max(low, -1.1 * _FARTHEST), min(high, 1.1 * _FARTHEST))
    ax.set_yticks(range(len(judged)), [_compared(row) for row in judged])
    ax.set_ylim(len(judged) - 0.5, -0.5)
    ax.set_xlabel("change with twice the strain steps over what is allowed [-], bars: 95 %")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)
    return ax


def _compared(row):
    once, twice = row["seeds"], row["seeds_at_twice_the_steps"]
    how = f"{once} pairs" if row["compared_by"] == "pairs" else f"{once} against {twice}"
    return f"{_QUANTITIES[row['quantity']]} ({how})"
