"""Figures 3 and 7 of the paper: the grading and the distribution of branch lengths."""

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from numpy.typing import NDArray

from branchcrush.files.tables import Table
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, axes


def plot_grading(grading: Table, ax: Axes | None = None, seeds: str = "all seeds") -> Axes:
    """Draw the sieve curve and the distribution by number: target and realised (Fig. 3).

    The ultimate grading is drawn as well if the table has it.

    Parameters
    ----------
    grading : DataFrame
        `grading.csv`.
    ax : Axes, optional
    seeds : str
        Whose grains are drawn: "all seeds" as a band about their mean, or a single one as a curve.

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    unit, scale = ("mm", 1e3) if grading["diameter_m"].max() >= 1e-4 else ("µm", 1e6)
    diameter = grading["diameter_m"] * scale
    low, high = (grading[f"percent_finer_by_mass_realised_{end}"] for end in ("min", "max"))
    if seeds == "all seeds":
        ax.fill_between(diameter, low, high, color=MEASURED, alpha=0.2, lw=0, label=seeds)
        seeds = "mean of seeds"
    _plot_curves(
        grading,
        diameter,
        (
            ("by_mass_realised", f"by mass, {seeds}", "-", MEASURED),
            ("by_mass_target", "by mass, target", "--", MODEL),
            ("by_mass_ultimate", "by mass, ultimate", "-.", OTHER),
            ("by_number_target", "by number, target", ":", FAINT),
        ),
        ax,
    )
    return _finished(ax, diameter, unit)


def plot_sieve_curve(grading: Mapping[str, NDArray], ax: Axes | None = None) -> Axes:
    """Draw the curves of a grading by mass and by number.

    Parameters
    ----------
    grading : mapping of ndarray
        `diameter_m` and both `percent_finer_..._target` of `grading.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    unit, scale = ("mm", 1e3) if grading["diameter_m"].max() >= 1e-4 else ("µm", 1e6)
    diameter = grading["diameter_m"] * scale
    curves = (
        ("by_mass_target", "by mass", "-", MEASURED),
        ("by_number_target", "by number", ":", FAINT),
    )
    _plot_curves(grading, diameter, curves, ax)
    return _finished(ax, diameter, unit)


def _plot_curves(grading, diameter, curves, ax):
    for name, label, line, color in curves:
        column = f"percent_finer_{name}"
        if column in grading:
            ax.plot(diameter, grading[column], line, color=color, label=label)


def _finished(ax, diameter, unit):
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
