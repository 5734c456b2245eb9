"""What a configuration asks of grains, files and folders: checked before any job starts."""

from os import PathLike
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from branchcrush.config.breakage_checks import breakage_problems
from branchcrush.config.build import unit_of
from branchcrush.config.fields import one_line
from branchcrush.config.folders import folder_problems
from branchcrush.config.grading_files import checked_grading, unread_file
from branchcrush.config.history import history_loads
from branchcrush.config.measured_checks import measured_problems
from branchcrush.config.packing_files import packing_problems
from branchcrush.config.room import room_problems
from branchcrush.config.sample import number_of_grains
from branchcrush.config.schema import Config, Sample, checked_config
from branchcrush.errors import ConfigError, GradingError
from branchcrush.gradings.narrower import narrower_words
from branchcrush.gradings.representativity import representativity
from branchcrush.loading.states import stress_floor
from branchcrush.loading.targets import Loading, expected_overlap_ratio
from branchcrush.packings.contact_laws import contact_law

# Grains pressed together by half their radius are no spheres in contact any more.
_DEEPEST_OVERLAP = 0.5
# What the checks below ask for; a mistake in another key keeps none of them back.
_NEEDED = (
    "grading",
    "sampling",
    "grains",
    "allow_unrepresentative",
    "initial_solid_fraction",
    "contact",
    "loading",
)


def checked_study(
    raw: Any, folder: str | PathLike[str] = ".", *, few_grains: bool = False
) -> Config:
    """Return the configuration, sound in itself and in what it asks of files and folder.

    Parameters
    ----------
    raw : object
        What the YAML file holds.
    folder : path-like
        Where results will go.
    few_grains : bool
        Whether grains too few for their grading are let through, as for a preview.

    Returns
    -------
    Config

    Raises
    ------
    ConfigError
        With one line for each problem, all of them at once.

    Examples
    --------
    >>> grading = {"form": "uniform", "basis": "number", "size": "radius", "unit": "mm",
    ...            "min": 0.5, "max": 1}
    >>> sample = {"grading": grading, "grains": 2, "loading": {"edge_reduction": 0.4}, "seeds": 2}
    >>> checked_study({"samples": {"mine": sample}})
    Traceback (most recent call last):
    branchcrush.errors.ConfigError: config: samples.mine.grains = 2: ...
    """
    problems, config = [], None
    try:
        config = checked_config(raw)
    except ConfigError as error:
        problems += str(error).splitlines()
    samples = raw.get("samples") if isinstance(raw, dict) else None
    samples = samples if isinstance(samples, dict) else {}
    for name, section in samples.items():
        problems += [
            f"config: samples.{one_line(name)}.{line}"
            for line in sample_problems(section, few_grains=few_grains)
        ]
    problems += _history_problems(config)
    materials = raw.get("measured") if isinstance(raw, dict) else None
    for name, section in materials.items() if isinstance(materials, dict) else ():
        problems += [
            f"config: measured.{one_line(name)}.{line}" for line in measured_problems(section)
        ]
    # A name that is none of a folder was refused as such.
    names = [name for name in samples if isinstance(name, str) and Path(name).name == name]
    seeds = {name: config.samples[name].seeds if config else () for name in names}
    problems += [
        f"config: {line}"
        for line in folder_problems(folder, seeds, list(config.measured) if config else ())
    ]
    if problems:
        raise ConfigError("\n".join(problems))
    return config


