"""The tables that a compression leaves, made of the frames of a packing that another code made."""

from typing import Any, NamedTuple

import numpy as np

from branchcrush.loading.measures import (
    cell_measures,
    coordination_measures,
    energy_measures,
    overlap_measures,
    rest_measures,
    stress_measures,
)
from branchcrush.loading.states import force_floor, law_error
from branchcrush.packings.contact_laws import HertzContact, LinearContact, reduced_radius
from branchcrush.packings.geometry import solid_volume
from branchcrush.readers.packing import Moment, ReadPacking

# Solid fractions that differ by less are the same.
_SAME = 1e-9


class PackingTables(NamedTuple):
    """What a packing leaves: a table for each kind of thing, as a dict of columns."""

    path: dict  # a row for each state
    contacts: dict  # a row for each contact and state
    walls: dict  # the same with walls
    steps: dict  # a row for each state, from which the jamming point is sought
    compressed: dict  # a row for each grain in the densest state


def packing_tables(read: ReadPacking, law: LinearContact | HertzContact) -> PackingTables:
    r"""Return the states of a packing as a compression of this workflow leaves them.

    .. math:: E = E(F, R^*), \qquad R^* = \frac{R_i R_j}{R_i + R_j}

    Energies are those of the normal forces under the contact law. What the files of other codes do
    not hold (work, kinetic energy, stress of the boundary) is nan.

    Parameters
    ----------
    read : ReadPacking
    law : LinearContact or HertzContact
        Of the run that made the contacts.

    Returns
    -------
    PackingTables

    Examples
    --------
    >>> from branchcrush.readers.layouts import Source
    >>> from branchcrush.readers.packing import read_frames
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     grains, contacts = (pathlib.Path(folder, name) for name in ("balls", "contacts"))
    ...     _ = grains.write_text("id x y z radius\n4 1 2 2 0.5\n9 1.9 2 2 0.5\n")
    ...     _ = contacts.write_text("id1 id2 fx fy fz\n9 4 3 0 0\n")
    ...     read = read_frames(Source(format="columns", grains=[grains], contacts=[contacts],
    ...                               periodic=True, low=[0, 0, 0], high=[4, 4, 4]))
    >>> tables = packing_tables(read, LinearContact(10.0))
    >>> tables.contacts["energy_J"].tolist(), tables.path["elastic_energy_J"].tolist()
    ([0.45], [0.45])
    """
    moments = read.moments
    first_edge = moments[0].cell.edge
    contacts = [_contacts(moment, law) for moment in moments]
    walls = [_walls(moment) for moment in moments]
    rows = [
        _row(number, moment, own, at_walls, first_edge, law)
        for number, (moment, own, at_walls) in enumerate(zip(moments, contacts, walls, strict=True))
    ]
    path = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    turn = int(np.flatnonzero(path["solid_fraction"] > path["solid_fraction"].max() - _SAME)[-1])
    path["leg"] = np.where(path["state"] <= turn, "loading", "unloading")
    path["stopped"] = np.full(len(rows), "")
    return PackingTables(
        path, _stacked(contacts), _stacked(walls), _steps(path), _compressed(moments[turn])
    )


def first_packing(read: ReadPacking) -> tuple[np.ndarray, np.ndarray, float]:
    """Return positions, radii and edge of the first frame, as `packing.npz` holds them.

    Parameters
    ----------
    read : ReadPacking

    Returns
    -------
    positions : ndarray, shape (N, 3)
        About the middle of the cell [m].
    radii : ndarray, shape (N,)
        [m]
    edge : float
        Of the cube of the cell's volume [m].
    """
    first = read.moments[0]
    grains = _compressed(first)
    places = np.column_stack([grains[name] for name in ("x_m", "y_m", "z_m")])
    return places, first.grains.radii, first.cell.edge


def _contacts(moment: Moment, law) -> dict[str, np.ndarray]:
    """Return the contacts of a state, in the columns of `contacts.parquet`."""
    touching, radii = moment.touching, moment.grains.radii
    radius_i, radius_j = radii[touching.i], radii[touching.j]
    vector = dict(zip(("branch_x", "branch_y", "branch_z"), touching.vector.T, strict=True))
    return {
        "i": touching.i,
        "j": touching.j,
        "radius_i_m": radius_i,
        "radius_j_m": radius_j,
        "branch_length_m": np.linalg.norm(touching.vector, axis=1),
        **vector,
        "overlap_m": touching.overlap,
        "normal_force_N": touching.normal_force,
        "energy_J": law.energy(touching.normal_force, reduced_radius(radius_i, radius_j)),
    }


def _walls(moment: Moment) -> dict[str, np.ndarray]:
    """Return the contacts with walls of a state, in the columns of `wall_contacts.parquet`."""
    touching = moment.touching
    names = ("direction_x", "direction_y", "direction_z")
    return {
        "i": touching.wall_grain,
        "wall": touching.wall_id.astype(str).astype(object),
        **dict(zip(names, touching.wall_direction.T, strict=True)),
        "overlap_m": touching.wall_overlap,
        "normal_force_N": touching.wall_force,
    }


def _row(number, moment, contacts, walls, first_edge, law) -> dict[str, Any]:
    """Return the row of `path.csv` of a state."""
    radii, edge = moment.grains.radii, moment.cell.edge
    solid = solid_volume(radii)
    stresses = stress_measures(contacts, walls, radii, edge, np.nan)
    return {
        "state": number,
        **cell_measures(edge, first_edge, solid),
        **stresses,
        **energy_measures(contacts, walls, radii, law, np.nan),
        **coordination_measures(contacts, walls, radii.size),
        **rest_measures(
            contacts["normal_force_N"],
            moment.touching.net_force,
            force_floor=force_floor(radii, law),
            kinetic_energy=np.nan,
            solid_volume=solid,
            stress=stresses["mean_stress_Pa"],
        ),
        **overlap_measures(contacts),
        "contact_law_error": law_error(contacts, walls, radii, law),
        "escaped": moment.cell.outside(moment.grains.positions),
        "lost": 0,
        "force_evaluations": np.nan,
    }


def _stacked(parts: list[dict]) -> dict[str, np.ndarray]:
    """Return the columns of all states one below the other."""
    states = np.repeat(np.arange(len(parts)), [len(part["i"]) for part in parts])
    return {"state": states} | {
        name: np.concatenate([part[name] for part in parts]) for name in parts[0]
    }


def _steps(path: dict) -> dict[str, np.ndarray]:
    """Return the states as the strain steps of `steps.csv`."""
    same = ("solid_fraction", "volume_m3", "mean_stress_Pa", "work_J", "unbalanced_force_ratio")
    return {"step": path["state"]} | {name: path[name] for name in same}


def _compressed(moment: Moment) -> dict[str, np.ndarray]:
    """Return the grains of a state, about the middle of the cell."""
    places = moment.cell.wrapped(moment.grains.positions) - moment.cell.centre
    names = ("x_m", "y_m", "z_m")
    return dict(zip(names, places.T, strict=True)) | {"radius_m": moment.grains.radii}
