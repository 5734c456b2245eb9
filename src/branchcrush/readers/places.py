"""Grains by where they are: the one at a place, and the pairs that overlap."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.readers.cells import Cell


def grains_at(places: ArrayLike, positions: ArrayLike, cell: Cell) -> tuple[NDArray, NDArray]:
    """Return the grain whose centre is nearest to each place, and how far it is.

    Parameters
    ----------
    places : array_like, shape (M, 3)
        [m]
    positions : array_like, shape (N, 3)
        Centres of the grains [m].
    cell : Cell

    Returns
    -------
    grains : ndarray of int, shape (M,)
    distance : ndarray, shape (M,)
        [m]

    Examples
    --------
    >>> cell = Cell.between([0, 0, 0], [10, 10, 10], (True, True, True))
    >>> grains, distance = grains_at([[9.9, 5, 5]], [[5, 5, 5], [0, 5, 5]], cell)
    >>> grains.tolist(), distance.round(9).tolist()
    ([1], [0.1])
    """
    from scipy.spatial import cKDTree  # slow to import, and few jobs need it

    # Of shares, so that a tilted cell is one too; the nearest of them is the nearest in space,
    # where a place is that of a centre but for its digits.
    repeats = np.where(cell.periodic, 1.0, 0.0)
    tree = cKDTree(cell.shares(positions), boxsize=repeats)
    _, grains = tree.query(cell.shares(places))
    apart = cell.nearest(np.asarray(places) - np.asarray(positions)[grains])
    return grains, np.linalg.norm(apart, axis=1)


def overlapping_pairs(positions: ArrayLike, radii: ArrayLike, cell: Cell) -> tuple[NDArray, ...]:
    r"""Return the pairs of grains that overlap, from positions alone.

    .. math:: \delta = R_i + R_j - |\mathbf{x}_j - \mathbf{x}_i| > 0

    Parameters
    ----------
    positions : array_like, shape (N, 3)
        [m]
    radii : array_like, shape (N,)
        [m]
    cell : Cell

    Returns
    -------
    i, j : ndarray of int, shape (M,)
        From 0, i < j.
    overlap : ndarray, shape (M,)
        Through the nearest image [m].

    Examples
    --------
    >>> cell = Cell.between([0, 0, 0], [10, 10, 10], (True, True, True))
    >>> i, j, overlap = overlapping_pairs([[1, 5, 5], [9, 5, 5], [5, 5, 5]], [1.0, 1.1, 1.0], cell)
    >>> i.tolist(), j.tolist(), overlap.round(9).tolist()
    ([0], [1], [0.1])
    """
    from scipy.spatial import cKDTree

    radii = np.asarray(radii, float)
    numbers, images = _images(cell, np.asarray(positions, float), 2.0 * radii.max())
    inside = np.arange(len(images)) < radii.size
    # Classes of radius, each twice the one before: one search radius would meet many times more.
    classes = np.floor(np.log2(radii / radii.min())).astype(int)[numbers]
    present = np.unique(classes)
    trees = {one: np.flatnonzero(classes == one) for one in present}
    parts = []
    for one in present:
        own = trees[one][inside[trees[one]]]
        for other in present[present <= one]:
            theirs = trees[other]
            reach = radii[numbers[own]].max() + radii[numbers[theirs]].max()
            near = cKDTree(images[own]).sparse_distance_matrix(
                cKDTree(images[theirs]), reach, output_type="coo_matrix"
            )
            parts.append(np.column_stack([numbers[own[near.row]], numbers[theirs[near.col]]]))
    pairs = np.unique(np.sort(np.concatenate(parts), axis=1), axis=0)
    i, j = pairs[pairs[:, 0] < pairs[:, 1]].T
    apart = cell.nearest(np.asarray(positions)[j] - np.asarray(positions)[i])
    overlap = radii[i] + radii[j] - np.linalg.norm(apart, axis=1)
    touch = overlap > 0
    return i[touch], j[touch], overlap[touch]


def _images(cell, positions, reach):
    """Return the grains in the cell, and below them the images that reach into it."""
    places = cell.wrapped(positions)
    # How far along each edge a grain may be from a face that it touches.
    depth = reach * np.linalg.norm(np.linalg.inv(cell.vectors), axis=0)
    numbers, images = [np.arange(len(places))], [places]
    for axis in range(3):
        if not cell.periodic[axis]:
            continue
        all_numbers, all_images = np.concatenate(numbers), np.concatenate(images)
        share = ((all_images - cell.origin) @ np.linalg.inv(cell.vectors))[:, axis]
        for side, near in ((1.0, share < depth[axis]), (-1.0, share > 1.0 - depth[axis])):
            numbers.append(all_numbers[near])
            images.append(all_images[near] + side * cell.vectors[axis])
    return np.concatenate(numbers), np.concatenate(images)
