"""What a measured material asks of its files and numbers together, checked before any job."""

from typing import Any

from pydantic import TypeAdapter, ValidationError

from branchcrush.config.build import compression_of
from branchcrush.config.grading_files import checked_grading, unread_file
from branchcrush.config.measured import CompressionTest, UltimateSmallest
from branchcrush.crushing.breakage import einav_breakage
from branchcrush.errors import GradingError
from branchcrush.gradings.distribution import Grading

_DEFAULT_ALPHA = 2.6
# Of Einav's breakage: by so little two sieve analyses of one sand may differ.
_SIEVING = 0.02


def measured_problems(section: Any) -> list[str]:
    """Return what is wrong with a measured material that its keys alone do not tell, a line each.

    Parameters
    ----------
    section : object
        Of the YAML file; a part that is not valid in itself is passed over.

    Returns
    -------
    list of str
        Each begins with the key below the material.

    Examples
    --------
    >>> measured_problems({"before": {"form": "radii", "file": "no.txt"}})[0][:45]
    "before.file = 'no.txt': there is no such file"
    """
    if not isinstance(section, dict):
        return []
    before, problems = checked_grading(section.get("before"), "before")
    after = None
    if section.get("after") is not None:
        after, found = checked_grading(section["after"], "after")
        problems += found
    problems += _compression_problems(section.get("compression"))
    if before is not None:
        problems += _ultimate_problems(section, before, after)
    return problems


def _compression_problems(raw: Any) -> list[str]:
    """Return what is wrong with the file of a compression curve."""
    if not isinstance(raw, dict):
        return []
    if problems := unread_file(raw.get("file"), "compression"):
        return problems
    try:
        section = CompressionTest.model_validate(raw).model_dump(exclude_none=True)
        compression_of(section)
    except ValidationError:
        return []
    except GradingError as error:
        return [f"compression.file: {line}" for line in str(error).splitlines()]
    return []


def _ultimate_problems(section: dict, before: Grading, after: Grading | None) -> list[str]:
    """Return whether crushing could not lead to the grading after, or to the ultimate one."""
    raw = section.get("ultimate_smallest")
    try:
        smallest = UltimateSmallest.model_validate(raw)
        alpha = TypeAdapter(float).validate_python(section.get("ultimate_alpha", _DEFAULT_ALPHA))
    except ValidationError:
        return []
    if not 0 < alpha < 3:  # refused as such
        return []
    largest = before.support()[1]
    value = f"ultimate_smallest.value = {smallest.value:g} {smallest.unit}"
    if smallest.radius >= largest:
        end = largest / smallest.radius * smallest.value
        return [
            f"{value}: must be below the largest size of the grading before, {end:.3g} "
            f"{smallest.unit}"
        ]
    try:
        # Without a grading after, whether the ultimate one is any finer.
        breakage = einav_breakage(before, after or before, alpha, largest, smallest.radius)
    except ValueError:
        return [
            f"{value}: the ultimate grading would be no finer than the one before: lower it, or "
            "raise ultimate_alpha"
        ]
    if breakage < -_SIEVING:
        return [
            f"after: coarser than before, Einav's B = {breakage:.3g}, and crushing makes none "
            "coarser: are before and after exchanged?"
        ]
    if breakage > 1.0 + _SIEVING:
        lower = "lower it, or " if smallest.value > 0.0 else ""
        return [
            f"{value}: the grading after is finer than the ultimate one, Einav's B = "
            f"{breakage:.3g}, which must be at most 1: {lower}raise ultimate_alpha"
        ]
    return []
