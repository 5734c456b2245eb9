"""The resistance to crushing of a material from one compression curve.

On the compression line each state of crushing yields at a strain and a pressure of its own; a test
that follows it tells the two parameters of the resistance, as far as it goes far enough.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.compression_line import (
    InterpolatedCriticalEnergy,
    Line,
    compression_line,
)
from branchcrush.crushing.curves import TabulatedCurve
from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import (
    ElasticStrainLimit,
    Resistance,
)
from branchcrush.errors import FitError

CONFIDENCE = 0.95
# Values at which a search may begin, of the scale and of the exponent.
_STARTS = (15, 6)
# A positive parameter that is known to less than this factor either way is not known.
_FACTOR = 3.0
# Nor is an exponent that is known to less than this.
_WIDTH = 1.0
# Two parameters pass through any two points beyond the beginning of crushing.
FEWEST_CRUSHED = 3
# Rounds in which slopes and errors are made to fit each other, and what leaves no errors.
_ROUNDS, _SINGULAR = 4, 1e14
# Steps of the parameters for their derivatives: above what interpolation leaves.
_STEP = 1e-4


class Parameter(NamedTuple):
    """A fitted parameter with its interval, and whether the curve determines it."""

    estimate: float
    low: float
    high: float
    determined: bool


@dataclass(frozen=True)
class Family:
    """Resistances of one kind, told apart by two parameters: a scale above 0 and an exponent.

    Parameters
    ----------
    resistance : callable
        Takes the scale and the exponent, returns a `Resistance`.
    scales, exponents : tuple of float
        Least and largest of each that is looked for.

    Examples
    --------
    >>> critical_energy_family(1e3, 1e7).resistance(1e5, 2.0)
    InterpolatedCriticalEnergy(energy=100000.0, hardening=2.0)
    """

    resistance: Callable[[float, float], Resistance]
    scales: tuple[float, float]
    exponents: tuple[float, float]


@dataclass(frozen=True)
class CompressionFit:
    """A resistance fitted to a compression curve.

    Parameters
    ----------
    scale, exponent : Parameter
        eps_0 and b, or E_c0 and s.
    correlation : float
        Of the logarithm of the scale and the exponent [-].
    residual : float
        Root mean square of the strains' [-].
    line : Line
        At the pressures of the curve.
    crushed : int
        Points at which C is above 0.
    locked : float or None
        The least pressure of the curve from which on C stays at the last that is admissible [Pa].
    resistance : Resistance
    """

    scale: Parameter
    exponent: Parameter
    correlation: float
    residual: float
    line: Line
    crushed: int
    locked: float | None
    resistance: Resistance


def elastic_strain_family(
    crushing: ArrayLike,
    contact_diameter: ArrayLike,
    exponent_of_strain: Callable[[float], float],
    scales: tuple[float, float] = (1e-4, 0.4),
) -> Family:
    r"""Return elastic strain limits that change with the size of the grains that carry load.

    .. math:: \epsilon_e = \epsilon_0\, (d_Q/d_{Q0})^{x(b)}

    Parameters
    ----------
    crushing, contact_diameter : array_like, shape (n,)
        C [-], and d_Q there [any unit].
    exponent_of_strain : callable
        x of b: 1 - b with linear contacts, -2b/3 with Hertz's.
    scales : tuple of float
        Between which eps_0 is looked for [-].

    Returns
    -------
    Family
        Of eps_0 [-] and b [-].

    Examples
    --------
    >>> family = elastic_strain_family([0.0, 1.0], [1.0, 0.5], lambda b: 1.0 - b)
    >>> float(family.resistance(0.01, 2.0).yield_strain(1.0, None, None))
    0.02
    """
    known = tuple(np.asarray(crushing, float).tolist())
    ratio = np.asarray(contact_diameter, float) / np.asarray(contact_diameter, float)[0]

    def resistance(scale: float, exponent: float) -> Resistance:
        change = TabulatedCurve(known, tuple((ratio ** exponent_of_strain(exponent)).tolist()))
        return ElasticStrainLimit(scale, change)

    return Family(resistance, scales, (-2.0, 6.0))


def critical_energy_family(least: float, largest: float) -> Family:
    """Return resistances E_c0/(1 - C)^s.

    Parameters
    ----------
    least, largest : float
        Between which E_c0 is looked for [J/m3].

    Returns
    -------
    Family
        Of E_c0 [J/m3] and s [-].
    """
    return Family(InterpolatedCriticalEnergy, (least, largest), (0.0, 12.0))


def fit_resistance(
    pressure: ArrayLike,
    strain: ArrayLike,
    form: ModelForm,
    elasticity: Elasticity,
    family: Family,
) -> CompressionFit:
    r"""Fit the resistance of a family to the strains of a compression, by least squares.

    .. math:: \min \sum_i [\epsilon(p_i) - \epsilon_i]^2

    Intervals are Student's, from the Jacobian at the minimum, its slopes taken over the parameters'
    errors, and the scatter about it: they hold the scatter of the points, not what the model lacks.
    A scale is not determined where its interval reaches beyond a factor of 3, an exponent where it
    reaches beyond 1 either way, and both when fewer than three points are beyond the beginning of
    crushing.

    Parameters
    ----------
    pressure, strain : array_like, shape (n,)
        Mean stress, increasing, above 0 [Pa], and volumetric strain from the beginning of the
        test [-].
    form : ModelForm
    elasticity : Elasticity
    family : Family

    Returns
    -------
    CompressionFit

    Raises
    ------
    FitError
        For fewer than four points, or numbers that are no compression.

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> form = ModelForm(LinearCurve(0.0), TabulatedCurve((0.0, 1.0), (1.0, 1.25)))
    >>> law, pressure = PowerLawElasticity(1e9, 1.0), np.linspace(2e6, 18e6, 9)
    >>> family = elastic_strain_family([0.0, 1.0], [1.0, 0.5], lambda b: 1.0 - b)
    >>> made = compression_line(pressure, form, law, family.resistance(0.01, 2.0))
    >>> fit = fit_resistance(pressure, made.strain, form, law, family)
    >>> round(fit.scale.estimate, 5), round(fit.exponent.estimate, 3)
    (0.01, 2.0)
    """
    from scipy.optimize import least_squares  # slow to import, and few jobs need it

    pressure, strain = np.asarray(pressure, float), np.asarray(strain, float)
    usable = pressure.ndim == 1 and pressure.shape == strain.shape
    if not (usable and np.isfinite([pressure, strain]).all() and (np.diff(pressure) > 0).all()):
        raise FitError("a compression curve needs increasing pressures with a strain each")
    if pressure.size < 4 or pressure[0] <= 0:
        raise FitError("a compression curve needs 4 points with pressures above 0")
    low = np.array([np.log(family.scales[0]), family.exponents[0]])
    high = np.array([np.log(family.scales[1]), family.exponents[1]])

    def made(parameters: NDArray) -> Resistance:
        return family.resistance(float(np.exp(parameters[0])), float(parameters[1]))

    def residuals(parameters: NDArray) -> NDArray:
        return compression_line(pressure, form, elasticity, made(parameters)).strain - strain

    scales, exponents = (
        np.linspace(least, most, many + 2)[1:-1]
        for least, most, many in zip(low, high, _STARTS, strict=True)
    )
    starts = np.array([(scale, exponent) for scale in scales for exponent in exponents])
    costs = np.array([np.sum(residuals(start) ** 2) for start in starts])
    # Side valleys: where no point crushes, nothing tells the search where to go.
    fits = [
        least_squares(
            residuals, starts[start], bounds=(low, high), diff_step=_STEP, x_scale=(1.0, 1.0)
        )
        for start in np.argsort(costs)[:3]
    ]
    best = min(fits, key=lambda fit: fit.cost)
    line = compression_line(pressure, form, elasticity, resistance := made(best.x))
    crushed = int(np.sum(line.crushing > 0.0))
    stays = (line.crushing == line.crushing[-1]) & (line.crushing > 0.0)
    width, correlation = _half_widths(best, residuals, low, high)
    at_end = bool(np.any((best.x <= low + 1e-3) | (best.x >= high - 1e-3)))
    clear = crushed >= FEWEST_CRUSHED and not at_end
    scale, exponent = float(np.exp(best.x[0])), float(best.x[1])
    factor = float(np.exp(min(width[0], 700.0)))
    return CompressionFit(
        scale=Parameter(scale, scale / factor, scale * factor, clear and factor <= _FACTOR),
        exponent=Parameter(
            exponent, exponent - width[1], exponent + width[1], clear and width[1] <= _WIDTH
        ),
        correlation=correlation,
        residual=float(np.sqrt(2.0 * best.cost / pressure.size)),
        line=line,
        crushed=crushed,
        locked=float(pressure[np.argmax(stays)]) if stays.sum() > 1 else None,
        resistance=resistance,
    )


def _half_widths(
    best: Any, residuals: Callable[[NDArray], NDArray], low: NDArray, high: NDArray
) -> tuple[list[float], float]:
    """Return half of each parameter's interval, and their correlation; infinite where unknown."""
    from scipy.stats import t  # slow to import, and few jobs need it

    left = best.fun.size - best.x.size
    jacobian, covariance = best.jac, np.full((2, 2), np.inf)
    # Where a point lies at the knee of the curve the slope there says little: slopes over the
    # parameters' own errors do, which they change.
    for _ in range(_ROUNDS):
        normal = jacobian.T @ jacobian
        if not np.linalg.cond(normal) < _SINGULAR:
            return [np.inf, np.inf], np.nan
        covariance = 2.0 * best.cost / left * np.linalg.inv(normal)
        steps = np.maximum(np.sqrt(np.diag(covariance)), _STEP)
        columns = []
        for step in np.diag(steps):
            ends = np.clip([best.x - step, best.x + step], low, high)
            columns.append((residuals(ends[1]) - residuals(ends[0])) / (ends[1] - ends[0]).max())
        jacobian = np.transpose(columns)
    error = np.sqrt(np.diag(covariance))
    quantile = float(t.ppf((1.0 + CONFIDENCE) / 2.0, left))
    return (quantile * error).tolist(), float(covariance[0, 1] / error.prod())
