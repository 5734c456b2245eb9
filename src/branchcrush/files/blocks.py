"""Blocks of a page that a command makes: the lines between two marks, and tables in Markdown."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

_BEGIN, _END = "<!-- made {}: {} -->", "<!-- end -->"


def filled(page: str, blocks: Mapping[str, Sequence[str]], made: str) -> str:
    """Return a page with the lines of each block between its marks.

    Parameters
    ----------
    page : str
    blocks : mapping of str to sequence of str
        Lines by the name of the block.
    made : str
        What makes them, as the marks say it: "by studies/mixing/compare.py".

    Returns
    -------
    str

    Raises
    ------
    ValueError
        The page has no place for a block.

    Examples
    --------
    >>> page = "<!-- made by a script: one --><!-- end -->"
    >>> filled(page, {"one": ["| a |"]}, "by a script").splitlines()[1]
    '| a |'
    """
    for name, lines in blocks.items():
        begin = _BEGIN.format(made, name)
        place = re.compile(f"({re.escape(begin)}).*?({re.escape(_END)})", re.DOTALL)
        if not place.search(page):
            raise ValueError(f"the page has no place for {begin} and {_END}")
        inside = "\n".join(lines)
        page = place.sub(lambda found, inside=inside: f"{found[1]}\n{inside}\n{found[2]}", page)
    return page


def table(header: Sequence[Any], rows: Sequence[Sequence[Any]]) -> list[str]:
    r"""Return the lines of a table.

    Parameters
    ----------
    header, rows : sequence
        Of cells, whose bars are escaped.

    Returns
    -------
    list of str

    Examples
    --------
    >>> table(["a", "b"], [[1, "x|y"]])
    ['| a | b |', '| --- | --- |', '| 1 | x\\|y |']
    """
    lines = [header, ["---"] * len(header), *rows]
    return [
        f"| {' | '.join(str(cell).replace('|', chr(92) + '|') for cell in line)} |"
        for line in lines
    ]


def number_cell(value: float | None, digits: int = 2) -> str:
    """Return a number of a table, a dash where there is none.

    Parameters
    ----------
    value : float or None
    digits : int
        After the point.

    Returns
    -------
    str

    Examples
    --------
    >>> number_cell(0.125, 1), number_cell(float("nan"))
    ('0.1', '–')
    """
    return "–" if value is None or not np.isfinite(value) else f"{value:.{digits}f}"


def interval_cell(row: Mapping[str, Any], name: str, digits: int = 2, times: float = 1.0) -> str:
    """Return a number of a table with its interval, where there is one.

    Parameters
    ----------
    row : mapping
        With name, name_low and name_high.
    name : str
    digits : int
        After the point.
    times : float
        The numbers are multiplied by it.

    Returns
    -------
    str

    Examples
    --------
    >>> interval_cell({"n": 3.0, "n_low": 2.5, "n_high": 3.5}, "n", 1)
    '3.0 (2.5–3.5)'
    >>> interval_cell({"n": -0.5, "n_low": -1.0, "n_high": -0.1}, "n", 1)
    '-0.5 (-1.0 to -0.1)'
    """
    ends = [row.get(f"{name}{ending}") for ending in ("", "_low", "_high")]
    told = [number_cell(None if end is None else times * end, digits) for end in ends]
    if "–" in told[1:]:
        return told[0]
    to = " to " if told[1].startswith("-") else "–"
    return f"{told[0]} ({told[1]}{to}{told[2]})"
