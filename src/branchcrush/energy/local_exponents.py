"""The exponent of the energy along the branch length, and the same at equal ratio of the radii."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.energy.designs import LinearDesign, log_equality, log_length, prepared
from branchcrush.errors import FitError
from branchcrush.statistics.gamma_regression import gamma_fit, parameter_intervals
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import Resampling

_RANGES = 4
# Shares of the branches that are shorter than the first range, and than the end of the last.
_FIRST, _LAST = 0.05, 0.99
_BY_LENGTH = LinearDesign(lambda small, large: [log_length(small, large)], [3.0])
_AT_EQUAL_RATIO = LinearDesign(
    lambda small, large: [log_length(small, large), log_equality(small, large)], [3.0, 0.0]
)


@dataclass(frozen=True)
class LocalExponent:
    """The exponent of the energy in a range of branch length.

    Parameters
    ----------
    length_low, length_high : float
        Of the range, over R_max [-].
    branches : int
        In it.
    exponent : Interval
        n of the branches there [-].
    at_equal_ratio : Interval
        The same at equal ratio of the radii, q [-].
    """

    length_low: float
    length_high: float
    branches: int
    exponent: Interval
    at_equal_ratio: Interval

    def result(self) -> dict[str, Any]:
        """Return what `energy_split.json` holds of it."""
        return {
            "length_low_over_R_max": self.length_low,
            "length_high_over_R_max": self.length_high,
            "branches": self.branches,
            **self.exponent.named("exponent"),
            **self.at_equal_ratio.named("exponent_at_equal_ratio"),
        }

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "LocalExponent":
        """Return the exponent of which a file holds this.

        Parameters
        ----------
        result : mapping
            As `result` returns it, null where it has nan.

        Returns
        -------
        LocalExponent
        """
        return cls(
            result["length_low_over_R_max"],
            result["length_high_over_R_max"],
            result["branches"],
            Interval.read(result, "exponent"),
            Interval.read(result, "exponent_at_equal_ratio"),
        )


def local_exponents(
    seeds: Sequence[tuple[NDArray, ...]], *, confidence: float = 0.95, resamples: int = 2000
) -> tuple[LocalExponent, ...]:
    r"""Return the exponent in each of four equal ranges of branch length.

    .. math:: \langle E \rangle \sim l^{n_k}, \qquad
        \langle E \rangle \sim l^{q_k} \left(\frac{4 r_1 r_2}{l^2}\right)^{t_k}, \qquad
        l_k \le l \le l_{k+1}

    A power law would have one n_k. It changes where longer branches join grains that are more
    alike, or less; q_k, the exponent at equal ratio of the radii, leaves that out.

    Parameters
    ----------
    seeds, confidence, resamples
        As for `energy.predictors.compared_predictors`.

    Returns
    -------
    tuple of LocalExponent
        From the length that a twentieth of the branches is shorter than to that which a hundredth
        is longer than. nan where a range does not tell an exponent; empty where none does.

    Examples
    --------
    >>> log = np.linspace(-2.0, 0.0, 401)
    >>> seeds = [(log, log, np.exp(2.5 * log))] * 2  # equal radii, E ~ l^2.5
    >>> [round(part.exponent.estimate, 6) for part in local_exponents(seeds)]
    [2.5, 2.5, 2.5, 2.5]
    """
    lengths = [np.exp(log_length(small, large)) for small, large, _ in seeds]
    every = np.concatenate(lengths)
    if not every.size:
        return ()
    first, last = np.quantile(every, [_FIRST, _LAST])
    edges = np.linspace(first, last, _RANGES + 1)
    options = {"confidence": confidence, "resamples": resamples}
    found = []
    for low, high in pairwise(edges):
        inside = [(length >= low) & (length <= high) for length in lengths]
        part = [
            tuple(column[kept] for column in seed) for seed, kept in zip(seeds, inside, strict=True)
        ]
        exponents = (_exponent(part, design, options) for design in (_BY_LENGTH, _AT_EQUAL_RATIO))
        branches = sum(int(kept.sum()) for kept in inside)
        found.append(LocalExponent(float(low), float(high), branches, *exponents))
    return tuple(found) if any(np.isfinite(one.exponent.estimate) for one in found) else ()


def _exponent(
    seeds: Sequence[tuple[NDArray, ...]], design: LinearDesign, options: dict
) -> Interval:
    made, columns = prepared(design, seeds)
    try:
        fit = gamma_fit(columns, made)
    except FitError:  # one length, or one ratio at each length
        return Interval(*3 * [float("nan")])
    return parameter_intervals(fit, rng=Resampling.PREDICTORS.rng(), **options).part(1)


def trend(exponents: Sequence[Interval]) -> str:
    """Return in words how exponents change from the first to the last, beyond their intervals.

    Parameters
    ----------
    exponents : list of Interval
        nan where not known.

    Returns
    -------
    str
        What follows "it". Two differ if they are further apart than their half widths, added in
        squares: they are of different branches.

    Examples
    --------
    >>> trend([Interval(2.5, 2.2, 2.8), Interval(3.5, 3.2, 3.8), Interval(2.0, 1.7, 2.3)])
    'rises and then falls'
    >>> trend([Interval(2.5, 1.2, 3.8), Interval(3.5, 2.2, 4.8)])
    'does not change by more than the intervals allow'
    """
    known = [one for one in exponents if np.isfinite(one.low)]
    if len(known) < 2:
        return "has no intervals that could tell whether it changes"
    # Where each change is complete.
    rises: list[int] = []
    falls: list[int] = []
    for later, second in enumerate(known):
        for first in known[:later]:
            change = second.estimate - first.estimate
            if abs(change) > np.hypot(first.high - first.estimate, second.high - second.estimate):
                (rises if change > 0.0 else falls).append(later)
    if rises and falls:
        return "rises and then falls" if min(rises) < min(falls) else "falls and then rises"
    if rises or falls:
        return "rises" if rises else "falls"
    return "does not change by more than the intervals allow"
