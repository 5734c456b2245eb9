"""The configuration: its keys, types, units, defaults and checks."""

from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    StrictBool,
    Tag,
    ValidationError,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)

from branchcrush.config.breakage import MOST_GRAINS, Breakage
from branchcrush.config.compression import DENSEST, Contact, LinearContact, Loading
from branchcrush.config.crushing import Thermodynamics
from branchcrush.config.evaluation import EnergySplit, Figures
from branchcrush.config.fields import (
    Allowed,
    Number,
    NumberOrNone,
    Section,
    number,
    refusal,
)
from branchcrush.config.gradings import GradingSection
from branchcrush.config.measured import Measured
from branchcrush.config.messages import problem
from branchcrush.config.names import NAMES_SCHEMA, SampleName, distinct_names
from branchcrush.config.packing import ReadSample
from branchcrush.config.schema_parts import EXAMPLE, number_or_list, required_unless
from branchcrush.errors import ConfigError
from branchcrush.loading.targets import (
    STATE_TOLERANCES,
    final_solid_fraction,
    strain_step,
)

_MOST_SEEDS = 1000
# That are named at once.
_MOST_PROBLEMS = 100
_GRAINS = NumberOrNone(least=2, most=MOST_GRAINS, whole=True)
_SEEDS = Number(least=1, most=_MOST_SEEDS, whole=True, hint=", or a list of as many seeds")
_SEEDS_SCHEMA = WithJsonSchema(
    number_or_list(_SEEDS, Number(least=0, most=2**32 - 1, whole=True), _MOST_SEEDS)
)

# In a schema: a list of grains has a number of them.
_A_LIST = {"properties": {"grading": {"properties": {"form": {"const": "radii"}}}}}


class Sample(Section):
    """A grading, a boundary and a loading, run with several seeds."""

    model_config = ConfigDict(json_schema_extra=required_unless("grains", _A_LIST))

    grading: GradingSection = Field(description="Sizes of the grains.")
    sampling: Literal["random", "number_quantiles", "mass_quantiles", "listed"] = Field(
        "random",
        description="How sizes are taken from the grading; a list of grains is taken as it is, "
        "listed, unless something else is asked for.",
    )
    # None for as many as a list has.
    grains: Annotated[
        int | None, BeforeValidator(_GRAINS), WithJsonSchema(_GRAINS.json_schema())
    ] = Field(
        description="Number of grains, N; of a list as many as it has, if left out.",
        examples=[1000],
    )
    allow_unrepresentative: StrictBool = Field(
        False, description="Run with too few grains, which the report will repeat."
    )
    boundary: Literal["walls", "periodic"] = Field(
        "walls", description="Six rigid walls, or a cube repeated in all directions."
    )
    initial_solid_fraction: number(above=0, most=0.4) = Field(
        0.16, description="Solid fraction of the loose packing, φ₀ [-]."
    )
    contact: Contact = Field(
        LinearContact(law="linear"), description="Law and stiffness of the contacts."
    )
    loading: Loading = Field(description="Where the compression goes, and what is saved.")
    breakage: Breakage | None = Field(
        None,
        description="Strength of the grains; with it every packing is crushed as well, beside the "
        "one whose grains do not break.",
    )
    seeds: Annotated[
        list[number(int, least=0, most=2**32 - 1)], Allowed(_SEEDS.allowed), _SEEDS_SCHEMA
    ] = Field(
        description="A number of packings, from seed 1 up, or a list of different seeds.",
        examples=[4, [3, 5]],
    )
    refined_seeds: number(int, least=0, most=_MOST_SEEDS) = Field(
        4,
        description="How many of the seeds, the first, run again with twice the strain steps; no "
        "more than there are seeds, all of them where there are fewer than the default.",
    )
    ranks: number(int, least=1, most=1024, unit="processes") = Field(
        1,
        description="MPI processes that share each packing, no more than there are cores; pays for "
        "large packings only. A change alone computes nothing again.",
    )

    @model_validator(mode="before")
    @classmethod
    def _as_listed(cls, sample: Any) -> Any:
        grading = sample.get("grading") if isinstance(sample, dict) else None
        if isinstance(grading, dict) and grading.get("form") == "radii":
            return {"sampling": "listed", "grains": None, **sample}
        return sample

    @field_validator("sampling")
    @classmethod
    def _of_a_list(cls, sampling: str, info: ValidationInfo) -> str:
        grading = info.data.get("grading")
        if sampling == "listed" and grading is not None and grading.form != "radii":
            raise refusal("takes the grains of a list as they are: it belongs to form: radii")
        return sampling

    @field_validator("grains")
    @classmethod
    def _known(cls, grains: int | None, info: ValidationInfo) -> int | None:
        grading = info.data.get("grading")
        if grains is None and grading is not None and grading.form != "radii":
            raise refusal(_GRAINS.allowed)
        return grains

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
        if not approach < final <= DENSEST:
            leads = f"leads from initial_solid_fraction {start:g} to {final:.3g}, which "
            raise refusal(
                f"{'' if name == 'solid_fraction' else leads}must be above "
                f"loading.approach_solid_fraction {approach:g} and at most {DENSEST}",
                key=name,
                value=value,
            )
        return loading

    @field_validator("breakage")
    @classmethod
    def _to_a_strain(cls, breakage: Breakage | None, info: ValidationInfo) -> Breakage | None:
        loading = info.data.get("loading")
        if breakage is not None and loading is not None and loading.target[0] == "mean_stress":
            raise refusal(
                "breakage cannot go with loading.mean_stress, since stress falls where grains "
                "break: give loading.solid_fraction (or edge_reduction, volume_reduction) instead, "
                "and breakage.largest_mean_stress to end at a stress",
                of_section=True,
            )
        return breakage

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

    @field_validator("refined_seeds")
    @classmethod
    def _of_the_seeds(cls, refined: int, info: ValidationInfo) -> int:
        # Of the seeds that are valid; the default is cut below.
        seeds = info.data.get("seeds")
        if seeds is not None and refined > len(seeds):
            raise refusal(
                f"must be at most {len(seeds)}, the number of seeds, of which so many run again; "
                "lower it, raise seeds, or leave it out"
            )
        return refined

    @model_validator(mode="after")
    def _default_within_seeds(self) -> Self:
        if "refined_seeds" in self.model_fields_set:
            return self
        refined = min(self.refined_seeds, len(self.seeds))
        return self.model_copy(update={"refined_seeds": refined})

    def settings(self, refinement: int = 1) -> dict[str, Any]:
        """Return the sample as plain values; a refinement takes that many times the steps.

        Parameters
        ----------
        refinement : int
            A refined sample has the first `refined_seeds` of the seeds.

        Returns
        -------
        dict
            As `config.sample.sample_of` takes it.
        """
        seeds = self.seeds if refinement == 1 else self.seeds[: self.refined_seeds]
        values = self.model_dump(exclude_none=True) | {"grains": self.grains, "breakage": None}
        return {
            "packing": None,
            # In the order of the keys, whichever of them were given.
            **{key: values[key] for key in type(self).model_fields},
            "loading": self.loading.plain(),
            "breakage": None if self.breakage is None else self.breakage.plain(),
            "strain_step": strain_step(self.loading.quality, refinement),
            "state_tolerance": STATE_TOLERANCES[self.loading.quality],
            "quality": self.loading.quality,
            "seeds": seeds,
        }


