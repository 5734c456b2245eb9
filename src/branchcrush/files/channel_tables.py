"""Channels and densities from the rows of a table, and whether its words and numbers are theirs."""

import math
import re
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from branchcrush.errors import GradingError
from branchcrush.files.channel_edges import edges_of_channels, regular
from branchcrush.files.columns import Table
from branchcrush.files.declared import Declared
from branchcrush.files.openings import UNITS_IN_MM, label_of, size_of
from branchcrush.files.rows import Row
from branchcrush.files.sieve_tables import value_of
from branchcrush.gradings.tables import from_density, from_histogram

_RANGE = re.compile(r"\s*(?P<low>[^\s].*?)\s*(?:-|–|—|\.\.|\bto\b|\bbis\b|/)\s*(?P<high>\d.*)")
_SUM = 1.0


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
        problems = _against_density(table, declared, rows)
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
                    f"line {table.rows[0].line}: both edges of each channel are given: say sizes: edges"
                ],
            )
        rows, totals, problems = _rows(pairs, declared, "value", edges=True)
    else:
        rows, totals, problems = _rows(table, declared, "value", unfilled=declared.sizes == "edges")
    if problems:
        return [], [], [], problems
    whole = math.fsum(row.values[-1] for row in rows if row.values[-1] is not None)
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
    problems += _against_histogram(table, declared, rows) + wrong
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
            except GradingError:
                wrong.append(
                    f"size = {label.text!r} is no finite number; correct it or remove the line"
                )
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


def _against_both(table, declared):
    """Return which keys the words above the columns speak against, of channels and densities."""
    words, against = table.words, []
    basis = {"volume": "mass"}.get(declared.basis, declared.basis)
    bases = words.bases()
    if bases and basis and basis not in bases:
        against.append(
            f'the words "{words.value}" say basis: {" or ".join(sorted(bases))}, not basis: '
            f"{declared.basis}"
        )
    if words.units() and declared.unit not in words.units():
        against.append(
            f'the words "{words.opening or words.title}" say unit: '
            f"{' or '.join(sorted(words.units()))}, not unit: {declared.unit}"
        )
    if words.openings() and "size" not in words.openings():
        against.append(
            f'the words "{words.opening or words.title}" say that sizes are '
            f"{' or '.join(sorted(words.openings()))}: give form: sieve with openings and values, "
            "or sizes"
        )
    return against


def _against_density(table, declared, rows):
    """Return why a table is no density as it is declared, with what else it can be."""
    words, against = table.words, _against_both(table, declared)
    sizes = [row.values[0] for row in rows]
    values = [row.values[1] for row in rows]
    per, said = declared.per or "size", words.per()
    if words.cumulative():
        against.append(
            f'the words "{words.value}" say a cumulative curve: give form: sieve with values: '
            "percent_finer or percent_coarser"
        )
    elif said and per not in said and not (per != "size" and said <= {"phi", "log_size"}):
        against.append(
            f'the words "{words.value or words.title}" say per: {" or ".join(sorted(said))}, not '
            f"per: {per}" + ("" if declared.per else ", the default")
        )
    if not against and declared.per is None and "size" not in said:
        against += _numbers_against_density(words, sizes, values)
    if not against:
        return []
    return [_density_readings(against, declared, sizes, values)]


def _numbers_against_density(words, sizes, values):
    many, geometric = len(sizes) >= 5, regular(sizes, "log")
    rising = all(high >= low for low, high in pairwise(values))
    if many and rising and values[-1] == 100:
        return ["the values grow to 100, as percent finer do (form: sieve)"]
    if len(sizes) >= 4 and abs(math.fsum(values) - 100) <= _SUM:
        return ["the values sum to 100, as percent in each channel do (form: histogram)"]
    if words.percent():
        return [f'the words "{words.value}" say percent, as of a channel (form: histogram)']
    if many and geometric and not _is_one(np.trapezoid(values, sizes)):
        logs = np.log(sizes)
        whole = np.trapezoid(values, logs)
        if _is_one(whole) or _is_one(whole / math.log(10)) or _is_one(whole / math.log(2)):
            return ["the density integrates to 1 over the logarithm of size, not over size"]
        if len(sizes) >= 8:
            return ["the sizes grow by a constant factor, as of a density per log_size"]
    return []


