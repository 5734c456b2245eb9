"""Crushing along any history of strain or stress: when C grows, and where the work goes.

C grows along the yield line of the form and resistance, the strain or stress at which each C
yields. Where that line falls, C jumps to the next C that holds the load: an event, whose energy is
booked for itself.
"""

from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import LARGEST, Resistance
from branchcrush.crushing.yield_line import Control, YieldLine

_ORDER = 24
# Nodes of Gauss and Legendre, and where the extremes of Chebyshev's polynomials lie.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(32)
_EXTREMES = np.cos(np.pi * np.arange(_ORDER + 1) / _ORDER)


class Event(NamedTuple):
    """What happened at one load."""

    # "yield" at first; "jump"; "complete" at the last C, 1; "lock" where C grows no more before it.
    kind: str
    strain: float  # eps where it began [-]
    crushing: float  # C before [-]
    crushing_after: float  # C after; more where it jumped [-]
    dissipated: float  # by a jump [J/m3]
    load: int = 0  # on the way to which load, counted from 0


@dataclass
class Evolution:
    """History of crushing; each array has the shape (states,) of what was asked for.

    `work` and `dissipated` are integrated by quadrature, each for itself, so that `stored` +
    `dissipated` is an independent check on `work`.
    """

    strain: NDArray  # eps, total [-]
    crushing: NDArray  # C [-]
    elastic_strain: NDArray  # eps_e [-]
    stress: NDArray  # sigma [Pa]
    driving_force: NDArray  # E_C [J/m3]
    stored: NDArray  # Psi [J/m3]
    dissipated: NDArray  # integral of E_C over C [J/m3]
    compaction: NDArray  # plastic work, the part of `work` that moves the jamming point [J/m3]
    work: NDArray  # integral of sigma over eps [J/m3]
    events: list[Event] = field(default_factory=list)


def evolve(
    load: ArrayLike,
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    control: Control = "strain",
) -> Evolution:
    """Return crushing, stress and energies along any history of strain or stress.

    C grows where the resistance says so and is frozen below it, and no farther than where it would
    cost elastic energy, E_C < 0: there the grading locks. A jump under stress control is a snap.

    Parameters
    ----------
    load : array_like, shape (states,)
        Total strains [-], or stresses, 0 or more [Pa], in turn; the history begins unloaded, at
        the jamming point before crushing.
    form : ModelForm
    elasticity : Elasticity
    resistance : Resistance
    control : {"strain", "stress"}
        What `load` is.

    Returns
    -------
    Evolution

    Raises
    ------
    ValueError
        For loads that are not one row of finite numbers, stresses below 0, or loads under which the
        elastic strain would be 0.5 and more, which no elastic law is meant for.

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> from branchcrush.crushing.resistance import CriticalEnergy
    >>> paper = ModelForm(LinearCurve(0.6))
    >>> law, resistance = PowerLawElasticity(1.0, 1.0), CriticalEnergy(1e-3, 2.0)
    >>> path = evolve([0.05, 0.1, 0.0], paper, law, resistance)
    >>> path.crushing.round(4).tolist(), np.allclose(path.work, path.stored + path.dissipated)
    ([0.0, 0.4226, 0.4226], True)
    >>> [(event.kind, round(event.strain, 4)) for event in path.events]
    [('yield', 0.0577)]
    """
    load = np.asarray(load, float)
    if load.ndim != 1 or not load.size or not np.isfinite(load).all():
        raise ValueError("the history must be one row of finite numbers")
    if control == "stress" and (load < 0).any():
        raise ValueError("stresses must not be below 0")
    walk = _Walk(YieldLine(form, elasticity, resistance, control))
    states = []
    for walk.number, target in enumerate(load.tolist()):
        walk.go(target)
        states.append((walk.strain, walk.crushing, walk.dissipated, walk.compaction, walk.work))
    strain, crushing, dissipated, compaction, work = np.transpose(states)
    return Evolution(
        strain=strain,
        crushing=crushing,
        elastic_strain=form.elastic_strain(strain, crushing),
        stress=form.stress(strain, crushing, elasticity),
        driving_force=form.driving_force(strain, crushing, elasticity),
        stored=form.free_energy(strain, crushing, elasticity),
        dissipated=dissipated,
        compaction=compaction,
        work=work,
        events=walk.events,
    )


