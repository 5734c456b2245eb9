"""Gradings with a formula, cut at the smallest and the largest radius given.

`by` says what the formula describes: the number of grains, or their mass, as a sieve weighs it.
"""

import numpy as np

from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.truncation import truncated, truncated_distribution


def uniform(radius_min: float, radius_max: float, by: str = "number") -> Grading:
    r"""Return the grading whose density is the same at every radius.

    .. math:: P(R) = 1/(R_M - R_m)

    Parameters
    ----------
    radius_min, radius_max : float
        Smallest and largest radius, R_m and R_M [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M.

    Examples
    --------
    >>> round(uniform(1.0, 3.0).moment(1), 12)
    2.0
    """
    return power_law(0.0, radius_min, radius_max, by)


def normal(
    mean: float,
    standard_deviation: float,
    radius_min: float,
    radius_max: float,
    by: str = "number",
) -> Grading:
    r"""Return the normal grading.

    .. math:: P(R) \propto \exp\left(-\frac{(R - \mu)^2}{2 s^2}\right)

    Parameters
    ----------
    mean, standard_deviation : float
        mu and s of the whole curve, before it is cut [m].
    radius_min, radius_max : float
        Smallest and largest radius [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M, s > 0, and something of the curve lies between R_m and R_M.

    Examples
    --------
    >>> round(float(normal(2.0, 0.1, 1.0, 3.0).number_ppf(0.5)), 9)
    2.0
    """
    from scipy import stats  # slow to import, and few gradings need it

    return truncated_distribution(stats.norm(mean, standard_deviation), radius_min, radius_max, by)


def lognormal(
    median: float,
    geometric_standard_deviation: float,
    radius_min: float,
    radius_max: float,
    by: str = "number",
) -> Grading:
    r"""Return the log-normal grading.

    .. math:: P(R) \propto \frac{1}{R}
        \exp\left(-\frac{\ln^2 (R/\tilde R)}{2 \ln^2 \sigma_g}\right)

    By number and by mass have the same sigma_g and medians exp(3 ln^2 sigma_g) apart, if not cut.

    Parameters
    ----------
    median : float
        Of the whole curve, before it is cut [m].
    geometric_standard_deviation : float
        sigma_g, above 1 [-].
    radius_min, radius_max : float
        Smallest and largest radius [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M, sigma_g > 1, and something of the curve lies between R_m and R_M.

    Examples
    --------
    >>> grading = lognormal(1.0, 1.2, 0.01, 100.0)
    >>> round(float(grading.mass_ppf(0.5) - np.exp(3 * np.log(1.2) ** 2)), 9)
    0.0

    References
    ----------
    Hatch and Choate (1929), J. Franklin Inst. 207, 369-387.
    """
    from scipy import stats  # slow to import, and few gradings need it

    width = np.log(geometric_standard_deviation)
    return truncated_distribution(stats.lognorm(s=width, scale=median), radius_min, radius_max, by)


def loguniform(radius_min: float, radius_max: float, by: str = "number") -> Grading:
    r"""Return the grading that is uniform in the logarithm of the radius.

    .. math:: P(R) = \frac{1}{R \ln(R_M/R_m)}

    Parameters
    ----------
    radius_min, radius_max : float
        Smallest and largest radius [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M.

    Examples
    --------
    >>> round(float(loguniform(1.0, 4.0).number_ppf(0.5)), 12)
    2.0
    """
    return power_law(-1.0, radius_min, radius_max, by)


def weibull(
    scale: float, shape: float, radius_min: float, radius_max: float, by: str = "mass"
) -> Grading:
    r"""Return the Weibull grading; by mass it is that of Rosin and Rammler.

    .. math:: F(R) = 1 - \exp\left(-(R/R_s)^m\right)

    Parameters
    ----------
    scale : float
        R_s, the radius that 63.2 % are finer than before the curve is cut [m].
    shape : float
        m [-].
    radius_min, radius_max : float
        Smallest and largest radius [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M, R_s and m > 0, and something of the curve lies between R_m and R_M.

    Examples
    --------
    >>> round(float(weibull(1.0, 3.0, 0.001, 10.0).mass_cdf(1.0)), 6)
    0.632121
    """
    from scipy import stats  # slow to import, and few gradings need it

    return truncated_distribution(stats.weibull_min(shape, scale=scale), radius_min, radius_max, by)


def fractal(radius_min: float, radius_max: float, alpha: float) -> Grading:
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
    Grading
        P by number, F by mass.

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M.

    Examples
    --------
    >>> round(float(fractal(1.0, 16.0, 2.5).number_ppf(0.5)), 4)
    1.319

    References
    ----------
    Einav (2007), J. Mech. Phys. Solids 55, 1274-1297, for the percent finer by mass.
    """
    return power_law(-1.0 - alpha, radius_min, radius_max, "number")


def fuller(radius_min: float, radius_max: float, exponent: float) -> Grading:
    r"""Return the grading of Fuller's curve; 0.5 is his, 0.45 that of asphalt.

    .. math:: F(D) = \frac{D^q - D_m^q}{D_M^q - D_m^q}

    Parameters
    ----------
    radius_min, radius_max : float
        Smallest and largest radius [m].
    exponent : float
        q [-]; 3 - alpha of a fractal grading.

    Returns
    -------
    Grading
        F by mass.

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M.

    Examples
    --------
    >>> round(float(fuller(1.0, 9.0, 0.5).mass_cdf(4.0)), 12)
    0.5

    References
    ----------
    Fuller and Thompson (1907), Trans. ASCE 59, 67-143.
    """
    return power_law(exponent - 1.0, radius_min, radius_max, "mass")


def power_law(power: float, radius_min: float, radius_max: float, by: str) -> Grading:
    r"""Return the grading whose density is a power of the radius.

    .. math:: P(R) \propto R^p

    Parameters
    ----------
    power : float
        p [-].
    radius_min, radius_max : float
        Smallest and largest radius [m].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless 0 < R_m < R_M.

    Examples
    --------
    >>> round(power_law(0.0, 1.0, 3.0, "number").moment(1), 12)
    2.0
    """
    # Relative to 1 m it would be out of the range of numbers for a steep density of fine grains.
    return truncated(lambda r: (r / radius_min) ** power, [], radius_min, radius_max, by)
