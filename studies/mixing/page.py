"""The tables of docs/mixing.md, between its marks: every number there comes from here."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import pandas as pd
from assumptions import LEVEL
from measured import UNCHANGED
from pairs import Pair

from branchcrush.files.blocks import interval_cell, number_cell, table

FORMS = {
    "moving_jamming": "moving jamming point, rods",
    "moving_jamming_parking": "the same, parking",
    "paper": "paper",
    "density": "with density",
    "einav": "Einav",
    "tengattini": "Tengattini",
    UNCHANGED: "no change",
}
# Tengattini's differs from Einav's in the jamming point alone, which no row here but one sees.
SHOWN = [name for name in FORMS if name != "tengattini"]
BASES = {
    "elastic_strain": "equal elastic strain",
    "strain": "equal strain from jamming",
    "stress": "equal stress",
}
MODELS = {
    "random_contact": "Eq. 4",
    "parking": "parking",
    "rods": "rods",
    "rods_compressed": "rods, compressed",
}


def energy_block(pairs: Sequence[Pair], compared: pd.DataFrame, *, held_out: bool) -> list[str]:
    """Return the energy of each mixture at equal elastic strain, and each form's."""
    header = ["sample", "elastic strain", "DEM", *(FORMS[form] for form in SHOWN[:-1])]
    rows = []
    if not len(compared):
        return _table(header, rows)
    at = compared[compared["basis"] == "elastic_strain"]
    for pair in pairs:
        if pair.held_out != held_out:
            continue
        of_pair = at[(at["pair"] == pair.name) & (at["law"] == pair.law)]
        for (_, level), group in of_pair.groupby(["crushing", "level"]):
            said = group.set_index("form")
            rows.append(
                [
                    group["sample"].iloc[0],
                    f"{level:g}",
                    interval_cell(group.iloc[0], "energy_ratio"),
                    *(number_cell(said["predicted_energy_ratio"].get(form)) for form in SHOWN[:-1]),
                ]
            )
    return _table(header, rows)


def error_block(summary: pd.DataFrame, part: str = "ln_energy") -> list[str]:
    """Return the errors of every form, by pair and by what is held equal."""
    header = ["pair", "law", "at", "comparisons", *(FORMS[form] for form in SHOWN)]
    rows = []
    for (pair, law, basis), group in _groups(summary, ["pair", "law", "basis"]):
        if part == "ln_stress" and basis == "elastic_strain":
            continue  # the same as of the energy
        said = group.set_index("form")
        if f"rms_{part}" not in said or said[f"rms_{part}"].isna().all():
            continue
        cells = [_error(said, form, part) for form in SHOWN]
        count = int(said["comparisons"].max())
        rows.append([pair, law, BASES[basis], count, *cells])
    return _table(header, rows)


def packing_block(measured: pd.DataFrame, predictions: pd.DataFrame) -> list[str]:
    """Return what the packings are like at one elastic strain, and phi_J beside the rods'."""
    header = ["sample", "seeds", "φ_J", "by rods", "κ", "κ\\*", "rattlers", "mass that bears", "n"]
    at = _at_level(measured)
    said = predictions[predictions["form"] == "moving_jamming"].set_index("sample")
    rows = [
        [
            row["sample"],
            row["seeds"],
            interval_cell(row, "jamming_solid_fraction", 4),
            f"{said.loc[row['sample'], 'jamming_solid_fraction']:.4f}",
            interval_cell(row, "coordination_number"),
            interval_cell(row, "mechanical_coordination_number"),
            interval_cell(row, "rattler_fraction"),
            interval_cell(row, "bearing_mass", 3),
            interval_cell(row, "exponent"),
        ]
        for _, row in at.iterrows()
    ]
    return _table(header, rows)


def assumption_block(assumptions: pd.DataFrame) -> list[str]:
    """Return the paper's assumptions, each beside what was measured."""
    header = ["sample", "n", "ρ(C)/ρ(0)", "φ_J(C)"]
    header += ["B(l) from Eq. 7 with C", "with the best share", "that share", "C by Eq. 15"]
    rows = [
        [
            row["sample"],
            interval_cell(row, "exponent"),
            interval_cell(row, "density_ratio"),
            interval_cell(row, "jamming_solid_fraction", 4),
            *(number_cell(row.get(name), 3) for name in ("mixed_by_crushing", "mixed_at_best")),
            *(number_cell(row.get(name), 2) for name in ("best_share", "crushing_by_moments")),
        ]
        for _, row in assumptions.iterrows()
    ]
    return _table(header, rows)


