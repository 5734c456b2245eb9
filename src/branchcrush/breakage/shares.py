"""Grains that break as shares of mass: classes of size, bins of strength, and where mass goes."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.breakage.fragments import packed_spheres
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength


def split_by_size(diameter: ArrayLike, mass: ArrayLike, classes: NDArray) -> NDArray:
    """Return masses of classes of size, each mass given to the two classes beside its diameter.

    The whole mass is kept, and its mean of ln(d), which Einav's breakage is made of.

    Parameters
    ----------
    diameter, mass : array_like, shape (n,)
        Within the classes [m], [any unit].
    classes : ndarray, shape (K,)
        Diameters, rising; 2 or more [m].

    Returns
    -------
    ndarray, shape (K,)
        [unit of the masses]

    Examples
    --------
    >>> split_by_size([2.0], [1.0], np.array([1.0, 4.0, 16.0])).round(12).tolist()
    [0.5, 0.5, 0.0]
    """
    mass = np.asarray(mass, float)
    place = np.interp(np.log(diameter), np.log(classes), np.arange(classes.size))
    lower = np.minimum(place.astype(int), classes.size - 2)
    part = place - lower
    return np.bincount(lower, mass * (1.0 - part), classes.size) + np.bincount(
        lower + 1, mass * part, classes.size
    )


def fragment_shares(classes: NDArray, rules: Breakage) -> NDArray:
    """Return which share of the mass of a grain that breaks goes to which class of size.

    Parameters
    ----------
    classes : ndarray, shape (K,)
        Diameters, rising, from `rules.finest_diameter` or less on [m].
    rules : Breakage

    Returns
    -------
    ndarray, shape (K, K)
        A row for each class that breaks: it sums to 1; 0 of those that never do [-].

    Examples
    --------
    >>> glass = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                  size_exponent=1.0)
    >>> rules = Breakage(strength=glass, smallest_diameter=2.5e-4)
    >>> fragment_shares(np.geomspace(5e-5, 1e-3, 40), rules).sum(axis=1).round(12)[[0, -1]].tolist()
    [0.0, 1.0]
    """
    ratio = packed_spheres(rules.fragments)[:, 3] * rules.growth[-1]
    shares = np.zeros((classes.size, classes.size))
    for row in np.flatnonzero(classes > rules.smallest_diameter):
        shares[row] = split_by_size(ratio * classes[row], ratio**3 / (ratio**3).sum(), classes)
    return shares


def weibull_bins(strength: Strength, bins: int) -> NDArray:
    r"""Return Weibull factors, each of as many grains as another, in the middles of their bins.

    .. math:: w_k = \left[-\ln\left(1 - \frac{k - 1/2}{n}\right)\right]^{1/m}

    Parameters
    ----------
    strength : Strength
    bins : int
        n, 1 or more.

    Returns
    -------
    ndarray, shape (n,)
        w, rising [-].

    Examples
    --------
    >>> glass = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                  size_exponent=1.0)
    >>> weibull_bins(glass, 3).round(3).tolist()
    [0.567, 0.885, 1.215]
    """
    level = (np.arange(bins) + 0.5) / bins
    return (-np.log1p(-level)) ** (1.0 / strength.weibull_modulus)
