"""`branchcrush grading`: how a table is read, before anything is made of it."""

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from branchcrush.config.reading import GradingReport, grading_report
from branchcrush.config.units import UNITS


def section_of(file: str | None, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the section of a grading for a file and what is declared of it.

    Parameters
    ----------
    file : str or None
    given : mapping
        Keys of the section; those that are None were not given.

    Returns
    -------
    dict

    Examples
    --------
    >>> section_of("sand.csv", {"form": "sieve", "unit": "mm", "size": None, "basis": None})
    {'form': 'sieve', 'basis': 'mass', 'size': 'diameter', 'unit': 'mm', 'file': 'sand.csv'}
    """
    declared = {key: value for key, value in given.items() if value is not None}
    # What the form leaves no choice of need not be typed.
    implied = {
        "sieve": {"basis": "mass", "size": "diameter"},
        "radii": {"basis": "number"},
    }.get(declared["form"], {})
    merged = {"form": declared["form"], **implied, **declared, "file": file}
    if file is None:
        merged.pop("file")
    order = ["form", "basis", "size", "unit", "file"]
    return {key: merged[key] for key in [*order, *(set(merged) - set(order))] if key in merged}


def grading(
    file: str | None, given: Mapping[str, Any], picture: str | None, width: int = 72
) -> int:
    """Print how a table is read, its sizes, a sketch of its curve, and the lines to paste.

    Parameters
    ----------
    file : str or None
    given : mapping
        As for `section_of`.
    picture : str or None
        A PNG file for the curve.
    width : int
        Of the sketch, in characters.

    Returns
    -------
    int
        1 if the table is not to be read so, else 0.

    Raises
    ------
    FileNotFoundError
        When there is no such file.
    """
    if file is not None and not Path(file).exists():
        raise FileNotFoundError(f"{file}: there is no such file in {Path.cwd()}")
    # The study runs in a folder of its own, where names begin.
    name = None if file is None else Path(file).name
    options = {key: item for key, item in given.items() if item is not None}
    typed = None if file is None else {"file": file, **options}
    report = grading_report(section_of(file, given), file_to_paste=name, typed=typed)
    if report.problems:
        print("\n".join(f"error: {line}" for line in report.problems), file=sys.stderr)
        return 1
    print(report_text(report))
    low, high = report.grading.support()
    radius = np.geomspace(low, high, 10 * width)
    print(sketch(2.0 * radius, 100.0 * report.grading.mass_cdf(radius), report.unit, width))
    if picture is not None:
        from branchcrush.plotting.packing_figures import draw_preview  # slow to import

        curves = {
            "diameter_m": 2.0 * radius,
            "percent_finer_by_mass_target": 100.0 * report.grading.mass_cdf(radius),
            "percent_finer_by_number_target": 100.0 * report.grading.number_cdf(radius),
        }
        draw_preview(picture, 200, curves, report.unit)
        print(f"picture: {picture}")
    if report.config_lines:
        print("to paste below a sample:")
        print("\n".join(f"    {line}" for line in report.config_lines))
        if file is not None:
            print("    # file: relative to the folder that the study runs in")
    return 0


def report_text(report: GradingReport) -> str:
    """Return how a table is read as text: what it means, its sizes, what is worth a look.

    Parameters
    ----------
    report : GradingReport

    Returns
    -------
    str

    Examples
    --------
    >>> print(report_text(GradingReport(["percent finer by mass"], {"D10": 0.1, "D50": 0.25})))
    read as: percent finer by mass
    D10 0.1, D50 0.25 mm by mass
    """
    lines = [f"read as: {sentence}" for sentence in report.meaning]
    sizes = ", ".join(f"{name} {size:.4g}" for name, size in report.d_values.items())
    lines.append(f"{sizes} {report.unit} by mass")
    return "\n".join([*lines, *(f"worth a look: {warning}" for warning in report.warnings)])


def sketch(
    diameter: Sequence[float] | np.ndarray,
    percent: Sequence[float] | np.ndarray,
    unit: str,
    width: int = 72,
    height: int = 11,
) -> str:
    """Return a curve of percent finer as characters, over the logarithm of diameter.

    Parameters
    ----------
    diameter : array_like, shape (n,)
        Increasing [m].
    percent : array_like, shape (n,)
        [%]
    unit : str
        A unit of `config.units.UNITS`, for the ends of the axis.
    width, height : int
        In characters.

    Returns
    -------
    str

    Examples
    --------
    >>> print(sketch([1e-3, 2e-3, 4e-3], [0, 50, 100], "mm", 16, 3))
    100 |        ***
     50 |   *****
      0 |***
        +-----------
         1      4 mm
    """
    columns = max(width - 5, 10)
    logs = np.log(np.asarray(diameter, dtype=float))
    at = np.interp(np.linspace(logs[0], logs[-1], columns), logs, percent)
    rows = np.rint(at / 100.0 * (height - 1)).astype(int)
    lines = []
    for row in range(height - 1, -1, -1):
        label = f"{100.0 * row / (height - 1):3.0f}"
        marks = "".join("*" if there == row else " " for there in rows).rstrip()
        lines.append(f"{label} |{marks}")
    low, high = (f"{float(f'{end / UNITS[unit]:.3g}'):g}" for end in (diameter[0], diameter[-1]))
    axis = f"{low}{f'{high} {unit}':>{max(columns - len(low), 1)}}"
    return "\n".join([*lines, f"    +{'-' * columns}", f"     {axis}"])
