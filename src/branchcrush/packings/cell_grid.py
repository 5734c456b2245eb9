"""A grid of cells in which spheres of similar radius find those near a place."""

import numpy as np

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

    def __init__(self, edge, periodic, largest_radius, expected):
        self.edge, self.periodic, self.largest_radius = edge, periodic, largest_radius
        # Cells of a diameter, but in a sparse class not many more than it has spheres.
        most = np.ceil(np.cbrt(2.0 * expected))
        self.n = int(np.clip(edge / (2.02 * largest_radius), 1, most))
        self.table = np.full((self.n**3, 4), EMPTY, dtype=np.int32)
        self.count = np.zeros(self.n**3, dtype=np.int32)
        self.filled = False

    def add(self, numbers, centres):
        """List spheres by their numbers, shape (M,), at their centres, shape (M, 3) [m]."""
        cell = np.clip((centres / self.edge + 0.5) * self.n, 0, self.n - 1).astype(int)
        cell = np.ravel_multi_index(cell.T, (self.n,) * 3)
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

    def near(self, places, radius, before=EMPTY):
        """Yield pairs of a place and a sphere near it, of a number below `before`, in portions."""
        # A little more than needed, so that rounding loses no cell.
        reach = (self.largest_radius + radius) / self.edge * self.n * (1.0 + 1e-6)
        span = min(int(np.ceil(2.0 * reach)) + 1, self.n)
        entries = span**3 * self.table.shape[1]
        rows = max(1, _ENTRIES_AT_ONCE // entries)
        for start in range(0, len(places), rows):
            part = slice(start, start + rows)
            low = np.floor((places[part] / self.edge + 0.5) * self.n - reach).astype(int)
            if not self.periodic:
                low = np.clip(low, 0, self.n - span)
            x, y, z = np.moveaxis((low[:, :, None] + np.arange(span)) % self.n, 1, 0)
            cell = (x[:, :, None] * self.n + y[:, None, :])[..., None] * self.n + z[:, None, None]
            listed = self.table[cell.reshape(-1)].reshape(len(low), -1)
            limit = before if np.isscalar(before) else before[part, None]
            found = np.flatnonzero(listed < limit)
            yield start + found // entries, listed.reshape(-1)[found]
