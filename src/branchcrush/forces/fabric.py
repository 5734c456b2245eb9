"""The fabric: how evenly the branches point in all directions, beside what chance would give."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray


def fabric_tensor(vectors: ArrayLike, weights: ArrayLike | None = None) -> NDArray:
    r"""Return the fabric tensor of branches, or of their forces.

    .. math:: \mathbf{F} = \frac{\sum_b w_b\, \mathbf{n}_b \otimes \mathbf{n}_b}{\sum_b w_b}

    Parameters
    ----------
    vectors : array_like, shape (M, 3)
        Branch vectors [m].
    weights : array_like, shape (M,), optional
        1 for the fabric of branches, their forces for that of the force network.

    Returns
    -------
    ndarray, shape (3, 3)
        [-]; its trace is 1.

    Examples
    --------
    >>> fabric_tensor([[2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).diagonal().tolist()
    [0.5, 0.5, 0.0]

    References
    ----------
    Satake (1982); Oda (1982), Soils and Foundations 22, 96.
    """
    lines = np.asarray(vectors, dtype=float)
    normals = lines / np.linalg.norm(lines, axis=1, keepdims=True)
    parts = np.ones(len(normals)) if weights is None else np.asarray(weights, dtype=float)
    return (normals * (parts / parts.sum())[:, None]).T @ normals


def deviator(tensor: ArrayLike) -> NDArray:
    r"""Return the size of a fabric tensor's deviator, 0 for an isotropic one.

    .. math:: q = \sqrt{\tfrac{3}{2}}\, \left\| \mathbf{F} - \mathbf{I}/3 \right\|

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)
        [-]

    Returns
    -------
    ndarray, shape (...)
        [-]; 1 when all branches are parallel.

    Examples
    --------
    >>> round(float(deviator(np.diag([1.0, 0.0, 0.0]))), 12)
    1.0
    """
    off = np.asarray(tensor) - np.eye(3) / 3.0
    return np.sqrt(1.5 * np.sum(off**2, axis=(-2, -1)))


def effective_branches(number: int, weights: ArrayLike | None = None) -> float:
    r"""Return how many equal branches have as much sampling noise as weighted ones.

    .. math:: M_{\mathrm{eff}} = \frac{(\sum_b w_b)^2}{\sum_b w_b^2}

    Parameters
    ----------
    number : int
        M.
    weights : array_like, shape (M,), optional
        Of any scale; all alike without them.

    Returns
    -------
    float
        [-]; M at most.

    Examples
    --------
    >>> effective_branches(2, [1.0, 3.0])
    1.6
    """
    if weights is None:
        return float(number)
    parts = np.asarray(weights, dtype=float)
    return float(parts.sum() ** 2 / (parts @ parts))


def expected_deviator(branches: float) -> float:
    r"""Return the deviator that independent, isotropic branches have by chance, its mean square.

    .. math:: \sqrt{\langle q^2 \rangle} = 1/\sqrt{M}

    since one branch has q = 1 and the deviators of M independent ones add like random steps.

    Parameters
    ----------
    branches : float
        M, or the effective number of weighted ones.

    Returns
    -------
    float
        [-]

    Examples
    --------
    >>> expected_deviator(100)
    0.1
    """
    return float(1.0 / np.sqrt(branches))


def chance_range(seeds: int, confidence: float = 0.95) -> tuple[float, float]:
    r"""Return the range by chance of the deviator over the expected one, root mean square of seeds.

    .. math:: \frac{1}{S} \sum_s \frac{q_s^2}{\langle q^2 \rangle_s} \sim \frac{\chi^2_{5S}}{5S}

    A symmetric tensor without trace has five components, which for many independent branches are
    normal, alike and independent.

    Parameters
    ----------
    seeds : int
        S.
    confidence : float

    Returns
    -------
    low, high : float
        [-]

    Examples
    --------
    >>> [round(limit, 3) for limit in chance_range(1)]
    [0.408, 1.602]
    """
    from scipy.special import chdtri  # slow to import, and few jobs need it

    above = np.array([(1.0 + confidence) / 2.0, (1.0 - confidence) / 2.0])
    low, high = np.sqrt(chdtri(5.0 * seeds, above) / (5.0 * seeds))
    return float(low), float(high)


def fabric_result(
    vectors: Sequence[ArrayLike], forces: Sequence[ArrayLike], *, confidence: float = 0.95
) -> tuple[list[dict[str, float]], dict[str, dict[str, float]]]:
    r"""Return the fabric of every seed, and whether it is as isotropic as chance allows.

    Independent branches would be in `chance_range`. The branches of one grain keep away from each
    other, so a packing at rest is evener than chance; contact networks that lean one way are less
    even.

    Parameters
    ----------
    vectors : list of array_like, shape (M, 3)
        Branch vectors of each seed [m].
    forces : list of array_like, shape (M,)
        Normal forces, in the same order [N].
    confidence : float
        Of the range by chance.

    Returns
    -------
    rows : list of dict
        Of each seed: branches, deviator and expected_deviator, force_deviator and
        expected_force_deviator.
    summary : dict
        Of `branches` and `forces`: the root mean square of the deviator over the expected one, its
        range by chance (low, high), and the deviator of the mean tensor of all seeds with what
        chance gives it.

    Examples
    --------
    >>> axes = np.eye(3)
    >>> rows, summary = fabric_result([axes], [[1.0, 1.0, 2.0]])
    >>> rows[0]["deviator"], round(rows[0]["force_deviator"], 12)
    (0.0, 0.25)
    """
    rows: list[dict[str, float]] = [{"branches": np.size(force)} for force in forces]
    summary = {}
    weighed: dict[str, tuple[str, Sequence[ArrayLike | None]]] = {
        "branches": ("", [None] * len(rows)),
        "forces": ("force_", forces),
    }
    for kind, (key, weights) in weighed.items():
        tensors, numbers = [], []
        for row, vector, weight in zip(rows, vectors, weights, strict=True):
            tensor = fabric_tensor(vector, weight)
            number = effective_branches(int(row["branches"]), weight)
            row[f"{key}deviator"] = float(deviator(tensor))
            row[f"expected_{key}deviator"] = expected_deviator(number)
            tensors.append(tensor)
            numbers.append(number)
        summary[kind] = _of_seeds(np.array(tensors), np.array(numbers), confidence)
    return rows, summary


def _of_seeds(tensors: NDArray, numbers: NDArray, confidence: float) -> dict[str, float]:
    low, high = chance_range(len(numbers), confidence)
    over_expected = deviator(tensors) ** 2 * numbers
    return {
        "deviator_over_expected": float(np.sqrt(over_expected.mean())),
        "by_chance_low": low,
        "by_chance_high": high,
        "deviator_of_mean": float(deviator(np.mean(tensors, axis=0))),
        "expected_deviator_of_mean": float(np.sqrt(np.sum(1.0 / numbers)) / len(numbers)),
    }


def orientation_band(branches: int, sectors: int, confidence: float = 0.95) -> tuple[float, float]:
    r"""Return the range by chance of a sector of a rose of orientations, over its mean.

    .. math:: \left[ Q(\tfrac{1-c}{2}),\; Q(\tfrac{1+c}{2}) \right] \frac{k}{M}

    with Q the quantile of the binomial distribution of M draws, each in one of k equal sectors.

    Parameters
    ----------
    branches : int
        M, independent and isotropic.
    sectors : int
        k, that the branches fall in alike.
    confidence : float
        c, share of the sectors that lie in the range [-].

    Returns
    -------
    tuple of float
        Lower and upper end [-].

    Examples
    --------
    >>> [round(end, 3) for end in orientation_band(1200, 12)]
    [0.82, 1.19]

    References
    ----------
    Rothenburg and Bathurst (1989), Geotechnique 39, 601, for roses of contact orientation.
    """
    # Not of scipy.stats, which takes longer to import than a rose to draw.
    from scipy.special import bdtr, bdtrik

    share = np.array([0.5 - confidence / 2.0, 0.5 + confidence / 2.0])
    above = np.ceil(bdtrik(share, branches, 1.0 / sectors))
    # The inverse of the distribution is of real numbers: where rounding took it to the next one.
    below = np.maximum(above - 1.0, 0.0)
    ends = np.where(bdtr(below, branches, 1.0 / sectors) >= share, below, above)
    low, high = ends * sectors / branches
    return float(low), float(high)
