"""What a packing is, from nothing but its geometry: one judge for every code that compresses one.

Each code hands over positions; the forces follow from the contact law F = k x overlap, so that no
code is believed about its own state.
"""

import numpy as np
from scipy.spatial import cKDTree

from branchcrush.loading.states import force_floor
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.packings.contacts import (
    coordination_number,
    mean_stress,
    mechanical_coordination_number,
    rattlers,
    unbalanced_force_ratio,
)


def state_of(positions, radii, edge, periodic, stiffness):
    """Return the state of a packing of frictionless spheres with linear contacts in a cube.

    Parameters
    ----------
    positions : array_like, shape (N, 3)
        Centres about the centre of the cube [m].
    radii : array_like, shape (N,)
        [m]
    edge : float
        Of the cube [m].
    periodic : bool
        Whether the faces are joined; if not they are rigid walls.
    stiffness : float
        k of every contact [N/m].

    Returns
    -------
    dict
        Names carry their units and mean the same as in `path.csv`; `contacts` are those between
        grains, `wall_contacts` the others, and `outside` counts centres beyond a wall.

    Examples
    --------
    Two spheres of 1 m pressed together by walls; all overlaps are 0.1 m.

    >>> state = state_of([[-0.95, 0.0, 0.0], [0.95, 0.0, 0.0]], [1.0, 1.0], 3.7, False, 10.0)
    >>> state["contacts"], state["wall_contacts"], round(state["elastic_energy_J"], 12)
    (1, 2, 0.15)
    >>> state["unbalanced_force_ratio"] < 1e-12
    True
    """
    positions, radii = np.asarray(positions, dtype=float), np.asarray(radii, dtype=float)
    grains, volume, law = radii.size, float(edge) ** 3, LinearContact(stiffness)
    i, j = near_pairs(positions, radii, edge if periodic else None)
    vector = positions[j] - positions[i]
    if periodic:
        vector -= edge * np.round(vector / edge)
    branch = np.linalg.norm(vector, axis=1)
    touching = branch < radii[i] + radii[j]
    i, j, vector, branch = i[touching], j[touching], vector[touching], branch[touching]
    overlap = radii[i] + radii[j] - branch
    force = stiffness * overlap

    net = np.zeros((grains, 3))
    pushes = vector * (force / branch)[:, None]
    np.subtract.at(net, i, pushes)
    np.add.at(net, j, pushes)

    at_wall = np.zeros(grains, dtype=int)
    wall_distance, wall_force = [], []
    if not periodic:
        for side in (-1.0, 1.0):
            distance = edge / 2.0 - side * positions
            push = stiffness * np.maximum(radii[:, None] - distance, 0.0)
            net -= side * push
            at_wall += np.count_nonzero(push, axis=1)
            wall_distance.append(distance[push > 0.0])
            wall_force.append(push[push > 0.0])
        wall_distance, wall_force = np.concatenate(wall_distance), np.concatenate(wall_force)

    ratio = overlap / np.minimum(radii[i], radii[j])
    loose = rattlers(i, j, grains, at_wall)
    return {
        "solid_fraction": float(4.0 / 3.0 * np.pi * np.sum(radii**3) / volume),
        "mean_stress_Pa": mean_stress(branch, force, volume, wall_distance, wall_force),
        "coordination_number": coordination_number(force.size, grains),
        "mechanical_coordination_number": mechanical_coordination_number(i, j, loose, at_wall),
        "rattler_fraction": float(loose.mean()),
        "elastic_energy_J": float(
            (np.dot(force, force) + np.dot(wall_force, wall_force)) / (2.0 * stiffness)
        ),
        "unbalanced_force_ratio": unbalanced_force_ratio(net, force, force_floor(radii, law)),
        "median_overlap_ratio": float(np.median(ratio)) if ratio.size else 0.0,
        "contacts": int(force.size),
        "wall_contacts": int(at_wall.sum()),
        "outside": 0 if periodic else int((np.abs(positions) > edge / 2.0).any(axis=1).sum()),
    }


def near_pairs(positions, radii, period=None):
    """Return pairs of grains, each once, with all that touch among them.

    The grains are sorted into classes of size, each a factor of two wide, with a tree for each
    class. So a fine grain is never looked for at the distance of two large ones, and it does not
    matter how much the sizes differ.

    Parameters
    ----------
    positions : ndarray, shape (N, 3)
        [m]
    radii : ndarray, shape (N,)
        [m]
    period : float, optional
        Edge of a periodic cube [m].

    Returns
    -------
    i, j : ndarray of int, shape (M,)

    Raises
    ------
    ValueError
        When the two largest grains could touch through two faces of a periodic cube.

    Examples
    --------
    >>> place = np.array([[-1.4, 0.0, 0.0], [1.4, 0.0, 0.0]])
    >>> [pair.tolist() for pair in near_pairs(place, np.array([0.1, 0.2]), 3.0)]
    [[0], [1]]
    """
    if period is not None:
        if 4.0 * radii.max() >= period:
            raise ValueError("grains too large for this periodic cube: two may touch twice")
        positions = np.mod(positions, period)
        # Rounding can put a centre just below 0 on the period itself, which the tree refuses.
        positions[positions >= period] = 0.0
    size_class = np.floor(np.log2(radii / radii.min())).astype(int)
    members = [np.flatnonzero(size_class == c) for c in np.unique(size_class)]
    trees = [cKDTree(positions[m], boxsize=period) for m in members]
    first, second = [], []
    for a, finer in enumerate(members):
        largest = radii[finer].max()
        for coarser in members[a:]:
            found = trees[a].query_ball_point(positions[coarser], radii[coarser] + largest)
            first.append(finer[np.concatenate(found).astype(int)])
            second.append(np.repeat(coarser, [len(f) for f in found]))
    i, j = np.concatenate(first), np.concatenate(second)
    # Within a class each pair was found from both sides, and each grain found itself.
    once = (size_class[i] != size_class[j]) | (i < j)
    return i[once], j[once]
