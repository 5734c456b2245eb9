"""How many grains of which size there are when a share of all that may break has broken."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.breakage.fragments import growth, packed_spheres

# Diameters closer than this are one, with their mass: differences of their logarithms [-].
_ALIKE = 5e-3
# Of the whole mass: what is less does not break on [-].
_NOTHING = 1e-15


def broken_down(
    diameter: ArrayLike, number: ArrayLike, share: float, limit: float, fragments: int
) -> tuple[NDArray, NDArray]:
    r"""Return the grains that there are when of those above the limit a share has broken.

    .. math:: N_{k+1}(d\, r_i) = \sum_i q\, N_k(d), \quad d > d_l; \qquad
        N(d) = \sum_k N_k(d)\, [1 - q\, (d > d_l)]

    Fragments break as their parents do, with the probability q of any size above the limit: so a
    grain of generation k is broken with q^(k+1). r_i are the sizes of fragments that have the mass
    of their grain.

    Parameters
    ----------
    diameter, number : array_like, shape (K,)
        Of the grains before [any unit], [any scale].
    share : float
        q, from 0 to 1 [-].
    limit : float
        d_l, above 0: grains no larger never break [unit of the diameters].
    fragments : int
        That a grain breaks into.

    Returns
    -------
    diameter, number : ndarray, shape (L,)
        [unit of the diameters], [scale of the number]; diameters may be there twice.

    Examples
    --------
    >>> diameter, number = broken_down([1.0], [1.0], 1.0, 0.25, 14)
    >>> round(float(number.sum())), round(float(number @ diameter**3), 9)
    (404, 1.0)
    """
    relative = packed_spheres(fragments)[:, 3] * growth(fragments, 0)[-1]
    here, count = np.asarray(diameter, float), np.asarray(number, float)
    least = _NOTHING * float(count @ here**3)
    diameters, numbers = [], []
    while here.size:
        breaks = np.where(here > limit, share, 0.0) * count
        breaks[breaks * here**3 <= least] = 0.0
        diameters.append(here)
        numbers.append(count - breaks)
        parents, count = here[breaks > 0.0], breaks[breaks > 0.0]
        here, count = _alike(np.outer(parents, relative).ravel(), np.repeat(count, relative.size))
    return np.concatenate(diameters), np.concatenate(numbers)


def _alike(diameter: NDArray, number: NDArray) -> tuple[NDArray, NDArray]:
    """Return classes of diameters for many of them, with their number and mass."""
    _, place = np.unique(np.round(np.log(diameter) / _ALIKE), return_inverse=True)
    count = np.bincount(place, number)
    mass = np.bincount(place, number * diameter**3)
    return np.cbrt(mass / count), count
