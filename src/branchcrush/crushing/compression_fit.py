"""The resistance to crushing of a material from one compression curve.

On the compression line each state of crushing yields at a strain and a pressure of its own; a test
that follows it tells the two parameters of the resistance, as far as it goes far enough.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.curves import TabulatedCurve
from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import (
    LARGEST,
    CriticalEnergy,
    ElasticStrainLimit,
    Resistance,
)
from branchcrush.errors import FitError

CONFIDENCE = 0.95
# C between two knots of a form at which the compression line is looked at.
_LOOKS = 4
# Values at which a search may begin, of the scale and of the exponent.
_STARTS = (15, 6)
# A positive parameter that is known to less than this factor either way is not known.
_FACTOR = 3.0
# Nor is an exponent that is known to less than this.
_WIDTH = 1.0
# Two parameters pass through any two points beyond the beginning of crushing.
FEWEST_CRUSHED = 3
# Steps of the parameters for their derivatives: above what interpolation leaves.
_STEP = 1e-4


class Parameter(NamedTuple):
    """A fitted parameter with its interval, and whether the curve determines it."""

    estimate: float
    low: float
    high: float
    determined: bool


class Line(NamedTuple):
    """Where a compression goes, each of the shape of the pressures."""

    crushing: NDArray  # C [-]
    strain: NDArray  # eps, total [-]


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
    CriticalEnergy(energy=100000.0, hardening=2.0)
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
    return Family(CriticalEnergy, (least, largest), (0.0, 12.0))


def compression_line(
    pressure: ArrayLike, form: ModelForm, elasticity: Elasticity, resistance: Resistance
) -> Line:
    r"""Return how far a compression under growing pressure crushes and strains.

    .. math:: p(C) = g(C)\, p_0(\epsilon_e(C)), \qquad
        \epsilon = 1 - \frac{1 - \epsilon_e}{j(C)}

    The strain counts from the jamming point before crushing. C grows no farther than where it
    would cost elastic energy; where p(C) falls, C goes on to where it is as high again.
    `evolution.evolve` is the exact way, of which this is an interpolation, continuous in the
    parameters as a fit needs it.

    Parameters
    ----------
    pressure : array_like, shape (n,)
        Mean stress, above 0 [Pa].
    form : ModelForm
    elasticity : Elasticity
    resistance : Resistance

    Returns
    -------
    Line

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> form = ModelForm(LinearCurve(0.0), TabulatedCurve((0.0, 1.0), (1.0, 1.25)))
    >>> law, harder = PowerLawElasticity(1e9, 1.0), TabulatedCurve((0.0, 1.0), (1.0, 2.0))
    >>> line = compression_line([5e6, 15e6], form, law, ElasticStrainLimit(0.01, harder))
    >>> line.crushing.round(3).tolist(), line.strain.round(4).tolist()
    ([0.0, 0.585], [0.005, 0.1355])
    """
    pressure = np.asarray(pressure, float)
    looks = _looks(form)
    elastic = resistance.yield_strain(looks, form, elasticity)
    reachable = np.isfinite(elastic) & (elastic < LARGEST)
    held = np.where(reachable, elastic, LARGEST)
    strain = form.total_strain(held, looks)
    costs = form.driving_force(strain, looks, elasticity) < 0.0
    last = int(np.argmax(costs)) if costs.any() else looks.size - 1
    yields_at = np.where(reachable, form.stress(strain, looks, elasticity), np.inf)[: last + 1]
    # A hair that rises keeps the inverse one: along a snap C is wherever the pressure is met last.
    risen = np.maximum.accumulate(yields_at)
    known = np.isfinite(risen)
    climb = np.log(np.maximum(risen[known], 1e-300)) + 1e-12 * np.arange(known.sum())
    if not known.any():
        crushing = np.zeros_like(pressure)
    else:
        crushing = np.interp(np.log(pressure), climb, looks[: last + 1][known])
    elastic = elasticity.strain_at_pressure(pressure / form.factor.value(crushing))
    return Line(crushing, form.total_strain(elastic, crushing))


def fit_resistance(
    pressure: ArrayLike,
    strain: ArrayLike,
    form: ModelForm,
    elasticity: Elasticity,
    family: Family,
) -> CompressionFit:
    r"""Fit the resistance of a family to the strains of a compression, by least squares.

    .. math:: \min \sum_i [\epsilon(p_i) - \epsilon_i]^2

    Intervals are Student's, from the Jacobian at the minimum and the scatter about it: they hold
    the scatter of the points, not what the model lacks. A scale is not determined where its
    interval reaches beyond a factor of 3, an exponent where it reaches beyond 1 either way, and
    both when fewer than three points are beyond the beginning of crushing.

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

    def residuals(parameters: NDArray) -> NDArray:
        resistance = family.resistance(float(np.exp(parameters[0])), float(parameters[1]))
        return compression_line(pressure, form, elasticity, resistance).strain - strain

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
    return _with_intervals(best, pressure, form, elasticity, family, low, high)


def _looks(form: ModelForm) -> NDArray:
    """Return C at which the line is looked at: on every smooth piece of the form."""
    knots = form.knots
    inner = np.linspace(0.0, 1.0, _LOOKS + 1)[:-1]
    looks = np.append((knots[:-1, None] + np.diff(knots)[:, None] * inner).ravel(), knots[-1])
    return looks[looks < 1.0]  # at 1 a resistance may be infinite


def _with_intervals(
    best: Any,
    pressure: NDArray,
    form: ModelForm,
    elasticity: Elasticity,
    family: Family,
    low: NDArray,
    high: NDArray,
) -> CompressionFit:
    """Return the fit with what its Jacobian says of the parameters."""
    from scipy.stats import t  # slow to import, and few jobs need it

    scale, exponent = float(np.exp(best.x[0])), float(best.x[1])
    resistance = family.resistance(scale, exponent)
    line = compression_line(pressure, form, elasticity, resistance)
    crushed = int(np.sum(line.crushing > 0.0))
    stays = (line.crushing == line.crushing[-1]) & (line.crushing > 0.0)
    left = pressure.size - best.x.size
    variance = 2.0 * best.cost / left
    normal = best.jac.T @ best.jac
    known = np.linalg.cond(normal) < 1e14 and bool((line.crushing > 0).any())
    at_end = bool(np.any((best.x <= low + 1e-3) | (best.x >= high - 1e-3)))
    if known:
        covariance = variance * np.linalg.inv(normal)
        error = np.sqrt(np.diag(covariance)) * t.ppf((1.0 + CONFIDENCE) / 2.0, left)
        correlation = float(covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1]))
    else:
        error, correlation = np.array([np.inf, np.inf]), np.nan
    clear = known and not at_end and crushed >= FEWEST_CRUSHED
    with np.errstate(over="ignore"):
        factor, width = float(np.exp(error[0])), float(error[1])
    return CompressionFit(
        scale=Parameter(scale, scale / factor, scale * factor, clear and factor <= _FACTOR),
        exponent=Parameter(exponent, exponent - width, exponent + width, clear and width <= _WIDTH),
        correlation=correlation,
        residual=float(np.sqrt(2.0 * best.cost / pressure.size)),
        line=line,
        crushed=crushed,
        locked=float(pressure[np.argmax(stays)]) if stays.sum() > 1 else None,
        resistance=resistance,
    )
