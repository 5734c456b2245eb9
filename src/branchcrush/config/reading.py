"""How a grading is read, told before anything runs: what columns mean, and the sizes then."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import yaml
from pydantic import ValidationError

from branchcrush.config.build import grading_of, size_fits
from branchcrush.config.fields import Section
from branchcrush.config.gradings import GradingSection
from branchcrush.config.messages import problem
from branchcrush.config.units import UNITS
from branchcrush.errors import GradingError
from branchcrush.files.declared import DEFAULTS, Declared
from branchcrush.files.grading_tables import (
    read_density_table,
    read_histogram,
    read_radii,
    read_sieve_table,
)
from branchcrush.files.header_words import header_words
from branchcrush.gradings.distribution import Grading

# Percent of the mass that is finer.
SHARES = (10, 30, 50, 60, 90)
_READERS = {
    "sieve": read_sieve_table,
    "density": read_density_table,
    "histogram": read_histogram,
}
_OPENINGS = {
    "size": "sizes in {unit}",
    "phi": "phi, -log2 of the size in mm",
    "astm_e11": "numbers and names of sieves by ASTM E11",
    "tyler_mesh": "meshes per inch of Tyler's scale",
}
_VALUES = {
    "percent_finer": "percent finer by mass",
    "percent_coarser": "percent coarser by mass, cumulative from the coarsest sieve",
    "percent_retained": "percent of the mass that each sieve retains",
    "mass_retained": "the mass that each sieve retains",
}
_CHANNELS = {
    "edges": "both edges of each channel",
    "lower": "the lower edge of each channel",
    "upper": "the upper edge of each channel",
    "middles": "the middle of each channel, on a {scale} scale",
}
# Keys of each form that have a default.
_FILLED = {"sieve": ("openings", "values"), "density": ("per",), "histogram": ("scale",)}


class _Root(Section):
    grading: GradingSection


@dataclass(frozen=True)
class GradingReport:
    """What a section of a grading is read as.

    Parameters
    ----------
    meaning : list of str
        How the file is read, a sentence each.
    d_values : dict
        D10, D30, D50, D60 and D90 by mass, diameters in `unit`; empty if there are problems.
    unit : str
        Of them.
    warnings : list of str
        What is worth a look, and keeps nothing from running.
    problems : list of str
        What is to be mended or said, with the keys to paste; empty if the grading is read.
    config_lines : list of str
        The section as YAML, to be pasted below a sample, with every key that a default filled and
        that may be said without changing how the file is read.
    grading : Grading or None
        What it makes; None if there are problems.

    Examples
    --------
    >>> GradingReport().problems
    []
    """

    meaning: list[str] = field(default_factory=list)
    d_values: dict[str, float] = field(default_factory=dict)
    unit: str = "mm"
    warnings: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    config_lines: list[str] = field(default_factory=list)
    grading: Grading | None = None


def grading_report(
    section: Mapping[str, Any],
    file_to_paste: str | None = None,
    typed: Mapping[str, Any] | None = None,
) -> GradingReport:
    """Return how a section of a grading is read, without raising for what is wrong in it.

    Parameters
    ----------
    section : mapping
        As the YAML file has it, complete or not. Names of files are relative to the working
        directory.
    file_to_paste : str, optional
        Name of the file in the lines to paste, where it is not that of the section.
    typed : mapping, optional
        The file and the options of the command line. There the unit may be that of the file's
        header, and problems name the command to type; a configuration has to say its unit.

    Returns
    -------
    GradingReport

    Examples
    --------
    >>> section = {"form": "uniform", "size": "diameter", "unit": "mm", "basis": "mass"}
    >>> report = grading_report({**section, "min": 1.0, "max": 2.0})
    >>> round(report.d_values["D50"], 6)
    1.5
    """
    by_header = None
    if typed is not None:
        try:
            unit, by_header = _unit_by_header(section)
        except GradingError as error:
            return GradingReport(problems=str(error).splitlines())
        section = {**section, "unit": unit} if unit else section
    try:
        checked = _Root.model_validate({"grading": dict(section)}).grading
    except ValidationError as error:
        return GradingReport(problems=[problem(detail, _Root) for detail in error.errors()])
    plain = checked.model_dump(exclude_none=True)
    try:
        grading = grading_of({**plain, "typed": typed})
        remarks = _remarks(plain)
    except GradingError as error:
        return GradingReport(_meaning(plain), problems=str(error).splitlines())
    filled = _filled(plain)
    named = {} if file_to_paste is None else {"file": file_to_paste}
    # A mixture has no unit of its own.
    unit = plain.get("unit", "mm")
    sizes = 2 * grading.mass_ppf([share / 100 for share in SHARES]) / UNITS[unit]
    header = [f"unit: {by_header}, by the header"] if by_header else []
    return GradingReport(
        meaning=_meaning(plain) + header + remarks,
        d_values={f"D{share}": float(size) for share, size in zip(SHARES, sizes, strict=True)},
        unit=unit,
        warnings=_warnings(plain, filled),
        config_lines=_config_lines({**plain, **named, **filled}),
        grading=grading,
    )


def _unit_by_header(section):
    """Return the unit to read a file in, and again if it is the header that gives it."""
    form, file = section["form"], section.get("file")
    declared = Declared.of(section)
    if section.get("unit") or file is None or declared.openings not in (None, "size"):
        return None, None
    words = header_words(file, form, declared)
    known = words.units() & set(UNITS)
    if len(words.units()) == 1 and known:
        (unit,) = known
        return unit, unit
    # Words of phi or of sieves' numbers are answered by how to say so, which needs no unit.
    answered = form in _READERS and words.openings() and "size" not in words.openings()
    return ("mm" if answered else None), None


def _meaning(plain):
    """Return what the columns of a file are taken for."""
    form, unit = plain["form"], plain.get("unit")
    declared = Declared.of(plain)
    if form == "sieve":
        lines = [
            f"openings: {_OPENINGS[declared.scale_of_openings].format(unit=unit)}",
            f"values: {_VALUES[declared.kind]}",
        ]
    elif form == "density":
        lines = [
            f"sizes: in {unit}",
            f"values: a density by {plain['basis']}, per {declared.taken('per')}",
        ]
    elif form == "histogram":
        sizes = _CHANNELS[plain["sizes"]].format(scale=declared.scale)
        lines = [f"sizes: {sizes}, in {unit}", f"values: the share or {_counts(plain)} of each"]
    elif form == "radii":
        lines = [f"sizes: the {plain['size']} of each grain, in {unit}"]
    elif fits := size_fits(plain):
        return [fit.words(unit, UNITS[unit]) for fit in fits.values()]
    else:
        return []
    if declared.columns:
        lines.append(f"columns: {', '.join(map(str, declared.columns))}")
    return lines


def _counts(plain):
    return {"number": "number of grains"}.get(plain["basis"], plain["basis"])


def _remarks(plain):
    """Return what the reader of the file has to say."""
    if plain["form"] == "radii":
        return [f"{len(read_radii(plain['file']))} sizes are in the file"]
    if plain["form"] not in _READERS:
        return []
    table = _READERS[plain["form"]](plain["file"], Declared.of(plain))
    return [f"{len(table.sizes)} sizes, {table.sizes[0]:g} to {table.sizes[-1]:g}", *table.remarks]


def _filled(plain):
    """Return the keys that a default fills."""
    keys = [key for key in _FILLED.get(plain["form"], ()) if key not in plain]
    filled = {key: DEFAULTS[key] for key in keys}
    # Said, a scale also tells how channels go on beyond the sizes in the file.
    if "scale" in filled and _edges(plain) != _edges({**plain, **filled}):
        del filled["scale"]
    return filled


def _edges(plain):
    """Return the edges of the channels of a file, or nothing if it cannot be read."""
    try:
        return read_histogram(plain["file"], Declared.of(plain)).sizes.tolist()
    except GradingError:
        return None


def _warnings(plain, filled):
    """Return which keys a default filled that no word above the columns agrees with."""
    if not filled:
        return []
    words = header_words(plain["file"], plain["form"], Declared.of(plain))
    said = {"values": words.values(), "openings": words.openings(), "per": words.per()}
    return [
        f"{key} is not given, and {default} is taken: nothing in the file speaks against it"
        for key, default in filled.items()
        if said.get(key) != {default}
    ]


def _config_lines(section):
    return yaml.safe_dump({"grading": section}, sort_keys=False, allow_unicode=True).splitlines()
