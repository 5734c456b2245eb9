"""The tiny study from end to end: every file that others rely on, and what it holds."""

import json
import re

import numpy as np
import pandas as pd
import pytest
from matplotlib import image

from branchcrush.summary import summary
from branchcrush.tables import read_json, read_table

SEEDS = (3, 5)
FIGURES = (
    "fig3_grading",
    "fig4_packing",
    "fig5_energy_split",
    "fig6_cubic",
    "fig7_branch_lengths",
    "exponent_path",
    "loading_path",
    "crushing_model",
)
PATH_COLUMNS = [
    "state",
    "linear_strain",
    "volumetric_strain",
    "solid_fraction",
    "void_ratio",
    "volume_m3",
    "mean_stress_Pa",
    "elastic_energy_J",
    "work_J",
    "dissipated_J",
    "coordination_number",
    "mechanical_coordination_number",
    "rattler_fraction",
    "unbalanced_force_ratio",
    "inertial_number",
    "max_overlap_ratio",
    "escaped",
]
CONTACT_COLUMNS = [
    "state",
    "i",
    "j",
    "radius_i_m",
    "radius_j_m",
    "branch_length_m",
    "overlap_m",
    "normal_force_N",
    "energy_J",
]


@pytest.fixture(scope="module")
def sample(finished):
    return finished.folder / "results" / "tiny"


@pytest.mark.parametrize("seed", SEEDS)
def test_every_seed_has_its_packing_path_contacts_and_dumps(sample, seed):
    folder = sample / f"seed_{seed}"
    with np.load(folder / "packing.npz") as packing:
        assert packing["positions"].shape == (60, 3)
        assert packing["radii"].shape == (60,)
        assert packing["box"].shape == (3,)
        assert json.loads(str(packing["meta"]))["seed"] == seed
    assert set(PATH_COLUMNS) <= set(read_table(folder / "path.csv"))
    assert set(CONTACT_COLUMNS) <= set(read_table(folder / "contacts.parquet"))
    for name in ("particles", "pairs"):
        assert (folder / f"{name}.dump.gz").stat().st_size > 0


@pytest.mark.parametrize("seed", SEEDS)
def test_the_path_runs_from_the_loose_packing_to_the_full_reduction(sample, seed):
    path = read_table(sample / f"seed_{seed}" / "path.csv")
    assert len(path) == 14  # as placed, after the approach, and 12 along the loading
    assert path["linear_strain"].iloc[0] == 0
    assert path["linear_strain"].iloc[-1] == pytest.approx(0.4, rel=1e-12)
    assert not path["carries_load"].iloc[1]
    assert path["carries_load"].iloc[-1]
    assert (path["unbalanced_force_ratio"] <= 1e-6).all()
    assert (path["dissipated_J"] >= -1e-12 * path["work_J"]).all()


def test_contacts_and_path_tell_the_same_energy_and_coordination(sample):
    folder = sample / "seed_3"
    path = read_table(folder / "path.csv").set_index("state")
    contacts = read_table(folder / "contacts.parquet")
    walls = read_table(folder / "wall_contacts.parquet")
    last = path.index[-1]
    energy = contacts.loc[contacts["state"] == last, "energy_J"].sum()
    at_walls = (walls.loc[walls["state"] == last, "normal_force_N"] ** 2).sum() / 2e6
    assert energy + at_walls == pytest.approx(path["elastic_energy_J"][last], rel=1e-12)
    count = (contacts["state"] == last).sum()
    assert path["coordination_number"][last] == pytest.approx(2 * count / 60, rel=1e-12)


def test_the_energy_split_counts_every_branch_of_every_seed(sample):
    table, fit = read_table(sample / "energy_split.csv"), read_json(sample / "energy_split.json")
    contacts = [read_table(sample / f"seed_{seed}" / "contacts.parquet") for seed in SEEDS]
    ends = pd.concat([c[c["state"] == c["state"].max()] for c in contacts])
    assert table["branches"].sum() == fit["branches"] == len(ends)
    total = (table["mean_energy_J"] * table["branches"]).sum()
    assert total == pytest.approx(ends["energy_J"].sum(), rel=1e-12)
    assert fit["seeds"] == 2
    assert fit["exponent_low"] < fit["exponent"] < fit["exponent_high"]
    assert {"confidence", "solid_fraction", "cubic_r_squared", "predictors"} <= set(fit)


def test_branch_lengths_integrate_to_one_and_eqs_2_and_3_hold(sample):
    table = read_table(sample / "branch_lengths.csv")
    width = table["length_high_m"] - table["length_low_m"]
    for column in ("density_measured_per_m", "density_random_contact_per_m"):
        assert (table[column] * width).sum() == pytest.approx(1, abs=1e-6)
    statistics = read_json(sample / "branch_lengths.json")
    assert statistics["grains_eq2"] == pytest.approx(60, rel=1e-12)
    counted = statistics["branch_density_per_m3"]
    assert statistics["branch_density_eq3_per_m3"] == pytest.approx(counted, rel=1e-12)


def test_the_crushing_curves_conserve_energy_and_never_heal(sample):
    curves, model = (
        read_table(sample / "thermodynamics.csv"),
        read_json(sample / "thermodynamics.json"),
    )
    path = curves[curves["path"] == "crushing"]
    kept = path["free_energy_J_per_m3"] + path["dissipated_J_per_m3"]
    assert np.allclose(path["work_J_per_m3"], kept, rtol=1e-8, atol=1e-9 * kept.max())
    assert (np.diff(path["crushing"]) >= 0).all()
    assert 0 <= model["theta"] <= 1


def test_the_grading_is_written_by_number_and_by_mass(sample):
    grading = read_table(sample / "grading.csv")
    for kind in ("number", "mass"):
        for curve in ("target", "realised"):
            finer = grading[f"percent_finer_by_{kind}_{curve}"]
            assert (np.diff(finer) >= -1e-9).all()
            assert finer.iloc[-1] == pytest.approx(100)


@pytest.mark.parametrize("figure", FIGURES)
def test_no_figure_is_blank(finished, figure):
    pixels = image.imread(finished.folder / "results/figures/tiny" / f"{figure}.png")[..., :3]
    inked = (pixels.min(axis=-1) < 0.9).mean()
    assert 0.01 < inked < 0.9
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 20


def test_the_report_shows_every_figure_and_the_exponent(finished):
    page = (finished.folder / "results" / "report.html").read_text(encoding="utf-8")
    fit = read_json(finished.folder / "results/tiny/energy_split.json")
    assert page.count("data:image/png;base64,") == len(FIGURES)
    assert f"n = {fit['exponent']:.2f}" in page
    assert not re.search(r"nan|None|https?://", re.sub(r"base64,[^\"]+", "", page))


def test_the_summary_names_exponent_interval_and_figures(finished):
    text = summary(finished.folder / "results")
    row = read_table(finished.folder / "results" / "comparison.csv").iloc[0]
    low, high = row["exponent_low"], row["exponent_high"]
    assert f"tiny: n = {row['exponent']:.2f} ({low:.2f} to {high:.2f})" in text
    assert "report.html" in text
    assert "figures" in text


def test_every_table_names_what_made_it(finished):
    for table in (finished.folder / "results").rglob("*.csv"):
        origin = json.loads(table.read_text().splitlines()[0].removeprefix("# "))
        assert origin["branchcrush"], table
    for fit in (finished.folder / "results").rglob("*.json"):
        assert read_json(fit)["provenance"]["config"], fit