def kind_of_sample(section: Any) -> str:
    """Return whether a sample is compressed here, or read from the files of another code.

    Parameters
    ----------
    section : object
        Of the YAML file, or a model.

    Returns
    -------
    {"compressed", "read"}

    Examples
    --------
    >>> kind_of_sample({"packing": {"format": "yade"}})
    'read'
    """
    read = "packing" in section if isinstance(section, dict) else isinstance(section, ReadSample)
    return "read" if read else "compressed"


AnySample = Annotated[
    Annotated[Sample, Tag("compressed")] | Annotated[ReadSample, Tag("read")],
    Discriminator(kind_of_sample),
]


def _not_empty(samples):
    if not samples:
        raise refusal("must hold at least one sample")
    return distinct_names(samples)


class Config(Section):
    """The whole configuration."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})

    samples: Annotated[dict[SampleName, AnySample], AfterValidator(_not_empty)] = Field(
        description="One or more samples by names of your own; results go to results/<name>.",
        json_schema_extra={"minProperties": 1, "propertyNames": NAMES_SCHEMA},
    )
    energy_split: EnergySplit = Field(
        EnergySplit(), description="How the energy split is binned, and the intervals found."
    )
    thermodynamics: Thermodynamics = Field(Thermodynamics(), description="The crushing model.")
    measured: Annotated[dict[SampleName, Measured], AfterValidator(distinct_names)] = Field(
        {},
        description="Materials that a laboratory measured, by names of your own; results go to "
        "results/measured/<name>.",
        json_schema_extra={"propertyNames": NAMES_SCHEMA},
    )
    figures: Figures = Field(Figures(), description="What the figures look like.")
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
        details = error.errors()
        problems = [problem(detail, Config) for detail in details[:_MOST_PROBLEMS]]
        more = len(details) - _MOST_PROBLEMS
        problems += [f"and {more} more problem{'s' * (more > 1)}"] if more > 0 else []
    raise ConfigError("\n".join(f"config: {line}" for line in problems))
