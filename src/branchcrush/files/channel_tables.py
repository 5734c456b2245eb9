"""Channels and densities from the rows of a table."""

import re

from branchcrush.errors import GradingError
from branchcrush.files.channel_edges import edges_of_channels
from branchcrush.files.channel_readings import against_density, against_histogram
from branchcrush.files.columns import Table
from branchcrush.files.declared import Declared
from branchcrush.files.openings import label_of, size_of
from branchcrush.files.rows import Row
from branchcrush.files.sieve_tables import sum_of, value_of

_RANGE = re.compile(r"\s*(?P<low>[^\s].*?)\s*(?:-|–|—|\.\.|\bto\b|\bbis\b|/)\s*(?P<high>\d.*)")


def density_rows(table: Table, declared: Declared) -> tuple[list[Row], list[str]]:
    """Return the rows of a density by size, and what is wrong with them.

    Parameters
    ----------
    table : Table
    declared : Declared

    Returns
    -------
    rows : list of Row
    problems : list of str

    Examples
    --------
    >>> from branchcrush.files.columns import TextRow
    >>> table = Table([TextRow(1, ("2", "1")), TextRow(2, ("1", "3"))], ["", ""])
    >>> [row.values for row in density_rows(table, Declared())[0]]
    [(1.0, 3.0), (2.0, 1.0)]
    """
    rows, _, problems = _rows(table, declared, "density")
    if len(rows) < 2 and not problems:
        where = f"line {rows[0].line}: one row" if rows else "line 1: no row"
        problems.append(f"{where} of numbers; must be two or more different ones: add the rest")
    elif rows and not problems and not any(row.values[1] for row in rows):
        lines = sorted(row.line for row in rows)
        problems.append(f"lines {lines[0]} to {lines[-1]}: every density = 0; one must be above 0")
    if not problems:
        problems = against_density(table, declared, rows)
    return rows, problems


def channel_edges(
    table: Table, declared: Declared
) -> tuple[list[float], list[float], list[str], list[str]]:
    """Return the edges of channels, what each holds, remarks, and what is wrong.

    Parameters
    ----------
    table : Table
    declared : Declared

    Returns
    -------
    edges, values : list of float
        n and n - 1, by size, in the unit; empty if there are problems.
    remarks, problems : list of str

    Examples
    --------
    >>> from branchcrush.files.columns import TextRow
    >>> table = Table([TextRow(1, ("1-2", "30")), TextRow(2, ("2-4", "70"))], ["", ""])
    >>> channel_edges(table, Declared(sizes="edges"))[:2]
    ([1.0, 2.0, 4.0], [30.0, 70.0])
    """
    pairs = _pairs(table)
    if pairs is not None:
        if declared.sizes != "edges":
            return (
                [],
                [],
                [],
                [
                    f"line {table.rows[0].line}: both edges of each channel are given: say "
                    "sizes: edges"
                ],
            )
        rows, totals, problems = _rows(pairs, declared, "value", edges=True)
    else:
        rows, totals, problems = _rows(table, declared, "value", unfilled=declared.sizes == "edges")
    if not rows and not problems:
        problems = ["line 1: no row of numbers; give a size and a value of each channel"]
    if problems:
        return [], [], [], problems
    whole = sum_of(row.values[-1] for row in rows if row.values[-1] is not None)
    problems = [
        f"line {line}: the total is {total:g}, and the rows sum to {whole:g}: a row is missing or "
        "wrong: correct it, or the total"
        for line, total in totals
        if total is not None and abs(total - whole) > 0.005 * max(whole, total)
    ]
    if not problems and not whole > 0:
        problems.append("line 1: no channel holds anything; one must hold more than 0")
    edges, values, remarks, wrong = ([], [], [], [])
    if not problems:
        edges, values, remarks, wrong = edges_of_channels(rows, declared)
    problems += against_histogram(table, declared, rows) + wrong
    return ([], [], [], problems) if problems else (edges, values, remarks, [])


def _pairs(table):
    """Return a table of lower, upper and value, if the file has both edges, else None."""
    if len(table.heads) == 3:
        return table
    cells = [_RANGE.fullmatch(row.cells[0]) for row in table.rows]
    if not any(cells) or any(label_of(row.cells[0]).kind == "number" for row in table.rows):
        return None
    rows = [
        row._replace(cells=(match["low"], match["high"], row.cells[-1]) if match else row.cells)
        for row, match in zip(table.rows, cells, strict=True)
    ]
    return Table(rows, [*table.heads, ""], table.title)


def _rows(table, declared, name, edges=False, unfilled=False):
    """Return rows of sizes and a value by size, totals, and problems."""
    rows, totals, problems = [], [], []
    for line, cells in table.rows:
        labels, value = [label_of(cell) for cell in cells[:-1]], value_of(cells[-1])
        if labels[0].kind in ("total", "pan"):
            if labels[0].kind == "total":
                totals.append((line, value))
            elif value:
                problems.append(f"line {line}: a channel of the pan has no size: give its edges")
            continue
        wrong = []
        sizes = []
        for label in labels:
            try:
                sizes.append(size_of(label, "size", declared.unit))
            except GradingError as error:
                no_number = f"{label.text!r} is no finite number"
                words = error if label.kind == "number" else no_number
                wrong.append(f"size = {words}; correct it or remove the line")
        wrong += [
            f"size = {size:g}; must be above 0: correct or remove it"
            for size in sizes[:1]
            if size <= 0
        ]
        if value is None and not (unfilled and not cells[-1]):
            wrong.append(
                f"{name} = {cells[-1]!r} is no finite number; correct it or remove the line"
            )
        elif value is not None and value < 0:
            wrong.append(f"{name} = {value:g}; must not be negative: correct it")
        problems += [f"line {line}: {words}" for words in wrong]
        if not wrong:
            rows.append(Row(line, (*sizes, value)))
    kept = {}
    for row in sorted(rows, key=lambda row: row.values[0]):
        first = kept.setdefault(row.values[0], row)
        if first.values != row.values:
            problems.append(
                f"line {row.line}: size {row.values[0]:g} has {name} = {_shown(row.values[-1])} "
                f"here and {_shown(first.values[-1])} on line {first.line}; it must have one: "
                "remove a line"
            )
    return list(kept.values()), totals, problems


def _shown(value):
    return "nothing" if value is None else f"{value:g}"
