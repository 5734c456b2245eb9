"""Branch lengths: how many there are in a volume, and how their lengths are distributed."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.branches.random_contacts import random_contact_moment, random_contact_shares
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.geometry import solid_volume


def number_of_grains(volume: float, void_ratio: float, cube_of_radius: float) -> float:
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


def branch_density(coordination_number: float, void_ratio: float, cube_of_radius: float) -> float:
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


def length_histogram(length: ArrayLike, edges: ArrayLike) -> tuple[NDArray, NDArray]:
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


def branch_length_table(
    lengths: Sequence[ArrayLike],
    grading: Grading,
    edges: ArrayLike,
    predicted: Mapping[str, ArrayLike] | None = None,
) -> dict[str, NDArray]:
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
    ends = np.asarray(edges, dtype=float)
    width = np.diff(ends)
    counts, density = length_histogram(np.concatenate(lengths), ends)
    single = np.array([length_histogram(seed, ends)[1] for seed in lengths])
    enough = len(lengths) > 1
    error = single.std(axis=0, ddof=1) / np.sqrt(len(lengths)) if enough else np.nan * density
    return {
        "length_low_m": ends[:-1],
        "length_high_m": ends[1:],
        "branches": counts,
        "density_measured_per_m": density,
        "density_measured_standard_error_per_m": error,
        "density_random_contact_per_m": random_contact_shares(grading, ends) / width,
        **{
            f"density_{name}_per_m": np.asarray(shares) / width
            for name, shares in (predicted or {}).items()
        },
    }


def branch_statistics(
    radii: Sequence[ArrayLike],
    lengths: Sequence[ArrayLike],
    volumes: Sequence[float],
    coordination_numbers: Sequence[float],
    grading: Grading,
) -> dict[str, float]:
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

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> cell = 2.0 * solid_volume([1.0, 1.0])  # two unit spheres that touch, void ratio 1
    >>> result = branch_statistics([[1.0, 1.0]], [[2.0]], [cell], [1.0], single(1.0))
    >>> round(result["grains_eq2"], 9), result["branches"], result["mean_length_1_m1"]
    (2.0, 1.0, 2.0)

    References
    ----------
    Paper, Eqs. 2 to 6.
    """
    target_cube = grading.moment(3)
    seeds = [
        _seed_statistics(np.asarray(radius), np.asarray(length), volume, kappa, target_cube)
        for radius, length, volume, kappa in zip(
            radii, lengths, volumes, coordination_numbers, strict=True
        )
    ]
    result = {key: float(np.mean([seed[key] for seed in seeds])) for key in seeds[0]}
    result |= {f"target_radius_{k}_m{k}": grading.moment(k) for k in (1, 2, 3)}
    return result | {f"eq4_length_{k}_m{k}": random_contact_moment(grading, k) for k in (1, 2, 3)}


def _seed_statistics(
    radius: NDArray, length: NDArray, volume: float, kappa: float, target_cube: float
) -> dict[str, float]:
    void_ratio, cube = volume / solid_volume(radius) - 1.0, float(np.mean(radius**3))
    return {
        "grains": radius.size,
        "grains_eq2": number_of_grains(volume, void_ratio, cube),
        "grains_eq2_target": number_of_grains(volume, void_ratio, target_cube),
        "branches": length.size,
        "branch_density_per_m3": length.size / volume,
        "branch_density_eq3_per_m3": branch_density(kappa, void_ratio, cube),
        "branch_density_eq3_target_per_m3": branch_density(kappa, void_ratio, target_cube),
        "void_ratio": void_ratio,
        **{f"mean_radius_{k}_m{k}": float(np.mean(radius**k)) for k in (1, 2, 3)},
        **{f"mean_length_{k}_m{k}": float(np.mean(np.power(length, k))) for k in (1, 2, 3)},
    }
