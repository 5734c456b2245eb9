"""The loading path: what each saved state of a compression tells, and whether it may be trusted."""

import numpy as np

from branchcrush.contact_law import linear_energy, linear_force
from branchcrush.contacts import (
    coordination_number,
    mean_stress,
    mechanical_coordination_number,
    rattlers,
    unbalanced_force_ratio,
)
from branchcrush.errors import SimulationError

# The mean contact force, over stiffness times mean radius, below which a packing carries no load.
NO_LOAD = 1e-4
STRESS_TOLERANCE = 1e-6
FORCE_TOLERANCE = 1e-9


def force_floor(radii, normal_stiffness):
    r"""Return the mean contact force below which a packing carries no load.

    .. math:: F_0 = 10^{-4} k \langle R \rangle

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    normal_stiffness : float
        [N/m]

    Returns
    -------
    float
        [N]

    Examples
    --------
    >>> force_floor([1e-3], 1e6)
    0.1
    """
    return float(NO_LOAD * normal_stiffness * np.mean(radii))


def state_contacts(pairs, radii, normal_stiffness):
    """Return the grain-grain contacts of a state, each once, sorted by grain.

    Parameters
    ----------
    pairs : DataFrame
        A frame of the pair dump: id1, id2, branch and branch_x, -y, -z [m], force [N].
    radii : ndarray, shape (N,)
        By id [m].
    normal_stiffness : float
        [N/m]

    Returns
    -------
    dict of ndarray, shape (M,)
        i, j (from 0, i < j), radius_i_m, radius_j_m, branch_length_m, overlap_m,
        normal_force_N, energy_J.

    Raises
    ------
    SimulationError
        When a contact is listed twice.
    """
    first, second = (pairs[name].to_numpy().astype(int) - 1 for name in ("id1", "id2"))
    i, j = np.minimum(first, second), np.maximum(first, second)
    # In a small periodic cell two grains may touch through two faces: the vector tells which.
    towards = np.where(first < second, 1.0, -1.0)[:, None]
    vector = towards * pairs[["branch_x", "branch_y", "branch_z"]].to_numpy()
    if len(np.unique(np.column_stack([i, j, vector]), axis=0)) < len(i):
        raise SimulationError("LAMMPS lists a contact twice")
    branch, force = pairs["branch"].to_numpy(), pairs["force"].to_numpy()
    order = np.lexsort((branch, j, i))
    i, j, branch, force = i[order], j[order], branch[order], force[order]
    return {
        "i": i,
        "j": j,
        "radius_i_m": radii[i],
        "radius_j_m": radii[j],
        "branch_length_m": branch,
        "overlap_m": radii[i] + radii[j] - branch,
        "normal_force_N": force,
        "energy_J": linear_energy(force, normal_stiffness),
    }


def wall_contacts(particles, edge):
    """Return the grain-wall contacts of a state.

    Parameters
    ----------
    particles : DataFrame
        A frame of the particle dump, sorted by id: x, y, z, radius [m], v_wall_fx, -fy, -fz [N].
    edge : float
        Edge of the cell [m].

    Returns
    -------
    dict of ndarray, shape (W,)
        i (from 0), wall ("-x" ... "+z"), overlap_m, normal_force_N.
    """
    found = {"i": [], "wall": [], "overlap_m": [], "normal_force_N": []}
    radius = particles["radius"].to_numpy()
    for axis in "xyz":
        force = particles[f"v_wall_f{axis}"].to_numpy()
        place = particles[axis].to_numpy()
        touching = np.flatnonzero(force)
        # A wall pushes inwards: towards +x at -x.
        side = np.where(force[touching] > 0, -1, 1)
        found["i"].append(touching)
        found["wall"].append(np.where(side < 0, f"-{axis}", f"+{axis}"))
        found["overlap_m"].append(radius[touching] - (edge / 2.0 - side * place[touching]))
        found["normal_force_N"].append(np.abs(force[touching]))
    return {name: np.concatenate(parts) for name, parts in found.items()}


