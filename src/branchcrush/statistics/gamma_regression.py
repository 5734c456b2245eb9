"""Regression of broad, positive energies: gamma-distributed about a mean, with a logarithmic link.

What the interval and the test on seeds left out need is kept for each seed, so both cost little
more than one fit.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import FitError
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import interval_of_refits, seed_draws

# Of parameters and columns: eta of each branch and its derivatives. Of None: where to start.
Design = Callable[..., Any]
# The columns that a design takes, and last the energies.
Seed = Sequence[ArrayLike]

_ITERATIONS = 100
_CONVERGED = 1e-8
# Columns less apart than this, relative, cannot be told from each other.
_INDEPENDENT = 1e-9
# By how much parameters are shifted for the second derivatives of a design that is not linear.
_SHIFT = 1e-4
# How many branches are taken at a time: what is made of them stays in the processor's cache.
_PIECE = 1 << 14


class GammaFit(NamedTuple):
    """A fit to all seeds, and what each of them adds at the fitted parameters."""

    parameters: np.ndarray  # the first is the logarithm of the scale, shape (p,)
    scores: np.ndarray  # shape (S, p)
    # Minus the derivatives of the scores by the parameters, shape (S, p, p).
    information: np.ndarray
    # Sums over the branches of the second derivatives of eta, 0 where it is linear, (S, p, p).
    bends: np.ndarray


def gamma_fit(seeds: Sequence[Seed], design: Design, start: ArrayLike | None = None) -> GammaFit:
    r"""Fit mean energies to all branches of all seeds at once.

    .. math:: \sum_b \left(\frac{E_b}{e^{\eta_b}} - 1\right) \frac{\partial \eta_b}
        {\partial \theta} = 0

    Every branch counts alike, whatever its energy: the variance is taken to go as the square of
    the mean, whatever the shape of the distribution.

    Parameters
    ----------
    seeds : list of tuple
        For each seed the arrays that the design takes, and last the energies [any one unit]; all
        of shape (M,).
    design : callable
        Takes the parameters and slices of these arrays; returns eta, shape (m,), and its
        derivatives by the parameters, shape (m, p). The first derivative is 1. Without parameters
        (None) it returns where to start.
    start : array_like, shape (p,), optional

    Returns
    -------
    GammaFit

    Raises
    ------
    FitError
        When the branches do not tell the parameters apart, or the fit does not settle.

    Examples
    --------
    >>> x = np.log([1.0, 2.0, 4.0])
    >>> line = lambda theta, x: (theta[0] + theta[1] * x, np.stack([np.ones_like(x), x], axis=1))
    >>> gamma_fit([(x, [5.0, 40.0, 320.0])], line, [0.0, 1.0]).parameters.round(9).tolist()
    [1.609437912, 3.0]

    References
    ----------
    McCullagh and Nelder (1989), Generalized Linear Models, chapter 8.
    """
    branches = _as_arrays(seeds)
    step, theta, scores, information = _settled(branches, design, start)
    return GammaFit(theta + step, scores, *_curved(branches, design, theta, information))


def fitted_parameters(
    seeds: Sequence[Seed], design: Design, start: ArrayLike | None = None
) -> NDArray:
    """Return the parameters of `gamma_fit` alone: all that a judgement of other seeds needs.

    Parameters
    ----------
    seeds, design, start
        As for `gamma_fit`.

    Returns
    -------
    ndarray, shape (p,)

    Raises
    ------
    FitError
        As `gamma_fit`.

    Examples
    --------
    >>> x = np.log([1.0, 2.0, 4.0])
    >>> line = lambda theta, x: (theta[0] + theta[1] * x, np.stack([np.ones_like(x), x], axis=1))
    >>> fitted_parameters([(x, [5.0, 40.0, 320.0])], line, [0.0, 1.0]).round(9).tolist()
    [1.609437912, 3.0]
    """
    step, theta, _, _ = _settled(_as_arrays(seeds), design, start)
    return theta + step


def _as_arrays(seeds: Sequence[Seed]) -> list[tuple[NDArray, ...]]:
    return [tuple(np.asarray(column, dtype=float) for column in seed) for seed in seeds]


def _settled(
    seeds: list[tuple[NDArray, ...]], design: Design, start: ArrayLike | None
) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """Return the last step and where it was made, with the sums of the seeds there."""
    energies = [seed[-1] for seed in seeds]
    number = sum(energy.size for energy in energies)
    total = sum(energy.sum() for energy in energies)
    if not (number and total > 0.0 and np.isfinite(total)):
        raise FitError("a fit needs branches that carry finite energy")
    theta = np.array(design(None) if start is None else start, dtype=float)
    if start is None:
        theta[0] = np.log(total / number)
    best = np.inf
    step = np.zeros(theta.size)
    for _ in range(_ITERATIONS):
        loss, scores, information = _sums(seeds, design, theta)
        if not loss <= best + 1e-12 * abs(best):  # a step too far, or not a number
            step /= 2.0
            theta = theta - step
            continue
        best = loss
        whole = information.sum(axis=0)
        step = _solved(whole, scores.sum(axis=0))
        step *= min(1.0, 2.0 / np.abs(step).max(initial=1e-300))
        if np.abs(step).max() < _CONVERGED:
            return step, theta, scores, information
        theta = theta + step
    raise FitError("the fit did not settle: too few branches carry energy")


def _solved(information: NDArray, score: NDArray) -> NDArray:
    """Return the step of Newton's method; refuse where branches do not tell parameters apart."""
    scale = np.sqrt(np.diag(information))
    if not np.all(scale > 0.0):
        raise FitError("the branches do not tell the parameters apart")
    relative = information / np.outer(scale, scale)
    values, vectors = np.linalg.eigh(relative)
    if values[0] < _INDEPENDENT * values[-1]:
        raise FitError("the branches do not tell the parameters apart")
    return vectors @ ((vectors.T @ (score / scale)) / values) / scale


