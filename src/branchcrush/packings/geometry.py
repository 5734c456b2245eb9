"""Volumes of spheres and of the cubic cell that holds them."""

from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

# A number, or an array of them: what goes in comes out.
Real = TypeVar("Real", float, NDArray)

# Volume of a sphere of radius 1: times a moment <R^3> it is a mean volume of grains.
UNIT_SPHERE = 4.0 / 3.0 * np.pi


def sphere_volume(radius: ArrayLike) -> NDArray:
    r"""Return the volume of each grain.

    .. math:: V = \tfrac{4}{3} \pi R^3

    Parameters
    ----------
    radius : array_like, shape (N,)
        R [m].

    Returns
    -------
    ndarray, shape (N,)
        [m3]

    Examples
    --------
    >>> round(float(sphere_volume(1.0)), 6)
    4.18879
    """
    return UNIT_SPHERE * np.asarray(radius, dtype=float) ** 3


def shared_volume(radius: Real, other: Real, overlap: Real) -> Real:
    r"""Return the volume that two overlapping spheres share, a lens.

    .. math:: V = \frac{\pi \delta^2}{12 d}
        \left(d^2 + 2 d (R_1 + R_2) - 3 (R_1 - R_2)^2\right), \quad d = R_1 + R_2 - \delta

    Parameters
    ----------
    radius, other : float or ndarray, shape (M,)
        R_1 and R_2 [m].
    overlap : float or ndarray, shape (M,)
        delta, from 0 to the diameter of the smaller sphere [m].

    Returns
    -------
    float or ndarray, shape (M,)
        [m3]

    Examples
    --------
    >>> round(float(shared_volume(1.0, 1.0, 1.0) / np.pi * 12), 9)
    5.0

    References
    ----------
    Weisstein, Sphere-Sphere Intersection, MathWorld.
    """
    distance = radius + other - overlap
    shape = distance**2 + 2 * distance * (radius + other) - 3 * (radius - other) ** 2
    return np.pi * overlap**2 * shape / (12 * distance)


def solid_volume(radii: ArrayLike) -> float:
    r"""Return the volume of all grains together.

    .. math:: V_s = \tfrac{4}{3} \pi \sum_i R_i^3

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]

    Returns
    -------
    float
        [m3]

    Examples
    --------
    >>> round(solid_volume([1.0, 2.0]) / np.pi, 9)
    12.0

    References
    ----------
    Paper, Eq. 1.
    """
    return float(UNIT_SPHERE * np.sum(np.asarray(radii, dtype=float) ** 3))


def cube(edge: Real) -> Real:
    r"""Return the volume of a cube, to the same last bit for a number and for an array.

    .. math:: V = L^3

    Parameters
    ----------
    edge : float or ndarray, shape (n,)
        L [m].

    Returns
    -------
    float or ndarray, shape (n,)
        [m3]

    Examples
    --------
    >>> cube(2.0)
    8.0
    """
    return edge * edge * edge


def cube_edge(radii: ArrayLike, solid_fraction: float) -> float:
    r"""Return the edge of the cube that the spheres fill to a solid fraction.

    .. math:: L = \left(\frac{4\pi}{3\phi} \sum_i R_i^3\right)^{1/3}

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    solid_fraction : float
        phi, above 0 [-].

    Returns
    -------
    float
        [m]

    Examples
    --------
    >>> round(cube_edge([1.0], 0.5), 6)
    2.030983
    """
    return float(np.cbrt(solid_volume(radii) / solid_fraction))
