"""Contact numbers by random parking: as many neighbours as find room on a grain, some touching."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.coordination import Coordination
from branchcrush.branches.parking_places import PARKING_COVERAGE, Places
from branchcrush.errors import FitError
from branchcrush.gradings.rods import rod_map

# Probabilities to touch that are tried; with less, six contacts would need eleven places and more.
_TRIED = np.linspace(0.55, 1.0, 46)
# A trial begins with contacts as R^3, most of them on the coarse grains, and as R, on the fines.
_BEGINNINGS = (3, 1)
# It only has to tell on which side of six contacts it is, so few radii and iterations do.
_RADII, _ITERATIONS, _WITHIN = 100, 150, 1e-6
# Then the whole grading settles, from there.
_MOST, _SETTLED = 2000, 1e-11
# Contacts beyond six a grain that are none, over all contacts; at a jump more are left.
_NONE = 1e-7
# Trials whose contacts are less apart, over all contacts, lead to one solution.
_SAME_TRIAL, _SAME = 0.05, 1e-4
# And from one trial to the next more than this is a jump.
_JUMP = 0.3


class ParkingSolution(NamedTuple):
    """One way in which the grains of a grading may carry load by random parking."""

    name: str  # only; where there are more coarse, fine, and middle between them
    coordination: Coordination
    touching: float  # p, probability of a neighbour to touch [-]


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
        Of the first of `parking_solutions`.

    Raises
    ------
    FitError
        As `parking_solutions`.

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
    return parking_solutions(radius, share, coverage)[0].coordination


def parking_solutions(
    radius: NDArray, share: NDArray, coverage: float = PARKING_COVERAGE
) -> list[ParkingSolution]:
    r"""Return the stable solutions of random parking, the one that rods choose first.

    .. math:: x(p) = \sum_i w_i c_i - 6 \sum_i w_i \beta_i = 0

    Of some gradings there are two: in one the coarse grains alone carry load and the fines rattle
    among them, in the other the fines carry it too. Random parking does not say which is real; rods
    that push do: first comes the solution whose shares of grains that carry load, by number and by
    mass, are together nearer to theirs.

    Contact numbers settle at each p of a scan, from contacts as R^3, most of them on the coarse
    grains, and as R, on the fines; on either side of a jump they go on from those of the last p.
    Where x rises through zero, p is sought. Where x jumps over it there is no stable solution.

    Parameters
    ----------
    radius, share, coverage
        As for `parking_contacts`.

    Returns
    -------
    list of ParkingSolution
        One or two, seldom more.

    Raises
    ------
    FitError
        When there is no room for six neighbours, or no stable solution.

    Examples
    --------
    A fifth of the mass six times finer: fines in the pores of the coarse, or all of them together.

    >>> radius, mass = np.array([6.0, 1.0]), np.array([0.8, 0.2])
    >>> found = parking_solutions(radius, mass / radius**3 / (mass / radius**3).sum())
    >>> [(one.name, one.coordination.load_bearing.round(1).tolist()) for one in found]
    [('coarse', [1.0, 0.0]), ('fine', [1.0, 1.0])]
    """
    share = share / share.sum()
    grains = Places.of(radius, share, coverage)
    found: list[tuple[Coordination, float]] = []
    trials = _trials(radius, share, coverage)
    for guess, low, high in trials.rising:
        if any(_apart(guess, known.contacts, share) < _SAME_TRIAL for known, _ in found):
            continue
        solution = _isostatic(grains, guess, low, high)
        if solution and all(
            _apart(solution[0].contacts, known.contacts, share) > _SAME for known, _ in found
        ):
            found.append(solution)
    if not found:
        raise FitError(
            "random parking has no stable solution for this grading"
            if trials.enough
            else "the grains of this grading have no room for six neighbours"
        )
    return _named(found, radius, share)


class _Trials(NamedTuple):
    """What the scan of p says."""

    rising: list[tuple[NDArray, float, float]]  # contacts, and p below and above where x rises
    enough: bool  # whether there are six contacts a grain when all neighbours touch


def _trials(radius: NDArray, share: NDArray, coverage: float) -> _Trials:
    """Return where contact numbers of a few radii pass six for each grain that carries load."""
    order = np.argsort(radius)
    mass = share * radius**3
    both = np.cumsum((share + mass / mass.sum())[order]) / 2.0
    cell = np.empty(radius.size, dtype=int)
    cell[order] = np.unique((both * _RADII * (1.0 - 1e-12)).astype(int), return_inverse=True)[1]
    few_share = np.bincount(cell, share)
    few_radius = np.bincount(cell, share * radius) / few_share
    few = Places.of(few_radius, few_share, coverage)
    begun = np.stack([(few_radius / few_radius.max()) ** power for power in _BEGINNINGS], axis=1)
    settled = few.settled(
        np.repeat(begun, _TRIED.size, axis=1),
        np.tile(_TRIED, len(_BEGINNINGS)),
        _ITERATIONS,
        _WITHIN,
    )
    shape = (len(_BEGINNINGS), _TRIED.size)
    contacts = settled.contacts.T.reshape(*shape, -1)
    excess = settled.excess.reshape(shape)
    rising = []
    for here, over in zip(contacts, excess, strict=True):
        for number in range(_TRIED.size - 1):
            if over[number] < 0.0 <= over[number + 1]:
                rising.append((here[number + 1], number))
            if _apart(here[number], here[number + 1], few_share) > _JUMP:
                # Either side may go on beyond the jump, to where it passes six contacts.
                rising += _beyond(few, here[number], number, over[number] < 0.0, 1)
                rising += _beyond(few, here[number + 1], number + 1, over[number + 1] > 0.0, -1)
    return _Trials(
        [(guess[cell], float(_TRIED[low]), float(_TRIED[low + 1])) for guess, low in rising],
        bool((excess[:, -1] > 0.0).any()),
    )


def _beyond(
    grains: Places, contacts: NDArray, number: int, is_away: bool, step: int
) -> list[tuple[NDArray, int]]:
    """Return where contacts that go on beyond a jump pass six for each grain, if they do."""
    while is_away and 0 <= number + step < _TRIED.size:
        number += step
        touching = _TRIED[number : number + 1]
        settled = grains.settled(contacts[:, None], touching, _ITERATIONS, _WITHIN)
        before, contacts = contacts, settled.contacts[:, 0]
        if _apart(before, contacts, grains.share) > _JUMP:
            break
        if settled.excess[0] * step > 0.0:
            return [(contacts, number - 1 if step > 0 else number)]
    return []


def _isostatic(
    grains: Places, guess: NDArray, low: float, high: float
) -> tuple[Coordination, float] | None:
    """Return contact numbers and p that give six contacts near a guess; None where x jumps."""
    from scipy.optimize import brentq  # slow to import, and few jobs need it

    last = grains.settled(guess[:, None], np.array([high]), _MOST, _SETTLED)

    def excess(touching: float) -> float:
        nonlocal last
        last = grains.settled(last.contacts, np.array([touching]), _MOST, _SETTLED)
        return float(last.excess[0])

    # The whole grading may pass six a little beside its few radii.
    step = _TRIED[1] - _TRIED[0]
    if last.excess[0] < 0.0:
        low, high = high, min(high + step, 1.0)
    elif excess(low) > 0.0:
        low, high = low - step, low
    if excess(low) > 0.0 or excess(high) < 0.0:
        return None
    touching = brentq(excess, low, high, xtol=1e-13)
    left = excess(touching)
    if abs(left) > _NONE * (grains.share @ last.contacts[:, 0]):
        return None
    return Coordination(last.contacts[:, 0], last.load_bearing[:, 0]), touching


def _apart(contacts: NDArray, others: NDArray, share: NDArray) -> float:
    """Return how far contact numbers are apart, over all of the more."""
    more = max(share @ contacts, share @ others)
    return float(share @ np.abs(contacts - others) / more)


def _named(
    found: list[tuple[Coordination, float]], radius: NDArray, share: NDArray
) -> list[ParkingSolution]:
    """Return the solutions by their names, the one that rods choose first."""
    if len(found) == 1:
        return [ParkingSolution("only", *found[0])]
    mass = share * radius**3 / (share @ radius**3)
    pushed = rod_map(radius, share).load_bearing(radius)

    def from_rods(solution: ParkingSolution) -> float:
        more = solution.coordination.load_bearing - pushed
        return abs(share @ more) + abs(mass @ more)

    by_bearing = sorted(found, key=lambda one: float(share @ one[0].load_bearing))
    names = ["coarse", *["middle"] * (len(found) - 2), "fine"]
    named = [ParkingSolution(name, *one) for name, one in zip(names, by_bearing, strict=True)]
    return sorted(named, key=from_rods)
