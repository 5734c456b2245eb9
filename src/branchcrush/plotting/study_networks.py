"""The contact networks of all samples of a study: coordination, shielding, stress and forces."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from branchcrush.branches.coordination_laws import field, gray, jamming_law, smith
from branchcrush.files.tables import Table
from branchcrush.plotting.study import legend_handles
from branchcrush.plotting.style import FAINT, MODEL, axes, legend_above


def plot_coordination(states: Table, styles: Mapping[str, Mapping], ax: Axes | None = None) -> Axes:
    """Draw the coordination numbers of all states against void ratio, with historic relations.

    Parameters
    ----------
    states : DataFrame
        `coordination.csv`.
    styles : dict
        From `sample_styles`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, rows in states.groupby("sample", sort=False):
        color = styles[name]["color"]
        ax.plot(
            rows["void_ratio"], rows["coordination_number"], ".", ms=1.5, color=color, alpha=0.5
        )
        ax.plot(
            rows["void_ratio"],
            rows["mechanical_coordination_number"],
            "o",
            ms=2.5,
            mfc="none",
            mew=0.4,
            color=color,
            alpha=0.5,
        )
    # Beside one state, relations are shown over some range too.
    least, most = states["void_ratio"].min(), states["void_ratio"].max()
    wider = max(0.0, 0.1 - (most - least)) / 2.0
    e = np.linspace(least - wider, most + wider, 100)
    curves = ((smith, "-", "Smith 1929"), (field, "--", "Field 1963"), (gray, ":", "Gray 1968"))
    for relation, line, label in curves:
        ax.plot(e, relation(e), line, color="black", lw=1.0, label=label)
    ax.plot([], [], ".", color="black", label=r"$\kappa$, all grains")
    ax.plot([], [], "o", mfc="none", color="black", label=r"$\kappa^*$, without rattlers")
    ax.set(xlabel="void ratio e [-]", ylabel=r"coordination number [-]", ylim=(0, 17))
    return legend_above(ax, 2)


def plot_jamming_law(states: Table, styles: Mapping[str, Mapping], ax: Axes | None = None) -> Axes:
    """Draw the mechanical coordination number against the distance from jamming, with the law.

    Parameters
    ----------
    states, styles, ax
        As for `plot_coordination`.

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, rows in states.groupby("sample", sort=False):
        style = styles[name]
        excess = rows["mechanical_coordination_number"] - rows["isostatic_number"]
        kept = (rows["solid_fraction_above_jamming"] > 1e-3) & (excess > 0.05)
        ax.plot(
            rows.loc[kept, "solid_fraction_above_jamming"],
            excess[kept],
            "o" if style["line"] == "-" else "^",
            ms=2.0,
            mew=0.4,
            mfc=style["color"] if style["filled"] else "none",
            color=style["color"],
            alpha=0.5,
        )
    x = np.geomspace(1e-3, max(0.2, states["solid_fraction_above_jamming"].max()), 50)
    ax.plot(x, jamming_law(x) - 6.0, color="black", label=r"$7.8\,\sqrt{\phi-\phi_J}$")
    ax.plot([], [], "o", color="black", label="periodic (filled: linear, open: Hertz)")
    ax.plot([], [], "^", color="black", label="walls")
    ax.set(xscale="log", yscale="log", xlabel=r"solid fraction above jamming $\phi - \phi_J$ [-]")
    ax.set(ylabel=r"$\kappa^* - \kappa^*_{iso}$ [-]")
    marks = ax.legend(loc="upper left")
    ax.add_artist(marks)
    ax.legend(handles=legend_handles(_of(states, styles)), loc="lower right")
    return ax


def plot_branch_shielding(
    tables: Mapping[str, Table], styles: Mapping[str, Mapping], ax: Axes | None = None
) -> Axes:
    """Draw the energy of branches of equal length against the ratio of their radii, at the end.

    Parameters
    ----------
    tables : dict of DataFrame
        `shielding_branches.csv` by sample.
    styles : dict
        From `sample_styles`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, rows in _ends(tables):
        rows = rows[rows["branches"] >= 20]
        _line(ax, rows["mean_radius_ratio"], rows["energy_ratio"], styles[name])
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.set(xlabel=r"ratio of the radii $r_{min}/r_{max}$ [-]", xlim=(0, 1.02), ylim=(0, None))
    ax.set_ylabel("energy over that of all of its length [-]")
    ax.legend(
        handles=legend_handles({name: styles[name] for name in tables}), loc="lower right", ncols=2
    )
    return ax


