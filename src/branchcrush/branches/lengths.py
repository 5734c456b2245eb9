"""Branch lengths: how many there are in a volume, and how their lengths are distributed."""

from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre

from branchcrush.gradings.distribution import Grading
from branchcrush.packings.geometry import solid_volume

# Nodes above which those of every grain are replaced by these on each panel of log R.
_MANY = 1000
_NODES, _WEIGHTS = legendre.leggauss(24)


def number_of_grains(volume, void_ratio, cube_of_radius):
    r"""Return the number of grains in a volume.

    .. math:: N = \frac{3 V}{4 \pi (1+e) \langle R^3 \rangle}

    Parameters
    ----------
    volume : float
        V [m3].
    void_ratio : float
        e [-].
    cube_of_radius : float
        <R^3> by number [m3].

    Returns
    -------
    float

    Examples
    --------
    >>> round(number_of_grains(8.0, 8.0 / (4 / 3 * 3.141592653589793) - 1.0, 1.0), 12)
    1.0

    References
    ----------
    Paper, Eq. 2.
    """
    return 3.0 * volume / (4.0 * np.pi * (1.0 + void_ratio) * cube_of_radius)


def branch_density(coordination_number, void_ratio, cube_of_radius):
    r"""Return the number of branches in a unit volume.

    .. math:: \rho = \frac{3 \kappa}{8 \pi (1+e) \langle R^3 \rangle}

    Parameters
    ----------
    coordination_number : float
        kappa, the mean over **all** grains, rattlers included [-].
    void_ratio : float
        e [-].
    cube_of_radius : float
        <R^3> by number [m3].

    Returns
    -------
    float
        [1/m3]

    Examples
    --------
    >>> round(branch_density(6.0, 1.0, 1.0), 6)
    0.358099

    References
    ----------
    Paper, Eq. 3.
    """
    return 3.0 * coordination_number / (8.0 * np.pi * (1.0 + void_ratio) * cube_of_radius)


def random_contact_shares(grading, edges):
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
        Bin edges [m]. As in `length_histogram` a length on an edge is in the bin that begins
        there, and one on the last edge in the last bin.

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
    edges = np.asarray(edges, dtype=float)
    shares = _shares_of_single_radii(*grading.discrete_part, edges)
    if grading.is_discrete:
        return shares
    return shares + [_share_with_continuous_part(grading, *ends) for ends in pairwise(edges)]


def _share_with_continuous_part(grading, low, high):
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


def _shares_of_single_radii(radii, shares, edges):
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


def random_contact_moment(grading, order):
    r"""Return the moment of branch length if every two grains were as likely to touch.

    .. math:: \langle l^n \rangle = \int\!\!\int (R + R')^n P(R) P(R')\, dR\, dR'

    For whole n it is 2<R>, 2<R^2> + 2<R>^2, 2<R^3> + 6<R><R^2>, ...

    Parameters
    ----------
    grading : Grading
        P, by number.
    order : float
        n [-].

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
    return float(weight @ (radius[:, None] + radius) ** order @ weight)


def _few(radius, weight):
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


def length_histogram(length, edges):
    """Return the counts and the density of branch lengths in bins.

    Parameters
    ----------
    length : array_like, shape (M,)
        Branch lengths [m].
    edges : array_like, shape (n+1,)
        Bin edges [m]. A length on the last edge is in the last bin.

    Returns
    -------
    counts : ndarray of int, shape (n,)
    density : ndarray, shape (n,)
        Integrates to 1 over the bins [1/m].

    Examples
    --------
    >>> counts, density = length_histogram([1.0, 1.5, 3.0], [1.0, 2.0, 3.0])
    >>> counts.tolist(), density.round(3).tolist()
    ([2, 1], [0.667, 0.333])
    """
    counts, _ = np.histogram(length, edges)
    return counts, counts / (max(counts.sum(), 1) * np.diff(edges))


def branch_length_table(lengths, grading, edges, predicted=None):
    """Return the distribution of branch length: counted, measured and predicted.

    Parameters
    ----------
    lengths : list of array_like
        Branch lengths R_i + R_j of each seed [m].
    grading : Grading
        Target.
    edges : array_like, shape (n+1,)
        Bin edges [m].
    predicted : dict of array_like, optional
        Shares of the branches in each bin by other predictions [-].

    Returns
    -------
    dict of ndarray, shape (n,)
        length_low_m, length_high_m, branches, the measured density and its standard error over
        seeds (nan with one seed), and that of Eq. 4 and of each other prediction as bin mean [1/m].

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> table = branch_length_table([[3.0]], uniform(1.0, 2.0), [2.0, 4.0])
    >>> float(table["density_random_contact_per_m"][0].round(9))
    0.5
    """
    edges, predicted = np.asarray(edges, dtype=float), predicted or {}
    counts, density = length_histogram(np.concatenate(lengths), edges)
    single = np.array([length_histogram(seed, edges)[1] for seed in lengths])
    enough = len(lengths) > 1
    error = single.std(axis=0, ddof=1) / np.sqrt(len(lengths)) if enough else np.nan * density
    return {
        "length_low_m": edges[:-1],
        "length_high_m": edges[1:],
        "branches": counts,
        "density_measured_per_m": density,
        "density_measured_standard_error_per_m": error,
        "density_random_contact_per_m": random_contact_shares(grading, edges) / np.diff(edges),
        **{
            f"density_{name}_per_m": np.asarray(predicted[name]) / np.diff(edges)
            for name in predicted
        },
    }


def branch_statistics(radii, lengths, volumes, coordination_numbers, grading):
    r"""Return N, rho and the moments of R and l, counted and by Eqs. 2 to 4, over all seeds.

    Eqs. 2 and 3 are identities for the radii that were really drawn; for the target grading they
    hold up to how well N grains represent it. Both are given.

    Parameters
    ----------
    radii : list of array_like
        Radii of each seed's grains [m].
    lengths : list of array_like
        Branch lengths of each seed [m].
    volumes, coordination_numbers : array_like, shape (S,)
        Volume of the cell [m3], and kappa over all grains [-], of each seed.
    grading : Grading
        Target.

    Returns
    -------
    dict
        Means over seeds; lengths in m, densities in 1/m3.
    """
    means = []
    for radius, length, volume, kappa in zip(
        radii, lengths, volumes, coordination_numbers, strict=True
    ):
        radius = np.asarray(radius)
        solid = solid_volume(radius)
        void_ratio, cube = volume / solid - 1.0, np.mean(radius**3)
        target_cube = grading.moment(3)
        means.append(
            {
                "grains": radius.size,
                "grains_eq2": number_of_grains(volume, void_ratio, cube),
                "grains_eq2_target": number_of_grains(volume, void_ratio, target_cube),
                "branches": len(length),
                "branch_density_per_m3": len(length) / volume,
                "branch_density_eq3_per_m3": branch_density(kappa, void_ratio, cube),
                "branch_density_eq3_target_per_m3": branch_density(kappa, void_ratio, target_cube),
                "void_ratio": void_ratio,
                **{f"mean_radius_{k}_m{k}": np.mean(radius**k) for k in (1, 2, 3)},
                **{f"mean_length_{k}_m{k}": np.mean(np.power(length, k)) for k in (1, 2, 3)},
            }
        )
    result = {key: float(np.mean([row[key] for row in means])) for key in means[0]}
    result |= {f"target_radius_{k}_m{k}": grading.moment(k) for k in (1, 2, 3)}
    return result | {f"eq4_length_{k}_m{k}": random_contact_moment(grading, k) for k in (1, 2, 3)}
