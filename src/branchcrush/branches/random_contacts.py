"""Branch lengths if every two grains were as likely to touch: Eq. 4 of the paper."""

from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray

from branchcrush.gradings.distribution import Grading

# Nodes above which those of every grain are replaced by these on each panel of log R.
_MANY = 1000
_NODES, _WEIGHTS = legendre.leggauss(24)


def random_contact_shares(grading: Grading, edges: ArrayLike) -> NDArray:
    r"""Return the share of branch lengths in each bin if every two grains were as likely to touch.

    .. math:: B(l) = \int_{\max(R_m,\, l-R_M)}^{\min(R_M,\, l-R_m)} P(R)\, P(l-R)\, dR, \qquad
        \int_a^b B(l)\, dl = \langle F(b-R) - F(a-R) \rangle

    with F the cumulative distribution of P, so that gradings of single sizes have it as well. The
    limits are those of the support; the paper's, l - R_M to l - R_m, leave it. The paper's
    denominator is 1. Neighbours that depend on size are left out, and they do depend on it: in a
    dense packing large grains have more contacts and the measured lengths are longer.

    Parameters
    ----------
    grading : Grading
        P, by number.
    edges : array_like, shape (n+1,)
        Bin edges [m]. A length on an edge is in the bin that begins there, and one on the last
        edge in the last bin, as in `lengths.length_histogram`.

    Returns
    -------
    ndarray, shape (n,)
        [-]

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> from branchcrush.gradings.forms import uniform
    >>> random_contact_shares(uniform(1.0, 2.0), [2.0, 2.5, 3.0, 4.0]).round(12).tolist()
    [0.125, 0.375, 0.5]
    >>> random_contact_shares(single(1.0), [1.0, 2.0, 3.0]).tolist()
    [0.0, 1.0]

    References
    ----------
    Paper, Eq. 4; Oda (1980).
    """
    ends = np.asarray(edges, dtype=float)
    radii, of_radii = grading.discrete_part
    shares = _shares_of_single_radii(radii, of_radii, ends)
    if grading.is_discrete:
        return shares
    return shares + [_share_with_continuous_part(grading, *pair) for pair in pairwise(ends)]


def _share_with_continuous_part(grading: Grading, low: float, high: float) -> float:
    # As a function of R, F(l - R) has the kinks of F at l - R.
    breaks = np.concatenate([length - grading.breaks for length in (low, high)])
    radius, weight = grading.quadrature(breaks=breaks)
    radii, shares = grading.discrete_part
    continuous = slice(radius.size - radii.size)
    radius, weight = radius[continuous], weight[continuous]
    share = weight @ grading.number_between(low - radius, high - radius)
    if grading.has_density:
        return share
    # A pair of both kinds comes in two orders. Pairs of single radii are counted apart.
    others = Grading(radii=radii, weights=shares).number_between(low - radius, high - radius)
    return share + shares.sum() * (weight @ others)


def _shares_of_single_radii(radii: NDArray, shares: NDArray, edges: NDArray) -> NDArray:
    cumulative = np.append(0.0, np.cumsum(shares))
    below = np.zeros(edges.size)
    for k, edge in enumerate(edges):
        last = k == edges.size - 1
        smaller = np.less_equal if last else np.less
        count = np.searchsorted(radii, edge - radii, side="right" if last else "left")
        # Rounded, the difference may miss a sum that lies on the edge.
        more = smaller(radii + radii[np.minimum(count, radii.size - 1)], edge)
        count += more & (count < radii.size)
        count -= ~smaller(radii + radii[np.maximum(count - 1, 0)], edge) & (count > 0)
        below[k] = shares @ cumulative[count]
    return np.diff(below)


def random_contact_moment(
    grading: Grading, order: float, neighbours: Grading | None = None
) -> float:
    r"""Return the moment of branch length if every two grains were as likely to touch.

    .. math:: \langle l^n \rangle = \int\!\!\int (R + R')^n P(R) P'(R')\, dR\, dR'

    For whole n and P' = P it is 2<R>, 2<R^2> + 2<R>^2, 2<R^3> + 6<R><R^2>, ...

    Parameters
    ----------
    grading : Grading
        P, by number.
    order : float
        n [-].
    neighbours : Grading, optional
        P', by number, of the grain at the other end; P if left out.

    Returns
    -------
    float
        [m^n]

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> round(random_contact_moment(uniform(1.0, 3.0), 1.0), 12)
    4.0

    References
    ----------
    Paper, Eqs. 4 to 6.
    """
    radius, weight = _few(*grading.quadrature())
    other, its_weight = (radius, weight) if neighbours is None else _few(*neighbours.quadrature())
    return float(weight @ (radius[:, None] + other) ** order @ its_weight)


def _few(radius: NDArray, weight: NDArray) -> tuple[NDArray, NDArray]:
    """Return nodes and weights with the same mean of any smooth function, but not one per grain."""
    if radius.size <= _MANY:
        return radius, weight
    # Onto Legendre's nodes, with the weights that keep every polynomial's mean on each panel.
    logs = np.log(radius)
    ends = np.linspace(logs.min(), logs.max(), int(np.ptp(logs) / 0.5) + 2)
    half, panel = (ends[1] - ends[0]) / 2.0, np.searchsorted(ends[1:-1], logs, side="right")
    basis = legendre.legvander((logs - ends[panel]) / half - 1.0, _NODES.size - 1)
    means = np.array([np.bincount(panel, weight * b, ends.size - 1) for b in basis.T])
    orders = np.arange(_NODES.size) + 0.5
    weights = (legendre.legvander(_NODES, _NODES.size - 1) * orders) @ means * _WEIGHTS[:, None]
    return np.exp(ends[:-1] + half * (_NODES[:, None] + 1.0)).ravel(), weights.ravel()