def _is_one(integral):
    return any(abs(integral / whole - 1) < 0.02 for whole in (1.0, 100.0))


def _density_readings(against, declared, sizes, values):
    """Return the readings of a density, and of channels, with the D50 of each, in one line."""
    basis = "number" if declared.basis == "number" else "mass"
    unit = declared.unit
    read = [
        f"`form: density, per: {per}` D50 = {_median_of_density(sizes, values, basis, per)} {unit}"
        for per in ("size", "log_size")
    ]
    read += _histogram_readings(sizes, values, declared)
    other = "mass" if basis == "number" else "number"
    per = declared.per or "size"
    if any("basis" in words for words in against):
        read.append(
            f"`basis: {other}` D50 = {_median_of_density(sizes, values, other, per)} {unit}"
        )
    return _told(against, read, declared)


def _told(against, read, declared):
    units = [
        f"in `unit: {unit}` each is the same number of {unit}"
        for words in against
        for unit in UNITS_IN_MM
        if f"say unit: {unit}," in words
    ]
    return (
        f"the file and the keys disagree: {'; '.join(against)}. Read as {'; as '.join(read)}"
        f"{''.join('; ' + words for words in units)}. Paste the keys that are meant into the "
        "grading, or correct the words in the file"
    )


def _histogram_readings(sizes, values, declared):
    """Return how channels of these sizes would be read, with the D50 of each."""
    basis = "number" if declared.basis == "number" else "mass"
    read, rows = [], [Row(0, pair) for pair in zip(sizes, values, strict=True)]
    scale = "log" if regular(sizes, "log") else "linear"
    for kind in ("middles", "lower", "upper"):
        keys = Declared(sizes=kind, scale=scale, unit=declared.unit)
        edges, shares, _, wrong = edges_of_channels(rows, keys)
        if not wrong:
            median = from_histogram(edges, shares, basis, scale=scale).mass_ppf(0.5)
            read.append(
                f"`form: histogram, sizes: {kind}, scale: {scale}` D50 = {float(median):.3g} "
                f"{declared.unit}"
            )
    return read


def _median_of_density(
    sizes: Sequence[float], values: Sequence[float], basis: str, per: str
) -> str:
    return f"{float(from_density(sizes, values, basis, per=per).mass_ppf(0.5)):.3g}"


def _against_histogram(table, declared, rows):
    """Return why a table is no histogram as it is declared, with what else it can be."""
    words, against = table.words, _against_both(table, declared)
    if words.cumulative():
        against.append(
            f'the words "{words.value}" say a cumulative curve: give form: sieve with values: '
            "percent_finer or percent_coarser"
        )
    if words.per():
        against.append(
            f'the words "{words.value or words.title}" say a density: give form: density with '
            f"per: {' or '.join(sorted(words.per()))}"
        )
    if words.sizes() and declared.sizes not in words.sizes():
        against.append(
            f'the words "{words.opening}" say sizes: {" or ".join(sorted(words.sizes()))}, not '
            f"sizes: {declared.sizes}"
        )
    values = [row.values[-1] for row in rows if row.values[-1] is not None]
    rising = all(high >= low for low, high in pairwise(values))
    falling = all(high <= low for low, high in pairwise(values))
    whole = max(values, default=0.0) == 100 and len(values) >= 4
    if not against and declared.basis != "number" and whole and (rising or falling):
        against.append(
            "the values go between 0 and 100 without turning, as percent finer or coarser do "
            "(form: sieve)"
        )
    if not against:
        return []
    sizes = [row.values[0] for row in rows]
    filled = [0.0 if row.values[-1] is None else row.values[-1] for row in rows]
    return [_told(against, _histogram_readings(sizes, filled, declared), declared)]
