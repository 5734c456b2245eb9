"""What is fitted to all branches of one state at once: its part of `energy_split.json`."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from branchcrush.energy.local_exponents import LocalExponent
from branchcrush.statistics.intervals import Interval

_NAN = float("nan")
UNKNOWN = Interval(_NAN, _NAN, _NAN)
# The quantities of a curvature, in the order of the file.
_BENDS = ("curvature", "slope_at_10_percent", "slope_at_mean", "slope_at_90_percent")


def number_or_nan(value: float | None) -> float:
    """Return a number of a file; nan where the file has null.

    Parameters
    ----------
    value : float or None

    Returns
    -------
    float

    Examples
    --------
    >>> number_or_nan(None), number_or_nan(3)
    (nan, 3.0)
    """
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
        """Return a predictor that has no fit, and why.

        Parameters
        ----------
        name, formula, reason : str

        Returns
        -------
        FittedPredictor
        """
        return cls(name, formula, {}, UNKNOWN, None, reason=reason)

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
        """Return the predictor of which a file holds this.

        Parameters
        ----------
        result : mapping
            As `result` returns it, null where it has nan.

        Returns
        -------
        FittedPredictor
        """
        if "reason" in result:
            return cls.without(result["name"], result["formula"], result["reason"])
        known = "difference_to_branch_length" in result
        return cls(
            result["name"],
            result["formula"],
            {
                key: Interval(*(number_or_nan(value[part]) for part in Interval._fields))
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
        """Return that there is no curvature, and why.

        Parameters
        ----------
        reason : str

        Returns
        -------
        Curvature

        Examples
        --------
        >>> Curvature.without("two lengths").result()
        {'reason': 'two lengths'}
        """
        return cls(UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN, reason)

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
        """Return the curvature of which a file holds this.

        Parameters
        ----------
        result : mapping
            As `result` returns it, null where it has nan.

        Returns
        -------
        Curvature
        """
        if "reason" in result:
            return cls.without(result["reason"])
        curvature, short, mean, long = (Interval.read(result, name) for name in _BENDS)
        return cls(curvature, short, mean, long)


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
    local_exponents : tuple of LocalExponent
        From short to long branches; empty where lengths are too few.
    """

    predictors: tuple[FittedPredictor, ...]
    curvature: Curvature
    state: int | None = None
    solid_fraction: float | None = None
    local_exponents: tuple[LocalExponent, ...] = ()

    def predictor(self, name: str) -> FittedPredictor | None:
        """Return the predictor of this name, None where there is no fit of it.

        Parameters
        ----------
        name : str

        Returns
        -------
        FittedPredictor or None
        """
        known = (one for one in self.predictors if one.name == name and one.reason is None)
        return next(known, None)

    def result(self) -> dict[str, Any]:
        """Return what `energy_split.json` holds of it."""
        place = {"state": self.state, "solid_fraction": self.solid_fraction}
        parts = [part.result() for part in self.local_exponents]
        return {
            **(place if self.state is not None else {}),
            "predictors": [predictor.result() for predictor in self.predictors],
            "curvature": self.curvature.result(),
            **({"local_exponents": parts} if parts else {}),
        }

    @classmethod
    def read(cls, result: Mapping[str, Any]) -> "StateFit":
        """Return the state of which a file holds this.

        Parameters
        ----------
        result : mapping
            As `result` returns it, null where it has nan.

        Returns
        -------
        StateFit
        """
        state = result.get("state")
        return cls(
            tuple(FittedPredictor.read(entry) for entry in result["predictors"]),
            Curvature.read(result["curvature"]),
            state,
            None if state is None else number_or_nan(result["solid_fraction"]),
            tuple(LocalExponent.read(one) for one in result.get("local_exponents", ())),
        )
