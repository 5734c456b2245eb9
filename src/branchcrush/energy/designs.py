"""Mean energies as functions of the two radii of a branch, in the form that the regression takes.

All are in logarithms of R/R_max.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class LinearDesign:
    """The design of a predictor that is linear in its parameters.

    Parameters
    ----------
    columns : callable
        Takes ln r_min and ln r_max, shape (M,); returns a column for each parameter after the
        scale.
    start : list of float
        Where these parameters start.

    Examples
    --------
    >>> design = LinearDesign(lambda small, large: [small], [2.0])
    >>> eta, slope = design(np.array([1.0, 3.0]), np.array([0.5]), np.array([0.7]))
    >>> design(None), eta.tolist(), slope.tolist()
    ([0.0, 2.0], [2.5], [[1.0, 0.5]])
    """

    columns: Callable[[NDArray, NDArray], Sequence[NDArray]]
    start: Sequence[float]

    def __call__(
        self, theta: NDArray | None, small: NDArray | None = None, large: NDArray | None = None
    ) -> Any:
        """Return eta and its slope, as `statistics.gamma_regression.gamma_fit` takes them."""
        if theta is None or small is None or large is None:
            return [0.0, *self.start]
        slope = self.slope(small, large)
        return slope @ theta, slope

    def slope(self, small: NDArray, large: NDArray) -> NDArray:
        """Return the derivatives of eta by the parameters, shape (M, p)."""
        return np.stack([np.ones_like(small), *self.columns(small, large)], axis=1)


def prepared(
    design: Callable[..., Any], seeds: Sequence[tuple[NDArray, ...]]
) -> tuple[Callable[..., Any], Sequence[tuple[NDArray, ...]]]:
    """Return a design and seeds that give the same fit, with what need be made only once made.

    A fit asks for the slope of a linear design several times, and it is made of logarithms.

    Parameters
    ----------
    design : callable
        As `statistics.gamma_regression.gamma_fit` takes it.
    seeds : list of tuple
        From `energy.predictors.branch_columns`, of each seed.

    Returns
    -------
    design : callable
    seeds : list of tuple

    Examples
    --------
    >>> reduced = LinearDesign(lambda small, large: [log_reduced_radius(small, large)], [2.0])
    >>> design, seeds = prepared(reduced, [(np.log([0.5]), np.log([0.5]), np.array([7.0]))])
    >>> slope, energy = seeds[0]
    >>> design(None), np.exp(slope[:, 1]).round(12).tolist(), energy.tolist()
    ([0.0, 2.0], [0.25], [7.0])
    """
    if not isinstance(design, LinearDesign) or not design.start:
        return design, seeds
    start = [0.0, *design.start]

    def of_slope(theta: NDArray | None, slope: NDArray | None = None) -> Any:
        return start if theta is None or slope is None else (slope @ theta, slope)

    return of_slope, [(design.slope(small, large), energy) for small, large, energy in seeds]


def log_length(small: NDArray, large: NDArray) -> NDArray:
    r"""Return the logarithm of the branch length over R_max.

    .. math:: \ln\frac{r_{min} + r_{max}}{R_{max}}

    Parameters
    ----------
    small, large : ndarray, shape (M,)
        ln(r_min/R_max) and ln(r_max/R_max) [-].

    Returns
    -------
    ndarray, shape (M,)
        [-]

    Examples
    --------
    >>> round(float(np.exp(log_length(np.log(0.25), np.log(0.5)))), 12)
    0.75
    """
    return large + np.log1p(np.exp(small - large))


def log_reduced_radius(small: NDArray, large: NDArray) -> NDArray:
    r"""Return the logarithm of the reduced radius over R_max.

    .. math:: \ln\frac{r_1 r_2}{(r_1 + r_2)\, R_{max}}

    Parameters
    ----------
    small, large : ndarray, shape (M,)
        As for `log_length`.

    Returns
    -------
    ndarray, shape (M,)
        [-]

    Examples
    --------
    >>> round(float(np.exp(log_reduced_radius(np.log(0.5), np.log(0.5)))), 12)
    0.25
    """
    return small + large - log_length(small, large)


def log_equality(small: NDArray, large: NDArray) -> NDArray:
    r"""Return the logarithm of the product of the radii over that of equal radii of one length.

    .. math:: \ln\frac{4\, r_1 r_2}{(r_1 + r_2)^2} = -2 \ln\cosh\left(\tfrac12
        \ln\frac{r_{min}}{r_{max}}\right)

    A function of the ratio alone: 0 for equal radii, where it is level, and for very unequal ones
    ln(4 r_min/r_max).

    Parameters
    ----------
    small, large : ndarray, shape (M,)
        As for `log_length`.

    Returns
    -------
    ndarray, shape (M,)
        [-]

    Examples
    --------
    >>> np.exp(log_equality(np.log([0.5, 0.1]), np.log([0.5, 0.3]))).round(12).tolist()
    [1.0, 0.75]
    """
    return small + large + np.log(4.0) - 2.0 * log_length(small, large)


def grain_sizes(
    theta: NDArray | None, small: NDArray | None = None, large: NDArray | None = None
) -> Any:
    r"""Return the design of a sum over the two grains, each a power of its own radius.

    .. math:: \eta = \ln A + \ln(r_1^n + r_2^n)

    Parameters
    ----------
    theta : ndarray, shape (2,), optional
        ln A and n.
    small, large : ndarray, shape (M,), optional
        As for `log_length`.

    Returns
    -------
    list or tuple of ndarray
        As `statistics.gamma_regression.gamma_fit` takes it.

    Examples
    --------
    >>> eta, slope = grain_sizes(np.array([0.0, 3.0]), np.log([0.5]), np.log([1.0]))
    >>> round(float(np.exp(eta[0])), 12)
    1.125
    """
    if theta is None or small is None or large is None:
        return [0.0, 3.0]
    share = 1.0 / (1.0 + np.exp(theta[1] * (small - large)))  # of the larger grain
    eta = theta[0] + theta[1] * large - np.log(share)
    return eta, np.stack([np.ones_like(small), share * large + (1.0 - share) * small], axis=1)
