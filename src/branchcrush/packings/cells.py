"""The cell of each state of a packing, cube or not, as the vectors of its edges."""

import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.packings.network import Table

# Corners as shares of the edges, and the pairs of them that an edge of the cell joins.
_CORNERS = np.array(list(itertools.product((-0.5, 0.5), repeat=3)))
CELL_EDGES = [
    (a, b) for a in range(8) for b in range(a) if np.abs(_CORNERS[a] - _CORNERS[b]).sum() == 1
]


def path_cells(path: Table, reading: Mapping[str, Any] | None = None) -> NDArray:
    r"""Return the vectors of the cell in each state.

    .. math:: \mathbf{a}_k = V^{1/3} \, \mathbf{e}_k

    Parameters
    ----------
    path : mapping of columns, or DataFrame
        `path.csv`, of it volume_m3.
    reading : mapping, optional
        `reading.json` of a packing that another code made, whose cells need not be cubes.

    Returns
    -------
    ndarray, shape (S, 3, 3)
        A row each edge; the origin is the middle of the cell [m].

    Examples
    --------
    >>> path_cells({"volume_m3": [8.0]}).round(9).tolist()
    [[[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]]
    """
    if reading is not None:
        return np.asarray(reading["cells_m"], dtype=float)
    return np.cbrt(np.asarray(path["volume_m3"], dtype=float))[:, None, None] * np.eye(3)


def cell_corners(cell: ArrayLike) -> NDArray:
    """Return the corners of cells, of which `CELL_EDGES` names those that an edge joins.

    Parameters
    ----------
    cell : array_like, shape (..., 3, 3)
        Vectors of the edges of each, a row an edge [m].

    Returns
    -------
    ndarray, shape (..., 8, 3)
        About its middle [m].

    Examples
    --------
    >>> cell_corners([[2, 0, 0], [1, 2, 0], [0, 0, 4]])[0].tolist()
    [-1.5, -1.0, -2.0]
    """
    return _CORNERS @ np.asarray(cell, dtype=float)
