"""Figures 3 and 7 of the paper: the grading and the distribution of branch lengths."""

import numpy as np

from branchcrush.plotting.style import FAINT, MEASURED, MODEL, axes


def plot_grading(grading, ax=None):
    """Draw the sieve curve and the distribution by number: target and realised (Fig. 3).

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
    diameter = grading["diameter_m"] * 1e3
    low, high = (grading[f"percent_finer_by_mass_realised_{end}"] for end in ("min", "max"))
    ax.fill_between(diameter, low, high, color=MEASURED, alpha=0.2, lw=0, label="all seeds")
    ax.plot(
        diameter,
        grading["percent_finer_by_mass_realised"],
        color=MEASURED,
        label="by mass, mean of seeds",
    )
    ax.plot(
        diameter,
        grading["percent_finer_by_mass_target"],
        "--",
        color=MODEL,
        label="by mass, target",
    )
    ax.plot(
        diameter,
        grading["percent_finer_by_number_target"],
        ":",
        color=FAINT,
        label="by number, target",
    )
    ax.set(xscale="log", xlabel="grain diameter D [mm]", ylabel="percent finer [%]", ylim=(0, 102))
    ax.legend(loc="upper left")
    return ax


def plot_branch_lengths(table, statistics, radius_max, ax=None):
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
    for key, color in (("mean_length_1_m1", MEASURED), ("eq4_length_1_m1", MODEL)):
        ax.axvline(statistics[key] / radius_max, color=color, lw=0.8, ls=":")
    ax.set(xlabel=r"branch length $l/R_M$ [-]", ylabel=r"density $B(l)\,R_M$ [-]", xlim=(0, 2))
    ax.set_ylim(
        0, 1.4 * max(density.max(), table["density_random_contact_per_m"].max() * radius_max)
    )
    ax.legend(loc="upper left", title="dotted: the means", title_fontsize=6.5)
    return ax


def _count(table):
    return f"{int(table['branches'].sum()):,}".replace(",", " ")
