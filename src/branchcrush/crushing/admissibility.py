"""What of a form of the crushing model can be: found for every C, and told in sentences.

Crushing must set energy free; C must grow with the load and never leap; the states that are elastic
must have no gap between them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.leaps import Leap, load_leaps
from branchcrush.crushing.resistance import Resistance
from branchcrush.crushing.yield_line import YieldLine

# Places from C = 0 to the end of a form, which is left out if it is C = 1.
_PLACES, _END = 401, 1.0 - 1e-9
# Driving force over stress that rounding may leave where nothing changes.
_NOTHING = 1e-9
# A step of C beyond the onset.
_STEP = 1e-6
# Of the steepest rise of the jamming point: below it the densest mixture is near.
_FLAT = 0.2
_ELASTIC_STATES = 60


@dataclass(frozen=True)
class Admissibility:
    """What of a form can be, for an elastic law and a resistance."""

    costs: tuple[tuple[float, float], ...]  # C from and to which crushing costs energy [-]
    leaps: tuple[Leap, ...]  # under a strain that rises
    snaps: tuple[Leap, ...]  # under a stress that rises
    hardens_at_onset: bool  # the yield stress rises as crushing begins
    gap_from: float | None  # C from which on the elastic domain is not convex [-]
    sentences: tuple[str, ...]  # one for each of these that is not as it must be

    @property
    def admissible(self) -> bool:
        """Whether crushing sets energy free at every C, C never leaps, the domain is convex."""
        return not (self.costs or self.leaps) and self.gap_from is None


def admissibility(
    form: ModelForm, elasticity: Elasticity, resistance: Resistance, largest: float
) -> Admissibility:
    """Return what of a form can be, and sentences of what cannot.

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    resistance : Resistance
    largest : float
        The largest elastic strain that the law is meant for [-].

    Returns
    -------
    Admissibility

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> from branchcrush.crushing.resistance import CriticalEnergy
    >>> stiffer, law = ModelForm(LinearCurve(-0.2)), PowerLawElasticity(1e9, 1.0)
    >>> print(*admissibility(stiffer, law, CriticalEnergy(1e5, 2.0), 0.1).sentences)
    From C = 0 on crushing would cost elastic energy: at equal strain more is stored as C grows.
    """
    places = np.linspace(0.0, form.knots[-1], _PLACES)
    changes = np.abs([form.factor.value(places) - 1.0, form.jamming.value(places) - 1.0]).max()
    if changes <= _NOTHING:
        told = "Crushing changes nothing in this form: the grading is the ultimate one already."
        return Admissibility((), (), (), True, None, (told,))
    costs = energy_costs(form, elasticity, resistance, largest)
    by_strain = YieldLine(form, elasticity, resistance)
    by_stress = by_strain.under_stress()
    leaps, snaps = (load_leaps(line, largest) for line in (by_strain, by_stress))
    onset, beyond = by_stress.load_at(np.array([0.0, _STEP]))
    gap = _gap(form, elasticity, resistance, largest, by_strain.looks[-1])
    return Admissibility(
        costs=tuple(costs),
        leaps=tuple(leaps),
        snaps=tuple(snaps),
        hardens_at_onset=bool(beyond >= onset),
        gap_from=None if gap is None else gap[0],
        sentences=(
            *(_told_cost(form, *ends) for ends in costs),
            *(_told_leap(leap, f"at a strain of {leap.load:.3g}", "leaps") for leap in leaps),
            *(_told_leap(snap, f"at {snap.load / 1e6:.3g} MPa", "snaps") for snap in snaps),
            *([] if gap is None else [_told_gap(*gap)]),
        ),
    )


def yielding_strain(
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    largest: float,
    crushing: ArrayLike,
) -> NDArray:
    """Return the elastic strain of yield for every C, at which the driving force has a sign.

    Parameters
    ----------
    form, elasticity, resistance, largest
        As for `admissibility`.
    crushing : array_like
        C, any shape [-].

    Returns
    -------
    ndarray
        eps_e [-]. Where some of the C never yield it is for all of them that of C = 0; the largest
        one if that does not either.
    """
    found = resistance.yield_strain(crushing, form, elasticity)
    if np.isfinite(found).all():
        return found
    onset = float(resistance.yield_strain(0.0, form, elasticity))
    return np.full_like(found, min(onset, largest))


def force_over_stress(
    form: ModelForm, elasticity: Elasticity, elastic_strain: ArrayLike, crushing: ArrayLike
) -> NDArray:
    """Return the driving force over the mean stress, E_C/sigma.

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    elastic_strain, crushing : array_like
        eps_e, beyond the onset, and C, any shape [-].

    Returns
    -------
    ndarray
        [-]
    """
    strain = form.total_strain(elastic_strain, crushing)
    force = form.driving_force(strain, crushing, elasticity)
    return force / form.stress(strain, crushing, elasticity)


def energy_costs(
    form: ModelForm, elasticity: Elasticity, resistance: Resistance, largest: float
) -> list[tuple[float, float]]:
    """Return from which C to which crushing would cost elastic energy, E_C < 0.

    Parameters
    ----------
    form, elasticity, resistance, largest
        As for `admissibility`; the elastic strain is that of `yielding_strain`.

    Returns
    -------
    list of tuple of float
        From and to [-]; the last ends where the form does if it does not end before.
    """
    from scipy.optimize import brentq  # slow to import, and few jobs need it

    places = np.minimum(np.union1d(np.linspace(0.0, form.knots[-1], _PLACES), form.knots), _END)
    elastic = yielding_strain(form, elasticity, resistance, largest, places)

    def force(crushing: ArrayLike) -> NDArray:
        strain = np.interp(np.asarray(crushing, float), places, elastic)
        return force_over_stress(form, elasticity, strain, crushing) + _NOTHING

    below = force(places) < 0.0
    changes = np.flatnonzero(below[1:] != below[:-1])
    ends = [brentq(lambda at: float(force(at)), *places[k : k + 2]) for k in changes]
    if below[0]:
        ends.insert(0, 0.0)
    if below[-1]:
        ends.append(float(form.knots[-1]))
    return list(zip(ends[::2], ends[1::2], strict=True))


def least_hardening_exponent(form: ModelForm, elasticity: Elasticity, strain: float) -> float:
    r"""Return the least s of E_c0/(1 - C)^s with which the stress never falls as crushing begins.

    .. math:: s_{min} = \left.\frac{\partial \ln E_C}{\partial C}\right|_{\sigma,\, C = 0}

    For the paper's form and a power law it is theta (1 + 1/m).

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    strain : float
        At which crushing begins [-].

    Returns
    -------
    float
        [-]; below 0 where even a constant resistance hardens.

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> paper, law = ModelForm(LinearCurve(0.6)), PowerLawElasticity(1.0, 1.5)
    >>> round(least_hardening_exponent(paper, law, 0.1), 8)
    1.0
    """
    crushing = _STEP * np.arange(3)
    stress = elasticity.pressure(strain) / form.factor.value(crushing)
    elastic = elasticity.strain_at_pressure(stress)
    total = form.total_strain(elastic, crushing)
    force = np.log(form.driving_force(total, crushing, elasticity))
    return float((-3.0 * force[0] + 4.0 * force[1] - force[2]) / (2.0 * _STEP))


def _gap(
    form: ModelForm, elasticity: Elasticity, resistance: Resistance, largest: float, end: float
) -> tuple[float, float] | None:
    """Return the first C that yields and is elastic again at a larger strain, and that strain."""
    crushing = np.linspace(0.0, min(end, _END), _PLACES)
    elastic = resistance.yield_strain(crushing, form, elasticity)
    yields = elastic < largest
    if not yields.any():
        return None
    crushing, elastic = crushing[yields, None], elastic[yields, None]
    strain = elastic * (largest / elastic) ** np.linspace(0.0, 1.0, _ELASTIC_STATES)[1:]
    total = form.total_strain(strain, crushing)
    again: NDArray = resistance.excess(total, crushing, form, elasticity) < 0.0
    if not again.any():
        return None
    row = int(again.any(axis=1).argmax())
    return float(crushing[row, 0]), float(strain[row, again[row].argmax()])


def _told_cost(form: ModelForm, begin: float, end: float) -> str:
    where = f"From C = {begin:.3g} " + (f"to {end:.3g}" if end < form.knots[-1] else "on")
    told = f"{where} crushing would cost elastic energy: "
    places = np.linspace(0.0, min(form.knots[-1], _END), _PLACES)
    density = form.jamming.value(places)
    if np.ptp(density) == 0.0:
        return f"{told}at equal strain more is stored as C grows."
    rise = form.jamming.log_slope(places)
    if form.jamming.log_slope(begin) < _FLAT * rise.max():
        densest = places[density.argmax()]
        return f"{told}the densest mixture is at C = {densest:.3g}, and more fines loosen it."
    return f"{told}fines begin to carry load, which stiffens the grains more than it packs them."


def _told_leap(leap: Leap, where: str, does: str) -> str:
    return f"C {does} from {leap.crushing:.3g} to {leap.crushing_after:.3g} {where}, by itself."


def _told_gap(crushing: float, strain: float) -> str:
    return (
        f"From C = {crushing:.3g} on the elastic domain is not convex: beyond an elastic strain of "
        f"{strain:.3g} a larger load would crush no more, since stiffening takes the energy."
    )
