"""The configuration of a grading: one section for each form, each with its size, unit and basis."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationInfo, field_validator

from branchcrush.config.curves import check_curve, check_share
from branchcrush.config.fields import Allowed, Section, number, refusal
from branchcrush.config.grading_keys import (
    SIZES_ARE,
    WEIGHTS_ARE,
    Basis,
    BasisOfFile,
    FileName,
    Length,
    OfMass,
    OfNumber,
    Size,
)
from branchcrush.config.table_keys import DensityKeys, FileKeys, HistogramKeys, SieveKeys


class _Sizes(Section):
    # Never guessed: either slip is a factor 2, or 1000, in every size.
    size: Annotated[Literal["radius", "diameter"], SIZES_ARE]
    unit: Literal["m", "cm", "mm", "um", "inch"] = Field(description="Unit of the sizes.")


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
        check_share("norm", info.data, "mean", lambda mean: {"loc": mean, "scale": width}, unit)
        return width


class _SizesOfCurve(_Sizes):
    min: Size | None = Field(None, description="Smallest size of a grain [unit].")
    max: Size | None = Field(None, description="Largest size of a grain [unit].")
    # D10, D50 and D90, as radii where sizes are radii.
    d10: Length | None = Field(None, description="Size that 10 % are finer than [unit].")
    d50: Length | None = Field(None, description="Size that 50 % are finer than [unit].")
    d90: Length | None = Field(None, description="Size that 90 % are finer than [unit].")

    @field_validator("max")
    @classmethod
    def _ordered(cls, largest: float | None, info: ValidationInfo) -> float | None:
        return _above_min(largest, info.data)

    @field_validator("d50", "d90")
    @classmethod
    def _growing(cls, size: float | None, info: ValidationInfo) -> float | None:
        unit = info.data.get("unit")
        for below in ("d10", "d50"):
            finer = info.data.get(below)
            if size is not None and finer is not None and not size > finer:
                raise refusal(f"must be above {below} {finer:g} {unit or ''}".rstrip(), unit=unit)
        return size


class LognormalGrading(_SizesOfCurve):
    """The normal distribution of the logarithm of size, cut at min and max."""

    form: Literal["lognormal"]
    basis: Basis
    median: Length | None = Field(None, description="Median of the distribution [unit].")
    # The last key is checked when all others are known, also where it is left out.
    geometric_standard_deviation: number(above=1, most=1000) | None = Field(
        None,
        validate_default=True,
        description="Exponential of the standard deviation of the logarithm of size [-].",
    )

    @field_validator("geometric_standard_deviation")
    @classmethod
    def _complete(cls, width: float | None, info: ValidationInfo) -> float | None:
        check_curve("lognormal", {**info.data, "geometric_standard_deviation": width})
        return width


class WeibullGrading(_SizesOfCurve):
    """The Weibull distribution, by mass that of Rosin and Rammler, cut at min and max."""

    form: Literal["weibull"]
    basis: Basis
    scale: Length | None = Field(
        None, description="Size that a share of 1/e, 37 %, exceeds [unit]."
    )
    shape: number(above=0, most=1000) | None = Field(
        None,
        validate_default=True,
        description="Exponent of size over scale; the larger, the narrower [-].",
    )

    @field_validator("shape")
    @classmethod
    def _complete(cls, shape: float | None, info: ValidationInfo) -> float | None:
        check_curve("weibull", {**info.data, "shape": shape})
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


class SieveGrading(FileKeys, SieveKeys, _Table):
    """What sieves let pass or retain, by mass, from a file."""

    form: Literal["sieve"]
    size: Annotated[Literal["diameter"], SIZES_ARE]
    basis: OfMass


class DensityGrading(FileKeys, DensityKeys, _Table):
    """A density at some sizes, from a file."""

    form: Literal["density"]
    basis: BasisOfFile


class HistogramGrading(FileKeys, HistogramKeys, _Table):
    """Percent, counts or masses in channels of size, from a file."""

    form: Literal["histogram"]
    basis: BasisOfFile


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
    | HistogramGrading
    | RadiiGrading
)
SimpleGrading = Annotated[_Simple, Field(discriminator="form")]


class Component(Section):
    """One part of a mixture."""

    weight: number(least=1e-15, most=1e15) = Field(
        description="Its part, by number or by mass, over the sum of all weights [-].", examples=[1]
    )
    grading: SimpleGrading = Field(description="Sizes of its grains: any form but a mixture.")


_SEVERAL = "must be a list of 2 or more, each with a weight and a grading"


class MixtureGrading(Section):
    """Other gradings in parts by number or by mass."""

    form: Literal["mixture"]
    basis: Annotated[Literal["number", "mass"], WEIGHTS_ARE]
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
