"""What a model of contact numbers returns, and what all of them begin with."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Frictionless spheres are isostatic where they jam: six contacts a grain that carries load.
ISOSTATIC = 6.0


class Coordination(NamedTuple):
    """Contact numbers at some radii and the share of those grains that carry load."""

    contacts: NDArray  # c(R), over all grains of the radius, shape (K,) [-]
    load_bearing: NDArray  # share of the grains of the radius, shape (K,) [-]


def solid_angle(radius: ArrayLike, neighbour: ArrayLike) -> NDArray:
    r"""Return the solid angle that a touching neighbour covers, seen from a grain's centre.

    .. math:: \Omega(R, R') = 2\pi\left[1 - \sqrt{1 - \left(\frac{R'}{R + R'}\right)^2}\right]

    Parameters
    ----------
    radius, neighbour : array_like
        R and R', broadcast [any one unit].

    Returns
    -------
    ndarray
        [sr]

    Examples
    --------
    >>> round(float(solid_angle(1.0, 1.0) / (4 * np.pi)), 4)  # 12 touching spheres cover 0.80
    0.067

    References
    ----------
    Suzuki and Oshima (1983), Powder Technology 35, 159.
    """
    ratio = np.asarray(neighbour) / np.add(radius, neighbour)
    return 2.0 * np.pi * (1.0 - np.sqrt(1.0 - ratio**2))
