"""Text files of other codes: plain or packed, their blocks of numbers, and how many digits."""

import io
import os
import re
from collections.abc import Iterable, Sequence
from os import PathLike
from pathlib import Path

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from branchcrush.errors import ReadingError

_PACKED = {".gz": "gzip", ".zst": "zstd", ".bz2": "bz2"}
_MANTISSA = re.compile(r"^[+-]?0*\.?0*(?P<digits>[\d.]*)(?:[eE][+-]?\d+)?$")
_TRUE, _FALSE = (re.compile(rf"\b{word}\b", re.IGNORECASE) for word in ("true", "false"))
# Unpacked: ten million grains and their contacts have less [bytes].
_LARGEST, _BLOCK = 4_000_000_000, 1 << 20
# Over its packed size, of more than so many bytes: numbers are packed to a tenth, what is made to
# fill a memory to a thousandth.
_MOST_TIMES, _FEW = 200, 16_000_000
_MOST_NAMES, _LONGEST_NAME = 20, 60
# So many lines tell how many digits a file has.
_LINES_OF_DIGITS = 200


def text_of(path: str | PathLike[str]) -> str:
    r"""Return the text of a file, plain, gzipped or packed by zstd or bzip2.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    str

    Raises
    ------
    ReadingError
        When it is not there, cannot be unpacked, is no text, or is empty.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "grains.txt")
    ...     _ = path.write_text("x y z\n1 2 3\n")
    ...     text_of(path)
    'x y z\n1 2 3\n'
    """
    kind = _PACKED.get(Path(path).suffix.lower())
    try:
        size = os.path.getsize(path)
        if size > _LARGEST:
            raise _too_large(path)
        data = _unpacked(path, kind, size) if kind else Path(path).read_bytes()
        # Not by utf-8-sig, which copies all of it.
        text = data.decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError:
        raise ReadingError(
            f"{path}: is no text; write it as text (ASCII), not in binary form"
        ) from None
    except FileNotFoundError:
        raise ReadingError(f"{path}: there is no such file") from None
    except OSError as error:
        raise ReadingError(
            f"{path}: cannot be read or unpacked ({error}): is it whole? write it again"
        ) from None
    if not text or text.isspace():
        raise ReadingError(f"{path}: is empty")
    return text


def listed(names: Iterable[str]) -> str:
    """Return names in a list that one can read, however many and long they are.

    Parameters
    ----------
    names : iterable of str

    Returns
    -------
    str

    Examples
    --------
    >>> listed(["x", "y"]), listed("abcdefghijklmnopqrstuvwxyz")[-17:]
    ('x, y', 's, t and 6 others')
    """
    names = [name if len(name) <= _LONGEST_NAME else name[:_LONGEST_NAME] + "..." for name in names]
    more = len(names) - _MOST_NAMES
    return ", ".join(names[:_MOST_NAMES]) + (f" and {more} others" if more > 0 else "")


def _unpacked(path, kind, size):
    """Return what is packed, unless it is more than a text may have: few bytes can stand for it."""
    text = bytearray()
    most = max(_FEW, _MOST_TIMES * size)
    with pa.CompressedInputStream(pa.OSFile(os.fspath(path)), kind) as file:
        while block := file.read(_BLOCK):
            text += block
            if len(text) > _LARGEST:
                raise _too_large(path)
            if len(text) > most:
                raise ReadingError(
                    f"{path}: unpacks to more than {_MOST_TIMES} times its size, which no text of "
                    "numbers does: is it the right file? write it again"
                )
    return text


def _too_large(path):
    return ReadingError(
        f"{path}: has more than {_LARGEST / 1e9:g} GB: write fewer frames into one file"
    )


def lines_of(path: str | PathLike[str]) -> list[str]:
    r"""Return the lines of a text file of which each has an end, as codes write them.

    Parameters
    ----------
    path : path-like
        As for `text_of`.

    Returns
    -------
    list of str
        Without their ends.

    Raises
    ------
    ReadingError
        As `text_of`, and when the last line has no end.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "grains.txt")
    ...     _ = path.write_text("x y z\n1 2 3\n")
    ...     lines_of(path)
    ['x y z', '1 2 3']
    """
    text = text_of(path)
    lines = text.splitlines()
    if not text.endswith("\n"):
        raise ReadingError(
            f"{path}: the file breaks off: its last line, {lines[-1][-40:]!r}, has no end; write "
            "it again, whole"
        )
    return lines


def numbers_of(
    lines: Sequence[str],
    columns: int,
    where: str,
    *,
    first: int,
    delimiter: str | None = None,
    used: Sequence[int] | None = None,
) -> NDArray:
    """Return lines of numbers as an array.

    Parameters
    ----------
    lines : sequence of str
    columns : int
        How many every line has.
    where : str
        Name of the file, for errors.
    first : int
        Number of the first of the lines in the file.
    delimiter : str, optional
        Between the columns; white space without.
    used : sequence of int, optional
        Which of the columns are numbers and wanted; all without.

    Returns
    -------
    ndarray, shape (n, columns) or (n, len(used))
        True and False are 1 and 0.

    Raises
    ------
    ReadingError
        When a line has another number of columns, or something that is no finite number.

    Examples
    --------
    >>> numbers_of(["1 2", "3 4 "], 2, "grains.txt", first=1).tolist()
    [[1.0, 2.0], [3.0, 4.0]]
    """
    chosen = range(columns) if used is None else used
    if not lines:
        return np.empty((0, len(chosen)))
    for place, line in enumerate(lines):
        found = len(line.split(delimiter))
        if found != columns:
            cut = "the file breaks off in it, or it" if place == len(lines) - 1 else "it"
            raise ReadingError(
                f"{where}, line {first + place}: {cut} has {found} columns where {columns} are "
                "due: write the file again, whole"
            )
    text = _TRUE.sub("1", _FALSE.sub("0", "\n".join(lines)))
    try:
        values = np.loadtxt(
            io.StringIO(text), delimiter=delimiter, usecols=chosen, ndmin=2, comments=None
        )
    except ValueError as error:
        raise ReadingError(f"{where}, from line {first}: {_words(error, first)}") from None
    bad = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if bad.size:
        raise ReadingError(
            f"{where}, line {first + int(bad[0])}: holds a number that is not finite"
        )
    return values


def _words(error, first):
    """Return what NumPy says of a cell, with the line of the file."""
    found = re.search(r"string '(.*)' to float64 at row (\d+), column (\d+)", str(error))
    if found:
        text, row, column = found.groups()
        # NumPy counts rows from 0 and columns from 1.
        return f"line {first + int(row)}, column {column}: {text[:60]!r} is no number"
    return f"{error}"[:200]


def significant_digits(lines: Sequence[str], delimiter: str | None = None) -> int:
    """Return how many significant digits the numbers of some lines have, at the most.

    Parameters
    ----------
    lines : sequence of str
        The first 200 are looked at.
    delimiter : str, optional

    Returns
    -------
    int
        0 without numbers.

    Examples
    --------
    >>> significant_digits(["1 -0.00165939 6.28449e-05", "2 0.5 1"])
    6
    """
    most = 0
    for line in lines[:_LINES_OF_DIGITS]:
        for word in line.split(delimiter):
            found = _MANTISSA.match(word.strip())
            if found:
                most = max(most, len(found["digits"].replace(".", "")))
    return most
