"""Rows of numbers from text files as spreadsheets, sieving machines and people write them."""

import math
from collections.abc import Sequence
from os import PathLike
from typing import NamedTuple

from branchcrush.errors import GradingError
from branchcrush.files.sheets import is_number, read_sheet

# Of a file that is wrong on every line, the first problems tell enough.
_SHOWN = 20
# Nor does the end of a line that is nothing but a cell.
_LONGEST = 2000
_DECIMAL_COMMAS = "Decimal commas need semicolons between columns"


class Row(NamedTuple):
    """The numbers of a line, and which line of the file it is, from 1."""

    line: int
    values: tuple[float, ...]


def read_rows(path: str | PathLike[str], columns: Sequence[str]) -> tuple[list[Row], list[str]]:
    r"""Return the rows of a text file of numbers, and what is wrong with its other lines.

    Lines are those of `sheets.read_sheet`. Lines of words above the numbers are passed over.

    Parameters
    ----------
    path : path-like
    columns : sequence of str
        Name of each column, for the messages.

    Returns
    -------
    rows : list of Row
    problems : list of str
        One line for each, as `refuse` takes them.

    Raises
    ------
    GradingError
        When the file is missing, empty or no text.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("opening; finer\n0,5; 0\n8; all\n")
    ...     read_rows(path, ("opening", "finer"))
    ([Row(line=2, values=(0.5, 0.0))],
     ["line 3: finer = 'all' is no finite number; correct it or remove the line"])
    """
    rows, problems = [], []
    for number, cells in read_sheet(path).lines:
        if not rows and not problems and not any(map(is_number, cells)):
            continue
        wrong = _wrong(cells, columns)
        problems += [f"line {number}: {problem}" for problem in wrong]
        if not wrong:
            rows.append(Row(number, tuple(map(float, cells))))
    return rows, problems


def refuse(path: str | PathLike[str], problems: Sequence[str]) -> None:
    """Raise GradingError with one line for each problem of a file; return if there is none.

    Parameters
    ----------
    path : path-like
        Begins each line.
    problems : sequence of str
        From `read_rows`; of more than 20 the others are counted, and long ones are cut.

    Raises
    ------
    GradingError

    Examples
    --------
    >>> refuse("sand.csv", [])
    >>> refuse("sand.csv", ["line 2: opening = 0"])
    Traceback (most recent call last):
    branchcrush.errors.GradingError: sand.csv, line 2: opening = 0
    """
    lines = [
        f"{path}, {problem if len(problem) <= _LONGEST else problem[:_LONGEST] + '...'}"
        for problem in problems[:_SHOWN]
    ]
    more = len(problems) - _SHOWN
    if more > 0:
        lines.append(f"{path}: and {more} more problem{'s' * (more != 1)}")
    if lines:
        raise GradingError("\n".join(lines))


def _wrong(cells, columns):
    """Return what keeps cells from being one number for each column."""
    if len(cells) != len(columns):
        return [
            f"{len(cells)} column{'s' * (len(cells) != 1)}, {' | '.join(cells)}; must have "
            f"{len(columns)}: {', '.join(columns)}. {_DECIMAL_COMMAS}"
        ]
    return [
        f"{name} = {cell!r} is no finite number; correct it or remove the line"
        + (f". {_DECIMAL_COMMAS}" if set(cell) & set(", ") else "")
        for name, cell in zip(columns, cells, strict=True)
        if not (is_number(cell) and math.isfinite(float(cell)))
    ]
