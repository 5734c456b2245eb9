"""Lines of cells from a file of text or a workbook, as spreadsheets, machines and people write."""

import csv
import re
from dataclasses import dataclass, field
from os import PathLike
from typing import NamedTuple

from branchcrush.errors import GradingError
from branchcrush.files.decoding import ZIP, decoded, raw_content
from branchcrush.files.spreadsheets import workbook_cells

# A number with a decimal comma or point, as a whole cell but for a unit after it.
# A machine writes some hundred channels on a line.
_LONGEST_LINE = 20_000
_NUMBER = r"[<>]?\s*[-+]?\d*{}\d+(?:[eE][-+]?\d+)?\s*(?:%|[^\W\d]{{1,7}}|\"|'')?"
_COMMA, _POINT = re.compile(_NUMBER.format(",")), re.compile(_NUMBER.format(r"\."))
# A sieve's number after a hash and blanks, and a value: no comment, as likely a row as not.
_HASHED_ROW = re.compile(r"#\s+\d+\s*[;,\t ]\s*[-+\d.,]+\s*%?\s*")


class Line(NamedTuple):
    """The cells of a line, and which line of the file it is, from 1."""

    number: int
    cells: list[str]


@dataclass(frozen=True)
class Sheet:
    """The lines of a file that hold anything, its comments, and what else there is to say.

    Parameters
    ----------
    lines : list of Line
    comments : list of str
    remarks : list of str
        Of other sheets, and of how the bytes were taken.

    Examples
    --------
    >>> Sheet([Line(1, ["2", "100"])]).comments
    []
    """

    lines: list[Line]
    comments: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)


def is_number(cell: str) -> bool:
    """Return whether a cell is a number as Python writes it, without its 1_000.

    Parameters
    ----------
    cell : str

    Returns
    -------
    bool

    Examples
    --------
    >>> is_number("1e-3"), is_number("1_000"), is_number("pan")
    (True, False, False)
    """
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell


def read_sheet(path: str | PathLike[str], sheet: str | int | None = None) -> Sheet:
    r"""Return the lines of cells of a file.

    Columns are parted by semicolons, tabs, commas or blanks. A comma between digits is a decimal
    one where it does not part columns, and where no number of the file has a point. A line that
    begins with # is a comment, and so is what follows a # after numbers; before a digit it is
    none, as in #40.

    Parameters
    ----------
    path : path-like
        A text file or a workbook (.xlsx).
    sheet : str or int, optional
        Which one of a workbook, by name or number; the first when left out.

    Returns
    -------
    Sheet

    Raises
    ------
    GradingError
        When the file is missing, empty, or neither; when there is no such sheet; when a line is
        longer than any table's.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("# sand\nsieve; finer\n#40; 0,5\n")
    ...     read_sheet(path).lines
    [Line(number=2, cells=['sieve', 'finer']), Line(number=3, cells=['#40', '0.5'])]
    """
    raw = raw_content(path)
    if raw[:4] == ZIP:
        return _of_workbook(raw, path, sheet)
    if sheet is not None:
        raise GradingError(f"{path}: sheet = {sheet!r}: is for a workbook (.xlsx): leave it out")
    text = decoded(raw, path)
    comments, written = [], []
    for number, line in _whole_lines(text):
        line, comment = _without_comment(line.strip())
        comments += [comment] if comment else []
        if len(line) > _LONGEST_LINE:
            raise GradingError(
                f"{path}, line {number}: has {len(line)} characters, and a line of a table may "
                f"have {_LONGEST_LINE}: write one row of numbers on each line"
            )
        if line:
            written.append((number, line, _separator(line)))
    # Where marks part columns, a line without any is a title, whatever blanks it has.
    marks = sum(separator is not None for *_, separator in written) > len(written) / 2
    lines = []
    for number, line, separator in written:
        cells = [line] if marks and separator is None else _cells(line, separator)
        if cells:
            lines.append((number, cells, separator))
    return Sheet(_decimal(lines), comments)


def _of_workbook(raw, path, sheet):
    """Return a sheet of a workbook, its lines numbered as the rows are."""
    rows, name, others = workbook_cells(raw, path, sheet)
    lines = []
    for number, cells in enumerate(rows, start=1):
        # A text of its own, as an export writes it; 1,000 might be a thousand.
        cells = [
            cell.replace(",", ".") if _COMMA.fullmatch(cell) and not _thousand(cell) else cell
            for cell in cells
        ]
        while cells and not cells[-1]:
            cells.pop()
        if any(cells):
            lines.append(Line(number, cells))
    if not lines:
        raise GradingError(f"{path}: sheet '{name}' is empty; name another with sheet")
    quoted = ", ".join(f"'{other}'" for other in others)
    remark = f"sheet '{name}' is read; there are others: {quoted} (key sheet)"
    return Sheet(lines, [], [remark] if others and sheet is None else [])


def _whole_lines(text):
    """Yield lines with their numbers; a quoted cell may go over several."""
    begun, kept = 0, ""
    for number, line in enumerate(text.split("\n"), start=1):
        begun = begun if kept else number
        kept = f"{kept} {line}" if kept else line
        # A single mark is one of inches; quotes are at the beginning of a cell.
        if kept.count('"') % 2 and re.search(r'(?:^|[;,\t])\s*"[^"]*$', kept) and len(kept) < 500:
            continue
        yield begun, kept
        kept = ""
    if kept:
        yield begun, kept


def _without_comment(line):
    """Return a line without its comment, and the comment."""
    place = re.search(r"#(?!\d)", line)
    if not place or _HASHED_ROW.fullmatch(line):
        return line, ""
    before, after = line[: place.start()].strip(), line[place.end() :].strip()
    # A header may say "sieve #".
    if before and not re.search(r"\d", before):
        return line, ""
    return before, after


def _separator(line):
    """Return the mark that parts a line's columns: the first of four that it has."""
    separator = next((mark for mark in ";\t," if mark in line), None)
    if separator == ",":
        # 0,5 12,5 is two numbers, since "5 12" is none.
        words, parted = line.split(), [word.strip() for word in line.split(",")]
        numbers = all(is_number(word) or _COMMA.fullmatch(word) for word in words)
        if len(words) > 1 and numbers and not all(map(is_number, parted)):
            return None
    return separator


def _cells(line, separator):
    """Return the words of a line."""
    if separator is None:
        cells = _words(line)
    else:
        cells = [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
    # Spreadsheets end each line with the empty cells of the widest.
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _words(line):
    """Return the cells of a line that blanks part; No. 40 is one."""
    joined = re.sub(r"(?i)\b(no|nr|n°|#)(\.?)\s+(?=\d)", r"\1\2", line)
    return joined.split()


def _thousand(cell):
    return re.search(r",\d{3}\b", cell) is not None


def _decimal(lines):
    """Return the lines with points for decimal commas, where these cannot be anything else."""
    every = [cell for _, cells, _ in lines for cell in cells]
    commas = [cell for cell in every if _COMMA.fullmatch(cell)]
    points = any(_POINT.fullmatch(cell) for cell in every)
    semicolons = any(separator == ";" for _, _, separator in lines)
    # Without semicolons, 1,000 is a thousand as likely as one.
    decimal = commas and not points and (semicolons or not all(map(_thousand, commas)))
    return [
        Line(number, [re.sub(r",(?=\d)", ".", cell) if decimal else cell for cell in cells])
        for number, cells, _ in lines
    ]