def fraction_block(fractions: pd.DataFrame) -> list[str]:
    """Return energies at equal solid fraction."""
    forms = ("moving_jamming", "paper", "einav", "tengattini")
    header = ["sample", "φ", "packings that carry load", "DEM", *(FORMS[form] for form in forms)]
    rows = [
        [
            row["sample"],
            f"{row['solid_fraction']:.4f}",
            f"{row['jammed']} of {row['seeds']}",
            interval_cell(row, "energy_ratio") if row["jammed"] else "0",
            *(number_cell(row[f"{form}_energy_ratio"], 3) for form in forms),
        ]
        for _, row in fractions.iterrows()
    ]
    return _table(header, rows)


def fines_block(pairs: Sequence[Pair], measured: pd.DataFrame) -> list[str]:
    """Return what soil mechanics asks of a gap-graded soil."""
    header = ["sample", "fines [%]", "φ_J", "void ratio e", "skeleton void ratio e_sk"]
    header += ["α, stress in the fines", "fines that carry load", "coarse-coarse contacts"]
    rows = []
    if "stress_reduction_factor" not in measured:
        return _table(header, rows)
    for _, row in _at_level(measured).iterrows():
        if np.isnan(row["stress_reduction_factor"]) and row["crushing"] > 0.0:
            continue
        if np.isnan(row["coarse_coarse_coordination"]):
            continue
        fraction = row["jamming_solid_fraction"]
        void, fines = 1.0 / fraction - 1.0, row["crushing"]
        rows.append(
            [
                row["sample"],
                f"{100 * fines:g}",
                interval_cell(row, "jamming_solid_fraction", 4),
                f"{void:.3f}",
                f"{(void + fines) / (1.0 - fines):.3f}",
                interval_cell(row, "stress_reduction_factor"),
                interval_cell(row, "bearing_fines"),
                interval_cell(row, "coarse_coarse_coordination"),
            ]
        )
    return _table(header, rows)


def network_block(networks: pd.DataFrame) -> list[str]:
    """Return distances of branch lengths, and who carries load, by each model."""
    header = ["sample", "elastic strain", *(f"KS {name}" for name in MODELS.values())]
    header += ["κ", *(f"κ {MODELS[name]}" for name in list(MODELS)[1:])]
    header += ["carry load", *(MODELS[name] for name in list(MODELS)[1:])]
    rows = []
    for (sample, level), group in _groups(networks, ["sample", "elastic_strain"]):
        said = group.set_index("model")
        row = [sample, f"{level:g}"]
        row += [number_cell(said["kolmogorov_smirnov"].get(name), 3) for name in MODELS]
        for name in ("coordination_number", "load_bearing_fraction"):
            row.append(number_cell(group[name].iloc[0]))
            predicted = said[f"predicted_{name}"]
            row += [number_cell(predicted.get(model)) for model in list(MODELS)[1:]]
        rows.append(row)
    return _table(header, rows)


def _at_level(measured):
    """Return the rows of each sample at the elastic strain that tables are told at."""
    if "basis" not in measured:
        return measured
    return measured[(measured["basis"] == "elastic_strain") & (measured["level"] == LEVEL)]


def _groups(table: pd.DataFrame, keys: list[str]) -> Iterable:
    return table.groupby(keys, sort=False) if len(table) else []


def _table(header: Sequence[str], rows: Sequence[Sequence[Any]]) -> list[str]:
    return table(header, rows) if rows else ["Nothing of this was packed yet."]


def _error(said, form, part):
    if form not in said.index or not np.isfinite(said.loc[form, f"rms_{part}"]):
        return "–"
    return f"{interval_cell(said.loc[form], f'rms_{part}')}, {said.loc[form, f'bias_{part}']:+.2f}"
