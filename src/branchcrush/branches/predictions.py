"""Predicted distributions of branch length, and how far each is from the measured one.

In all of them but Eq. 4 two grains touch by their contact numbers: Q(R) = c(R) P(R)/kappa.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.branches.coordination_models import MODELS
from branchcrush.branches.nodes import CELLS, grading_nodes
from branchcrush.branches.random_contacts import random_contact_shares
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading

# A prime: no sum of two radii that are simple fractions of each other lies on an edge.
_BINS = 997
# A mode is where most branches are within this share of the whole range.
_MODE_WINDOW = 0.1


class Look(NamedTuple):
    """How figures show a prediction."""

    label: str
    color: str
    marker: str


# All that branch lengths are compared with, in the order of figures. Two are no models of contact
# numbers: Eq. 4 needs none, and the last takes those that were measured.
PREDICTIONS = {
    "random_contact": Look("Eq. 4, any two alike", "#c1440e", "s"),
    **{name: Look(model.label, model.color, model.marker) for name, model in MODELS.items()},
    "configuration": Look("measured contact numbers", "#1f4e79", "P"),
}


class Prediction(NamedTuple):
    """What a model says of a grading."""

    shares: NDArray  # of the branches in each bin of length [-]
    radius: NDArray  # nodes of the grading, shape (K,) [m]; empty for Eq. 4
    share: NDArray  # their share of the grains [-]
    contacts: NDArray  # c(R) at the nodes [-]
    load_bearing: NDArray  # share of the grains of each node [-]


def fine_edges(radius_min: float, radius_max: float) -> NDArray:
    """Return the edges of narrow bins of branch length, in which distributions are compared.

    Parameters
    ----------
    radius_min, radius_max : float
        [m]

    Returns
    -------
    ndarray, shape (998,)
        [m]; a little beyond both ends, so that no branch lies on one.

    Examples
    --------
    >>> edges = fine_edges(1.0, 2.0)
    >>> bool(edges[0] < 2.0 and edges[-1] > 4.0)
    True
    """
    margin = 1e-3 * radius_max
    return np.linspace(2.0 * radius_min - margin, 2.0 * radius_max + margin, _BINS + 1)


def pair_shares(radius: ArrayLike, touched: ArrayLike, edges: ArrayLike) -> NDArray:
    r"""Return the shares of branch lengths when ends are drawn independently, by their contacts.

    .. math:: B(l) = \int Q(R)\, Q(l - R)\, dR

    Parameters
    ----------
    radius : array_like, shape (K,)
        [m]
    touched : array_like, shape (K,)
        Contacts that grains of this radius have, Q of any scale.
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    ndarray, shape (n,)
        [-]

    Examples
    --------
    >>> pair_shares([1.0, 2.0], [1.0, 3.0], [1.5, 2.5, 3.5, 4.5]).tolist()
    [0.0625, 0.375, 0.5625]
    """
    ends = np.asarray(touched) / np.sum(touched)
    length = np.add.outer(radius, radius)
    return np.histogram(length.ravel(), edges, weights=np.outer(ends, ends).ravel())[0]


def predictions(grading: Grading, edges: ArrayLike) -> dict[str, Prediction]:
    """Return what Eq. 4 and every model of contact numbers say of a grading.

    Parameters
    ----------
    grading : Grading
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    dict of Prediction
        `random_contact` (Eq. 4), then those of `branches.coordination_models.MODELS`; a model that
        does not hold for the grading is left out.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> edges = np.array([2.0, 3.0, 4.0])
    >>> for name, prediction in predictions(uniform(1.0, 2.0), edges).items():
    ...     print(name, prediction.shares.round(2))
    random_contact [0.5 0.5]
    mean_neighbour [0.38 0.62]
    surface [0.39 0.61]
    self_consistent [0.38 0.62]
    parking [0.35 0.65]
    rods [0.42 0.58]
    """
    nothing = np.empty(0)
    shares = random_contact_shares(grading, edges)
    predicted = {"random_contact": Prediction(shares, nothing, nothing, nothing, nothing)}
    radius, share = grading_nodes(grading)
    for name, model in MODELS.items():
        try:
            contacts, bearing = model.contacts(radius, share)
        except FitError:
            continue
        shares = pair_shares(radius, share * contacts, edges)
        predicted[name] = Prediction(shares, radius, share, contacts, bearing)
    return predicted


def binned_predictions(models: Mapping[str, Prediction], edges: ArrayLike) -> dict[str, NDArray]:
    """Return the shares of the branches by the models of contact numbers in other bins.

    Parameters
    ----------
    models : dict of Prediction
        From `predictions`.
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    dict of ndarray, shape (n,)
        [-]; without Eq. 4, which has no contact numbers.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> edges = np.array([1.0, 2.0, 3.0])
    >>> binned_predictions(predictions(single(1.2), edges), edges)["parking"].tolist()
    [0.0, 1.0]
    """
    return {
        name: pair_shares(model.radius, model.share * model.contacts, edges)
        for name, model in models.items()
        if model.radius.size
    }


def lumped(
    radius: ArrayLike, contacts: ArrayLike, cells: int = 2 * CELLS, order: NDArray | None = None
) -> tuple[NDArray, NDArray]:
    """Return grains in groups of nearly one radius: mean radius, and contacts of all of the group.

    Parameters
    ----------
    radius, contacts : array_like, shape (N,)
        Of each grain [m], [-].
    cells : int
        Groups at most.
    order : array_like of int, shape (N,), optional
        The stable one of increasing radius, for who asks for many states of the same grains.

    Returns
    -------
    radius, touched : ndarray, shape (K,)
        [m], [-]

    Examples
    --------
    >>> [part.tolist() for part in lumped([1.0, 2.0, 1.0], [3, 9, 5])]
    [[1.0, 2.0], [8.0, 9.0]]
    """
    radii, ends = np.asarray(radius, dtype=float), np.asarray(contacts, dtype=float)
    order = np.argsort(radii, kind="stable") if order is None else order
    ascending = np.cumsum(np.diff(radii[order], prepend=radii[order[:1]]) > 0.0)
    if ascending[-1] >= cells:
        # As many grains and contacts in each: the few that most branches end at are told apart.
        weight = np.cumsum(1.0 / radii.size + ends[order] / max(ends.sum(), 1.0))
        ascending = np.minimum(weight / weight[-1] * cells, cells - 1).astype(int)
        # Numbered without gaps.
        ascending = np.cumsum(np.diff(ascending, prepend=ascending[:1]) > 0)
    group = np.empty(radii.size, dtype=int)
    group[order] = ascending
    number = np.bincount(group)
    return np.bincount(group, radii) / number, np.bincount(group, ends)


def distances(counts: ArrayLike, shares: ArrayLike, edges: ArrayLike) -> dict[str, float]:
    r"""Return how far a predicted distribution of branch length is from the measured one.

    .. math:: D = \max_l |F(l) - \hat F(l)|

    Parameters
    ----------
    counts : array_like, shape (n,)
        Branches measured in narrow bins.
    shares : array_like, shape (n,)
        Predicted [-].
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    dict
        kolmogorov_smirnov [-]; mean_length_m and mode_length_m of the prediction.

    Examples
    --------
    >>> distances([2, 2], [0.25, 0.75], [1.0, 2.0, 3.0])["kolmogorov_smirnov"]
    0.25
    """
    measured = np.cumsum(counts) / np.sum(counts)
    predicted = np.cumsum(shares) / np.sum(shares)
    return {
        "kolmogorov_smirnov": float(np.abs(measured - predicted).max()),
        "mean_length_m": mean_length(shares, edges),
        "mode_length_m": mode_length(shares, edges),
    }


def mean_length(shares: ArrayLike, edges: ArrayLike) -> float:
    """Return the mean branch length of a distribution in narrow bins.

    Parameters
    ----------
    shares : array_like, shape (n,)
        Counts or shares of the branches in narrow bins.
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    float
        [m]

    Examples
    --------
    >>> mean_length([1, 3], [1.0, 2.0, 3.0])
    2.25
    """
    ends = np.asarray(edges, dtype=float)
    return float(np.average((ends[:-1] + ends[1:]) / 2.0, weights=np.asarray(shares)))


def mode_length(shares: ArrayLike, edges: ArrayLike) -> float:
    """Return the middle of the tenth of the range in which most branches are.

    Single narrow bins are too noisy to tell.

    Parameters
    ----------
    shares : array_like, shape (n,)
        Counts or shares of the branches in narrow bins.
    edges : array_like, shape (n+1,)
        Bin edges, evenly spaced [m].

    Returns
    -------
    float
        [m]

    Examples
    --------
    >>> round(mode_length(np.exp(-np.linspace(-3.0, 2.0, 500) ** 2), np.linspace(0, 5, 501)), 1)
    3.0
    """
    ends = np.asarray(edges, dtype=float)
    below = np.append(0.0, np.cumsum(shares))
    width = max(round(_MODE_WINDOW * np.size(shares)), 1)
    inside = below[width:] - below[:-width]
    # The middle of all that hold the most: single lengths give a plateau.
    most = np.flatnonzero(inside >= inside.max() * (1.0 - 1e-12))
    first = most[: np.flatnonzero(np.diff(np.append(most, most[-1] + 2)) > 1)[0] + 1].mean()
    return float(np.interp(first + width / 2.0, np.arange(ends.size), ends))
