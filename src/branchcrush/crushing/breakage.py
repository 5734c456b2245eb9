"""How far crushing has come, from the gradings before and after: measures of laboratories."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.gradings.distribution import Grading

# Radius of the finest grain that can break, in Hardin's sense: silt, 0.074 mm in diameter.
SILT = 0.037e-3


def hardin_breakage(before: Grading, after: Grading, finest: float = SILT) -> float:
    r"""Return Hardin's relative breakage.

    .. math:: B_r = \frac{\int (b_0 - b_1)\, df}{\int b_0\, df}, \qquad
        b = \max\left(\log_{10} \frac{D}{0.074\,\mathrm{mm}}, 0\right)

    The area between the two curves on the usual chart, down to silt, over the area that is left of
    the first one.

    Parameters
    ----------
    before, after : Grading
    finest : float
        Radius below which grains count as broken completely, above 0 [m].

    Returns
    -------
    float
        From 0 to 1 where the grading became finer [-].

    Raises
    ------
    ValueError
        When no grain is coarser than that, before crushing.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> round(hardin_breakage(single(0.37e-3), single(0.117e-3)), 3)
    0.5

    References
    ----------
    Hardin (1985), J. Geotech. Eng. 111, 1177-1192.
    """
    potential = _mean_logarithm(before, finest)
    if not potential > 0.0:
        raise ValueError(f"no grain is larger than the {finest:g} m below which none can break")
    return float((potential - _mean_logarithm(after, finest)) / potential)


def einav_breakage(
    before: Grading, after: Grading, alpha: float, largest: float, smallest: float = 0.0
) -> float:
    r"""Return Einav's breakage: the share of the way to a fractal grading that was gone.

    .. math:: B = \frac{\int (F_1 - F_0)\, d\ln D}{\int (F_u - F_0)\, d\ln D}
        = \frac{\langle \ln D \rangle_0 - \langle \ln D \rangle_1}
               {\langle \ln D \rangle_0 - \langle \ln D \rangle_u}

    Means by mass. What the ultimate grading's smallest size is decides: the same two curves may
    give B = 0.24 with 0 and 0.53 with a hundredth of the largest.

    Parameters
    ----------
    before, after : Grading
    alpha : float
        Fractal dimension of the ultimate grading, 0 to below 3 [-].
    largest, smallest : float
        Its radii [m]; the smallest may be 0.

    Returns
    -------
    float
        [-]; above 1 when crushing went beyond the ultimate grading.

    Raises
    ------
    ValueError
        When the ultimate grading is no finer than the first one, or alpha is outside of its range.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> round(einav_breakage(single(1.0), single(0.5), alpha=2.0, largest=1.0), 4)
    0.6931

    References
    ----------
    Einav (2007), J. Mech. Phys. Solids 55, 1274-1297.
    """
    initial = _mean_logarithm(before)
    way = initial - _ultimate_mean_logarithm(alpha, largest, smallest)
    if not way > 0.0:
        raise ValueError("the ultimate grading is no finer than the one before crushing")
    return float((initial - _mean_logarithm(after)) / way)


def crushing_parameter(initial: float, now: float, ultimate: float) -> float:
    r"""Return the paper's C from a moment of the branch lengths.

    .. math:: C = \frac{\langle l^n \rangle_0 - \langle l^n \rangle}
        {\langle l^n \rangle_0 - \langle l^n \rangle_u}

    A mean by number, in which a few fines outweigh all else: it is almost 1 where a quarter of the
    way is gone by Einav's measure.

    Parameters
    ----------
    initial, now, ultimate : float
        Moments <l^n> before crushing, of the grading now, and of the ultimate one [m^n].

    Returns
    -------
    float
        [-]

    Raises
    ------
    ValueError
        When the first and the last are equal.

    Examples
    --------
    >>> crushing_parameter(1.0, 0.75, 0.5)
    0.5

    References
    ----------
    Paper, Eq. 15.
    """
    if initial == ultimate:
        raise ValueError("C is undefined: the ultimate grading has the moment of the initial one")
    return (initial - now) / (initial - ultimate)


def _mean_logarithm(grading: Grading, finest: float | None = None) -> float:
    """Return the mean by mass of ln D, or of log10 of D over the finest where that is above 0."""
    radius, number = grading.quadrature(breaks=() if finest is None else (finest,))
    mass = number * (radius / radius.max()) ** 3
    if finest is None:
        logarithm: NDArray = np.log(2.0 * radius)
    else:
        logarithm = np.log10(np.maximum(radius / finest, 1.0))
    return float(mass @ logarithm / mass.sum())


def _ultimate_mean_logarithm(alpha: float, largest: float, smallest: float) -> float:
    """Return the mean by mass of ln D of a fractal grading between two radii."""
    if not (0.0 < alpha < 3.0 and 0.0 <= smallest < largest):
        raise ValueError(
            f"alpha = {alpha:g} must be from 0 to 3, and the smallest size below the largest"
        )
    power = 3.0 - alpha  # F grows as D^power, from 0 or from the smallest on
    beyond = 0.0
    if smallest > 0.0:
        ratio = (smallest / largest) ** power
        beyond = ratio * np.log(largest / smallest) / (1.0 - ratio)
    return float(np.log(2.0 * largest) - 1.0 / power + beyond)
