"""The configuration of a history of loads: a list of strains or stresses, or a file of them."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, WithJsonSchema, model_validator

from branchcrush.config.fields import Section, number_of, refusal
from branchcrush.crushing.resistance import LARGEST
from branchcrush.files.histories import MOST_LOADS, UNITS, load_problem, read_history

_WAYS = (
    "must have one of strain, a list of total strains from jamming [-]; stress, a list of mean "
    "stresses [Pa]; or file with column and unit"
)


def _loads(quantity: str) -> Any:
    """Return the type of a list of loads of one quantity."""
    unit = {"strain": "-", "stress": "Pa"}[quantity]

    def read(value: Any) -> list[float] | None:
        if value is None:
            return None
        allowed = f"must be a list of 1 to {MOST_LOADS} numbers [{unit}], in the order of time"
        if not isinstance(value, list) or not 1 <= len(value) <= MOST_LOADS:
            raise refusal(allowed)
        loads = []
        for place, item in enumerate(value, start=1):
            load = number_of(item)
            if load is None:
                raise refusal(f"{allowed}; number {place} is none")
            if problem := load_problem(float(load), quantity):
                problem = problem.replace("say unit: percent", "divide by 100")
                raise refusal(f"number {place} is {load:g}, {problem}")
            loads.append(float(load))
        return loads

    limits = {"minimum": 0, **({"exclusiveMaximum": LARGEST} if quantity == "strain" else {})}
    schema = {
        "anyOf": [
            {
                "type": "array",
                "items": {"anyOf": [{"type": "number", **limits}, {"type": "string"}]},
                "minItems": 1,
                "maxItems": MOST_LOADS,
            },
            {"type": "null"},
        ]
    }
    return Annotated[list[float] | None, BeforeValidator(read), WithJsonSchema(schema)]


class History(Section):
    """A history of loads of the user's own, walked from jamming before crushing on."""

    strain: _loads("strain") = Field(
        None, description="Total volumetric strains from jamming before crushing, in turn [-]."
    )
    stress: _loads("stress") = Field(None, description="Mean stresses, in turn [Pa].")
    file: str | None = Field(
        None, description="Table of the loads instead, text or workbook, one on each line."
    )
    column: Literal["strain", "stress"] | None = Field(
        None,
        description="What the loads of the file are; the header names it where there are more.",
    )
    unit: Literal["-", "percent", "Pa", "kPa", "MPa"] | None = Field(
        None, description="Unit of the loads of the file."
    )

    @model_validator(mode="after")
    def _one_way(self) -> "History":
        given = [key for key in ("strain", "stress", "file") if getattr(self, key) is not None]
        of_file = self.column is not None or self.unit is not None
        if len(given) != 1:
            which = (
                f"{' and '.join(given)} are given"
                if given
                else "none is given: give one, or leave history out"
            )
            raise refusal(f"{_WAYS}; {which}")
        if self.file is None:
            if of_file:
                raise refusal(
                    f"column and unit are for a file: leave them out, a {given[0]} here is in "
                    f"[{'-' if given == ['strain'] else 'Pa'}]"
                )
            return self
        if self.column is None or self.unit not in UNITS[self.column]:
            units = "; ".join(f"{name}: {', '.join(UNITS[name])}" for name in UNITS)
            raise refusal(f"a file must have column, strain or stress, and a unit of it ({units})")
        return self


def history_loads(section: Mapping[str, Any]) -> tuple[str, NDArray] | None:
    """Return what loads are and the loads themselves, of a section as plain values.

    Parameters
    ----------
    section : mapping
        Of a checked configuration; None at keys that are left out.

    Returns
    -------
    tuple of str and ndarray, or None
        "strain" [-] or "stress" [Pa], and the loads; None where there is no history.

    Raises
    ------
    GradingError
        When a file cannot be read.

    Examples
    --------
    >>> quantity, loads = history_loads({"stress": [1e6, 0.0]})
    >>> quantity, loads.tolist()
    ('stress', [1000000.0, 0.0])
    """
    if section.get("file") is not None:
        quantity = section["column"]
        return quantity, read_history(section["file"], quantity, section["unit"])
    for quantity in UNITS:
        if section.get(quantity) is not None:
            return quantity, np.array(section[quantity], float)
    return None
