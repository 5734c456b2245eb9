"""The fabric: how evenly the branches point in all directions, beside what chance would give."""

import numpy as np


def fabric_tensor(vectors, weights=None):
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
    vectors = np.asarray(vectors, dtype=float)
    normals = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    weights = np.ones(len(normals)) if weights is None else np.asarray(weights, dtype=float)
    return (normals * (weights / weights.sum())[:, None]).T @ normals


def deviator(tensor):
    r"""Return the size of a fabric tensor's deviator, 0 for an isotropic one.

    .. math:: q = \sqrt{\tfrac{3}{2}}\, \left\| \mathbf{F} - \mathbf{I}/3 \right\|

    Parameters
    ----------
    tensor : array_like, shape (..., 3, 3)

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


def effective_branches(number, weights=None):
    r"""Return how many equal branches have as much sampling noise as weighted ones.

    .. math:: M_{\mathrm{eff}} = \frac{(\sum_b w_b)^2}{\sum_b w_b^2}

    Parameters
    ----------
    number : int
        M.
    weights : array_like, shape (M,), optional

    Returns
    -------
    float

    Examples
    --------
    >>> effective_branches(2, [1.0, 3.0])
    1.6
    """
    if weights is None:
        return float(number)
    weights = np.asarray(weights, dtype=float)
    return float(weights.sum() ** 2 / (weights @ weights))


def expected_deviator(branches):
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

    Examples
    --------
    >>> expected_deviator(100)
    0.1
    """
    return float(1.0 / np.sqrt(branches))


def chance_range(seeds, confidence=0.95):
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

    Examples
    --------
    >>> [round(limit, 3) for limit in chance_range(1)]
    [0.408, 1.602]
    """
    from scipy.special import chdtri  # slow to import, and few jobs need it

    above = np.array([(1.0 + confidence) / 2.0, (1.0 - confidence) / 2.0])
    low, high = np.sqrt(chdtri(5.0 * seeds, above) / (5.0 * seeds))
    return float(low), float(high)


def fabric_result(vectors, forces, *, confidence=0.95):
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
    """
    rows, tensors, branches = [], {"branches": [], "forces": []}, {"branches": [], "forces": []}
    for vector, force in zip(vectors, forces, strict=True):
        row = {"branches": len(force)}
        for kind, key, weights in (("branches", "", None), ("forces", "force_", force)):
            tensor = fabric_tensor(vector, weights)
            number = effective_branches(len(force), weights)
            row[f"{key}deviator"] = float(deviator(tensor))
            row[f"expected_{key}deviator"] = expected_deviator(number)
            tensors[kind].append(tensor)
            branches[kind].append(number)
        rows.append(row)
    low, high = chance_range(len(rows), confidence)
    summary = {}
    for kind in tensors:
        single = deviator(np.array(tensors[kind])) ** 2 * np.array(branches[kind])
        noise = np.sqrt(np.sum(1.0 / np.array(branches[kind]))) / len(rows)
        summary[kind] = {
            "deviator_over_expected": float(np.sqrt(single.mean())),
            "by_chance_low": low,
            "by_chance_high": high,
            "deviator_of_mean": float(deviator(np.mean(tensors[kind], axis=0))),
            "expected_deviator_of_mean": float(noise),
        }
    return rows, summary