def _sums(
    seeds: Sequence[tuple[NDArray, ...]], design: Design, theta: NDArray
) -> tuple[float, NDArray, NDArray]:
    """Return the loss, sum of eta + E exp(-eta), and score and information of each seed."""
    loss, scores = 0.0, np.zeros((len(seeds), theta.size))
    information = np.zeros((len(seeds), theta.size, theta.size))
    with np.errstate(over="ignore", invalid="ignore"):  # a step too far is taken back
        for number, (*columns, energy) in enumerate(seeds):
            for piece in _pieces(energy.size):
                eta, slope = design(theta, *(column[piece] for column in columns))
                ratio = energy[piece] * np.exp(-eta)
                loss += eta.sum() + ratio.sum()
                scores[number] += (ratio - 1.0) @ slope
                # Column by column: a product of both is slow where the rows are short.
                weighted = np.empty_like(slope)
                for k in range(theta.size):
                    np.multiply(slope[:, k], ratio, out=weighted[:, k])
                information[number] += weighted.T @ slope
    return loss, scores, information


def _curved(
    seeds: Sequence[tuple[NDArray, ...]], design: Design, theta: NDArray, information: NDArray
) -> tuple[NDArray, NDArray]:
    """Return information and bends, the second derivatives of eta taken into account."""
    bends = np.zeros_like(information)
    *columns, _ = max(seeds, key=lambda seed: seed[-1].size)
    columns = [column[:_PIECE] for column in columns]
    if np.array_equal(design(theta, *columns)[1], design(theta + _SHIFT, *columns)[1]):
        return information, bends
    information = information.copy()
    for k in range(1, theta.size):
        shift = _SHIFT * (np.arange(theta.size) == k)
        (_, below, less), (_, above, more) = (
            _sums(seeds, design, theta + side * shift) for side in (-1.0, 1.0)
        )
        information[:, :, k] = (below - above) / (2.0 * _SHIFT)
        bends[:, :, k] = ((more[:, 0] - above) - (less[:, 0] - below)) / (2.0 * _SHIFT)
    return _symmetric(information), _symmetric(bends)


def _symmetric(matrices: NDArray) -> NDArray:
    return (matrices + np.swapaxes(matrices, 1, 2)) / 2.0


