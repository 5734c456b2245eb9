"""The contact network of one packing in one state: its grains, contacts and forces, as arrays."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.packings.contacts import contact_number, rattlers

# The columns of the contacts tables that networks are made of, and those of the branch vector and
# of the direction of a wall, which few results need.
COLUMNS = ("state", "i", "j", "overlap_m", "normal_force_N", "energy_J")
VECTOR_COLUMNS = ("branch_x", "branch_y", "branch_z")
WALL_COLUMNS = ("state", "i", "overlap_m", "normal_force_N")
DIRECTION_COLUMNS = ("direction_x", "direction_y", "direction_z")


class Table(Protocol):
    """What columns are taken from by name: a mapping of arrays, or a DataFrame."""

    def __getitem__(self, name: str, /) -> Any: ...

    def __contains__(self, name: Any, /) -> bool: ...


@dataclass(frozen=True, eq=False)
class Network:
    """Grains, contacts between them, and contacts with walls; of one packing in one state.

    Contact numbers and rattlers are sought once and kept.
    """

    radius: NDArray  # of each grain, shape (N,) [m]
    i: NDArray  # the two grains of each contact, from 0, shape (M,)
    j: NDArray
    overlap: NDArray  # of each contact [m]
    force: NDArray  # repulsive, of each contact [N]
    energy: NDArray  # elastic, of each contact [J]
    wall_grain: NDArray  # the grain of each contact with a wall, shape (W,)
    wall_overlap: NDArray  # [m]
    wall_force: NDArray  # [N]
    vector: NDArray | None = None  # branch vector from i to j, shape (M, 3) [m]; None if not read

    @cached_property
    def contacts(self) -> NDArray:
        """Number of contacts with other grains, of each grain."""
        return contact_number(self.i, self.j, self.radius.size)

    @cached_property
    def wall_contacts(self) -> NDArray:
        """Number of contacts with walls, of each grain."""
        return np.bincount(self.wall_grain, minlength=self.radius.size)

    @cached_property
    def rattlers(self) -> NDArray:
        """Which grains carry no load: fewer than four contacts, walls' included."""
        return rattlers(self.i, self.j, self.radius.size, self.wall_contacts)

    @property
    def bearing(self) -> NDArray:
        """Which grains carry load: all but the rattlers."""
        return ~self.rattlers

    @property
    def radius_i(self) -> NDArray:
        """Radius of the first grain of each contact [m]."""
        return self.radius[self.i]

    @property
    def radius_j(self) -> NDArray:
        """Radius of the second [m]."""
        return self.radius[self.j]

    @property
    def length(self) -> NDArray:
        """Branch length R_i + R_j of each contact [m]."""
        return self.radius_i + self.radius_j


def state_network(radii: ArrayLike, contacts: Table, walls: Table, state: int) -> Network:
    """Return the network of a packing in one state.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    contacts : mapping of columns, or DataFrame
        `contacts.parquet`, of it at least `COLUMNS`, state after state; with `VECTOR_COLUMNS` the
        network has branch vectors.
    walls : mapping of columns, or DataFrame
        `wall_contacts.parquet`, of it at least `WALL_COLUMNS`.
    state : int

    Returns
    -------
    Network

    Raises
    ------
    ValueError
        When a state comes after a later one in a table.

    Examples
    --------
    >>> contacts = {"state": [0, 1], "i": [0, 0], "j": [1, 1], "overlap_m": [0.1, 0.2],
    ...             "normal_force_N": [1.0, 2.0], "energy_J": [0.05, 0.2]}
    >>> walls = {name: [] for name in WALL_COLUMNS}
    >>> network = state_network([1.0, 2.0], contacts, walls, 1)
    >>> network.length.tolist(), network.force.tolist(), network.contacts.tolist()
    ([3.0], [2.0], [1, 1])
    """
    return next(state_networks(radii, contacts, walls, [state]))


def state_networks(
    radii: ArrayLike, contacts: Table, walls: Table, states: Iterable[int]
) -> Iterator[Network]:
    """Yield the network of a packing in each of some states, one at a time.

    Parameters
    ----------
    radii, contacts, walls
        As for `state_network`.
    states : iterable of int

    Yields
    ------
    Network
        Its arrays are views of the columns: a table need not be in memory twice.

    Raises
    ------
    ValueError
        When a state comes after a later one in a table.

    Examples
    --------
    >>> contacts = {"state": [0, 1], "i": [0, 0], "j": [1, 1], "overlap_m": [0.1, 0.2],
    ...             "normal_force_N": [1.0, 2.0], "energy_J": [0.05, 0.2]}
    >>> walls = {name: [] for name in WALL_COLUMNS}
    >>> networks = state_networks([1.0, 2.0], contacts, walls, [0, 1])
    >>> [network.force.tolist() for network in networks]
    [[1.0], [2.0]]
    """
    radii, states = np.asarray(radii, dtype=float), list(states)
    pairs = _columns(contacts, COLUMNS)
    held = _columns(walls, WALL_COLUMNS)
    vectors = all(name in contacts for name in VECTOR_COLUMNS)
    parts = zip(state_rows(pairs["state"], states), state_rows(held["state"], states), strict=True)
    for rows, at_wall in parts:
        yield Network(
            radii,
            pairs["i"][rows].astype(int, copy=False),
            pairs["j"][rows].astype(int, copy=False),
            pairs["overlap_m"][rows],
            pairs["normal_force_N"][rows],
            pairs["energy_J"][rows],
            held["i"][at_wall].astype(int, copy=False),
            held["overlap_m"][at_wall].astype(float, copy=False),
            held["normal_force_N"][at_wall].astype(float, copy=False),
            np.column_stack([np.asarray(contacts[name])[rows] for name in VECTOR_COLUMNS])
            if vectors
            else None,
        )


def state_rows(column: ArrayLike, states: Iterable[int]) -> list[slice]:
    """Return the rows of each of some states in a table that holds state after state.

    Parameters
    ----------
    column : array_like, shape (M,)
        The state of each row.
    states : iterable of int

    Returns
    -------
    list of slice

    Raises
    ------
    ValueError
        When a state comes after a later one.

    Examples
    --------
    >>> state_rows([2, 2, 5], [2, 5, 7])
    [slice(0, 2, None), slice(2, 3, None), slice(3, 3, None)]
    """
    column = np.asarray(column)
    if np.any(column[1:] < column[:-1]):
        raise ValueError("the rows of a contacts table must come state after state")
    first, last = (np.searchsorted(column, list(states), side) for side in ("left", "right"))
    return [slice(int(start), int(end)) for start, end in zip(first, last, strict=True)]


def _columns(table: Table, names: Iterable[str]) -> dict[str, NDArray]:
    return {name: np.asarray(table[name]) for name in names}
