"""Gradings from tables: a sieve curve, channels, or a density at a few radii."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import GradingError
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.panels import Density
from branchcrush.gradings.truncation import truncated


def from_percent_finer(
    radius: ArrayLike,
    percent: ArrayLike,
    radius_min: float | None = None,
    radius_max: float | None = None,
    straight: bool = False,
) -> Grading:
    r"""Return the grading of a sieve curve, drawn through its points without overshooting.

    .. math:: g(R) = \frac{1}{R} \frac{d F}{d \ln R}

    F is the monotone cubic in ln R through the points. Where it is level, as in a gap-graded
    soil, there are no grains.

    Parameters
    ----------
    radius : array_like, shape (n,)
        Increasing [m].
    percent : array_like, shape (n,)
        Percent finer by mass, nowhere falling [%]. From 0 to 100, unless cut before it ends.
    radius_min, radius_max : float, optional
        Grains below the one and above the other are left out, and the rest is 100 % [m].
    straight : bool
        Straight lines between the points, on the usual chart of ln R, in place of the cubic.

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        When the table is not such a curve, or has nothing left between the two radii.

    Examples
    --------
    >>> sand = from_percent_finer([0.1, 0.2, 0.4], [0.0, 50.0, 100.0])
    >>> sand.mass_ppf(0.5).round(12).item()
    0.2

    References
    ----------
    Fritsch and Butland (1984), SIAM J. Sci. Stat. Comput. 5, 300-304, for the cubic.
    """
    radius, percent = _columns(radius, percent)
    if np.any(np.diff(percent) < 0) or percent[0] < 0 or percent[-1] > 100:
        raise GradingError("percent finer must grow with the radius, from 0 to 100")
    for value, bound, end, step in (
        (percent[0], radius_min, radius[0], 1),
        (100 - percent[-1], radius_max, radius[-1], -1),
    ):
        if value > 0 and (bound is None or step * bound < step * end):
            raise GradingError(
                f"the curve must run from 0 to 100 percent finer, not {percent[0]:g} to "
                f"{percent[-1]:g}, unless it is cut within the radii {radius[0]:g} m to "
                f"{radius[-1]:g} m that it covers"
            )
    # Sieves that hold nothing or let everything pass say nothing about the curve between.
    first, last = np.flatnonzero(percent == percent[0])[-1], np.argmax(percent == percent[-1])
    if first >= last:
        raise GradingError(
            f"the curve is {percent[0]:g} percent throughout: give it a second value"
        )
    radius, percent = radius[first : last + 1], percent[first : last + 1]
    # Slow to import, for sieve tables alone.
    from scipy.interpolate import PchipInterpolator, make_interp_spline

    points = np.log(radius), percent / 100
    # Of next to no percent a slope has no reciprocal, and PCHIP takes it for level.
    with np.errstate(over="ignore"):
        curve = make_interp_spline(*points, k=1) if straight else PchipInterpolator(*points)
    slope = curve.derivative()

    def density_by_mass(r: NDArray) -> NDArray:
        # A level part must not come out below 0 by rounding.
        return np.maximum(slope(np.log(np.clip(r, radius[0], radius[-1]))), 0.0) / r

    return _between(density_by_mass, radius, radius_min, radius_max, "mass")


def from_histogram(
    edges: ArrayLike,
    shares: ArrayLike,
    by: str,
    radius_min: float | None = None,
    radius_max: float | None = None,
    scale: str = "log",
) -> Grading:
    r"""Return the grading of channels, each with its share of the grains spread evenly in it.

    .. math:: P(R) = \frac{s_i}{\sum_j s_j} \frac{1}{R \ln(R_{i+1} / R_i)}

    from one edge to the next; on a linear scale 1/(R_{i+1} - R_i) takes the place of the second
    fraction.

    Parameters
    ----------
    edges : array_like, shape (n + 1,)
        Increasing radii that channels begin and end at [m].
    shares : array_like, shape (n,)
        Not negative, of any scale: percent, counts, masses.
    by : {"number", "mass"}
    radius_min, radius_max : float, optional
        Grains below the one and above the other are left out [m].
    scale : {"log", "linear"}
        Over what grains are spread evenly within a channel.

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        When these are no channels, or nothing is left between the two radii.

    Examples
    --------
    >>> from_histogram([1.0, 2.0, 4.0], [30.0, 30.0], "mass").mass_ppf(0.25).round(9).item()
    1.414213562
    """
    edges, shares = np.asarray(edges, dtype=float), np.asarray(shares, dtype=float)
    usable = shares.ndim == 1 and np.isfinite(shares).all() and np.all(shares >= 0)
    if not (usable and np.any(shares > 0)):
        raise GradingError("channels must hold 0 or more each, and one of them more")
    # To at most 1, by a power of two, which rounds nothing: their scale is any, and a sum or a
    # quotient of the largest numbers is none.
    largest: int = np.frexp(shares.max())[1]
    shares = np.asarray(np.ldexp(shares, -largest), dtype=float)
    edges, _ = _columns(edges, np.append(0.0, shares))
    held = np.flatnonzero(shares)
    edges, shares = edges[held[0] : held[-1] + 2], shares[held[0] : held[-1] + 1]
    heights = shares / np.diff(edges if scale == "linear" else np.log(edges))

    def density(r: NDArray) -> NDArray:
        place = np.clip(np.searchsorted(edges, r, side="right") - 1, 0, heights.size - 1)
        return heights[place] if scale == "linear" else heights[place] / r

    return _between(density, edges, radius_min, radius_max, by)


def from_density(
    radius: ArrayLike,
    density: ArrayLike,
    by: str,
    radius_min: float | None = None,
    radius_max: float | None = None,
    per: str = "size",
) -> Grading:
    r"""Return the grading whose density is drawn straight from point to point.

    .. math:: P(R) \propto P_k + (P_{k+1} - P_k) \frac{x - x_k}{x_{k+1} - x_k} \frac{dx}{dR}

    x is R, or ln R for a density per logarithm of size or per phi, which differ by a factor.

    Parameters
    ----------
    radius : array_like, shape (n,)
        Increasing [m].
    density : array_like, shape (n,)
        Not negative, of any scale [1/m, or - per logarithm].
    by : {"number", "mass"}
    radius_min, radius_max : float, optional
        Grains below the one and above the other are left out [m].
    per : {"size", "log_size", "phi"}
        What the density is taken per.

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        When the table is not such a density, or has nothing left between the two radii.

    Examples
    --------
    >>> from_density([1.0, 2.0, 3.0], [0.0, 1.0, 0.0], "number").number_cdf(2.0).round(12).item()
    0.5
    """
    radius, density = _columns(radius, density)
    if np.any(density < 0) or not np.any(density > 0):
        raise GradingError("a density must not be negative, nor 0 at every radius")
    held = np.flatnonzero(density > 0)
    first, last = max(held[0] - 1, 0), min(held[-1] + 1, radius.size - 1)
    radius, density = radius[first : last + 1], density[first : last + 1]
    if per == "size":
        return _between(lambda r: np.interp(r, radius, density), radius, radius_min, radius_max, by)
    places = np.log(radius)
    return _between(
        lambda r: np.interp(np.log(r), places, density) / r, radius, radius_min, radius_max, by
    )


def _between(
    density: Density,
    radius: NDArray,
    radius_min: float | None,
    radius_max: float | None,
    by: str,
) -> Grading:
    low = radius[0] if radius_min is None else max(radius_min, radius[0])
    high = radius[-1] if radius_max is None else min(radius_max, radius[-1])
    if not low < high:
        raise GradingError(
            f"no grains are left between {low:g} m and {high:g} m: the table has them from "
            f"{radius[0]:g} m to {radius[-1]:g} m"
        )
    return truncated(density, radius, low, high, by)


def _columns(radius: ArrayLike, values: ArrayLike) -> tuple[NDArray, NDArray]:
    radius, values = np.asarray(radius, dtype=float), np.asarray(values, dtype=float)
    usable = radius.shape == values.shape and radius.ndim == 1 and radius.size > 1
    if not (usable and np.isfinite([radius, values]).all() and np.all(np.diff(radius) > 0)):
        raise GradingError("a table needs two rows or more of finite numbers, the radii increasing")
    return radius, values
