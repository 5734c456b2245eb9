"""The load at which each C yields: the line along which crushing goes on."""

from copy import copy
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import Resistance

Control = Literal["strain", "stress"]

# How often the rest up to C = 1 is halved: powers of 1 - C are smooth on each piece.
_HALVINGS = 40
# Places on each smooth piece at which the yield line is looked at.
_LOOKS = 17
# How often where crushing ends at a peak of the driving force: more would be rounding.
_NEAR = 30
# Each divides by 16 how far the end of the line is known.
_ROUNDS = 12
# Halvings after which a step of the line stands out from its slope, and the least one [-].
_HALVINGS_OF_STEPS, _STEP = 6, 1e-9


class YieldLine:
    """The load at which each C yields, from C = 0 to where crushing is admissible no more.

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    resistance : Resistance
    control : {"strain", "stress"}
        What a load is: a total strain [-], or a stress [Pa].

    Attributes
    ----------
    pieces : ndarray
        C between which the line is smooth [-].
    looks, loads : ndarray
        C on every piece, and the loads at which they yield; infinite where one never does.
    known : dict of float
        Total strains at which single C yield, each looked for once.
    whole : bool
        Whether every C of the form yields and sets energy free, up to its last.
    halts : frozenset of float
        The C after a step of the line: the one before it halts until the load has risen by it. A
        law that passes measured states has more than one peak of the driving force, and the first
        one may no longer reach the resistance.
    """

    def __init__(
        self,
        form: ModelForm,
        elasticity: Elasticity,
        resistance: Resistance,
        control: Control = "strain",
    ) -> None:
        self.form, self.elasticity = form, elasticity
        self.resistance, self.control = resistance, control
        self.known: dict[float, float] = {}
        knots = np.union1d(form.knots, resistance.knots)
        knots = knots[knots <= form.knots[-1]]
        rest = 1.0 - 0.5 ** np.arange(1, _HALVINGS + 1)
        self.pieces = np.union1d(knots, rest[rest < knots[-1]])
        if knots[-1] == 1.0:  # there a resistance may be infinite
            self.pieces = self.pieces[:-1]
        self.whole = True
        self._look()
        end = self._last_yielding()
        if end < self.pieces[-1]:
            # The line is as steep there as a root is.
            near = end - end * 0.5 ** np.arange(1, _NEAR + 1)
            self._end_at(end, near)
        end = self._last_admissible()
        if end < self.pieces[-1]:
            self._end_at(end)
        self.halts: frozenset[float] = frozenset()
        if elasticity.knots.size > 1:
            self._look_for_halts()
        self.loads = self.load_at(self.looks)

    def under_stress(self) -> "YieldLine":
        """Return the same line of the stresses at which each C yields."""
        line = copy(self)
        line.control = "stress"
        line.loads = line.load_at(line.looks)
        return line

    def _end_at(self, end: float, near: ArrayLike = ()) -> None:
        self.whole = False
        pieces = np.union1d(self.pieces, near)
        self.pieces = np.append(pieces[pieces < end], end)
        self._look()

    def _look_for_halts(self) -> None:
        """Find the steps of the line, between two C that are neighbours as numbers."""
        low, high = self.looks[:-1], self.looks[1:]
        at_low, at_high = (self.strain_at(self.looks)[ends] for ends in (np.s_[:-1], np.s_[1:]))
        least = np.maximum((at_high - at_low) * 1.5 * 0.5**_HALVINGS_OF_STEPS, _STEP)
        number = 0
        while low.size:
            middle = low + (high - low) / 2.0
            whole = (middle <= low) | (middle >= high)
            if whole.all():
                break
            at = self._strain_at(middle)
            upper = at_high - at > at - at_low
            low, at_low = np.where(upper, middle, low), np.where(upper, at, at_low)
            high, at_high = np.where(upper, high, middle), np.where(upper, at_high, at)
            number += 1
            if number >= _HALVINGS_OF_STEPS:
                steps = at_high - at_low > least
                low, high, least = low[steps], high[steps], least[steps]
                at_low, at_high = at_low[steps], at_high[steps]
        self.halts = frozenset(high.tolist())
        if self.halts:
            # Before a step the line is as steep as a root is.
            near = (low[:, None] * (1.0 - 0.5 ** np.arange(1, _NEAR + 1))).ravel()
            end = self.pieces[-1]
            self.pieces = np.union1d(self.pieces, np.concatenate([near, low, high]))
            self.pieces = self.pieces[self.pieces <= end]
            self._look()

    def _look(self) -> None:
        inner = np.linspace(0.0, 1.0, _LOOKS)[:-1]
        looks = self.pieces[:-1, None] + np.diff(self.pieces)[:, None] * inner
        # Of pieces between neighbours there are no looks but the ends.
        self.looks: NDArray = np.unique(np.append(looks.ravel(), self.pieces[-1]))
        self._at_looks: NDArray | None = None

    def _last_yielding(self) -> float:
        """Return the C up to which each one yields at some strain."""
        between = self.looks
        for _ in range(_ROUNDS):
            never = np.flatnonzero(np.isinf(self.strain_at(between)))
            if not never.size:
                return between[-1]
            if never[0] == 0:
                return between[0]
            between = np.linspace(between[never[0] - 1], between[never[0]], _LOOKS)
        return between[0]

    def _last_admissible(self) -> float:
        """Return the C up to which crushing sets energy free on the yield line."""
        from scipy.optimize import brentq  # slow to import, and few jobs need it

        def force(crushing: ArrayLike) -> NDArray:
            strain = self.strain_at(crushing)
            loaded = np.where(np.isfinite(strain), strain, 0.0)
            return self.form.driving_force(loaded, crushing, self.elasticity)

        costs = np.flatnonzero(force(self.looks) < 0.0)
        if not costs.size:
            return self.looks[-1]
        first = costs[0]
        if first == 0:
            return self.looks[0]
        return brentq(lambda at: float(force(at)), *self.looks[first - 1 : first + 1], xtol=1e-14)

    def strain_at(self, crushing: ArrayLike) -> NDArray:
        """Return the total strain at which each C yields."""
        if crushing is self.looks:
            if self._at_looks is None:
                self._at_looks = self._strain_at(crushing)
            return self._at_looks
        if np.ndim(crushing) > 0:
            return self._strain_at(crushing)
        one = np.asarray(crushing).item()
        if one not in self.known:
            self.known[one] = float(self._strain_at(one))
        return np.asarray(self.known[one])

    def _strain_at(self, crushing: ArrayLike) -> NDArray:
        elastic = self.resistance.yield_strain(crushing, self.form, self.elasticity)
        reachable = np.where(np.isfinite(elastic), elastic, 0.0)
        strain = self.form.total_strain(reachable, crushing)
        return np.where(np.isfinite(elastic), strain, np.inf)

    def load_at(self, crushing: ArrayLike) -> NDArray:
        """Return the strain or stress at which each C yields."""
        strain = self.strain_at(crushing)
        if self.control == "strain":
            return strain
        stress = self.form.stress(np.minimum(strain, 1.0), crushing, self.elasticity)
        return np.where(np.isfinite(strain), stress, np.inf)

    def strain_under(self, load: float, crushing: ArrayLike) -> NDArray:
        """Return the total strain under a load at each C."""
        if self.control == "strain":
            return np.broadcast_to(load, np.shape(crushing)).astype(float)
        elastic = self.elasticity.strain_at_pressure(load / self.form.factor.value(crushing))
        return self.form.total_strain(elastic, crushing)

    def beyond(self, crushing: ArrayLike, elastic: float, load: float | None = None) -> NDArray:
        """Return a number above 0 where the elastic strain is more than one.

        On the yield line, or under one load, at each C.
        """
        if load is None:
            strain = self.form.total_strain(elastic, crushing)
            return -self.resistance.excess(strain, crushing, self.form, self.elasticity)
        if self.control == "strain":
            return self.form.elastic_strain(load, crushing) - elastic
        return load - self.form.factor.value(crushing) * self.elasticity.pressure(elastic)

    def holding(self, load: float, low: float, high: float) -> float:
        """Return the C between two that yields at a load; `high` holds it and `low` does not."""
        from scipy.optimize import brentq  # slow to import, and few jobs need it

        def excess(crushing: float) -> float:
            strain = self.strain_under(load, crushing)
            return float(self.resistance.excess(strain, crushing, self.form, self.elasticity))

        if excess(low) <= 0.0:
            return float(low)
        return (
            float(high)
            if excess(high) >= 0.0
            else brentq(excess, low, high, xtol=1e-15, rtol=1e-15)
        )

    def top(self, low: float, high: float) -> float:
        """Return the C between two at which the yield line is highest."""
        from scipy.optimize import minimize_scalar  # slow to import, and few jobs need it

        bounds = {"bounds": (low, high), "method": "bounded", "options": {"xatol": 1e-10}}
        best = minimize_scalar(lambda crushing: -float(self.load_at(crushing)), **bounds).x
        ends = np.array([low, best, high])
        return float(ends[np.argmax(self.load_at(ends))])


