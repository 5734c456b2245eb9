"""The columns of a table that are meant, with the words above them."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from os import PathLike
from typing import NamedTuple

from branchcrush.files.headers import Words, plain_words
from branchcrush.files.openings import label_of
from branchcrush.files.rows import refuse
from branchcrush.files.sheets import is_number, read_sheet


class TextRow(NamedTuple):
    """The chosen cells of a line, and which line of the file it is, from 1."""

    line: int
    cells: tuple[str, ...]


@dataclass(frozen=True)
class Table:
    """Rows of cells, the words above each column, and what else there is to say.

    Parameters
    ----------
    rows : list of TextRow
    heads : list of str
        What stands above each column.
    title : str
        What stands above all of them, and in comments.
    remarks, problems : list of str

    Examples
    --------
    >>> Table([], ["phi", "cumulative weight %"]).words.opening
    'phi'
    """

    rows: list[TextRow]
    heads: list[str]
    title: str = ""
    remarks: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)

    @property
    def words(self) -> Words:
        """The words above the sizes and above the values."""
        return Words(" ".join(self.heads[:-1]), self.heads[-1], self.title)


def read_columns(
    path: str | PathLike[str],
    names: Sequence[str],
    columns: Sequence[str | int] | None = None,
    sheet: str | int | None = None,
    unfilled: bool = False,
    wide: Sequence[str] = (),
) -> Table:
    r"""Return the rows of a file's table, of the columns that are meant.

    Parameters
    ----------
    path : path-like
    names : sequence of str
        What each column is, for the messages.
    columns : sequence of str or int, optional
        Which ones: words above a column, or its number from 1. Needed where there are more than
        names.
    sheet : str or int, optional
        As for `sheets.read_sheet`.
    unfilled : bool
        Whether a row may lack its last cell.
    wide : sequence of str
        Names of as many columns as a file may have instead.

    Returns
    -------
    Table

    Raises
    ------
    GradingError
        When the file is not to be read at all, or its columns are not known.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("no.,mm,passing\n1,2,100\n2,0.5,0\n")
    ...     read_columns(path, ("opening", "value"), ["mm", 3]).rows
    [TextRow(line=2, cells=('2', '100')), TextRow(line=3, cells=('0.5', '0'))]
    """
    sheet_read = read_sheet(path, sheet)
    lines = sheet_read.lines
    empty = _empty_columns(lines) if columns is None else 0
    lines = [(line.number, line.cells[empty:]) for line in lines]
    start = _first_row(lines, columns)
    head, body = lines[:start], lines[start:]
    above = _above(head, body)
    title = " ".join(
        [*sheet_read.comments, *(" ".join(cells) for _, cells in head if not _is_head(cells, body))]
    )
    if columns is None:
        width = _width(body)
        names = wide if wide and width == len(wide) else names
        if width > len(names):
            refuse(path, [_ask_for_columns(body, width, above, names)])
        places = list(range(len(names)))
    else:
        places, problems = _places(columns, above, body)
        refuse(path, problems)
    heads = [above[place] if place < len(above) else "" for place in places]
    rows, problems = [], []
    for number, cells in body:
        if unfilled and len(cells) == len(places) - 1:
            cells = [*cells, ""]
        chosen, wrong = _chosen(cells, places, names, columns is None)
        if wrong:
            problems.append(f"line {number}: {wrong}")
        elif chosen:
            rows.append(TextRow(number, chosen))
    remarks = list(sheet_read.remarks)
    if any(heads):
        remarks.append("the columns are " + " and ".join(f'"{name}"' for name in heads))
    return Table(rows, heads, title, remarks, problems)


def _empty_columns(lines):
    """Return how many columns at the left hold nothing."""
    return min(
        (next(place for place, cell in enumerate(line.cells) if cell) for line in lines), default=0
    )


def _is_label(cell):
    return label_of(cell).kind not in ("words", "total")


def _first_row(lines, columns):
    """Return the place of the first line that is a row, not words about the table."""
    for place, (_, cells) in enumerate(lines):
        numbers = sum(map(is_number, cells))
        begins = _is_label(cells[0]) if columns is None else numbers > 1
        if begins or (numbers and not _words_follow(lines[place + 1 :])):
            return place
    return len(lines)


def _words_follow(lines):
    """Return whether a header comes before the next row."""
    for _, cells in lines:
        if _is_label(cells[0]) and any(map(is_number, cells)):
            return False
        if len([cell for cell in cells if cell]) > 1 and not any(map(is_number, cells)):
            return True
    return False


def _width(body):
    counts = Counter(len(cells) for _, cells in body)
    return max(counts, key=lambda width: (counts[width], -width), default=0)


def _is_head(cells, body):
    """Return whether a line above the rows has a word for each column."""
    filled = [cell for cell in cells if cell]
    wide = max((len(row) for _, row in body), default=2)
    return len(filled) > 1 and len(cells) <= wide and not any(map(is_number, filled))


def _above(head, body):
    """Return what stands above each column, of all lines that name columns."""
    above: list[str] = []
    for _, cells in head:
        if _is_head(cells, body):
            above += [""] * (len(cells) - len(above))
            for place, cell in enumerate(cells):
                above[place] = f"{above[place]} {cell}".strip()
    return above


def _ask_for_columns(body, width, above, names):
    """Return the question which columns are meant, with lines to paste."""
    named = [above[place] if place < len(above) else "" for place in range(width)]
    listed = ", ".join(
        f"{place}: '{name}'" if name else str(place) for place, name in enumerate(named, start=1)
    )
    number, cells = body[0]
    sizes = [place for place, name in enumerate(named) if _is_of_sizes(name)]
    values = [place for place, name in enumerate(named) if Words(value=name).values()]
    known = len(names) == 2 and len(sizes) == len(values) == 1 and sizes != values
    places = [sizes[0], values[0]] if known else range(len(names))
    pair = ", ".join(str(place + 1) for place in places)
    return (
        f"line {number}: {len(cells)} columns, {' | '.join(cells)}; must have {len(names)}: "
        f"{', '.join(names)}. The columns are {listed}: choose by name or number, as in "
        f"`columns: [{pair}]`. Decimal commas need semicolons between columns"
    )


def _is_of_sizes(name):
    words = Words(opening=name)
    return bool(words.openings() or words.units())


def _places(columns, above, body):
    """Return where the chosen columns are, and which are not there."""
    width = max([len(above), *(len(cells) for _, cells in body)], default=0)
    known = {plain_words(name): place for place, name in reversed(list(enumerate(above))) if name}
    twice = [name for name, many in Counter(map(plain_words, above)).items() if many > 1 and name]
    listed = ", ".join(f"{place}: '{name}'" for place, name in enumerate(above, start=1))
    places, problems = [], []
    for column in columns:
        word = plain_words(str(column).replace(",", "."))
        known_word = next((name for name in known if word in (name, name.replace(",", "."))), None)
        if isinstance(column, int):
            if 1 <= column <= width:
                places.append(column - 1)
            else:
                problems.append(f"columns: {column}: there are {width}, counted from 1")
        elif known_word is not None and known_word not in twice:
            places.append(known[known_word])
        elif known_word is not None:
            problems.append(f"columns: '{column}' stands above more than one: give its number")
        else:
            near = get_close_matches(word, list(known), n=1)
            hint = f"; did you mean '{above[known[near[0]]]}'?" if near else ""
            what = f"the columns are {listed}" if listed else "no words stand above the numbers"
            problems.append(f"columns: '{column}': there is none; {what}{hint}")
    if not problems and len(set(places)) < len(places):
        problems.append("columns: the same one is chosen twice: choose different ones")
    return places, problems


def _chosen(cells, places, names, every):
    """Return the cells of a row that are meant, none of a blank row, and what is wrong with it."""
    if every and len(cells) != len(places) and not (len(cells) < len(places) and _spoken(cells)):
        return (), (
            f"{len(cells)} column{'s' * (len(cells) != 1)}, {' | '.join(cells)}; must have "
            f"{len(places)}: {', '.join(names)}. Decimal commas need semicolons between columns"
        )
    chosen = [cells[place] if place < len(cells) else "" for place in places]
    # The word for the pan or the total may stand in a column of its own.
    if label_of(chosen[0]).kind == "words" and (spoken := _spoken(cells)):
        chosen[0] = spoken
    return (tuple(chosen) if any(chosen) else ()), ""


def _is_spoken(cell):
    return label_of(cell).kind in ("pan", "total")


def _spoken(cells):
    """Return the word for the pan or the total, if a row has one."""
    return next((cell for cell in cells if _is_spoken(cell)), "")
