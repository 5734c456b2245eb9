"""How the gradings of the study are crushed, from strengths and contacts alone.

    python studies/crushing/predict.py

writes studies/crushing/predictions.csv. It reads config.yaml and no packing: of the samples whose
results are to be predicted only `base` was looked at before the file was committed.

    python studies/crushing/predict.py RESULTS SAMPLE PICTURE

puts the prediction of a sample beside the packings in RESULTS/SAMPLE/crushing, and draws both.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd

from branchcrush.branches.crushing_gradings import crushing_gradings
from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study
from branchcrush.config.file import config_file_content
from branchcrush.config.sample import breakage_of
from branchcrush.files.tables import provenance, read_table, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.plotting.crushing_predicted import draw_crushing_predicted
from branchcrush.samples.crushing_predicted import (
    beside_predicted,
    measured_states,
    predicted_states,
)

STUDY = Path(__file__).parent
PREDICTIONS = STUDY / "predictions.csv"
# The others differ from `base` by what the model knows nothing of.
PREDICTED = ("base", "size_exponent_05", "size_exponent_2", "hertz", "limit_eighth")
SOLID_FRACTIONS = np.arange(0.640, 0.7801, 0.0025)


def settings_of() -> dict:
    """Return the plain settings of every sample."""
    config = checked_study(config_file_content(STUDY / "config.yaml"), STUDY, few_grains=True)
    return {name: sample.settings() for name, sample in config.samples.items()}


def predict() -> None:
    """Write the predictions."""
    samples, tables = settings_of(), []
    for name in PREDICTED:
        settings = samples[name]
        rules, law = breakage_of(settings["breakage"]), contact_law(**settings["contact"])
        path = crushing_gradings(grading_of(settings["grading"]), law, rules, SOLID_FRACTIONS[-1])
        table = predicted_states(path, rules, SOLID_FRACTIONS).dropna(subset="mean_stress_Pa")
        table.insert(0, "sample", name)
        tables.append(table)
    write_table(PREDICTIONS, pd.concat(tables), provenance())


def compare(results: Path, sample: str, picture: Path) -> None:
    """Print errors of a sample's prediction, and draw it beside its packings."""
    settings = settings_of()[sample if sample in PREDICTED else "base"]
    predicted = read_table(PREDICTIONS)
    predicted = predicted[predicted["sample"] == (sample if sample in PREDICTED else "base")]
    rules, law = breakage_of(settings["breakage"]), contact_law(**settings["contact"])
    measured = {
        int(folder.name.removeprefix("seed_")): measured_states(
            read_table(folder / "path.csv"),
            pd.read_parquet(folder / "grains.parquet", columns=["state", "radius_m"]),
            rules,
            law,
        )
        for folder in sorted((results / sample / "crushing").glob("seed_*"))
    }
    table = beside_predicted(predicted, measured)
    print(table.to_csv(index=False, float_format="%.4g"))
    draw_crushing_predicted(picture, 150, predicted, table)


if __name__ == "__main__":
    if len(sys.argv) == 1:
        predict()
    else:
        compare(Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]))
