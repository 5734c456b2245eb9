"""Gradings from a density, cut at two radii and turned from mass to number."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.errors import GradingError
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.panels import Density

# Less of a distribution than this between the two ends: they were hardly meant.
LEAST_SHARE = 1e-6
# Where a distribution from SciPy changes, however narrow it is.
_TAILS = np.array([1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.02, 0.16, 0.5])


def truncated(
    density: Density,
    breaks: Sequence[float] | NDArray,
    radius_min: float,
    radius_max: float,
    by: str,
) -> Grading:
    r"""Return the grading of a density by number or by mass, cut at two radii.

    .. math:: n(R) \propto R^{-3} g(R), \quad R_m \le R \le R_M

    Parameters
    ----------
    density : callable
        n, or g by mass, of any scale and smooth between the breaks [1/m].
    breaks : array_like, shape (n,)
        Where it has a kink, jump or narrow peak [m].
    radius_min, radius_max : float
        R_m and R_M [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M, or when the density vanishes or `by` is another word.

    Examples
    --------
    >>> rising = truncated(lambda r: r, [], 1.0, 3.0, "number")
    >>> round(float(rising.number_cdf(2.0)), 12)
    0.375
    """
    _check_order(radius_min, radius_max)
    inside = [r for r in breaks if radius_min < r < radius_max]
    power = -3.0 if is_by_mass(by) else 0.0

    def by_number(radius: NDArray) -> NDArray:
        within = (radius >= radius_min) & (radius <= radius_max)
        return np.where(within, density(radius) * (radius / radius_max) ** power, 0.0)

    return Grading(by_number, [radius_min, *inside, radius_max])


def is_by_mass(by: str) -> bool:
    """Return whether a basis is mass.

    Parameters
    ----------
    by : {"number", "mass"}

    Returns
    -------
    bool

    Raises
    ------
    GradingError
        For another word.

    Examples
    --------
    >>> is_by_mass("mass"), is_by_mass("number")
    (True, False)
    """
    if by not in ("number", "mass"):
        raise GradingError(f"a grading is by number or by mass, not by {by!r}")
    return by == "mass"


def share_within(distribution: Any, lower: float, upper: float) -> float:
    r"""Return the share of a SciPy distribution between two values, to rounding in both tails.

    .. math:: F(b) - F(a) = (1 - F(a)) - (1 - F(b))

    The second form, by the survival function, keeps its digits where F is near 1.

    Parameters
    ----------
    distribution : frozen scipy.stats distribution
    lower, upper : float
        a and b, in its unit.

    Returns
    -------
    float
        [-]

    Examples
    --------
    >>> from scipy import stats
    >>> share_within(stats.norm(), 8.0, 9.0) > 6e-16
    True
    """
    if distribution.cdf(lower) < 0.5:
        return float(distribution.cdf(upper) - distribution.cdf(lower))
    return float(distribution.sf(lower) - distribution.sf(upper))


def truncated_distribution(
    distribution: Any, radius_min: float, radius_max: float, by: str
) -> Grading:
    """Return the grading of a SciPy distribution of the radius, cut at two radii.

    Parameters
    ----------
    distribution : frozen scipy.stats distribution
        [m]
    radius_min, radius_max : float
        Smallest and largest radius [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M with at least `LEAST_SHARE` of the distribution between them.

    Examples
    --------
    >>> from scipy import stats
    >>> grading = truncated_distribution(stats.expon(), 1.0, 9.0, "number")
    >>> round(float(grading.number_cdf(2.0)), 6)
    0.632333
    """
    _check_order(radius_min, radius_max)
    share = share_within(distribution, radius_min, radius_max)
    if not share >= LEAST_SHARE:
        raise GradingError(
            f"only {share:.3g} of the {distribution.dist.name} distribution of "
            f"{distribution.kwds or distribution.args} lies between {radius_min:g} m and "
            f"{radius_max:g} m: its parameters must be positive, and the two radii hold at least "
            f"{LEAST_SHARE:g} of it"
        )
    breaks = np.append(distribution.ppf(_TAILS), distribution.isf(_TAILS))
    return truncated(distribution.pdf, breaks, radius_min, radius_max, by)


def _check_order(radius_min: float, radius_max: float) -> None:
    if not 0 < radius_min < radius_max < np.inf:
        raise GradingError(
            f"the smallest radius {radius_min:g} m must be above 0 and below the largest "
            f"{radius_max:g} m; a grading of one size has its own form"
        )
