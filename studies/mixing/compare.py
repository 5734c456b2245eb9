"""What was measured of the mixtures beside what was predicted of them.

    python studies/mixing/compare.py [folder of the study [folder of docs]]

reads the results of the study in the folder (this one, if none is given) and predictions.csv of
this one; it writes docs/results/mixing.csv (every comparison) with tables beside it, the figure and
the tables of docs/mixing.md. Of packings that are missing it says so, here and on the page.
"""

import sys
from pathlib import Path

import pandas as pd
from along import sample_paths
from assumptions import assumption_rows, fraction_rows
from figure import draw
from measured import compared_rows, measured_rows, summary_rows
from networks import network_rows, size_rows
from page import (
    assumption_block,
    energy_block,
    error_block,
    fines_block,
    fraction_block,
    network_block,
    packing_block,
)
from pairs import STUDY, study_pairs
from predict import PREDICTIONS
from verdicts import verdict_block

from branchcrush.files.blocks import filled
from branchcrush.files.tables import provenance, read_table, write_table

MADE = "by studies/mixing/compare.py"
DOCS = STUDY.parents[1] / "docs"


def main(folder: Path = STUDY, docs: Path = DOCS) -> list[str]:
    """Write the tables, the figure and the page; return what is missing, a line each."""
    pairs, predictions = study_pairs(folder), read_table(PREDICTIONS)
    tables, there, missing, untold = _tables(folder, pairs, predictions)
    for name, table in tables.items():
        write_table(docs / "results" / f"{name}.csv", table, provenance())
    figure = docs / "figures" / "mixing.png"
    draw(figure, pairs, tables["mixing"], tables["mixing_measured"], predictions)
    page = docs / "mixing.md"
    blocks = _blocks(pairs, tables, predictions, there, missing, untold)
    page.write_text(filled(page.read_text(encoding="utf-8"), blocks, MADE), encoding="utf-8")
    return missing + untold


def _tables(folder, pairs, predictions):
    rows = {name: [] for name in _TABLES}
    there, missing, untold = 0, [], []
    for pair in pairs:
        paths = {}
        for sample in pair.samples:
            found = sample_paths(folder / "results", pair, sample)
            paths[sample.crushing] = found[0]
            there += len(found[0])
            missing += found[1]
            untold += found[2]
            if paths[sample.crushing]:
                rows["mixing_networks"] += network_rows(pair, sample, paths[sample.crushing])
                rows["mixing_by_size"] += size_rows(pair, sample, paths[sample.crushing])
        rows["mixing_measured"] += measured_rows(pair, paths)
        rows["mixing_assumptions"] += assumption_rows(pair, paths)
        if paths[0.0]:
            rows["mixing"] += compared_rows(pair, paths, predictions)
            rows["mixing_errors"] += summary_rows(pair, paths, predictions)
            rows["mixing_solid_fraction"] += fraction_rows(pair, paths, predictions)
    return {name: pd.DataFrame(entries) for name, entries in rows.items()}, there, missing, untold


# What is written, docs/results/<name>.csv.
_TABLES = (
    "mixing",
    "mixing_errors",
    "mixing_measured",
    "mixing_assumptions",
    "mixing_solid_fraction",
    "mixing_networks",
    "mixing_by_size",
)


def _blocks(pairs, tables, predictions, there, missing, untold):
    compared, measured = tables["mixing"], tables["mixing_measured"]
    asked = sum(len(sample.settings["seeds"]) for pair in pairs for sample in pair.samples)
    told = [f"{there} of {asked} packings are in these tables."]
    if missing:
        told += [
            "",
            "Missing, and why:",
            "",
            *(f"- {line}" for line in missing),
        ]
    if untold:
        told += ["", "At elastic strains and stresses only:", "", *(f"- {line}" for line in untold)]
    return {
        "packings there": told,
        "verdicts": verdict_block(
            pairs,
            compared,
            tables["mixing_errors"],
            tables["mixing_assumptions"],
            predictions,
        ),
        "packings": packing_block(measured, predictions),
        "energy": energy_block(pairs, compared, held_out=False),
        "held out": energy_block(pairs, compared, held_out=True),
        "errors": error_block(tables["mixing_errors"]),
        "stress errors": error_block(tables["mixing_errors"], "ln_stress"),
        "assumptions": assumption_block(tables["mixing_assumptions"]),
        "solid fraction": fraction_block(tables["mixing_solid_fraction"]),
        "fines": fines_block(pairs, measured),
        "networks": network_block(tables["mixing_networks"]),
    }


if __name__ == "__main__":
    for line in main(*(Path(argument) for argument in sys.argv[1:])):
        print(line, file=sys.stderr)
