"""What is kept of the contacts of one seed, for the results of who touches whom."""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from branchcrush.branches.contact_numbers import ContactSums, contact_sums, radius_classes
from branchcrush.branches.coordination_laws import isostatic_number
from branchcrush.branches.predictions import fine_edges
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.network import state_network, state_networks

# What reads a seed, counted from 0: its radii, contacts and wall contacts.
SeedReader = Callable[[int], tuple[NDArray, pd.DataFrame, pd.DataFrame]]


class SeedContacts(NamedTuple):
    """What is kept of the contacts of one seed in some of its states."""

    radius: np.ndarray  # of the grains, shape (N,) [m]
    contacts: list[np.ndarray]  # of each grain, in each state
    lengths: np.ndarray  # branches in narrow bins, shape (states, n)
    sums: list[ContactSums]  # of each state
    length: np.ndarray  # R_i + R_j of every branch of the last state [m]
    isostatic: np.ndarray  # `branches.coordination_laws.isostatic_number` of each state


def sample_classes(
    grading: Grading, radii: ArrayLike, contacts: pd.DataFrame, walls: pd.DataFrame, state: int
) -> NDArray:
    """Return the classes of radius of a sample, from one of its packings.

    Parameters
    ----------
    grading : Grading
    radii, contacts, walls, state
        As for `packings.network.state_network`.

    Returns
    -------
    ndarray, shape (K+1,)
        Edges, from the smallest to the largest radius of the grading [m].

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> contacts = {"state": [0], "i": [0], "j": [1], "overlap_m": [0.1], "normal_force_N": [1.0],
    ...             "energy_J": [0.05]}
    >>> walls = {name: [] for name in ("state", "i", "overlap_m", "normal_force_N")}
    >>> sample_classes(uniform(1.0, 5.0), [1.0, 4.0], contacts, walls, 0).tolist()
    [1.0, 2.0, 5.0]
    """
    network = state_network(radii, contacts, walls, state)
    classes = radius_classes(network.radius, network.contacts)
    smallest, largest = grading.support()
    inner = classes[1:-1]
    inner = inner[(inner > smallest) & (inner < largest)]
    return np.concatenate([[smallest], inner, [largest]])


def seed_contacts(
    grading: Grading,
    classes: ArrayLike,
    radii: ArrayLike,
    contacts: pd.DataFrame,
    walls: pd.DataFrame,
    states: Iterable[int],
) -> SeedContacts:
    """Return what the results of a sample need of the contacts of one seed.

    Parameters
    ----------
    grading : Grading
    classes : array_like, shape (K+1,)
        From `sample_classes` [m].
    radii, contacts, walls
        As for `packings.network.state_network`.
    states : iterable of int

    Returns
    -------
    SeedContacts
        It holds no part of the table.
    """
    edges = fine_edges(*grading.support())
    numbers, lengths, sums, isostatic = [], [], [], []
    for network in state_networks(radii, contacts, walls, states):
        numbers.append(network.contacts)
        length = network.length
        lengths.append(np.histogram(length, edges)[0])
        sums.append(contact_sums(network, classes))
        isostatic.append(isostatic_number(network))
    return SeedContacts(
        np.asarray(radii), numbers, np.array(lengths), sums, length, np.array(isostatic)
    )


def sample_contacts(
    grading: Grading, read_seed: SeedReader, used: Sequence[int], states: Sequence[int]
) -> tuple[list[SeedContacts], NDArray]:
    """Return what is kept of the contacts of all seeds, read one after the other, and the classes.

    Parameters
    ----------
    grading : Grading
    read_seed : callable
        Takes the number of a seed; returns radii, contacts and walls as for
        `packings.network.state_network`.
    used : sequence of int
        Which seeds, counted from 0.
    states : sequence of int
        In increasing order.

    Returns
    -------
    seeds : list of SeedContacts
    classes : ndarray, shape (K+1,)
        Of radius, from the last state of the first of these seeds [m].
    """
    seeds, classes = [], None
    for number in used:
        packing = read_seed(number)
        if classes is None:
            classes = sample_classes(grading, *packing, states[-1])
        seeds.append(seed_contacts(grading, classes, *packing, states))
        del packing  # before the next one is read
    return seeds, classes
