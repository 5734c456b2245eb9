"""Panels of grains that break, beside every form of the model: C and breakage, stress, losses."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.tables import Table
from branchcrush.plotting.form_lines import plain_decades
from branchcrush.plotting.style import FAINT, FORMS, axes, legend_above, reason

_DENSITY = r"solid fraction $\phi$ [-]"


def plot_measures(means: Table, beside: Table, ax: Axes | None = None) -> Axes:
    """Draw the measured C and B, and the C of every form of the crushing model.

    Parameters
    ----------
    means, beside : DataFrame
        `crushing_means.csv` and `crushing_beside_forms.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, marker, label in (
        ("crushing_by_random_contacts", "s", "C of Eq. 4"),
        ("crushing_by_contacts", "o", r"C of measured $\langle l^3 \rangle$"),
        ("einav_breakage", "D", "B of Einav"),
    ):
        _points(ax, means, name, 1.0, marker, label)
    _forms(ax, beside, "crushing", 1.0)
    # C by numbers and B may pass 1, for there are fragments below the limit.
    drawn = [value for line in ax.lines for value in line.get_ydata() if np.isfinite(value)]
    ax.set(xlabel=_DENSITY, ylabel="C or B [-]", ylim=(0.0, max([1.1, *(1.05 * y for y in drawn)])))
    return legend_above(ax, 2)


def plot_stress(
    means: Table, beside: Table, controls: Sequence[Table], ax: Axes | None = None
) -> Axes:
    """Draw the mean stress beside every form, and that of grains that do not break.

    Parameters
    ----------
    means, beside : DataFrame
        `crushing_means.csv` and `crushing_beside_forms.csv`.
    controls : list of DataFrame
        `path.csv` of each seed whose grains do not break.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    _points(ax, means, "mean_stress_Pa", 1e-6, "o", "simulated")
    _forms(ax, beside, "stress_Pa", 1e-6)
    for k, path in enumerate(controls):
        rows = path[path["carries_load"].astype(bool) & (path["leg"] == "loading")]
        label = None if k else "grains do not break"
        ax.plot(
            rows["solid_fraction"], rows["mean_stress_Pa"] / 1e6, color=FAINT, lw=0.8, label=label
        )
    ax.set(xlabel=_DENSITY, ylabel="mean stress p [MPa]", yscale="log")
    plain_decades(ax.yaxis)
    return legend_above(ax, 2)


def plot_dissipation(means: Table, beside: Table, ax: Axes | None = None) -> Axes:
    """Draw what was lost since the first breakage beside every form, and the work of compaction.

    Parameters
    ----------
    means, beside : DataFrame
        `crushing_means.csv` and `crushing_beside_forms.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    _points(ax, means, "dissipated_J_per_m3", 1e-6, "o", "simulated")
    _points(ax, means, "compaction_work_J_per_m3", 1e-6, "x", r"$\int p\, d\epsilon_J$, by rods")
    _forms(ax, beside, "dissipated_J_per_m3", 1e-6)
    if not ax.lines:
        return reason(ax, "no grain broke under load")
    ax.set(xlabel=_DENSITY, ylabel="dissipated [MJ/m³]")
    ax.set_ylim(bottom=0.0)
    return legend_above(ax, 2)


def _points(ax: Axes, means: Table, name: str, scale: float, marker: str, label: str) -> None:
    """Draw means over seeds as points, the halved step's smaller; nothing where it is unknown."""
    for halved, rows in means.dropna(subset=name).groupby("halved_step"):
        style = {"ms": 2.0, "alpha": 0.5} if halved else {"label": label}
        ax.plot(
            rows["solid_fraction"],
            scale * rows[name],
            marker,
            color="k",
            mfc="none",
            gid=name,
            zorder=4,
            **style,
        )


def _forms(ax: Axes, beside: Table, name: str, scale: float) -> None:
    """Draw what every form says."""
    for form in FORM_LABELS:
        rows = beside[beside["form"] == form]
        if rows[name].notna().any():
            ax.plot(
                rows["solid_fraction"],
                scale * rows[name],
                "--" if form == "einav" else "-",  # else it hides the paper's, of the same C
                color=FORMS[form],
                label=FORM_LABELS[form],
                gid=form,
            )
