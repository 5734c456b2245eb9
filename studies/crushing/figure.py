"""The figure of docs/crushing_study.md: compression lines, gradings and energy of all cases."""

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from branchcrush.files.tables import read_table
from branchcrush.plotting.crushed import PARTS
from branchcrush.plotting.style import figure, grid

# Cases of the first three panels, and how they look.
CASES = {
    "base": ("base: b = 1", "#1f4e79", "o"),
    "size_exponent_05": ("b = 0.5", "#c0562b", "^"),
    "size_exponent_2": ("b = 2", "#2e7d52", "v"),
    "hertz": ("Hertz", "#7d5ba6", "s"),
    "octahedral": ("octahedral stress", "#8a6d1b", "D"),
    "limit_eighth": ("limit 1/8", "#4a4a4a", "x"),
}


def draw(
    path: Path, results: Path, names: list[str], study: pd.DataFrame, predictions: pd.DataFrame
) -> None:
    """Draw e over p, the broken mass and alpha over phi with what was predicted, and the energy."""
    means = {}
    for name in names:
        table = read_table(results / name / "crushing_means.csv")
        most = table.groupby("halved_step")["seeds"].transform("max")
        means[name] = table[~table["halved_step"] & (table["seeds"] == most)]
    size, panels = grid(2, 2)
    with figure(path, 114, size, panels) as axes:
        compression, exponents, broken, energy = axes.flat
        for name, look in CASES.items():
            if name not in means:
                continue
            said = predictions[predictions["sample"] == name]
            rows = means[name]
            _case(compression, rows, said, ("mean_stress_Pa", "void_ratio"), look, 1e-6)
            _case(broken, rows, said, ("solid_fraction", "broken_mass_fraction"), look, 1.0)
            _case(exponents, rows, said, ("solid_fraction", "number_exponent"), look, 1.0)
        compression.set(xscale="log", yscale="log", xlim=(0.5, 40.0))
        compression.set(xlabel="mean stress p [MPa]", ylabel="void ratio e [-]")
        compression.minorticks_off()
        for axis, ticks in (
            (compression.xaxis, (0.5, 1, 2, 5, 10, 20)),
            (compression.yaxis, (0.35, 0.4, 0.5, 0.6)),
        ):
            axis.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
        exponents.set(xlabel=r"solid fraction $\phi$ [-]", ylabel=r"$\alpha$ of N(>d) [-]")
        broken.set(xlabel=r"solid fraction $\phi$ [-]", ylabel="mass in fragments [-]")
        _energy(energy, study)
        handles = compression.get_legend_handles_labels()
        compression.figure.legend(*handles, loc="outside lower center", ncols=3)


def _case(
    ax: Axes,
    rows: pd.DataFrame,
    said: pd.DataFrame,
    columns: tuple[str, str],
    look: tuple[str, str, str],
    unit: float,
) -> None:
    """Draw a case: points are simulated, the line was predicted without a simulation."""
    label, color, marker = look
    x, y = columns
    known = rows.dropna(subset=[x, y])
    known = known[(known[x] > 0.0) & (known[y] > 0.0)]
    ax.plot(unit * known[x], known[y], marker, color=color, ms=3.5, label=label)
    if len(said):
        inside = said[said["solid_fraction"] <= known["solid_fraction"].max()]
        ax.plot(unit * inside[x], inside[y], "-", color=color, lw=1.0)


def _energy(ax: Axes, study: pd.DataFrame) -> None:
    """Draw the shares of the work of every sample, one above the other."""
    names = study["sample"].tolist()[::-1]
    left = np.zeros(len(names))
    told = study.set_index("sample")
    for part, (label, color) in PARTS.items():
        share = 100.0 * told.loc[names, f"{part}_share"].to_numpy(float)
        ax.barh(names, share, left=left, color=color, label=label, height=0.7)
        left += share
    ax.set(xlim=(0, 100), xlabel="share of the work since the first breakage [%]")
    ax.legend(loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=2, fontsize=6)
