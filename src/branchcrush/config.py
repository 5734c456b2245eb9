"""The configuration: its keys, types, units, defaults and checks."""

from typing import Annotated, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
    field_validator,
    model_validator,
)

from branchcrush.config_messages import problem
from branchcrush.errors import ConfigError

# Ends the name of a sample run with twice the steps, to judge its convergence.
REFINED = "-refined"

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Fraction = Annotated[float, Field(gt=0, lt=1)]


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class UniformGrading(_Section):
    """Radius uniform by number."""

    form: Literal["uniform"]
    radius_min: Positive
    radius_max: Positive

    @model_validator(mode="after")
    def _ordered(self):
        if self.radius_min >= self.radius_max:
            raise ValueError(
                f"radius_min {self.radius_min:g} m must be below radius_max {self.radius_max:g} m"
            )
        return self


class FractalGrading(UniformGrading):
    """Number density ~ R^-(1+alpha)."""

    form: Literal["fractal"]
    alpha: Annotated[float, Field(gt=0, le=6)]


Grading = Annotated[UniformGrading | FractalGrading, Field(discriminator="form")]


class Contact(_Section):
    """Frictionless linear normal contact."""

    normal_stiffness: Positive = 1.0e6  # [N/m]


class Loading(_Section):
    """Isotropic strain-controlled compression in equal steps, each relaxed."""

    edge_reduction: Fraction = 0.40
    approach_solid_fraction: Fraction = 0.55
    steps: Annotated[int, Field(ge=1)] = 60
    states: Annotated[int, Field(ge=1)] = 15
    unbalanced_force_ratio: Annotated[float, Field(gt=0, le=1e-6)] = 1e-7

    @model_validator(mode="after")
    def _whole_steps(self):
        if self.steps % self.states:
            raise ValueError(
                f"steps {self.steps} must be a multiple of states {self.states}, "
                "so that a state is saved every few whole steps"
            )
        return self


class Sample(_Section):
    """A grading, a boundary and a loading, run with several seeds."""

    grading: Grading
    grains: Annotated[int, Field(ge=2)]
    boundary: Literal["walls", "periodic"] = "walls"
    initial_solid_fraction: Annotated[float, Field(gt=0, le=0.4)] = 0.16
    contact: Contact = Contact()
    loading: Loading = Loading()
    seeds: list[Annotated[int, Field(ge=0)]] = Field(min_length=1)

    @field_validator("seeds", mode="before")
    @classmethod
    def _count_or_list(cls, seeds):
        if isinstance(seeds, int) and not isinstance(seeds, bool):
            if seeds < 1:
                raise ValueError("a number of seeds must be at least 1")
            return list(range(1, seeds + 1))
        return seeds

    @field_validator("seeds")
    @classmethod
    def _distinct(cls, seeds):
        if len(set(seeds)) < len(seeds):
            raise ValueError("every seed must be given once")
        return seeds

    @model_validator(mode="after")
    def _compresses(self):
        final = self.initial_solid_fraction / (1 - self.loading.edge_reduction) ** 3
        approach = self.loading.approach_solid_fraction
        if not self.initial_solid_fraction < approach < final:
            raise ValueError(
                f"loading.approach_solid_fraction {approach:g} must lie between "
                f"initial_solid_fraction {self.initial_solid_fraction:g} and the final "
                f"{final:.3f} that edge_reduction {self.loading.edge_reduction:g} leads to"
            )
        return self


class EnergySplit(_Section):
    """How the energy-split function is binned and its exponent's interval found."""

    bins: Annotated[int, Field(ge=3, le=200)] = 20
    confidence: Fraction = 0.95
    resamples: Annotated[int, Field(ge=100)] = 2000


class Thermodynamics(_Section):
    """The crushing model."""

    ultimate_alpha: Annotated[float, Field(gt=0, lt=3)] = 2.6
    critical_energy: Positive = 2.0e5  # [J/m3]
    hardening_exponent: Positive = 2.0


class Figures(_Section):
    """What the figures look like."""

    dpi: Annotated[int, Field(ge=50, le=1200)] = 300


def _usable_name(name):
    if name.endswith(REFINED):
        raise ValueError(f"a name must not end in {REFINED}, kept for the convergence study")
    return name


SampleName = Annotated[
    str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$"), AfterValidator(_usable_name)
]


class Config(_Section):
    """The whole configuration."""

    samples: dict[SampleName, Sample] = Field(min_length=1)
    energy_split: EnergySplit = EnergySplit()
    thermodynamics: Thermodynamics = Thermodynamics()
    figures: Figures = Figures()


def checked_config(raw):
    """Return the configuration with types converted and defaults filled in.

    Parameters
    ----------
    raw : dict
        What the YAML file holds.

    Returns
    -------
    Config

    Raises
    ------
    ConfigError
        With one line for each problem: the key's path, its value, and what is allowed.

    Examples
    --------
    >>> grading = {"form": "uniform", "radius_min": 1e-5, "radius_max": 1e-3}
    >>> sample = {"grading": grading, "grains": 100, "seeds": 2}
    >>> checked_config({"samples": {"mine": sample}}).samples["mine"].seeds
    [1, 2]
    """
    try:
        return Config.model_validate(raw)
    except ValidationError as error:
        problems = [problem(detail, Config) for detail in error.errors()]
    raise ConfigError("\n".join(f"config: {line}" for line in problems))


def refined(sample):
    """Return the sample with twice the strain steps: what its convergence is judged against."""
    loading = sample.loading.model_copy(update={"steps": 2 * sample.loading.steps})
    return sample.model_copy(update={"loading": loading})
