"""Who touches whom: contact numbers by radius, pairs of radii, and predictions of the lengths."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from branchcrush.branches.predictions import PREDICTIONS
from branchcrush.files.tables import Table
from branchcrush.plotting.intervals import draw_band
from branchcrush.plotting.style import (
    FAINT,
    MEASURED,
    MODEL,
    OTHER,
    STATES,
    above_jamming,
    axes,
    legend_above,
    reason,
    widen,
)


def plot_contact_numbers(
    table: Table, summary: Mapping, radius_max: float, ax: Axes | None = None
) -> Axes:
    """Draw the contact number by radius near jamming and at the end, beside the models.

    Parameters
    ----------
    table : DataFrame
        `contact_numbers.csv`.
    summary : dict
        `contact_numbers.json`.
    radius_max : float
        [m]
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for where, (name, color) in STATES.items():
        if where not in summary:  # one state is the end
            continue
        state = summary[where]
        rows = table[table["state"] == state["state"]]
        low, high = (rows[f"contact_number_{part}"] for part in ("low", "high"))
        error = None
        if low.notna().any():
            error = np.maximum([rows["contact_number"] - low, high - rows["contact_number"]], 0.0)
        ax.errorbar(
            rows["mean_radius_m"] / radius_max,
            rows["contact_number"],
            error,
            fmt="o",
            color=color,
            lw=0.8,
            label=rf"{name}, $\phi$ = {state['solid_fraction']:.3f}",
        )
    for name in ("mean_neighbour", "self_consistent", "parking", "rods"):
        column = f"contact_number_{name}"
        if column in table:
            label, color, _ = PREDICTIONS[name]
            ax.plot(rows["mean_radius_m"] / radius_max, rows[column], color=color, label=label)
    ax.set(xlabel=r"radius $R/R_M$ [-]", ylabel="contacts of a grain, rattlers too [-]")
    ax.set(xlim=(0, 1.03), ylim=(0, 1.6 * ax.get_ylim()[1]))
    ax.legend(loc="upper left", title="models: at jamming", title_fontsize=6.5)
    return ax


