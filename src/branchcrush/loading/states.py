"""The contacts of a saved state, from what LAMMPS dumps: whether they keep the law, carry load."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import SimulationError
from branchcrush.packings.contact_laws import HertzContact, LinearContact, reduced_radius

# Arrays of one length by name.
Columns = Mapping[str, NDArray]

# The overlap of two mean grains, over their radius, whose force is the mean one below which a
# packing carries no load.
NO_LOAD = 1e-4


def force_floor(radii: ArrayLike, law: LinearContact | HertzContact) -> float:
    r"""Return the mean contact force below which a packing carries no load.

    .. math:: F_0 = F(10^{-4} \langle R \rangle,\ \langle R \rangle / 2)

    F is the law at an overlap and a reduced radius, here those of two mean grains.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    law : LinearContact or HertzContact

    Returns
    -------
    float
        [N]

    Examples
    --------
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> force_floor([1e-3], LinearContact(1e6))
    0.1
    """
    mean = float(np.asarray(radii, dtype=float).mean())
    return float(law.force(NO_LOAD * mean, mean / 2.0))


def stress_floor(radii: ArrayLike, law: LinearContact | HertzContact) -> float:
    r"""Return the mean stress that stands for no load.

    .. math:: P_0 = \frac{F_0}{\pi \langle R \rangle^2}

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    law : LinearContact or HertzContact

    Returns
    -------
    float
        [Pa]

    Examples
    --------
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> round(stress_floor([1e-3], LinearContact(np.pi * 1e6)), 6)
    100000.0
    """
    mean = float(np.asarray(radii, dtype=float).mean())
    return force_floor(radii, law) / (np.pi * mean**2)


def state_contacts(
    pairs: Columns, radii: NDArray, law: LinearContact | HertzContact
) -> dict[str, NDArray]:
    r"""Return the grain-grain contacts of a state, each once, sorted by grain.

    .. math:: \delta = R_i + R_j - l, \quad \mathbf{l} = \mathbf{x}_j - \mathbf{x}_i

    Parameters
    ----------
    pairs : mapping of columns
        A frame of the pair dump: id1, id2, branch and branch_x, -y, -z [m], force [N].
    radii : ndarray, shape (N,)
        By id [m].
    law : LinearContact or HertzContact

    Returns
    -------
    dict of ndarray, shape (M,)
        i, j (from 0, i < j), radius_i_m, radius_j_m, branch_length_m; branch_x, branch_y and
        branch_z, from i to j through the periodic face where they touch there [m]; overlap_m,
        normal_force_N, energy_J.

    Raises
    ------
    SimulationError
        When a contact is listed twice.

    Examples
    --------
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> columns = {"id1": 2, "id2": 1, "branch": 2.5, "force": 5.0,
    ...            "branch_x": 2.5, "branch_y": 0.0, "branch_z": 0.0}
    >>> pairs = {name: np.array([value]) for name, value in columns.items()}
    >>> contacts = state_contacts(pairs, np.array([1.0, 2.0]), LinearContact(10.0))
    >>> [contacts[name].tolist() for name in ("i", "j", "branch_x", "overlap_m", "energy_J")]
    [[0], [1], [2.5], [0.5], [1.25]]
    """
    first, second = (np.asarray(pairs[name], dtype=int) - 1 for name in ("id1", "id2"))
    i, j = np.minimum(first, second), np.maximum(first, second)
    branch, force = np.asarray(pairs["branch"]), np.asarray(pairs["force"])
    pair = i * len(radii) + j
    order = np.lexsort((branch, pair))
    i, j, branch, force = i[order], j[order], branch[order], force[order]
    # LAMMPS tells where the first grain is, seen from the second. Added to 0, -0 is 0.
    towards = np.where(first < second, -1.0, 1.0)[order]
    vector = [towards * np.asarray(pairs[f"branch_{axis}"])[order] + 0.0 for axis in "xyz"]
    # In a small periodic cell two grains may touch through two faces: the vector tells which.
    again = np.diff(pair[order]) == 0
    if again.any():
        same = np.append(again, False) | np.append(False, again)
        rows = np.column_stack([column[same] for column in (i, j, *vector)])
        if len(np.unique(rows, axis=0)) < len(rows):
            raise SimulationError("LAMMPS lists a contact twice")
    return {
        "i": i,
        "j": j,
        "radius_i_m": radii[i],
        "radius_j_m": radii[j],
        "branch_length_m": branch,
        **{f"branch_{axis}": column for axis, column in zip("xyz", vector, strict=True)},
        "overlap_m": radii[i] + radii[j] - branch,
        "normal_force_N": force,
        "energy_J": law.energy(force, reduced_radius(radii[i], radii[j])),
    }


def wall_contacts(particles: Columns, edge: float) -> dict[str, NDArray]:
    r"""Return the grain-wall contacts of a state.

    .. math:: \delta = R - (L/2 - \mathbf{n} \cdot \mathbf{x})

    Parameters
    ----------
    particles : mapping of columns
        A frame of the particle dump, sorted by id: x, y, z, radius [m], v_wall_fx, -fy, -fz [N].
    edge : float
        L of the cell, which lies about the origin [m].

    Returns
    -------
    dict of ndarray, shape (W,)
        i (from 0), wall ("-x" ... "+z"); direction_x, direction_y and direction_z, of unit length
        from the grain to the wall, n [-]; overlap_m, normal_force_N.

    Examples
    --------
    >>> grain = {"x": -1.5, "y": 0.0, "z": 0.0, "radius": 1.0,
    ...          "v_wall_fx": 3.0, "v_wall_fy": 0.0, "v_wall_fz": 0.0}
    >>> walls = wall_contacts({name: np.array([value]) for name, value in grain.items()}, 4.0)
    >>> [walls[name].tolist() for name in ("wall", "direction_x", "overlap_m", "normal_force_N")]
    [['-x'], [-1.0], [0.5], [3.0]]
    """
    directions = [f"direction_{axis}" for axis in "xyz"]
    names = ("i", "wall", *directions, "overlap_m", "normal_force_N")
    columns: dict[str, list] = {name: [] for name in names}
    radius = np.asarray(particles["radius"])
    for axis in "xyz":
        force = np.asarray(particles[f"v_wall_f{axis}"])
        place = np.asarray(particles[axis])
        touching = np.flatnonzero(force)
        # A wall pushes inwards: towards +x at -x.
        side = np.where(force[touching] > 0, -1, 1)
        columns["i"].append(touching)
        columns["wall"].append(np.where(side < 0, f"-{axis}", f"+{axis}"))
        for name in directions:
            columns[name].append(np.where(name.endswith(axis), side, 0).astype(float))
        columns["overlap_m"].append(radius[touching] - (edge / 2.0 - side * place[touching]))
        columns["normal_force_N"].append(np.abs(force[touching]))
    return {name: np.concatenate(parts) for name, parts in columns.items()}


def law_error(
    contacts: Columns, walls: Columns, radii: NDArray, law: LinearContact | HertzContact
) -> float:
    r"""Return how far the forces are from those of the contact law at the overlaps of the state.

    .. math:: \frac{\max |F - F(\delta, R^*)|}{\max(F_0, \max F)}

    Parameters
    ----------
    contacts, walls : mapping of columns
        From `state_contacts` and `wall_contacts`.
    radii : ndarray, shape (N,)
        By id [m].
    law : LinearContact or HertzContact

    Returns
    -------
    float
        The largest difference over the largest force, or over `force_floor` where that is
        larger [-].

    Examples
    --------
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> contacts = {name: np.zeros(0) for name in
    ...             ("radius_i_m", "radius_j_m", "overlap_m", "normal_force_N")}
    >>> walls = {"i": np.array([0]), "overlap_m": np.array([0.5]),
    ...          "normal_force_N": np.array([4.0])}
    >>> law_error(contacts, walls, np.array([1.0]), LinearContact(10.0))
    0.25
    """
    reduced = reduced_radius(contacts["radius_i_m"], contacts["radius_j_m"])
    differences = np.concatenate(
        [
            contacts["normal_force_N"] - law.force(contacts["overlap_m"], reduced),
            walls["normal_force_N"] - law.force(walls["overlap_m"], radii[walls["i"]]),
        ]
    )
    forces = np.concatenate([contacts["normal_force_N"], walls["normal_force_N"]])
    scale = max(force_floor(radii, law), forces.max(initial=0.0))
    return float(np.abs(differences).max(initial=0.0) / scale)
