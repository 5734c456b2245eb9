"""What is asked of a grading: its curves and diameters, and how near a packing comes to them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.forms import fractal


def particle_diameter(grading: Grading, percent: float) -> float:
    r"""Return D_x, the diameter that x percent of the mass is finer than, as D10, D50 or D60.

    .. math:: F(D_x/2) = x/100

    Parameters
    ----------
    grading : Grading
    percent : float
        x, 0 to 100 [%].

    Returns
    -------
    float
        [m]; nan beyond 0 to 100 %.

    Examples
    --------
    >>> from branchcrush.gradings.forms import fuller
    >>> round(particle_diameter(fuller(1.0, 9.0, 0.5), 50.0), 9)
    8.0
    """
    return 2.0 * float(grading.mass_ppf(percent / 100.0))


def grading_summary(grading: Grading) -> dict[str, float]:
    r"""Return the diameters, coefficients and moments that a grading is known by.

    .. math:: C_u = D_{60}/D_{10}, \qquad C_c = D_{30}^2/(D_{10} D_{60})

    Parameters
    ----------
    grading : Grading

    Returns
    -------
    dict of float
        D_min_m and D_max_m; D10_m, D30_m, D50_m and D60_m by mass; uniformity_coefficient and
        curvature_coefficient; mean_radius_1_m1, _2_m2 and _3_m3 by number.

    Examples
    --------
    >>> from branchcrush.gradings.forms import fuller
    >>> summary = grading_summary(fuller(1e-9, 1.0, 0.5))
    >>> round(summary["uniformity_coefficient"], 2), round(summary["curvature_coefficient"], 2)
    (35.98, 2.25)

    References
    ----------
    ASTM D2487 for the coefficients.
    """
    d10, d30, d50, d60 = (particle_diameter(grading, percent) for percent in (10, 30, 50, 60))
    smallest, largest = (2.0 * radius for radius in grading.support())
    return {
        "D_min_m": smallest,
        "D_max_m": largest,
        "D10_m": d10,
        "D30_m": d30,
        "D50_m": d50,
        "D60_m": d60,
        "uniformity_coefficient": d60 / d10,
        "curvature_coefficient": d30**2 / (d10 * d60),
        **{f"mean_radius_{k}_m{k}": grading.moment(k) for k in (1, 2, 3)},
    }


def ultimate_grading(grading: Grading, alpha: float) -> Grading | None:
    r"""Return the fractal grading on the sizes of another: what crushing it completely leads to.

    .. math:: P(R) \propto R^{-(1+\alpha)}, \quad R_m \le R \le R_M

    Parameters
    ----------
    grading : Grading
    alpha : float
        Fractal dimension [-].

    Returns
    -------
    Grading or None
        None for a single size, which leaves no room for finer ones.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> ultimate_grading(uniform(1.0, 9.0), 2.6).support()
    (1.0, 9.0)

    References
    ----------
    Einav (2007), J. Mech. Phys. Solids 55, 1274-1297.
    """
    smallest, largest = grading.support()
    return fractal(smallest, largest, alpha) if smallest < largest else None


def realised_percent_finer(radii: ArrayLike, radius: ArrayLike) -> tuple[NDArray, NDArray]:
    r"""Return the percent of the mass, and of the number, of a packing's grains up to a radius.

    .. math:: 100\, \frac{\sum_{R_i \le r} R_i^3}{\sum_i R_i^3}, \qquad
        \frac{100}{N} \sum_{R_i \le r} 1

    Parameters
    ----------
    radii : array_like, shape (N,)
        Radii of the grains [m].
    radius : array_like, shape (n,)
        Where to read the curves [m].

    Returns
    -------
    by_mass, by_number : ndarray, shape (n,)
        [%]

    Examples
    --------
    >>> by_mass, by_number = realised_percent_finer([1.0, 2.0], [1.0, 2.0])
    >>> by_mass.round(3).tolist(), by_number.tolist()
    ([11.111, 100.0], [50.0, 100.0])
    """
    radii = np.sort(radii)
    volume = np.concatenate([[0.0], np.cumsum(radii**3)])
    finer = np.searchsorted(radii, radius, side="right")
    return 100.0 * volume[finer] / volume[-1], 100.0 * finer / radii.size


def grading_table(
    grading: Grading,
    radii: Sequence[ArrayLike],
    ultimate: Grading | None = None,
    points: int = 200,
) -> dict[str, NDArray]:
    """Return the target and the realised grading, by number and as percent finer by mass.

    Parameters
    ----------
    grading : Grading
        Target.
    radii : list of array_like
        Radii of each seed's grains [m].
    ultimate : Grading, optional
        The one that crushing ends in.
    points : int
        Rows; the diameters are even in their logarithm.

    Returns
    -------
    dict of ndarray, shape (points,)
        diameter_m, density_target_per_m (by number, of the diameter; nan where a discrete part
        has none), percent_finer_* of target and realised by number and by mass; of the realised
        ones the mean and both extremes of the seeds by mass; of the ultimate one, if it is given,
        by mass and by number.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> table = grading_table(uniform(1.0, 3.0), [[1.5, 2.5]])
    >>> float(table["percent_finer_by_mass_target"][-1])
    100.0
    """
    radius = _radii_of_rows([grading] if ultimate is None else [grading, ultimate], points)
    curves = [realised_percent_finer(seed, radius) for seed in radii]
    by_mass, by_number = (np.array(kind) for kind in zip(*curves, strict=True))
    table = {
        "diameter_m": 2.0 * radius,
        "density_target_per_m": grading.number_pdf(radius) / 2.0,
        "percent_finer_by_number_target": 100.0 * grading.number_cdf(radius),
        "percent_finer_by_number_realised": by_number.mean(axis=0),
        "percent_finer_by_mass_target": 100.0 * grading.mass_cdf(radius),
        "percent_finer_by_mass_realised": by_mass.mean(axis=0),
        "percent_finer_by_mass_realised_min": by_mass.min(axis=0),
        "percent_finer_by_mass_realised_max": by_mass.max(axis=0),
    }
    if ultimate is not None:
        table["percent_finer_by_mass_ultimate"] = 100.0 * ultimate.mass_cdf(radius)
        table["percent_finer_by_number_ultimate"] = 100.0 * ultimate.number_cdf(radius)
    return table


def _radii_of_rows(gradings: Sequence[Grading], points: int) -> NDArray:
    ends = np.array([grading.support() for grading in gradings])
    start, end = ends.min(), ends.max()
    if not all(grading.has_density for grading in gradings):
        # The steps at single sizes stand clear of the ends.
        start, end = 0.9 * start, 1.1 * end
    return np.geomspace(start, end, points)
