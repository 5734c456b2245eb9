"""What a run came to, in a few lines: those that every way of running ends with."""

import csv
from collections.abc import Mapping
from os import PathLike
from pathlib import Path


def summary(results: str | PathLike[str], shown_as: str | PathLike[str] | None = None) -> str:
    """Return the verdict and the exponent of every sample, and where the pages are, as text.

    Parameters
    ----------
    results : path-like
        The folder of results.
    shown_as : path-like, optional
        The same folder as its reader sees it.

    Returns
    -------
    str
    """
    results = Path(results)
    shown = results if shown_as is None else Path(shown_as)
    # Without pandas, which takes half a second to import, for a few lines.
    with (results / "comparison.csv").open(encoding="utf-8", newline="") as file:
        next(file)  # where the table comes from
        rows = list(csv.DictReader(file))
    return "\n".join(
        [
            *map(_sample_line, rows),
            f"report:   {shown / 'report.html'}",
            f"figures:  {shown / 'figures'}",
        ]
    )


def _sample_line(row: Mapping[str, str]) -> str:
    """Return what one sample came to."""
    name = f"{row['sample']}: {row['verdict']}"
    if not row["exponent"]:
        return f"{name}, no exponent: {row['reason']}"
    if reasons := row.get("verdict_reasons"):  # a table of an earlier version has none
        name += f" ({reasons})"
    exponent = f"n = {float(row['exponent']):.2f}"
    if row["exponent_low"]:
        low, high, confidence = (
            float(row[key]) for key in ("exponent_low", "exponent_high", "confidence")
        )
        exponent += (
            f", with {100 * confidence:.4g} % confidence between {low:.2f} and {high:.2f} "
            f"({row['seeds_certified']} packings)"
        )
    else:
        exponent += " (one packing: no interval)"
    return f"{name}, {exponent}, at solid fraction {float(row['solid_fraction']):.3f}"
