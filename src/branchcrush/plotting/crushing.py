"""The crushing model on the measured elastic energy."""

from collections.abc import Mapping

from matplotlib.axes import Axes

from branchcrush.files.tables import Table
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, axes

_SHADES = ("#08306b", "#2171b5", "#6baed6", "#fd8d3c", "#d94801")
_STRAIN = r"volumetric strain from jamming $\epsilon$ [%]"


def plot_reference_energy(curves: Table, ax: Axes | None = None) -> Axes:
    """Draw the reference energy psi_r of Eq. 9 beside the whole elastic energy.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    fixed = curves[(curves["path"] == "fixed") & (curves["crushing"] == 0)]
    strain = 100 * fixed["volumetric_strain"]
    ax.plot(strain, fixed["elastic_energy_J_per_m3"] / 1e6, color=MEASURED, label=r"$\Psi_0$")
    ax.plot(
        strain,
        fixed["reference_energy_J_per_m3"] / 1e6,
        color=MODEL,
        label=r"$\psi_r = \Psi_0\, l_r^n/\langle l^n\rangle_0$",
    )
    ax.set(xlabel=_STRAIN, ylabel="energy per volume [MJ/m³]")
    ax.legend(loc="upper left")
    return ax


def plot_family(curves: Table, column: str, label: str, ax: Axes | None = None) -> Axes:
    """Draw a quantity at fixed crushing C, and along the path on which C evolves.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    column : str
        In Pa or J/m3.
    label : str
        Of the vertical axis, in MPa or MJ/m3.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    fixed = curves[curves["path"] == "fixed"]
    for color, (crushing, curve) in zip(_SHADES, fixed.groupby("crushing"), strict=True):
        ax.plot(
            100 * curve["volumetric_strain"],
            curve[column] / 1e6,
            color=color,
            lw=0.8,
            label=f"C = {crushing:g}",
        )
    path = curves[curves["path"] == "crushing"]
    ax.plot(
        100 * path["volumetric_strain"], path[column] / 1e6, "k", lw=1.6, label="C evolves, unloads"
    )
    ax.set(xlabel=_STRAIN, ylabel=label)
    ax.legend(loc="upper left")
    return ax


def plot_crushing(curves: Table, summary: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the crushing parameter along loading and unloading.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    summary : dict
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    path = curves[curves["path"] == "crushing"]
    ax.plot(100 * path["volumetric_strain"], path["crushing"], "k", label="loading, unloading")
    if summary["yields_on_path"]:
        ax.axvline(
            100 * summary["yield_strain"],
            color=FAINT,
            ls=":",
            label=rf"$\epsilon_y$ = {100 * summary['yield_strain']:.2f} %",
        )
    ax.set(xlabel=_STRAIN, ylabel="crushing parameter C [-]", ylim=(0, 1))
    ax.legend(loc="upper left", title=rf"$\theta$ = {summary['theta']:.6g}", title_fontsize=6.5)
    return ax


def plot_driving_force(curves: Table, ax: Axes | None = None) -> Axes:
    """Draw the driving force E_C against its resistance: crushing goes on where they are equal.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    path = curves[curves["path"] == "crushing"]
    strain = 100 * path["volumetric_strain"]
    ax.plot(
        strain,
        path["driving_force_J_per_m3"] / 1e6,
        color=MODEL,
        label=r"driving force $E_C=\theta\Psi_0$",
    )
    ax.plot(
        strain,
        path["resistance_J_per_m3"] / 1e6,
        "--",
        color=MEASURED,
        label=r"resistance $E_{c0}/(1-C)^s$",
    )
    ax.set(xlabel=_STRAIN, ylabel=r"energy per volume and C [MJ/m³]")
    ax.legend(loc="upper left")
    return ax


def plot_dissipation(curves: Table, ax: Axes | None = None) -> Axes:
    """Draw work, stored and dissipated energy of the crushing model.

    Parameters
    ----------
    curves : DataFrame
        `thermodynamics.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    path = curves[curves["path"] == "crushing"]
    strain = 100 * path["volumetric_strain"]
    for column, label, color in (
        ("work_J_per_m3", "work", FAINT),
        ("free_energy_J_per_m3", r"stored $\Psi$", MEASURED),
        ("dissipated_J_per_m3", r"dissipated $\int E_C\,dC$", MODEL),
    ):
        ax.plot(strain, path[column] / 1e6, color=color, label=label)
    ax.set(xlabel=_STRAIN, ylabel="energy per volume [MJ/m³]")
    ax.legend(loc="upper left")
    return ax
