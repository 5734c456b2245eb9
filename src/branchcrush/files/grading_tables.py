"""Gradings as files hold them: the curve of a sieving, a density, channels, sizes of grains."""

from dataclasses import dataclass, field
from os import PathLike

import numpy as np

from branchcrush.files.channel_tables import channel_edges, density_rows
from branchcrush.files.columns import read_columns
from branchcrush.files.declared import Declared
from branchcrush.files.rows import Row, read_rows, refuse
from branchcrush.files.sieve_readings import contradictions
from branchcrush.files.sieve_tables import NAMES, sieve_curve


@dataclass(frozen=True)
class SizeTable:
    """Sizes of a file and what stands beside them.

    Parameters
    ----------
    sizes : ndarray, shape (n,)
        Increasing, in the unit that is declared.
    values : ndarray, shape (n,) or, of channels, (n - 1,)
    remarks : list of str
        How the file was read.

    Examples
    --------
    >>> SizeTable(np.array([1.0, 2.0]), np.array([0.0, 100.0])).remarks
    []
    """

    sizes: np.ndarray
    values: np.ndarray
    remarks: list[str] = field(default_factory=list)


def read_sieve_table(path: str | PathLike[str], declared: Declared | None = None) -> SizeTable:
    r"""Return the sieve curve of a file: openings and percent finer by mass.

    .. math:: F(d_i) = 100 - C(d_i) = 100 \sum_{d_j < d_i} m_j / \sum_j m_j

    C is percent coarser, m what each sieve and the pan retain.

    Parameters
    ----------
    path : path-like
    declared : Declared, optional
        What openings and values are; sizes and percent finer when left out.

    Returns
    -------
    SizeTable
        Percent finer [%] at increasing openings.

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
    ...     _ = path.write_text("opening,finer\n2,100\n0.5,0\n")
    ...     table = read_sieve_table(path)
    ...     table.sizes.tolist(), table.values.tolist()
    ([0.5, 2.0], [0.0, 100.0])
    """
    declared = declared or Declared()
    table = read_columns(path, ("opening", NAMES[declared.kind]), declared.columns, declared.sheet)
    against, curve = contradictions(table, declared), sieve_curve(table, declared)
    # What is wrong with a table that is something else says little.
    refuse(path, table.problems + (against or curve.problems))
    rows = curve.rows
    refuse(path, _wrong_range(rows, declared))
    refuse(path, _wrong_ends(rows, declared))
    sizes, percent = map(list, zip(*(row.values for row in rows), strict=True))
    # What passes the last sieve goes down to the smallest grain, and the like above the first.
    if percent[0] > 0 and declared.smallest is not None and declared.smallest < sizes[0]:
        sizes, percent = [declared.smallest, *sizes], [0.0, *percent]
    if percent[-1] < 100 and declared.largest is not None and declared.largest > sizes[-1]:
        sizes, percent = [*sizes, declared.largest], [*percent, 100.0]
    return SizeTable(np.array(sizes), np.array(percent), table.remarks + curve.remarks)


def read_density_table(path: str | PathLike[str], declared: Declared | None = None) -> SizeTable:
    r"""Return the density of a file of two columns: size and density, of any scale.

    Parameters
    ----------
    path : path-like
    declared : Declared, optional

    Returns
    -------
    SizeTable
        Increasing sizes, and the density as it is there.

    Raises
    ------
    GradingError
        When it is no such file; one line for each problem, with the line of the file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("1,3\n2,1\n")
    ...     read_density_table(path).values.tolist()
    [3.0, 1.0]
    """
    declared = declared or Declared()
    table = read_columns(path, ("size", "density"), declared.columns, declared.sheet)
    rows, problems = density_rows(table, declared)
    refuse(path, table.problems + problems)
    refuse(path, _wrong_range(rows, declared))
    sizes, density = np.array([row.values for row in rows]).T
    return SizeTable(sizes, density, table.remarks)


