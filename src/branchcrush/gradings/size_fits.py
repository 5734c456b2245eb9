"""Curves through a few sizes, such as D10, D50 and D90, where no table of the grading is known.

Both curves are straight lines in the logarithm of size, so that least squares have a closed form.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import GradingError

# What each curve is known by: its centre, and its width.
CURVES = {"lognormal": ("median", "geometric_standard_deviation"), "weibull": ("scale", "shape")}
# Sizes that it may be laid through, and how many percent are finer.
D_VALUES = {"d10": 10.0, "d50": 50.0, "d90": 90.0}
# Farther from a given size than this, by a factor 1.25, a curve is none through it.
LARGEST_MISFIT = 0.25
# Of the grading below `min` and above `max` in the advice of where to cut it.
_ADVISED_TAIL = 0.01


@dataclass(frozen=True)
class SizeFit:
    """A lognormal or Weibull curve through a few sizes, of the whole curve before it is cut."""

    curve: Literal["lognormal", "weibull"]
    centre: float  # median of the lognormal, scale of the Weibull, in the unit of the sizes
    width: float  # geometric standard deviation of the first, shape of the second [-]
    percents: tuple[float, ...]  # x of each D_x [%]
    given: tuple[float, ...]  # D_x as given
    fitted: tuple[float, ...]  # D_x of the curve

    @property
    def misfits(self) -> tuple[float, ...]:
        """What each size of the curve is above the given one, over the given one [-]."""
        pairs = zip(self.fitted, self.given, strict=True)
        return tuple(fitted / given - 1.0 for fitted, given in pairs)

    @property
    def root_mean_square(self) -> float:
        """Root mean square of the misfits in the logarithm of size [-]."""
        logs = np.log(self.fitted) - np.log(self.given)
        return float(np.sqrt(np.mean(logs**2)))

    @property
    def advised_ends(self) -> tuple[float, float]:
        """Sizes that 1 % and 99 % are finer than: where the curve may be cut."""
        low, high = self.sizes([100.0 * _ADVISED_TAIL, 100.0 * (1.0 - _ADVISED_TAIL)])
        return float(low), float(high)

    def sizes(self, percents: ArrayLike) -> NDArray:
        r"""Return the sizes that a percentage of the whole curve is finer than.

        .. math:: D_x = \tilde D\, \sigma_g^{z_x}, \qquad
            D_x = D_s \left(-\ln(1 - x/100)\right)^{1/m}

        Parameters
        ----------
        percents : array_like, shape (n,)
            x, between 0 and 100 [%].

        Returns
        -------
        ndarray, shape (n,)
            In the unit of the sizes.

        Examples
        --------
        >>> fit = fit_sizes("lognormal", {50.0: 2.0, 90.0: 4.0})
        >>> fit.sizes([10.0, 50.0]).round(9).tolist()
        [1.0, 2.0]
        """
        slope = np.log(self.width) if self.curve == "lognormal" else 1.0 / self.width
        return self.centre * np.exp(slope * _abscissa(self.curve, percents))

    def words(self, unit: str, metres: float) -> str:
        """Return a curve through diameters in metres, and what it misses, for a person.

        Parameters
        ----------
        unit : str
            Name of the unit.
        metres : float
            That it has [m].

        Returns
        -------
        str

        Examples
        --------
        >>> fit_sizes("lognormal", {10.0: 1e-3, 90.0: 4e-3}).words("mm", 1e-3)
        'lognormal, median 2 mm, geometric standard deviation 1.72; before it is cut D10 1 for 1
         (+0.0 %), D90 4 for 4 (+0.0 %)'
        """
        names = {"lognormal": ("median", "geometric standard deviation")}
        centre, width = names.get(self.curve, ("scale", "shape"))
        sizes = ", ".join(
            f"D{percent:g} {fitted / metres:.4g} for {given / metres:.4g} ({100 * missed:+.1f} %)"
            for percent, fitted, given, missed in zip(
                self.percents, self.fitted, self.given, map(_rounded, self.misfits), strict=True
            )
        )
        return (
            f"{self.curve}, {centre} {self.centre / metres:.4g} {unit}, {width} {self.width:.3g}; "
            f"before it is cut {sizes}"
        )

    def report(self) -> dict[str, object]:
        """Return what `grading.json` says of a curve through diameters in metres.

        Returns
        -------
        dict
            curve; median_m and geometric_standard_deviation, or scale_m and shape; given_m,
            of_the_curve_m and misfit_percent by D_x; root_mean_square_misfit_percent.

        Examples
        --------
        >>> fit_sizes("weibull", {10.0: 1e-3, 90.0: 3e-3}).report()["misfit_percent"]
        {'D10': 0.0, 'D90': 0.0}
        """
        names = [f"D{percent:g}" for percent in self.percents]
        lognormal = self.curve == "lognormal"
        return {
            "curve": self.curve,
            "median_m" if lognormal else "scale_m": self.centre,
            "geometric_standard_deviation" if lognormal else "shape": self.width,
            "given_m": dict(zip(names, self.given, strict=True)),
            "of_the_curve_m": dict(zip(names, self.fitted, strict=True)),
            "misfit_percent": dict(
                zip(names, (100.0 * miss for miss in map(_rounded, self.misfits)), strict=True)
            ),
            "root_mean_square_misfit_percent": 100.0 * _rounded(self.root_mean_square),
        }


def fit_sizes(curve: Literal["lognormal", "weibull"], sizes: Mapping[float, float]) -> SizeFit:
    r"""Return the curve nearest to a few sizes, by least squares in their logarithm.

    .. math:: \ln D_x = \ln \tilde D + z_x \ln \sigma_g, \qquad
        \ln D_x = \ln D_s + \frac{1}{m} \ln\left(-\ln(1 - x/100)\right)

    z_x is the quantile of the standard normal distribution. Two sizes are met exactly.

    Parameters
    ----------
    curve : {"lognormal", "weibull"}
    sizes : mapping of float to float
        By x, between 0 and 100 [%], the size D_x that x percent are finer than, of any unit.

    Returns
    -------
    SizeFit

    Raises
    ------
    GradingError
        When there are fewer than two sizes, when they do not grow with x, or when the curve misses
        one by more than a quarter of it.

    Examples
    --------
    >>> fit = fit_sizes("lognormal", {10.0: 82.0, 50.0: 200.0, 90.0: 486.0})
    >>> round(fit.centre, 1), round(fit.width, 3)
    (199.8, 2.002)
    >>> [f"{misfit:.1%}" for misfit in fit.misfits]
    ['0.1%', '-0.1%', '0.1%']

    References
    ----------
    Rosin and Rammler (1933), J. Inst. Fuel 7, 29-36, for the second curve.
    """
    percents = tuple(sorted(sizes))
    given = tuple(float(sizes[percent]) for percent in percents)
    named = ", ".join(f"D{x:g} = {size:g}" for x, size in zip(percents, given, strict=True))
    if len(given) < 2:
        raise GradingError(f"a curve needs two sizes or more of D10, D50 and D90, not {named}")
    if not (given[0] > 0 and np.all(np.diff(given) > 0) and np.isfinite(given[-1])):
        raise GradingError(f"sizes must be above 0 and grow with their percentage, not {named}")
    abscissa, logs = _abscissa(curve, percents), np.log(given)
    across = abscissa - abscissa.mean()
    slope = float(across @ logs / (across @ across))
    centre = float(np.exp(logs.mean() - slope * abscissa.mean()))
    width = float(np.exp(slope)) if curve == "lognormal" else 1.0 / slope
    fit = SizeFit(curve, centre, width, percents, given, ())
    fit = SizeFit(curve, centre, width, percents, given, tuple(fit.sizes(percents).tolist()))
    farthest = np.abs(np.log(fit.fitted) - logs)
    if farthest.max() > np.log1p(LARGEST_MISFIT):
        curves = ", ".join(
            f"D{x:g} = {size:.3g}" for x, size in zip(percents, fit.fitted, strict=True)
        )
        raise GradingError(
            f"no {curve} curve passes near these sizes: given {named}, of the nearest one {curves} "
            f"(at most {LARGEST_MISFIT:.0%} apart); check them, try the other of lognormal and "
            "weibull, leave one out, or give the whole curve as form: sieve"
        )
    return fit


def curve_of(curve: Literal["lognormal", "weibull"], parameters: Mapping[str, Any]) -> SizeFit:
    """Return the curve of its centre and width, or through sizes, as they are called.

    Parameters
    ----------
    curve : {"lognormal", "weibull"}
    parameters : mapping
        With median and geometric_standard_deviation, or d50 in place of the first; with scale and
        shape; or with two or three of d10, d50 and d90; sizes of any unit. One may be None.

    Returns
    -------
    SizeFit
        In the unit of the sizes; where centre and width are given, with no sizes to miss.

    Raises
    ------
    GradingError
        When no such curve passes near the sizes.

    Examples
    --------
    >>> curve = curve_of("lognormal", {"d50": 2.0, "geometric_standard_deviation": 1.5})
    >>> curve.centre, curve.width, curve.given
    (2.0, 1.5, ())
    """
    centre, width = (parameters.get(key) for key in CURVES[curve])
    if width is not None:
        return SizeFit(curve, parameters["d50"] if centre is None else centre, width, (), (), ())
    sizes = {D_VALUES[key]: parameters[key] for key in D_VALUES if parameters.get(key) is not None}
    return fit_sizes(curve, sizes)


def _abscissa(curve: str, percents: ArrayLike) -> NDArray:
    """Return what the logarithm of size is a straight line of."""
    share = np.asarray(percents, dtype=float) / 100.0
    if curve == "lognormal":
        from statistics import NormalDist  # every reading of a configuration would wait for it

        return np.array([NormalDist().inv_cdf(x) for x in share])
    if curve == "weibull":
        return np.log(-np.log1p(-share))
    raise GradingError(f"a curve through sizes is lognormal or weibull, not {curve!r}")


def _rounded(share: float) -> float:
    # Two sizes are met exactly: what rounding leaves is no misfit, nor is -0.
    return round(share, 11) + 0.0
