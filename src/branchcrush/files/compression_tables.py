"""Compression curves as laboratories write them: stress, and void ratio or strain."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from os import PathLike
from typing import Literal

import numpy as np

from branchcrush.files.columns import Table, read_columns
from branchcrush.files.headers import plain_words
from branchcrush.files.rows import Row, refuse
from branchcrush.files.sheets import is_number

Values = Literal["void_ratio", "strain", "percent_strain"]

# [Pa]
_UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6}
_UNIT_WORDS = {
    "Pa": r"(?<![a-z])pa(?![a-z])|\bn ?/ ?m(2|\^2)",
    "kPa": r"\bkpa\b|\bkn ?/ ?m(2|\^2)",
    "MPa": r"\bmpa\b|\bmn ?/ ?m(2|\^2)|\bn ?/ ?mm(2|\^2)",
    "none that is read: convert them": r"\bpsi\b|\bbars?\b|\bgpa\b|\btsf\b|\bksi\b|\bkg(f)? ?/ ?cm",
}
_STRESS = (
    r"\bstress\b|\bpressure\b|\bsigma\b|σ|\bspannung|\bdruck\b|\bcontrainte|\bpression\b|\bload\b"
)
_VALUE_WORDS = {
    "void_ratio": r"\bvoids? ratio\b|\bporenzahl\b|\bindice des vides\b|^e( ?[\[(].*)?$",
    "percent_strain": r"(strain|dehnung|stauchung|deformation|epsilon|ε).*(%|percent|prozent)",
    "strain": r"strain|dehnung|stauchung|deformation|epsilon|ε",
}
# A void ratio beyond this is a percent, or none.
_LARGEST_VOID_RATIO = 20.0
# In any of the units.
_LARGEST_STRESS = 1e15
_NAMES = {"void_ratio": "void ratio", "strain": "strain", "percent_strain": "percent strain"}
# Of first loading: two parameters and what tells how sure they are.
FEWEST_ROWS = 5


@dataclass(frozen=True)
class CompressionTable:
    """The first loading of a compression test.

    Parameters
    ----------
    stress : ndarray, shape (n,)
        Axial, increasing, above 0 [Pa].
    strain : ndarray, shape (n,)
        Volumetric, from the beginning of the test [-].
    remarks : list of str
        How the file was read.

    Examples
    --------
    >>> CompressionTable(np.array([1e6]), np.array([0.01])).remarks
    []
    """

    stress: np.ndarray
    strain: np.ndarray
    remarks: list[str] = field(default_factory=list)


def read_compression(
    path: str | PathLike[str],
    values: Values,
    stress_unit: str,
    columns: Sequence[str | int] | None = None,
    sheet: str | int | None = None,
    initial_void_ratio: float | None = None,
) -> CompressionTable:
    r"""Return the first loading of a compression test from a file of two columns.

    .. math:: \epsilon = 1 - \frac{1 + e}{1 + e_0}

    Rows are in the order of the test. Those of unloading and reloading, where the stress is not
    above all before, are left out, and so is one without stress; the remarks tell.

    Parameters
    ----------
    path : path-like
    values : {"void_ratio", "strain", "percent_strain"}
        What stands beside each stress; compression is positive.
    stress_unit : {"Pa", "kPa", "MPa"}
    columns : sequence of str or int, optional
        The stresses' and the values', as for `columns.read_columns`.
    sheet : str or int, optional
        As for `sheets.read_sheet`.
    initial_void_ratio : float, optional
        e_0, needed with void ratios [-].

    Returns
    -------
    CompressionTable

    Raises
    ------
    GradingError
        When it is no such file, or its words and numbers speak against what is declared; one line
        for each problem, with the line of the file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("Spannung [MPa]; Porenzahl\n0;0,6\n1;0,58\n2;0,56\n"
    ...                         "4;0,52\n1;0,53\n8;0,44\n16;0,36\n")
    ...     table = read_compression(path, "void_ratio", "MPa", initial_void_ratio=0.6)
    >>> table.stress.tolist(), table.strain.round(4).tolist()
    ([1000000.0, 2000000.0, 4000000.0, 8000000.0, 16000000.0],
     [0.0125, 0.025, 0.05, 0.1, 0.15])
    """
    name = _NAMES[values]
    table = read_columns(path, ("stress", name), columns, sheet)
    against = _words_against(table, values, stress_unit)
    # What is wrong with numbers of another kind says little.
    refuse(path, table.problems + against)
    rows, problems = _numbers(table, name)
    problems += _impossible(rows, values, initial_void_ratio)
    problems += _twice(rows, name)
    refuse(path, problems)
    loading, remarks = _first_loading(rows)
    refuse(path, _too_few(rows, loading))
    stress, value = np.array([row.values for row in loading]).T
    if values == "void_ratio":
        assert initial_void_ratio is not None
        strain = 1.0 - (1.0 + value) / (1.0 + initial_void_ratio)
    else:
        strain = value / (100.0 if values == "percent_strain" else 1.0)
    return CompressionTable(stress * _UNITS[stress_unit], strain, table.remarks + remarks)


def _words_against(table: Table, values: Values, stress_unit: str) -> list[str]:
    """Return where the words above the columns speak against what is declared."""
    first, second = (plain_words(head) for head in (table.heads[0], table.heads[-1]))
    turned = _values_said(first) and not re.search(_STRESS, first) and not _values_said(second)
    if turned:
        return [
            f'the words "{table.heads[0]}" stand above the first column and "{table.heads[-1]}" '
            "above the second; the stresses' column comes first: set columns: "
            f"['{table.heads[-1]}', '{table.heads[0]}']"
        ]
    against = []
    units = _units(first) or _units_in_brackets(plain_words(table.title))
    if units and stress_unit not in units:
        heading = table.heads[0] or table.title
        against.append(_against(heading, "stress_unit", " or ".join(sorted(units)), stress_unit))
    said = _values_said(second)
    # "strain" alone may be in percent.
    if said and values != said and not (said == "strain" and values == "percent_strain"):
        against.append(_against(table.heads[-1], "values", said, values))
    return against


def _against(heading: str, key: str, said: str, declared: str) -> str:
    return (
        f'the file and the keys disagree: the words "{heading}" say {key}: {said}, not {key}: '
        f"{declared}; correct the key, or the words"
    )


def _units(text: str) -> set[str]:
    return {unit for unit, word in _UNIT_WORDS.items() if re.search(word, text)}


def _units_in_brackets(text: str) -> set[str]:
    """Return the units of a title, which speaks of more than stresses."""
    return set().union(*(_units(part) for part in re.findall(r"[\[(]([^][()]*)[\])]", text)))


def _values_said(text: str) -> str | None:
    return next((kind for kind, word in _VALUE_WORDS.items() if re.search(word, text)), None)


def _numbers(table: Table, name: str) -> tuple[list[Row], list[str]]:
    rows, problems = [], []
    for line, cells in table.rows:
        wrong = [
            f"line {line}: {what} = {cell!r} is no finite number; correct it or remove the line"
            for what, cell in zip(("stress", name), cells, strict=True)
            if not (is_number(cell) and math.isfinite(float(cell)))
        ]
        problems += wrong
        if not wrong:
            rows.append(Row(line, tuple(map(float, cells))))
    if not rows and not problems:
        problems.append(f"line 1: no numbers in the file; give a stress and a {name} on each line")
    return rows, problems


def _too_few(rows: list[Row], loading: list[Row]) -> list[str]:
    """Return whether rows of first loading are too few for a fit, and where they end."""
    if len(loading) >= FEWEST_ROWS:
        return []
    falls = next((row for above, row in pairwise(rows) if row.values[0] < above.values[0]), None)
    where = f"line {rows[0].line}" if falls is None else f"line {falls.line}: the stress falls here"
    return [
        f"{where}: {len(loading)} row{'s' * (len(loading) != 1)} of first loading, each with a "
        f"stress above all before it; a fit needs {FEWEST_ROWS}: give rows in the order of the "
        "test, from the smallest stress on"
    ]


def _impossible(rows: list[Row], values: Values, initial: float | None) -> list[str]:
    """Return which numbers no test has."""
    problems, name, above = [], _NAMES[values], []
    for line, (stress, value) in rows:
        if stress < 0:
            problems.append(
                f"line {line}: stress = {stress:g} is below 0; compression is positive here: "
                "change the sign of the column"
            )
        elif stress > _LARGEST_STRESS:
            problems.append(f"line {line}: stress = {stress:g} is more than there is: correct it")
        if values == "void_ratio":
            if not 0 < value <= _LARGEST_VOID_RATIO:
                problems.append(
                    f"line {line}: void ratio = {value:g}; must be above 0 and at most "
                    f"{_LARGEST_VOID_RATIO:g}: correct it, or say values"
                )
            elif initial is not None and value > initial:
                above.append((line, value))
        elif value < 0:
            problems.append(
                f"line {line}: {name} = {value:g} is below 0; compression is positive here, and "
                "strain counts from the beginning of the test"
            )
        elif value >= (1 if values == "strain" else 100):
            percent = "; of percent say values: percent_strain" if values == "strain" else ""
            problems.append(
                f"line {line}: {name} = {value:g} would leave no volume; must be below "
                f"{1 if values == 'strain' else 100}{percent}"
            )
    if above:
        line, value = above[0]
        others = len(above) - 1
        more = f", as in {others} more row{'s' * (others != 1)}" if others else ""
        problems.append(
            f"line {line}: void ratio = {value:g} is above initial_void_ratio {initial:g}{more}: "
            "correct either"
        )
    return problems


def _twice(rows: list[Row], name: str) -> list[str]:
    """Return which stresses stand in two rows, one after the other."""
    return [
        f"line {row.line}: stress = {row.values[0]:g} is there twice, also in line {above.line}: "
        f"keep the row whose {name} belongs to it"
        for above, row in pairwise(rows)
        if row.values[0] == above.values[0]
    ]


def _first_loading(rows: list[Row]) -> tuple[list[Row], list[str]]:
    """Return the rows whose stress is above all before, and which are left out."""
    loading, unloaded, unstressed, largest = [], [], [], 0.0
    for row in rows:
        if row.values[0] > largest:
            loading.append(row)
            largest = row.values[0]
        elif row.values[0] == 0.0 and not loading:
            unstressed.append(row.line)
        else:
            unloaded.append(row.line)
    remarks = []
    if unstressed:
        remarks.append(f"line {unstressed[0]} is without stress: the beginning of the test")
    if unloaded:
        lines = ", ".join(map(str, unloaded[:10])) + (", ..." if len(unloaded) > 10 else "")
        remarks.append(
            f"{len(unloaded)} row{'s' * (len(unloaded) != 1)} of unloading or reloading left out "
            f"of the fit (line{'s' * (len(unloaded) != 1)} {lines})"
        )
    return loading, remarks
