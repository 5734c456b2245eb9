"""The configuration of grains that break: their strength, and how they are replaced."""

from typing import Any, Literal

from pydantic import Field

from branchcrush.breakage.fragments import FEWEST_FRAGMENTS, MOST_FRAGMENTS
from branchcrush.config.fields import Section, number
from branchcrush.config.grading_keys import Size
from branchcrush.config.units import UNITS

# In one packing.
MOST_GRAINS = 10_000_000


class Breakage(Section):
    """Grains that break where the load on them exceeds their strength."""

    strength: number(above=0, most=1e15, unit="Pa") = Field(
        description="Strength s₀ that 37 % of the grains of the reference diameter survive, as the "
        "force between two plates over the square of the diameter [Pa].",
        examples=[2.0e7],
    )
    weibull_modulus: number(least=0.5, most=100) = Field(
        description="Weibull modulus m of the strengths of grains of one size [-].", examples=[3.0]
    )
    unit: Literal["m", "cm", "mm", "um", "inch"] = Field(
        description="Unit of the two diameters below."
    )
    reference_diameter: Size = Field(
        description="Diameter d₀ of the grains whose strength is given [unit].", examples=[1.0]
    )
    smallest_diameter: Size = Field(
        description="Comminution limit: grains no larger than this never break. It decides how "
        "many grains there will be, and belongs to the result [unit].",
        examples=[0.25],
    )
    size_exponent: number(least=0, most=10) | None = Field(
        None,
        description="Exponent b with which strength falls with size, s = s₀ (d/d₀)^(−b); 3 over "
        "the Weibull modulus if left out [-].",
    )
    criterion: Literal["largest_force", "octahedral_stress"] = Field(
        "largest_force",
        description="What is held against the strength: the largest force on a grain over d², or "
        "the octahedral shear stress in it, in the same measure.",
    )
    fragments: number(int, least=FEWEST_FRAGMENTS, most=MOST_FRAGMENTS) = Field(
        14, description="Spheres that a grain breaks into."
    )
    growth_stages: number(int, least=0, most=1000) = Field(
        5,
        description="Stages in which touching fragments grow until no mass is lost; 0 for all of "
        "it at once.",
    )
    per_round: Literal["all", "one"] = Field(
        "all",
        description="Which overloaded grains break before the packing comes to rest again: all of "
        "them, or the most overloaded one.",
    )
    stepping: Literal["strain_step", "events"] = Field(
        "strain_step",
        description="Whether a strain step that overloads grains is kept as it is, or taken back "
        "to the strain at which the first of them breaks.",
    )
    largest_grains: number(int, least=2, most=MOST_GRAINS) = Field(
        20_000, description="Where there would be more grains the run ends, validly."
    )
    largest_mean_stress: number(above=0, most=1e15, unit="Pa") | None = Field(
        None, description="Mean stress at which the run ends, validly [Pa]."
    )

    def plain(self) -> dict[str, Any]:
        """Return the section as `config.sample.breakage_of` takes it: plain values, SI units.

        Examples
        --------
        >>> sand = Breakage(strength=2e7, weibull_modulus=3, unit="mm", reference_diameter=1,
        ...                 smallest_diameter=0.25)
        >>> sand.plain()["size_exponent"], sand.plain()["smallest_diameter"]
        (1.0, 0.00025)
        """
        values = self.model_dump()
        metres = UNITS[values.pop("unit")]
        exponent = values["size_exponent"]
        return {
            **values,
            "reference_diameter": values["reference_diameter"] * metres,
            "smallest_diameter": values["smallest_diameter"] * metres,
            "size_exponent": 3.0 / self.weibull_modulus if exponent is None else exponent,
        }
