"""What grains that break ask of the grading and the number of grains, checked before any job."""

from typing import Any

from pydantic import ValidationError

from branchcrush.breakage.cascade import broken_down
from branchcrush.config.breakage import MOST_GRAINS, Breakage
from branchcrush.config.units import UNITS
from branchcrush.gradings.distribution import Grading


def breakage_problems(
    raw: Any, grading: Grading, grains: int | None, unit: str, size: str
) -> list[str]:
    """Return what is wrong with the breakage of a sample that its keys alone do not tell.

    Parameters
    ----------
    raw : object
        The section of the YAML file; one that is not valid in itself is passed over.
    grading : Grading
    grains : int or None
        Of the sample; None where their number is not valid.
    unit : str
        That the sizes of the grading are given in.
    size : {"diameter", "radius"}
        What they are.

    Returns
    -------
    list of str
        A line each, which begins with the key below the sample.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> raw = {"strength": 2e7, "weibull_modulus": 3, "unit": "mm", "reference_diameter": 1,
    ...        "smallest_diameter": 1.2}
    >>> (line,) = breakage_problems(raw, uniform(4e-4, 6e-4), 100, "mm", "radius")
    >>> line[:75]
    'breakage.smallest_diameter = 1.2 mm: must be below the largest grain, 1.2 m'
    """
    try:
        section = Breakage.model_validate(raw)
    except ValidationError:
        return []
    return [*_limit_problems(section, grading, unit, size), *_room_problems(section, grains)]


def _limit_problems(section, grading, unit, size):
    """Return whether no grain is above the comminution limit, or grains break without end."""
    metres = UNITS[section.unit]
    limit, largest = section.smallest_diameter * metres, 2.0 * float(grading.support()[1])
    begin = f"breakage.smallest_diameter = {section.smallest_diameter:g} {section.unit}: must be"
    told = f"{largest / metres:.4g} {section.unit} in diameter"
    if limit >= largest:
        scale = (2.0 if size == "diameter" else 1.0) / UNITS[unit]
        first, last = (f"{scale * end:.4g}" for end in grading.support())
        sizes = "diameters" if size == "diameter" else "radii"
        return [
            f"{begin} below the largest grain, {told}, or none can break (the grading has {sizes} "
            f"from {first} to {last} {unit}): check it and breakage.unit"
        ]
    pieces = _pieces(largest / limit, section.fragments)
    if pieces <= MOST_GRAINS:
        return []
    least = largest / _most_ratio(section.fragments) / metres
    return [
        f"{begin} at least {least:.3g} {section.unit}, since the largest grain, {told}, broken "
        f"down to it would be {pieces:.2g} grains, and a packing may have {MOST_GRAINS}: check it "
        "and breakage.unit"
    ]


def _pieces(ratio: float, fragments: int) -> float:
    """Return into how many grains one is broken down that is so many times the limit."""
    return float(broken_down([ratio], [1.0], 1.0, 1.0, fragments)[1].sum())


def _most_ratio(fragments: int) -> float:
    """Return about how many times the limit a grain may be."""
    low, high = 1.0, 1e12
    while high > 1.001 * low:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if _pieces(middle, fragments) <= MOST_GRAINS else (low, middle)
    return low


def _room_problems(section, grains):
    """Return whether not one grain can break before there are too many."""
    if grains is None or section.largest_grains >= grains + section.fragments - 1:
        return []
    return [
        f"breakage.largest_grains = {section.largest_grains}: must be at least "
        f"{grains + section.fragments - 1}, or none can break: there are {grains} grains to begin "
        f"with, and one that breaks into {section.fragments} fragments adds {section.fragments - 1}"
    ]