def _pieces(number: int) -> Iterator[slice]:
    return (slice(start, start + _PIECE) for start in range(0, number, _PIECE))


def parameter_intervals(
    fit: GammaFit,
    transform: Callable[[NDArray], NDArray] | None = None,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> Interval:
    r"""Return the parameters with their intervals from resampling seeds.

    .. math:: \theta^* = \hat\theta + (\ln\rho, 0, \ldots)
        + \Bigl(\sum_s w_s A_s(\rho)\Bigr)^{-1} \sum_s w_s g_s(\rho), \qquad
        \rho = \frac{\sum_s w_s \sum_b E_b e^{-\eta_b}}{\sum_s w_s M_s}

    w_s says how often seed s is drawn. The scale of the draw comes first, exactly: seeds may
    differ in it by far. From there it is one step of Newton's method towards the fit of the draw;
    g_s is the score of seed s and A_s its information, with all means times rho.

    Parameters
    ----------
    fit : GammaFit
    transform : callable, optional
        What is wanted of the parameters: takes shape (draws, p), returns (draws, q).
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    Interval
        Arrays of shape (p,), or (q,).

    Examples
    --------
    >>> constant = lambda theta, x: (theta[0] + 0.0 * x, np.ones((x.size, 1)))
    >>> fit = gamma_fit([([0.0], [2.0]), ([0.0], [2.0])], constant, [0.0])
    >>> mean = parameter_intervals(fit, np.exp, rng=np.random.default_rng(1))
    >>> [round(float(value[0]), 6) for value in mean]
    [2.0, 2.0, 2.0]

    References
    ----------
    McCullagh and Nelder (1989), Generalized Linear Models, chapter 8, for score and information.
    """
    wanted = transform if transform is not None else (lambda theta: theta)
    estimate = wanted(fit.parameters[None])[0]
    seeds = len(fit.scores)
    if seeds == 1:
        return interval_of_refits(estimate, [], seeds, confidence)
    drawn = seed_draws(seeds, resamples, rng)
    scores, information, bends = (np.tensordot(drawn, sums, axes=1) for sums in fit[1:])
    # Sums of the derivatives of eta, times E exp(-eta) and times 1: the first ones of E exp(-eta)
    # and of 1, as the first derivative is 1.
    weighted, plain = information[:, 0], information[:, 0] - scores
    held = weighted[:, 0] > 0.0  # a draw without energy has no estimate
    scale = np.where(held, weighted[:, 0], 1.0) / np.where(held, plain[:, 0], 1.0)
    scores = weighted / scale[:, None] - plain
    information = (information - bends) / scale[:, None, None] + bends
    # The pseudo-inverse: a draw may lack the branches that tell parameters apart.
    steps = (np.linalg.pinv(information, hermitian=True) @ scores[..., None])[..., 0]
    steps[:, 0] += np.log(scale)
    steps[~held] = np.nan
    return interval_of_refits(estimate, wanted(fit.parameters + steps), seeds, confidence)


def deviance(seed: Seed, design: Design, parameters: ArrayLike) -> float:
    r"""Return the gamma deviance of a seed's energies from fitted means.

    .. math:: D = 2 \sum_b \left[\frac{E_b}{\mu_b} - 1 - \ln\frac{E_b}{\mu_b}\right]

    Parameters
    ----------
    seed : tuple of array_like
        As one of `gamma_fit`; energies above 0.
    design : callable
        As of `gamma_fit`.
    parameters : array_like, shape (p,)

    Returns
    -------
    float
        Never negative [-].

    Examples
    --------
    >>> constant = lambda theta, x: (theta[0] + 0.0 * x, np.ones((x.size, 1)))
    >>> deviance((np.array([0.0]), np.array([2.0])), constant, [np.log(2.0)])
    0.0
    """
    *columns, energy = (np.asarray(column, dtype=float) for column in seed)
    total = 0.0
    for piece in _pieces(energy.size):
        eta, _ = design(np.asarray(parameters), *(column[piece] for column in columns))
        logs = np.log(energy[piece]) - eta
        total += 2.0 * (np.expm1(logs) - logs).sum()
    return float(total)
