"""The configuration of the crushing model: its forms, who carries load, and what resists."""

from typing import Literal

from pydantic import Field, ValidationInfo, field_validator

from branchcrush.config.fields import Section, number, refusal
from branchcrush.config.history import History
from branchcrush.crushing.resistance import LARGEST
from branchcrush.gradings.rods import GAP, PUBLISHED_GAP

# Keys that are for one choice of another key, and what they are for.
_FOR = {
    "pressure_exponent": ("elasticity", "pressure_dependent"),
    "critical_energy": ("resistance", "critical_energy"),
    "hardening_exponent": ("resistance", "critical_energy"),
    "elastic_strain": ("resistance", "elastic_strain"),
    "strength_exponent": ("resistance", "elastic_strain"),
}


class Thermodynamics(Section):
    """The crushing model; all of its forms are computed."""

    ultimate_alpha: number(above=0, below=3) = Field(
        2.6, description="Fractal dimension of the ultimate grading, on the sample's sizes [-]."
    )
    form: Literal[
        "moving_jamming", "paper", "density", "measured_contacts", "einav", "tengattini"
    ] = Field(
        "moving_jamming",
        description="Form of the model that stands on the front; the others stand beside it.",
    )
    network: Literal["rods", "parking"] = Field(
        "rods",
        description="Who carries load in the gradings that crushing leads through: rods that push, "
        "or random parking.",
    )
    rod_gap: number(above=0, most=10) = Field(
        GAP,
        description="Gaps beside a rod over its length, f, where the rod map jams; "
        f"{PUBLISHED_GAP:g} was published [-].",
    )
    elasticity: Literal["power_law", "linear", "hertz", "pressure_dependent", "measured"] = Field(
        "power_law",
        description="Elastic law before crushing, from the energies of the packings: a power of "
        "the strain, its exponent fitted or that of linear or Hertz's contacts; a modulus that "
        "grows with pressure; or through every state.",
    )
    pressure_exponent: number(least=0, most=0.99) = Field(
        0.5,
        description="Exponent q of the modulus K = K_r (p/p_r)^q, with elasticity: "
        "pressure_dependent; K_r is fitted [-].",
    )
    reference_pressure: number(above=0, most=1e15, unit="Pa") = Field(
        1.0e5, description="Pressure p_r at which the modulus of the elastic law is told [Pa]."
    )
    # As none is given: a section without a history is refused.
    history: History = Field(
        History.model_construct(),
        description="A history of strain or stress of your own, beside the loading and unloading.",
    )
    resistance: Literal["critical_energy", "elastic_strain"] = Field(
        "critical_energy",
        description="What must be reached for crushing to go on: a critical energy, or an elastic "
        "strain.",
    )
    critical_energy: number(above=0, most=1e15, unit="J/m3") = Field(
        2.0e5, description="Energy per volume at which crushing begins, E_c0 [J/m3]."
    )
    hardening_exponent: number(above=0, most=100) = Field(
        2.0, description="Exponent s of the resistance to crushing, E_c0/(1 − C)^s [-]."
    )
    elastic_strain: number(above=0, below=LARGEST) = Field(
        0.0125,
        description="Elastic strain at which crushing begins, ε_0, with resistance: elastic_strain "
        "[-].",
    )
    strength_exponent: number(least=0, most=10) = Field(
        1.0,
        description="Exponent b with which the strength of a grain falls with its size; the "
        "elastic strain of crushing goes as d^(1 − b) with a constant stiffness, as d^(−2b/3) with "
        "Hertz's contacts [-].",
    )

    # Defaults are not validated, so that only what is given is refused.
    @field_validator(*_FOR)
    @classmethod
    def _has_effect(cls, value: float, info: ValidationInfo) -> float:
        key, needed = _FOR[str(info.field_name)]
        chosen = info.data.get(key, needed)  # one that is wrong is refused as such
        if chosen != needed:
            raise refusal(
                f"has no effect with {key}: {chosen}: leave it out, or say {key}: {needed}"
            )
        return value
