"""Estimates with their confidence intervals: names, columns and text."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

# What ends the name of an estimate, of its lower and of its upper limit.
LIMITS = ("", "_low", "_high")


def interval_names(name: str) -> tuple[str, ...]:
    """Return the names under which tables and results hold an estimate and its two limits.

    Parameters
    ----------
    name : str
        Of the estimate.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> interval_names("exponent")
    ('exponent', 'exponent_low', 'exponent_high')
    """
    return tuple(name + limit for limit in LIMITS)


class Interval(NamedTuple):
    """An estimate and its confidence interval; low and high are nan when there is none.

    Numbers, or arrays of one shape when many quantities are estimated at once.

    Examples
    --------
    >>> Interval(3.0, 2.5, 3.5).named("exponent")
    {'exponent': 3.0, 'exponent_low': 2.5, 'exponent_high': 3.5}
    >>> Interval(np.array([1.0, 2.0]), np.array([0.0, 1.0]), np.array([2.0, 3.0])).part(1)
    Interval(estimate=2.0, low=1.0, high=3.0)
    """

    estimate: float | np.ndarray
    low: float | np.ndarray
    high: float | np.ndarray

    def named(self, name: str) -> dict:
        """Return the three by their names in tables and results.

        Parameters
        ----------
        name : str
            Of the estimate.

        Returns
        -------
        dict
            As `interval_names` calls them.
        """
        return dict(zip(interval_names(name), self, strict=True))

    def part(self, place: Any) -> "Interval":
        """Return the interval of one quantity of many, or of some.

        Parameters
        ----------
        place : int, slice or array
            An index into the arrays.

        Returns
        -------
        Interval
        """
        return Interval(*(plain(np.asarray(values)[place]) for values in self))

    @property
    def is_wide(self) -> bool:
        """Whether it is wider than the estimate itself, which then is not told; not where unknown.

        Examples
        --------
        >>> Interval(3.0, 1.4, 4.6).is_wide, Interval(3.0, 1.6, 4.4).is_wide
        (True, False)
        """
        width = np.subtract(self.high, self.low)
        return bool(width > np.abs(self.estimate))

    @classmethod
    def read(cls, result: Mapping[str, Any], name: str) -> "Interval":
        """Return the interval that a result holds under a name.

        Parameters
        ----------
        result : mapping
            Has `interval_names` of the name, or not.
        name : str

        Returns
        -------
        Interval
            nan where the result has none, or None.

        Examples
        --------
        >>> Interval.read({"exponent": 3.0, "exponent_low": None}, "exponent")
        Interval(estimate=3.0, low=nan, high=nan)
        """
        values = (result.get(key) for key in interval_names(name))
        return cls(*(float("nan") if value is None else value for value in values))


def interval_text(estimate: float, low: float | None, high: float | None) -> str:
    """Return an estimate with its interval as text, as 3.06 (2.97 to 3.15).

    Parameters
    ----------
    estimate : float
    low, high : float or None
        None or nan where there is no interval.

    Returns
    -------
    str
        With two decimals.

    Examples
    --------
    >>> interval_text(3.0, 2.9, 3.1)
    '3.00 (2.90 to 3.10)'
    >>> interval_text(3.0, None, None)
    '3.00 (one seed: no interval)'
    """
    if low is None or low != low:
        return f"{estimate:.2f} (one seed: no interval)"
    return f"{estimate:.2f} ({low:.2f} to {high:.2f})"


def plain(values: Any) -> Any:
    """Return an array of no dimension as a number, and any other as it is.

    Parameters
    ----------
    values : float or ndarray

    Returns
    -------
    float or ndarray

    Examples
    --------
    >>> plain(np.array(3.0))
    3.0
    """
    return float(values) if np.ndim(values) == 0 else values