def read_histogram(path: str | PathLike[str], declared: Declared) -> SizeTable:
    r"""Return the channels of a file: their edges, and what each of them holds.

    Parameters
    ----------
    path : path-like
    declared : Declared
        With what of a channel the file's sizes are.

    Returns
    -------
    SizeTable
        n edges, and n - 1 values of any scale.

    Raises
    ------
    GradingError
        When it is no such file; one line for each problem, with the line of the file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "powder.csv")
    ...     _ = path.write_text("10,20\n20,50\n40,30\n")
    ...     table = read_histogram(path, Declared(sizes="lower", unit="um"))
    ...     table.sizes.tolist(), table.values.tolist()
    ([10.0, 20.0, 40.0, 80.0], [20.0, 50.0, 30.0])
    """
    edges = declared.sizes == "edges"
    both, names = ("lower", "upper", "value"), ("size", "value")
    if declared.columns and len(declared.columns) == 3:
        names = both
    table = read_columns(
        path,
        names,
        declared.columns,
        declared.sheet,
        unfilled=edges,
        wide=both if edges else (),
    )
    edges, values, remarks, problems = channel_edges(table, declared)
    refuse(path, table.problems + problems)
    rows = [Row(0, (edge, 0.0)) for edge in edges]
    refuse(path, [problem.removeprefix("line 0: ") for problem in _wrong_range(rows, declared)])
    return SizeTable(np.array(edges), np.array(values), table.remarks + remarks)


def read_radii(path: str | PathLike[str]) -> np.ndarray:
    r"""Return the sizes of the grains in a file with one on each line, radii or diameters.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    ndarray, shape (n,)
        Increasing, in the file's unit. A size that is there twice is two grains.

    Raises
    ------
    GradingError
        When it is no such file; one line for each problem, with the line of the file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("2\n1.5\n2\n")
    ...     read_radii(path).tolist()
    [1.5, 2.0, 2.0]
    """
    rows, problems = read_rows(path, ("size",))
    problems += _not_positive(rows, "size")
    if not rows and not problems:
        problems.append("line 1: no numbers in the file; give the size of one grain on each line")
    refuse(path, problems)
    return np.sort([row.values[0] for row in rows])


def _not_positive(rows, name):
    """Return which rows have no size above 0."""
    return [
        f"line {row.line}: {name} = {row.values[0]:g}; must be above 0: correct or remove it"
        for row in rows
        if row.values[0] <= 0
    ]


def _wrong_range(rows, declared):
    """Return what is wrong with the sizes that a curve is cut at."""
    problems, unit = [], declared.unit
    smallest, largest = declared.smallest, declared.largest
    first, last = rows[0], rows[-1]
    if smallest is not None and smallest >= last.values[0]:
        problems.append(
            f"line {last.line}: min = {smallest:g} must be below the largest size "
            f"{last.values[0]:g} {unit}: lower min or check the unit"
        )
    if largest is not None and largest <= first.values[0]:
        problems.append(
            f"line {first.line}: max = {largest:g} must be above the smallest size "
            f"{first.values[0]:g} {unit}: raise max or check the unit"
        )
    return problems


def _wrong_ends(rows, declared):
    """Return which end of a sieve curve is missing and not cut off."""
    problems, unit = [], declared.unit
    (low, first), (high, last) = rows[0].values, rows[-1].values
    if declared.kind == "percent_finer" and 0 < last <= 1:
        return [
            f"line {rows[-1].line}: percent finer ends at {last:g}, so these are fractions; "
            "multiply the column by 100"
        ]
    if declared.kind == "percent_coarser" and 99 <= first < 100:
        return [
            f"line {rows[0].line}: percent coarser ends at {100 - first:g}, so these are "
            "fractions; multiply the column by 100"
        ]
    if first > 0 and declared.smallest is None:
        problems.append(
            f"line {rows[0].line}: percent finer = {first:.4g} at the smallest opening {low:g}; "
            f"how small is the smallest grain? Set min to its size, below {low:g} {unit}, or to "
            f"{low:g} or more to leave finer grains out; or add a row with that size, below "
            f"{low:g}, and 0"
        )
    if last < 100 and declared.largest is None:
        problems.append(
            f"line {rows[-1].line}: percent finer = {last:.4g} at the largest opening {high:g}; "
            f"how large is the largest grain? Set max to its size, above {high:g} {unit}, or to "
            f"{high:g} or less to leave coarser grains out; or add a row with that size, above "
            f"{high:g}, and 100"
        )
    return problems
