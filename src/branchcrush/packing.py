"""Non-overlapping random placement of spheres in a cube."""

import numpy as np

from branchcrush.errors import PackingError

_TRIES_AT_ONCE = 64


def cube_edge(radii, solid_fraction):
    r"""Return the edge of the cube that the spheres fill to a solid fraction.

    .. math:: L = \left(\frac{4\pi}{3\phi} \sum_i R_i^3\right)^{1/3}

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    solid_fraction : float
        phi [-].

    Returns
    -------
    float
        [m]

    Examples
    --------
    >>> round(cube_edge([1.0], 0.5), 6)
    2.030983
    """
    return float(np.cbrt(4.0 / 3.0 * np.pi * np.sum(np.asarray(radii) ** 3) / solid_fraction))


def random_packing(radii, edge, *, periodic, rng, largest_attempts=20_000):
    """Place spheres at random in a cube about the origin so that none overlap.

    Random sequential addition, the largest first: each sphere is put at a uniform random place
    until one is free. Behind walls it stays wholly inside; a periodic cube has no wall.

    Parameters
    ----------
    radii : array_like, shape (N,)
        In the order to place them; decreasing reaches the highest fraction [m].
    edge : float
        Edge of the cube [m].
    periodic : bool
        Whether the faces of the cube are joined.
    rng : numpy.random.Generator
    largest_attempts : int
        Places tried for one sphere before giving up.

    Returns
    -------
    ndarray, shape (N, 3)
        Centres [m].

    Raises
    ------
    PackingError
        When a sphere finds no place; the message names the solid fraction reached.

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> random_packing([1.0, 0.5], 4.0, periodic=False, rng=rng).shape
    (2, 3)

    References
    ----------
    Widom (1966), J. Chem. Phys. 44, 3888-3894, for random sequential addition.
    """
    radii = np.asarray(radii, dtype=float)
    if radii.max() * 2.0 > edge:
        raise PackingError(
            f"a grain of radius {radii.max():.3g} m does not fit into a cube of {edge:.3g} m: "
            "use more grains or a lower initial_solid_fraction"
        )
    centres = np.empty((radii.size, 3))
    for n, radius in enumerate(radii):
        reach = edge / 2.0 if periodic else edge / 2.0 - radius
        contact_squared = (radii[:n] + radius) ** 2
        for _ in range(-(-largest_attempts // _TRIES_AT_ONCE)):
            tries = rng.uniform(-reach, reach, size=(_TRIES_AT_ONCE, 3))
            placed = centres[:n]
            free = next(
                (p for p in tries if _is_free(p, placed, contact_squared, edge, periodic)), None
            )
            if free is not None:
                centres[n] = free
                break
        else:
            reached = 4.0 / 3.0 * np.pi * np.sum(radii[:n] ** 3) / edge**3
            raise PackingError(
                f"no free place for grain {n + 1} of {radii.size} after {largest_attempts} "
                f"attempts, at a solid fraction of {reached:.3f}: lower initial_solid_fraction "
                "(random placement ends near 0.3 to 0.4) and compress further"
            )
    return centres


def _is_free(place, centres, contact_squared, edge, periodic):
    gap = centres - place
    if periodic:
        gap -= edge * np.round(gap / edge)
    return np.all(np.einsum("ij,ij->i", gap, gap) >= contact_squared)
