"""What a laboratory measured: gradings around a test, and a compression curve with its fits."""

from os import PathLike

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from branchcrush.files.tables import Table
from branchcrush.plotting.gradings import mark_sizes
from branchcrush.plotting.style import (
    FAINT,
    MEASURED,
    MODEL,
    OTHER,
    axes,
    drawn,
    figure,
    grid,
    legend_above,
)

_GRADINGS = (
    ("before", "before the test", "-", MEASURED),
    ("after", "after the test", "--", MODEL),
    ("ultimate", "ultimate", "-.", OTHER),
)
_FITS = (
    ("elastic_strain_limit", "elastic strain limit", "-", MODEL),
    ("critical_energy", "critical energy", "--", OTHER),
)
# Values that the fits are compared by, with their labels.
_VOID_RATIO, _STRAIN = "void_ratio", "volumetric_strain"
_LABELS = {_VOID_RATIO: "void ratio e [-]", _STRAIN: r"volumetric strain $\epsilon$ [-]"}


def draw_gradings(path: str | PathLike[str], dpi: int, curves: Table) -> None:
    """Draw the gradings before and after a test, with the ultimate one.

    Parameters
    ----------
    path : path-like
    dpi : int
        Dots per inch.
    curves : DataFrame
        `gradings.csv`.
    """
    with figure(path, dpi) as ax:
        plot_gradings(curves, ax)


def draw_compression(
    path: str | PathLike[str], dpi: int, curve: Table, line: Table, why: str | None = None
) -> None:
    """Draw a compression curve with the fitted lines, and what the fits leave over.

    Parameters
    ----------
    path : path-like
    dpi : int
        Dots per inch.
    curve : DataFrame
        `compression.csv`.
    line : DataFrame
        `compression_line.csv`.
    why : str, optional
        Why there is no fit.
    """
    with figure(path, dpi, *grid(1, 2)) as panels:
        drawn(plot_compression, why, curve, line, ax=panels[0])
        drawn(plot_residuals, why, curve, ax=panels[1])


def plot_gradings(curves: Table, ax: Axes | None = None) -> Axes:
    """Draw percent finer by mass of the gradings that a table has.

    Parameters
    ----------
    curves : DataFrame
        `gradings.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    unit, scale = ("mm", 1e3) if curves["diameter_m"].max() >= 1e-4 else ("µm", 1e6)
    diameter = curves["diameter_m"] * scale
    for name, label, style, color in _GRADINGS:
        column = f"percent_finer_by_mass_{name}"
        if column in curves:
            ax.plot(diameter, curves[column], style, color=color, label=label)
    ax.set(xscale="log", ylabel="percent finer by mass [%]", ylim=(0, 102))
    ax.set_xlabel(f"grain diameter D [{unit}]")
    mark_sizes(ax.xaxis, diameter.max() / diameter.min())
    ax.legend(loc="best")
    return ax


def plot_compression(curve: Table, line: Table, ax: Axes | None = None) -> Axes:
    """Draw void ratio, or strain where no void ratio is known, against mean stress.

    Parameters
    ----------
    curve : DataFrame
        `compression.csv`.
    line : DataFrame
        `compression_line.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, value = axes(ax), _value(curve)
    stress = curve["mean_stress_Pa"] / 1e6
    ax.plot(stress, curve[value], "o", color=MEASURED, label="measured", zorder=3)
    for name, label, style, color in _FITS:
        fitted = line[f"{value}_{name}"]
        ax.plot(line["mean_stress_Pa"] / 1e6, fitted, style, color=color, label=label)
    ax.set(ylabel=_LABELS[value])
    _stress_axis(ax, stress)
    if value == _STRAIN:  # compression goes down, as it does in a void ratio
        ax.invert_yaxis()
    ax.legend(loc="lower left")
    return ax


def plot_residuals(curve: Table, ax: Axes | None = None) -> Axes:
    """Draw what each fit leaves over: measured less fitted.

    Parameters
    ----------
    curve : DataFrame
        `compression.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax, value = axes(ax), _value(curve)
    stress = curve["mean_stress_Pa"] / 1e6
    ax.axhline(0.0, color=FAINT, lw=0.8)
    for name, label, style, color in _FITS:
        left = curve[value] - curve[f"{value}_{name}"]
        ax.plot(stress, left, f"o{style}", color=color, lw=0.8, label=label)
    what, unit = _LABELS[value].rsplit(" ", 1)
    ax.set(ylabel=f"{what},\nmeasured less fitted {unit}")
    _stress_axis(ax, stress)
    return legend_above(ax, 2)


def _value(curve: Table) -> str:
    return _VOID_RATIO if _VOID_RATIO in curve else _STRAIN


def _stress_axis(ax: Axes, stress: Table) -> None:
    ax.set(xscale="log", xlabel="mean stress p [MPa]")
    few = stress.max() / stress.min() < 100
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
