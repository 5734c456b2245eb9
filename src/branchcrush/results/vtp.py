"""A state of a packing as files for ParaView."""

from pathlib import Path

import numpy as np
import pandas as pd

from branchcrush.files.vtk_xml import write_polydata
from branchcrush.forces.chains import ForceChains

# Two corners of a cube that differ in one coordinate are joined by an edge.
_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 2.0
_EDGES = [
    (a, b) for a in range(8) for b in range(a) if np.abs(_CORNERS[a] - _CORNERS[b]).sum() == 1
]


def write_state(
    folder: str | Path,
    number: int,
    edge: float,
    grains: pd.DataFrame,
    contacts: pd.DataFrame,
    chains: ForceChains,
) -> list[Path]:
    """Write grains, contacts, force chains and the cell of a state as .vtp files.

    Parameters
    ----------
    folder : path-like
        Is made.
    number : int
        Of the state, at the end of the names.
    edge : float
        Of the cell [m].
    grains, contacts : DataFrame
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
    names = ("grains", "contacts", "force_chains", "cell")
    paths = [folder / f"{name}_{number:04d}.vtp" for name in names]

    # A glyph of ParaView is a sphere of diameter 1, and is scaled by the diameter.
    of_grains = {"grain": np.arange(len(grains)), "diameter_m": 2.0 * grains["radius_m"]}
    of_grains |= {name: grains[name] for name in grains if name not in ("x_m", "y_m", "z_m")}
    write_polydata(paths[0], centres, point_data=of_grains)

    branch = contacts[["branch_x", "branch_y", "branch_z"]].to_numpy()
    dropped = ("state", "branch_x", "branch_y", "branch_z")
    of_contacts = {name: contacts[name] for name in contacts if name not in dropped}
    _write_branches(paths[1], centres[contacts["i"]], branch, of_contacts)
    of_links = {name: values.iloc[chains.contacts] for name, values in of_contacts.items()}
    of_links |= {"chain": chains.chain, "grains_in_chain": chains.grains}
    start = centres[of_links["i"]]
    _write_branches(paths[2], start, branch[chains.contacts], of_links)

    write_polydata(paths[3], _CORNERS * edge, _EDGES)
    return paths


def _write_branches(path, start, branch, data):
    """Write a line for each branch: from a centre on, out of the cell where it crosses its face."""
    points = np.concatenate([start, start + branch])
    lines = np.arange(len(points)).reshape(2, -1).T
    write_polydata(path, points, lines, cell_data=data)
