"""The tables of docs/energy_split.md and docs/rods.md: `python studies/energy_split/compare.py`.

Reads docs/results/findings.csv, which `make findings` leaves there, and writes between the marks
of these pages.
"""

from pathlib import Path

import pandas as pd

from branchcrush.branches.nodes import grading_nodes
from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study
from branchcrush.config.file import config_file_content
from branchcrush.files.blocks import filled, interval_cell, number_cell, table
from branchcrush.files.tables import read_table
from branchcrush.gradings.rods import rod_map

ROOT = Path(__file__).parents[2]
DOCS, CONFIG = ROOT / "docs", Path(__file__).with_name("config.yaml")
MADE = "by studies/energy_split/compare.py"
# Of each table the columns of the findings by their titles, and their digits.
COLUMNS = {
    "exponents": {
        "n at φ − φ_J = 0.08": ("exponent_at_distance", 2),
        "n at the end": ("exponent_at_end", 2),
        "φ − φ_J there": ("distance_at_end", 3),
        "curvature": ("curvature_end", 2),
        "branch length": ("explained_branch_length_end", 3),
        "R\\*": ("explained_reduced_radius_end", 3),
        "both radii": ("explained_both_radii_end", 3),
        "length and ratio": ("explained_length_and_ratio_end", 3),
        "grain size": ("explained_grain_size_end", 3),
        "any smooth": ("explained_surface_end", 3),
        "exponent of R\\*": ("exponent_of_reduced_radius_end", 2),
    },
    "lengths": {
        "φ − φ_J": ("distance_near", 3),
        "Eq. 4": ("ks_random_contact_near", 3),
        "solid angle": ("ks_mean_neighbour_near", 3),
        "Bouvard-Lange": ("ks_surface_near", 3),
        "self-consistent": ("ks_self_consistent_near", 3),
        "random parking": ("ks_parking_near", 3),
        "rods": ("ks_rods_near", 3),
        "measured c(R)": ("ks_configuration_near", 3),
        "random parking, at the end": ("ks_parking_end", 3),
        "rods, at the end": ("ks_rods_end", 3),
        "correlation of the radii, at the end": ("assortativity_of_radii", 2),
    },
    "sharing": {
        "s of branches": ("shielding_exponent", 2),
        "grain energy ~ R^a": ("grain_energy_exponent_load_bearing", 2),
        "stress share of the coarser half": ("coarse_half_stress_share", 3),
        "force ~ l^m": ("force_exponent", 2),
        "decay rate above 2⟨F⟩": ("force_tail_decay_rate", 2),
        "squared variation above it": ("force_tail_squared_variation", 2),
        "fabric over chance": ("fabric_branches_deviator_over_expected", 2),
        "of forces": ("fabric_forces_deviator_over_expected", 2),
        "a of κ\\*": ("jamming_law_prefactor", 2),
        "ν of κ\\*": ("jamming_law_exponent", 2),
    },
}
RODS = (
    ("rattlers near jamming", "rattler_fraction_near"),
    ("by rods", "rods_rattler_fraction_near"),
    ("by parking", "parking_rattler_fraction"),
    ("κ near jamming", "coordination_number_near"),
    ("by rods", "rods_coordination_number_near"),
    ("by parking", "parking_coordination_number"),
    ("κ at the end", "coordination_number_end"),
    ("by rods", "rods_coordination_number_end"),
)
RIVALS = ["random_contact", "mean_neighbour", "surface", "self_consistent", "parking", "rods"]


def main() -> None:
    """Write the tables between their marks."""
    findings = read_table(DOCS / "results/findings.csv")
    tables = {name: told(findings, columns) for name, columns in COLUMNS.items()}
    for name, blocks in (
        ("energy_split.md", tables | {"counts": counts(findings)}),
        ("rods.md", {"rods": by_rods(findings)}),
    ):
        page = DOCS / name
        page.write_text(filled(page.read_text(encoding="utf-8"), blocks, MADE), encoding="utf-8")


def told(findings: pd.DataFrame, columns: dict[str, tuple[str, int]]) -> list[str]:
    """Return a table with a row for each sample, and intervals where there are any."""
    rows = [
        [row["sample"], *(cell(row, *column) for column in columns.values())]
        for row in findings.to_dict("records")
    ]
    return table(["sample", *columns], rows)


def cell(row: dict, name: str, digits: int) -> str:
    """Return a number of a sample, with its interval where the findings have one."""
    for where in ("_end", "_near"):
        # The limits of x_end are x_low_end and x_high_end.
        of = name.removesuffix(where)
        for limit in ("_low", "_high"):
            if f"{of}{limit}{where}" in row:
                row = {**row, f"{name}{limit}": row[f"{of}{limit}{where}"]}
    return interval_cell(row, name, digits)


def counts(findings: pd.DataFrame) -> list[str]:
    """Return in how many samples whose radii vary something holds, near jamming and at the end."""
    varied = findings[findings["curvature_end"].notna()]
    over, size = "reduced_radius_over_length", "grain_size_over_length"
    rows = []
    for title, holds in (
        ("curvature above 0", lambda at: at("curvature_low") > 0),
        ("curvature below 0", lambda at: at("curvature_high") < 0),
        ("R\\* explains more than the branch length", lambda at: at(f"{over}_low") > 0),
        (
            "R\\* explains less than the branch length",
            lambda at: at(f"{over}_high") < 0,
        ),
        (
            "grain size explains less than the branch length",
            lambda at: at(f"{size}_high") < 0,
        ),
        ("length and ratio explain most", lambda at: at("best_predictor") == "length_and_ratio"),
    ):
        numbers = [
            int(holds(lambda name, where=where: varied[f"{name}_{where}"]).sum())
            for where in ("near", "end")
        ]
        rows.append([title, *numbers])
    nearest = varied[[f"ks_{name}_near" for name in RIVALS]].idxmin(axis=1)
    rows.append(
        ["random parking is nearest to the lengths", int((nearest == "ks_parking_near").sum()), ""]
    )
    tail = varied["force_tail_squared_variation_high"] < 1
    rows.append(["forces above 2⟨F⟩ fall faster than exponentially", "", int(tail.sum())])
    certified = varied["verdict"].str.startswith("certified")
    rows.append(["certified, with notes or without", "", int(certified.sum())])
    return table([f"of {len(varied)} samples", "near jamming", "at the end"], rows)


def by_rods(findings: pd.DataFrame) -> list[str]:
    """Return the periodic samples of linear contacts beside rods that push, and parking."""
    samples = checked_study(config_file_content(CONFIG), CONFIG.parent, few_grains=True).samples
    rows = []
    for row in findings.to_dict("records"):
        grading, *of = row["sample"].rsplit("-", 2)
        if of != ["periodic", "linear"]:
            continue
        rods = rod_map(*grading_nodes(grading_of(samples[row["sample"]].settings()["grading"])))
        jammed = (row["solid_fraction"] - row["distance_at_end"], rods.solid_fraction)
        cells = [number_cell(number, 3) for number in jammed]
        cells += [number_cell(row[name]) for _, name in RODS]
        rows.append([grading, *cells])
    return table(["grading", "φ_J", "by rods", *(title for title, _ in RODS)], rows)


if __name__ == "__main__":
    main()
