"""What holds crushing back: when C may grow, for every form of the model.

A resistance says at which elastic strain the grains of a grading begin to crush further.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.curves import UNCHANGED, Curve
from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm

# Where a yield strain is sought: elastic strains that no contact law is meant to leave.
_LEAST, LARGEST = 1e-8, 0.5
_STEPS, _BETWEEN = 161, 16
# How far below the resistance, of it, the force may be at a look and above it next to that.
_NEARLY = 0.05
_MOST_SEARCHES, _ROUNDING = 100, 4e-16


class Resistance(Protocol):
    """A condition for C to grow; strains and C are of any shape."""

    def excess(
        self, strain: ArrayLike, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity
    ) -> NDArray:
        """Return a number that is above 0 where C grows at a total strain, and 0 on its limit."""

    def yield_strain(self, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity) -> NDArray:
        """Return the least elastic strain at which C grows [-]; infinite where it never does."""

    def critical_force(
        self, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity
    ) -> NDArray:
        """Return the driving force at which C grows [J/m3]."""

    @property
    def knots(self) -> NDArray:
        """C between which it is smooth [-]."""


@dataclass(frozen=True)
class CriticalEnergy:
    r"""Crushing begins where the energy that it sets free reaches a critical one.

    .. math:: E_C = \frac{E_{c0}}{(1 - C)^s}

    s = 2 is Einav's (1 - C)^2 E_C = E_c0, and s = 0 a constant.

    Parameters
    ----------
    energy : float
        E_c0, above 0 [J/m3].
    hardening : float
        s, 0 or more [-].

    Raises
    ------
    ValueError
        For values outside of these.

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> paper, law = ModelForm(LinearCurve(0.5)), PowerLawElasticity(2.0, 1.0)
    >>> float(CriticalEnergy(0.005, 2.0).yield_strain(0.0, paper, law).round(12))
    0.1
    """

    energy: float
    hardening: float

    def __post_init__(self) -> None:
        if not (0 < self.energy < np.inf and 0 <= self.hardening < np.inf):
            raise ValueError(f"critical energy above 0 and hardening from 0 on, finite: {self}")

    def resistance(self, crushing: ArrayLike) -> NDArray:
        """Return E_c at C.

        Parameters
        ----------
        crushing : array_like
            C, any shape [-].

        Returns
        -------
        ndarray
            [J/m3]; infinite at C = 1 if it hardens.
        """
        left = np.subtract(1.0, crushing) ** self.hardening
        return np.divide(self.energy, left, out=np.full_like(left, np.inf), where=left > 0.0)

    def critical_force(
        self, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity
    ) -> NDArray:
        """Return `resistance`, whatever the form and the elastic law."""
        return self.resistance(crushing)

    @property
    def knots(self) -> NDArray:
        """The beginning: at C = 1 it is infinite."""
        return np.array([0.0])

    def excess(
        self, strain: ArrayLike, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity
    ) -> NDArray:
        r"""Return by how much the driving force is above the resistance.

        .. math:: E_C\, (1 - C)^s / E_{c0} - 1

        Parameters
        ----------
        strain, crushing : array_like
            eps, total, and C, any shape [-].
        form : ModelForm
        elasticity : Elasticity

        Returns
        -------
        ndarray
            [-]; -1 where the resistance is infinite, however large the force.
        """
        left = np.subtract(1.0, crushing) ** self.hardening
        # The force may be infinite there too, of what comes to an end with a jerk.
        force = form.driving_force(strain, np.where(left > 0.0, crushing, 0.0), elasticity)
        return force * left / self.energy - 1.0

    def yield_strain(self, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity) -> NDArray:
        """Return the least elastic strain at which C grows.

        Parameters
        ----------
        crushing : array_like
            C, any shape, below 1 [-].
        form : ModelForm
        elasticity : Elasticity

        Returns
        -------
        ndarray
            eps_e [-]; infinite where the driving force stays too small up to 0.5.
        """
        crushing = np.asarray(crushing, float)
        at = crushing.reshape(-1)
        steps = _steps(elasticity.knots)

        def excess(elastic: NDArray, at: NDArray) -> NDArray:
            return self.excess(form.total_strain(elastic, at), at, form, elasticity)

        looks = excess(steps, at[:, None])
        rows, first = np.arange(at.size), np.maximum((looks > 0.0).argmax(axis=1), 1)
        before = np.array([steps[first - 1], looks[rows, first - 1]])
        after = np.array([steps[first], looks[rows, first]])
        self._look_between(excess, at, steps, looks, before, after)
        # What yields at once has no ends to search between.
        at_once = looks[:, 0] > 0.0
        yields = (after[1] > 0.0) & ~at_once
        result = np.full(at.size, np.inf)
        if yields.any():
            ends = [(np.log(end[0, yields]), end[1, yields]) for end in (before, after)]
            roots = _roots(lambda logs: excess(np.exp(logs), at[yields]), *ends)
            result[yields] = np.exp(roots)
        result[at_once] = _LEAST
        return result.reshape(crushing.shape)

    @staticmethod
    def _look_between(
        excess: Callable[[NDArray, NDArray], NDArray],
        at: NDArray,
        steps: NDArray,
        looks: NDArray,
        before: NDArray,
        after: NDArray,
    ) -> None:
        """Move the ends of the search to where the force is above the resistance within a step.

        Of a law that passes measured states there may be more than one peak.
        """
        inner = looks[:, 1:-1]
        peaks = (inner >= looks[:, :-2]) & (inner >= looks[:, 2:])
        # Farther below it is no question of where one looks.
        hidden = peaks & (inner <= 0.0) & (inner > -_NEARLY)
        hidden &= ~np.maximum.accumulate(looks[:, 1:-1] > 0.0, axis=1)
        while (rows := np.flatnonzero(hidden.any(axis=1))).size:
            from scipy.optimize.elementwise import find_minimum  # slow to import

            peak = 1 + hidden[rows].argmax(axis=1)
            around = [steps[peak + side] for side in (-1, 0, 1)]
            found = find_minimum(lambda *args: -excess(*args), tuple(around), args=(at[rows],))
            hidden[rows, peak - 1] = False
            above = -found.f_x > 0.0
            rows, peak = rows[above], peak[above]
            before[:, rows] = steps[peak - 1], looks[rows, peak - 1]
            after[:, rows] = found.x[above], -found.f_x[above]
            hidden[rows] = False


def _steps(knots: NDArray) -> NDArray:
    """Return the elastic strains at which the force is looked at, by the knots of the law."""
    steps = np.geomspace(_LEAST, LARGEST, _STEPS)
    knots = knots[knots > _LEAST]
    if knots.size < 2:
        return steps
    # Between measured states the force may have a peak each, nearer to each other than a step.
    inner = [np.geomspace(*ends, _BETWEEN + 1) for ends in pairwise(knots)]
    return np.union1d(steps, np.concatenate(inner))


def _roots(
    function: Callable[[NDArray], NDArray],
    before: tuple[NDArray, NDArray],
    after: tuple[NDArray, NDArray],
) -> NDArray:
    """Return where a function is 0, each between two places and values of other signs.

    Regula falsi, Illinois. scipy's search for many roots at once takes six times as long, nearly
    all of it for things other than the function, and it is most of what a history takes.
    """
    (low, low_value), (high, high_value) = before, after
    for _ in range(_MOST_SEARCHES):
        middle = high - high_value * (high - low) / (high_value - low_value)
        value = function(middle)
        stays = np.sign(value) == np.sign(high_value)
        low = np.where(stays, low, high)
        low_value = np.where(stays, 0.5 * low_value, high_value)
        moved, high, high_value = np.abs(middle - high), middle, value
        if (moved <= _ROUNDING * np.abs(high)).all():
            break
    return high


@dataclass(frozen=True)
class ElasticStrainLimit:
    r"""Crushing holds the elastic strain at a value of its own, as crushing grains do.

    .. math:: \epsilon_e = \epsilon_0\, \left(\frac{d_Q}{d_{Q0}}\right)^x

    x = 1 - b with a constant stiffness and -2b/3 with Hertz's contacts, where b is the exponent
    with which strength falls with size and d_Q the mean diameter of the ends of contacts.

    Parameters
    ----------
    strain : float
        eps_0, from above 0 to 0.5 [-].
    change : Curve
        (d_Q/d_Q0)^x [-].

    Raises
    ------
    ValueError
        For a strain outside of these.

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> any_form, any_law = ModelForm(LinearCurve(0.5)), PowerLawElasticity(2.0, 1.0)
    >>> limit = ElasticStrainLimit(0.0125, LinearCurve(0.5))
    >>> limit.yield_strain([0.0, 1.0], any_form, any_law).tolist()
    [0.0125, 0.00625]
    """

    strain: float
    change: Curve = UNCHANGED

    def __post_init__(self) -> None:
        if not 0 < self.strain <= LARGEST:
            raise ValueError(f"an elastic strain from 0 to {LARGEST:g}: {self.strain:g}")

    def excess(
        self, strain: ArrayLike, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity
    ) -> NDArray:
        """Return by how much the elastic strain is above its limit, as `CriticalEnergy.excess`."""
        return (
            form.elastic_strain(strain, crushing) / self.yield_strain(crushing, form, elasticity)
            - 1.0
        )

    def yield_strain(self, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity) -> NDArray:
        """Return the elastic strain at which C grows, as `CriticalEnergy.yield_strain` does."""
        return self.strain * self.change.value(crushing)

    def critical_force(
        self, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity
    ) -> NDArray:
        """Return the driving force at the limit, which is what the grains must resist with."""
        elastic = self.yield_strain(crushing, form, elasticity)
        strain = form.total_strain(elastic, crushing)
        return form.driving_force(strain, crushing, elasticity)

    @property
    def knots(self) -> NDArray:
        """Those of the change."""
        return self.change.knots
