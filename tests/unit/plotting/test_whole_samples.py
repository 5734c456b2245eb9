"""The figures of networks, predictors and samples draw many seeds, one seed, and one radius."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from matplotlib import pyplot as plt

from branchcrush.branches.predictions import fine_edges, predictions
from branchcrush.errors import FitError
from branchcrush.files.tables import read_json, write_json
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import single
from branchcrush.packings.network import state_network
from branchcrush.plotting import branches as touching
from branchcrush.plotting import forces, predictors
from branchcrush.plotting import shielding as sharing
from branchcrush.plotting import study as samples
from branchcrush.plotting import study_networks as samples_networks
from branchcrush.samples.branch_lengths import (
    contact_number_rows,
    length_prediction_rows,
    sample_classes,
    seed_contacts,
    touching_summary,
)
from branchcrush.samples.energy_split import COLUMNS, final_energy_split, seed_branches
from branchcrush.samples.ensemble import mean_path
from branchcrush.samples.sharing import both_states, shared_in_state
from branchcrush.statistics.bins import bin_edges
from branchcrush.study.kinds import SampleKind

pytestmark = pytest.mark.filterwarnings("error")
OPTIONS = {"confidence": 0.95, "resamples": 100}
STATES = (4, 7)
KIND = SampleKind("walls", "linear", {"form": "any"})


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")


def packing(grading, seed, grains=150, contacts=600):
    """Grains that touch at random, and one wall contact of each of the first ten."""
    rng = np.random.default_rng(seed)
    radii = grading.rvs(grains, random_state=rng)
    parts = []
    for state in STATES:
        i, j = rng.integers(0, grains, (2, 2 * contacts))
        apart = i != j
        i, j = i[apart][:contacts], j[apart][:contacts]
        energy = 1e6 * (radii[i] + radii[j]) ** 3 * rng.standard_exponential(contacts)
        parts.append(
            pd.DataFrame(
                {
                    "state": state,
                    "i": i,
                    "j": j,
                    "radius_i_m": radii[i],
                    "radius_j_m": radii[j],
                    "branch_length_m": 0.99 * (radii[i] + radii[j]),
                    "overlap_m": 1e-3 * radii[i],
                    "normal_force_N": np.sqrt(energy),
                    "energy_J": energy,
                }
            )
        )
    walls = {"i": np.arange(10), "overlap_m": 1e-5, "normal_force_N": 1.0}
    walls = pd.concat([pd.DataFrame({"state": state, **walls}) for state in STATES])
    return radii, pd.concat(parts, ignore_index=True), walls


def path():
    return pd.DataFrame(
        {
            "state": STATES,
            "solid_fraction": [0.65, 0.7],
            "mean_stress_Pa": [1e5, 1e6],
            "volume_m3": 1.0,
            "elastic_energy_J": 1.0,
            "coordination_number": 8.0,
            "mechanical_coordination_number": 8.0,
            "rattler_fraction": 0.0,
        }
    )


@pytest.fixture(
    params=[(uniform(0.2, 1.0), 3), (uniform(0.2, 1.0), 1), (single(1.0), 2)],
    ids=["three seeds", "one seed", "one radius"],
)
def sample(request, tmp_path):
    """Grading, its seeds, and a way to JSON and back, as the figures' data go."""
    grading, number = request.param
    seeds = [packing(grading, seed) for seed in range(number)]

    def through_json(result):
        write_json(tmp_path / "result.json", result, {})
        return read_json(tmp_path / "result.json")

    return grading, seeds, through_json


def test_who_touches_whom(sample):
    grading, seeds, through_json = sample
    classes = sample_classes(grading, *seeds[0], STATES[-1])
    found = [seed_contacts(grading, classes, *seed, STATES) for seed in seeds]
    edges, along = fine_edges(*grading.support()), mean_path([path()] * len(seeds), 0.6)
    models = predictions(grading, edges)
    rows = length_prediction_rows(found, models, edges, along, **OPTIONS)
    numbers, pairs = contact_number_rows(found, models, classes, along, **OPTIONS)
    summary = through_json(touching_summary(found, models, rows, along, **OPTIONS))
    table = pd.DataFrame(rows)
    for ax in (
        touching.plot_contact_numbers(numbers, summary, 1.0),
        touching.plot_distances(table),
        touching.plot_mean_lengths(table, 1.0),
    ):
        assert ax.get_xlabel() and ax.get_ylabel() and ax.get_legend()
    ax = touching.plot_pairs(pairs, summary, 1.0)
    assert ax.get_xlabel() or "one radius" in ax.texts[0].get_text()


