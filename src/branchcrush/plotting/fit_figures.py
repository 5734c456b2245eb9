"""The figures of what is fitted to a sample, a function each: result files in, one picture out."""

import os
from collections.abc import Mapping

from matplotlib.figure import Figure

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import Table
from branchcrush.plotting import branches, energy, loading, predictors
from branchcrush.plotting.style import SIZE, drawn, figure, grid

Path = str | os.PathLike


def draw_energy_split(path: Path, dpi: int, table: Table, fit: EnergySplitFit) -> Figure:
    """Draw Fig. 5, the energy split, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    table : DataFrame
        `energy_split.csv`.
    fit : EnergySplitFit
        Read from `energy_split.json`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi) as ax:
        drawn(energy.plot_energy_split, fit.reason, table, fit, ax=ax)
    return ax.figure


def draw_cubic(path: Path, dpi: int, table: Table, fit: EnergySplitFit) -> Figure:
    """Draw Fig. 6, the energy split against the cube of the length, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    table : DataFrame
        `energy_split.csv`.
    fit : EnergySplitFit
        Read from `energy_split.json`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi) as ax:
        drawn(energy.plot_cubic, fit.reason, table, fit, ax=ax)
    return ax.figure


def draw_branch_lengths(
    path: Path, dpi: int, table: Table, statistics: Mapping, radius_max: float
) -> Figure:
    """Draw Fig. 7, the branch lengths, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    table : DataFrame
        `branch_lengths.csv`.
    statistics : mapping
        `branch_lengths.json`.
    radius_max : float
        R_M [m].

    Returns
    -------
    Figure
    """
    with figure(path, dpi, (SIZE[0], 3.4)) as ax:  # with room for the legend
        drawn(
            branches.plot_branch_lengths,
            statistics.get("reason"),
            table,
            statistics,
            radius_max,
            ax=ax,
        )
    return ax.figure


def draw_exponent_path(path: Path, dpi: int, states: Table, fit: EnergySplitFit) -> Figure:
    """Draw n along the loading, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    states : DataFrame
        `energy_split_path.csv`.
    fit : EnergySplitFit
        Read from `energy_split.json`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi) as ax:
        drawn(energy.plot_exponent_path, fit.reason, states, fit, ax=ax)
    return ax.figure


def draw_predictors(path: Path, dpi: int, fit: EnergySplitFit, ratio: Table) -> Figure:
    """Draw what predicts the energies, local exponents and radius ratios, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    fit : EnergySplitFit
        Read from `energy_split.json`.
    ratio : DataFrame
        `energy_split_ratio.csv`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi, *grid(1, 3)) as panels:
        drawn(predictors.plot_predictors, fit.reason, fit, ax=panels[0])
        drawn(predictors.plot_local_exponents, fit.reason, fit, ax=panels[1])
        drawn(predictors.plot_radius_ratio, fit.reason, ratio, fit, ax=panels[2])
    return panels[0].figure


def draw_compression_curve(path: Path, dpi: int, paths: Table) -> Figure:
    """Draw void ratio against the logarithm of the stress, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    paths : DataFrame
        `path.csv` of all seeds, from `samples.ensemble.stacked`.

    Returns
    -------
    Figure
    """
    why = None if paths["carries_load"].any() else "no packing carries load in any state"
    with figure(path, dpi) as ax:
        drawn(loading.plot_compression_curve, why, paths, ax=ax)
    return ax.figure


def draw_loading_path(path: Path, dpi: int, states: Table, model: Mapping) -> Figure:
    """Draw stress, energies, coordination and elastic law along the loading, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    states : DataFrame
        `path.csv` of all seeds, from `samples.ensemble.stacked`.
    model : dict
        `thermodynamics.json`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi, *grid(2, 2)) as panels:
        loading.plot_mean_stress(states, ax=panels[0, 0])
        loading.plot_energy_balance(states, ax=panels[0, 1])
        loading.plot_coordination(states, ax=panels[1, 0])
        drawn(loading.plot_elastic_law, model.get("reason"), states, model, ax=panels[1, 1])
    return panels[0, 0].figure
