"""The figures of the networks of a sample, a function each: result files in, one picture out."""

import os
from collections.abc import Mapping

from matplotlib.figure import Figure

from branchcrush.files.tables import Table
from branchcrush.packings.cells import path_cells
from branchcrush.plotting import branches, chains, forces, shielding
from branchcrush.plotting.style import SIZE, drawn, figure, grid, reason
from branchcrush.samples.ensemble import end_of_loading

Path = str | os.PathLike


def draw_who_touches_whom(
    path: Path, dpi: int, numbers: Mapping, tables: Mapping[str, Table], radius_max: float
) -> Figure:
    """Draw contact numbers, pairs of radii and predicted branch lengths, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    numbers : dict
        `contact_numbers.json`.
    tables : mapping of DataFrame
        `contact_numbers.csv`, `contact_pairs.csv` and `length_predictions.csv`, by these names
        without their ends.
    radius_max : float
        R_M [m].

    Returns
    -------
    Figure
    """
    lengths = tables["length_predictions"]
    (width, height), panels_of = grid(2, 2)
    with figure(path, dpi, (width, 1.2 * height), panels_of) as panels:  # with room for legends
        for ax, plot, *data in (
            (panels[0, 0], branches.plot_contact_numbers, tables["contact_numbers"], numbers),
            (panels[0, 1], branches.plot_pairs, tables["contact_pairs"], numbers),
            (panels[1, 1], branches.plot_mean_lengths, lengths),
        ):
            drawn(plot, numbers.get("reason"), *data, radius_max, ax=ax)
        drawn(branches.plot_distances, numbers.get("reason"), lengths, ax=panels[1, 0])
    return panels[0, 0].figure


def draw_sharing(
    path: Path, dpi: int, shared: Mapping, tables: Mapping[str, Table], radius_max: float
) -> Figure:
    """Draw who carries what: shielding, forces, stress and fabric; and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    shared : dict
        `sharing.json`.
    tables : mapping of DataFrame
        `samples.sharing.TABLES` of the sample, by name.
    radius_max : float
        R_M [m].

    Returns
    -------
    Figure
    """
    why = shared.get("reason")
    by_branch = why or shared["end"]["shielding"]["branches"].get("reason")
    (width, height), panels_of = grid(4, 2)
    with figure(path, dpi, (width, 1.15 * height), panels_of) as panels:  # with room for legends
        panels.flat[-1].set_axis_off()
        for ax, (name, plot, result, *data) in zip(
            panels.flat[:-1],
            (
                ("shielding_branches", shielding.plot_branch_shielding, by_branch, shared),
                ("shielding_grains", shielding.plot_grain_shielding, why),
                ("force_distribution", forces.plot_force_distribution, why, shared),
                ("force_by_length", forces.plot_force_by_length, why, shared, radius_max),
                ("stress_by_radius", forces.plot_stress_by_radius, why, radius_max),
                ("stress_sharing", forces.plot_stress_sharing, why, shared),
                ("fabric", forces.plot_fabric, why, shared),
            ),
            strict=True,
        ):
            drawn(plot, result, tables[name], *data, ax=ax)
    return panels[0, 0].figure


def draw_chains(
    path: Path,
    dpi: int,
    compressed: Table,
    contacts: Table,
    loading_path: Table,
    reading: Mapping | None = None,
) -> Figure:
    """Draw force chains and the energy of branches in a slab of a packing, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    compressed : DataFrame
        `compressed.parquet` of a packing.
    contacts : DataFrame
        Its `contacts.parquet`.
    loading_path : DataFrame
        Its `path.csv`.
    reading : mapping, optional
        `reading.json` of a packing that another code made, whose cell need not be a cube.

    Returns
    -------
    Figure
        The slab is as thick as the largest grain, across the middle of the cell.
    """
    end = end_of_loading(loading_path)
    last = contacts[contacts["state"] == end["state"]]
    cell = path_cells(loading_path, reading)[end.name]
    thickness = 2.0 * compressed["radius_m"].max()
    plots = (chains.plot_slab, chains.plot_branch_energy)
    with figure(path, dpi, *grid(1, 2)) as panels:
        for ax, plot in zip(panels, plots, strict=True):
            if last["normal_force_N"].max() > 0:
                plot(compressed, last, cell, thickness, ax=ax)
            else:
                reason(ax, "no grain touches another at the end of the loading")
    return panels[0].figure


def draw_rose(path: Path, dpi: int, contacts: Table, loading_path: Table) -> Figure:
    """Draw which way the branches of a packing point, seen along each axis, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    contacts : DataFrame
        `contacts.parquet` of a packing.
    loading_path : DataFrame
        Its `path.csv`.

    Returns
    -------
    Figure
        Of the end of the loading.
    """
    last = contacts[contacts["state"] == end_of_loading(loading_path)["state"]]
    with figure(path, dpi, (2 * SIZE[0], SIZE[1]), (1, 3), projection="polar") as panels:
        for ax, normal in zip(panels, "xyz", strict=True):
            if len(last):
                chains.plot_rose(last, normal, ax=ax)
            else:
                reason(ax, "no grain touches another at the end of the loading")
    return panels[0].figure