def path_row(scalars, particles, contacts, walls, *, first_edge, normal_stiffness, periodic):
    """Return the row of `path.csv` of a state.

    Parameters
    ----------
    scalars : mapping
        The state's line of `states.csv` as in.compress writes it.
    particles : DataFrame
        Its frame of the particle dump, sorted by id.
    contacts, walls : dict
        From `state_contacts` and `wall_contacts`.
    first_edge : float
        Edge of the cell before loading [m].
    normal_stiffness : float
        [N/m]
    periodic : bool

    Returns
    -------
    dict
        Names carry their units; strains and stress are positive in compression.
    """
    edge = float(scalars["edge"])
    volume = edge**3
    radius = particles["radius"].to_numpy()
    grains = radius.size
    solid_volume = 4.0 / 3.0 * np.pi * np.sum(radius**3)
    floor = force_floor(radius, normal_stiffness)
    force = contacts["normal_force_N"]
    at_wall = np.bincount(walls["i"], minlength=grains)
    wall_distance = radius[walls["i"]] - walls["overlap_m"]
    i, j = contacts["i"], contacts["j"]
    stress = mean_stress(
        contacts["branch_length_m"], force, volume, wall_distance, walls["normal_force_N"]
    )
    on_walls = walls["normal_force_N"].sum() / (6.0 * edge**2)
    energy = (
        contacts["energy_J"].sum() + linear_energy(walls["normal_force_N"], normal_stiffness).sum()
    )
    mean_force = float(force.mean()) if force.size else 0.0
    # sqrt(rho_s/P) times the residual speed; without stress the number has no meaning.
    twice_kinetic = 2.0 * float(scalars["kinetic_energy"])
    inertial = np.sqrt(twice_kinetic / (solid_volume * stress)) if mean_force > floor else np.nan
    overlap_ratio = contacts["overlap_m"] / np.minimum(
        contacts["radius_i_m"], contacts["radius_j_m"]
    )
    return {
        "state": int(scalars["state"]),
        "linear_strain": 1.0 - edge / first_edge,
        "volumetric_strain": 1.0 - volume / first_edge**3,
        "solid_fraction": solid_volume / volume,
        "void_ratio": volume / solid_volume - 1.0,
        "volume_m3": volume,
        "mean_stress_Pa": stress,
        "boundary_stress_Pa": float(scalars["pair_pressure"]) if periodic else on_walls,
        "elastic_energy_J": energy,
        "work_J": float(scalars["work"]),
        "dissipated_J": float(scalars["work"]) - energy,
        "coordination_number": coordination_number(force.size, grains),
        "mechanical_coordination_number": mechanical_coordination_number(i, j, grains, at_wall),
        "rattler_fraction": float(rattlers(i, j, grains, at_wall).mean()),
        "mean_normal_force_N": mean_force,
        "carries_load": mean_force > floor,
        "unbalanced_force_ratio": unbalanced_force_ratio(
            particles[["fx", "fy", "fz"]].to_numpy(), force, floor
        ),
        "inertial_number": inertial,
        "max_overlap_ratio": float(overlap_ratio.max()) if overlap_ratio.size else 0.0,
        "escaped": int(scalars["escaped"]),
        "force_evaluations": int(scalars["evaluations"]),
    }


def check_state(row, contacts, walls, radii, *, normal_stiffness, tolerance):
    """Raise unless the identities of a packing at rest hold in a state.

    Parameters
    ----------
    row : dict
        From `path_row`.
    contacts, walls : dict
        From `state_contacts` and `wall_contacts`.
    radii : ndarray, shape (N,)
        [m]
    normal_stiffness : float
        [N/m]
    tolerance : float
        Largest unbalanced force ratio.

    Raises
    ------
    SimulationError
        Naming every identity that fails, with both numbers.
    """
    floor = force_floor(radii, normal_stiffness)
    stress, boundary = row["mean_stress_Pa"], row["boundary_stress_Pa"]
    stress_floor = floor / (np.pi * np.mean(radii) ** 2)
    work, energy = row["work_J"], row["elastic_energy_J"]
    # What a packing that carries no load may hold: rounding is not energy from nowhere.
    no_energy = 1e-9 * linear_energy(floor, normal_stiffness) * len(radii)
    checks = {
        f"unbalanced force ratio {row['unbalanced_force_ratio']:.2e} is above {tolerance:.0e}": (
            row["unbalanced_force_ratio"] <= tolerance
        ),
        f"stress of the branches {stress:.9g} Pa is not that of the boundary {boundary:.9g} Pa": (
            abs(stress - boundary) <= STRESS_TOLERANCE * max(abs(boundary), stress_floor)
        ),
        f"elastic energy {energy:.9g} J is more than the work {work:.9g} J": (
            energy <= work * (1.0 + 1e-9) + no_energy
        ),
        f"{row['escaped']} grain(s) are outside the cell": row["escaped"] == 0,
        "force of a contact is not stiffness times overlap": _linear(
            contacts, floor, normal_stiffness
        )
        and _linear(walls, floor, normal_stiffness),
    }
    failed = [message for message, holds in checks.items() if not holds]
    if failed:
        raise SimulationError(
            f"state {row['state']} at solid fraction {row['solid_fraction']:.4f} fails its checks: "
            + "; ".join(failed)
        )


def _linear(contacts, floor, normal_stiffness):
    difference = contacts["normal_force_N"] - linear_force(contacts["overlap_m"], normal_stiffness)
    scale = max(floor, np.max(contacts["normal_force_N"], initial=0.0))
    return bool(np.all(np.abs(difference) <= FORCE_TOLERANCE * scale))
