"""Radii of the grains of a packing, drawn from a grading at random or at its quantiles."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.errors import GradingError
from branchcrush.gradings.distribution import Grading

# Of any grading; a list of grains may also be "listed".
METHODS = ("random", "number_quantiles", "mass_quantiles")


def sampled_radii(
    grading: Grading, grains: int, method: str, rng: np.random.Generator | None
) -> NDArray:
    r"""Return the radii of N grains of a grading, the largest first.

    "random" draws them independently. "number_quantiles" takes the middle of N intervals of equal
    number, "mass_quantiles" the radius of the mean volume in each: its sieve curve meets the
    target's at the end of every interval. "listed" takes each grain of a list once, as it is.

    .. math:: R_i = F^{-1}\left(\frac{i - 1/2}{N}\right), \qquad
        R_i^3 = N \int_{(i-1)/N}^{i/N} \left(F^{-1}(q)\right)^3 dq

    Parameters
    ----------
    grading : Grading
    grains : int
        N.
    method : {"random", "number_quantiles", "mass_quantiles", "listed"}
        An interval across two single sizes has a grain between them by "mass_quantiles" only.
    rng : numpy.random.Generator or None
        Used by "random" only.

    Returns
    -------
    ndarray, shape (N,)
        [m]

    Raises
    ------
    ValueError
        For an unknown method.
    GradingError
        By "listed", when the grading is no list of N grains.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> sampled_radii(uniform(1.0, 3.0), 2, "number_quantiles", None).round(12).tolist()
    [2.5, 1.5]
    >>> sampled_radii(uniform(1.0, 3.0), 2, "mass_quantiles", None).round(4).tolist()
    [2.5329, 1.5536]
    """
    if method == "random":
        radii = grading.rvs(grains, rng)
    elif method == "number_quantiles":
        radii = grading.number_ppf((np.arange(grains) + 0.5) / grains)
    elif method == "mass_quantiles":
        radii = _radii_of_mean_volume(grading, grains)
    elif method == "listed":
        radii = _radii_of_list(grading, grains)
    else:
        raise ValueError(f"method must be one of {', '.join(METHODS)} or listed, not {method!r}")
    return np.sort(radii)[::-1]


def _radii_of_list(grading: Grading, grains: int) -> NDArray:
    single, share = grading.discrete_part
    number = np.rint(share * grains)
    # A grading of other shares is no list of so many grains.
    if not grading.is_discrete or np.abs(share * grains - number).max() > 1e-6:
        raise GradingError(
            f"the grading is no list of {grains} grains, to be taken as they are: draw them by "
            "another sampling"
        )
    return np.repeat(single, number.astype(int))


def _radii_of_mean_volume(grading: Grading, grains: int) -> NDArray:
    ends = np.arange(grains + 1) / grains
    radius = grading.number_ppf(ends)
    # The mass of the smallest grains up to a share of the number, which may end within one size.
    excess = (grading.number_cdf(radius) - ends) * radius**3
    volume = grading.mass_cdf(radius) * grading.moment(3) - excess
    # Rounding of a small difference must not lead out of its interval.
    return np.clip(np.cbrt(grains * np.diff(volume)), radius[:-1], radius[1:])