def plot_pairs(table: Table, summary: Mapping, radius_max: float, ax: Axes | None = None) -> Axes:
    """Draw how often classes of radius touch, over what their contact numbers alone would give.

    Parameters
    ----------
    table : DataFrame
        `contact_pairs.csv`.
    summary : dict
        `contact_numbers.json`.
    radius_max : float
        [m]
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    end = summary["end"]
    rows = table[table["state"] == end["state"]]
    if rows["radius_i_low_m"].nunique() < 2:
        return reason(ax, "grains of one radius")
    # Few contacts say nothing of their ratio.
    ratio = rows["ratio"].where(rows["expected_contacts"] >= 20).to_numpy()
    edges = np.append(rows["radius_j_low_m"].unique(), rows["radius_j_high_m"].max()) / radius_max
    spread = np.nanmax(np.abs(np.log2(np.maximum(np.append(ratio, 2.0**0.2), 0.25))))
    drawn = ax.pcolormesh(
        edges,
        edges,
        np.log2(np.maximum(ratio, 0.25)).reshape(len(edges) - 1, -1),
        cmap="RdBu_r",
        vmin=-spread,
        vmax=spread,
    )
    ax.set_facecolor("#eeeeee")
    bar = ax.figure.colorbar(drawn, ax=ax)
    ticks = [tick for tick in (-2, -1, -0.5, -0.2, 0, 0.2, 0.5, 1, 2) if abs(tick) <= spread]
    bar.set_ticks(ticks, labels=[f"{2.0**tick:.2f}" for tick in ticks])
    bar.set_label("contacts over expected [-]")
    ax.set(xlabel=r"radius $R/R_M$ [-]", ylabel=r"radius of the other $R'/R_M$ [-]")
    ax.set_aspect("equal")
    alike = end["assortativity_of_radii"]
    ax.set_title(rf"correlation of the two radii {alike:.2f}, $\phi$ = {end['solid_fraction']:.3f}")
    return ax


def plot_distances(table: Table, ax: Axes | None = None) -> Axes:
    """Draw how far each prediction of the branch lengths is off along the loading.

    Parameters
    ----------
    table : DataFrame
        `length_predictions.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    x, label = above_jamming(table)
    for name, (text, color, marker) in PREDICTIONS.items():
        rows = table["prediction"] == name
        ax.plot(
            x[rows],
            # Grains of one radius have one length, and every prediction is exact.
            table.loc[rows, "kolmogorov_smirnov"].clip(lower=1e-3),
            color=color,
            marker=marker,
            ms=2.5,
            label=text,
        )
    ax.set(xlabel=label, ylabel="Kolmogorov-Smirnov distance [-]", yscale="log")
    low, high = ax.get_ylim()
    ax.set_ylim(low, high * (high / low) ** 0.9)
    ax.legend(loc="upper left")
    return widen(ax)


def plot_mean_lengths(table: Table, radius_max: float, ax: Axes | None = None) -> Axes:
    """Draw the mean branch length along the loading, measured and predicted.

    Parameters
    ----------
    table : DataFrame
        `length_predictions.csv`.
    radius_max : float
        [m]
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    x, label = above_jamming(table)
    for name, (_, color, _) in PREDICTIONS.items():
        rows = table["prediction"] == name
        if name == "configuration":  # has the measured mean, by its making
            measured = table[rows]
            mean = measured["measured_mean_length_m"] / radius_max
            ax.plot(x[rows], mean, "o-", color=color, label="measured")
            limits = (measured[f"measured_mean_length_{part}_m"] for part in ("low", "high"))
            low, high = (limit / radius_max for limit in limits)
            interval = {"length": mean, "length_low": low, "length_high": high}
            draw_band(ax, x[rows], interval, "length", color)
        elif rows.any():
            mean = table.loc[rows, "mean_length_m"].iloc[0] / radius_max
            ax.axhline(mean, color=color, lw=1.0, ls="--")
    ax.set(xlabel=label, ylabel=r"mean branch length $\langle l\rangle/R_M$ [-]")
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.25 * (high - low))
    ax.plot([], [], "--", color=FAINT, label="predicted, in the colours of the distances")
    ax.legend(loc="upper left")
    return widen(ax)


def plot_branch_lengths(
    table: Table, statistics: Mapping, radius_max: float, ax: Axes | None = None
) -> Axes:
    """Draw the measured distribution of branch lengths beside Eq. 4 (Fig. 7).

    Parameters
    ----------
    table : DataFrame
        `branch_lengths.csv`.
    statistics : dict
        `branch_lengths.json`.
    radius_max : float
        [m]
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    middle = (table["length_low_m"] + table["length_high_m"]) / 2 / radius_max
    width = (table["length_high_m"] - table["length_low_m"]) / radius_max
    density = table["density_measured_per_m"] * radius_max
    error = table["density_measured_standard_error_per_m"] * radius_max
    ax.bar(
        middle,
        density,
        width,
        color=MEASURED,
        alpha=0.35,
        label=f"measured, {_count(table)} branches",
    )
    if np.isfinite(error).any():
        ax.errorbar(
            middle,
            density,
            error,
            fmt="none",
            ecolor=MEASURED,
            lw=0.8,
            label="standard error of seeds",
        )
    ax.plot(
        middle,
        table["density_random_contact_per_m"] * radius_max,
        "o-",
        color=MODEL,
        label="Eq. 4: any two grains touch alike",
    )
    if "density_parking_per_m" in table:
        ax.plot(
            middle,
            table["density_parking_per_m"] * radius_max,
            "D-",
            ms=2.5,
            color=OTHER,
            label="random parking, at jamming",
        )
    if "density_rods_per_m" in table:
        look = PREDICTIONS["rods"]
        ax.plot(
            middle,
            table["density_rods_per_m"] * radius_max,
            marker=look.marker,
            ms=2.5,
            color=look.color,
            label=f"{look.label}, at jamming",
        )
    for key, color in (("mean_length_1_m1", MEASURED), ("eq4_length_1_m1", MODEL)):
        ax.axvline(statistics[key] / radius_max, color=color, lw=0.8, ls=":")
    ax.set(xlabel=r"branch length $l/R_M$ [-]", ylabel=r"density $B(l)\,R_M$ [-]")
    ax.set(xlim=(0, table["length_high_m"].max() / radius_max), ylim=(0, None))
    return legend_above(ax, title="dotted: the means")


def _count(table):
    return f"{int(table['branches'].sum()):,}".replace(",", " ")
