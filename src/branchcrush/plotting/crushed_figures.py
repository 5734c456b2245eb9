"""Figures of grains that break: what panels each has, and what it says where there is nothing."""

from collections.abc import Mapping, Sequence
from os import PathLike

import numpy as np
from matplotlib.colors import ListedColormap

from branchcrush.files.tables import Table
from branchcrush.packings.cells import path_cells
from branchcrush.plotting import crushed, crushed_forms
from branchcrush.plotting.packings import plot_packing
from branchcrush.plotting.style import drawn, figure, grid, reason

_NONE_BROKE = "no grain broke"
# Generations that are told apart, the last with all further ones.
_GENERATIONS = ("#c9ced6", "#e8b04a", "#c1440e", "#5b1a4a")
_POSITION = ["x_m", "y_m", "z_m"]
_PICTURES = 3


def draw_line(
    path: str | PathLike[str],
    dpi: int,
    tables: Mapping[str, Table],
    controls: Sequence[Table],
    summary: Mapping,
) -> None:
    """Draw the compression line, and the jamming point of the gradings beside the measured one.

    Parameters
    ----------
    path : path-like
    dpi : int
    tables : mapping of DataFrame
        With states and line.
    controls : list of DataFrame
        `path.csv` of each seed whose grains do not break.
    summary : mapping
        `crushing.json`.
    """
    states = tables["states"]
    with figure(path, dpi, *grid(1, 2)) as panels:
        crushed.plot_line(states, tables["line"], controls, summary, ax=panels[0])
        crushed.plot_jamming(states, ax=panels[1])


def draw_gradings(path: str | PathLike[str], dpi: int, gradings: Table, summary: Mapping) -> None:
    """Draw gradings at stages of crushing.

    Parameters
    ----------
    path : path-like
    dpi : int
    gradings : DataFrame
        `crushing_gradings.csv`.
    summary : mapping
        `crushing.json`.
    """
    with figure(path, dpi) as ax:
        crushed.plot_gradings(gradings, summary, ax=ax)


def draw_energy(path: str | PathLike[str], dpi: int, means: Table, summary: Mapping) -> None:
    """Draw where the work since the first breakage went.

    Parameters
    ----------
    path : path-like
    dpi : int
    means : DataFrame
        `crushing_means.csv`.
    summary : mapping
        `crushing.json`.
    """
    with figure(path, dpi) as ax:
        drawn(crushed.plot_energy, None if summary["breakages"] else _NONE_BROKE, means, ax=ax)


def draw_measures(
    path: str | PathLike[str], dpi: int, means: Table, beside: Table, summary: Mapping
) -> None:
    """Draw C and B beside the C of every form.

    Parameters
    ----------
    path : path-like
    dpi : int
    means, beside : DataFrame
        `crushing_means.csv` and `crushing_beside_forms.csv`.
    summary : mapping
        `crushing.json`.
    """
    why = None if summary["breakages"] else _NONE_BROKE
    with figure(path, dpi) as ax:
        drawn(crushed_forms.plot_measures, why, means, beside, ax=ax)


def draw_forms(
    path: str | PathLike[str],
    dpi: int,
    means: Table,
    beside: Table,
    controls: Sequence[Table],
) -> None:
    """Draw stress and dissipation beside every form.

    Parameters
    ----------
    path : path-like
    dpi : int
    means, beside : DataFrame
        `crushing_means.csv` and `crushing_beside_forms.csv`.
    controls : list of DataFrame
        `path.csv` of each seed whose grains do not break.
    """
    with figure(path, dpi, *grid(1, 2)) as panels:
        crushed_forms.plot_stress(means, beside, controls, ax=panels[0])
        crushed_forms.plot_dissipation(means, beside, ax=panels[1])


def draw_packing(
    path: str | PathLike[str], dpi: int, grains: Table, loading: Table, summary: Mapping
) -> None:
    """Draw the packing of one seed at stages, grains coloured by generation, to one scale.

    Parameters
    ----------
    path : path-like
    dpi : int
    grains : DataFrame
        `grains.parquet`.
    loading : DataFrame
        `path.csv` of the same crushing.
    summary : mapping
        `crushing.json`.
    """
    stages = summary["stages"]
    chosen = [stages[k] for k in np.unique(np.linspace(0, len(stages) - 1, _PICTURES).astype(int))]
    colours = ListedColormap(_GENERATIONS)
    with figure(path, dpi, *grid(1, len(chosen)), squeeze=False) as panels:
        rows = loading.set_index("state")
        cells = dict(zip(rows.index, path_cells(loading), strict=True))
        for ax, state in zip(panels[0], chosen, strict=True):
            here = grains[grains["state"] == state]
            if not set(_POSITION) <= set(grains.columns):
                reason(ax, "grains.parquet has no positions")
                continue
            generation = np.minimum(here["generation"], len(_GENERATIONS) - 1).to_numpy()
            plot_packing(
                here[_POSITION].to_numpy(),
                here["radius_m"].to_numpy(),
                cells[state],
                extent=cells[chosen[0]],
                colours=colours(generation)[:, :3],
                ax=ax,
            )
            told = rows.loc[state]
            ax.set_title(rf"$\phi$ = {told['solid_fraction']:.3f}, {told['grains']:.0f} grains")
