"""How grains and branches share energy, force and stress."""

from collections.abc import Mapping

from matplotlib.axes import Axes

from branchcrush.files.tables import Table
from branchcrush.plotting.intervals import draw_points
from branchcrush.plotting.style import FAINT, MODEL, STATES, axes, legend_above, of_states
from branchcrush.statistics.intervals import Interval, interval_text


def plot_branch_shielding(table: Table, summary: Mapping, ax: Axes | None = None) -> Axes:
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
    for where, rows in of_states(table):
        label, color = STATES[where]
        rows = rows[rows["branches"] >= 20]
        fit = summary[where]["shielding"]["branches"]
        limits = Interval.read(fit, "shielding_exponent")
        draw_points(
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
    title = r"bins of 20 branches or more; $E \sim l^n (r_{min}/r_{max})^s$"
    return legend_above(ax, title=title)


def plot_grain_shielding(table: Table, reading: str = "contact", ax: Axes | None = None) -> Axes:
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
    for where, rows in of_states(table):
        label, color = STATES[where]
        for counted, marker in (("all", "o"), ("load-bearing", "^")):
            part = rows[(rows["grains_counted"] == counted) & (rows["grains"] >= 10)]
            part = part[part[f"energy_per_{reading}"] > 0]
            text = label if counted == "all" else f"{label}, without rattlers"
            draw_points(
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
    return legend_above(ax)
