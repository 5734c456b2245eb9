"""How many contacts a grain of a radius has, predicted from the grading alone.

Each model gives c(R), the mean number of contacts with other grains over **all** grains of that
radius, rattlers included, at the jamming point. None has a number fitted to a packing.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.coordination import ISOSTATIC, Coordination, solid_angle
from branchcrush.branches.load_bearing import rod_contacts
from branchcrush.branches.parking import ParkingSolution, parking_contacts, parking_solutions
from branchcrush.errors import FitError
from branchcrush.packings.contacts import STABLE_CONTACTS

# Contacts that Bouvard and Lange give to a grain of no size: half of the isostatic number.
_SMALLEST = 3.0
_ITERATIONS = 500
_CONVERGED = 1e-9


def mean_neighbour_contacts(radius: NDArray, share: NDArray) -> Coordination:
    r"""Return contact numbers when every neighbour is of the mean radius.

    .. math:: c(R) \propto 1/\Omega(R, \langle R \rangle), \qquad \langle c \rangle = 6

    Parameters
    ----------
    radius, share : ndarray, shape (K,)
        Radii [any unit], and their shares of the number of grains [-].

    Returns
    -------
    Coordination

    Examples
    --------
    >>> mean_neighbour_contacts(np.array([2.0]), np.array([1.0])).contacts.tolist()
    [6.0]

    References
    ----------
    Suzuki and Oshima (1983), Powder Technology 35, 159; Madadi, Tsoungui, Laetzel and Luding
    (2004), Int. J. Solids Struct. 41, 2563; Shaebani, Madadi, Luding and Wolf (2012), Phys. Rev. E
    85, 011301.
    """
    contacts = 1.0 / solid_angle(radius, share @ radius)
    return Coordination(ISOSTATIC * contacts / (share @ contacts), np.ones(radius.size))


def surface_contacts(radius: NDArray, share: NDArray) -> Coordination:
    r"""Return contact numbers that grow with the surface from three for the smallest.

    .. math:: c(R) = 3 + (6 - 3)\, R^2/\langle R^2 \rangle

    Parameters
    ----------
    radius, share
        As for `mean_neighbour_contacts`.

    Returns
    -------
    Coordination

    Examples
    --------
    >>> surface_contacts(np.array([2.0]), np.array([1.0])).contacts.tolist()
    [6.0]

    References
    ----------
    Bouvard and Lange (1991), Acta Metall. Mater. 39, 3083.
    """
    contacts = _SMALLEST + (ISOSTATIC - _SMALLEST) * radius**2 / (share @ radius**2)
    return Coordination(contacts, np.ones(radius.size))


def self_consistent_contacts(
    radius: NDArray, share: NDArray, least: float = STABLE_CONTACTS - 0.5
) -> Coordination:
    r"""Return contact numbers that cover the same solid angle of every grain, with a rattler cut.

    .. math:: c(R) \int \Omega(R, R')\, Q(R')\, dR' = \text{const}, \qquad
        Q(R) = \frac{c(R) P(R)}{\int c P\, dR}

    Neighbours are drawn by their own contacts; grains that would have fewer than `least` take no
    part, and the others have six on average. All grains of one radius share one fate.

    Parameters
    ----------
    radius, share
        As for `mean_neighbour_contacts`.
    least : float
        Contacts of the last grains that take part [-].

    Returns
    -------
    Coordination

    Raises
    ------
    FitError
        When no grain keeps enough contacts.

    Examples
    --------
    >>> self_consistent_contacts(np.array([2.0]), np.array([1.0])).contacts.tolist()
    [6.0]
    """
    angles = solid_angle(radius[:, None], radius)
    contacts, bearing = np.full(radius.size, ISOSTATIC), np.ones(radius.size)
    for _ in range(_ITERATIONS):
        before = contacts * bearing
        touched = share * before
        wanted = 1.0 / (angles @ (touched / touched.sum()))
        bearing_share = share * bearing
        wanted *= ISOSTATIC * bearing_share.sum() / (bearing_share @ wanted)
        contacts = 0.5 * (contacts + wanted)
        bearing = (contacts >= least).astype(float)
        if not bearing.any():
            raise FitError(f"no grain of this grading would have {least:g} contacts")
        if np.abs(contacts * bearing - before).max() < _CONVERGED * contacts.max():
            break
    # A radius at the cut may come and go for ever; it has hardly any grains.
    return Coordination(contacts * bearing, bearing)


@dataclass(frozen=True)
class CoordinationModel:
    """A model of contact numbers, and how figures show it.

    Parameters
    ----------
    contacts : callable
        Takes radii and their shares of the number of grains, shape (K,); returns `Coordination`,
        or raises `FitError` where the model does not hold.
    label : str
        What figures call it.
    color, marker : str
    solutions : callable, optional
        Of a model that may have more than one: all of them, the one of `contacts` first.
    """

    contacts: Callable[[NDArray, NDArray], Coordination]
    label: str
    color: str
    marker: str
    solutions: Callable[[NDArray, NDArray], list[ParkingSolution]] | None = None


# Each with the name that tables give it.
MODELS = {
    "mean_neighbour": CoordinationModel(
        mean_neighbour_contacts,
        label="solid angle, mean neighbour",
        color="#c99a1a",
        marker="^",
    ),
    "surface": CoordinationModel(
        surface_contacts, label="Bouvard-Lange", color="#9aa5b1", marker="v"
    ),
    "self_consistent": CoordinationModel(
        self_consistent_contacts,
        label="self-consistent, rattler cut",
        color="#8a5aa5",
        marker="D",
    ),
    "parking": CoordinationModel(
        parking_contacts,
        label="random parking",
        color="#3a7d44",
        marker="o",
        solutions=parking_solutions,
    ),
    "rods": CoordinationModel(rod_contacts, label="rods that push", color="#14a0bd", marker="X"),
}
