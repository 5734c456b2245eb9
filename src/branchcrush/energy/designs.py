"""Mean energies as functions of the two radii of a branch, in the form that the regression takes.

All are in logarithms of R/R_max.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray


def linear_design(
    columns: Callable[[NDArray, NDArray], list[NDArray]], start: list[float]
) -> Callable[..., Any]:
    """Return the design of a predictor that is linear in its parameters.

    Parameters
    ----------
    columns : callable
        Takes ln r_min and ln r_max, shape (M,); returns a column for each parameter after the
        scale.
    start : list of float
        Where these parameters start.

    Returns
    -------
    callable
        As `statistics.gamma_regression.gamma_fit` takes it.

    Examples
    --------
    >>> design = linear_design(lambda small, large: [small], [2.0])
    >>> eta, slope = design(np.array([1.0, 3.0]), np.array([0.5]), np.array([0.7]))
    >>> design(None), eta.tolist(), slope.tolist()
    ([0.0, 2.0], [2.5], [[1.0, 0.5]])
    """

    def design(
        theta: NDArray | None, small: NDArray | None = None, large: NDArray | None = None
    ) -> Any:
        if theta is None or small is None or large is None:
            return [0.0, *start]
        slope = np.stack([np.ones_like(small), *columns(small, large)], axis=1)
        return slope @ theta, slope

    return design


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


def grain_sizes(
    theta: NDArray | None, small: NDArray | None = None, large: NDArray | None = None
) -> Any:
    r"""Return the design of a sum over the two grains, each a power of its own radius.

    .. math:: \eta = \ln A + \ln(r_1^q + r_2^q)

    Parameters
    ----------
    theta : ndarray, shape (2,), optional
        ln A and q.
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
