"""The configuration of a compression: the law of its contacts, and where it goes."""

from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    ConfigDict,
    Field,
    StrictBool,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
)

from branchcrush.config.fields import Fraction, Section, number, refusal
from branchcrush.config.schema_parts import given
from branchcrush.config.stresses import STRESSES, increasing_stresses
from branchcrush.loading.targets import STRAIN_TARGETS

# Beyond this the overlaps are as large as the grains, whatever the stiffness.
DENSEST = 1.2
_TARGETS = (*STRAIN_TARGETS, "mean_stress")


_ONE_TARGET = [given(target) for target in _TARGETS]
_STATES_AT_STRESSES = given("mean_stress", "states")


class LinearContact(Section):
    """Frictionless linear normal contact of one stiffness."""

    law: Literal["linear"]
    normal_stiffness: number(least=1e-9, most=1e15, unit="N/m") = Field(
        1.0e6, description="Normal stiffness of a contact, k_n [N/m]."
    )


class HertzContact(Section):
    """Frictionless Hertz contact of grains of one material."""

    law: Literal["hertz"]
    young_modulus: number(least=1e-3, most=1e15, unit="Pa") = Field(
        description="Young's modulus of the grains [Pa].", examples=[70.0e9]
    )
    poisson_ratio: number(least=0, most=0.5) = Field(
        description="Poisson's ratio of the grains [-].", examples=[0.17]
    )


Contact = Annotated[LinearContact | HertzContact, Field(discriminator="law")]


class Loading(Section):
    """Isotropic compression in strain steps, each relaxed, to one target."""

    model_config = ConfigDict(json_schema_extra={"oneOf": _ONE_TARGET, "not": _STATES_AT_STRESSES})

    edge_reduction: Fraction | None = Field(
        None, description="Target: share that each edge loses, ε; φ = φ₀/(1 − ε)³ [-]."
    )
    volume_reduction: Fraction | None = Field(
        None, description="Target: share that the volume loses, ε_v; φ = φ₀/(1 − ε_v) [-]."
    )
    solid_fraction: number(above=0, most=DENSEST) | None = Field(
        None, description="Target: solid fraction at the end, φ [-]."
    )
    mean_stress: (
        Annotated[list[float], BeforeValidator(increasing_stresses), WithJsonSchema(STRESSES)]
        | None
    ) = Field(
        None, description="Target: a mean stress, an increasing list, or a range of them [Pa]."
    )
    states: number(int, least=1, most=1000) | None = Field(
        None,
        description="States saved on the way to a strain target, 15 if left out; with mean_stress "
        "there is one at each stress.",
    )
    approach_solid_fraction: Fraction = Field(
        0.55, description="Where strain steps begin, before grains begin to carry load [-]."
    )
    quality: Literal["draft", "standard", "fine"] = Field(
        "standard", description="How small the strain steps are, from the largest."
    )
    # The last key is checked when all others are known, also where some are wrong.
    unloading: StrictBool = Field(
        False, validate_default=True, description="Go back through the same states."
    )

    @field_validator("states")
    @classmethod
    def _of_strains(cls, states: int | None, info: ValidationInfo) -> int | None:
        if states is not None and info.data.get("mean_stress") is not None:
            raise refusal(
                "belongs to a strain target; with mean_stress a state is saved at each stress: "
                "list them, or give mean_stress as {from: 1e5, to: 1e7, states: 9}"
            )
        return states

    @field_validator("unloading")
    @classmethod
    def _one_target(cls, unloading: bool, info: ValidationInfo) -> bool:
        # A target that is wrong is not in the data, and was given all the same.
        given = [name for name in _TARGETS if info.data.get(name, "wrong") is not None]
        if len(given) != 1:
            which = f"{' and '.join(given)} are given" if given else "none is given"
            raise refusal(
                f"must have exactly one target of {', '.join(_TARGETS)}; {which}", of_section=True
            )
        return unloading

    @property
    def target(self) -> tuple[str, float | list[float]]:
        """Name and value of the target: a share [-], or increasing stresses [Pa]."""
        given = ((name, getattr(self, name)) for name in _TARGETS)
        return next((name, value) for name, value in given if value is not None)

    def plain(self) -> dict[str, Any]:
        """Return the section as `loading.targets.Loading` takes it, plain values by name.

        Examples
        --------
        >>> Loading(solid_fraction=0.7).plain()["value"]
        0.7
        """
        name, value = self.target
        return {
            "target": name,
            "value": value,
            "states": self.states or 15,
            "approach_solid_fraction": self.approach_solid_fraction,
            "unloading": self.unloading,
        }
