"""The configuration of a grading: one section for each form, each with its size, unit and basis."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, ValidationInfo, field_validator

from branchcrush.config.fields import Allowed, Positive, Section, number, refusal
from branchcrush.config.units import UNITS

# Of a grain [m]. Outside of them it is the unit that is wrong.
_SMALLEST, _LARGEST = 1e-9, 1e3


def _possible(size, info):
    unit = info.data.get("unit")
    if unit and not _SMALLEST <= size * UNITS[unit] <= _LARGEST:
        raise refusal(
            f"must be from {_SMALLEST:g} m to {_LARGEST:g} m, and is {size * UNITS[unit]:.3g} m: "
            "check it and the unit",
            unit=unit,
        )
    return size


Length = number(above=0, unit_of="unit")
Size = Annotated[Length, AfterValidator(_possible)]

_FORM_TELLS = Field(description="What the form tells of: the number of grains, or their mass.")
_WEIGHTS_ARE = Field(description="What the weights are of: the number of grains, or their mass.")
_SIZES_ARE = Field(description="What sizes are: of a grain its radius or its diameter.")
Basis = Annotated[Literal["number", "mass"], _FORM_TELLS]
OfNumber = Annotated[Literal["number"], _FORM_TELLS]
OfMass = Annotated[Literal["mass"], _FORM_TELLS]
FileName = Annotated[
    str,
    Allowed("must be the name of a file"),
    Field(
        min_length=1,
        description="Name of the file, relative to the folder that the study runs in.",
        examples=["sand.csv"],
    ),
]


class _Sizes(Section):
    # Never guessed: either slip is a factor 2, or 1000, in every size.
    size: Annotated[Literal["radius", "diameter"], _SIZES_ARE]
    unit: Literal["m", "mm", "um"] = Field(description="Unit of the sizes.")


class _Range(_Sizes):
    min: Size = Field(description="Smallest size of a grain [unit].", examples=[0.063])
    max: Size = Field(description="Largest size of a grain [unit].", examples=[2.0])

    @field_validator("max")
    @classmethod
    def _ordered(cls, largest: float | None, info: ValidationInfo) -> float | None:
        return _above_min(largest, info.data)


class UniformGrading(_Range):
    """The same density at every size."""

    form: Literal["uniform"]
    basis: Basis


class LoguniformGrading(_Range):
    """Uniform in the logarithm of size."""

    form: Literal["loguniform"]
    basis: Basis


class NormalGrading(_Range):
    """The normal distribution of size, cut at min and max."""

    form: Literal["normal"]
    basis: Basis
    mean: Length = Field(description="Mean of the normal distribution [unit].", examples=[0.5])
    standard_deviation: Length = Field(
        description="Standard deviation of the normal distribution [unit].", examples=[0.15]
    )

    @field_validator("standard_deviation")
    @classmethod
    def _within(cls, width: float, info: ValidationInfo) -> float:
        unit = info.data.get("unit", "")
        _check_share("norm", info.data, "mean", lambda mean: {"loc": mean, "scale": width}, unit)
        return width


class LognormalGrading(_Range):
    """The normal distribution of the logarithm of size, cut at min and max."""

    form: Literal["lognormal"]
    basis: Basis
    median: Length = Field(description="Median of the distribution [unit].", examples=[0.1])
    geometric_standard_deviation: number(above=1, most=1000) = Field(
        description="Exponential of the standard deviation of the logarithm of size [-].",
        examples=[1.4],
    )

    @field_validator("geometric_standard_deviation")
    @classmethod
    def _within(cls, width: float, info: ValidationInfo) -> float:
        s = math.log(width)
        _check_share("lognorm", info.data, "median", lambda median: {"s": s, "scale": median})
        return width


class WeibullGrading(_Range):
    """The Weibull distribution, by mass that of Rosin and Rammler, cut at min and max."""

    form: Literal["weibull"]
    basis: Basis
    scale: Length = Field(
        description="Size that a share of 1/e, 37 %, exceeds [unit].", examples=[0.5]
    )
    shape: number(above=0, most=1000) = Field(
        description="Exponent of size over scale; the larger, the narrower [-].", examples=[2.0]
    )

    @field_validator("shape")
    @classmethod
    def _within(cls, shape: float, info: ValidationInfo) -> float:
        _check_share("weibull_min", info.data, "scale", lambda scale: {"c": shape, "scale": scale})
        return shape


class FractalGrading(_Range):
    """Number density ~ R^-(1+alpha)."""

    form: Literal["fractal"]
    basis: OfNumber
    alpha: number(above=0, most=6) = Field(description="Fractal dimension [-].", examples=[2.6])


class FullerGrading(_Range):
    """Mass finer ~ D^exponent - D_min^exponent."""

    form: Literal["fuller"]
    basis: OfMass
    exponent: number(above=0, most=6) = Field(
        description="Exponent n of the size in the mass finer [-].", examples=[0.5]
    )


class SingleGrading(_Sizes):
    """One size."""

    form: Literal["single"]
    value: Size = Field(description="Size of all grains [unit].", examples=[1.0])


class _Table(_Sizes):
    file: FileName
    min: Size | None = Field(None, description="Smallest size, if it is to be cut there [unit].")
    max: Size | None = Field(None, description="Largest size, if it is to be cut there [unit].")

    @field_validator("max")
    @classmethod
    def _ordered(cls, largest: float | None, info: ValidationInfo) -> float | None:
        return _above_min(largest, info.data)


class SieveGrading(_Table):
    """Percent finer by mass at the openings of sieves, from a file."""

    form: Literal["sieve"]
    size: Annotated[Literal["diameter"], _SIZES_ARE]
    basis: OfMass


class DensityGrading(_Table):
    """A density at some sizes, from a file."""

    form: Literal["density"]
    basis: Basis


class RadiiGrading(_Sizes):
    """The sizes of single grains, from a file."""

    form: Literal["radii"]
    basis: OfNumber
    file: FileName


_Simple = (
    UniformGrading
    | LoguniformGrading
    | NormalGrading
    | LognormalGrading
    | WeibullGrading
    | FractalGrading
    | FullerGrading
    | SingleGrading
    | SieveGrading
    | DensityGrading
    | RadiiGrading
)
SimpleGrading = Annotated[_Simple, Field(discriminator="form")]


class Component(Section):
    """One part of a mixture."""

    weight: Positive = Field(
        description="Its part, by number or by mass, over the sum of all weights [-].", examples=[1]
    )
    grading: SimpleGrading = Field(description="Sizes of its grains: any form but a mixture.")


_SEVERAL = "must be a list of 2 or more, each with a weight and a grading"


class MixtureGrading(Section):
    """Other gradings in parts by number or by mass."""

    form: Literal["mixture"]
    basis: Annotated[Literal["number", "mass"], _WEIGHTS_ARE]
    components: Annotated[list[Component], Allowed(_SEVERAL)] = Field(
        description="Two or more gradings, each with its weight.",
        json_schema_extra={"minItems": 2},
    )

    @field_validator("components", mode="before")
    @classmethod
    def _several(cls, components: Any) -> list:
        if not isinstance(components, list) or len(components) < 2:
            raise refusal(_SEVERAL)
        return components


GradingSection = Annotated[_Simple | MixtureGrading, Field(discriminator="form")]


def grading_data_files(section: Mapping[str, Any]) -> list[str]:
    """Return the names of the files that a section of the configuration reads.

    Parameters
    ----------
    section : mapping
        From `model_dump` of a `GradingSection`.

    Returns
    -------
    list of str
        As they stand there; those of a mixture in the order of its parts.

    Examples
    --------
    >>> sieve = {"form": "sieve", "file": "sand.csv"}
    >>> grading_data_files({"form": "mixture", "components": [{"weight": 1, "grading": sieve}]})
    ['sand.csv']
    """
    parts = [component["grading"] for component in section.get("components", [])]
    return [part["file"] for part in [section, *parts] if "file" in part]


def _above_min(largest, data):
    """Return the largest size, or refuse one that is not above the smallest."""
    smallest, unit = data.get("min"), data.get("unit")
    if largest is not None and smallest is not None and smallest >= largest:
        raise refusal(f"must be above min {smallest:g} {unit or ''}".rstrip(), unit=unit)
    return largest


def _check_share(distribution, data, centre, parameters, unit_of_width=""):
    """Refuse a distribution that hardly reaches between min and max, if these are known."""
    if not {"min", "max", "unit", centre} <= set(data):
        return
    # Every job reads the configuration; few of them need what SciPy takes seconds to import.
    from scipy import stats

    from branchcrush.gradings.truncation import LEAST_SHARE, share_within

    low, high, at, unit = data["min"], data["max"], data[centre], data["unit"]
    share = share_within(getattr(stats, distribution)(**parameters(at)), low, high)
    if not share >= LEAST_SHARE:
        raise refusal(
            f"with {centre} {at:g} {unit} only {share:.2g} of the distribution lies between min "
            f"{low:g} {unit} and max {high:g} {unit}; at least {LEAST_SHARE:g} must: move them or "
            "check the unit",
            unit=unit_of_width,
        )
