"""What is known of the energy split of a sample: the types behind `energy_split.json`.

Each has a `result`, which is what the file holds, and a `read`, which takes it back. A number that
is not known is nan here and null in the file.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from branchcrush.statistics.intervals import Interval

_NAN = float("nan")
_UNKNOWN = Interval(_NAN, _NAN, _NAN)
# The quantities of a curvature, in the order of the file.
_BENDS = ("curvature", "slope_at_10_percent", "slope_at_mean", "slope_at_90_percent")
# What the file calls the numbers of the packings at the end, with their units.
_END_NAMES = {
    "solid_fraction": "solid_fraction",
    "jamming_solid_fraction": "jamming_solid_fraction",
    "mean_stress": "mean_stress_Pa",
    "elastic_energy_density": "elastic_energy_J_per_m3",
    "median_overlap_over_length": "median_overlap_over_length",
    "coordination_number": "coordination_number",
    "mechanical_coordination_number": "mechanical_coordination_number",
    "rattler_fraction": "rattler_fraction",
}


def _number(value: float | None) -> float:
    return _NAN if value is None else float(value)


@dataclass(frozen=True)
class FittedPredictor:
    """A predictor of the energy of a branch, fitted, and what it explains on seeds left out.

    Parameters
    ----------
    name : str
        Its key in `energy.predictors.PREDICTORS`.
    formula : str
    parameters : mapping of str to Interval
        After the scale, by name [-]; empty where there is no fit.
    explained : Interval
        Share of the deviance that it explains [-]; nan where no seeds can be left out.
    difference : Interval or None
        The same less that of the branch length [-]; None where that has no fit.
    exponent : float or None
        Of the branch length alone, n [-].
    reason : str or None
        Why there is no fit.
    left_out_reason : str or None
        Why nothing can be left out.

    Examples
    --------
    >>> FittedPredictor.without("surface", "exp(...)", "too few lengths").result()
    {'name': 'surface', 'formula': 'exp(...)', 'reason': 'too few lengths'}
    """

    name: str
    formula: str
    parameters: Mapping[str, Interval]
    explained: Interval
    difference: Interval | None
    exponent: float | None = None
    reason: str | None = None
    left_out_reason: str | None = None

    @classmethod
    def without(cls, name: str, formula: str, reason: str) -> "FittedPredictor":
        """Return a predictor that has no fit, and why."""
        return cls(name, formula, {}, _UNKNOWN, None, reason=reason)

    def result(self) -> dict[str, Any]:
        """Return what `energy_split.json` holds of it."""
        entry: dict[str, Any] = {"name": self.name, "formula": self.formula}
        if self.reason is not None:
            return {**entry, "reason": self.reason}
        entry["parameters"] = {key: value._asdict() for key, value in self.parameters.items()}
        entry |= self.explained.named("explained_deviance")
        if self.difference is not None:
            entry |= self.difference.named("difference_to_branch_length")
        if self.left_out_reason is not None:
            entry["left_out_reason"] = self.left_out_reason
        if self.exponent is not None:
            entry["exponent"] = self.exponent
        return entry

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "FittedPredictor":
        """Return the predictor of which a file holds this."""
        if "reason" in result:
            return cls.without(result["name"], result["formula"], result["reason"])
        known = "difference_to_branch_length" in result
        return cls(
            result["name"],
            result["formula"],
            {
                key: Interval(*(_number(value[part]) for part in Interval._fields))
                for key, value in result["parameters"].items()
            },
            Interval.read(result, "explained_deviance"),
            Interval.read(result, "difference_to_branch_length") if known else None,
            exponent=result.get("exponent"),
            left_out_reason=result.get("left_out_reason"),
        )


@dataclass(frozen=True)
class Curvature:
    """How far the energies are from a power law of branch length.

    Parameters
    ----------
    curvature : Interval
        c [-], 0 for a power law.
    slope_at_10_percent, slope_at_mean, slope_at_90_percent : Interval
        d ln E/d ln l at the tenth of the branches that is shortest, at the geometric mean length,
        and at the tenth that is longest [-].
    reason : str or None
        Why there is none; the numbers are nan then.
    """

    curvature: Interval
    slope_at_10_percent: Interval
    slope_at_mean: Interval
    slope_at_90_percent: Interval
    reason: str | None = None

    @classmethod
    def without(cls, reason: str) -> "Curvature":
        """Return that there is no curvature, and why."""
        return cls(_UNKNOWN, _UNKNOWN, _UNKNOWN, _UNKNOWN, reason)

    def result(self) -> dict[str, Any]:
        """Return what `energy_split.json` holds of it."""
        if self.reason is not None:
            return {"reason": self.reason}
        named: dict[str, Any] = {}
        for name in _BENDS:
            named |= getattr(self, name).named(name)
        return named

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "Curvature":
        """Return the curvature of which a file holds this."""
        if "reason" in result:
            return cls.without(result["reason"])
        return cls(*(Interval.read(result, name) for name in _BENDS))


@dataclass(frozen=True)
class StateFit:
    """What is fitted to all branches of one state at once.

    Parameters
    ----------
    predictors : tuple of FittedPredictor
        The first of them is the branch length.
    curvature : Curvature
    state : int or None
        Its number; None at the end.
    solid_fraction : float or None
        phi, mean of the seeds [-]; None at the end, where `EndState` has it.
    """

    predictors: tuple[FittedPredictor, ...]
    curvature: Curvature
    state: int | None = None
    solid_fraction: float | None = None

    def result(self) -> dict[str, Any]:
        """Return what `energy_split.json` holds of it."""
        place = {"state": self.state, "solid_fraction": self.solid_fraction}
        return {
            **(place if self.state is not None else {}),
            "predictors": [predictor.result() for predictor in self.predictors],
            "curvature": self.curvature.result(),
        }

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "StateFit":
        """Return the state of which a file holds this."""
        state = result.get("state")
        return cls(
            tuple(FittedPredictor.read(entry) for entry in result["predictors"]),
            Curvature.read(result["curvature"]),
            state,
            None if state is None else _number(result["solid_fraction"]),
        )


@dataclass(frozen=True)
class EndState:
    """What the packings are like at the end of their loading, means over the seeds.

    Parameters
    ----------
    seeds, branches : int
        Certified packings, and the branches of all of them.
    solid_fraction, jamming_solid_fraction : float
        phi and phi_J [-].
    mean_stress : float
        [Pa]
    elastic_energy_density : float
        [J/m3]
    median_overlap_over_length : float
        Overlap over branch length [-]; that over the smaller radius is another.
    coordination_number, mechanical_coordination_number, rattler_fraction : float
        [-]
    """

    seeds: int
    branches: int
    solid_fraction: float
    jamming_solid_fraction: float
    mean_stress: float
    elastic_energy_density: float
    median_overlap_over_length: float
    coordination_number: float
    mechanical_coordination_number: float
    rattler_fraction: float

    def result(self) -> dict[str, Any]:
        """Return what `energy_split.json` holds of it."""
        numbers = {name: getattr(self, field) for field, name in _END_NAMES.items()}
        return {"seeds": self.seeds, "branches": self.branches, **numbers}

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "EndState":
        """Return the packings of which a file holds this."""
        numbers = {field: _number(result[name]) for field, name in _END_NAMES.items()}
        return cls(seeds=result["seeds"], branches=result["branches"], **numbers)


@dataclass(frozen=True)
class EnergySplitFit:
    """The energy split of a sample at the end of its loading, and near jamming.

    Parameters
    ----------
    exponent : Interval
        n of f(l) = (l/l_r)^n, of the bins of all seeds [-].
    confidence : float
        Of every interval [-].
    amplitude : float
        A of A l^n [J/m^n].
    reference_length : float
        l_r [m].
    exponent_of_each_seed : tuple of float
        n of each seed alone [-].
    mean_of_seed_exponents : float
        [-]
    packings : EndState or None
        None where no seed is certified.
    cubic_slope, cubic_r_squared : float
        Of the paper's Fig. 6 [-].
    end : StateFit
        What is fitted to all branches at once, at the end.
    near_jamming : StateFit or None
        The same in the first loaded state; None where that is the end.
    reason : str or None
        Why there is no energy split; the numbers are nan then.

    Examples
    --------
    >>> EnergySplitFit.without("no seed is certified").result()
    {'reason': 'no seed is certified'}
    >>> fit = EnergySplitFit.read({"reason": "no seed is certified"})
    >>> fit.reason, fit.exponent.estimate, fit.packings
    ('no seed is certified', nan, None)
    """

    exponent: Interval
    confidence: float
    amplitude: float
    reference_length: float
    exponent_of_each_seed: tuple[float, ...]
    mean_of_seed_exponents: float
    packings: EndState | None
    cubic_slope: float
    cubic_r_squared: float
    end: StateFit
    near_jamming: StateFit | None
    reason: str | None = None

    @classmethod
    def without(cls, reason: str, packings: EndState | None = None) -> "EnergySplitFit":
        """Return that there is no energy split, why, and what is known of the packings."""
        nothing = StateFit((), Curvature.without(reason))
        return cls(
            exponent=_UNKNOWN,
            confidence=_NAN,
            amplitude=_NAN,
            reference_length=_NAN,
            exponent_of_each_seed=(),
            mean_of_seed_exponents=_NAN,
            packings=packings,
            cubic_slope=_NAN,
            cubic_r_squared=_NAN,
            end=nothing,
            near_jamming=nothing,
            reason=reason,
        )

    def result(self) -> dict[str, Any]:
        """Return what `energy_split.json` holds, but for its provenance."""
        packings = {} if self.packings is None else self.packings.result()
        if self.reason is not None:
            return {**packings, "reason": self.reason}
        return {
            **self.exponent.named("exponent"),
            "confidence": self.confidence,
            "amplitude_J_per_m_n": self.amplitude,
            "reference_length_m": self.reference_length,
            "exponent_of_each_seed": list(self.exponent_of_each_seed),
            "mean_of_seed_exponents": self.mean_of_seed_exponents,
            **packings,
            "cubic_slope": self.cubic_slope,
            "cubic_r_squared": self.cubic_r_squared,
            **self.end.result(),
            **({} if self.near_jamming is None else {"near_jamming": self.near_jamming.result()}),
        }

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "EnergySplitFit":
        """Return the fit of which a file holds this; other keys, as provenance, are ignored."""
        packings = EndState.read(result) if "seeds" in result else None
        if "reason" in result:
            return cls.without(result["reason"], packings)
        ends = {key: result[key] for key in ("predictors", "curvature")}
        near = result.get("near_jamming")
        return cls(
            exponent=Interval.read(result, "exponent"),
            confidence=result["confidence"],
            amplitude=_number(result["amplitude_J_per_m_n"]),
            reference_length=_number(result["reference_length_m"]),
            exponent_of_each_seed=tuple(map(_number, result["exponent_of_each_seed"])),
            mean_of_seed_exponents=_number(result["mean_of_seed_exponents"]),
            packings=packings,
            cubic_slope=_number(result["cubic_slope"]),
            cubic_r_squared=_number(result["cubic_r_squared"]),
            end=StateFit.read(ends),
            near_jamming=None if near is None else StateFit.read(near),
        )
