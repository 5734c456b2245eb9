"""The configuration: its keys, types, units, defaults and checks."""

import re
from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    StrictBool,
    ValidationError,
    ValidationInfo,
    field_validator,
)

from branchcrush.config.fields import Fraction, Number, Section, number, refusal
from branchcrush.config.gradings import GradingSection
from branchcrush.config.messages import problem
from branchcrush.config.stresses import increasing_stresses
from branchcrush.errors import ConfigError
from branchcrush.loading.targets import (
    STATE_TOLERANCES,
    STRAIN_TARGETS,
    final_solid_fraction,
    strain_step,
)

# Ends the name of a sample run with twice the strain steps, to judge its convergence.
REFINED = "-refined"
# Beyond this the overlaps are as large as the grains, whatever the stiffness.
_DENSEST = 1.2
_TARGETS = (*STRAIN_TARGETS, "mean_stress")
_MOST_SEEDS = 1000
_SEEDS = Number(least=1, most=_MOST_SEEDS, whole=True, hint=", or a list of as many seeds")
_LONGEST_NAME = 100
# Files and folders of results that no sample may be called.
_TAKEN = (
    "figures",
    "findings",
    "made",
    "comparison.csv",
    "coordination.csv",
    "exponents.csv",
    "findings.csv",
    "findings.html",
    "report.html",
    "preview.txt",
)


class LinearContact(Section):
    """Frictionless linear normal contact of one stiffness."""

    law: Literal["linear"]
    normal_stiffness: number(above=0, most=1e15, unit="N/m") = 1.0e6


class HertzContact(Section):
    """Frictionless Hertz contact of grains of one material."""

    law: Literal["hertz"]
    young_modulus: number(above=0, most=1e15, unit="Pa")
    poisson_ratio: number(least=0, most=0.5)


Contact = Annotated[LinearContact | HertzContact, Field(discriminator="law")]


class Loading(Section):
    """Isotropic compression in strain steps, each relaxed, to one target."""

    edge_reduction: Fraction | None = None
    volume_reduction: Fraction | None = None
    solid_fraction: number(above=0, most=_DENSEST) | None = None
    mean_stress: Annotated[list[float], BeforeValidator(increasing_stresses)] | None = None
    states: number(int, least=1, most=1000) | None = None
    approach_solid_fraction: Fraction = 0.55
    quality: Literal["draft", "standard", "fine"] = "standard"
    # The last key is checked when all others are known, also where some are wrong.
    unloading: Annotated[StrictBool, Field(validate_default=True)] = False

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


class Sample(Section):
    """A grading, a boundary and a loading, run with several seeds."""

    grading: GradingSection
    sampling: Literal["random", "number_quantiles", "mass_quantiles"] = "random"
    grains: number(int, least=2, most=10_000_000)
    allow_unrepresentative: StrictBool = False
    boundary: Literal["walls", "periodic"] = "walls"
    initial_solid_fraction: number(above=0, most=0.4) = 0.16
    contact: Contact = LinearContact(law="linear")
    loading: Loading
    seeds: list[number(int, least=0, most=2**32 - 1)] = Field(description=_SEEDS.allowed)
    refined_seeds: number(int, least=0, most=_MOST_SEEDS) = 4
    ranks: number(int, least=1, most=1024, unit="processes") = 1

    @field_validator("loading")
    @classmethod
    def _compresses(cls, loading: Loading, info: ValidationInfo) -> Loading:
        start, approach = info.data.get("initial_solid_fraction"), loading.approach_solid_fraction
        name, value = loading.target
        if start is None:
            return loading
        if not start < approach:
            raise refusal(
                f"must be above initial_solid_fraction {start:g}",
                key="approach_solid_fraction",
                value=approach,
            )
        if name == "mean_stress":
            return loading
        final = final_solid_fraction(start, name, value)
        if not approach < final <= _DENSEST:
            leads = f"leads from initial_solid_fraction {start:g} to {final:.3g}, which "
            raise refusal(
                f"{'' if name == 'solid_fraction' else leads}must be above "
                f"loading.approach_solid_fraction {approach:g} and at most {_DENSEST}",
                key=name,
                value=value,
            )
        return loading

    @field_validator("seeds", mode="before")
    @classmethod
    def _count_or_list(cls, seeds: Any, info: ValidationInfo) -> list:
        if isinstance(seeds, list) and 0 < len(seeds) <= _MOST_SEEDS:
            return seeds
        return list(range(1, _SEEDS(seeds, info) + 1))

    @field_validator("seeds")
    @classmethod
    def _distinct(cls, seeds: list[int]) -> list[int]:
        twice = sorted({seed for seed in seeds if seeds.count(seed) > 1})
        if twice:
            which = ", ".join(map(str, twice))
            raise refusal(f"must have every seed once; more than once: {which}")
        return seeds

    def settings(self, refinement: int = 1) -> dict[str, Any]:
        """Return the sample as plain values; a refinement takes that many times the steps.

        Parameters
        ----------
        refinement : int
            A refined sample has the first `refined_seeds` of the seeds.

        Returns
        -------
        dict
            As `config.build.sample_of` takes it.
        """
        seeds = self.seeds if refinement == 1 else self.seeds[: self.refined_seeds]
        return {
            **self.model_dump(exclude_none=True),
            "loading": self.loading.plain(),
            "strain_step": strain_step(self.loading.quality, refinement),
            "state_tolerance": STATE_TOLERANCES[self.loading.quality],
            "quality": self.loading.quality,
            "seeds": seeds,
        }


