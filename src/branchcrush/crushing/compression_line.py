"""Where a compression under growing pressure goes: how far it crushes, and how it strains.

Interpolated, so that it takes milliseconds and is continuous in the parameters of a resistance, as
a fit needs it; `evolution.evolve` is the exact way.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import LARGEST, CriticalEnergy, Resistance

# C between two knots of a form at which the line is looked at.
_LOOKS = 4
# Elastic strains between which the driving force is nearly a power law.
_STRAINS = np.geomspace(1e-8, LARGEST, 161)


class Line(NamedTuple):
    """Where a compression goes, each of the shape of the pressures."""

    crushing: NDArray  # C [-]
    strain: NDArray  # eps, total [-]


def compression_line(
    pressure: ArrayLike, form: ModelForm, elasticity: Elasticity, resistance: Resistance
) -> Line:
    r"""Return how far a compression under growing pressure crushes and strains.

    .. math:: p(C) = g(C)\, p_0(\epsilon_e(C)), \qquad
        \epsilon = 1 - \frac{1 - \epsilon_e}{j(C)}

    The strain counts from the jamming point before crushing. C grows no farther than where it
    would cost elastic energy; where p(C) falls, C goes on to where it is as high again.

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
    >>> from branchcrush.crushing.curves import LinearCurve, TabulatedCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> from branchcrush.crushing.resistance import ElasticStrainLimit
    >>> form = ModelForm(LinearCurve(0.0), TabulatedCurve((0.0, 1.0), (1.0, 1.25)))
    >>> law, harder = PowerLawElasticity(1e9, 1.0), TabulatedCurve((0.0, 1.0), (1.0, 2.0))
    >>> line = compression_line([5e6, 15e6], form, law, ElasticStrainLimit(0.01, harder))
    >>> line.crushing.round(3).tolist(), line.strain.round(4).tolist()
    ([0.0, 0.585], [0.005, 0.1355])
    """
    pressure = np.asarray(pressure, float)
    looks, yields_at = _yields_at(form, elasticity, resistance)
    # A hair that rises keeps the inverse one: along a snap C is wherever the pressure is met last.
    risen = np.maximum.accumulate(yields_at)
    known = np.isfinite(risen)
    climb = np.log(np.maximum(risen[known], 1e-300)) + 1e-12 * np.arange(known.sum())
    if not known.any():
        crushing = np.zeros_like(pressure)
    else:
        crushing = np.interp(np.log(pressure), climb, looks[known])
    elastic = elasticity.strain_at_pressure(pressure / form.factor.value(crushing))
    return Line(crushing, form.total_strain(elastic, crushing))


class InterpolatedCriticalEnergy(CriticalEnergy):
    """A critical energy whose yield strains are interpolated between powers of the strain."""

    def yield_strain(self, crushing: ArrayLike, form: ModelForm, elasticity: Elasticity) -> NDArray:
        """Return the least elastic strain at which C grows, as `CriticalEnergy.yield_strain`.

        Parameters
        ----------
        crushing : array_like
            C, any shape, below 1 [-].
        form : ModelForm
        elasticity : Elasticity

        Returns
        -------
        ndarray
            eps_e [-], to 1e-4 of it; infinite where the driving force stays too small up to 0.5.
        """
        at = np.asarray(crushing, float)[..., None]
        force = form.driving_force(form.total_strain(_STRAINS, at), at, elasticity)
        ratio = force / self.resistance(at)
        above = ratio > 1.0
        first = np.maximum(above.argmax(axis=-1), 1)
        low, high = (
            np.take_along_axis(ratio, (first - one)[..., None], -1)[..., 0] for one in (1, 0)
        )
        logs = np.log(np.maximum(low, 1e-300)), np.log(np.maximum(high, 1e-300))
        part = np.clip(-logs[0] / np.where(logs[1] > logs[0], logs[1] - logs[0], 1.0), 0.0, 1.0)
        steps = np.log(_STRAINS)
        strain = np.exp(steps[first - 1] + part * (steps[first] - steps[first - 1]))
        return np.where(above.any(axis=-1), strain, np.inf)


def _yields_at(
    form: ModelForm, elasticity: Elasticity, resistance: Resistance
) -> tuple[NDArray, NDArray]:
    """Return C on every smooth piece, up to where crushing costs energy, and where each yields."""
    knots = form.knots
    inner = np.linspace(0.0, 1.0, _LOOKS + 1)[:-1]
    looks = np.append((knots[:-1, None] + np.diff(knots)[:, None] * inner).ravel(), knots[-1])
    looks = looks[looks < 1.0]  # at 1 a resistance may be infinite
    pressure, force = _at_yield(looks, form, elasticity, resistance)
    costs = np.flatnonzero(force < 0.0)
    if costs.size and (first := int(costs[0])):
        # The force is nearly straight between two looks.
        part = force[first - 1] / (force[first - 1] - force[first])
        last = looks[first - 1] + part * (looks[first] - looks[first - 1])
        at_last, _ = _at_yield(np.array([last]), form, elasticity, resistance)
        return np.append(looks[:first], last), np.append(pressure[:first], at_last)
    return (looks[:1], pressure[:1]) if costs.size else (looks, pressure)


def _at_yield(
    crushing: NDArray, form: ModelForm, elasticity: Elasticity, resistance: Resistance
) -> tuple[NDArray, NDArray]:
    """Return pressure, infinite where C never yields, and driving force where each C yields."""
    elastic = resistance.yield_strain(crushing, form, elasticity)
    reachable = np.isfinite(elastic) & (elastic < LARGEST)
    strain = form.total_strain(np.where(reachable, elastic, LARGEST), crushing)
    pressure = np.where(reachable, form.stress(strain, crushing, elasticity), np.inf)
    return pressure, form.driving_force(strain, crushing, elasticity)
