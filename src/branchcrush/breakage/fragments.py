"""What a grain breaks into: touching spheres within it, which grow until no mass is lost."""

from functools import lru_cache
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Four touching spheres of one radius that touch the grain's surface are the first.
FEWEST_FRAGMENTS, MOST_FRAGMENTS = 4, 50
_ALIKE = 1e-9  # differences of radii and places up to which two are one [-]


class Fragments(NamedTuple):
    """The pieces of a grain, touching each other within it."""

    position: NDArray  # of the centres, shape (n, 3) [m]
    radius: NDArray  # of touching spheres, shape (n,) [m]
    full_radius: NDArray  # with which they have the mass of the grain, shape (n,) [m]


@lru_cache
def packed_spheres(number: int) -> NDArray:
    r"""Return spheres in a unit sphere, each the largest that the ones before it leave room for.

    .. math:: |\mathbf x_a - \mathbf x_b| = r_a + r_b, \qquad |\mathbf x_a| = 1 - r_a

    A near-Apollonian packing: the first four, of radius sqrt(6) - 2, touch each other and the unit
    sphere; each further one touches four of the others, the unit sphere among them or not. Their
    sizes follow a power law, as those of fragments do.

    Parameters
    ----------
    number : int
        From 4 to 50.

    Returns
    -------
    ndarray, shape (n, 4)
        x, y, z and radius, radii falling [-].

    Raises
    ------
    ValueError
        When the number is outside of its range.

    Examples
    --------
    >>> spheres = packed_spheres(20)
    >>> [round(float(radius), 4) for radius in spheres[[0, 4, 8, 19], 3]]
    [0.4495, 0.2899, 0.2139, 0.2139]
    >>> round(float((packed_spheres(14)[:, 3] ** 3).sum()), 4)
    0.5195

    References
    ----------
    Soddy (1936), Nature 137, 1021; Borkovec, de Paris and Peikert (1994), Fractals 2, 521: the
    fractal dimension of the complete packing is 2.47.
    """
    if not FEWEST_FRAGMENTS <= number <= MOST_FRAGMENTS:
        raise ValueError(
            f"a grain breaks into {FEWEST_FRAGMENTS} to {MOST_FRAGMENTS} fragments, not {number}"
        )
    radius = np.sqrt(6.0) - 2.0
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3.0)
    # The unit sphere comes first, its radius negative: touched from within.
    placed, candidates = np.array([[0.0, 0.0, 0.0, -1.0]]), np.empty((0, 4))
    for count in range(number):
        if count < 4:
            new = np.append(corners[count] * (1.0 - radius), radius)
        else:
            # The first found of those that are as large as the largest.
            new = candidates[np.argmax(candidates[:, 3] > candidates[:, 3].max() - _ALIKE)]
        three = np.array(list(combinations(range(count + 1), 3)), dtype=int).reshape(-1, 3)
        fours = np.concatenate([placed[three], np.tile(new, (len(three), 1, 1))], axis=1)
        placed = np.vstack([placed, new])
        candidates = np.vstack([candidates, _touching(fours)])
        candidates = candidates[_is_free(candidates, placed)]
    return placed[1:]


def _touching(fours: NDArray) -> NDArray:
    """Return the spheres that touch all of four others: none, one or two of each four."""
    # |x - x_a| = r + r_a, squared; the first one's equation taken from the others is linear:
    # x = away + x_1 + slope r.
    first, rest = fours[:, :1], fours[:, 1:]
    matrix = 2.0 * (rest - first)
    size = (fours[..., :3] ** 2).sum(-1) - fours[..., 3] ** 2
    solvable = np.abs(np.linalg.det(matrix[..., :3])) > _ALIKE
    matrix, first, size = matrix[solvable], first[solvable, 0], size[solvable]
    right = np.stack([size[:, 1:] - size[:, :1], -matrix[..., 3]], axis=-1)
    solved = np.linalg.solve(matrix[..., :3], right)
    away, slope = solved[..., 0] - first[:, :3], solved[..., 1]
    # |away + slope r|^2 = (r + r_1)^2
    a, b = (slope**2).sum(1) - 1.0, 2.0 * ((away * slope).sum(1) - first[:, 3])
    c = (away**2).sum(1) - first[:, 3] ** 2
    real = (np.abs(a) > _ALIKE) & (b * b - 4.0 * a * c >= 0.0)
    a, b, c, away, slope, first = (part[real] for part in (a, b, c, away, slope, first))
    root = np.sqrt(b * b - 4.0 * a * c)
    radii = np.stack([-b - root, -b + root], axis=1) / (2.0 * a[:, None])
    places = (away + first[:, :3])[:, None] + slope[:, None] * radii[..., None]
    found = np.concatenate([places, radii[..., None]], axis=2).reshape(-1, 4)
    return found[(found[:, 3] > _ALIKE) & (found[:, 3] < 1.0)]


def _is_free(spheres: NDArray, placed: NDArray) -> NDArray:
    """Return which spheres overlap none of those placed and lie within the unit sphere."""
    distance = np.linalg.norm(spheres[:, None, :3] - placed[:, :3], axis=2)
    outer = placed[:, 3] < 0.0
    gap = distance - placed[:, 3] - spheres[:, 3:]
    within = -placed[:, 3] - distance - spheres[:, 3:]
    return np.all(np.where(outer, within, gap) > -_ALIKE, axis=1)


def broken(position: ArrayLike, radius: float, number: int, rng: np.random.Generator) -> Fragments:
    r"""Return the fragments of a grain, turned at random.

    .. math:: R_k = r_k R, \qquad R_k^* = R_k \left(\sum_k r_k^3\right)^{-1/3}

    As touching spheres they lie within the grain and overlap its neighbours no more than it did.
    Grown to R_k^* they have its mass.

    Parameters
    ----------
    position : array_like, shape (3,)
        [m]
    radius : float
        R [m].
    number : int
        Of fragments.
    rng : numpy.random.Generator

    Returns
    -------
    Fragments

    Examples
    --------
    >>> pieces = broken([0.0, 0.0, 0.0], 2.0, 14, np.random.default_rng(1))
    >>> round(float((pieces.full_radius**3).sum()), 12)
    8.0
    """
    from scipy.spatial.transform import Rotation  # slow to import, and few jobs need it

    spheres = packed_spheres(number)
    turned = Rotation.random(random_state=rng).apply(spheres[:, :3])
    touching = radius * spheres[:, 3]
    fill = float((spheres[:, 3] ** 3).sum())
    return Fragments(np.asarray(position) + radius * turned, touching, touching * fill ** (-1 / 3))


def growth(number: int, stages: int) -> list[float]:
    r"""Return by how much the fragments of a grain have grown in each stage.

    .. math:: g_k = 1 + \frac{k}{n} \left[\left(\sum r^3\right)^{-1/3} - 1\right]

    Parameters
    ----------
    number : int
        Of fragments.
    stages : int
        n; 0 for full mass at once.

    Returns
    -------
    list of float
        g of each stage [-]; the last has all the mass.

    Examples
    --------
    >>> [round(factor, 4) for factor in growth(14, 2)], len(growth(14, 0))
    ([1.122, 1.244], 1)
    """
    full = float((packed_spheres(number)[:, 3] ** 3).sum()) ** (-1 / 3)
    steps = max(stages, 1)
    return [1.0 + (full - 1.0) * k / steps for k in range(1, steps + 1)]
