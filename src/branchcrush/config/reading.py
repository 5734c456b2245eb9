"""How a grading is read, told before anything runs: what columns mean, sizes that follow from it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

SHARES = (10, 30, 50, 60, 90)


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
        The section as YAML, to be pasted below a sample, with every key that a default filled.

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


def grading_report(section: Mapping[str, Any]) -> GradingReport:
    """Return how a section of a grading is read, without raising for what is wrong in it.

    Parameters
    ----------
    section : mapping
        As the YAML file has it, complete or not. Names of files are relative to the working
        directory.

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
    from pydantic import TypeAdapter

    from branchcrush.config.build import grading_of
    from branchcrush.config.gradings import GradingSection
    from branchcrush.config.units import UNITS

    plain = TypeAdapter(GradingSection).validate_python(dict(section)).model_dump(exclude_none=True)
    grading = grading_of(plain)
    unit = plain.get("unit", "mm")
    sizes = 2 * grading.mass_ppf([share / 100 for share in SHARES]) / UNITS[unit]
    d_values = {f"D{share}": float(size) for share, size in zip(SHARES, sizes, strict=True)}
    return GradingReport(d_values=d_values, unit=unit)
