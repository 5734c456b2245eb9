"""The loading path: what each saved state of a compression tells."""

import numpy as np

from branchcrush.errors import SimulationError
from branchcrush.packings.contact_laws import reduced_radius
from branchcrush.packings.contacts import (
    coordination_number,
    mean_stress,
    mechanical_coordination_number,
    rattlers,
    unbalanced_force_ratio,
)
from branchcrush.packings.geometry import cube, solid_volume

# The overlap of two mean grains, over their radius, whose force is the mean one below which a
# packing carries no load.
NO_LOAD = 1e-4


def force_floor(radii, law):
    r"""Return the mean contact force below which a packing carries no load.

    .. math:: F_0 = F(10^{-4} \langle R \rangle,\ \langle R \rangle / 2)

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    law : contact_law.LinearContact or HertzContact

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
    mean = float(np.mean(radii))
    return float(law.force(NO_LOAD * mean, mean / 2.0))


def stress_floor(radii, law):
    r"""Return the mean stress that stands for no load, F_0 / (pi <R>^2) [Pa]."""
    return force_floor(radii, law) / (np.pi * float(np.mean(radii)) ** 2)


def state_contacts(pairs, radii, law):
    """Return the grain-grain contacts of a state, each once, sorted by grain.

    Parameters
    ----------
    pairs : mapping of columns
        A frame of the pair dump: id1, id2, branch and branch_x, -y, -z [m], force [N].
    radii : ndarray, shape (N,)
        By id [m].
    law : contact_law.LinearContact or HertzContact

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


def wall_contacts(particles, edge):
    """Return the grain-wall contacts of a state.

    Parameters
    ----------
    particles : mapping of columns
        A frame of the particle dump, sorted by id: x, y, z, radius [m], v_wall_fx, -fy, -fz [N].
    edge : float
        Edge of the cell [m].

    Returns
    -------
    dict of ndarray, shape (W,)
        i (from 0), wall ("-x" ... "+z"); direction_x, direction_y and direction_z, of unit length
        from the grain to the wall [-]; overlap_m, normal_force_N.
    """
    names = (
        "i",
        "wall",
        "direction_x",
        "direction_y",
        "direction_z",
        "overlap_m",
        "normal_force_N",
    )
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
        for other in "xyz":
            columns[f"direction_{other}"].append(np.where(other == axis, side, 0).astype(float))
        columns["overlap_m"].append(radius[touching] - (edge / 2.0 - side * place[touching]))
        columns["normal_force_N"].append(np.abs(force[touching]))
    return {name: np.concatenate(parts) for name, parts in columns.items()}


def path_row(scalars, particles, contacts, walls, *, first_edge, law, periodic):
    """Return the row of `path.csv` of a state.

    Parameters
    ----------
    scalars : mapping
        The state's line of `states.csv` as in.compress writes it.
    particles : mapping of columns
        Its frame of the particle dump, sorted by id.
    contacts, walls : dict
        From `state_contacts` and `wall_contacts`.
    first_edge : float
        Edge of the cell before loading [m].
    law : contact_law.LinearContact or HertzContact
    periodic : bool

    Returns
    -------
    dict
        Names carry their units; strains and stress are positive in compression.
    """
    edge, work = float(scalars["edge"]), float(scalars["work"])
    volume = cube(edge)
    radius = np.asarray(particles["radius"])
    grains = radius.size
    solid = solid_volume(radius)
    floor = force_floor(radius, law)
    force = contacts["normal_force_N"]
    at_wall = np.bincount(walls["i"], minlength=grains)
    wall_distance = radius[walls["i"]] - walls["overlap_m"]
    i, j = contacts["i"], contacts["j"]
    loose = rattlers(i, j, grains, at_wall)
    stress = mean_stress(
        contacts["branch_length_m"], force, volume, wall_distance, walls["normal_force_N"]
    )
    on_walls = walls["normal_force_N"].sum() / (6.0 * edge**2)
    # At a plane wall the reduced radius is the grain's own.
    at_walls = law.energy(walls["normal_force_N"], radius[walls["i"]]).sum()
    energy = contacts["energy_J"].sum() + at_walls
    mean_force = float(force.mean()) if force.size else 0.0
    # sqrt(rho_s/P) times the residual speed; without stress the number has no meaning.
    twice_kinetic = 2.0 * float(scalars["kinetic_energy"])
    inertial = np.sqrt(twice_kinetic / (solid * stress)) if mean_force > floor else np.nan
    smaller = np.minimum(contacts["radius_i_m"], contacts["radius_j_m"])
    overlap_ratio = contacts["overlap_m"] / smaller
    median, most = np.quantile(overlap_ratio, (0.5, 0.95)) if force.size else (0.0, 0.0)
    return {
        "state": int(scalars["state"]),
        "linear_strain": 1.0 - edge / first_edge,
        "volumetric_strain": 1.0 - volume / cube(first_edge),
        "solid_fraction": solid / volume,
        "void_ratio": volume / solid - 1.0,
        "volume_m3": volume,
        "mean_stress_Pa": stress,
        "boundary_stress_Pa": float(scalars["pair_pressure"]) if periodic else on_walls,
        "elastic_energy_J": energy,
        "work_J": work,
        "dissipated_J": work - energy,
        "coordination_number": coordination_number(force.size, grains),
        "mechanical_coordination_number": mechanical_coordination_number(i, j, loose, at_wall),
        "rattler_fraction": float(loose.mean()),
        "mean_normal_force_N": mean_force,
        "carries_load": mean_force > floor,
        "unbalanced_force_ratio": unbalanced_force_ratio(
            np.column_stack([particles[f"f{axis}"] for axis in "xyz"]), force, floor
        ),
        "inertial_number": inertial,
        "median_overlap_ratio": float(median),
        "overlap_ratio_95": float(most),
        "max_overlap_ratio": float(overlap_ratio.max(initial=0.0)),
        "contact_law_error": law_error(contacts, walls, radius, law),
        "escaped": int(scalars["escaped"]),
        "lost": int(scalars["lost"]),
        "force_evaluations": int(scalars["evaluations"]),
    }


def law_error(contacts, walls, radii, law):
    """Return how far the forces are from those of the contact law at the overlaps found.

    Parameters
    ----------
    contacts, walls : dict
        From `state_contacts` and `wall_contacts`.
    radii : ndarray, shape (N,)
        [m]
    law : contact_law.LinearContact or HertzContact

    Returns
    -------
    float
        The largest difference over the largest force, or over the floor where that is smaller [-].
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
