"""What a grain at rest feels: the stress that is held against its strength."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Octahedral shear stress of a sphere between two plates, over F/d^2: by it one strength serves both
# criteria.
BETWEEN_PLATES = np.sqrt(2.0) / 3.0 * 6.0 / np.pi


class Sides(NamedTuple):
    """The contacts of grains as each grain feels them: a row for each grain of each contact."""

    grain: NDArray  # from 0, shape (K,)
    force: NDArray  # repulsive [N]
    direction: NDArray  # from the grain's centre to the contact, of unit length, shape (K, 3) [-]


def sides(
    i: ArrayLike,
    j: ArrayLike,
    force: ArrayLike,
    direction: ArrayLike,
    wall_grain: ArrayLike,
    wall_force: ArrayLike,
    wall_direction: ArrayLike,
) -> Sides:
    """Return contacts between grains and with walls as each grain feels them.

    Parameters
    ----------
    i, j : array_like of int, shape (M,)
        The two grains of each contact, from 0.
    force : array_like, shape (M,)
        [N]
    direction : array_like, shape (M, 3)
        From i to j, of unit length [-].
    wall_grain : array_like of int, shape (W,)
    wall_force : array_like, shape (W,)
        [N]
    wall_direction : array_like, shape (W, 3)
        From the grain to the wall, of unit length [-].

    Returns
    -------
    Sides

    Examples
    --------
    >>> felt = sides([0], [1], [2.0], [[1.0, 0, 0]], [0], [3.0], [[0, -1.0, 0]])
    >>> felt.grain.tolist(), felt.force.tolist()
    ([0, 1, 0], [2.0, 2.0, 3.0])
    """
    towards = np.reshape(np.asarray(direction, float), (-1, 3))
    at_wall = np.reshape(np.asarray(wall_direction, float), (-1, 3))
    return Sides(
        np.concatenate([np.asarray(part, int) for part in (i, j, wall_grain)]),
        np.concatenate([np.asarray(part, float) for part in (force, force, wall_force)]),
        np.concatenate([towards, -towards, at_wall]),
    )


def largest_force(felt: Sides, radius: ArrayLike) -> NDArray:
    """Return the largest force on each grain; 0 where none touches it.

    Parameters
    ----------
    felt : Sides
    radius : array_like, shape (N,)
        [m]

    Returns
    -------
    ndarray, shape (N,)
        [N]

    Examples
    --------
    >>> felt = sides([0], [1], [2.0], [[1.0, 0, 0]], [0], [3.0], [[0, -1.0, 0]])
    >>> largest_force(felt, [1.0, 1.0, 1.0]).tolist()
    [3.0, 2.0, 0.0]
    """
    largest = np.zeros(np.size(radius))
    np.maximum.at(largest, felt.grain, felt.force)
    return largest


def stress_of_largest_force(felt: Sides, radius: ArrayLike) -> NDArray:
    r"""Return the stress that the largest force on each grain makes.

    .. math:: \sigma = F_{max}/d^2

    Parameters
    ----------
    felt : Sides
    radius : array_like, shape (N,)
        [m]

    Returns
    -------
    ndarray, shape (N,)
        [Pa]

    Examples
    --------
    >>> felt = sides([], [], [], [], [0, 0], [8.0, 8.0], [[0, 0, 1.0], [0, 0, -1.0]])
    >>> stress_of_largest_force(felt, [1.0]).tolist()
    [2.0]

    References
    ----------
    Jaeger (1967); McDowell and de Bono (2016), Géotechnique 66, 1014.
    """
    return largest_force(felt, radius) / (2.0 * np.asarray(radius, float)) ** 2


def octahedral_stress(felt: Sides, radius: ArrayLike) -> NDArray:
    r"""Return the octahedral shear stress in each grain, as strengths are measured by it.

    .. math:: \boldsymbol\sigma = \frac{R}{V} \sum_c F_c\, \mathbf n_c \otimes \mathbf n_c, \quad
        q = \tfrac13 \sqrt{\textstyle\sum_{a<b} (\sigma_a - \sigma_b)^2}

    The forces act where the undeformed sphere ends. Between two plates q = 0.900 F/d^2; what is
    returned is q over 0.900, so that a strength measured between plates holds for it as for
    `stress_of_largest_force`.

    Parameters
    ----------
    felt : Sides
    radius : array_like, shape (N,)
        [m]

    Returns
    -------
    ndarray, shape (N,)
        [Pa]

    Examples
    --------
    >>> felt = sides([], [], [], [], [0, 0], [8.0, 8.0], [[0, 0, 1.0], [0, 0, -1.0]])
    >>> octahedral_stress(felt, [1.0]).round(12).tolist()
    [2.0]
    """
    radius = np.asarray(radius, float)
    normal, shear = np.zeros((3, radius.size)), np.zeros((3, radius.size))
    n = felt.direction.T
    for axis in range(3):
        other = (axis + 1) % 3
        normal[axis] = np.bincount(felt.grain, felt.force * n[axis] ** 2, radius.size)
        shear[axis] = np.bincount(felt.grain, felt.force * n[axis] * n[other], radius.size)
    # The same as by principal stresses, from the components: no eigenvalues are sought.
    squares = ((normal - np.roll(normal, -1, axis=0)) ** 2).sum(0) + 6.0 * (shear**2).sum(0)
    # R/V = 3/(4 pi R^2)
    return np.sqrt(squares) / 3.0 / (4.0 / 3.0 * np.pi * radius**2) / BETWEEN_PLATES


class Criterion(NamedTuple):
    """What the registry knows of a criterion: how it is found, and what figures call it."""

    stress: Callable[[Sides, ArrayLike], NDArray]
    label: str


# A criterion is added here and in `config.breakage`.
CRITERIA = {
    "largest_force": Criterion(stress_of_largest_force, "largest force"),
    "octahedral_stress": Criterion(octahedral_stress, "octahedral shear stress"),
}
