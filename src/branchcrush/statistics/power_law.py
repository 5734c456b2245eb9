"""Power laws fitted to broad, positive data: one, or that of binned sums with its interval.

Where the data are broad at every abscissa (energies of branches have a coefficient of variation
of about 1), the power law is fitted as a mean of gamma-distributed values with a logarithmic link:
each counts alike, whatever its scale, and the amplitude is free.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import FitError
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import interval_of_refits, seed_draws

_ITERATIONS = 200
_CONVERGED = 1e-11
# How many branches the fit takes at a time: what it makes of them stays in the processor's cache.
_PIECE = 1 << 14


class PowerLaw(NamedTuple):
    """E(l) = amplitude (l/l_scale)^exponent; arrays when fitted to many data sets at once."""

    amplitude: float | np.ndarray
    exponent: float | np.ndarray


def power_law_fit(length: ArrayLike, energy: ArrayLike, weight: ArrayLike = 1.0) -> PowerLaw:
    r"""Fit E(l) = A l^n by gamma quasi-likelihood with a logarithmic link.

    .. math:: \sum_b w_b \left(\frac{E_b}{A l_b^n} - 1\right) (1,\ \ln l_b) = 0

    With single branches it is the gamma regression of all of them; with bin means weighted by
    their counts, the same fit to binned data. Lengths are scaled by their own mean inside, so
    that metres or millimetres give the same exponent.

    Parameters
    ----------
    length : array_like, shape (n,)
        [m]
    energy : array_like, shape (..., n)
        Mean energy at each length; leading axes are independent data sets [J].
    weight : array_like, broadcast to the shape of energy
        Number of branches behind each mean; 0 leaves a point out [-].

    Returns
    -------
    PowerLaw
        amplitude A such that E = A (l / 1 m)^n [J], and exponent n.

    Raises
    ------
    FitError
        When fewer than two lengths carry finite energy, or the fit does not converge.

    Examples
    --------
    >>> fit = power_law_fit([1.0, 2.0, 3.0], [5.0, 40.0, 135.0])
    >>> round(float(fit.amplitude), 9), round(float(fit.exponent), 9)
    (5.0, 3.0)

    References
    ----------
    McCullagh and Nelder (1989), Generalized Linear Models, chapter 8.
    """
    length, energy = np.asarray(length, dtype=float), np.asarray(energy, dtype=float)
    weight = np.broadcast_to(np.asarray(weight, dtype=float), energy.shape)
    lengths = np.broadcast_to(length, energy.shape)
    used = (weight > 0) & (energy > 0) & (length > 0)
    first = lengths.min(axis=-1, initial=np.inf, where=used)
    last = lengths.max(axis=-1, initial=-np.inf, where=used)
    if not np.all(np.isfinite(energy)) or np.any(first >= last):
        raise FitError("a power law needs finite energy at two or more branch lengths")
    scale = np.average(length, weights=weight.reshape(-1, length.size).sum(axis=0))
    x = np.log(length / scale)
    total = weight.sum(axis=-1)
    mean = (weight * x).sum(axis=-1) / total
    energy_scale = (weight * energy).sum(axis=-1) / total
    weighted = weight * energy / energy_scale[..., None]
    centred = x - mean[..., None]
    # Zero but for rounding, which is what it is here for.
    residue = (weight * centred).sum(axis=-1)

    # Newton's method on the deviance, which is convex in intercept and slope. Steps are bounded:
    # where a mean is far too high, its energy hardly counts and the full step overshoots.
    intercept, slope = np.zeros(total.shape), np.full(total.shape, 3.0)
    for _ in range(_ITERATIONS):
        zeroth, first, second = _moments(weighted, centred, intercept, slope)
        excess, tilt = zeroth - total, first - residue
        determinant = zeroth * second - first**2
        by_intercept = (second * excess - first * tilt) / determinant
        by_slope = (zeroth * tilt - first * excess) / determinant
        steps = np.clip([by_intercept, by_slope], -1.0, 1.0)
        intercept, slope = intercept + steps[0], slope + steps[1]
        if np.abs(steps).max() < _CONVERGED:
            break
    else:
        raise FitError("the power-law fit did not converge: too few branches carry energy")
    log_amplitude = intercept - slope * (mean + np.log(scale))
    return PowerLaw(energy_scale * np.exp(log_amplitude), slope)


def _moments(weighted: NDArray, centred: NDArray, intercept: NDArray, slope: NDArray) -> NDArray:
    """Return the sums over the points of w y exp(-a - b x) times 1, x and x^2."""
    sums = np.zeros((3, *slope.shape))
    for start in range(0, centred.shape[-1], _PIECE):
        x = centred[..., start : start + _PIECE]
        terms = np.exp(-intercept[..., None] - slope[..., None] * x)
        terms *= weighted[..., start : start + _PIECE]
        for order in range(3):
            sums[order] += terms.sum(axis=-1)
            terms *= x
    return sums


def binned_exponent(
    sums: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> tuple[PowerLaw, Interval]:
    r"""Return the exponent of the binned energies of all seeds, with its confidence interval.

    .. math:: \sum_b N_b \left(\frac{\bar E_b}{A\, \bar l_b^{\,n}} - 1\right)
        (1,\ \ln \bar l_b) = 0

    Branches of one packing share one force network and are not independent, so whole seeds are
    drawn with replacement and refitted: `statistics.resampling.interval_of_refits`.

    Parameters
    ----------
    sums : array_like, shape (S, 3, n)
        `statistics.bins.binned_sums` of each seed.
    confidence : float
    resamples : int
        Draws of S seeds.
    rng : numpy.random.Generator
        One seed needs none.

    Returns
    -------
    fit : PowerLaw
        Of all seeds together.
    exponent : Interval
        nan limits with one seed.

    Raises
    ------
    FitError
        As `power_law_fit`.

    Examples
    --------
    >>> sums = [[[9.0, 4.0], [9.0, 8.0], [9.0, 32.0]]] * 3
    >>> fit, exponent = binned_exponent(sums, rng=np.random.default_rng(1))
    >>> [round(float(value), 6) for value in exponent]
    [3.0, 3.0, 3.0]
    """
    sums = np.asarray(sums, dtype=float)
    seeds = len(sums)
    counts, lengths, energies = sums.sum(axis=0)
    filled = counts > 0
    length = lengths[filled] / counts[filled]
    fit = power_law_fit(length, energies[filled] / counts[filled], counts[filled])
    if seeds == 1:
        return fit, interval_of_refits(fit.exponent, [], seeds, confidence)
    draws = seed_draws(seeds, resamples, rng)
    drawn_counts = draws @ sums[:, 0, filled]
    drawn_energies = draws @ sums[:, 2, filled]
    means = drawn_energies / np.maximum(drawn_counts, 1.0)
    refits = power_law_fit(length, means, drawn_counts).exponent
    return fit, interval_of_refits(fit.exponent, refits, seeds, confidence)
