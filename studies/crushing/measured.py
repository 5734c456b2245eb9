"""What the crushed packings of the study tell, a table for each question."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from predict import settings_of

from branchcrush.config.sample import breakage_of
from branchcrush.files.tables import read_json, read_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.samples.crushed_line import YIELDED
from branchcrush.samples.crushing_predicted import beside_predicted, measured_states
from branchcrush.samples.crushing_prediction import prediction_errors

# A sample whose seeds are also those of another with other growth of fragments.
GROWTH = {"growth_at_once": 0, "base": 5, "growth_20": 20}
_AT = 0.72  # solid fraction at which exponents of several limits are told


def samples_there(results: Path) -> tuple[list[str], list[str]]:
    """Return the names of the samples that were crushed, and of those that are missing."""
    names = list(settings_of())
    there = [name for name in names if (results / name / "crushing.json").exists()]
    return there, [name for name in names if name not in there]


def study_rows(results: Path, names: list[str]) -> list[dict[str, Any]]:
    """Return the summary of each sample, its numbers and intervals."""
    rows = []
    for name in names:
        summary = read_json(results / name / "crushing.json")
        means = read_table(results / name / "crushing_means.csv")
        whole = means[~means["halved_step"]]
        told = {
            key: value
            for key, value in summary.items()
            if value is None or isinstance(value, (int, float))
        }
        at = np.interp(
            _AT, whole["solid_fraction"], whole["number_exponent"], left=np.nan, right=np.nan
        )
        rows.append(
            {"sample": name, "seeds": len(summary["seeds"])} | told | {"exponent_at_072": at}
        )
    return rows


def prediction_rows(results: Path, names: list[str], predictions: pd.DataFrame) -> pd.DataFrame:
    """Return what was predicted beside what was measured, a row for each state and quantity."""
    tables = []
    for name in names:
        predicted = predictions[predictions["sample"] == name]
        if not len(predicted):
            continue
        settings = settings_of()[name]
        rules, law = breakage_of(settings["breakage"]), contact_law(**settings["contact"])
        measured = {
            seed: measured_states(
                read_table(folder / "path.csv"),
                read_table(folder / "grains.parquet", columns=["state", "radius_m"]),
                rules,
                law,
            )
            for seed, folder in _seeds(results / name)
        }
        tables.append(beside_predicted(predicted, measured).assign(sample=name))
    return pd.concat(tables, ignore_index=True) if tables else pd.DataFrame()


def errors_of_samples(beside: pd.DataFrame) -> list[dict[str, Any]]:
    """Return errors of the prediction of each sample and quantity, of the states that yield."""
    rows: list[dict[str, Any]] = []
    if len(beside):
        for name, of_sample in beside.groupby("sample", sort=False):
            table = prediction_errors(of_sample)
            rows += [{"sample": name} | row for row in table.to_dict("records")]
    return rows


def form_rows(results: Path, names: list[str]) -> list[dict[str, Any]]:
    """Return errors of each form's stress and dissipation, of the states that yield."""
    rows = []
    for name in names:
        beside = read_table(results / name / "crushing_beside_forms.csv")
        means = read_table(results / name / "crushing_means.csv")
        whole = means[~means["halved_step"]].set_index("state")
        for form, said in beside.groupby("form", sort=False):
            said = said.set_index("state")
            here = whole[whole["broken_mass_fraction"] >= YIELDED].index.intersection(said.index)
            row: dict[str, Any] = {"sample": name, "form": form, "states": len(here)}
            for quantity, key in (
                ("stress", "mean_stress_Pa"),
                ("dissipated", "dissipated_J_per_m3"),
            ):
                of_form = {"stress": "stress_Pa"}.get(quantity, key)
                ratio = said.loc[here, of_form] / whole.loc[here, key]
                known = np.log(ratio[ratio > 0.0].dropna())
                row |= {
                    f"{quantity}_states": len(known),
                    f"{quantity}_rms_ln": float(np.sqrt((known**2).mean())),
                    f"{quantity}_bias_ln": float(known.mean()),
                }
            rows.append(row)
    return rows


def foreteller_rows(results: Path, names: list[str]) -> list[dict[str, Any]]:
    """Return how well each quantity of a grain tells which grains break, of each sample."""
    tables = []
    for name in names:
        file = results / name / "crushed_predictors.csv"
        table = read_table(file)
        tables.append(table.assign(sample=name)[["sample", *table.columns]])
    return pd.concat(tables).to_dict("records") if tables else []


def growth_rows(results: Path, names: list[str]) -> list[dict[str, Any]]:
    """Return what breakage took with other growth of fragments, over that of the base case."""
    taken = {name: _breakage(results / name) for name in GROWTH if name in names}
    base = taken.get("base", {})
    rows = []
    for name, of_seeds in taken.items():
        shared = sorted(set(of_seeds) & set(base))
        for seed in shared:
            rows.append(
                {"sample": name, "growth_stages": GROWTH[name], "seed": seed}
                | of_seeds[seed]
                | {"over_base": of_seeds[seed]["breakage_J"] / base[seed]["breakage_J"]}
            )
    return rows


def _breakage(sample: Path) -> dict[int, Mapping[str, float]]:
    """Return D_b, the work of growth, grains and stress at the end of each seed."""
    told = {}
    for seed, folder in _seeds(sample):
        path = read_table(folder / "path.csv")
        last = path[path["leg"] == "loading"].iloc[-1]
        told[seed] = {
            "breakage_J": last["dissipated_breakage_J"],
            "growth_J": last["growth_work_J"],
            "grains": last["grains"],
            "mean_stress_Pa": last["mean_stress_Pa"],
        }
    return told


def _seeds(sample: Path) -> Iterator[tuple[int, Path]]:
    for folder in sorted((sample / "crushing").glob("seed_*")):
        yield int(folder.name.removeprefix("seed_")), folder
