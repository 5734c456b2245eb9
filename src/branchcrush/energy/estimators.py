"""The exponent n of one set of energies by several estimators, which weigh branches differently."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.energy.designs import log_length
from branchcrush.energy.predictors import BranchColumns
from branchcrush.errors import FitError
from branchcrush.statistics.bins import binned_sums
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import Resampling, pooled_interval

# In words, as pages show them; the first is that of `predictors`.
ESTIMATORS = {
    "gamma_regression": "gamma regression of all branches: each counts alike",
    "least_squares": "least squares on f(l), as the paper: the bins of high energy count",
    "log_log": "straight line through ln f and ln l, unweighted: the bins of few branches count",
}
_ITERATIONS = 200
_CONVERGED = 1e-10


def binned_estimators(
    seeds: Sequence[BranchColumns],
    edges: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
) -> dict[str, Interval]:
    r"""Return n by two fits to the means of the bins of branch length, every bin alike.

    .. math:: \min_{A, n} \sum_b (\bar E_b - A\, \bar l_b^{\,n})^2, \qquad
        \min_{A, n} \sum_b (\ln \bar E_b - \ln A - n \ln \bar l_b)^2

    The scale A is free, so the bin that f(l) is normalised with does not matter. Intervals are from
    resampling seeds; a draw in which fewer than two bins have branches has no n.

    Parameters
    ----------
    seeds : list of tuple
        From `energy.predictors.branch_columns`, of each seed.
    edges : array_like, shape (n+1,)
        Of the bins of branch length, over R_max [-].
    confidence : float
    resamples : int

    Returns
    -------
    dict of Interval
        least_squares and log_log.

    Raises
    ------
    FitError
        When fewer than two bins have branches.

    Examples
    --------
    >>> log = np.log([0.1, 0.2, 0.4])
    >>> seeds = [(log, log, np.array([1.0, 8.0, 64.0]))] * 2  # E ~ l^3
    >>> found = binned_estimators(seeds, [0.0, 0.3, 0.6, 1.0])
    >>> [round(interval.estimate, 9) for interval in found.values()]
    [3.0, 3.0]

    References
    ----------
    Paper, Eq. 26 and text before Fig. 5.
    """
    sums = np.array(
        [binned_sums(np.exp(log_length(small, large)), e, edges) for small, large, e in seeds]
    )
    whole = sums.sum(axis=0)
    filled = whole[0] > 0
    if filled.sum() < 2:
        raise FitError("an exponent needs branches in two bins of length")
    # The mean lengths of all seeds, as in `statistics.power_law.binned_exponent`.
    log = np.log(whole[1, filled] / whole[0, filled])
    energy_scale = whole[2].sum() / whole[0].sum()
    both = sums[:, ::2, filled]
    both[:, 1] /= energy_scale

    def exponents(totals: NDArray) -> NDArray:
        number, energy = totals[:, 0], totals[:, 1]
        used = number > 0.0
        mean = energy / np.where(used, number, 1.0)
        line = _log_log(log, mean, used)
        return np.stack([_least_squares(log, mean, used, line), line], axis=1)

    found = pooled_interval(
        both, exponents, confidence=confidence, resamples=resamples, rng=Resampling.EXPONENTS.rng()
    )
    return {"least_squares": found.part(0), "log_log": found.part(1)}


def _log_log(log: NDArray, mean: NDArray, used: NDArray) -> NDArray:
    """Return the slope of the line through the logarithms of each draw, bins alike."""
    weight = used & (mean > 0.0)
    number = np.maximum(weight.sum(axis=1, keepdims=True), 1)
    y = np.log(np.where(weight, mean, 1.0))
    centred = np.where(weight, log - (weight * log).sum(axis=1, keepdims=True) / number, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return (centred * y).sum(axis=1) / (centred**2).sum(axis=1)


def _least_squares(log: NDArray, mean: NDArray, used: NDArray, start: NDArray) -> NDArray:
    """Return the exponent of the least squares of each draw; Gauss and Newton's method.

    The scale is eliminated: for each exponent it is the best one.
    """
    exponent = np.where(np.isfinite(start), start, np.nan)
    for _ in range(_ITERATIONS):
        power = np.where(used, np.exp(exponent[:, None] * log), 0.0)
        norm = (power**2).sum(axis=1, keepdims=True)
        scale = (mean * power).sum(axis=1, keepdims=True) / norm
        slope = scale * power * log
        slope -= power * (power * slope).sum(axis=1, keepdims=True) / norm
        with np.errstate(invalid="ignore", divide="ignore"):
            step = (slope * (mean - scale * power)).sum(axis=1) / (slope**2).sum(axis=1)
        step = np.clip(step, -1.0, 1.0)
        exponent = exponent + step
        if not np.any(np.abs(step) > _CONVERGED):
            return exponent
    raise FitError("the least squares on f(l) did not settle: too few branches carry energy")
