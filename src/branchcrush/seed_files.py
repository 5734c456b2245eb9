"""The files of one seed, read as its contact network is made of them."""

from branchcrush.networks import COLUMNS, WALL_COLUMNS
from branchcrush.tables import read_packing, read_table


def read_contacts(files, number):
    """Return what `networks.state_network` takes of a seed: radii, contacts, contacts with walls.

    Parameters
    ----------
    files : object
        With lists of paths `packings`, `contacts` and `walls`, one entry a seed.
    number : int
        Which seed, counted from 0.

    Returns
    -------
    radii : ndarray
        [m]
    contacts, walls : DataFrame
    """
    _, radii, _ = read_packing(files.packings[number])
    contacts = read_table(files.contacts[number], COLUMNS)
    return radii, contacts, read_table(files.walls[number], WALL_COLUMNS)
