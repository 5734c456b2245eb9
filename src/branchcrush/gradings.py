"""Gradings: distributions of grain radius **by number**, and what a sieve makes of them by mass.

A grading is a frozen `scipy.stats` distribution of the radius in metres, so sampling, quantiles
and moments are SciPy's.
"""

import numpy as np
from scipy import stats

# Gauss-Legendre points per panel, and panels over the logarithm of the radius. Together they
# integrate r^k P(r) over a size ratio of 1000 to rounding for every grading of this module.
_POINTS, _PANELS = np.polynomial.legendre.leggauss(24), 16


def uniform(radius_min, radius_max):
    r"""Return the grading whose radius is uniform by number.

    .. math:: P(R) = 1/(R_M - R_m)

    Parameters
    ----------
    radius_min, radius_max : float
        Smallest and largest radius, R_m and R_M [m].

    Returns
    -------
    scipy.stats frozen distribution of the radius [m]

    Examples
    --------
    >>> float(uniform(1.0, 3.0).mean())
    2.0
    """
    return stats.uniform(loc=radius_min, scale=radius_max - radius_min)


def fractal(radius_min, radius_max, alpha):
    r"""Return the grading of fractal dimension alpha, the ultimate one of crushing models.

    .. math:: P(R) \propto R^{-(1+\alpha)}, \qquad
        F(D) = \frac{D^{3-\alpha} - D_m^{3-\alpha}}{D_M^{3-\alpha} - D_m^{3-\alpha}}

    Parameters
    ----------
    radius_min, radius_max : float
        Smallest and largest radius [m].
    alpha : float
        Fractal dimension [-], 2.5 to 2.7 for crushed rock.

    Returns
    -------
    scipy.stats frozen distribution of the radius [m]

    Examples
    --------
    >>> round(float(fractal(1.0, 16.0, 2.5).median()), 4)
    1.319

    References
    ----------
    Einav (2007), J. Mech. Phys. Solids 55, 1274-1297, for the percent finer by mass.
    """
    return stats.truncpareto(b=alpha, c=radius_max / radius_min, scale=radius_min)


def quadrature(grading, *, lower=None, upper=None):
    """Return nodes and probability weights, so that sum(w g(R)) is the number mean of g.

    The nodes are those of Gauss and Legendre on panels even in log R, because a grading of a
    large size ratio changes over each decade.

    Parameters
    ----------
    grading : scipy.stats frozen distribution
        Density by number of the radius [m].
    lower, upper : float, optional
        Part of the support to integrate over [m]; the whole of it when left out.

    Returns
    -------
    radius, weight : ndarray, shape (n,)
        Nodes [m] and weights [-].

    Examples
    --------
    >>> radius, weight = quadrature(uniform(1.0, 3.0))
    >>> round(float(weight @ radius**2), 12)
    4.333333333333
    """
    start, end = grading.support()
    edges = np.geomspace(lower or start, upper or end, _PANELS + 1)
    x, w = _POINTS
    log_edges = np.log(edges)
    half = np.diff(log_edges)[:, None] / 2
    radius = np.exp(log_edges[:-1, None] + half * (x + 1))
    weight = half * w * radius * grading.pdf(radius)
    return radius.ravel(), weight.ravel()


def raw_moment(grading, order):
    r"""Return the raw moment <R^k> by number.

    .. math:: \langle R^k \rangle = \int R^k P(R)\, dR

    Parameters
    ----------
    grading : scipy.stats frozen distribution
        Density by number of the radius [m].
    order : float
        k [-].

    Returns
    -------
    float
        [m^k]

    Examples
    --------
    >>> round(raw_moment(uniform(0.0 + 1e-9, 1.0), 3), 9)
    0.25
    """
    radius, weight = quadrature(grading)
    return float(weight @ radius**order)


def percent_finer_by_mass(grading, radius):
    r"""Return the sieve curve: percent of the mass in grains smaller than each radius.

    .. math:: F(r) = 100 \int_{R_m}^{r} R^3 P(R)\, dR \,/\, \langle R^3 \rangle

    Parameters
    ----------
    grading : scipy.stats frozen distribution
        Density by number of the radius [m].
    radius : array_like, shape (n,)
        [m]

    Returns
    -------
    ndarray, shape (n,)
        [%]

    Examples
    --------
    >>> float(percent_finer_by_mass(uniform(1e-9, 1.0), [0.5])[0].round(6))
    6.25
    """
    start, end = grading.support()

    def mass_below(r):
        if r <= start:
            return 0.0
        nodes, weight = quadrature(grading, upper=min(r, end))
        return weight @ nodes**3

    below = np.array([mass_below(r) for r in np.atleast_1d(radius)])
    return 100.0 * below / mass_below(end)


def realised_percent_finer(radii, radius):
    """Return the percent of the mass, and of the number, of a packing's grains up to a radius.

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


def particle_diameter(radius, percent_finer, percent):
    """Return D_x, the diameter that x percent of the mass is finer than, as D10, D50 or D60.

    Parameters
    ----------
    radius : array_like, shape (n,)
        Increasing [m].
    percent_finer : array_like, shape (n,)
        Percent finer by mass at each radius, increasing [%].
    percent : float
        x [%].

    Returns
    -------
    float
        [m]

    Examples
    --------
    >>> round(particle_diameter([1.0, 2.0], [0.0, 100.0], 50.0), 9)
    2.828427125
    """
    return float(2.0 * np.exp(np.interp(percent, percent_finer, np.log(radius))))


def from_parameters(form, **parameters):
    """Return the grading of a form by name, as the configuration gives it.

    Parameters
    ----------
    form : {"uniform", "fractal"}
    **parameters
        Of the function of that name.

    Returns
    -------
    scipy.stats frozen distribution of the radius [m]

    Examples
    --------
    >>> float(from_parameters("uniform", radius_min=1.0, radius_max=3.0).mean())
    2.0
    """
    return {"uniform": uniform, "fractal": fractal}[form](**parameters)


def grading_table(grading, radii, points=200):
    """Return the target and the realised grading, by number and as percent finer by mass.

    Parameters
    ----------
    grading : scipy.stats frozen distribution
        Target, by number [1/m].
    radii : list of array_like
        Radii of each seed's grains [m].
    points : int
        Rows; the diameters are even in their logarithm.

    Returns
    -------
    dict of ndarray, shape (points,)
        diameter_m, density_target_per_m (by number, of the diameter), percent_finer_* of target
        and realised by number and by mass; of the realised ones the mean and both extremes of
        the seeds by mass.

    Examples
    --------
    >>> table = grading_table(uniform(1.0, 3.0), [[1.5, 2.5]])
    >>> float(table["percent_finer_by_mass_target"][-1])
    100.0
    """
    radius = np.geomspace(*grading.support(), points)
    curves = [realised_percent_finer(seed, radius) for seed in radii]
    by_mass, by_number = (np.array(kind) for kind in zip(*curves, strict=True))
    return {
        "diameter_m": 2.0 * radius,
        "density_target_per_m": grading.pdf(radius) / 2.0,
        "percent_finer_by_number_target": 100.0 * grading.cdf(radius),
        "percent_finer_by_number_realised": by_number.mean(axis=0),
        "percent_finer_by_mass_target": percent_finer_by_mass(grading, radius),
        "percent_finer_by_mass_realised": by_mass.mean(axis=0),
        "percent_finer_by_mass_realised_min": by_mass.min(axis=0),
        "percent_finer_by_mass_realised_max": by_mass.max(axis=0),
    }
