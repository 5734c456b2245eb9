"""Branch lengths: how many there are in a volume, and how their lengths are distributed."""

import numpy as np

from branchcrush.gradings import quadrature, raw_moment

_POINTS = np.polynomial.legendre.leggauss(96)


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


def random_contact_density(grading, length):
    r"""Return the density of branch lengths if every two grains were as likely to touch.

    .. math:: B(l) = \int_{\max(R_m,\, l-R_M)}^{\min(R_M,\, l-R_m)} P(R)\, P(l-R)\, dR

    The limits are those of the support; the paper's, l - R_M to l - R_m, leave it. The paper's
    denominator is 1. Neighbours that depend on size are left out, and they do depend on it: in a
    dense packing large grains have more contacts and the measured lengths are longer.

    Parameters
    ----------
    grading : scipy.stats frozen distribution
        P, by number [1/m].
    length : array_like, shape (n,)
        l [m].

    Returns
    -------
    ndarray, shape (n,)
        [1/m]

    Examples
    --------
    >>> from branchcrush.gradings import uniform
    >>> random_contact_density(uniform(1.0, 2.0), [2.5, 3.0, 3.5]).round(9).tolist()
    [0.5, 1.0, 0.5]

    References
    ----------
    Paper, Eq. 4; Oda (1980).
    """
    radius_min, radius_max = grading.support()
    length = np.atleast_1d(np.asarray(length, dtype=float))[:, None]
    # By symmetry twice the half up to l/2, in log R: both densities may be steep near R_m.
    lower = np.maximum(radius_min, length - radius_max)
    inside = (length / 2.0 >= lower) & (length > 2.0 * radius_min) & (length < 2.0 * radius_max)
    log_lower, log_upper = np.log(lower), np.log(np.where(inside, length / 2.0, lower))
    half = (log_upper - log_lower) / 2.0
    radius = np.exp(log_lower + half * (_POINTS[0] + 1.0))
    # Rounding may put a node an ulp outside the support, where a density is 0.
    other = np.clip(length - radius, radius_min, radius_max)
    values = grading.pdf(np.clip(radius, radius_min, radius_max)) * grading.pdf(other) * radius
    return 2.0 * (half * values) @ _POINTS[1]


def random_contact_moment(grading, order):
    r"""Return the moment of branch length if every two grains were as likely to touch.

    .. math:: \langle l^n \rangle = \int\!\!\int (R + R')^n P(R) P(R')\, dR\, dR'

    For whole n it is 2<R>, 2<R^2> + 2<R>^2, 2<R^3> + 6<R><R^2>, ...

    Parameters
    ----------
    grading : scipy.stats frozen distribution
        P, by number [1/m].
    order : float
        n [-].

    Returns
    -------
    float
        [m^n]

    Examples
    --------
    >>> from branchcrush.gradings import uniform
    >>> round(random_contact_moment(uniform(1.0, 3.0), 1.0), 12)
    4.0

    References
    ----------
    Paper, Eqs. 4 to 6.
    """
    radius, weight = quadrature(grading)
    return float(weight @ (radius[:, None] + radius) ** order @ weight)


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


def branch_length_table(lengths, grading, edges):
    """Return the distribution of branch length: counted, measured and predicted.

    Parameters
    ----------
    lengths : list of array_like
        Branch lengths R_i + R_j of each seed [m].
    grading : scipy.stats frozen distribution
        Target, by number [1/m].
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    dict of ndarray, shape (n,)
        length_low_m, length_high_m, branches, the measured density and its standard error over
        seeds (nan with one seed), and that of Eq. 4 as bin mean [1/m].

    Examples
    --------
    >>> from branchcrush.gradings import uniform
    >>> table = branch_length_table([[3.0]], uniform(1.0, 2.0), [2.0, 4.0])
    >>> float(table["density_random_contact_per_m"][0].round(9))
    0.5
    """
    edges = np.asarray(edges, dtype=float)
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
        "density_random_contact_per_m": _bin_means(grading, edges),
    }


def _bin_means(grading, edges):
    # Eq. 4 is smooth on either side of its kink at R_m + R_M. Below it, it changes over each decade
    # of l - R_m, and above it of l - R_M; both run from R_m to R_M.
    share = 0.0
    for offset in grading.support():
        log_edges = np.log(np.clip(edges - offset, *grading.support()))
        half = np.diff(log_edges)[:, None] / 2.0
        rest = np.exp(log_edges[:-1, None] + half * (_POINTS[0] + 1.0))
        density = random_contact_density(grading, (offset + rest).ravel()).reshape(rest.shape)
        share = share + (half * density * rest) @ _POINTS[1]
    return share / np.diff(edges)


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
    grading : scipy.stats frozen distribution
        Target, by number [1/m].

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
        solid = 4.0 / 3.0 * np.pi * np.sum(radius**3)
        void_ratio, cube = volume / solid - 1.0, np.mean(radius**3)
        target_cube = raw_moment(grading, 3)
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
    result |= {f"target_radius_{k}_m{k}": raw_moment(grading, k) for k in (1, 2, 3)}
    return result | {f"eq4_length_{k}_m{k}": random_contact_moment(grading, k) for k in (1, 2, 3)}
