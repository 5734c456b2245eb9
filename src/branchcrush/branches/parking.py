"""Contact numbers by random parking: as many neighbours as find room on a grain, some touching."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.coordination import ISOSTATIC, Coordination, solid_angle
from branchcrush.errors import FitError
from branchcrush.packings.contacts import STABLE_CONTACTS

# The share of a surface that discs cover when they are put there at random, one after another,
# until none fits any more.
PARKING_COVERAGE = 0.547
_ITERATIONS = 500
_CONVERGED = 1e-9


def parking_contacts(
    radius: NDArray, share: NDArray, coverage: float = PARKING_COVERAGE
) -> Coordination:
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
    radius, share : ndarray, shape (K,)
        Radii [any unit], and their shares of the number of grains [-].
    coverage : float
        Of a surface by its neighbours [-].

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
    angles = solid_angle(radius[:, None], radius)
    contacts = ISOSTATIC * radius**2 / (share @ radius**2)
    for _ in range(_ITERATIONS):
        touched = share * contacts
        room = coverage * 4.0 * np.pi / (angles @ (touched / touched.sum()))
        # On the way there may be no room, whether there is at the end counts.
        touching = _touching(room, share)
        expected, bearing = _stable_binomial(room, touching)
        change = np.abs(expected - contacts).max()
        contacts = 0.5 * (contacts + expected)
        if change < _CONVERGED * contacts.max():
            if touching == 1.0:
                raise FitError("the grains of this grading have no room for six neighbours")
            return Coordination(expected, bearing)
    raise FitError("the contact numbers of this grading do not settle")


def _touching(room: NDArray, share: NDArray) -> float:
    """Return p with which load-bearing grains have six contacts; 1 where there is no room."""
    from scipy.optimize import brentq  # slow to import, and few jobs need it

    def excess(touching: float) -> float:
        expected, bearing = _stable_binomial(room, touching)
        return share @ expected - ISOSTATIC * (share @ bearing)

    if excess(1.0) <= 0.0:
        return 1.0
    # With p almost 0, one contact for the largest, whoever has four contacts has no more.
    return brentq(excess, 1.0 / room.max(), 1.0, xtol=1e-12)


def _stable_binomial(room: NDArray, touching: float) -> tuple[NDArray, NDArray]:
    """Return the mean of z where z is four or more, and the chance of that; z binomial."""
    whole = np.floor(room)
    more = room - whole
    expected, bearing = np.zeros(room.size), np.zeros(room.size)
    for trials, weight in ((whole, 1.0 - more), (whole + 1.0, more)):
        fewer = np.arange(STABLE_CONTACTS)[:, None]
        chance = _binomial(trials, fewer, touching)
        bearing += weight * (1.0 - chance.sum(axis=0))
        expected += weight * (trials * touching - (fewer * chance).sum(axis=0))
    # Rounding may leave less than nothing.
    return np.maximum(expected, 0.0), np.clip(bearing, 0.0, 1.0)


def _binomial(trials: NDArray, number: NDArray, chance: float) -> NDArray:
    """Return the probability of some successes out of so many trials."""
    from scipy.special import binom, xlog1py, xlogy  # slow to import, and few jobs need it

    logs = xlogy(number, chance) + xlog1py(np.maximum(trials - number, 0.0), -chance)
    return np.where(number <= trials, binom(trials, number) * np.exp(logs), 0.0)
