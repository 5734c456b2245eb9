"""A few radii that stand for a whole grading."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.gradings.distribution import Grading

# Cells that a grading is cut into, by number and as many by mass.
CELLS = 200
# Single radii of a grading that are kept as they are.
_SINGLE = 100


def grading_nodes(grading: Grading, cells: int = CELLS) -> tuple[NDArray, NDArray]:
    """Return radii that stand for a grading, and their shares of the number of grains.

    Parameters
    ----------
    grading : Grading
    cells : int
        That the continuous part is cut into, by number and as many by mass.

    Returns
    -------
    radius, share : ndarray, shape (K,)
        [m], [-]; up to a hundred single radii beside twice the cells. The coarse grains, few by
        number, have as many nodes as the fine ones.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> from branchcrush.gradings.forms import uniform
    >>> [part.tolist() for part in grading_nodes(single(1.0))]
    [[1.0], [1.0]]
    >>> radius, share = grading_nodes(uniform(1.0, 3.0))
    >>> round(float(share @ radius), 4), round(float(share.sum()), 9)
    (2.0, 1.0)
    """
    single, single_share = grading.discrete_part
    if single.size > _SINGLE:
        single, single_share = single[:0], single_share[:0]
    elif grading.is_discrete:
        return single, single_share
    levels = np.linspace(0.0, 1.0, cells + 1)[1:-1]
    quantiles = np.concatenate([grading.number_ppf(levels), grading.mass_ppf(levels)])
    inner, times = np.unique(quantiles, return_counts=True)
    # The last of these nodes are single radii, which are cut into cells only when they are many.
    nodes, weight = grading.quadrature(breaks=inner)
    cut = nodes.size - single.size
    # One that is more than a cell by itself has its own, without the fines that it outweighs.
    ends = np.union1d(inner, np.nextafter(inner[times > 1], 0.0))
    cell = np.searchsorted(ends, nodes[:cut])
    share = np.bincount(cell, weight[:cut])
    sums = np.bincount(cell, weight[:cut] * nodes[:cut])
    kept = share > 1e-15
    # Means, not middles: the last cell of a long tail reaches far beyond the grains in it.
    radius = np.append(sums[kept] / share[kept], single)
    share = np.append(share[kept], single_share)
    return radius, share / share.sum()
