"""Places for neighbours on the surfaces of grains, and how many of them are taken by contacts."""

from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.coordination import ISOSTATIC, solid_angle
from branchcrush.packings.contacts import STABLE_CONTACTS

# The share of a surface that discs cover when they are put there at random, one after another,
# until none fits any more.
PARKING_COVERAGE = 0.547
# With more places a grain has four contacts for sure, as a place is taken in every second case.
_MANY = 150
# Of the new contact numbers in each step.
_DAMPING = 0.5


class Settled(NamedTuple):
    """Contact numbers for some probabilities that a neighbour touches."""

    contacts: NDArray  # c, over all grains of a radius, shape (K, P) [-]
    load_bearing: NDArray  # share of the grains of a radius, shape (K, P) [-]
    excess: NDArray  # contacts beyond six for each grain that carries load, shape (P,) [-]


@dataclass(frozen=True)
class Places:
    r"""The places for neighbours on grains of some radii.

    .. math:: \nu_i = \frac{0.547 \cdot 4\pi}{\sum_j \Omega(R_i, R_j)\, Q_j}

    Parameters
    ----------
    share : ndarray, shape (K,)
        Of the number of grains [-].
    taken : ndarray, shape (K, K)
        Share of the room on a grain i that one neighbour j takes [-].
    """

    share: NDArray
    taken: NDArray

    @classmethod
    def of(cls, radius: NDArray, share: NDArray, coverage: float) -> Self:
        """Return the places on the grains of a grading.

        Parameters
        ----------
        radius, share : ndarray, shape (K,)
            Radii [any unit], and their shares of the number of grains [-].
        coverage : float
            Of a surface by its neighbours [-].

        Returns
        -------
        Places
        """
        return cls(share, solid_angle(radius[:, None], radius) / (coverage * 4.0 * np.pi))

    def settled(
        self, contacts: NDArray, touching: NDArray, iterations: int, within: float
    ) -> Settled:
        r"""Return the contact numbers that give themselves, from some to begin with.

        .. math:: c_i = \sum_{z \ge 4} z \Pr(z), \qquad z \sim \mathrm{Bin}(\nu_i(c), p), \qquad
            x = \sum_i w_i c_i - 6 \sum_i w_i \beta_i

        Parameters
        ----------
        contacts : ndarray, shape (K, P)
            To begin with, of any scale.
        touching : ndarray, shape (P,)
            p, probabilities of a neighbour to touch [-].
        iterations : int
            At most.
        within : float
            Change of the contacts of an iteration, over all contacts, that ends it [-].

        Returns
        -------
        Settled

        Examples
        --------
        Ten places, of which each second is taken.

        >>> equal, one = Places(np.ones(1), np.full((1, 1), 0.1)), np.ones((1, 1))
        >>> settled = equal.settled(one, np.array([0.5]), 99, 1e-9)
        >>> round(float(settled.load_bearing[0, 0]), 4)  # 1 - (1 + 10 + 45 + 120) / 2^10
        0.8281
        """
        tables = _Tables.of(touching)
        for _ in range(iterations):
            touched = self.share[:, None] * contacts
            all_contacts = touched.sum(axis=0)
            room = all_contacts / (self.taken @ touched)
            expected, bearing = tables.at(room)
            change = self.share @ np.abs(expected - contacts) / all_contacts
            contacts = contacts + _DAMPING * (expected - contacts)
            if change.max() < within:
                break
        return Settled(expected, bearing, self.share @ (expected - ISOSTATIC * bearing))


class _Tables(NamedTuple):
    """`stable_binomial` for some p, which is linear between whole numbers of places."""

    touching: NDArray  # shape (P,)
    values: NDArray  # mean and chance at whole numbers, shape (2, P * (_MANY + 1))
    steps: NDArray  # to the next whole number

    @classmethod
    def of(cls, touching: NDArray) -> Self:
        whole = np.arange(_MANY + 2.0)
        values = np.stack([stable_binomial(whole, p) for p in touching.tolist()], axis=1)
        steps = np.diff(values, axis=2)
        return cls(touching, values[:, :, :-1].reshape(2, -1), steps.reshape(2, -1))

    def at(self, room: NDArray) -> NDArray:
        """Return mean and chance for places on each grain and each p, shape (2, K, P)."""
        whole = np.minimum(room, float(_MANY)).astype(int)
        part = np.minimum(room - whole, 1.0)
        place = whole + np.arange(self.touching.size) * (_MANY + 1)
        taken = self.values[:, place] + part * self.steps[:, place]
        taken[0] = np.where(room > _MANY, room * self.touching, taken[0])
        return taken


def stable_binomial(trials: NDArray, touching: float) -> tuple[NDArray, NDArray]:
    """Return the mean of z where z is four or more, and the chance of that; z binomial.

    Parameters
    ----------
    trials : ndarray, shape (n,)
        Whole numbers.
    touching : float
        [-]

    Returns
    -------
    mean, chance : ndarray, shape (n,)

    Examples
    --------
    >>> mean, chance = stable_binomial(np.array([3.0, 4.0]), 0.5)
    >>> mean.tolist(), chance.tolist()
    ([0.0, 0.25], [0.0, 0.0625])
    """
    fewer = np.arange(STABLE_CONTACTS)[:, None]
    chance = _binomial(trials, fewer, touching)
    # Rounding may leave less than nothing.
    mean = np.maximum(trials * touching - (fewer * chance).sum(axis=0), 0.0)
    return mean, np.clip(1.0 - chance.sum(axis=0), 0.0, 1.0)


def _binomial(trials: NDArray, number: NDArray, chance: float) -> NDArray:
    """Return the probability of some successes out of so many trials."""
    from scipy.special import binom, xlog1py, xlogy  # slow to import, and few jobs need it

    logs = xlogy(number, chance) + xlog1py(np.maximum(trials - number, 0.0), -chance)
    return np.where(number <= trials, binom(trials, number) * np.exp(logs), 0.0)
