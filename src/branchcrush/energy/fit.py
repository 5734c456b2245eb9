"""What is known of the energy split of a sample: the types behind `energy_split.json`.

Each, as those of `energy.state_fit`, has a `result`, which is what the file holds, and a `read`,
which takes it back. A number that is not known is nan here and null in the file.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from branchcrush.energy.state_fit import UNKNOWN, Curvature, StateFit, number_or_nan
from branchcrush.statistics.intervals import Interval

_NAN = float("nan")
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
        """Return the packings of which a file holds this.

        Parameters
        ----------
        result : mapping
            As `result` returns it, null where it has nan.

        Returns
        -------
        EndState
        """
        numbers = {field: number_or_nan(result[name]) for field, name in _END_NAMES.items()}
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
    estimators : mapping of str to Interval
        n at the end, by the names in `energy.estimators.ESTIMATORS` [-].

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
    estimators: Mapping[str, Interval] = field(default_factory=dict)

    @classmethod
    def without(cls, reason: str, packings: EndState | None = None) -> "EnergySplitFit":
        """Return that there is no energy split, why, and what is known of the packings.

        Parameters
        ----------
        reason : str
        packings : EndState, optional

        Returns
        -------
        EnergySplitFit
        """
        nothing = StateFit((), Curvature.without(reason))
        return cls(
            exponent=UNKNOWN,
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
            "estimators": {name: value._asdict() for name, value in self.estimators.items()},
            **self.end.result(),
            **({} if self.near_jamming is None else {"near_jamming": self.near_jamming.result()}),
        }

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "EnergySplitFit":
        """Return the fit of which a file holds this.

        Parameters
        ----------
        result : mapping
            As `result` returns it, null where it has nan; other keys, as provenance, are ignored.

        Returns
        -------
        EnergySplitFit
        """
        packings = EndState.read(result) if "seeds" in result else None
        if "reason" in result:
            return cls.without(result["reason"], packings)
        near = result.get("near_jamming")
        return cls(
            exponent=Interval.read(result, "exponent"),
            confidence=result["confidence"],
            amplitude=number_or_nan(result["amplitude_J_per_m_n"]),
            reference_length=number_or_nan(result["reference_length_m"]),
            exponent_of_each_seed=tuple(map(number_or_nan, result["exponent_of_each_seed"])),
            mean_of_seed_exponents=number_or_nan(result["mean_of_seed_exponents"]),
            packings=packings,
            cubic_slope=number_or_nan(result["cubic_slope"]),
            cubic_r_squared=number_or_nan(result["cubic_r_squared"]),
            end=StateFit.read({**result, "state": None}),
            near_jamming=None if near is None else StateFit.read(near),
            estimators={
                name: Interval(*(number_or_nan(value[part]) for part in Interval._fields))
                for name, value in result["estimators"].items()
            },
        )
