"""The samples of the study beside each other, and beside what was predicted of them.

    python studies/crushing/compare.py [results [docs]]

reads what every sample below results has (this study's, if none is given) and predictions.csv; it
writes docs/results/crushing_study*.csv, the figure and the tables of docs/crushing_study.md, and
says which samples are missing.
"""

import sys
from pathlib import Path

import pandas as pd
from figure import draw
from measured import (
    errors_of_samples,
    foreteller_rows,
    form_rows,
    growth_rows,
    prediction_rows,
    samples_there,
    study_rows,
)
from page import (
    CHANGED,
    energy_block,
    foreteller_block,
    form_block,
    grading_block,
    growth_block,
    line_block,
    prediction_block,
    step_block,
)
from predict import PREDICTIONS, STUDY
from verdicts import verdict_block

from branchcrush.files.blocks import filled, table
from branchcrush.files.tables import provenance, read_table, write_table

DOCS = STUDY.parents[1] / "docs"
MADE = "by studies/crushing/compare.py"


def main(results: Path = STUDY / "results", docs: Path = DOCS) -> list[str]:
    """Write the tables, the figure and the page; return the samples that are missing."""
    there, missing = samples_there(results)
    predictions = read_table(PREDICTIONS)
    beside = prediction_rows(results, there, predictions)
    tables = {
        "crushing_study": pd.DataFrame(study_rows(results, there)),
        "crushing_study_predicted": beside,
        "crushing_study_errors": pd.DataFrame(errors_of_samples(beside)),
        "crushing_study_forms": pd.DataFrame(form_rows(results, there)),
        "crushing_study_growth": pd.DataFrame(growth_rows(results, there)),
        "crushing_study_who_breaks": pd.DataFrame(foreteller_rows(results, there)),
    }
    for name, rows in tables.items():
        write_table(docs / "results" / f"{name}.csv", rows, provenance())
    study = tables["crushing_study"]
    if there:
        draw(docs / "figures" / "crushing_study.png", results, there, study, predictions)
    steps = docs / "results" / "crushing_steps.csv"
    steps = read_table(steps) if steps.exists() else pd.DataFrame()
    blocks = {
        "cases": _cases(study, missing),
        "verdicts": verdict_block(
            study,
            steps,
            *(tables[f"crushing_study_{name}"] for name in ("growth", "errors", "forms")),
            tables["crushing_study_who_breaks"],
        ),
        "lines": line_block(study),
        "gradings": grading_block(study),
        "energy": energy_block(study),
        "steps": step_block(steps),
        "growth": growth_block(tables["crushing_study_growth"]),
        "predictions": prediction_block(tables["crushing_study_errors"]),
        "forms": form_block(tables["crushing_study_forms"]),
        "who breaks": foreteller_block(tables["crushing_study_who_breaks"]),
    }
    page = docs / "crushing_study.md"
    page.write_text(filled(page.read_text(encoding="utf-8"), blocks, MADE), encoding="utf-8")
    return missing


def _cases(study: pd.DataFrame, missing: list[str]) -> list[str]:
    seeds = study.set_index("sample")["seeds"] if len(study) else {}
    rows = [
        [name, what, "not crushed yet" if name in missing else seeds[name]]
        for name, what in CHANGED.items()
    ]
    return table(["sample", "what differs", "seeds"], rows)


if __name__ == "__main__":
    for name in main(*map(Path, sys.argv[1:])):
        print(f"{name} is missing: its packings are not crushed yet")
