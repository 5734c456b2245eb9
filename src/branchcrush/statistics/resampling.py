"""Intervals from resampling whole seeds: packings are independent, branches are not."""

from collections.abc import Callable
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.statistics.intervals import Interval, plain


class Resampling(IntEnum):
    """The random state of each kind of result: one and the same, so that it can be made again."""

    EXPONENTS = 20
    CONTACTS = 21
    PREDICTORS = 22
    SHARING = 23
    FINDINGS = 24
    CRUSHED = 25
    CRUSHED_GRAINS = 26

    def rng(self) -> np.random.Generator:
        """Return a generator at the beginning of this state's draws.

        Returns
        -------
        numpy.random.Generator
        """
        return np.random.default_rng(int(self))


def seed_draws(seeds: int, resamples: int, rng: np.random.Generator) -> NDArray:
    """Return how often each seed is in each draw of S seeds with replacement.

    Parameters
    ----------
    seeds : int
        S.
    resamples : int
    rng : numpy.random.Generator

    Returns
    -------
    ndarray of int, shape (resamples, S)

    Examples
    --------
    >>> seed_draws(3, 4, np.random.default_rng(1)).sum(axis=1).tolist()
    [3, 3, 3, 3]
    """
    return rng.multinomial(seeds, np.full(seeds, 1.0 / seeds), size=resamples)


def interval_of_refits(
    estimate: ArrayLike, refits: ArrayLike, seeds: int, confidence: float = 0.95
) -> Interval:
    r"""Return the interval of an estimate from those of draws of the seeds.

    .. math:: \hat\theta \pm t_{S-1}\, s_\theta \sqrt{S/(S-1)}

    s is the standard deviation of the refits. Student's t and the factor make up for how little
    S seeds tell of their own scatter.

    Parameters
    ----------
    estimate : float or array_like, shape (...)
    refits : array_like, shape (resamples, ...)
        nan where a draw has no estimate; left out. Fewer than two others have no interval.
    seeds : int
        S; with one seed the limits are nan.
    confidence : float
        Between 0 and 1 [-].

    Returns
    -------
    Interval

    Examples
    --------
    >>> low, high = interval_of_refits(2.0, [1.0, 3.0], 5)[1:]
    >>> round(high - 2.0, 3), round(2.0 - low, 3)
    (4.39, 4.39)

    References
    ----------
    Davison and Hinkley (1997), Bootstrap Methods and their Application, sections 2.3 and 3.8.
    """
    estimate, refits = np.asarray(estimate, dtype=float), np.asarray(refits, dtype=float)
    if seeds == 1:
        half = np.full(estimate.shape, np.nan)
    else:
        from scipy.special import stdtrit  # slow to import, and few jobs need it

        known = np.isfinite(refits)
        number = known.sum(axis=0)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = np.where(known, refits, 0.0).sum(axis=0) / number
            squares = np.where(known, (refits - mean) ** 2, 0.0).sum(axis=0)
            # Without refits too, 0/0: nan.
            error = np.sqrt(squares / np.maximum(number - 1.0, 0.0) * seeds / (seeds - 1.0))
        half = stdtrit(seeds - 1, (1.0 + confidence) / 2.0) * error
    return Interval(*(plain(value) for value in (estimate, estimate - half, estimate + half)))


def pooled_interval(
    sums: ArrayLike,
    statistic: Callable[[NDArray], NDArray],
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> Interval:
    r"""Return a statistic of sums over all seeds, with its interval from resampling seeds.

    .. math:: \hat\theta = T\Bigl(\sum_s x_s\Bigr)

    A mean is a ratio of sums, so are the mean energies of bins, and what is fitted to them.

    Parameters
    ----------
    sums : array_like, shape (S, ...)
        x_s, what each seed adds.
    statistic : callable
        T: takes sums of shape (draws, ...) and returns one estimate, or an array of them, a draw.
    confidence : float
        Between 0 and 1 [-].
    resamples : int
        Draws of S seeds.
    rng : numpy.random.Generator
        One seed needs none.

    Returns
    -------
    Interval

    Examples
    --------
    >>> heights = [[3.0, 2.0], [3.0, 2.0]]  # sum and number, of two seeds
    >>> mean = pooled_interval(heights, lambda x: x[:, 0] / x[:, 1], rng=np.random.default_rng(1))
    >>> tuple(mean)
    (1.5, 1.5, 1.5)
    """
    sums = np.asarray(sums, dtype=float)
    seeds = len(sums)
    estimate = statistic(sums.sum(axis=0)[None])[0]
    if seeds == 1:
        return interval_of_refits(estimate, [], seeds, confidence)
    drawn = np.tensordot(seed_draws(seeds, resamples, rng), sums, axes=1)
    return interval_of_refits(estimate, statistic(drawn), seeds, confidence)


def share_interval(
    sums: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> Interval:
    r"""Return shares of all seeds together, with intervals from resampling seeds inside 0 to 1.

    .. math:: \hat\theta = \sum_s k_s / \sum_s n_s

    A share of 0 or 1 in every seed does not scatter, which tells nothing of its error: the limits
    are nan there.

    Parameters
    ----------
    sums : array_like, shape (S, 2, ...)
        k_s and n_s of each seed.
    confidence, resamples, rng
        As for `pooled_interval`.

    Returns
    -------
    Interval
        nan where n is 0.

    Examples
    --------
    >>> tuple(share_interval([[0, 5], [0, 7]], rng=np.random.default_rng(1)))
    (0.0, nan, nan)
    >>> share_interval([[1, 5], [4, 5]], rng=np.random.default_rng(1))[1:]
    (0.0, 1.0)
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        share, low, high = pooled_interval(
            sums,
            lambda x: x[:, 0] / x[:, 1],
            confidence=confidence,
            resamples=resamples,
            rng=rng,
        )
    inside = (np.asarray(share) > 0.0) & (np.asarray(share) < 1.0)
    limits = (np.where(inside, np.clip(limit, 0.0, 1.0), np.nan) for limit in (low, high))
    return Interval(share, *(plain(limit) for limit in limits))
