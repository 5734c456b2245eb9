"""Panels of grains that break: compression line, jamming point, gradings, where the work went."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator, NullLocator

from branchcrush.files.tables import Table
from branchcrush.plotting.form_lines import plain_decades
from branchcrush.plotting.gradings import mark_sizes
from branchcrush.plotting.intervals import draw_band
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, axes, legend_above

# Where the work went, the largest part first, with labels and colours.
PARTS: Mapping[str, tuple[str, str]] = {
    "avalanches": ("avalanches after breakages", MODEL),
    "rearrangement": ("rearrangement while straining", "#7d5ba6"),
    "released_by_parents": ("contacts of the broken grains", OTHER),
    "stored": ("stored elastically", MEASURED),
}
# Of rearrangement.
STEP_EXCESS = ("of it, by the size of the strain step", "#b9a3d6")
_MARKERS = "osD^v<>ph*"
_DENSITY = r"solid fraction $\phi$ [-]"


def plot_line(
    states: Table, line: Table, controls: Sequence[Table], summary: Mapping, ax: Axes | None = None
) -> Axes:
    """Draw void ratio over mean stress of every seed, beside the line of the gradings alone.

    Parameters
    ----------
    states, line : DataFrame
        `crushing_states.csv` and `crushing_line.csv`.
    controls : list of DataFrame
        `path.csv` of each seed whose grains do not break.
    summary : mapping
        `crushing.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    loaded = states[states["carries_load"].astype(bool) & ~states["halved_step"]]
    for k, (seed, rows) in enumerate(loaded.groupby("seed")):
        ax.plot(
            rows["mean_stress_Pa"] / 1e6,
            rows["void_ratio"],
            _MARKERS[k % len(_MARKERS)],
            color=MEASURED,
            mfc="none",
            label=f"seed {seed}",
            zorder=3,
        )
    for k, path in enumerate(controls):
        rows = path[path["carries_load"].astype(bool) & (path["leg"] == "loading")]
        label = None if k else "grains do not break"
        ax.plot(rows["mean_stress_Pa"] / 1e6, rows["void_ratio"], color=FAINT, lw=0.8, label=label)
    if len(line):
        mean = line.groupby("state")[["predicted_stress_Pa", "predicted_void_ratio"]].mean()
        if mean.notna().all(axis=1).any():
            label = "from the gradings alone"
            ax.plot(mean.iloc[:, 0] / 1e6, mean.iloc[:, 1], color=MODEL, label=label)
        slope = summary["slope"]
        # With fewer states that yield there is no line yet that a law could stand beside.
        if slope is not None and np.isfinite(slope):
            _law(ax, line, summary)
    ax.set(xscale="log", yscale="log", xlabel="mean stress p [MPa]", ylabel="void ratio e [-]")
    plain_decades(ax.xaxis)
    # Void ratios span less than a decade, of which marks at 1, 2 and 5 would leave one.
    ax.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]))
    ax.yaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_minor_locator(NullLocator())
    return legend_above(ax, 2)


def _law(ax: Axes, line: Table, summary: Mapping) -> None:
    """Draw the slope of the law through the middle of the states that yield."""
    stress, void = line["mean_stress_Pa"], line["void_ratio"]
    middle = np.exp(np.log(stress).mean()), np.exp(np.log(void).mean())
    ends = np.array([stress.min(), stress.max()])
    slope = summary["slope_by_strength"]
    at = middle[1] * (ends / middle[0]) ** -slope
    ax.plot(ends / 1e6, at, "--", color=OTHER, label=f"slope 1/(2b) = {slope:.2g}", gid="law")


def plot_jamming(states: Table, ax: Axes | None = None) -> Axes:
    """Draw phi_J of the gradings by rods over phi less the measured elastic strain.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    known = states.dropna(subset=["jamming_by_elastic_strain"])
    for halved, rows in known.groupby("halved_step"):
        ax.plot(
            rows["jamming_by_elastic_strain"],
            rows["jamming_by_rods"],
            "x" if halved else "o",
            color=OTHER if halved else MEASURED,
            mfc="none",
            label="half the step" if halved else "states",
        )
    if len(known):
        both = known[["jamming_by_elastic_strain", "jamming_by_rods"]]
        ends = [both.min().min(), both.max().max()]
        ax.plot(ends, ends, color=FAINT, lw=0.8, label="equal", zorder=1)
    ax.set(xlabel=r"measured, $\phi\,(1 - \epsilon_e)$ [-]", ylabel=r"$\phi_J$ of the grading [-]")
    return legend_above(ax, 3)


def plot_gradings(gradings: Table, summary: Mapping, ax: Axes | None = None) -> Axes:
    """Draw percent finer by mass at stages of crushing, and the fractal limit.

    Parameters
    ----------
    gradings : DataFrame
        `crushing_gradings.csv`.
    summary : mapping
        `crushing.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    from matplotlib import colormaps

    ax = axes(ax)
    stages = gradings["state"].unique()
    for k, (_, rows) in enumerate(gradings.groupby("state")):
        color = colormaps["viridis"](0.9 * k / max(len(stages) - 1, 1))
        size = rows["diameter_m"] * 1e3
        label = rf"$\phi$ = {rows['solid_fraction'].iloc[0]:.3f}"
        ax.plot(size, rows["percent_finer_by_mass"], color=color, label=label)
        draw_band(ax, size, rows, "percent_finer_by_mass", color, alpha=0.12)
    limit = rows["percent_finer_by_mass_ultimate"]
    if limit.notna().any():
        label = rf"fractal, $\alpha$ = {summary['ultimate_alpha']:g}"
        ax.plot(size, limit, "--", color=MODEL, label=label)
    ax.axvline(1e3 * summary["comminution_limit_m"], color=FAINT, lw=0.8)
    ax.set(xscale="log", ylabel="percent finer by mass [%]", ylim=(0, 102))
    ax.set_xlabel("grain diameter d [mm]")
    mark_sizes(ax.xaxis, size.max() / size.min())
    return legend_above(ax, 2)


def plot_energy(means: Table, ax: Axes | None = None) -> Axes:
    """Draw the shares of the work since the first breakage, with the halved step dashed.

    Parameters
    ----------
    means : DataFrame
        `crushing_means.csv`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    # Of a mean over fewer seeds than there are the line would jump.
    full = means[means["seeds"] == means.groupby("halved_step")["seeds"].transform("max")]
    for name, (label, color) in {**PARTS, "step_excess": STEP_EXCESS}.items():
        for halved, rows in full.groupby("halved_step"):
            style = {"ls": "--", "lw": 0.9} if halved else {"label": label}
            ax.plot(
                rows["solid_fraction"],
                100.0 * rows[f"{name}_share"],
                color=color,
                gid=name,
                **style,
            )
    if full["halved_step"].any():
        ax.plot([], [], "--", color="0.4", lw=0.9, label="half the strain step")
    ax.set(xlabel=_DENSITY, ylabel="share of the work since\nthe first breakage [%]")
    ax.set_ylim(min(0.0, ax.get_ylim()[0]), 100.0)
    return legend_above(ax, 1)
