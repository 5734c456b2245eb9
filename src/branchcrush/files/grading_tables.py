"""Gradings as files hold them: the curve of a sieving, a density, the sizes of single grains."""

from itertools import pairwise
from os import PathLike

import numpy as np

from branchcrush.files.rows import read_rows, refuse


def read_sieve_table(
    path: str | PathLike[str], smallest: float | None = None, largest: float | None = None
) -> tuple[np.ndarray, np.ndarray]:
    r"""Return the sieve curve of a file of two columns: opening and percent finer by mass.

    Parameters
    ----------
    path : path-like
    smallest, largest : float, optional
        Sizes between which the curve is used, in the file's unit: there it need not go on to
        0 and 100 percent.

    Returns
    -------
    opening, percent : ndarray, shape (n,)
        Increasing openings, in the file's unit, and percent finer [%].

    Raises
    ------
    GradingError
        When it is no such file; one line for each problem, with the line of the file.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("opening,finer\n2,100\n0.5,0\n")
    ...     opening, percent = read_sieve_table(path)
    ...     opening.tolist(), percent.tolist()
    ([0.5, 2.0], [0.0, 100.0])
    """
    rows, problems = _table(path, ("opening", "percent finer"), 100.0)
    problems += [
        f"line {high.line}: percent finer = {high.values[1]:g} at opening {high.values[0]:g} is "
        f"less than {low.values[1]:g} at the smaller {low.values[0]:g} on line {low.line}; it "
        "must not fall as openings grow: correct one of them"
        for low, high in pairwise(rows)
        if high.values[1] < low.values[1]
    ]
    # The ends of a curve that is wrong elsewhere say little.
    refuse(path, problems or _wrong_range(rows, smallest, largest))
    refuse(path, _wrong_ends(rows, smallest, largest))
    opening, percent = np.array([row.values for row in rows]).T
    return opening, percent


def read_density_table(
    path: str | PathLike[str], smallest: float | None = None, largest: float | None = None
) -> tuple[np.ndarray, np.ndarray]:
    r"""Return the density of a file of two columns: size and density, of any scale.

    Parameters
    ----------
    path : path-like
    smallest, largest : float, optional
        Sizes between which the density is used, in the file's unit.

    Returns
    -------
    size, density : ndarray, shape (n,)
        Increasing sizes, in the file's unit, and the density as it is there.

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
    ...     size, density = read_density_table(path)
    ...     size.tolist(), density.tolist()
    ([1.0, 2.0], [3.0, 1.0])
    """
    rows, problems = _table(path, ("size", "density"), np.inf)
    if rows and not problems and not any(row.values[1] for row in rows):
        problems.append(
            f"lines {rows[0].line} to {rows[-1].line}: every density = 0; one must be above 0"
        )
    refuse(path, problems or _wrong_range(rows, smallest, largest))
    size, density = np.array([row.values for row in rows]).T
    return size, density


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


def _table(path, names, most):
    """Return the usable rows by size, each once, and what is wrong with the others."""
    name, other = names
    rows, problems = read_rows(path, names)
    allowed = "not be negative" if most == np.inf else f"lie between 0 and {most:g}"
    problems += _not_positive(rows, name)
    problems += [
        f"line {row.line}: {other} = {row.values[1]:g}; must {allowed}: correct it"
        for row in rows
        if not 0 <= row.values[1] <= most
    ]
    usable = [row for row in rows if row.values[0] > 0 and 0 <= row.values[1] <= most]
    kept = {}
    for row in sorted(usable, key=lambda row: row.values[0]):
        first = kept.setdefault(row.values[0], row)
        if first.values != row.values:
            problems.append(
                f"line {row.line}: {name} {row.values[0]:g} has {other} = {row.values[1]:g} here "
                f"and {first.values[1]:g} on line {first.line}; it must have one: remove a line"
            )
    if len(kept) < 2 and not problems:
        where = f"line {rows[0].line}: one row" if rows else "line 1: no row"
        problems.append(f"{where} of numbers; must be two or more different ones: add the rest")
    return list(kept.values()), problems


def _not_positive(rows, name):
    """Return which rows have no size above 0."""
    return [
        f"line {row.line}: {name} = {row.values[0]:g}; must be above 0: correct or remove it"
        for row in rows
        if row.values[0] <= 0
    ]


def _wrong_range(rows, smallest, largest):
    """Return what is wrong with the sizes that a curve is cut at."""
    problems = []
    first, last = rows[0], rows[-1]
    if smallest is not None and smallest >= last.values[0]:
        problems.append(
            f"line {last.line}: min = {smallest:g} must be below the largest size "
            f"{last.values[0]:g}: lower min or check the unit"
        )
    if largest is not None and largest <= first.values[0]:
        problems.append(
            f"line {first.line}: max = {largest:g} must be above the smallest size "
            f"{first.values[0]:g}: raise max or check the unit"
        )
    return problems


def _wrong_ends(rows, smallest, largest):
    """Return which end of a sieve curve is missing and not cut off."""
    problems = []
    (low, first), (high, last) = rows[0].values, rows[-1].values
    if last <= 1 and rows[-1].values[1] > 0:
        return [
            f"line {rows[-1].line}: percent finer ends at {last:g}, so these are fractions; "
            "multiply the column by 100"
        ]
    if first > 0 and (smallest is None or smallest < low):
        problems.append(
            f"line {rows[0].line}: percent finer = {first:g} at the smallest opening {low:g}; must "
            "be 0: add a row with the size of the smallest grain, below "
            f"{low:g}, and 0, or set min to {low:g} or more to leave finer grains out"
        )
    if last < 100 and (largest is None or largest > high):
        problems.append(
            f"line {rows[-1].line}: percent finer = {last:g} at the largest opening {high:g}; must "
            "be 100: add a row with the size of the largest grain, above "
            f"{high:g}, and 100, or set max to {high:g} or less to leave coarser grains out"
        )
    return problems
