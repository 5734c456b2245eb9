"""The loading path as measured: stress, energies, coordination."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator

from branchcrush.crushing.elastic_fits import interpolated_elasticity
from branchcrush.files.tables import Table
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, axes, legend_above, widen


def plot_mean_stress(path: Table, ax: Axes | None = None) -> Axes:
    """Draw the mean stress of every seed against solid fraction.

    Parameters
    ----------
    path : DataFrame
        From `samples.ensemble.stacked`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    _each_seed(ax, path, path["mean_stress_Pa"] / 1e6)
    if (path["leg"] == "unloading").any():
        back = path[path["leg"] == "unloading"].groupby("state").mean(numeric_only=True)
        stress = back["mean_stress_Pa"] / 1e6
        ax.plot(back["solid_fraction"], stress, "s", color=OTHER, ms=3, label="unloading, mean")
    ax.set(xlabel=r"solid fraction $\phi$ [-]", ylabel="mean stress [MPa]")
    ax.legend(loc="upper left")
    return ax


def plot_compression_curve(path: Table, ax: Axes | None = None) -> Axes:
    """Draw the void ratio of every seed against the logarithm of the mean stress, and their mean.

    Parameters
    ----------
    path : DataFrame
        From `samples.ensemble.stacked`; states that carry no load have no place on the axis.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    loaded = path[path["carries_load"]]
    for leg, color in (("loading", MEASURED), ("unloading", OTHER)):
        part = loaded[loaded["leg"] == leg]
        for number, (_, seed) in enumerate(part.groupby("seed_number")):
            label = f"{leg}, each seed" if number == 0 else None
            stress = seed["mean_stress_Pa"] / 1e6
            ax.plot(stress, seed["void_ratio"], color=color, alpha=0.3, lw=0.7, label=label)
        if len(part):
            mean = part.groupby("state")[["mean_stress_Pa", "void_ratio"]].mean()
            line = {"color": MODEL if leg == "loading" else OTHER, "label": f"{leg}, mean"}
            ax.plot(mean["mean_stress_Pa"] / 1e6, mean["void_ratio"], "o-", **line)
    ax.set(xscale="log", xlabel="mean stress p [MPa]", ylabel="void ratio e [-]")
    # Plain numbers, a few to a decade: most curves span one or two.
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.xaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter("")
    ax.legend()
    return ax


def plot_energy_balance(path: Table, ax: Axes | None = None) -> Axes:
    """Draw work, stored and dissipated energy per volume as it is then, means over the seeds.

    Parameters
    ----------
    path : DataFrame
        From `samples.ensemble.stacked`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    names = {
        "work_J": ("work on the boundary", FAINT),
        "elastic_energy_J": ("stored, elastic", MEASURED),
        "dissipated_J": ("dissipated by rearrangement", MODEL),
    }
    for column, (label, color) in names.items():
        density = (path[column] / path["volume_m3"] / 1e6).groupby(path["state"]).mean()
        phi = path.groupby("state")["solid_fraction"].mean()
        ax.plot(phi[1:], density[1:], "o-", color=color, label=label)
    ax.set(xlabel=r"solid fraction $\phi$ [-]", ylabel="energy per current volume [MJ/m³]")
    ax.legend(loc="upper left")
    return ax


def plot_coordination(path: Table, ax: Axes | None = None) -> Axes:
    """Draw the coordination numbers and the share of rattlers, means over the seeds.

    Parameters
    ----------
    path : DataFrame
        From `samples.ensemble.stacked`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    mean = path[path["carries_load"]].groupby("state").mean(numeric_only=True)
    phi = mean["solid_fraction"]
    ax.plot(
        phi,
        mean["mechanical_coordination_number"],
        "o-",
        color=MODEL,
        label=r"$\kappa^*$ without rattlers",
    )
    ax.plot(phi, mean["coordination_number"], "o-", color=MEASURED, label=r"$\kappa$ of all grains")
    ax.set(xlabel=r"solid fraction $\phi$ [-]", ylabel="coordination number [-]", ylim=(0, None))
    share = ax.twinx()
    share.plot(phi, 100 * mean["rattler_fraction"], "s--", color=OTHER)
    share.set_ylabel("rattlers [%]", color=OTHER)
    share.set_ylim(0, 100)
    share.spines["right"].set_visible(True)
    ax.plot([], [], "s--", color=OTHER, label="rattlers (right)")
    return widen(legend_above(ax, 2))


def plot_elastic_law(path: Table, summary: Mapping, ax: Axes | None = None) -> Axes:
    """Draw the measured elastic energy and the law fitted to it, per volume at jamming.

    Parameters
    ----------
    path : DataFrame
        From `samples.ensemble.stacked`.
    summary : dict
        `thermodynamics.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    path = path[path["leg"] == "loading"]
    jamming = summary["jamming_solid_fraction"]
    strain = 1 - jamming / path["solid_fraction"]
    density = path["elastic_energy_J"] / path["volume_m3"] * jamming / path["solid_fraction"]
    shown = strain > -0.1
    ax.plot(
        100 * strain[shown],
        density[shown] * 1e-6,
        ".",
        color=MEASURED,
        alpha=0.5,
        label="each seed",
    )
    line = np.linspace(0.0, 100 * strain.max(), 200)
    end = rf"$\phi_J$ = {jamming:.3f}, $R^2$ = {summary['elastic_r_squared']:.4f}"
    if summary["elastic_exponent"] is None:
        per_volume = path.assign(energy=path["elastic_energy_J"] / path["volume_m3"])
        means = per_volume.groupby("state")[["solid_fraction", "energy"]].mean()
        energy = interpolated_elasticity(*means.to_numpy().T, jamming)[0].energy(line / 100)
        label = f"through the mean of every state,\n{end}"
    else:
        power = summary["elastic_exponent"] + 1
        energy = summary["elastic_modulus_Pa"] / power * (line / 100) ** power
        label = (
            rf"$A\,\epsilon^{{m+1}}/(m+1)$, A = {summary['elastic_modulus_Pa'] / 1e6:.0f} MPa,"
            f"\nm = {summary['elastic_exponent']:.2f}, {end}"
        )
    ax.plot(line, energy * 1e-6, color=MODEL, label=label)
    ax.set(
        xlabel=r"volumetric strain from jamming $\epsilon$ [%]",
        ylabel="elastic energy $\\Psi_0$ per volume\nat jamming [MJ/m³]",
    )
    ax.legend(loc="upper left")
    return ax


def _each_seed(ax, path, values):
    for number, (_, seed) in enumerate(path.groupby("seed_number")):
        label = "each seed" if number == 0 else None
        ax.plot(
            seed["solid_fraction"],
            values[seed.index],
            color=MEASURED,
            alpha=0.3,
            lw=0.7,
            label=label,
        )
    mean = values.groupby(path["state"]).mean()
    ax.plot(
        path.groupby("state")["solid_fraction"].mean(),
        mean,
        "o-",
        color=MODEL,
        label="mean of seeds",
    )
