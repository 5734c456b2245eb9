"""Keys that say how the file of a grading is read: which columns, and what stands in them."""

from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)

from branchcrush.config.fields import Section, refusal
from branchcrush.config.schema_parts import required_unless

_COLUMNS = (
    "must be a list of two columns, the sizes' and the values', each by the words above it or by "
    "its number from 1 (or a section with opening and value)"
)
_THREE = "; a histogram may have three: lower, upper, value"
_SHEET = "must be the name of a sheet of the workbook, or its number from 1"
# A section may name its columns, in any order.
_NAMED = (("opening", "value"), ("size", "value"), ("lower", "upper", "value"))
NAME_SCHEMA = {"anyOf": [{"type": "string", "minLength": 1}, {"type": "integer", "minimum": 1}]}
_NOTHING = {"type": "null"}
_COLUMNS_SCHEMA = {
    "anyOf": [
        {"type": "array", "items": NAME_SCHEMA, "minItems": 2, "maxItems": 3},
        *(
            {
                "type": "object",
                "properties": dict.fromkeys(names, NAME_SCHEMA),
                "required": list(names),
                "additionalProperties": False,
            }
            for names in _NAMED
        ),
        _NOTHING,
    ]
}
# Phi and sieves' numbers mean millimetres; a unit is that of min and max then.
_IN_MILLIMETRES = ("phi", "astm_e11", "tyler_mesh")
_MEANS_MILLIMETRES = {
    "required": ["openings"],
    "properties": {"openings": {"enum": list(_IN_MILLIMETRES)}},
}


def _columns(columns: Any, info: ValidationInfo) -> Any:
    """Return columns as a list, which a section with names may say too."""
    if columns is None:
        return None
    three = info.data.get("form") == "histogram" or "sizes" in info.data
    if isinstance(columns, dict):
        names = next((names for names in _NAMED if set(columns) == set(names)), ())
        columns = [columns[name] for name in names]
    usable = isinstance(columns, (list, tuple)) and len(columns) in ((2, 3) if three else (2,))
    if not usable or not all(map(is_name, columns)):
        raise refusal(_COLUMNS + (_THREE if three else ""))
    return list(columns)


def _sheet(sheet: Any) -> Any:
    """Return the name or the number of a sheet."""
    if sheet is not None and not is_name(sheet):
        raise refusal(_SHEET)
    return sheet


def is_name(name: Any) -> bool:
    """Return whether a value names a column or a sheet: words, or a number from 1.

    Parameters
    ----------
    name : object

    Returns
    -------
    bool

    Examples
    --------
    >>> is_name("mm"), is_name(0), is_name(True)
    (True, False, False)
    """
    if isinstance(name, bool):
        return False
    return (isinstance(name, int) and name >= 1) or (isinstance(name, str) and name != "")


class SieveKeys(Section):
    """What openings and values of a sieve table are; where nothing is said, a default holds."""

    model_config = ConfigDict(json_schema_extra=required_unless("unit", _MEANS_MILLIMETRES))

    values: (
        Literal["percent_finer", "percent_coarser", "percent_retained", "mass_retained"] | None
    ) = Field(None, description="What values are; percent_finer where nothing is said.")
    openings: Literal["size", "phi", "astm_e11", "tyler_mesh"] | None = Field(
        None, description="What openings are; size where nothing is said."
    )

    @model_validator(mode="before")
    @classmethod
    def _unit_of_others(cls, section: Any) -> Any:
        if isinstance(section, dict) and section.get("openings") in _IN_MILLIMETRES:
            return {"unit": "mm", **section}
        return section


class DensityKeys(Section):
    """What a density is taken per."""

    per: Literal["size", "log_size", "phi"] | None = Field(
        None, description="What the density is taken per; size where nothing is said."
    )


class HistogramKeys(Section):
    """Which size of each channel stands in the file."""

    sizes: Literal["edges", "lower", "upper", "middles"] = Field(
        description="Which size of each channel stands in the file."
    )
    scale: Literal["log", "linear"] | None = Field(
        None,
        validate_default=True,
        description="Whether channels are even on a log or a linear scale; needed for middles.",
    )

    @field_validator("scale")
    @classmethod
    def _scale_of_middles(cls, scale: str | None, info: ValidationInfo) -> str | None:
        if scale is None and info.data.get("sizes") == "middles":
            raise refusal(
                "must be 'log' or 'linear': where channels meet does not follow from their middles "
                "alone"
            )
        return scale


SheetName = Annotated[
    str | int | None,
    BeforeValidator(_sheet),
    WithJsonSchema({"anyOf": [*NAME_SCHEMA["anyOf"], _NOTHING]}),
]


class FileKeys(Section):
    """Which columns of which sheet are meant, where a file has more than two."""

    columns: Annotated[
        list[str | int] | None, BeforeValidator(_columns), WithJsonSchema(_COLUMNS_SCHEMA)
    ] = Field(
        None,
        description="Columns of the sizes and of the values, each by the words above it or by its "
        "number from 1; a histogram may have three: lower, upper, value.",
    )
    sheet: SheetName = Field(
        None, description="Sheet of a workbook, by its name or its number from 1."
    )
