"""The cell of a packing that another code made: of any shape, periodic in any direction."""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

_SHIFTS = np.array(list(itertools.product((-1.0, 0.0, 1.0), repeat=3)))


@dataclass(frozen=True, eq=False)
class Cell:
    """A parallelepiped, and in which of its directions it repeats.

    Parameters
    ----------
    origin : ndarray, shape (3,)
        Its lower corner [m].
    vectors : ndarray, shape (3, 3)
        Its edges, a row each [m].
    periodic : tuple of bool
        In the direction of each edge.

    Examples
    --------
    >>> cell = Cell.between([0, 0, 0], [10, 10, 10], (True, True, True), tilts=(4.0, 0.0, 0.0))
    >>> cell.volume, cell.nearest([[0.0, 9.0, 0.0]]).tolist()
    (1000.0, [[-4.0, -1.0, 0.0]])
    """

    origin: NDArray
    vectors: NDArray
    periodic: tuple[bool, bool, bool]

    @classmethod
    def between(
        cls,
        low: ArrayLike,
        high: ArrayLike,
        periodic: tuple[bool, bool, bool],
        tilts: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> "Cell":
        """Return the cell between two corners, of which tilts move the upper edges.

        Parameters
        ----------
        low, high : array_like, shape (3,)
            Corners of the cell without its tilts [m].
        periodic : tuple of bool
        tilts : tuple of float
            xy, xz and yz, as LAMMPS has them [m].

        Returns
        -------
        Cell
        """
        low, edges = np.asarray(low, float), np.subtract(high, low).astype(float)
        vectors = np.diag(edges)
        vectors[1, 0], vectors[2, 0], vectors[2, 1] = tilts
        return cls(low, vectors, periodic)

    @property
    def volume(self) -> float:
        """Volume of the cell [m3]."""
        a, b, c = self.vectors
        return float(abs(a @ np.cross(b, c)))

    @property
    def edge(self) -> float:
        """Edge of the cube of its volume; of a cube its own, to the last digit [m]."""
        edges = np.diag(self.vectors)
        cube = np.all(edges == edges[0]) and np.count_nonzero(self.vectors) == 3
        return float(edges[0]) if cube else float(np.cbrt(self.volume))

    @property
    def centre(self) -> NDArray:
        """Its middle [m]."""
        return self.origin + self.vectors.sum(axis=0) / 2.0

    def shares(self, positions: ArrayLike) -> NDArray:
        """Return where positions are along the three edges, wrapped where the cell repeats.

        Parameters
        ----------
        positions : array_like, shape (N, 3)
            [m]

        Returns
        -------
        ndarray, shape (N, 3)
            0 to 1 in the cell [-].
        """
        shares = (np.asarray(positions, float) - self.origin) @ np.linalg.inv(self.vectors)
        wrapped = shares - np.floor(shares)
        wrapped[wrapped >= 1.0] = 0.0  # of a share just below 0
        return np.where(self.periodic, wrapped, shares)

    def wrapped(self, positions: ArrayLike) -> NDArray:
        """Return positions in the cell.

        Parameters
        ----------
        positions : array_like, shape (N, 3)
            [m]

        Returns
        -------
        ndarray, shape (N, 3)
            [m]
        """
        return self.origin + self.shares(positions) @ self.vectors

    def nearest(self, vectors: ArrayLike) -> NDArray:
        """Return the shortest image of vectors between places in the cell.

        Parameters
        ----------
        vectors : array_like, shape (M, 3)
            [m]

        Returns
        -------
        ndarray, shape (M, 3)
            [m]
        """
        vectors = np.asarray(vectors, float)
        shares = np.where(self.periodic, vectors @ np.linalg.inv(self.vectors), 0.0)
        reduced = vectors - np.round(shares) @ self.vectors
        # In a tilted cell the rounded one need not be the shortest.
        best, shortest = reduced, np.einsum("ij,ij->i", reduced, reduced)
        for shift in _SHIFTS[np.all((_SHIFTS == 0.0) | self.periodic, axis=1)]:
            image = reduced + shift @ self.vectors
            squared = np.einsum("ij,ij->i", image, image)
            nearer = squared < shortest * (1.0 - 1e-12)
            best, shortest = np.where(nearer[:, None], image, best), np.minimum(squared, shortest)
        return best

    def outside(self, positions: ArrayLike) -> int:
        """Return how many positions lie outside, in the directions that do not repeat.

        Parameters
        ----------
        positions : array_like, shape (N, 3)
            [m]

        Returns
        -------
        int
        """
        shares = self.shares(positions)
        return int(np.any((shares < 0.0) | (shares > 1.0), axis=1).sum())