class CompressionLine(NamedTuple):
    """The states in which crushing goes on; arrays of the shape of C, nan where it never does."""

    elastic_strain: NDArray  # eps_e [-]
    stress: NDArray  # sigma [Pa]
    void_ratio: NDArray  # e [-]


def compression_line(
    form: ModelForm,
    crushing: ArrayLike,
    elasticity: Elasticity,
    resistance: Resistance,
    jamming: float,
) -> CompressionLine:
    r"""Return stress and void ratio while crushing goes on, from gradings alone.

    .. math:: e = \frac{1 - \epsilon_e}{\phi_J} - 1, \qquad \sigma = g\, p_0(\epsilon_e)

    Parameters
    ----------
    form : ModelForm
    crushing : array_like
        C, any shape [-].
    elasticity : Elasticity
    resistance : Resistance
    jamming : float
        phi_J before crushing [-].

    Returns
    -------
    CompressionLine

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> from branchcrush.crushing.resistance import ElasticStrainLimit
    >>> denser = ModelForm(LinearCurve(-1.0), LinearCurve(-0.2))
    >>> line = compression_line(
    ...     denser, [0.0, 1.0], PowerLawElasticity(1e9, 1.0), ElasticStrainLimit(0.01), 0.64
    ... )
    >>> line.stress.tolist(), line.void_ratio.round(4).tolist()
    ([10000000.0, 20000000.0], [0.5469, 0.2891])
    """
    crushing = np.asarray(crushing, float)
    elastic = resistance.yield_strain(crushing, form, elasticity)
    elastic = np.where(np.isfinite(elastic), elastic, np.nan)
    stress = form.factor.value(crushing) * elasticity.pressure(elastic)
    density = jamming * form.jamming.value(crushing)
    return CompressionLine(elastic, stress, (1.0 - elastic) / density - 1.0)
