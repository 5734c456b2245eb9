"""A grid of cells in which spheres of similar radius find those near a place."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

# Grid entries compared at once, which bounds the memory.
_ENTRIES_AT_ONCE = 2**20
# No sphere has this number.
EMPTY = int(np.iinfo(np.int32).max)


class CellGrid:
    """Cells of a cube, each of which lists the numbers of the spheres with a centre in it.

    Parameters
    ----------
    edge : float
        Of the cube about the origin [m].
    periodic : bool
    largest_radius : float
        Of the spheres it will hold [m].
    expected : int
        How many it will hold, for the number of cells.

    Examples
    --------
    >>> grid = CellGrid(10.0, False, 1.0, 1)
    >>> grid.add(np.array([7]), np.array([[1.0, 1.0, 1.0]]))
    >>> [(int(place), int(sphere)) for which, near in grid.near(np.zeros((1, 3)), 1.0)
    ...  for place, sphere in zip(which, near)]
    [(0, 7)]
    """

    def __init__(self, edge: float, periodic: bool, largest_radius: float, expected: int) -> None:
        self.edge, self.periodic, self.largest_radius = edge, periodic, largest_radius
        # Cells of a diameter, but in a sparse class not many more than it has spheres.
        most = np.ceil(np.cbrt(2.0 * expected))
        self.cells = int(np.clip(edge / (2.02 * largest_radius), 1, most))
        self.table = np.full((self.cells**3, 4), EMPTY, dtype=np.int32)
        self.count = np.zeros(self.cells**3, dtype=np.int32)
        self.filled = False

    def add(self, numbers: NDArray, centres: NDArray) -> None:
        """List spheres in the cells of their centres.

        Parameters
        ----------
        numbers : ndarray of int, shape (M,)
            What they are called by, below `EMPTY`.
        centres : ndarray, shape (M, 3)
            [m]
        """
        cell = np.clip((centres / self.edge + 0.5) * self.cells, 0, self.cells - 1).astype(int)
        cell = np.ravel_multi_index(cell.T, (self.cells,) * 3)
        order = np.argsort(cell, kind="stable")
        cell = cell[order]
        # How many of the same cell come before.
        rank = np.arange(cell.size) - np.searchsorted(cell, cell)
        slot = self.count[cell] + rank
        while slot.max() >= self.table.shape[1]:
            self.table = np.hstack([self.table, np.full_like(self.table, EMPTY)])
        self.table[cell, slot] = numbers[order]
        np.maximum.at(self.count, cell, slot + 1)
        self.filled = True

    def near(
        self, places: NDArray, radius: float, before: int | NDArray = EMPTY
    ) -> Iterator[tuple[NDArray, NDArray]]:
        """Yield pairs of a place and a sphere near it, in portions.

        Parameters
        ----------
        places : ndarray, shape (P, 3)
            [m]
        radius : float
            All spheres that one of this radius could touch from a place are met, and more [m].
        before : int or ndarray of int, shape (P,)
            Only spheres of a lower number, of each place's own where it is an array.

        Yields
        ------
        place, sphere : ndarray of int, shape (m,)
            Row of the place, and number of the sphere.
        """
        # A little more than needed, so that rounding loses no cell.
        reach = (self.largest_radius + radius) / self.edge * self.cells * (1.0 + 1e-6)
        span = min(int(np.ceil(2.0 * reach)) + 1, self.cells)
        entries = span**3 * self.table.shape[1]
        rows = max(1, _ENTRIES_AT_ONCE // entries)
        for start in range(0, len(places), rows):
            part = slice(start, start + rows)
            low = np.floor((places[part] / self.edge + 0.5) * self.cells - reach).astype(int)
            if not self.periodic:
                low = np.clip(low, 0, self.cells - span)
            x, y, z = np.moveaxis((low[:, :, None] + np.arange(span)) % self.cells, 1, 0)
            cell = (x[:, :, None] * self.cells + y[:, None, :])[..., None] * self.cells + z[
                :, None, None
            ]
            listed = self.table[cell.reshape(-1)].reshape(len(low), -1)
            limit = before[part, None] if isinstance(before, np.ndarray) else before
            entry = np.flatnonzero(listed < limit)
            yield start + entry // entries, listed.reshape(-1)[entry]
