"""Figures 3 and 7 of the paper: the grading and the distribution of branch lengths."""

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, axes


def plot_grading(grading, ax=None):
    """Draw the sieve curve and the distribution by number: target and realised (Fig. 3).

    The ultimate grading is drawn as well if the table has it.

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
    unit, scale = ("mm", 1e3) if grading["diameter_m"].max() >= 1e-4 else ("µm", 1e6)
    diameter = grading["diameter_m"] * scale
    low, high = (grading[f"percent_finer_by_mass_realised_{end}"] for end in ("min", "max"))
    ax.fill_between(diameter, low, high, color=MEASURED, alpha=0.2, lw=0, label="all seeds")
    for name, label, line, color in (
        ("by_mass_realised", "by mass, mean of seeds", "-", MEASURED),
        ("by_mass_target", "by mass, target", "--", MODEL),
        ("by_mass_ultimate", "by mass, ultimate", "-.", OTHER),
        ("by_number_target", "by number, target", ":", FAINT),
    ):
        column = f"percent_finer_{name}"
        if column in grading:
            ax.plot(diameter, grading[column], line, color=color, label=label)
    ax.set(xscale="log", ylabel="percent finer [%]", ylim=(0, 102))
    ax.set_xlabel(f"grain diameter D [{unit}]")
    _mark_sizes(ax.xaxis, diameter.max() / diameter.min())
    # Curves by mass and by number leave different corners free.
    ax.legend(loc="best")
    return ax


def _mark_sizes(axis, ratio):
    # The marks of a logarithmic axis are decades, of which narrow gradings have one or none.
    if ratio < 6:
        axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    else:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if ratio < 30 else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda size, _: f"{size:g}"))
    axis.set_minor_formatter(NullFormatter())


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
    if "density_parking_per_m" in table:
        ax.plot(
            middle,
            table["density_parking_per_m"] * radius_max,
            "D-",
            ms=2.5,
            color=OTHER,
            label="random parking, at jamming",
        )
    for key, color in (("mean_length_1_m1", MEASURED), ("eq4_length_1_m1", MODEL)):
        ax.axvline(statistics[key] / radius_max, color=color, lw=0.8, ls=":")
    ax.set(xlabel=r"branch length $l/R_M$ [-]", ylabel=r"density $B(l)\,R_M$ [-]")
    ax.set_xlim(0, table["length_high_m"].max() / radius_max)
    ax.set_ylim(
        0, 1.4 * max(density.max(), table["density_random_contact_per_m"].max() * radius_max)
    )
    ax.legend(loc="upper left", title="dotted: the means", title_fontsize=6.5)
    return ax


def _count(table):
    return f"{int(table['branches'].sum()):,}".replace(",", " ")
