"""Print what a run came to: `python -m branchcrush.study.summary results`."""

import csv
import sys
from os import PathLike
from pathlib import Path

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
    results, lines = Path(results), []
    # Without pandas, which takes half a second to import, for a few lines.
    with (results / "comparison.csv").open(encoding="utf-8", newline="") as file:
        next(file)  # where the table comes from
        rows = list(csv.DictReader(file))
    for row in rows:
        name = f"{row['sample']}: {row['verdict']}"
        if not row["exponent"]:
            lines.append(f"{name}, no exponent: {row['reason']}")
            continue
        ends = [float(row[f"exponent_{end}"] or "nan") for end in ("low", "high")]
        exponent = interval_text(float(row["exponent"]), *ends)
        if row["exponent_low"]:
            confidence = float(row["confidence"])
            exponent += f", {confidence:.0%} interval of {row['seeds_certified']} seeds"
        lines.append(
            f"{name}, n = {exponent}, at solid fraction {float(row['solid_fraction']):.3f}"
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
