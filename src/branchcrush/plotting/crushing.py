"""The forms of the crushing model beside each other, along the crushing parameter C."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from branchcrush.files.tables import Table
from branchcrush.plotting.form_lines import (
    SNAP,
    beside_the_paper,
    draw_form,
    each_form,
    plain_decades,
)
from branchcrush.plotting.style import FAINT, FORMS, axes

CRUSHING = "crushing parameter C [-]"
# What is held equal when energies before and after crushing are compared.
COMPARED = {
    "energy_at_equal_strain": "at equal\nelastic strain",
    "energy_at_equal_energy_over_pressure": "at equal energy\nover pressure",
    "energy_at_equal_stress": "at equal\nstress",
    "energy_at_equal_solid_fraction": "at equal\nsolid fraction",
}
# Energies beyond these shares of those before crushing are off the axis: the paper's ends at 0.
_RATIOS = (0.01, 100.0)
# Driving forces over pressure beyond these are off the axis.
_FORCES = (-0.35, 0.7)
_MARKS = np.arange(11) / 10.0  # C along the compression line
_MOVES = 1e-6  # of a jamming point that does not stay
_APART = 0.09  # of two marks with their C, in widths of the panel
_HEAP = 0.2  # of a line that is too short for several marks
_OFFSET = {"textcoords": "offset points", "fontsize": 6.5}


def plot_compression_line(
    forms: Table, curves: Table, model: Mapping, ax: Axes | None = None
) -> Axes:
    """Draw void ratio against stress where crushing goes on, with C along the line.

    Of the forms that are admissible, of the paper's, and of the one on the front, which also has
    its elastic loading and unloading.

    Parameters
    ----------
    forms, curves : DataFrame
        `crushing_forms.csv` and `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, begins, front = axes(ax), [], None
    ax.set(xscale="log", xlabel="mean stress [MPa]", ylabel="void ratio e [-]")
    for name, rows in each_form(forms, model):
        if name not in beside_the_paper(model):
            continue
        crushing, void = rows["crushing"].to_numpy(), rows["void_ratio"].to_numpy()
        stress = rows["yield_stress_Pa"].to_numpy() / 1e6
        admissible = draw_form(ax, rows, model, stress, void, at_yield=True)
        usable = admissible & np.isfinite(stress) & np.isfinite(void) & (stress > 0)
        if usable.any():
            begins.append(stress[usable][0])
            if name == model["form"]:
                front = crushing[usable], stress[usable], void[usable]
    if front is not None:
        crushing, stress, void = front
        ax.set_xlim(min(*stress, *begins) / 3.0, max(*stress, *begins) * 3.0)
        margin = 0.12 * max(float(np.ptp(void)), 0.05)
        ax.set_ylim(max(void.min() - margin, 0.0), void.max() + 1.5 * margin)
        _mark(ax, crushing, stress, void, model)
    path = curves[(curves["form"] == model["form"]) & (curves["path"] == "crushing")]
    path = path[path["stress_Pa"] > 0]
    void = (1.0 - path["volumetric_strain"]) / model["jamming_solid_fraction"] - 1.0
    elastic = {"ls": ":", "lw": 0.9, "zorder": 1, "label": "loading and unloading"}
    ax.plot(path["stress_Pa"] / 1e6, void, color=FORMS[model["form"]], **elastic)
    ax.set_ylim(bottom=max(ax.get_ylim()[0], 0.0))
    plain_decades(ax.xaxis)
    return ax if begins else _never(ax)


def plot_jamming(forms: Table, model: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the solid fraction at jamming of the forms that move it, and that of the others.

    The axis shows the form on the front and the moving jamming point: limiting densities end at 1.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, stays, whole = axes(ax), [], []
    for name, rows in each_form(forms, model):
        solid = rows["jamming_solid_fraction"].to_numpy()
        if name not in beside_the_paper(model):
            continue
        if np.ptp(solid) > _MOVES:
            draw_form(ax, rows, model, rows["crushing"].to_numpy(), solid)
        else:
            stays.append(solid[0])
        if name in (model["form"], "moving_jamming"):
            whole += solid.tolist()
    if stays:
        ax.axhline(stays[0], color=FAINT, lw=0.8)
        below = {"xytext": (0, -3), "ha": "right", "va": "top"}
        ax.annotate("all other forms", (0.98, stays[0]), **below, **_OFFSET)
    ax.set(xlabel=CRUSHING, ylabel="solid fraction\nat jamming $\\phi_J$ [-]", xlim=(0, 1))
    if whole:
        margin = max(0.2 * (max(whole) - min(whole)), 0.01)
        ax.set_ylim(min(whole) - margin, max(whole) + margin)
    return ax


def plot_energy(forms: Table, model: Mapping, column: str, ax: Axes | None = None) -> Axes:
    """Draw the elastic energy over that before crushing, at something that is held equal.

    The axis shows the form on the front and the paper's.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.
    column : str
        One of `COMPARED`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, shown = axes(ax), [1.0]
    for name, rows in each_form(forms, model):
        ratio = rows[column].to_numpy()
        admissible = draw_form(ax, rows, model, rows["crushing"].to_numpy(), ratio)
        if name in (model["form"], "paper"):
            shown += ratio[admissible & np.isfinite(ratio)].tolist()
    ax.axhline(1.0, color=FAINT, lw=0.6, zorder=0)
    ax.set(yscale="log", xlim=(0, 1), xticks=(0.0, 0.5, 1.0))
    ax.set_ylim(max(min(shown) / 1.5, _RATIOS[0]), min(2.0 * max(shown), _RATIOS[1]))
    ax.set_title(COMPARED[column], fontsize=7)
    plain_decades(ax.yaxis)
    return ax


def plot_driving_force(forms: Table, model: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the driving force over pressure where crushing goes on, and where it would cost energy.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, known, front = axes(ax), [0.0], 0.0
    for name, rows in each_form(forms, model):
        force = rows["driving_force_over_pressure"].to_numpy()
        draw_form(ax, rows, model, rows["crushing"].to_numpy(), force, at_yield=True)
        known += (finite := force[np.isfinite(force)].tolist())
        front = max(finite, default=0.0) if name == model["form"] else front
    low, high = max(min(known), _FORCES[0]), min(max(known), _FORCES[1])
    # Limiting densities end infinitely: no more than shows the form on the front.
    high = min(high, 2.5 * front) if front > 0 else high
    low = min(low, -0.25 * high, -1e-3)  # room for the words
    ax.axhspan(low, 0.0, color=FAINT, alpha=0.18, lw=0, zorder=0)
    ax.axhline(0.0, color="k", lw=0.6)
    ax.annotate("crushing would cost elastic energy", (0.0, low), (3, 3), **_OFFSET)
    ax.set(xlabel=CRUSHING, ylabel="driving force\nover pressure [-]", xlim=(0, 1))
    ax.set_ylim(low, 1.08 * high if high > 0 else 0.1)
    return ax


def plot_yield_stress(forms: Table, model: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the yield locus: the stress at which a grading crushes on, against how far it has.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    ax.set(yscale="log", xlabel=CRUSHING, ylabel="yield stress [MPa]", xlim=(0, 1))
    shown: list[float] = []
    for name, rows in each_form(forms, model):
        crushing, stress = rows["crushing"].to_numpy(), rows["yield_stress_Pa"].to_numpy() / 1e6
        admissible = draw_form(ax, rows, model, crushing, stress, at_yield=True)
        known = np.isfinite(stress) & (stress > 0)
        shown += stress[known & admissible].tolist()
        snaps = model["forms"][name]["snaps"]
        if snaps and known.any():
            at = np.interp(snaps, crushing[known], stress[known])
            ax.plot(snaps, at, color=FORMS[name], **SNAP)
    if shown:
        ax.set_ylim(min(shown) / 2.0, 2.0 * max(shown))
    plain_decades(ax.yaxis)
    return ax if shown else _never(ax)


def _never(ax: Axes) -> Axes:
    """Say that no form yields."""
    middle = {"ha": "center", "va": "center", "fontsize": 7}
    ax.text(0.5, 0.4, "crushing never begins", transform=ax.transAxes, **middle)
    return ax


def _mark(ax: Axes, crushing: NDArray, stress: NDArray, void: NDArray, model: Mapping) -> None:
    """Mark C along the line of the form on the front where there is room, and where it jumps."""
    color = FORMS[model["form"]]

    def places(at: Sequence[float]) -> NDArray:
        x = np.exp(np.interp(at, crushing, np.log(stress)))
        return np.column_stack([x, np.interp(at, crushing, void)])

    last = None
    marks = _MARKS[: np.searchsorted(_MARKS, crushing[-1], side="right")].tolist()
    points = places(marks)
    spots = ax.transAxes.inverted().transform(ax.transData.transform(points))
    heap = np.ptp(spots, axis=0).max() < _HEAP and len(marks) > 1
    for value, point, spot in zip(marks, points, spots, strict=True):
        if last is None or (np.hypot(*(spot - last)) >= _APART and not heap):
            label = f"{value:g}" if value else f"C = 0 to {marks[-1]:g}" if heap else "C = 0"
            last = spot
            ax.plot(*point, "o", color=color, ms=3.5, mec="w", mew=0.5, zorder=5)
            ax.annotate(label, point, (4, 3), color=color, **_OFFSET)
    snaps = places(model["forms"][model["form"]]["snaps"])
    ax.plot(*snaps.T, color=color, zorder=6, **SNAP)
