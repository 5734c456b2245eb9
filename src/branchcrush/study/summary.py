"""Print what a run came to: `python -m branchcrush.study.summary results`."""

import sys
from os import PathLike
from pathlib import Path

from branchcrush.files.tables import read_table
from branchcrush.statistics.intervals import interval_text


def summary(results: str | PathLike[str]) -> str:
    """Return the exponent of every sample with its interval, and where to look, as text.

    Parameters
    ----------
    results : path-like
        The folder of results.

    Returns
    -------
    str
    """
    results = Path(results)
    lines = []
    for row in read_table(results / "comparison.csv").itertuples():
        # An empty cell of a CSV file is read as nan.
        if row.exponent != row.exponent:
            lines.append(f"{row.sample}: {row.verdict}, no exponent: {row.reason}")
            continue
        exponent = interval_text(row.exponent, row.exponent_low, row.exponent_high)
        if row.exponent_low == row.exponent_low:
            exponent += f", {row.confidence:.0%} interval of {row.seeds_certified} seeds"
        lines.append(
            f"{row.sample}: {row.verdict}, n = {exponent}, at solid fraction "
            f"{row.solid_fraction:.3f}"
        )
    return "\n".join(
        [
            *lines,
            f"report:   {results / 'report.html'}",
            f"findings: {results / 'findings.html'}",
            f"figures:  {results / 'figures'}",
        ]
    )


if __name__ == "__main__":
    print(summary(sys.argv[1] if len(sys.argv) > 1 else "results"))
