"""The crushing model along a loading and an unloading, against the strain."""

from collections.abc import Mapping

from matplotlib.axes import Axes

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.tables import Table
from branchcrush.plotting.form_lines import each_form, plain_decades, width
from branchcrush.plotting.style import FAINT, FORMS, MEASURED, MODEL, OTHER, axes, legend_above

STRAIN = "volumetric strain from jamming [%]"
_SHADES = ("#08306b", "#2171b5", "#6baed6", "#fd8d3c", "#d94801")


def plot_crushing(curves: Table, model: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the crushing parameter of each form along loading and unloading.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    for name, path in each_form(curves[curves["path"] == "crushing"], model):
        style = {"color": FORMS[name], "lw": width(name, model), "label": FORM_LABELS[name]}
        ax.plot(100 * path["volumetric_strain"], path["crushing"], **style)
    ax.set(xlabel=STRAIN, ylabel="crushing parameter C [-]", ylim=(-0.03, 1.03))
    return ax


def plot_stress(curves: Table, model: Mapping, ax: Axes | None = None) -> Axes:
    """Draw stress against strain by the form on the front: C evolving, and C that is held.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, form = axes(ax), model["form"]
    fixed = curves[(curves["form"] == form) & (curves["path"] == "fixed")]
    held = sorted(fixed["crushing"].unique())
    for color, crushing in zip(_SHADES, held, strict=False):
        rows = fixed[fixed["crushing"] == crushing]
        strain, stress = 100 * rows["volumetric_strain"], rows["stress_Pa"] / 1e6
        ax.plot(strain, stress, color=color, lw=0.8, label=f"C = {crushing:g}")
    path = _path(curves, form)
    strain = 100 * path["volumetric_strain"]
    ax.plot(strain, path["stress_Pa"] / 1e6, "k", lw=1.6, label="C evolves")
    band = path.filter(["stress_low_Pa", "stress_high_Pa"])
    if len(band.columns) and band.notna().all(axis=1).any():
        # Of the way in alone: on the way back a band would lie over its own.
        way_in = slice(0, int(path["volumetric_strain"].to_numpy().argmax()) + 1)
        low, high = (path[f"stress_{end}_Pa"][way_in] / 1e6 for end in ("low", "high"))
        ax.fill_between(strain[way_in], low, high, color=FAINT, alpha=0.4, lw=0, label="its band")
    own = curves[(curves["form"] == form) & (curves["path"] == "history")]
    if len(own):
        # Its states alone: between them the table does not say how the stress went.
        strain, stress = 100 * own["volumetric_strain"], own["stress_Pa"] / 1e6
        ring = {"color": MODEL, "mfc": "w", "ms": 4, "zorder": 5}
        ax.plot(strain, stress, "o", label="history", **ring)
    ax.set(xlabel=STRAIN, ylabel="mean stress [MPa]")
    _decades_below(ax, max(path["stress_Pa"].max(), own["stress_Pa"].max() if len(own) else 0.0))
    return legend_above(ax, 3)


def plot_resistance(curves: Table, model: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the driving force against the one at which C grows.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, path = axes(ax), _path(curves, model["form"])
    strain = 100 * path["volumetric_strain"]
    for column, label, style in (
        ("driving_force_J_per_m3", "driving force", {"color": MODEL}),
        ("resistance_J_per_m3", "resistance", {"color": MEASURED, "ls": "--"}),
    ):
        ax.plot(strain, path[column] / 1e6, label=label, **style)
    ax.axhline(0.0, color="k", lw=0.5)
    ax.set(xlabel=STRAIN, ylabel="energy per volume\nat jamming and C [MJ/m³]")
    # Once C is held the driving force may be anything; what matters is near the resistance.
    highest = path["resistance_J_per_m3"].max() / 1e6
    if highest > 0:
        low, high = ax.get_ylim()
        ax.set_ylim(max(low, -0.3 * highest), min(high, 1.3 * highest))
    return legend_above(ax, 2)


def plot_work(curves: Table, model: Mapping, ax: Axes | None = None) -> Axes:
    """Draw work = stored + dissipated, and the part of the work that moves the jamming point.

    That part may lie above what is dissipated: a grading that crushing made stiffer stores some.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, path = axes(ax), _path(curves, model["form"])
    strain = 100 * path["volumetric_strain"]
    for column, label, style in (
        ("work_J_per_m3", "work", {"color": FAINT, "lw": 2.4}),
        ("free_energy_J_per_m3", "stored", {"color": MEASURED}),
        ("dissipated_J_per_m3", "dissipated", {"color": MODEL}),
        ("plastic_work_J_per_m3", "plastic work", {"color": OTHER, "ls": "--"}),
    ):
        ax.plot(strain, path[column] / 1e6, label=label, **style)
    ax.set(xlabel=STRAIN, ylabel="energy per volume\nat jamming [MJ/m³]")
    _decades_below(ax, path["work_J_per_m3"].max())
    return legend_above(ax, 2)


def _path(curves: Table, name: str) -> Table:
    return curves[(curves["form"] == name) & (curves["path"] == "crushing")]


def _decades_below(ax: Axes, highest: float) -> None:
    """Let a vertical axis end at a number in Pa, and show what is up to 10 000 times less."""
    if highest > 0:
        ax.set_yscale("log")
        ax.set_ylim(1e-4 * highest / 1e6, 2.0 * highest / 1e6)
        plain_decades(ax.yaxis)
