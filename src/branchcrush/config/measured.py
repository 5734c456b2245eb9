"""The configuration of what a laboratory measured: gradings around a test, and its compression."""

from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
)

from branchcrush.config.compression import Contact
from branchcrush.config.fields import Allowed, Fraction, Section, number, refusal
from branchcrush.config.grading_keys import SIZES_ARE, FileName
from branchcrush.config.gradings import GradingSection
from branchcrush.config.table_keys import NAME_SCHEMA, SheetName, is_name
from branchcrush.config.units import UNITS

# [Pa]
STRESS_UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6}
_COLUMNS = (
    "must be a list of two columns, the stresses' and the values', each by the words above it or "
    "by its number from 1"
)
_COLUMNS_SCHEMA = {
    "anyOf": [
        {"type": "array", "items": NAME_SCHEMA, "minItems": 2, "maxItems": 2},
        {"type": "null"},
    ]
}
_SMALLEST = (
    "must be a section with size, unit and value: the smallest size that crushing leads to, which "
    "decides B; 0 is allowed"
)


def _columns(columns: Any) -> Any:
    if columns is None:
        return None
    if (
        not isinstance(columns, (list, tuple))
        or len(columns) != 2
        or not all(map(is_name, columns))
    ):
        raise refusal(_COLUMNS)
    return list(columns)


class UltimateSmallest(Section):
    """The smallest size of the grading that crushing ends in; it decides Einav's breakage."""

    size: Annotated[Literal["diameter", "radius"], SIZES_ARE]
    unit: Literal["m", "cm", "mm", "um", "inch"] = Field(description="Unit of the size.")
    value: number(least=0, most=1e6) = Field(
        description="The size, below which nothing breaks; 0 is allowed [unit].", examples=[0.02]
    )

    @property
    def radius(self) -> float:
        """The size as a radius [m].

        Examples
        --------
        >>> UltimateSmallest(size="diameter", unit="mm", value=0.02).radius
        1e-05
        """
        return self.value * UNITS[self.unit] * (0.5 if self.size == "diameter" else 1.0)


class CompressionTest(Section):
    """A compression curve, to which the resistance to crushing is fitted."""

    model_config = ConfigDict(
        json_schema_extra={
            "if": {"properties": {"values": {"const": "void_ratio"}}},
            "then": {"required": ["initial_void_ratio"]},
        }
    )

    file: FileName
    stress_unit: Literal["Pa", "kPa", "MPa"] = Field(description="Unit of the stresses.")
    values: Literal["void_ratio", "strain", "percent_strain"] = Field(
        description="What stands beside each stress: the void ratio, or the volumetric strain from "
        "the beginning of the test, as a share or in percent; compression is positive."
    )
    columns: Annotated[
        list[str | int] | None, BeforeValidator(_columns), WithJsonSchema(_COLUMNS_SCHEMA)
    ] = Field(
        None,
        description="Columns of the stresses and of the values, each by the words above it or by "
        "its number from 1.",
    )
    sheet: SheetName = Field(
        None, description="Sheet of a workbook, by its name or its number from 1."
    )
    lateral_stress_ratio: number(
        above=0, most=1, hint=": 1 of an isotropic test, about 0.4 to 0.5 of an oedometer"
    ) = Field(
        description="Lateral over axial stress, K₀; the mean stress is (1 + 2 K₀)/3 of the axial "
        "one. 1 where stresses are mean stresses [-].",
        examples=[0.45],
    )
    contact: Contact = Field(
        description="Law and stiffness of the grains' contacts; the fit rests on them, so that no "
        "default is taken."
    )
    share_of_affine: Fraction = Field(
        0.8,
        description="Elastic energy over that of affine motion on the network at jamming; 0.8 was "
        "measured of linear contacts. The stress at a given elastic strain is in proportion [-].",
    )
    # The last key is checked when all others are known, also where it is left out.
    initial_void_ratio: number(above=0, most=20) | None = Field(
        None,
        validate_default=True,
        description="Void ratio at the beginning of the test; needed where values are void "
        "ratios [-].",
    )

    @field_validator("contact")
    @classmethod
    def _stated(cls, contact: Contact) -> Contact:
        for key in type(contact).model_fields:
            if key not in contact.model_fields_set:
                raise refusal(
                    "give that of the grains' contacts: the fit rests on it, so that it has no "
                    "default here",
                    key=key,
                    value=None,
                    missing=True,
                )
        return contact

    @field_validator("initial_void_ratio")
    @classmethod
    def _of_void_ratios(cls, ratio: float | None, info: ValidationInfo) -> float | None:
        if ratio is None and info.data.get("values") == "void_ratio":
            raise refusal(
                "must be the void ratio at the beginning of the test, from which strain counts, "
                "where values are void ratios",
                missing=True,
            )
        return ratio


class Measured(Section):
    """What a laboratory measured of one material: sieve curves, and a compression curve."""

    before: GradingSection = Field(description="Grading before the test.")
    after: GradingSection | None = Field(
        None,
        description="Grading after the test; may be left out where only a compression is fitted.",
    )
    ultimate_alpha: number(above=0, below=3) = Field(
        2.6, description="Fractal dimension of the ultimate grading [-]."
    )
    compression: CompressionTest | None = Field(
        None, description="A compression curve, to which the resistance is fitted."
    )
    # The last key is checked when all others are known.
    ultimate_smallest: Annotated[UltimateSmallest, Allowed(_SMALLEST)] = Field(
        description="Smallest size of the ultimate grading, whose largest is that of the one "
        "before. It decides B."
    )

    @field_validator("ultimate_smallest")
    @classmethod
    def _complete(cls, smallest: UltimateSmallest, info: ValidationInfo) -> UltimateSmallest:
        # One that is wrong is not in the data, and was given all the same.
        after, compression = (info.data.get(key, "wrong") for key in ("after", "compression"))
        if after is None and compression is None:
            raise refusal(
                "must have after, the grading after the test, or compression, or both; neither is "
                "given",
                of_section=True,
            )
        if compression is not None and not smallest.value > 0:
            raise refusal(
                "must be above 0 where a compression is fitted: the gradings that crushing takes "
                "on its way end in one with a smallest grain",
                key="value",
                value=smallest.value,
                unit=smallest.unit,
            )
        return smallest

    def settings(self) -> dict[str, Any]:
        """Return the section as plain values.

        Returns
        -------
        dict
            Of before, after and compression what is given; `ultimate_smallest` is a radius [m].
        """
        values = self.model_dump(exclude_none=True)
        return values | {"ultimate_smallest": self.ultimate_smallest.radius}
