"""The files of one seed, read as its contact network is made of them."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from branchcrush.files.tables import Table, read_packing, read_table
from branchcrush.packings.network import COLUMNS, VECTOR_COLUMNS, WALL_COLUMNS


class SeedFiles(Protocol):
    """The paths of all seeds of a sample, an entry a seed, as an input of Snakemake has them."""

    packings: Sequence[str]
    contacts: Sequence[str]
    walls: Sequence[str]


def read_contacts(
    files: SeedFiles, number: int, *, vectors: bool = False, states: Sequence[int] | None = None
) -> tuple[np.ndarray, Table, Table]:
    """Return radii, contacts and wall contacts of a seed, for `packings.network.state_network`.

    Parameters
    ----------
    files : SeedFiles
    number : int
        Which seed, counted from 0.
    vectors : bool
        Whether the branch vectors are wanted, which take half as much again.
    states : sequence of int, optional
        Those of the contacts that are wanted; all by default.

    Returns
    -------
    radii : ndarray, shape (N,)
        [m]
    contacts, walls : DataFrame
        A row for each contact and state, with the columns that a network needs.
    """
    _, radii, _ = read_packing(files.packings[number])
    columns = COLUMNS + VECTOR_COLUMNS if vectors else COLUMNS
    contacts = read_table(files.contacts[number], columns, states)
    return radii, contacts, read_table(files.walls[number], WALL_COLUMNS)
