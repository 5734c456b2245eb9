"""Keys that several forms of a grading have, with what each means."""

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from branchcrush.config.fields import Allowed, number, refusal
from branchcrush.config.units import UNITS
from branchcrush.packings.sizes import LARGEST, SMALLEST

# Parameters of a distribution may lie far beyond the sizes that it is cut at.
_BEYOND = 1e6


def _between(smallest, largest):
    """Return what refuses lengths outside two [m]."""

    def possible(length, info):
        unit = info.data.get("unit")
        if unit and not smallest <= length * UNITS[unit] <= largest:
            raise refusal(
                f"must be from {smallest:g} m to {largest:g} m, and is {length * UNITS[unit]:.3g} "
                "m: check it and the unit",
                unit=unit,
            )
        return length

    return AfterValidator(possible)


_LENGTH = number(above=0, unit_of="unit")
Length = Annotated[_LENGTH, _between(SMALLEST / _BEYOND, LARGEST * _BEYOND)]
Size = Annotated[_LENGTH, _between(SMALLEST, LARGEST)]
_FORM_TELLS = Field(description="What the form tells of: the number of grains, or their mass.")
WEIGHTS_ARE = Field(description="What the weights are of: the number of grains, or their mass.")
SIZES_ARE = Field(description="What sizes are: of a grain its radius or its diameter.")
Basis = Annotated[Literal["number", "mass"], _FORM_TELLS]
BasisOfFile = Annotated[Literal["number", "mass", "volume"], _FORM_TELLS]
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
