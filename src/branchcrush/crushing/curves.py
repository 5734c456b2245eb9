"""What changes with the crushing parameter C: values that are one at C = 0, with their slopes."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Curve(Protocol):
    """A positive function of C from 0 to 1 that is 1 at C = 0; C is of any shape."""

    def value(self, crushing: ArrayLike) -> NDArray:
        """Return the function at C [-]."""

    def log_slope(self, crushing: ArrayLike) -> NDArray:
        """Return the slope of its logarithm at C [-]."""

    @property
    def knots(self) -> NDArray:
        """C between 0 and 1, both with them, between which the function is smooth [-]."""


@dataclass(frozen=True)
class LinearCurve:
    r"""A function that falls or rises in proportion to C.

    .. math:: 1 - \theta C

    Parameters
    ----------
    theta : float
        Below 1; 0 is no change [-].

    Examples
    --------
    >>> curve = LinearCurve(0.5)
    >>> float(curve.value(0.5)), float(curve.log_slope(1.0))
    (0.75, -1.0)
    """

    theta: float

    def value(self, crushing: ArrayLike) -> NDArray:
        """Return 1 - theta C."""
        return 1.0 - np.multiply(self.theta, crushing)

    def log_slope(self, crushing: ArrayLike) -> NDArray:
        """Return -theta/(1 - theta C)."""
        return -self.theta / self.value(crushing)

    @property
    def knots(self) -> NDArray:
        """The ends."""
        return np.array([0.0, 1.0])


UNCHANGED = LinearCurve(0.0)


@dataclass(frozen=True)
class PorosityCurve:
    r"""The solid fraction at jamming when its porosity falls as a power of 1 - C.

    .. math:: \frac{1 - n_0 (1 - C)^u}{1 - n_0}

    Parameters
    ----------
    porosity : float
        n_0, at jamming before crushing, 0 to 1 [-].
    power : float
        u, above 0; the porosity itself is left at C = 1 only where u is small [-].

    Examples
    --------
    >>> curve = PorosityCurve(porosity=0.4, power=1.0)
    >>> float(curve.value(0.0)), round(float(curve.value(1.0)), 12)
    (1.0, 1.666666666667)

    References
    ----------
    Tengattini, Das and Einav (2016), Geotechnique 66, 695, doi 10.1680/jgeot.14.P.164: limits of
    the porosity that depend on breakage.
    """

    porosity: float
    power: float

    def value(self, crushing: ArrayLike) -> NDArray:
        """Return the solid fraction at jamming over that at C = 0."""
        left = np.subtract(1.0, crushing) ** self.power
        return (1.0 - self.porosity * left) / (1.0 - self.porosity)

    def log_slope(self, crushing: ArrayLike) -> NDArray:
        """Return the slope of its logarithm; that just below C = 1 for C = 1 itself."""
        # There it may be infinite.
        intact = np.maximum(np.subtract(1.0, crushing), np.finfo(float).epsneg)
        fall = self.porosity * self.power * intact ** (self.power - 1.0)
        return fall / (1.0 - self.porosity * intact**self.power)

    @property
    def knots(self) -> NDArray:
        """The ends."""
        return np.array([0.0, 1.0])


@dataclass(frozen=True)
class PairCurve:
    r"""Energy of pairs, per volume, in a mixture by mass of an initial and an ultimate grading.

    .. math:: \frac{(1-C)^2 + 2 (1-C) C x y + C^2 x^2 z}{1 - C + C x}

    Whatever all pairs have, one of them from either grading: the cross term is what a mixture of
    the two branch length densities, Eq. 7 of the paper, leaves out.

    Parameters
    ----------
    ends : float
        x, contact ends per mass of the ultimate grading over those of the initial one [-].
    cross, ultimate : float
        y and z, the mean energy of a pair with one grain and with both of the ultimate grading,
        over that of a pair of the initial one [-].

    Examples
    --------
    One grading on both sides changes nothing.

    >>> round(float(PairCurve(1.0, 1.0, 1.0).value(0.3)), 12)
    1.0
    >>> curve = PairCurve(ends=2.0, cross=0.5, ultimate=0.25)
    >>> float(curve.value(1.0)), float(curve.value(0.5))
    (0.5, 0.6666666666666666)
    """

    ends: float
    cross: float
    ultimate: float

    def value(self, crushing: ArrayLike) -> NDArray:
        """Return the energy at C over that at C = 0."""
        intact, crushed = np.subtract(1.0, crushing), np.multiply(self.ends, crushing)
        return self._pairs(intact, crushed) / (intact + crushed)

    def log_slope(self, crushing: ArrayLike) -> NDArray:
        """Return the slope of its logarithm."""
        intact, crushed = np.subtract(1.0, crushing), np.multiply(self.ends, crushing)
        pairs_slope = 2.0 * (
            -intact
            + self.cross * (self.ends * intact - crushed)
            + self.ultimate * self.ends * crushed
        )
        return pairs_slope / self._pairs(intact, crushed) - (self.ends - 1.0) / (intact + crushed)

    def _pairs(self, intact: NDArray, crushed: NDArray) -> NDArray:
        return intact**2 + 2.0 * self.cross * intact * crushed + self.ultimate * crushed**2

    @property
    def knots(self) -> NDArray:
        """C that crowd toward 0, where few of many finer grains change most."""
        halvings = max(np.ceil(np.log2(self.ends)), 0.0) + 3.0
        return np.append(0.0, 0.5 ** np.arange(halvings, -1.0, -1.0))


@dataclass(frozen=True)
class TabulatedCurve:
    """A function that is known at some C, from gradings or measured.

    Between them its logarithm is interpolated so that it rises and falls only where the values do.

    Parameters
    ----------
    crushing : tuple of float
        C, increasing from 0 to the last one known, at most 1 [-].
    values : tuple of float
        Above 0; they are divided by the first [any unit].

    Raises
    ------
    ValueError
        For other than two or more increasing C from 0 to at most 1 with positive values.

    Examples
    --------
    >>> curve = TabulatedCurve((0.0, 0.5, 1.0), (2.0, 4.0, 8.0))
    >>> round(float(curve.value(0.25)), 6), round(float(curve.log_slope(0.25)), 6)
    (1.414214, 1.386294)
    """

    crushing: tuple[float, ...]
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        known, values = np.array(self.crushing), np.array(self.values)
        rising = known.size >= 2 and known[0] == 0.0 and (np.diff(known) > 0).all()
        usable = rising and known[-1] <= 1.0 and values.shape == known.shape
        if not (usable and np.isfinite(values).all() and (values > 0).all()):
            raise ValueError("a curve needs values above 0 at two or more C that rise from 0 to 1")

    def value(self, crushing: ArrayLike) -> NDArray:
        """Return the value at C over that at C = 0."""
        return np.exp(self._logarithm[0](crushing))

    def log_slope(self, crushing: ArrayLike) -> NDArray:
        """Return the slope of its logarithm."""
        return self._logarithm[1](crushing)

    @property
    def knots(self) -> NDArray:
        """Where the function is known."""
        return np.array(self.crushing)

    @cached_property
    def _logarithm(self) -> tuple[Callable, Callable]:
        from scipy.interpolate import PchipInterpolator  # slow to import, and few jobs need it

        logs = np.log(np.divide(self.values, self.values[0]))
        curve = PchipInterpolator(self.crushing, logs)
        return curve, curve.derivative()
