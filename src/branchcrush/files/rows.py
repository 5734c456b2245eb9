"""Rows of numbers from text files as spreadsheets, sieving machines and people write them."""

import csv
import math
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import NamedTuple

from branchcrush.errors import GradingError

# Of a file that is wrong on every line, the first problems tell enough.
_SHOWN = 20
_DECIMAL_COMMAS = "Decimal commas need semicolons between columns"


class Row(NamedTuple):
    """The numbers of a line, and which line of the file it is, from 1."""

    line: int
    values: tuple[float, ...]


def read_rows(path: str | PathLike[str], columns: Sequence[str]) -> tuple[list[Row], list[str]]:
    r"""Return the rows of a text file of numbers, and what is wrong with its other lines.

    Columns are parted by semicolons, tabs, commas or blanks; with semicolons a comma is a decimal
    one. Lines of words above the numbers, blank lines, and what follows a # are passed over.

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
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "sand.csv")
    ...     _ = path.write_text("opening; finer\n0,5; 0\n8; all\n")
    ...     read_rows(path, ("opening", "finer"))
    ([Row(line=2, values=(0.5, 0.0))],
     ["line 3: finer = 'all' is no finite number; correct it or remove the line"])
    """
    rows, problems = [], []
    for number, line in enumerate(_content(path).split("\n"), start=1):
        cells = _cells(line.partition("#")[0].strip())
        if not cells or (not rows and not problems and not any(map(_is_number, cells))):
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
        From `read_rows`; of more than 20 the others are counted.

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
    lines = [f"{path}, {problem}" for problem in problems[:_SHOWN]]
    more = len(problems) - _SHOWN
    if more > 0:
        lines.append(f"{path}: and {more} more problem{'s' * (more != 1)}")
    if lines:
        raise GradingError("\n".join(lines))


def _content(path):
    """Return the text of a file, its lines ended by line feeds."""
    path = Path(path)
    if path.is_dir():
        raise GradingError(f"{path}: is a folder; give the name of a file in it")
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        raise GradingError(
            f"{path}: there is no such file in {Path.cwd()}; names are relative to that folder"
        ) from None
    except OSError as error:
        raise GradingError(f"{path}: cannot be read: {error.strerror}") from None
    # The mark that spreadsheets begin "Unicode text" with.
    encoding = "utf-16" if raw[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        text = raw.decode(encoding)
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise GradingError(f"{path}: is no text in UTF-8; save the table as CSV in UTF-8")
    if not text.strip():
        raise GradingError(f"{path}: is empty; write one row of numbers on each line")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _cells(line):
    """Return the words of a line, parted by the first mark that it has."""
    separator = next((mark for mark in ";\t," if mark in line), None)
    if separator is None:
        cells = line.split()
    else:
        cells = [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
    if separator == ";":
        cells = [cell.replace(",", ".") for cell in cells]
    # Spreadsheets end each line with the empty cells of the widest.
    while cells and not cells[-1]:
        cells.pop()
    return cells


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
        if not (_is_number(cell) and math.isfinite(float(cell)))
    ]


def _is_number(cell):
    try:
        float(cell)
    except ValueError:
        return False
    # Python's own 1_000 is no number elsewhere.
    return "_" not in cell
