"""The configuration of a grading: one section for each form, each with its size, unit and basis."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    Field,
    ValidationInfo,
    field_validator,
)

from branchcrush.config.curves import check_curve, check_share
from branchcrush.config.fields import Positive, Section, number, refusal
from branchcrush.config.table_keys import DensityKeys, FileKeys, HistogramKeys, SieveKeys
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


class _Sizes(Section):
    # Never guessed: either slip is a factor 2, or 1000, in every size.
    size: Literal["radius", "diameter"]
    unit: Literal["m", "cm", "mm", "um", "inch"]


class _Range(_Sizes):
    min: Size
    max: Size

    @field_validator("max")
    @classmethod
    def _ordered(cls, largest: float | None, info: ValidationInfo) -> float | None:
        return _above_min(largest, info.data)


class UniformGrading(_Range):
    """The same density at every size."""

    form: Literal["uniform"]
    basis: Literal["number", "mass"]


class LoguniformGrading(_Range):
    """Uniform in the logarithm of size."""

    form: Literal["loguniform"]
    basis: Literal["number", "mass"]


class NormalGrading(_Range):
    """The normal distribution of size, cut at min and max."""

    form: Literal["normal"]
    basis: Literal["number", "mass"]
    mean: Length
    standard_deviation: Length

    @field_validator("standard_deviation")
    @classmethod
    def _within(cls, width: float, info: ValidationInfo) -> float:
        unit = info.data.get("unit", "")
        check_share("norm", info.data, "mean", lambda mean: {"loc": mean, "scale": width}, unit)
        return width


class _SizesOfCurve(_Sizes):
    min: Size | None = None
    max: Size | None = None
    # D10, D50 and D90, as radii where sizes are radii.
    d10: Length | None = None
    d50: Length | None = None
    d90: Length | None = None

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
    basis: Literal["number", "mass"]
    median: Length | None = None
    # The last key is checked when all others are known, also where it is left out.
    geometric_standard_deviation: Annotated[
        number(above=1, most=1000) | None, Field(validate_default=True)
    ] = None

    @field_validator("geometric_standard_deviation")
    @classmethod
    def _complete(cls, width: float | None, info: ValidationInfo) -> float | None:
        check_curve("lognormal", {**info.data, "geometric_standard_deviation": width})
        return width


class WeibullGrading(_SizesOfCurve):
    """The Weibull distribution, by mass that of Rosin and Rammler, cut at min and max."""

    form: Literal["weibull"]
    basis: Literal["number", "mass"]
    scale: Length | None = None
    shape: Annotated[number(above=0, most=1000) | None, Field(validate_default=True)] = None

    @field_validator("shape")
    @classmethod
    def _complete(cls, shape: float | None, info: ValidationInfo) -> float | None:
        check_curve("weibull", {**info.data, "shape": shape})
        return shape


class FractalGrading(_Range):
    """Number density ~ R^-(1+alpha)."""

    form: Literal["fractal"]
    basis: Literal["number"]
    alpha: number(above=0, most=6)


class FullerGrading(_Range):
    """Mass finer ~ D^exponent - D_min^exponent."""

    form: Literal["fuller"]
    basis: Literal["mass"]
    exponent: number(above=0, most=6)


class SingleGrading(_Sizes):
    """One size."""

    form: Literal["single"]
    value: Size


class _Table(_Sizes):
    file: Annotated[str, Field(min_length=1, description="must be the name of a file")]
    min: Size | None = None
    max: Size | None = None

    @field_validator("max")
    @classmethod
    def _ordered(cls, largest: float | None, info: ValidationInfo) -> float | None:
        return _above_min(largest, info.data)


class SieveGrading(FileKeys, SieveKeys, _Table):
    """What sieves let pass or retain, by mass, from a file."""

    form: Literal["sieve"]
    size: Literal["diameter"]
    basis: Literal["mass"]


class DensityGrading(FileKeys, DensityKeys, _Table):
    """A density at some sizes, from a file."""

    form: Literal["density"]
    basis: Literal["number", "mass", "volume"]


class HistogramGrading(FileKeys, HistogramKeys, _Table):
    """Percent, counts or masses in channels of size, from a file."""

    form: Literal["histogram"]
    basis: Literal["number", "mass", "volume"]


class RadiiGrading(_Sizes):
    """The sizes of single grains, from a file."""

    form: Literal["radii"]
    basis: Literal["number"]
    file: Annotated[str, Field(min_length=1, description="must be the name of a file")]


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

    weight: Positive
    grading: SimpleGrading


_SEVERAL = "must be a list of 2 or more, each with a weight and a grading"


class MixtureGrading(Section):
    """Other gradings in parts by number or by mass."""

    form: Literal["mixture"]
    basis: Literal["number", "mass"]
    components: list[Component] = Field(description=_SEVERAL)

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
