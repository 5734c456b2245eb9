"""The samples of the study beside each other, and beside what was predicted of them.

    python studies/crushing/compare.py [results [docs]]

reads crushing.json of every sample below results (this study's, if none is given) and
predictions.csv; it writes docs/results/crushing_study.csv, and says which samples are missing.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
from predict import PREDICTIONS, STUDY, settings_of

from branchcrush.files.tables import provenance, read_json, read_table, write_table

DOCS = STUDY.parents[1] / "docs"
# Of `crushing.json`; those with an interval have columns for it.
_TOLD = (
    "final_solid_fraction",
    "final_mean_stress_Pa",
    "final_grains",
    "final_breakages",
    "final_broken_mass_fraction",
    "final_einav_breakage",
    "final_crushing_by_contacts",
    "final_crushing_by_random_contacts",
    "number_exponent",
    "slope",
    "slope_by_strength",
    "slope_by_number_exponent",
    "predicted_slope",
    "stored_share",
    "released_by_parents_share",
    "avalanches_share",
    "rearrangement_share",
    "elastic_strain_least",
    "elastic_strain_largest",
    "jamming_by_rods_difference",
    "jamming_by_rods_scatter",
    "compaction_over_dissipated",
)
_PREDICTED = ("mean_stress_Pa", "broken_mass_fraction", "einav_breakage", "number_exponent")


def main(results: Path = STUDY / "results", docs: Path = DOCS) -> list[str]:
    """Write the table; return the names of the samples that are missing."""
    predictions, rows, missing = read_table(PREDICTIONS), [], []
    for name in settings_of():
        file = results / name / "crushing.json"
        if not file.exists():
            missing.append(name)
            continue
        summary = read_json(file)
        told = {
            key: value
            for key, value in summary.items()
            if any(_is_of(key, quantity) for quantity in _TOLD)
        }
        predicted = predictions[predictions["sample"] == name]
        halved = {key: value for key, value in summary.items() if key.endswith("_halved")}
        rows.append(
            {
                "sample": name,
                "seeds": len(summary["seeds"]),
                "comminution_limit_m": summary["comminution_limit_m"],
                **told,
                **halved,
                **_at(predicted, summary.get("final_solid_fraction", np.nan)),
            }
        )
    if rows:
        table = docs / "results" / "crushing_study.csv"
        write_table(table, pd.DataFrame(rows), provenance())
    return missing


def _is_of(key: str, quantity: str) -> bool:
    """Return whether a key is of a quantity or of an end of its interval."""
    name = quantity.removesuffix("_Pa")
    ends = (f"{name}_low", f"{name}_high")
    return key == quantity or key.removesuffix("_Pa") in ends


def _at(predicted: pd.DataFrame, solid_fraction: float) -> dict[str, float]:
    """Return what was predicted at a solid fraction; nothing of samples without predictions."""
    if not len(predicted):
        return {}
    phi = predicted["solid_fraction"]
    return {
        f"predicted_{name}": float(np.interp(solid_fraction, phi, predicted[name]))
        for name in _PREDICTED
    }


if __name__ == "__main__":
    for name in main(*map(Path, sys.argv[1:])):
        print(f"{name} is missing: its packings are not crushed yet")
