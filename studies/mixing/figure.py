"""The figure of docs/mixing.md: energy and jamming point of the mixtures beside the forms."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter
from pairs import Pair

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, figure, grid, reason

LABELS = {**FORM_LABELS, "moving_jamming_parking": "the same by random parking"}
# Line of each form.
LOOKS = {
    "moving_jamming": {"color": MODEL, "lw": 1.8},
    "moving_jamming_parking": {"color": MODEL, "ls": ":", "marker": "x"},
    "paper": {"color": OTHER},
    "density": {"color": "#8a5aa5", "ls": "--"},
    "einav": {"color": "#c99a1a", "ls": "-."},
}
TITLES = {
    "mix": "uniform toward fractal",
    "gap": "gap-graded, size ratio 6",
    "held_a": "held out: lognormal toward fractal",
    "held_b": "held out: narrow toward lognormal fines",
}
LAWS = {"linear": "linear", "hertz": "Hertz"}
# Elastic strains that are drawn, the middle one with its intervals.
SHOWN = {0.02: ("o", "none"), 0.04: ("o", MEASURED), 0.07: ("s", "none")}


def draw(
    path: Path,
    pairs: Sequence[Pair],
    compared: pd.DataFrame,
    measured: pd.DataFrame,
    predictions: pd.DataFrame,
) -> None:
    """Draw a panel of the energy for each pair, and one of the jamming points of all."""
    size, panels = grid(2, 3)
    with figure(path, 114, size, panels) as axes:
        for pair, ax in zip(pairs, axes.flat, strict=False):
            _energy(ax, pair, compared, predictions)
        handles = axes.flat[0].get_legend_handles_labels()
        axes.flat[0].figure.legend(*handles, loc="outside lower center", ncols=4)
        for ax in axes.flat[len(pairs) : -1]:
            ax.set_axis_off()
        _jamming(axes.flat[-1], pairs, measured, predictions)


def _energy(ax: Axes, pair: Pair, compared: pd.DataFrame, predictions: pd.DataFrame) -> None:
    said = predictions[(predictions["pair"] == pair.name) & (predictions["law"] == pair.law)]
    for form, look in LOOKS.items():
        rows = said[said["form"] == form]
        ax.plot(rows["crushing"], rows["stiffness_ratio"], label=LABELS[form], **look)
    for level, (marker, face) in SHOWN.items():
        at = _measured_at(compared, pair, level)
        look = {"color": MEASURED, "marker": marker, "mfc": face, "ls": "none", "zorder": 5}
        label = f"DEM, elastic strain {level:g}"
        ax.plot(at["crushing"], at["energy_ratio"], label=label, **look)
        if face != "none":
            limits = at[["energy_ratio_low", "energy_ratio_high"]]
            ax.vlines(at["crushing"], *limits.to_numpy().T, color=MEASURED, lw=0.8)
    ax.axhline(1.0, color=FAINT, lw=0.6, zorder=0)
    ax.set_yscale("log")
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set_title(f"{TITLES.get(pair.name, pair.name)}, {LAWS[pair.law]}")
    ax.set_xlabel("C, share of the ultimate grading by mass [-]")
    ax.set_ylabel(r"$\Psi(C)/\Psi(0)$ at equal elastic strain [-]")


def _measured_at(compared: pd.DataFrame, pair: Pair, level: float) -> pd.DataFrame:
    """Return a row for each mixture of a pair that was measured at an elastic strain."""
    columns = ["crushing", "energy_ratio", "energy_ratio_low", "energy_ratio_high"]
    if not len(compared):
        return pd.DataFrame(columns=columns, dtype=float)
    return compared[
        (compared["pair"] == pair.name)
        & (compared["law"] == pair.law)
        & (compared["basis"] == "elastic_strain")
        & (compared["level"] == level)
        & (compared["form"] == "moving_jamming")
    ][columns]


def _jamming(
    ax: Axes, pairs: Sequence[Pair], measured: pd.DataFrame, predictions: pd.DataFrame
) -> None:
    colors = [MEASURED, "#6f9bc4", MODEL, OTHER, "#8a5aa5"]
    if not len(measured):
        reason(ax, "nothing was packed yet")
        return
    said = predictions[predictions["form"] == "moving_jamming"].set_index("sample")
    at = measured[measured["basis"] == "elastic_strain"].drop_duplicates("sample")
    for pair, color in zip(pairs, colors, strict=False):
        rows = at[(at["pair"] == pair.name) & (at["law"] == pair.law)]
        if not len(rows):
            continue
        predicted = said.loc[rows["sample"], "jamming_solid_fraction"]
        error = predicted.to_numpy() - rows["jamming_solid_fraction"].to_numpy()
        limits = (
            predicted.to_numpy()
            - rows[["jamming_solid_fraction_high", "jamming_solid_fraction_low"]].to_numpy().T
        )
        ax.plot(rows["crushing"], error, "o-", color=color, label=f"{pair.name}, {LAWS[pair.law]}")
        ax.vlines(rows["crushing"], *limits, color=color, lw=0.6)
    ax.axhline(0.0, color=FAINT, lw=0.6, zorder=0)
    ax.set_title("jamming point by rods, from the grading alone")
    ax.set_xlabel("C [-]")
    ax.set_ylabel(r"predicted less measured $\phi_J$ [-]")
    ax.legend()
    ax.set_xlim(-0.03, 1.03)
