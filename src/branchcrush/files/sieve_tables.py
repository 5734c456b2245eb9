"""The curve of a sieving from the rows of its table, whatever its columns are declared to be."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise

from branchcrush.errors import GradingError
from branchcrush.files.columns import Table, TextRow
from branchcrush.files.declared import Declared
from branchcrush.files.openings import Label, label_of, size_of
from branchcrush.files.rows import Row
from branchcrush.files.sheets import is_number

NAMES = {
    "percent_finer": "percent finer",
    "percent_coarser": "percent coarser",
    "percent_retained": "percent retained",
    "mass_retained": "mass retained",
}
# Percent that are rounded do not sum to 100, and grams are lost [of the sum].
_ROUNDED, _LOST = 0.01, 0.005


@dataclass
class SieveCurve:
    """A curve by increasing opening, what is wrong with its table, and what was understood.

    Parameters
    ----------
    rows : list of Row
        Opening in the declared unit, and percent finer.
    problems, remarks : list of str

    Examples
    --------
    >>> SieveCurve([Row(1, (0.5, 0.0)), Row(2, (2.0, 100.0))]).problems
    []
    """

    rows: list[Row] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)


def sieve_curve(table: Table, declared: Declared) -> SieveCurve:
    """Return the curve of a sieving, its table read as it is declared.

    Parameters
    ----------
    table : Table
        Of openings and values.
    declared : Declared

    Returns
    -------
    SieveCurve

    Examples
    --------
    >>> rows = [TextRow(1, ("2", "0")), TextRow(2, ("1", "30")), TextRow(3, ("pan", "10"))]
    >>> curve = sieve_curve(Table(rows, ["", ""]), Declared(values="mass_retained"))
    >>> [row.values for row in curve.rows]
    [(1.0, 25.0), (2.0, 100.0)]
    """
    name = NAMES[declared.kind]
    rows, pans, totals, problems = _parsed(table.rows, declared, name)
    if declared.kind.endswith("retained"):
        kept, more = _each_once(rows, name, again=False)
        curve = _from_retained(kept, pans, totals, declared) if not problems + more else None
    else:
        kept, more = _each_once(rows, name, again=True)
        curve = None if problems + more else _from_cumulative(kept, pans, totals, declared, name)
        # A slip below another slip is told at once.
        more += _wrong_order(kept, declared, name) if curve is None else []
    problems += more
    if len(kept) < 2 and not problems:
        where = f"line {kept[0].line}: one row" if kept else "line 1: no row"
        problems = [f"{where} of numbers; must be two or more different ones: add the rest"]
    if curve is None or problems:
        return SieveCurve([], problems)
    return curve


def value_of(cell: str) -> float | None:
    """Return the number of a cell, which may say percent or grams, or None.

    Parameters
    ----------
    cell : str

    Returns
    -------
    float or None

    Examples
    --------
    >>> value_of("12.5 %"), value_of("12.5 g"), value_of("all"), value_of("inf")
    (12.5, 12.5, None, None)
    """
    bare = cell.strip().rstrip("%").removesuffix("g").strip()
    number = float(bare) if is_number(bare) else math.nan
    return number if math.isfinite(number) else None


def sum_of(values: Iterable[float]) -> float:
    """Return a sum that order and rounding do not change; inf where it is beyond all numbers.

    Parameters
    ----------
    values : iterable of float

    Returns
    -------
    float

    Examples
    --------
    >>> sum_of([0.1] * 10), sum_of([1e308, 1e308])
    (1.0, inf)
    """
    try:
        return math.fsum(values)
    except OverflowError:
        return math.inf


def _parsed(rows, declared, name):
    """Return the rows of sieves, of the pan, of totals, and what is wrong with the others."""
    most = 100.0 if declared.kind != "mass_retained" else math.inf
    labels = [label_of(row.cells[0]) for row in rows]
    smallest = min((size for label in labels if (size := _size(label, declared)) > 0), default=0.0)
    sieves, pans, totals, problems = [], [], [], []
    for row, label in zip(rows, labels, strict=True):
        value = value_of(row.cells[1])
        if label.kind == "total":
            totals.append((row.line, value))
        elif _is_pan(label, declared, smallest):
            if value is None and row.cells[1]:
                problems.append(_no_number(row, name, row.cells[1]))
            elif value is not None and not 0 <= value <= most:
                problems.append(_out_of_range(row, name, value, most))
            else:
                pans.append((row.line, value))
        else:
            wrong = _wrong_row(row, label, value, declared, name, most)
            problems += wrong
            if not wrong:
                sieves.append(Row(row.line, (_size(label, declared), value)))
    if len(pans) > 1:
        problems.append(f"line {pans[1][0]}: a second row of the pan: remove one")
    return sieves, pans, totals, problems


def _size(label: Label, declared: Declared) -> float:
    """Return the size that a label means, 0 if it means none."""
    try:
        return size_of(label, declared.scale_of_openings, declared.unit)
    except GradingError:
        return 0.0


def _is_pan(label, declared, smallest):
    if label.kind == "pan":
        return True
    if label.kind == "number" and declared.scale_of_openings != "phi":
        return label.value == 0
    if label.kind != "below" or not declared.kind.endswith("retained"):
        return False
    return _size(label, declared) <= smallest * (1 + 1e-9)


def _wrong_row(row, label, value, declared, name, most):
    """Return what keeps a row from being an opening and a value."""
    problems = []
    if label.kind == "words":
        problems.append(_no_number(row, "opening", row.cells[0]))
    else:
        try:
            size = size_of(label, declared.scale_of_openings, declared.unit)
            if not size > 0:
                problems.append(
                    f"line {row.line}: opening = {label.value:g}; must be above 0: correct or "
                    "remove it"
                )
        except GradingError as error:
            problems.append(
                f"line {row.line}: opening = {label.text!r}: {error}; openings: "
                f"{declared.scale_of_openings}"
            )
    if value is None:
        problems.append(_no_number(row, name, row.cells[1]))
    elif not 0 <= value <= most:
        problems.append(_out_of_range(row, name, value, most))
    return problems


def _out_of_range(row: TextRow, name: str, value: float, most: float) -> str:
    allowed = "not be negative" if most == math.inf else f"lie between 0 and {most:g}"
    return f"line {row.line}: {name} = {value:g}; must {allowed}: correct it"


def _no_number(row: TextRow, name: str, cell: str) -> str:
    comma = ". Decimal commas need semicolons between columns" if set(cell) & set(", ") else ""
    return (
        f"line {row.line}: {name} = {cell!r} is no finite number; correct it or remove the "
        f"line{comma}"
    )


def _each_once(rows, name, again):
    """Return the rows by size, each once, and which sizes have two values, or are there again."""
    kept, problems = {}, []
    for row in sorted(rows, key=lambda row: row.values[0]):
        first = kept.setdefault(row.values[0], row)
        if first is not row and not (again and first.values == row.values):
            problems.append(
                f"line {row.line}: opening {row.values[0]:g} has {name} = {row.values[1]:g} here "
                f"and {first.values[1]:g} on line {first.line}; it must have one: remove a line"
            )
    return list(kept.values()), problems


def _wrong_order(rows, declared, name):
    """Return where a cumulative curve turns back."""
    finer = declared.kind == "percent_finer"
    turn, than = ("fall", "less") if finer else ("rise", "more")
    return [
        f"line {high.line}: {name} = {high.values[1]:g} at opening {high.values[0]:g} is {than} "
        f"than {low.values[1]:g} at the smaller {low.values[0]:g} on line {low.line}; it must not "
        f"{turn} as openings grow: correct one of them"
        for low, high in pairwise(rows)
        if (high.values[1] < low.values[1] if finer else high.values[1] > low.values[1])
    ]


def _from_cumulative(rows, pans, totals, declared, name):
    problems = _wrong_order(rows, declared, name)
    finer = declared.kind == "percent_finer"
    whole = 0.0 if finer else 100.0
    for line, value in pans:
        if value is not None and abs(value - whole) > 100 * _ROUNDED:
            problems.append(
                f"line {line}: {name} = {value:g} at the pan; must be {whole:g}, since no grain is "
                "finer: correct it or say what values are"
            )
    remarks = [f"line {line}: the pan's row says no size and is passed over" for line, _ in pans]
    remarks += [f"line {line}: the row of the total is passed over" for line, _ in totals]
    if not finer:
        rows = [Row(row.line, (row.values[0], 100.0 - row.values[1])) for row in rows]
    return SieveCurve(rows, problems, remarks) if not problems else SieveCurve([], problems)


def _from_retained(rows, pans, totals, declared):
    """Return the curve of what each sieve holds, the pan's below the last of them."""
    pan = sum(value or 0.0 for _, value in pans)
    whole = sum_of([pan, *(row.values[1] for row in rows)])
    problems = [
        f"line {line}: the total is {value:g}, and the rows sum to {whole:g}: a row is missing or "
        "wrong: correct it, or the total"
        for line, value in totals
        if value is not None and abs(value - whole) > _LOST * max(whole, value) + 1e-9
    ]
    first = rows[0].line if rows else 1
    if declared.kind == "percent_retained" and abs(whole - 100) > 100 * _ROUNDED:
        problems.append(_wrong_sum(first, whole, bool(pans)))
    if whole == math.inf:
        problems.append(f"line {first}: the masses sum to more than any number: give them in grams")
    if whole <= 0:
        problems.append(f"line {first}: nothing is retained on any sieve: one must hold something")
    if problems:
        return SieveCurve([], problems)
    curve = []
    for place, row in enumerate(rows):
        # Exact, so that a sieve that holds nothing has 100 % below it.
        below = math.fsum([pan, *(finer.values[1] for finer in rows[:place])])
        curve.append(Row(row.line, (row.values[0], 100.0 * below / whole)))
    remarks = [
        f"line {line}: the pan holds {value or 0:g}, {(value or 0) / whole:.2%} of the whole, "
        f"below the last sieve, {rows[0].values[0]:g} {declared.unit}"
        for line, value in pans
        if rows
    ]
    remarks += [
        f"line {line}: the row of the total has no number and is passed over"
        if value is None
        else f"line {line}: the total agrees with the sum, {whole:g}"
        for line, value in totals
    ]
    return SieveCurve(curve, [], remarks)


def _wrong_sum(line, whole, pan):
    words = f"line {line}: percent retained sum to {whole:g}, and must to 100: "
    if abs(whole - 1) <= _ROUNDED:
        return words + "these are fractions; multiply by 100, or say values: mass_retained"
    if whole < 100 and not pan:
        return (
            words + f"if the other {100 - whole:g} % passed the last sieve, add a row for the pan, "
            f"pan and {100 - whole:g}; else say what values are (key values)"
        )
    return words + "a row is missing or twice, or values are something else (key values)"
