"""The files of one seed, read as its contact network is made of them."""

from branchcrush.files.tables import read_packing, read_table
from branchcrush.packings.network import COLUMNS, VECTOR_COLUMNS, WALL_COLUMNS


def read_contacts(files, number: int, *, vectors: bool = False):
    """Return radii, contacts and wall contacts of a seed, for `packings.network.state_network`.

    Parameters
    ----------
    files : object
        With lists of paths `packings`, `contacts` and `walls`, one entry a seed.
    number : int
        Which seed, counted from 0.
    vectors : bool
        Whether the branch vectors are wanted, which take half as much again.

    Returns
    -------
    radii : ndarray
        [m]
    contacts, walls : DataFrame
    """
    _, radii, _ = read_packing(files.packings[number])
    columns = COLUMNS + VECTOR_COLUMNS if vectors else COLUMNS
    contacts = read_table(files.contacts[number], columns)
    return radii, contacts, read_table(files.walls[number], WALL_COLUMNS)
