"""Contacts of a file held against its grains: each once, with its branch vector and normal force.

What does not fit is a problem with a name; what is left out is counted.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from branchcrush.errors import ReadingError
from branchcrush.readers.cells import Cell
from branchcrush.readers.forces import attraction, normal_forces, wall_forces
from branchcrush.readers.pairs import each_once
from branchcrush.readers.places import grains_at, overlapping_pairs
from branchcrush.readers.roles import Grains, some

# Of the smaller radius: grains that push and are further apart, or deeper in each other, are not
# those that the file means.
_APART, _DEEP = 0.05, 0.5
# Of the radius of the smallest grain: a place further from every centre is none of a grain.
_AT_CENTRE = 0.02
# Of the median overlap: pairs that overlap by less may have met in the last step.
_JUST_MET = 0.2
# A force below this share of the largest is none.
_NO_FORCE = 1e-12


@dataclass(frozen=True, eq=False)
class Touching:
    """The contacts of one moment, each once, with i < j, in the order of the grains."""

    i: NDArray  # the two grains, from 0 in the order of their ids, shape (M,)
    j: NDArray
    vector: NDArray  # branch vector from i to j, shape (M, 3) [m]
    overlap: NDArray  # [m]
    normal_force: NDArray  # repulsion positive [N]
    net_force: NDArray  # on each grain, shape (N, 3) [N]
    wall_grain: NDArray  # the grain of each contact with a wall, shape (W,)
    wall_id: NDArray
    wall_direction: NDArray  # of unit length from the grain to the wall, shape (W, 3) [-]
    wall_overlap: NDArray  # [m]
    wall_force: NDArray  # normal, repulsion positive [N]
    counts: dict[str, int] = field(default_factory=dict)  # what was left out, by why
    overlap_error: float = 0.0  # of an overlap, from the digits of the file [m]
    tangential_share: float = 0.0  # tangential forces over normal ones, their sums [-]


@dataclass(frozen=True)
class Matching:
    """How a file lists its contacts."""

    each_pair: str = "once"  # or twice
    wall_ids: tuple[int, ...] = ()
    negative_walls: bool = False  # whether a negative second id is a wall
    length: float = 1.0  # unit of the file's lengths [m]
    force: float = 1.0  # unit of its forces [N]


def matched(
    grains: Grains,
    columns: Mapping[str, NDArray],
    cell: Cell,
    how: Matching,
    where: str,
    digits: int,
) -> Touching:
    r"""Return the contacts of one moment, each held against the grains that it joins.

    .. math:: F = \mathbf{F} \cdot \mathbf{l} / l, \qquad \delta = R_i + R_j - l

    Parameters
    ----------
    grains : Grains
    columns : mapping of ndarray
        From `roles.in_roles`: id1 and id2, or start and end; force or normal_force; of overlap (or
        gap), branch, point and real what there is.
    cell : Cell
    how : Matching
    where : str
        The file and its frame, for errors.
    digits : int
        Significant ones of the positions.

    Returns
    -------
    Touching

    Raises
    ------
    ReadingError
        With a line for each problem: ids without a grain, pairs listed twice or not twice, forces
        between grains that do not touch, pairs that overlap without a contact, attraction.

    Examples
    --------
    >>> cell = Cell.between([0, 0, 0], [10, 10, 10], (True, True, True))
    >>> grains = Grains(np.array([3, 8]), np.array([[9.5, 5, 5], [1.4, 5, 5]]), np.ones(2))
    >>> columns = {"id1": np.array([8]), "id2": np.array([3]), "normal_force": np.array([2.0])}
    >>> touching = matched(grains, columns, cell, Matching(), "x.csv", 17)
    >>> touching.vector.round(9).tolist(), touching.overlap.round(9).tolist()
    ([[1.9, 0.0, 0.0]], [0.1])
    """
    columns, counts = _carrying(columns, how)
    problems: list[str] = []
    error = position_error(grains, digits)
    first, second, at_wall = _ends(grains, columns, cell, how, problems)
    if problems:
        raise _refused(where, problems)
    pairs = {name: each[~at_wall] for name, each in columns.items()}
    i, j = first[~at_wall], second[~at_wall]
    vector = _branches(grains, pairs, cell, i, j, error)
    length = np.linalg.norm(vector, axis=1)
    if np.any(length == 0.0):
        one = int(np.argmin(length))
        first, second = grains.ids[i[one]], grains.ids[j[one]]
        same = f"grains {first} and {second} have their centres at one place, and a contact"
        raise _refused(
            where, [f"{same}: is an id given twice, or a contact of a grain with itself?"]
        )
    touch = grains.radii[i] + grains.radii[j] - length
    overlap = pairs.get("overlap", touch)
    smaller = np.minimum(grains.radii[i], grains.radii[j])
    problems += _misplaced(grains, i, j, touch, overlap, smaller, error)
    force, normal, share = normal_forces(pairs, vector, length)
    problems += attraction(grains, i, j, normal)
    if problems:
        raise _refused(where, problems)
    kept, swapped, found = each_once(grains, i, j, vector, normal, how.each_pair, smaller)
    problems += found
    i, j, vector = np.where(swapped, j, i), np.where(swapped, i, j), vector.copy()
    vector[swapped] *= -1.0
    vector += 0.0  # -0 becomes 0
    force = np.where(swapped[:, None], -force, force)
    order = kept[np.lexsort((length[kept], j[kept], i[kept]))]
    i, j, vector, overlap, normal, force = (
        each[order] for each in (i, j, vector, overlap, normal, force)
    )
    lacking, lines = _unlisted(grains, cell, i, j, overlap, error)
    problems += lines
    if problems:
        raise _refused(where, problems)
    if lacking:
        counts["pairs that just overlap and have no contact"] = lacking
    walls = wall_forces(
        grains, {name: each[at_wall] for name, each in columns.items()}, first[at_wall]
    )
    ids = columns["id2"][at_wall].astype(int) if "id2" in columns else np.zeros(0, int)
    net = np.zeros((grains.ids.size, 3))
    np.add.at(net, i, -force)
    np.add.at(net, j, force)
    np.add.at(net, first[at_wall], -walls[0] * walls[2][:, None])
    return Touching(
        i, j, vector, overlap, normal, net, first[at_wall], ids, *walls, counts, error, share
    )


def position_error(grains: Grains, digits: int) -> float:
    r"""Return how far an overlap may be off that is made of positions of few digits.

    .. math:: \epsilon = x_{max}\, 10^{1 - d}

    Parameters
    ----------
    grains : Grains
    digits : int
        d, significant ones.

    Returns
    -------
    float
        [m]

    Examples
    --------
    >>> grains = Grains(np.array([1]), np.array([[0.0, 0.0, 5.0]]), np.array([1.0]))
    >>> position_error(grains, 6)
    5e-05
    """
    return float(np.abs(grains.positions).max()) * 10.0 ** (1 - digits)


def _refused(where, problems):
    return ReadingError("\n".join(f"{where}: {problem}" for problem in problems))


def _carrying(columns, how):
    """Return the contacts that carry a force, in SI, and how many do not."""
    counts = {}
    keep = np.ones(len(next(iter(columns.values()))), dtype=bool)
    if "real" in columns:
        keep &= columns["real"] != 0
        counts["virtual contacts"] = int((~keep).sum())
    size = (
        np.abs(columns["normal_force"])
        if "normal_force" in columns
        else np.linalg.norm(columns["force"], axis=1)
    )
    idle = keep & ~(size > _NO_FORCE * size.max(initial=0.0))
    counts["contacts without force"] = int(idle.sum())
    keep &= ~idle
    lengths = ("start", "end", "branch", "overlap", "gap", "point")
    units = dict.fromkeys(lengths, how.length) | dict.fromkeys(("force", "normal_force"), how.force)
    scaled = {name: each[keep] * units.get(name, 1.0) for name, each in columns.items()}
    if "gap" in scaled:
        scaled["overlap"] = -scaled.pop("gap")
    return scaled, {why: number for why, number in counts.items() if number}


def _ends(grains, columns, cell, how, problems):
    """Return the two grains of each contact, by id or by place, and which contacts have a wall."""
    if "id1" not in columns:
        return (*_by_place(grains, columns, cell, problems), np.zeros(len(columns["start"]), bool))
    ids = [columns[name] for name in ("id1", "id2")]
    walls = [np.isin(each, how.wall_ids) | (how.negative_walls & (each < 0)) for each in ids]
    turned = walls[0] & ~walls[1]
    if turned.any():  # the wall stands first
        ids = [np.where(turned, ids[1], ids[0]), np.where(turned, ids[0], ids[1])]
        columns["id1"], columns["id2"] = ids
        if "force" in columns:
            columns["force"] = np.where(turned[:, None], -1.0, 1.0) * columns["force"]
    at_wall = walls[0] | walls[1]
    rows = [np.searchsorted(grains.ids, each) for each in ids]
    rows = [np.clip(each, 0, grains.ids.size - 1) for each in rows]
    unknown = [grains.ids[row] != each for row, each in zip(rows, ids, strict=True)]
    unknown[1] &= ~at_wall
    lost = np.unique(np.concatenate([each[bad] for each, bad in zip(ids, unknown, strict=True)]))
    if lost.size:
        with_lost = int((unknown[0] | unknown[1]).sum())
        problems.append(
            f"{with_lost} contacts join grains that are not in the file of grains, ids "
            f"{some(lost)} (there are {grains.ids.size} grains, ids {grains.ids[0]} to "
            f"{grains.ids[-1]}): write all grains at the same moment, or name walls in "
            "packing.wall_ids"
        )
    return rows[0], rows[1], at_wall


def _by_place(grains, columns, cell, problems):
    """Return the grains whose centres are the two ends of each contact."""
    found = []
    for name in ("start", "end"):
        rows, distance = grains_at(columns[name], grains.positions, cell)
        far = distance > _AT_CENTRE * grains.radii.min()
        if far.any():
            problems.append(
                f"{int(far.sum())} of {far.size} contacts have an end ({name}) that is no centre "
                f"of a grain, the furthest by {distance.max():.3g} m: are both of the same moment, "
                "and is packing.boundary right?"
            )
        found.append(rows)
    return found


def _branches(grains, columns, cell, i, j, error):
    """Return the branch vector from i to j of each contact, through the face where it touches."""
    apart = grains.positions[j] - grains.positions[i]
    nearest = cell.nearest(apart)
    told = columns.get("branch")
    if told is None and "start" in columns:
        told = columns["end"] - columns["start"]
    if told is None:
        return nearest
    # From i to j, or from j to i: whichever leads there.
    misses = [np.linalg.norm(cell.nearest(sign * told - apart), axis=1) for sign in (1.0, -1.0)]
    one = int(misses[0].sum() > misses[1].sum())
    told, miss = (told, -told)[one], misses[one]
    reach = grains.radii[i] + grains.radii[j]
    # In a small cell two grains may touch through two faces; the vector tells which.
    fits = (np.linalg.norm(told, axis=1) < (1.0 + _APART) * reach) & (miss < _APART * reach)
    return np.where(fits[:, None], told, nearest)


def _misplaced(grains, i, j, touch, overlap, smaller, error):
    """Return which grains push without touching, or are deep in each other."""
    problems = []
    for bad, what, check in (
        (touch < -_APART * smaller - 3.0 * error, "push each other and do not touch", "apart by"),
        (touch > _DEEP * smaller + 3.0 * error, "are deep in each other", "overlap"),
    ):
        if bad.any():
            worst = int(np.argmax(np.where(bad, np.abs(touch), -1.0)))
            problems.append(
                f"{int(bad.sum())} of {bad.size} pairs of grains {what}, such as "
                f"{grains.ids[i[worst]]} and {grains.ids[j[worst]]} ({check} "
                f"{abs(touch[worst]):.3g} m): are grains and contacts of the same moment, the ids "
                "the same in both, sizes radii (not diameters), and cell and boundary right?"
            )
    differ = np.abs(overlap - touch) > _APART * smaller + 3.0 * error
    if differ.any() and not problems:
        worst = int(np.argmax(np.abs(overlap - touch)))
        problems.append(
            f"the overlaps of {int(differ.sum())} contacts differ from those of the positions, "
            f"such as {overlap[worst]:.3g} m and {touch[worst]:.3g} m of grains "
            f"{grains.ids[i[worst]]} and {grains.ids[j[worst]]}: is a gap named as an overlap?"
        )
    return problems


def _unlisted(grains, cell, i, j, overlap, error):
    """Return how many pairs just overlap and have no contact, and the problem if some clearly do.

    Grains that have met in the last step overlap by little, and may not push yet.
    """
    a, b, depth = overlapping_pairs(grains.positions, grains.radii, cell)
    listed = np.isin(a * grains.ids.size + b, i * grains.ids.size + j)
    lacking = ~listed & (depth > 3.0 * error)
    just = _JUST_MET * max(float(np.median(overlap)), 0.0) if overlap.size else 0.0
    clear = np.flatnonzero(lacking & (depth > 3.0 * error + just))
    if not clear.size:
        return int(lacking.sum()), []
    worst = clear[np.argmax(depth[clear])]
    return 0, [
        f"{clear.size} pairs of grains overlap and have no contact ({i.size} have one), such as "
        f"{grains.ids[a[worst]]} and {grains.ids[b[worst]]} by {depth[worst]:.3g} m: are contacts "
        "missing, or of another moment, or cell and boundary other than they were?"
    ]
