"""Non-overlapping random placement of spheres in a cube."""

import heapq

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import PackingError
from branchcrush.packings.cell_grid import EMPTY, CellGrid
from branchcrush.packings.geometry import UNIT_SPHERE, solid_volume

# Every sphere draws its places in blocks of so many, and leaves the rest of the last one unused.
_BLOCK = 64
# In a batch of spheres of this solid fraction up to four times as large a share hit another one.
_BATCH_FRACTION = 0.005
_LARGEST_BATCH = 2048
# Where spheres that need a second block end batches sooner than this, none are made.
_SMALLEST_BATCH = 16
_BLOCKS_IN_TURN = 64
# Relative to the radius; a place is blocked for all spheres so alike, or for almost none.
_ALIKE = 0.02
# Smaller classes of radii cost more than they save.
_SMALLEST_CLASS = 64


def random_packing(
    radii: ArrayLike,
    edge: float,
    *,
    periodic: bool,
    rng: np.random.Generator,
    largest_attempts: int = 20_000,
) -> NDArray:
    """Place spheres at random in a cube about the origin so that none overlap.

    Random sequential addition, the largest first: each sphere is put at a uniform random place
    until one is free. Behind walls it stays wholly inside; a periodic cube has no wall. It ends
    near a solid fraction of 0.3 to 0.4.

    Parameters
    ----------
    radii : array_like, shape (N,)
        In the order to place them; decreasing reaches the highest fraction [m].
    edge : float
        Edge of the cube [m].
    periodic : bool
        Whether the faces of the cube are joined.
    rng : numpy.random.Generator
    largest_attempts : int
        Places tried for one sphere before giving up.

    Returns
    -------
    ndarray, shape (N, 3)
        Centres [m].

    Raises
    ------
    PackingError
        When a sphere does not fit into the cube, or finds no place; the message then names the
        solid fraction reached.

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> random_packing([1.0, 0.5], 4.0, periodic=False, rng=rng).shape
    (2, 3)

    References
    ----------
    Widom (1966), J. Chem. Phys. 44, 3888-3894, for random sequential addition.
    """
    radii = np.asarray(radii, dtype=float)
    if radii.max() * 2.0 > edge:
        raise PackingError(
            f"a grain of radius {radii.max():.3g} m does not fit into a cube of {edge:.3g} m: "
            "use more grains or a lower initial_solid_fraction"
        )
    spheres = _Spheres(radii, edge, periodic)
    filled = UNIT_SPHERE * np.cumsum(radii**3) / edge**3
    placed, tried, largest_batch, blocks_each = 0, 0, _LARGEST_BATCH, 1.0
    while placed < radii.size:
        # A sphere is given a block of places, and further blocks until one of them is free: the
        # outcome is that of one sphere after the other, whichever way the blocks are drawn.
        crowded = largest_batch < _SMALLEST_BATCH
        batch = np.searchsorted(filled, filled[placed] + _BATCH_FRACTION) - placed
        batch = int(np.clip(batch, 1, largest_batch))
        blocks = batch
        if tried or crowded:
            stop = spheres.alike(placed, _BLOCKS_IN_TURN if crowded else 1)
            blocks = max(int((stop - placed) * blocks_each), tried // _BLOCK)
            blocks = min(blocks, _BLOCKS_IN_TURN)
        state = rng.bit_generator.state
        uniform = rng.random((blocks, _BLOCK, 3))
        if tried or crowded:
            new, used, tried = spheres.place_in_turn(placed, stop, uniform, tried, largest_attempts)
            blocks_each = used / max(new, 1) if crowded else 1.0
            if crowded and new > 0.9 * used:
                largest_batch = _SMALLEST_BATCH
        else:
            new = spheres.place_batch(placed, uniform[:, : max(largest_attempts, 0)])
            used = min(new + 1, batch)
            tried = 0 if new == batch else _BLOCK
            largest_batch = new if tried else min(2 * largest_batch, _LARGEST_BATCH)
        placed += new
        if tried >= largest_attempts:
            reached = solid_volume(radii[:placed]) / edge**3
            raise PackingError(
                f"no free place for grain {placed + 1} of {radii.size} after {largest_attempts} "
                f"attempts, at a solid fraction of {reached:.3f}: lower initial_solid_fraction "
                "(random placement ends near 0.3 to 0.4) and compress further"
            )
        if used < blocks:
            # What was drawn for spheres not placed yet is drawn again.
            rng.bit_generator.state = state
            rng.random((used, _BLOCK, 3))
    return spheres.centres


class _Spheres:
    """Spheres in a cube that find each other through one grid for each class of similar radius."""

    def __init__(self, radii: NDArray, edge: float, periodic: bool) -> None:
        self.radii, self.edge, self.periodic = radii, edge, periodic
        self.reach = np.full(radii.size, edge / 2.0) if periodic else edge / 2.0 - radii
        self.centres = np.empty((radii.size, 3))
        falling = np.sort(radii)[::-1]
        self.grids: list[CellGrid] = []
        smallest, start = [], 0
        while start < radii.size:
            stop = np.searchsorted(-falling, -falling[start] / 2.0)
            stop = min(max(stop, start + _SMALLEST_CLASS), radii.size)
            self.grids.append(CellGrid(edge, periodic, falling[start], stop - start))
            smallest.append(falling[stop - 1])
            start = stop
        self.class_of = np.searchsorted(-np.array(smallest), -radii)

    def place_batch(self, first: int, uniform: NDArray) -> int:
        """Place a sphere for each block of random numbers, and return how many before one failed.

        Sphere by sphere, the first place of its block that is free of all spheres before it.
        """
        reach = self.reach[first : first + len(uniform), None, None]
        tries = uniform * (2.0 * reach) - reach
        chosen = np.zeros(len(tries), dtype=int)
        self._choose_free(first, tries, chosen)
        failed = np.flatnonzero(chosen == tries.shape[1])
        stop = first + (failed[0] if failed.size else len(tries))
        if stop > first:
            self.centres[first:stop] = tries[np.arange(stop - first), chosen[: stop - first]]
            stop = self._separate(first, stop, tries, chosen)
            self._add(first, stop)
        return stop - first

    def alike(self, first: int, most: int) -> int:
        """Return the end of a run of spheres of nearly equal radius, `most` of them at most."""
        radii = self.radii[first : first + most]
        other = np.abs(radii - radii[0]) > _ALIKE * radii[0]
        return first + (int(np.argmax(other)) if other.any() else len(radii))

    def place_in_turn(
        self, first: int, stop: int, uniform: NDArray, tried: int, largest_attempts: int
    ) -> tuple[int, int, int]:
        """Place spheres from blocks of random numbers, of which each may need many.

        Return how many were placed, how many blocks that took, and what the next one has tried.
        """
        radii, reach = self.radii[first:stop], self.reach[first:stop]
        # Behind walls the same numbers lead to places so far apart, times less than 2.
        apart = 2.0 * np.abs(reach - reach[0]).max()
        places = (uniform * (2.0 * reach[0]) - reach[0]).reshape(-1, 3)
        # Most places are blocked for all these spheres, which this tells at once.
        possible = self._free(places, np.full(len(places), radii.min() - apart))
        sphere, used = first, 0
        for block, in_block in zip(uniform, possible.reshape(-1, _BLOCK), strict=True):
            used += 1
            for k in np.flatnonzero(in_block[: largest_attempts - tried]):
                place = block[k] * (2.0 * self.reach[sphere]) - self.reach[sphere]
                contact = self.radii[first:sphere] + self.radii[sphere]
                met = self._overlap(self.centres[first:sphere] - place, contact)
                if not met.any() and self._free(place[None], self.radii[sphere : sphere + 1])[0]:
                    self.centres[sphere] = place
                    sphere, tried = sphere + 1, 0
                    break
            else:
                tried += _BLOCK
            if sphere == stop or tried >= largest_attempts:
                break
        self._add(first, sphere)
        return sphere - first, used, tried

    def _separate(self, first: int, stop: int, tries: NDArray, chosen: NDArray) -> int:
        """Move on, in their order, the spheres of a batch that overlap an earlier one of it.

        Return the first of them that has no place left, or else `stop`.
        """
        radii, centres = self.radii[first:stop], self.centres[first:stop]
        grid = CellGrid(self.edge, self.periodic, radii.max(), stop - first)
        grid.add(np.arange(first, stop), centres)
        waiting = np.flatnonzero(self._hit(grid, centres, radii, np.arange(first, stop))).tolist()
        while waiting:
            sphere = heapq.heappop(waiting)
            before, after = slice(sphere), sphere + 1
            first_choice = chosen[sphere]
            while self._overlap(
                centres[before] - centres[sphere], radii[before] + radii[sphere]
            ).any():
                chosen[sphere] += 1
                self._choose_free(first + sphere, tries[sphere:after], chosen[sphere:after])
                if chosen[sphere] == tries.shape[1]:
                    return first + sphere
                centres[sphere] = tries[sphere, chosen[sphere]]
            if chosen[sphere] != first_choice:
                gap, contact = centres[after:] - centres[sphere], radii[after:] + radii[sphere]
                for later in after + np.flatnonzero(self._overlap(gap, contact)):
                    heapq.heappush(waiting, int(later))
        return stop

    def _choose_free(self, first: int, tries: NDArray, chosen: NDArray) -> None:
        """Raise `chosen` to the first try, from it on, that is free of the spheres in the grids."""
        most, width = tries.shape[1], 1
        searching = np.flatnonzero(chosen < most)
        while searching.size:
            k = chosen[searching, None] + np.arange(width)
            places = tries[searching[:, None], np.minimum(k, most - 1)]
            radii = np.repeat(self.radii[first + searching], width)
            free = self._free(places.reshape(-1, 3), radii).reshape(-1, width)
            ends = free.any(axis=1)
            step = np.where(ends, free.argmax(axis=1), width)
            chosen[searching] = np.minimum(chosen[searching] + step, most)
            searching = searching[~ends & (chosen[searching] < most)]
            width = max(1, min(2 * width, 1024 // max(searching.size, 1)))

    def _add(self, first: int, stop: int) -> None:
        for one in np.unique(self.class_of[first:stop]):
            members = first + np.flatnonzero(self.class_of[first:stop] == one)
            self.grids[one].add(members, self.centres[members])

    def _free(self, places: NDArray, radii: NDArray) -> NDArray:
        """Return which spheres of these radii would be free at these places."""
        free = np.arange(len(places))
        for grid in self.grids:
            if grid.filled and free.size:
                free = free[~self._hit(grid, places[free], radii[free])]
        result = np.zeros(len(places), dtype=bool)
        result[free] = True
        return result

    def _hit(
        self, grid: CellGrid, places: NDArray, radii: NDArray, before: int | NDArray = EMPTY
    ) -> NDArray:
        """Return which spheres at these places overlap one in the grid, of a lower number."""
        hit = np.zeros(len(places), dtype=bool)
        for which, near in grid.near(places, radii.max(), before):
            gap = self.centres[near] - places[which]
            hit[which[self._overlap(gap, self.radii[near] + radii[which])]] = True
        return hit

    def _overlap(self, gap: NDArray, contact: NDArray) -> NDArray:
        """Return which gaps between two centres, shape (n, 3), are below a distance [m]."""
        if self.periodic:
            gap -= self.edge * np.round(gap / self.edge)
        return np.einsum("ij,ij->i", gap, gap) < contact**2
