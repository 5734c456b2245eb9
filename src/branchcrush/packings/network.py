"""The contact network of one packing in one state: its grains, contacts and forces, as arrays."""

from typing import NamedTuple

import numpy as np

from branchcrush.packings.contacts import contact_number, rattlers

# The columns of the contacts tables that networks are made of.
COLUMNS = ("state", "i", "j", "overlap_m", "normal_force_N", "energy_J")
WALL_COLUMNS = ("state", "i", "overlap_m", "normal_force_N")


class Network(NamedTuple):
    """Grains, contacts between them, and contacts with walls; of one packing in one state."""

    radius: np.ndarray  # of each grain, shape (N,) [m]
    i: np.ndarray  # the two grains of each contact, from 0, shape (M,)
    j: np.ndarray
    overlap: np.ndarray  # of each contact [m]
    force: np.ndarray  # repulsive, of each contact [N]
    energy: np.ndarray  # elastic, of each contact [J]
    wall_grain: np.ndarray  # the grain of each contact with a wall, shape (W,)
    wall_overlap: np.ndarray  # [m]
    wall_force: np.ndarray  # [N]

    @property
    def contacts(self):
        """Number of contacts with other grains, of each grain."""
        return contact_number(self.i, self.j, self.radius.size)

    @property
    def wall_contacts(self):
        """Number of contacts with walls, of each grain."""
        return np.bincount(self.wall_grain, minlength=self.radius.size)

    @property
    def rattlers(self):
        """Which grains carry no load: fewer than four contacts, walls' included."""
        return rattlers(self.i, self.j, self.radius.size, self.wall_contacts)

    @property
    def radius_i(self):
        """Radius of the first grain of each contact [m]."""
        return self.radius[self.i]

    @property
    def radius_j(self):
        """Radius of the second [m]."""
        return self.radius[self.j]

    @property
    def length(self):
        """Branch length R_i + R_j of each contact [m]."""
        return self.radius_i + self.radius_j


def state_network(radii, contacts, walls, state):
    """Return the network of a packing in one state.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    contacts : DataFrame
        `contacts.parquet`, of it at least `COLUMNS`.
    walls : DataFrame
        `wall_contacts.parquet`, of it at least `WALL_COLUMNS`.
    state : int

    Returns
    -------
    Network

    Examples
    --------
    >>> import pandas as pd
    >>> contacts = pd.DataFrame({"state": [0, 1], "i": [0, 0], "j": [1, 1], "overlap_m": [0.1, 0.2],
    ...                          "normal_force_N": [1.0, 2.0], "energy_J": [0.05, 0.2]})
    >>> walls = pd.DataFrame({name: [] for name in WALL_COLUMNS})
    >>> network = state_network([1.0, 2.0], contacts, walls, 1)
    >>> network.length.tolist(), network.force.tolist(), network.contacts.tolist()
    ([3.0], [2.0], [1, 1])
    """
    pairs = contacts[contacts["state"] == state]
    held = walls[walls["state"] == state]
    return Network(
        np.asarray(radii, dtype=float),
        pairs["i"].to_numpy(int),
        pairs["j"].to_numpy(int),
        pairs["overlap_m"].to_numpy(),
        pairs["normal_force_N"].to_numpy(),
        pairs["energy_J"].to_numpy(),
        held["i"].to_numpy(int),
        held["overlap_m"].to_numpy(float),
        held["normal_force_N"].to_numpy(float),
    )
