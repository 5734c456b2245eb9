"""How many contacts a grain of a radius has, predicted from the grading alone.

Each model gives c(R), the mean number of contacts with other grains over **all** grains of that
radius, rattlers included, at the jamming point. None has a number fitted to a packing.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from branchcrush.errors import FitError
from branchcrush.packings.contacts import STABLE_CONTACTS

# Frictionless spheres are isostatic where they jam: six contacts a grain that carries load.
ISOSTATIC = 6.0
# Contacts that Bouvard and Lange give to a grain of no size: half of the isostatic number.
_SMALLEST = 3.0
# The share of a surface that discs cover when they are put there at random, one after another,
# until none fits any more.
PARKING_COVERAGE = 0.547
_ITERATIONS = 500
_CONVERGED = 1e-9


class Coordination(NamedTuple):
    """Contact numbers at some radii and the share of those grains that carry load."""

    contacts: np.ndarray  # c(R), over all grains of the radius, shape (K,) [-]
    load_bearing: np.ndarray  # share of the grains of the radius, shape (K,) [-]


def solid_angle(radius, neighbour):
    r"""Return the solid angle that a touching neighbour covers, seen from a grain's centre.

    .. math:: \Omega(R, R') = 2\pi\left[1 - \sqrt{1 - \left(\frac{R'}{R + R'}\right)^2}\right]

    Parameters
    ----------
    radius, neighbour : array_like
        R and R', broadcast [any one unit].

    Returns
    -------
    ndarray
        [sr]

    Examples
    --------
    >>> round(float(solid_angle(1.0, 1.0) / (4 * np.pi)), 4)  # 12 touching spheres cover 0.80
    0.067

    References
    ----------
    Suzuki and Oshima (1983), Powder Technology 35, 159.
    """
    ratio = np.asarray(neighbour) / (np.asarray(radius) + neighbour)
    return 2.0 * np.pi * (1.0 - np.sqrt(1.0 - ratio**2))


def mean_neighbour_contacts(radius, share):
    r"""Return contact numbers when every neighbour is of the mean radius.

    .. math:: c(R) \propto 1/\Omega(R, \langle R \rangle), \qquad \langle c \rangle = 6

    Parameters
    ----------
    radius, share : array_like, shape (K,)
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


def surface_contacts(radius, share):
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


def self_consistent_contacts(radius, share, least=STABLE_CONTACTS - 0.5):
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
        [-]

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


def parking_contacts(radius, share):
    r"""Return contact numbers of grains whose neighbours are parked at random on their surface.

    .. math:: \nu(R) = \frac{0.547 \cdot 4\pi}{\int \Omega(R, R')\, Q(R')\, dR'}, \qquad
        z \sim \mathrm{Bin}(\nu, p), \qquad c(R) = \sum_{z \ge 4} z\, \Pr(z)

    At most nu neighbours find room on a grain, as discs that are put on a surface at random cover
    0.547 of it. Each of them touches with one probability p, the same for all grains. A grain with
    fewer than four contacts is a rattler and its contacts carry nothing: so grains of one radius
    may carry load or not, and fines seldom do. Neighbours are drawn by their own contacts, Q = c
    P/kappa, and p follows from the isostatic six contacts of the grains that carry load. Between
    whole numbers nu is a mixture of the two next to it.

    Parameters
    ----------
    radius, share
        As for `mean_neighbour_contacts`.

    Returns
    -------
    Coordination

    Raises
    ------
    FitError
        When there is no room for six neighbours, or when the contact numbers do not settle, as
        with two sizes where the coarse ones are about to carry all the load.

    Examples
    --------
    >>> single = parking_contacts(np.array([2.0]), np.array([1.0]))
    >>> round(float(single.contacts[0] / single.load_bearing[0]), 6)
    6.0
    >>> round(1.0 - float(single.load_bearing[0]), 3)  # rattlers among equal spheres
    0.04

    References
    ----------
    Feder (1980), J. Theor. Biol. 87, 237, for the coverage; O'Hern, Silbert, Liu and Nagel (2003),
    Phys. Rev. E 68, 011306, for six contacts; in the spirit of Clusel, Corwin, Siemens and Brujic
    (2009), Nature 460, 611.
    """
    from scipy.optimize import brentq  # slow to import, and few jobs need it

    angles = solid_angle(radius[:, None], radius)
    contacts = ISOSTATIC * radius**2 / (share @ radius**2)
    for _ in range(_ITERATIONS):
        touched = share * contacts
        room = PARKING_COVERAGE * 4.0 * np.pi / (angles @ (touched / touched.sum()))

        def excess(touching, room=room):
            expected, bearing = _stable_binomial(room, touching)
            return share @ expected - ISOSTATIC * (share @ bearing)

        # With p almost 0, one contact for the largest, whoever has four contacts has no more. On
        # the way there may be no room.
        full = excess(1.0) <= 0.0
        touching = 1.0 if full else brentq(excess, 1.0 / room.max(), 1.0, xtol=1e-12)
        expected, bearing = _stable_binomial(room, touching)
        change = np.abs(expected - contacts).max()
        contacts = 0.5 * (contacts + expected)
        if change < _CONVERGED * contacts.max():
            if full:
                raise FitError("the grains of this grading have no room for six neighbours")
            return Coordination(expected, bearing)
    raise FitError("the contact numbers of this grading do not settle")


def _stable_binomial(room, touching):
    """Return the mean of z where z is four or more, and the chance of that; z binomial."""
    whole = np.floor(room)
    more = room - whole
    expected, bearing = np.zeros(room.size), np.zeros(room.size)
    for trials, weight in ((whole, 1.0 - more), (whole + 1.0, more)):
        z = np.arange(STABLE_CONTACTS)[:, None]
        chance = _binomial(trials, z, touching)
        bearing += weight * (1.0 - chance.sum(axis=0))
        expected += weight * (trials * touching - (z * chance).sum(axis=0))
    # Rounding may leave less than nothing.
    return np.maximum(expected, 0.0), np.clip(bearing, 0.0, 1.0)


def _binomial(trials, number, chance):
    """Return the probability of some successes out of so many trials."""
    from scipy.special import binom, xlog1py, xlogy  # slow to import, and few jobs need it

    logs = xlogy(number, chance) + xlog1py(np.maximum(trials - number, 0.0), -chance)
    return np.where(number <= trials, binom(trials, number) * np.exp(logs), 0.0)


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
    """

    contacts: Callable[[np.ndarray, np.ndarray], Coordination]
    label: str
    color: str
    marker: str


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
        parking_contacts, label="random parking", color="#3a7d44", marker="o"
    ),
}