class EnergySplit(Section):
    """How the energy-split function is binned and its exponent's interval found."""

    bins: number(int, least=3, most=200) = 20
    confidence: Fraction = 0.95
    resamples: number(int, least=100, most=1_000_000) = 2000


class Thermodynamics(Section):
    """The crushing model."""

    ultimate_alpha: number(above=0, below=3) = 2.6
    critical_energy: number(above=0, most=1e15, unit="J/m3") = 2.0e5
    hardening_exponent: number(above=0, most=100) = 2.0


class Figures(Section):
    """What the figures look like."""

    dpi: number(int, least=50, most=1200, unit="dots per inch") = 300


def _usable_name(name):
    """Return the name of a sample, or refuse one that no folder can have."""
    if not isinstance(name, str):
        raise refusal("a name must be text: put it in quotes")
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", name) or len(name) > _LONGEST_NAME:
        raise refusal(
            f"a name must be 1 to {_LONGEST_NAME} letters, digits, '.', '_' and '-', and begin "
            "with a letter or digit: it names a folder"
        )
    if name.endswith(REFINED):
        raise refusal(f"a name must not end in {REFINED}, kept for the convergence of the others")
    if name in _TAKEN:
        raise refusal(f"a name must not be {name}, which results has for all samples")
    return name


SampleName = Annotated[str, BeforeValidator(_usable_name)]


def _not_empty(samples):
    if not samples:
        raise refusal("must hold at least one sample")
    return samples


class Config(Section):
    """The whole configuration."""

    samples: Annotated[dict[SampleName, Sample], AfterValidator(_not_empty)]
    energy_split: EnergySplit = EnergySplit()
    thermodynamics: Thermodynamics = Thermodynamics()
    figures: Figures = Figures()
    keep_dumps: Literal["all", "last", "none"] = Field(
        "all",
        description=(
            "Of which states a packing keeps LAMMPS's dumps of grains and pair forces, for OVITO: "
            "all, the last one, or none. No result needs them."
        ),
    )


def checked_config(raw: Any) -> Config:
    """Return the configuration with types converted and defaults filled in.

    Every key alone and every section in itself; `config_checks` asks what needs the grains, the
    files and the folder.

    Parameters
    ----------
    raw : object
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
    >>> grading = {"form": "uniform", "basis": "number", "size": "radius", "unit": "mm",
    ...            "min": 0.01, "max": 1}
    >>> loading = {"edge_reduction": 0.4}
    >>> sample = {"grading": grading, "grains": 100, "loading": loading, "seeds": 2}
    >>> checked_config({"samples": {"mine": sample}}).samples["mine"].seeds
    [1, 2]
    """
    try:
        return Config.model_validate(raw)
    except ValidationError as error:
        problems = [problem(detail, Config) for detail in error.errors()]
    raise ConfigError("\n".join(f"config: {line}" for line in problems))
