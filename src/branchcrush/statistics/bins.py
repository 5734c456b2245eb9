"""Bins of branch length and of radius, and what is counted in them."""

import numpy as np
from numpy.typing import ArrayLike, NDArray


def bin_edges(radius_min: float, radius_max: float, bins: int = 20) -> NDArray:
    r"""Return the edges of equal bins of branch length.

    .. math:: l_k = 2 R_{min} + \frac{k}{n} (2 R_{max} - 2 R_{min}), \quad k = 0 \ldots n

    A single size has bins too, from a tenth below its branches to a tenth above.

    Parameters
    ----------
    radius_min, radius_max : float
        Of all grains [m].
    bins : int
        n.

    Returns
    -------
    ndarray, shape (n+1,)
        [m]

    Examples
    --------
    >>> bin_edges(0.5, 1.5, 2).tolist()
    [1.0, 2.0, 3.0]

    References
    ----------
    Paper, text before Eq. 25.
    """
    if radius_min == radius_max:
        radius_min, radius_max = 0.9 * radius_min, 1.1 * radius_max
    return np.linspace(2.0 * radius_min, 2.0 * radius_max, bins + 1)


def bin_numbers(values: ArrayLike, edges: ArrayLike) -> NDArray:
    r"""Return the number of the bin of each value; one beyond the ends belongs to the end bin.

    .. math:: e_b \le x < e_{b+1}

    Parameters
    ----------
    values : array_like, shape (M,)
        x, in the unit of the edges.
    edges : array_like, shape (n+1,)
        Increasing.

    Returns
    -------
    ndarray of int, shape (M,)
        From 0.

    Examples
    --------
    >>> bin_numbers([0.9, 1.0, 2.0, 3.0], [1.0, 2.0, 3.0]).tolist()
    [0, 0, 1, 1]
    """
    edges = np.asarray(edges, dtype=float)
    return np.clip(np.searchsorted(edges, values, side="right") - 1, 0, edges.size - 2)


def binned_sums(length: ArrayLike, energy: ArrayLike, edges: ArrayLike) -> NDArray:
    r"""Return, for each bin, the branches, the sum of their lengths and of their energies.

    .. math:: N_b, \quad \sum_b l, \quad \psi_b = \sum_b E

    Parameters
    ----------
    length, energy : array_like, shape (M,)
        Branch length R_i + R_j [m] and elastic energy [J] of each branch.
    edges : array_like, shape (n+1,)
        [m]; a length beyond the first or last edge, by rounding, belongs to the end bin.

    Returns
    -------
    ndarray, shape (3, n)
        Counts [-], lengths [m], energies [J].

    Examples
    --------
    >>> binned_sums([1.5, 1.5, 2.5], [1.0, 3.0, 5.0], [1.0, 2.0, 3.0]).tolist()
    [[2.0, 1.0], [3.0, 2.5], [4.0, 5.0]]

    References
    ----------
    Paper, Eqs. 24 and 25; the energy is that of `packings.contact_laws`, with its 1/2.
    """
    length, energy = np.asarray(length, dtype=float), np.asarray(energy, dtype=float)
    bins = np.size(edges) - 1
    index = bin_numbers(length, edges)
    return np.stack(
        [np.bincount(index, weights, minlength=bins) for weights in (None, length, energy)]
    ).astype(float)
