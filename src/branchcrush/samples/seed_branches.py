"""The branches of one seed: what is kept of its contacts for the energy split.

Contacts are many, so each seed's are read, reduced to what the results need, and let go.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.energy.predictors import branch_columns
from branchcrush.packings.network import state_rows
from branchcrush.statistics.bins import binned_sums

# The columns of a contacts table that energies by length need, and those that all of it needs.
ENERGY_COLUMNS = ("state", "radius_i_m", "radius_j_m", "energy_J")
COLUMNS = (*ENERGY_COLUMNS, "branch_length_m", "overlap_m")


class Branches(NamedTuple):
    """The branches of one seed in some of its states, in their order."""

    sums: np.ndarray  # `statistics.bins.binned_sums` of each state, shape (states, 3, n)
    overlap_over_length: list[np.ndarray]  # overlap over distance of the centres, of each state [-]
    # Every branch of the first state and of the last, as `energy.predictors.branch_columns`: those
    # between are many, and what they say of the exponent is in the sums.
    first: tuple
    last: tuple


def seed_branches(contacts: pd.DataFrame, states: Sequence[int], edges: NDArray) -> Branches:
    """Return what the results of a sample need of the contacts of one seed.

    Parameters
    ----------
    contacts : DataFrame
        `contacts.parquet`, of it at least `COLUMNS`.
    states : array_like of int
        In increasing order.
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    Branches
        It holds no part of the table.
    """
    tables = _of_states(contacts, states)
    ratios = [
        table["overlap_m"].to_numpy() / table["branch_length_m"].to_numpy() for table in tables
    ]
    sums = np.stack([_sums(table, edges) for table in tables])
    return Branches(sums, ratios, *(_columns(tables[number], edges) for number in (0, -1)))


def state_sums(contacts: pd.DataFrame, state: int, edges: NDArray) -> NDArray:
    """Return the binned energies of one state of a seed, as `statistics.bins.binned_sums`.

    Parameters
    ----------
    contacts : DataFrame
        `contacts.parquet`, of it at least `ENERGY_COLUMNS`.
    state : int
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    ndarray, shape (3, n)

    Examples
    --------
    >>> table = {"state": [1, 2], "radius_i_m": 1.0, "radius_j_m": 2.0, "energy_J": [0.1, 0.5]}
    >>> state_sums(pd.DataFrame(table), 2, np.array([2.0, 4.0])).tolist()
    [[1.0], [3.0], [0.5]]
    """
    return _sums(*_of_states(contacts, [state]), edges)


def _of_states(contacts: pd.DataFrame, states: Sequence[int]) -> list[pd.DataFrame]:
    """Return the rows of each state as a table of its own."""
    return [contacts.iloc[rows] for rows in state_rows(contacts["state"], states)]


def _columns(table, edges):
    radii = (table["radius_i_m"].to_numpy(), table["radius_j_m"].to_numpy())
    return branch_columns(*radii, table["energy_J"].to_numpy(), edges[-1] / 2.0)


def _sums(table, edges):
    # The paper's branch length, that of two spheres that just touch.
    length = table["radius_i_m"].to_numpy() + table["radius_j_m"].to_numpy()
    return binned_sums(length, table["energy_J"].to_numpy(), edges)
