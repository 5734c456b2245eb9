"""Histories of strain or stress as files hold them: one load on each line, in the order of time."""

import math
import re
from collections.abc import Sequence
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from branchcrush.crushing.resistance import LARGEST
from branchcrush.files.headers import plain_words
from branchcrush.files.rows import refuse
from branchcrush.files.sheets import Line, is_number, read_sheet

# What a load is given in, and what it is multiplied by [-] or [Pa].
UNITS = {
    "strain": {"-": 1.0, "percent": 1e-2},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6},
}
# Words of a header that name a unit; a strain that says none may be of either.
_SAID = {
    "percent": r"%|\bpercent\b|\bper cent\b|\bprozent\b",
    "kPa": r"\bkpa\b",
    "MPa": r"\bmpa\b",
    "Pa": r"\bpa\b",
}
_NAMES = {
    "strain": r"strain|dehnung|deformation|\beps|ε",
    "stress": r"stress|pressure|spannung|druck|contrainte|pression|σ",
}
# From jamming on: at larger strains grains overlap by as much as they are wide.
_LIMITS = {"strain": (0.0, LARGEST), "stress": (0.0, 1e15)}
MOST_LOADS = 1000


def read_history(path: str | PathLike[str], quantity: str, unit: str) -> NDArray:
    r"""Return the loads of a file, in the order in which they stand there.

    Parameters
    ----------
    path : path-like
        Text or a workbook. Of many columns that is read whose header names the quantity.
    quantity : {"strain", "stress"}
    unit : {"-", "percent", "Pa", "kPa", "MPa"}

    Returns
    -------
    ndarray, shape (loads,)
        Total strains [-] or stresses [Pa].

    Raises
    ------
    GradingError
        When it is no such file, its words speak against the unit, or loads cannot be; one line for
        each problem, with the line of the file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "oedometer.csv")
    ...     _ = path.write_text("time;stress [kPa]\n0;0\n1;250\n2;100\n")
    ...     read_history(path, "stress", "kPa").tolist()
    [0.0, 250000.0, 100000.0]
    """
    lines = read_sheet(path).lines
    start = next((n for n, line in enumerate(lines) if any(map(is_number, line.cells))), len(lines))
    head, body = lines[:start], lines[start:]
    if not body:
        refuse(path, [f"line 1: no numbers in the file; give one {quantity} on each line"])
    place = _column(path, head, body, quantity)
    # Blanks part the words above a column that stands alone.
    alone = max(len(line.cells) for line in body) == 1
    words = _words([Line(0, [" ".join(line.cells)]) for line in head] if alone else head, place)
    said = next((unit for unit, word in _SAID.items() if re.search(word, words)), None)
    problems = []
    if said and said != unit:
        problems.append(
            f"line {head[-1].number}: the words above the column say {said}, but unit: {unit}; "
            "correct one of them"
        )
    loads = []
    for line in body:
        cell = line.cells[place] if place < len(line.cells) else ""
        if is_number(cell) and math.isfinite(float(cell)):
            loads.append((line.number, float(cell)))
        else:
            problems.append(
                f"line {line.number}: {quantity} = {cell!r} is no finite number; correct it or "
                "remove the line"
            )
    if len(loads) > MOST_LOADS:
        problems.append(
            f"line {loads[MOST_LOADS][0]}: more than {MOST_LOADS} loads: leave some out"
        )
    factor = UNITS[quantity][unit]
    for number, load in loads:
        if problem := load_problem(load * factor, quantity):
            problems.append(f"line {number}: {quantity} = {load:g} {unit}: {problem}")
    refuse(path, problems)
    return np.array([load for _, load in loads]) * factor


def load_problem(load: float, quantity: str) -> str | None:
    """Return why no packing can have a load, and what to check, or None.

    Parameters
    ----------
    load : float
        Total strain [-] or stress [Pa].
    quantity : {"strain", "stress"}

    Returns
    -------
    str or None

    Examples
    --------
    >>> load_problem(0.1, "strain") is None
    True
    >>> load_problem(12.0, "strain")
    'must be from 0, at jamming, to below 0.5; are these percent? Then say unit: percent'
    """
    low, high = _LIMITS[quantity]
    if low <= load < high:
        return None
    if quantity == "stress":
        return f"must be from 0 to below {high:g} Pa: compression is positive"
    allowed = f"must be from 0, at jamming, to below {high:g}"
    if load < low:
        return f"{allowed}: compression is positive"
    if load < 1.0:
        return f"{allowed}: no elastic law is meant for more; end the history before"
    return f"{allowed}; are these percent? Then say unit: percent"


def _column(
    path: str | PathLike[str], head: Sequence[Line], body: Sequence[Line], quantity: str
) -> int:
    """Return the place of the column that holds the loads."""
    width = max(len(line.cells) for line in body)
    if width == 1:
        return 0
    names = [_words(head, place) for place in range(width)]
    found = [n for n, name in enumerate(names) if re.search(_NAMES[quantity], name)]
    if len(found) != 1:
        listed = ", ".join(f"{n}: '{name}'" for n, name in enumerate(names, start=1))
        refuse(
            path,
            [
                f"line {body[0].number}: {width} columns, {listed}; "
                f"{'none' if not found else f'{len(found)} of them'} named {quantity}: name one "
                f"column so, or leave only the loads in the file"
            ],
        )
    return found[0]


def _words(head: Sequence[Line], place: int) -> str:
    """Return what stands above a column."""
    return plain_words(" ".join(line.cells[place] for line in head if place < len(line.cells)))
