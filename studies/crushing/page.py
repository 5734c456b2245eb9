"""The tables of docs/crushing_study.md, between its marks: every number there comes from here."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.blocks import interval_cell, number_cell, table

# What each sample of the study changes.
CHANGED = {
    "base": "the base case",
    "events": "strain steps end where the next grain breaks",
    "size_exponent_05": "b = 0.5",
    "size_exponent_2": "b = 2",
    "hertz": "Hertz contacts",
    "octahedral": "criterion octahedral stress",
    "limit_eighth": "half the comminution limit, 200 grains, to φ = 0.72",
    "growth_at_once": "fragments have their whole mass at once",
    "growth_20": "fragments grow in 20 stages",
}
PREDICTED = {
    "broken_mass_fraction": "broken mass",
    "einav_breakage": "Einav's B",
    "number_exponent": "α",
    "grains_ratio": "grains",
    "mean_stress_Pa": "p",
    "elastic_strain": "ε_e",
    "coordination_number": "κ",
    "dissipated_J_per_m3": "lost",
}
FORETELLERS = {
    "stress_over_strength": "stress over strength",
    "weakness": "strength alone",
    "stress": "stress alone",
    "largest_force": "largest force",
    "energy": "energy of its contacts",
    "split_energy": "the same by the paper's split",
    "longest_branch": "longest branch",
    "contacts": "number of contacts",
    "radius": "radius",
}
_MPA, _PERCENT = 1e-6, 100.0
_NOTHING = ["Nothing of this was crushed yet."]


def line_block(study: pd.DataFrame) -> list[str]:
    """Return the compression line of each sample beside its laws."""
    header = ["sample", "seeds", "-d ln e/d ln p", "1/(2b)", "(3 − α)/b"]
    header += ["by the gradings alone", "p of the line, off by", "elastic strain ε_e [%]"]
    return _table(
        header,
        [
            [
                row["sample"],
                row["seeds"],
                interval_cell(row, "slope"),
                number_cell(row["slope_by_strength"]),
                number_cell(row["slope_by_number_exponent"]),
                interval_cell(row, "predicted_slope"),
                f"{_PERCENT * (row['log_stress_factor'] - 1.0):.0f} %",
                f"{_PERCENT * row['elastic_strain_least']:.1f} to "
                f"{_PERCENT * row['elastic_strain_largest']:.1f}",
            ]
            for _, row in study.iterrows()
        ],
    )


def grading_block(study: pd.DataFrame) -> list[str]:
    """Return what the gradings have become at the end."""
    header = ["sample", "φ", "p [MPa]", "grains", "broken mass [%]", "Einav's B", "C by contacts"]
    header += ["C by Eq. 4", "α", "α at φ = 0.72", "φ_J by rods − measured"]
    return _table(
        header,
        [
            [
                row["sample"],
                f"{row['final_solid_fraction']:.3f}",
                interval_cell(_pascals(row), "p", 1, _MPA),
                f"{row['final_grains']:.0f}",
                interval_cell(row, "final_broken_mass_fraction", 0, _PERCENT),
                interval_cell(row, "final_einav_breakage_down_to_0", 3),
                interval_cell(row, "final_crushing_by_contacts"),
                interval_cell(row, "final_crushing_by_random_contacts"),
                interval_cell(row, "number_exponent"),
                number_cell(row["exponent_at_072"]),
                f"{row['jamming_by_rods_difference']:+.4f} ± {row['jamming_by_rods_scatter']:.4f}",
            ]
            for _, row in study.iterrows()
        ],
    )


def energy_block(study: pd.DataFrame) -> list[str]:
    """Return where the work since the first breakage went, and with half the step."""
    header = ["sample", "stored", "contacts of broken grains", "avalanches", "rearrangement"]
    header += ["avalanches and rearrangement", "∫ p dφ_J over what is lost"]
    rows = []
    for _, row in study.iterrows():
        rows.append(
            [
                row["sample"],
                *(interval_cell(row, f"{part}_share", 0, _PERCENT) for part in _PARTS),
                f"{_PERCENT * (row['avalanches_share'] + row['rearrangement_share']):.0f}",
                interval_cell(row, "compaction_over_dissipated"),
            ]
        )
        if pd.notna(row.get("stored_share_halved")):
            halved = [row[f"{part}_share_halved"] for part in _PARTS]
            rows.append(
                [
                    f"{row['sample']}, half the step",
                    *(f"{_PERCENT * share:.0f}" for share in halved),
                    f"{_PERCENT * sum(halved[2:]):.0f}",
                    "",
                ]
            )
    return _table(header, rows)


def step_block(steps: pd.DataFrame) -> list[str]:
    """Return the split of the work by how strain steps are taken, with standard errors."""
    header = ["strain step", "steps end", "rest", "packings", "breakages", "p [MPa]"]
    header += ["stored", "contacts of broken grains", "avalanches"]
    header += ["size of the strain step", "rearrangement without it", "evaluations"]
    rows = []
    if not len(steps):
        return _NOTHING
    for (step, tolerance, stepping), group in steps.groupby(
        ["strain_step", "step_tolerance", "stepping"], sort=False
    ):
        shares = group.assign(
            quasi_static_share=group["rearrangement_share"] - group["step_excess_share"]
        )
        rows.append(
            [
                f"{step:g}",
                "where a grain breaks" if stepping == "events" else "anywhere",
                f"{tolerance:g}",
                len(group),
                _error(group["breakages"], 0),
                _error(_MPA * group["mean_stress_Pa"], 1),
                *(
                    _error(_PERCENT * shares[f"{part}_share"], 1)
                    for part in (*_PARTS[:3], "step_excess", "quasi_static")
                ),
                f"{group['force_evaluations'].mean():.2g}".replace("e+0", "e"),
            ]
        )
    return _table(header, rows)


def growth_block(growth: pd.DataFrame) -> list[str]:
    """Return what breakage takes by how fragments grow."""
    header = ["stages", "seed", "D_b [J]", "over 5 stages", "put in by growth [J]", "grains"]
    return _table(
        header,
        [
            [
                int(row["growth_stages"]),
                int(row["seed"]),
                f"{row['breakage_J']:.4f}",
                f"{row['over_base']:.3f}",
                f"{row['growth_J']:.2g}",
                int(row["grains"]),
            ]
            for _, row in growth.iterrows()
        ],
    )


def prediction_block(errors: pd.DataFrame) -> list[str]:
    """Return errors of the prediction without a simulation."""
    if not len(errors):
        return _NOTHING
    rows = []
    for name, group in errors.groupby("sample", sort=False):
        said = group.set_index("quantity")
        reached = int(said["states"].max()), int(said["states_asked"].max())
        rows.append(
            [
                name,
                f"{reached[0]} of {reached[1]}",
                *(
                    f"{said.loc[key, 'rms_ln']:.2f}, {said.loc[key, 'bias_ln']:+.2f}"
                    for key in PREDICTED
                ),
            ]
        )
    return _table(["sample", "states", *PREDICTED.values()], rows)


def form_block(forms: pd.DataFrame) -> list[str]:
    """Return errors of the forms of the model."""
    header = ["sample", *(FORM_LABELS[form] for form in dict.fromkeys(forms.get("form", [])))]
    if len(header) == 1:
        return _NOTHING
    rows = []
    for name, group in forms.groupby("sample", sort=False):
        rows.append(
            [
                name,
                *(
                    f"{_bias(row, 'stress')}; {_bias(row, 'dissipated')}"
                    for _, row in group.iterrows()
                ),
            ]
        )
    return _table(header, rows)


def foreteller_block(forerunners: pd.DataFrame) -> list[str]:
    """Return how well quantities of a grain that carries load tell which grains break."""
    if not len(forerunners):
        return _NOTHING
    here = forerunners[forerunners["among"] == "bearing"]
    rows = []
    for name, group in here.groupby("sample", sort=False):
        said = group.set_index("foreteller")
        cells = [
            interval_cell(said.loc[key], "area") if key in said.index else "–"
            for key in FORETELLERS
        ]
        rows.append([name, int(said["breakages"].max()), *cells])
    return _table(["sample", "breakages", *FORETELLERS.values()], rows)


_PARTS = ("stored", "released_by_parents", "avalanches", "rearrangement")


def _pascals(row: pd.Series) -> Mapping[str, Any]:
    return {f"p{end}": row[f"final_mean_stress{end}_Pa"] for end in ("", "_low", "_high")}


def _bias(row: pd.Series, quantity: str) -> str:
    asked, known = row["states"], row[f"{quantity}_states"]
    if not known:
        return "–"
    told = f"{row[f'{quantity}_rms_ln']:.2f}, {row[f'{quantity}_bias_ln']:+.2f}"
    return told if known == asked else f"{told} ({known:.0f} of {asked:.0f} states)"


def _error(values: pd.Series, digits: int) -> str:
    """Return a mean with its standard error, of packings that are told one by one."""
    if len(values) < 2:
        return f"{values.mean():.{digits}f}"
    return f"{values.mean():.{digits}f} ± {values.sem():.{digits}f}"


def _table(header: Sequence[str], rows: Sequence[Sequence[Any]]) -> list[str]:
    return table(header, rows) if rows else _NOTHING
