"""A state of a packing as files for ParaView."""

from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.files.vtk_xml import write_polydata
from branchcrush.forces.chains import ForceChains
from branchcrush.packings.cells import CELL_EDGES, cell_corners
from branchcrush.packings.network import DIRECTION_COLUMNS


def write_state(
    folder: str | Path,
    number: int,
    cell: NDArray,
    grains: pd.DataFrame,
    contacts: pd.DataFrame,
    walls: pd.DataFrame,
    chains: ForceChains,
) -> list[Path]:
    """Write grains, contacts, those with walls, force chains and the cell of a state as .vtp files.

    Parameters
    ----------
    folder : path-like
        Is made.
    number : int
        Of the state, at the end of the names.
    cell : ndarray, shape (3, 3)
        Vectors of its edges, a row each [m].
    grains, contacts, walls : DataFrame
        As a state of `results.packing` has them.
    chains : ForceChains
        Of these contacts.

    Returns
    -------
    list of Path
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    centres = grains[["x_m", "y_m", "z_m"]].to_numpy()
    names = ("grains", "contacts", "wall_contacts", "force_chains", "cell")
    paths = [folder / f"{name}_{number:04d}.vtp" for name in names]

    # A glyph of ParaView is a sphere of diameter 1, and is scaled by the diameter.
    of_grains = {"grain": np.arange(len(grains)), "diameter_m": 2.0 * grains["radius_m"]}
    of_grains |= {name: grains[name] for name in grains if name not in ("x_m", "y_m", "z_m")}
    write_polydata(paths[0], centres, point_data=of_grains)

    branch = contacts[["branch_x", "branch_y", "branch_z"]].to_numpy()
    dropped = ("state", "branch_x", "branch_y", "branch_z")
    of_contacts = {name: contacts[name] for name in contacts if name not in dropped}
    _write_branches(paths[1], centres[contacts["i"]], branch, of_contacts)
    # A periodic cell has an empty table, whose columns have no type.
    held = walls["i"].to_numpy(dtype=int)
    of_walls = {name: walls[name].to_numpy(dtype=float) for name in ("overlap_m", "normal_force_N")}
    reach = grains["radius_m"].to_numpy()[held] - of_walls["overlap_m"]
    towards = reach[:, None] * walls[[*DIRECTION_COLUMNS]].to_numpy(dtype=float)
    _write_branches(paths[2], centres[held], towards, {"i": held, **of_walls})

    of_links = {name: values.iloc[chains.contacts] for name, values in of_contacts.items()}
    of_links |= {"chain": chains.chain, "grains_in_chain": chains.grains}
    start = centres[of_links["i"]]
    _write_branches(paths[3], start, branch[chains.contacts], of_links)

    write_polydata(paths[4], cell_corners(cell), CELL_EDGES)
    return paths


def _write_branches(path, start, branch, data):
    """Write a line for each branch: from a centre on, out of the cell where it crosses its face."""
    points = np.concatenate([start, start + branch])
    lines = np.arange(len(points)).reshape(2, -1).T
    write_polydata(path, points, lines, cell_data=data)