def sample_problems(section: Any, *, few_grains: bool = False) -> list[str]:
    """Return what is wrong with a sample that its keys alone do not tell, a line each.

    Parameters
    ----------
    section : object
        Of the YAML file; a part that is not valid in itself is passed over.
    few_grains : bool
        As for `checked_study`.

    Returns
    -------
    list of str
        Each begins with the key below the sample.

    Examples
    --------
    >>> sample_problems({"grading": {"form": "radii", "file": "no.txt"}})[0][:46]
    "grading.file = 'no.txt': there is no such file"
    """
    if not isinstance(section, dict):
        return []
    if "packing" in section:
        return packing_problems(section["packing"])
    grading, problems = checked_grading(section.get("grading"))
    if grading is None:
        return problems
    grains, sample = None, _sample(section)
    if sample is not None:
        settings = sample.settings()
        problems = _list_problems(settings)
        if not problems:
            grains = number_of_grains(settings)
            allowed = few_grains or sample.allow_unrepresentative
            problems = _grain_problems(settings, grading, grains, allowed)
            problems += _stress_problems(sample, grading)
            # What is refused for too few grains need not be tried; a preview tells it itself.
            if not problems and not few_grains:
                problems = room_problems(settings, grading, grains)
    unit, _, size = unit_of(section["grading"])
    return problems + breakage_problems(section.get("breakage"), grading, grains, unit, size)


def _sample(section):
    """Return the sample of the keys that are checked here, or None where one of them is wrong."""
    needed = {key: section[key] for key in _NEEDED if key in section}
    # Where these are wrong they are refused as such, and keep nothing back.
    others = {key: section[key] for key in ("boundary", "seeds") if key in section}
    for given in (others, {"seeds": 1}):
        try:
            return Sample.model_validate({**needed, **given, "refined_seeds": 0})
        except ValidationError:
            continue
    return None


def _history_problems(config):
    """Return what is wrong with the file of a history."""
    if config is None:
        return []
    file = config.thermodynamics.history.file
    if file and (problems := unread_file(file, "thermodynamics.history")):
        return [f"config: {line}" for line in problems]
    try:
        history_loads(config.thermodynamics.history.model_dump())
    except GradingError as error:
        return [f"config: thermodynamics.history.file: {line}" for line in str(error).splitlines()]
    return []


def _list_problems(settings):
    """Return whether a list of grains has another number than is asked for."""
    given = settings["grains"]
    if settings["sampling"] != "listed" or given is None:
        return []
    listed = number_of_grains({**settings, "grains": None})
    if given == listed:
        return []
    return [
        f"grains = {given}: the list {settings['grading']['file']} has {listed}; leave grains "
        f"out to take these {listed} as they are, or say sampling: random (or number_quantiles, "
        f"mass_quantiles) to draw {given} of such sizes"
    ]


def _grain_problems(settings, grading, grains, allowed):
    """Return what is wrong with the number of grains, for the sizes there are."""
    end = Loading(**settings["loading"]).end(settings["initial_solid_fraction"])
    standing = representativity(grading, grains, end)
    problems = []
    if standing.verdict == "refuse" and not allowed:
        part = narrower_words(grading, grains, end, *unit_of(settings["grading"]))
        problems.append(
            f"grains = {grains}: {standing.message}{part}; or set allow_unrepresentative: true, "
            "which the report will repeat"
        )
    if standing.box_edge < standing.expected_largest_diameter:
        problems.append(
            f"grains = {grains}: the cell would end at an edge of {standing.box_edge:.3g} "
            f"m, smaller than the largest grain of {standing.expected_largest_diameter:.3g} m: use "
            "more grains or load less"
        )
    return problems


def _stress_problems(sample, grading):
    """Return whether a stress would press the grains into each other, or would be none."""
    target, value = sample.loading.target
    if target != "mean_stress":
        return []
    radius, law = float(grading.mass_ppf(0.5)), contact_law(**sample.contact.model_dump())
    floor, problems = stress_floor([grading.moment(1)], law), []
    if min(value) < floor:
        problems.append(
            f"loading.mean_stress = {min(value):g} Pa: below {floor:.3g} Pa grains of this "
            "stiffness are not told from grains that carry no load: ask for more, or lower the "
            "stiffness of contact"
        )
    overlap = expected_overlap_ratio(value[-1], radius, law)
    if overlap > _DEEPEST_OVERLAP:
        problems.append(
            f"loading.mean_stress = {value[-1]:g} Pa: would press grains of the median radius "
            f"by mass, {radius:.3g} m, together by about {overlap:.0%} of it (at most "
            f"{_DEEPEST_OVERLAP:.0%}): ask for less, or raise the stiffness of contact"
        )
    return problems