class _Walk:
    """A state on its way through a history, and what the way took."""

    def __init__(self, line: YieldLine) -> None:
        self.line = line
        self.strain = self.crushing = self.dissipated = self.compaction = self.work = 0.0
        self.events: list[Event] = []
        self.number = 0  # of the load that it goes to

    def go(self, target: float) -> None:
        """Go to a load: elastically, along the yield line, and over its jumps."""
        line = self.line
        while float(line.load_at(self.crushing)) < target:
            yields_at = float(line.strain_at(self.crushing))
            if self.crushing >= line.looks[-1]:
                ends = "complete" if line.whole else "lock"
                if not self.events or self.events[-1].kind != ends:
                    self._tell(ends, yields_at)
                break
            if not self.events:
                self._tell("yield", yields_at)
            self._load_to(yields_at)
            if self._crush(target):
                break
        self._load_to(float(line.strain_under(target, self.crushing)))

    def _tell(self, kind: str, strain: float) -> None:
        self.events.append(Event(kind, strain, self.crushing, self.crushing, 0.0, self.number))

    def _crush(self, target: float) -> bool:
        """Follow the yield line to a load, or to the end of a smooth piece or over a jump.

        Return whether the load was reached.
        """
        line, begin = self.line, self.crushing
        after = np.searchsorted(line.looks, begin, side="right")
        end = line.pieces[np.searchsorted(line.pieces, begin, side="right")]
        looks = np.append(begin, line.looks[after:][line.looks[after:] <= end])
        loads = np.append(line.load_at(begin), line.loads[after : after + looks.size - 1])
        # Infinite where C never yields, at both ends of a piece too.
        falls = np.flatnonzero(loads[1:] <= loads[:-1])
        reaches = np.flatnonzero(loads[1:] >= target)
        if reaches.size and not (falls.size and falls[0] < reaches[0]):
            self._follow(line.holding(target, looks[reaches[0]], looks[reaches[0] + 1]))
            return True
        if falls.size:
            first = falls[0]
            low = float(looks[max(first - 1, 0)])
            top = line.top(low, float(looks[first + 1]))
            if float(line.load_at(top)) >= target:  # a peak between two looks
                self._follow(line.holding(target, low, top))
                return True
            self._follow(top)
            if self.crushing < looks[first + 1]:
                self._jump()
        else:
            self._follow(end)
        return False

    def _jump(self) -> None:
        """Let C go on at one load to where the yield line is as high again."""
        line, load = self.line, float(self.line.load_at(self.crushing))
        after = np.searchsorted(line.looks, self.crushing, side="right")
        holds = np.flatnonzero(line.loads[after:] > load)
        if holds.size:
            high = after + holds[0]
            # From where it is when it jumps only to the next look, and to there at least when the
            # line falls by no more than rounding.
            to = line.holding(load, max(line.looks[high - 1], self.crushing), line.looks[high])
            to = to if to > self.crushing else float(line.looks[high])
        else:
            to = float(line.looks[-1])
        before, strain, dissipated = self.crushing, self.strain, self.dissipated
        self._follow(to, load)
        lost = self.dissipated - dissipated
        self.events.append(Event("jump", strain, before, to, lost, self.number))

    def _follow(self, to: float, load: float | None = None) -> None:
        """Let C grow along the yield line, or at one load, and add up what that takes."""
        inside = self.line.pieces[(self.line.pieces > self.crushing) & (self.line.pieces < to)]
        for end in [*inside.tolist(), to]:
            if load is None and end in self.line.halts:
                self._load_to(float(self.line.strain_at(end)))
                self.crushing = end
                continue
            for part in [*self._kinks(end, load), end]:
                self._integrate(part, load)

    def _integrate(self, to: float, load: float | None) -> None:
        """Let C grow over a piece that is smooth."""
        line, form, law = self.line, self.line.form, self.line.elasticity
        half, middle = (to - self.crushing) / 2.0, (to + self.crushing) / 2.0
        if half <= 0.0:
            return
        # The first of the extremes is the end.
        at = np.concatenate([middle + half * _NODES, [to], middle + half * _EXTREMES[1:]])
        # Rounding would lead over a step of the line.
        at = np.clip(at, self.crushing, to)
        strain = line.strain_at(at) if load is None else line.strain_under(load, at)
        at_end = float(strain[_NODES.size])
        series = chebyshev.chebfit(_EXTREMES, strain[_NODES.size :], _ORDER)
        slope = chebyshev.chebval(_NODES, chebyshev.chebder(series))
        at, strain = at[: _NODES.size], strain[: _NODES.size]
        stress = form.stress(strain, at, law)
        moved = form.jamming.log_slope(at) / form.jamming.value(at)
        self.work += float(_WEIGHTS @ (stress * slope))
        self.dissipated += half * float(_WEIGHTS @ form.driving_force(strain, at, law))
        self.compaction += half * float(_WEIGHTS @ (stress * moved))
        self.crushing, self.strain = to, at_end
        if load is None:
            line.known[to] = at_end

    def _kinks(self, to: float, load: float | None) -> list[float]:
        """Return the C on the way to one at which the elastic strain passes a knot of the law."""
        line = self.line
        if line.elasticity.knots.size == 1 or to <= self.crushing:  # nothing yields at the onset
            return []
        from scipy.optimize import brentq  # slow to import, and few jobs need it

        middle, half = (to + self.crushing) / 2.0, (to - self.crushing) / 2.0
        at = middle - half * _EXTREMES
        places = []
        for knot in line.elasticity.knots.tolist():
            passed = np.diff(line.beyond(at, knot, load) > 0.0)
            for first in np.flatnonzero(passed).tolist():
                places.append(brentq(line.beyond, at[first], at[first + 1], args=(knot, load)))
        return sorted(place for place in places if self.crushing < place < to)

    def _load_to(self, strain: float) -> None:
        """Go to a strain at the C that is, and add up the work."""
        form, law = self.line.form, self.line.elasticity
        elastic = float(form.elastic_strain(strain, self.crushing))
        if not elastic < LARGEST:
            raise ValueError(
                f"an elastic strain of {elastic:.3g}: loads must keep it below {LARGEST}"
            )
        low, high = sorted((self.strain, strain))
        knots = form.total_strain(law.knots, self.crushing)
        places = np.unique(np.clip(knots, low, high))
        places = places if strain > self.strain else places[::-1]
        # Nodes crowd at both ends as t^3, which makes a power law of any exponent smooth there.
        t = (1.0 + _NODES) / 2.0
        x, weights = t**3 * (10 - 15 * t + 6 * t**2), 15 * _WEIGHTS * (t * (1 - t)) ** 2
        for begin, end in pairwise([self.strain, *places.tolist(), strain]):
            stress = form.stress(begin + (end - begin) * x, self.crushing, law)
            self.work += float(weights @ stress) * (end - begin)
        self.strain = strain
