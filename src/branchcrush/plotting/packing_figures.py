"""The figures of the packings of a sample, a function each: result files in, one picture out."""

import os
from collections.abc import Mapping

from matplotlib.figure import Figure
from numpy.typing import NDArray

from branchcrush.files.tables import Table
from branchcrush.packings.cells import path_cells
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.plotting import certificate, gradings
from branchcrush.plotting.packings import plot_packing
from branchcrush.plotting.style import figure, grid
from branchcrush.samples.ensemble import end_of_loading

Path = str | os.PathLike


def draw_grading(path: Path, dpi: int, grading: Table) -> Figure:
    """Draw Fig. 3, the grading, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    grading : DataFrame
        `grading.csv`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi) as ax:
        gradings.plot_grading(grading, ax)
    return ax.figure


def draw_preview(
    path: Path, dpi: int, grading: Mapping[str, NDArray], unit: str, drawn: str = "drawn"
) -> Figure:
    """Draw the grading of a sample that has not run, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    grading, unit, drawn
        As for `plotting.gradings.plot_preview`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi) as ax:
        gradings.plot_preview(grading, unit, drawn, ax)
    return ax.figure


def draw_packing(
    path: Path,
    dpi: int,
    packing: tuple[NDArray, NDArray, float],
    compressed: Table,
    loading_path: Table,
    radius_max: float,
    *,
    reading: Mapping | None = None,
) -> Figure:
    """Draw Fig. 4, a packing before and after its loading to one scale, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    packing : tuple
        Positions, shape (N, 3), radii, shape (N,), and edge of `packing.npz` [m].
    compressed : DataFrame
        `compressed.parquet` of the same packing.
    loading_path : DataFrame
        `path.csv` of this packing.
    radius_max : float
        At the dark end of the colours [m].
    reading : mapping, optional
        `reading.json` of a packing that another code made: its cells, and frames for states.

    Returns
    -------
    Figure
    """
    positions, radii, _ = packing
    end, cells = end_of_loading(loading_path), path_cells(loading_path, reading)
    pair = cells[[0, end.name]]
    scale = {"extent": pair, "radius_max": radius_max}
    with figure(path, dpi, *grid(1, 2)) as (before, after):
        plot_packing(positions, radii, pair[0], **scale, ax=before)
        positions = compressed[["x_m", "y_m", "z_m"]].to_numpy()
        plot_packing(positions, compressed["radius_m"].to_numpy(), pair[1], **scale, ax=after)
        first = loading_path["solid_fraction"].iloc[0]
        words = ("placed at random", "compressed")
        if reading is not None:
            words = ("first frame", "densest frame")
        before.set_title(rf"{words[0]}, $\phi$ = {first:.3f}")
        after.set_title(rf"{words[1]}, $\phi$ = {end['solid_fraction']:.3f}")
    return before.figure


def draw_certificate(
    path: Path, dpi: int, states: Table, jamming: Table, verdict: Mapping
) -> Figure:
    """Draw the certificate of every state, jamming points and convergence, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    states : DataFrame
        `certificate.csv`.
    jamming : DataFrame
        `jamming.csv`.
    verdict : mapping
        `certificate.json`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi, *grid(3, 2)) as panels:
        certificate.plot_rest(states, verdict["limits"], ax=panels[0, 0])
        certificate.plot_overlaps(states, OVERLAP_FLAG, ax=panels[0, 1])
        certificate.plot_dissipation(states, ax=panels[1, 0])
        certificate.plot_jamming(jamming, ax=panels[1, 1])
        bottom = panels[2, 0].get_gridspec()[2, :]
        for panel in panels[2]:
            panel.remove()
        certificate.plot_convergence(
            verdict["convergence"], ax=panels[0, 0].figure.add_subplot(bottom)
        )
    return panels[0, 0].figure