def plot_grain_shielding(
    tables: Mapping[str, Table], styles: Mapping[str, Mapping], ax: Axes | None = None
) -> Axes:
    """Draw the energy per contact of grains against their radius over their neighbours'.

    Parameters
    ----------
    tables : dict of DataFrame
        `shielding_grains.csv` by sample.
    styles : dict
        From `sample_styles`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, rows in _ends(tables):
        rows = rows[(rows["grains_counted"] == "all") & (rows["grains"] >= 10)]
        _line(ax, rows["mean_neighbour_ratio"], rows["energy_per_contact"], styles[name])
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.axvline(10.0, color=MODEL, lw=0.8, ls="--")
    claim = ax.axhline(0.1, color=MODEL, lw=0.8, ls="--", label="claim: below 0.1 from 10 on")
    ax.set(xscale="log", xlabel=r"radius over neighbours' mean $R/\langle R\rangle_{nb}$ [-]")
    ax.set(yscale="log", ylabel="energy per contact over the mean [-]")
    ax.set_ylim(5e-4, max(5.0, ax.get_ylim()[1]))
    shown = legend_handles({name: styles[name] for name in tables})
    ax.legend(handles=[*shown, claim], loc="lower left", ncols=2)
    return ax


def plot_stress(
    tables: Mapping[str, Table], styles: Mapping[str, Mapping], ax: Axes | None = None
) -> Axes:
    """Draw how far the cumulative stress is from the cumulative volume, finest grains first.

    Parameters
    ----------
    tables : dict of DataFrame
        `stress_sharing.csv` by sample.
    styles : dict
        From `sample_styles`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, rows in _ends(tables):
        style = styles[name]
        more = rows["stress_share"] - rows["volume_share"]
        ax.plot(rows["volume_share"], more, style["line"], color=style["color"], lw=0.9)
    ax.axhline(0.0, color=FAINT, lw=0.8)
    ax.set(
        xlabel="share x of the solid volume, finest first [-]",
        ylabel="share of the stress less x [-]",
    )
    low, high = ax.get_ylim()
    ax.set(xlim=(0, 1), ylim=(low, high + 0.35 * (high - low)))
    ax.legend(
        handles=legend_handles({name: styles[name] for name in tables}, lines=True),
        loc="upper right",
        ncols=2,
    )
    return ax


def plot_forces(
    tables: Mapping[str, Table], styles: Mapping[str, Mapping], ax: Axes | None = None
) -> Axes:
    """Draw the distribution of forces of all samples at the end of the loading.

    Parameters
    ----------
    tables : dict of DataFrame
        `force_distribution.csv` by sample.
    styles : dict
        From `sample_styles`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, rows in _ends(tables):
        rows, style = rows[rows["contacts"] >= 5], styles[name]
        middle = (rows["force_low"] + rows["force_high"]) / 2.0
        ax.plot(middle, rows["density"], style["line"], color=style["color"], lw=0.8)
    f = np.linspace(0.0, 6.0, 50)
    ax.plot(f, np.exp(-f), ":", color="black", label=r"$e^{-f}$")
    ax.set(
        xlabel=r"normal force $f = F/\langle F\rangle$ [-]", ylabel="density P(f) [-]", yscale="log"
    )
    ax.set(xlim=(0, None))
    ax.legend(loc="upper right")
    return ax


def _ends(tables):
    return ((name, table[table["where"] == "end"]) for name, table in tables.items())


def _line(ax, x, y, style):
    ax.plot(
        x,
        y,
        "o",
        ls=style["line"],
        lw=0.8,
        ms=2.5,
        color=style["color"],
        mfc=style["color"] if style["filled"] else "none",
        alpha=0.8,
    )


def _of(states, styles):
    return {name: styles[name] for name, _ in states.groupby("sample", sort=False)}