def test_what_is_shared(sample):
    grading, seeds, through_json = sample
    edges, rng = bin_edges(*grading.support()), np.random.default_rng(1)
    classes = sample_classes(grading, *seeds[0], STATES[-1])
    found = {}
    for where, state in (("near_jamming", 4), ("end", 7)):
        networks = [state_network(*seed, state) for seed in seeds]
        networks = [replace(one, vector=rng.normal(size=(one.i.size, 3))) for one in networks]
        found[where, state] = shared_in_state(networks, edges, classes, 1.0, **OPTIONS)
    tables, summary = both_states(found)
    summary = through_json(summary)
    drawn = [
        sharing.plot_grain_shielding(tables["shielding_grains"]),
        forces.plot_force_distribution(tables["force_distribution"], summary),
        forces.plot_force_by_length(tables["force_by_length"], summary, 1.0),
        forces.plot_stress_by_radius(tables["stress_by_radius"], 1.0),
        forces.plot_stress_sharing(tables["stress_sharing"], summary),
    ]
    if "reason" not in summary["end"]["shielding"]["branches"]:
        drawn.append(sharing.plot_branch_shielding(tables["shielding_branches"], summary))
    styles = samples.sample_styles({"one": KIND})
    for plot, name in (
        (samples_networks.plot_grain_shielding, "shielding_grains"),
        (samples_networks.plot_stress, "stress_sharing"),
        (samples_networks.plot_forces, "force_distribution"),
    ):
        drawn.append(plot({"one": tables[name]}, styles))
    assert all(ax.get_xlabel() and ax.get_ylabel() and ax.get_legend() for ax in drawn)


def test_predictors_and_slopes(sample):
    grading, seeds, through_json = sample
    edges = bin_edges(*grading.support())
    branches = [seed_branches(contacts[[*COLUMNS]], STATES, edges) for _, contacts, _ in seeds]
    paths = [path()] * len(seeds)
    if grading.is_discrete:
        with pytest.raises(FitError, match="two or more branch lengths"):
            final_energy_split(branches, paths, edges, 0.6, **OPTIONS)
        return
    fit = through_json(final_energy_split(branches, paths, edges, 0.6, **OPTIONS)[1])
    assert predictors.plot_predictors(fit).get_xlabel()
    assert predictors.plot_slopes(fit).get_legend()


def test_samples_of_one_grading_have_one_colour_and_the_name_they_share():
    other = replace(KIND, grading={"form": "other"})
    hertz = replace(KIND, boundary="periodic", law="hertz")
    styles = samples.sample_styles({"sand-a": KIND, "sand-b": hertz, "mud": other})
    assert styles["sand-a"]["color"] == styles["sand-b"]["color"] != styles["mud"]["color"]
    assert [style["grading"] for style in styles.values()] == ["sand", "sand", "mud"]
    assert (styles["sand-a"]["line"], styles["sand-b"]["line"]) == ("--", "-")
    assert not styles["sand-b"]["filled"]


def test_exponents_are_drawn_for_the_samples_of_one_law():
    table = pd.DataFrame(
        {
            "solid_fraction_above_jamming": [0.0, 0.1, 0.2],
            "exponent": [2.0, 2.5, 3.0],
            # The first says nothing, and is left out.
            "exponent_low": [0.0, 2.4, 2.9],
            "exponent_high": [4.0, 2.6, 3.1],
        }
    )
    hertz = replace(KIND, law="hertz")
    styles = samples.sample_styles({"one": KIND, "two": hertz})
    ax = samples.plot_exponents({"one": table, "two": table}, styles, "linear")
    assert ax.lines[0].get_xdata().tolist() == [0.1, 0.2]
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["one", "the paper's n = 3"]
