"""Contacts of a sample drawn by known contact numbers, beside what the predictions say."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.branches.predictions import fine_edges, predictions
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import from_radii, single
from branchcrush.packings.network import COLUMNS, WALL_COLUMNS
from branchcrush.samples.branch_lengths import (
    contact_number_rows,
    length_prediction_rows,
    sample_classes,
    seed_contacts,
    touching_summary,
)
from branchcrush.samples.ensemble import mean_path

GRADING = uniform(1.0, 20.0)
EDGES = fine_edges(1.0, 20.0)
STATES = (2, 5)
MEASURED = dict(confidence=0.95, resamples=200)
NO_WALLS = pd.DataFrame({name: [] for name in WALL_COLUMNS})


def contact_table(state, i, j):
    return pd.DataFrame(dict(zip(COLUMNS, (state, i, j, 0.01, 1.0, 0.1), strict=True)))


def packing(rng, grading, laws, grains=1000):
    """Return radii and contacts whose ends are drawn by a contact number in each state.

    Each law gives a contact number of any scale; a grain has six on average.
    """
    radii = grading.rvs(grains, rng)
    tables = []
    for state, law in laws.items():
        weight = law(radii)
        ends = rng.choice(grains, (2, 3 * grains), p=weight / weight.sum())
        tables.append(contact_table(state, *ends))
    return radii, pd.concat(tables, ignore_index=True)


def path_of(states=STATES):
    number = np.arange(len(states))
    return pd.DataFrame(
        {
            "state": states,
            "solid_fraction": 0.65 + 0.04 * number,
            "solid_fraction_above_jamming": 0.01 + 0.04 * number,
            "mean_stress_Pa": 1e4 * (number + 1.0),
        }
    )


def sample(grading, laws, seeds=4, state=1, grains=1000):
    """Return the packings, what is kept of their contacts, and the classes of a sample."""
    rng = np.random.default_rng(state)
    packings = [packing(rng, grading, laws, grains) for _ in range(seeds)]
    classes = sample_classes(grading, *packings[0], NO_WALLS, max(laws))
    kept = [seed_contacts(grading, classes, *one, NO_WALLS, list(laws)) for one in packings]
    return packings, kept, classes


@pytest.fixture(scope="module")
def models():
    return predictions(GRADING, EDGES)


@pytest.fixture(scope="module")
def growing():
    """A sample whose contact numbers grow as R near jamming, and as R^2 at the end."""
    return sample(GRADING, {STATES[0]: lambda r: r, STATES[1]: lambda r: r**2})


def rows_of(kept, models, edges=EDGES, path=None):
    path = path_of() if path is None else path
    return pd.DataFrame(length_prediction_rows(kept, models, edges, path, **MEASURED))


# --- predictions ---------------------------------------------------------------------------------


def test_measured_contact_numbers_tell_the_lengths_of_contacts_drawn_by_them(growing, models):
    _, kept, _ = growing
    rows = rows_of(kept, models)
    for state in STATES:
        here = rows[rows["state"] == state].set_index("prediction")
        # 12 000 branches; the limit of Kolmogorov and Smirnov for 1 in 100 000 is 2.5/sqrt(M).
        assert here["branches"].tolist() == [12_000] * len(here)
        assert here["kolmogorov_smirnov"]["configuration"] < 2.5 / 12_000**0.5
        assert here["kolmogorov_smirnov"]["random_contact"] > 0.15


def test_random_contacts_are_right_where_all_grains_have_as_many(models):
    _, kept, _ = sample(GRADING, {2: np.ones_like, 5: np.ones_like})
    rows = rows_of(kept, models).set_index("prediction")
    # The radii drawn, 4000 of them, are not quite those of the grading.
    assert np.all(rows["kolmogorov_smirnov"]["random_contact"] < 0.06)
    assert np.all(rows["kolmogorov_smirnov"]["configuration"] < 2.5 / 12_000**0.5)
    assert np.all(rows["kolmogorov_smirnov"]["surface"] > 0.15)


def test_a_model_is_right_where_contacts_are_drawn_by_it(models):
    truth = models["parking"]
    order = np.argsort(truth.radius)

    def law(radius):
        return np.interp(radius, truth.radius[order], truth.contacts[order])

    _, kept, _ = sample(GRADING, {2: law, 5: law})
    rows = rows_of(kept, models).set_index("prediction")
    distance = rows["kolmogorov_smirnov"]
    assert np.all(distance["parking"] < 0.05)
    assert np.all(distance["random_contact"] > 0.2)


def test_large_grains_that_touch_only_small_ones_are_no_configuration():
    # Two sizes, every contact between them: one length, where drawing apart gives three.
    grading = from_radii([1.0, 3.0])
    rng = np.random.default_rng(0)
    radii = np.repeat([1.0, 3.0], 200)
    table = contact_table(0, rng.integers(0, 200, 600), rng.integers(200, 400, 600))
    classes = sample_classes(grading, radii, table, NO_WALLS, 0)
    kept = [seed_contacts(grading, classes, radii, table, NO_WALLS, [0])]
    edges, path = fine_edges(1.0, 3.0), path_of([0])
    rows = length_prediction_rows(kept, predictions(grading, edges), edges, path, **MEASURED)
    assert rows[0]["prediction"] == "configuration"
    assert rows[0]["kolmogorov_smirnov"] == pytest.approx(0.25, abs=1e-12)
    found = touching_summary(kept, {}, rows, path, **MEASURED)["end"]
    assert found["assortativity_of_radii"] == pytest.approx(-1.0, abs=1e-12)
    assert found["assortativity_of_log_radii"] == pytest.approx(-1.0, abs=1e-12)


def test_every_state_and_prediction_has_a_row_with_the_states_own_numbers(growing, models):
    packings, kept, _ = growing
    rows = rows_of(kept, models)
    assert len(rows) == 2 * (1 + len(models))
    assert rows["prediction"].tolist() == 2 * ["configuration", *models]
    for number, state in path_of().iterrows():
        here = rows[rows["state"] == state["state"]]
        for name in state.index:
            assert np.all(here[name] == state[name])
        lengths = np.concatenate(
            [
                radii[table["i"]] + radii[table["j"]]
                for radii, contacts in packings
                for table in [contacts[contacts["state"] == STATES[number]]]
            ]
        )
        assert_allclose(here["measured_mean_length_m"], lengths.mean(), rtol=1e-3)
        assert np.all(here["measured_mean_length_low_m"] < here["measured_mean_length_m"])
        assert np.all(here["measured_mean_length_high_m"] > here["measured_mean_length_m"])
        ends = here.set_index("prediction")["mean_length_m"]
        assert ends["configuration"] == pytest.approx(lengths.mean(), rel=0.01)
    # What the grading alone says is the same in every state.
    known = rows[rows["prediction"] != "configuration"].groupby("prediction")
    assert np.all(known["mean_length_m"].nunique() == 1)


def test_order_of_seeds_does_not_matter(growing, models):
    _, kept, _ = growing
    one, other = rows_of(kept, models), rows_of(kept[::-1], models)
    for name in ("kolmogorov_smirnov", "measured_mean_length_m", "mode_length_m"):
        assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-9)


def test_the_same_contacts_give_the_same_rows_and_intervals(growing, models):
    _, kept, _ = growing
    assert rows_of(kept, models).equals(rows_of(kept, models))


# --- contact numbers -----------------------------------------------------------------------------


def test_contact_numbers_by_class_follow_the_law_they_were_drawn_with(growing, models):
    packings, kept, classes = growing
    numbers, pairs = contact_number_rows(kept, models, classes, path_of(), **MEASURED)
    radius = np.concatenate([radii for radii, _ in packings])
    for state, power in zip(STATES, (1, 2), strict=True):
        here = numbers[numbers["state"] == state]
        group = np.searchsorted(classes, radius, side="right") - 1
        weight = np.concatenate([6.0 * r**power / np.mean(r**power) for r, _ in packings])
        expected = np.bincount(group, weight) / np.bincount(group)
        noise = np.sqrt(expected / here["grains"].to_numpy())
        assert np.all(np.abs(here["contact_number"].to_numpy() - expected) < 4.5 * noise)
        assert here["grains"].sum() == 4000
        ratio = pairs[pairs["state"] == state]
        noise = np.sqrt(2.0 / ratio["expected_contacts"])
        assert np.all(np.abs(ratio["ratio"] - 1.0) < 4.5 * noise)


def test_contact_numbers_of_the_models_are_those_of_their_classes(growing, models):
    _, kept, classes = growing
    numbers, _ = contact_number_rows(kept, models, classes, path_of(), **MEASURED)
    # Uniform radii: c = 3 + 3 R^2/<R^2>, and <R^2> = (a^2 + a b + b^2)/3 over any interval.
    low, high = classes[:-1], classes[1:]
    expected = 3.0 + 3.0 * (low**2 + low * high + high**2) / (1 + 20 + 400)
    for state in STATES:
        here = numbers[numbers["state"] == state]
        assert_allclose(here["contact_number_surface"], expected, rtol=0.02)
    assert "contact_number_random_contact" not in numbers


def test_sizes_of_one_class_count_by_their_number_of_grains():
    # <R^2> is 0.8 + 0.4 + 0.9: c is 3 + 3 R^2/2.1.
    grading = from_radii([1.0] * 8 + [2.0, 3.0])
    classes, path = np.array([1.0, 2.5, 3.0]), path_of([0])
    radii, contacts = packing(np.random.default_rng(0), grading, {0: np.square}, 50)
    kept = [seed_contacts(grading, classes, radii, contacts, NO_WALLS, [0])]
    models = predictions(grading, fine_edges(1.0, 3.0))
    numbers, _ = contact_number_rows(kept, models, classes, path, **MEASURED)
    expected = [3 + (8 * 1 + 4) / 9 * 3 / 2.1, 3 + 9 * 3 / 2.1]
    assert_allclose(numbers["contact_number_surface"], expected, rtol=1e-12)


def test_classes_reach_from_one_end_of_the_grading_to_the_other(growing):
    *_, classes = growing
    assert (classes[0], classes[-1]) == (1.0, 20.0)
    assert np.all(np.diff(classes) > 0)
    assert 5 <= classes.size <= 11


# --- summary -------------------------------------------------------------------------------------


def test_summary_says_what_the_rows_say_of_the_first_and_the_last_state(growing, models):
    _, kept, _ = growing
    rows = length_prediction_rows(kept, models, EDGES, path_of(), **MEASURED)
    summary = touching_summary(kept, models, rows, path_of(), **MEASURED)
    assert summary["seeds"] == 4
    for where, row in (("near_jamming", 0), ("end", 1)):
        found, state = summary[where], path_of().iloc[row]
        assert found["state"] == STATES[row]
        assert found["solid_fraction"] == state["solid_fraction"]
        assert found["solid_fraction_above_jamming"] == state["solid_fraction_above_jamming"]
        assert found["coordination_number"] == 6.0
        here = [line for line in rows if line["state"] == STATES[row]]
        assert found["mean_length_m"] == here[0]["measured_mean_length_m"]
        assert found["mode_length_m"] == here[0]["measured_mode_length_m"]
        for line, said in zip(here, found["predictions"], strict=True):
            assert said["name"] == line["prediction"]
            for name in ("kolmogorov_smirnov", "mean_length_m", "mode_length_m"):
                assert said[name] == line[name]
        # Both ends were drawn apart.
        for kind in ("radii", "log_radii"):
            assert abs(found[f"assortativity_of_{kind}"]) < 4.5 / 12_000**0.5
        assert 0.0 < found["rattler_fraction"] < 0.5
    assert summary["near_jamming"]["mean_length_m"] < summary["end"]["mean_length_m"]
    said = {model["name"]: model for model in summary["models"]}
    assert list(said) == [name for name in models if name != "random_contact"]
    assert said["surface"] == {
        "name": "surface",
        "coordination_number": pytest.approx(6.0),
        "rattler_fraction": pytest.approx(0.0, abs=1e-12),
    }
    assert 0.3 < said["parking"]["rattler_fraction"] < 0.6


def test_one_seed_has_no_limits_and_one_state_is_the_end_and_not_near_jamming(models):
    _, kept, classes = sample(GRADING, {3: np.square}, seeds=1)
    path = path_of([3])
    rows = length_prediction_rows(kept, models, EDGES, path, **MEASURED)
    summary = touching_summary(kept, models, rows, path, **MEASURED)
    numbers, pairs = contact_number_rows(kept, models, classes, path, **MEASURED)
    assert list(summary) == ["seeds", "end", "models"]
    assert summary["end"]["state"] == 3
    assert_array_equal(numbers["state"], np.full(len(classes) - 1, 3))
    assert len(pairs) == (len(classes) - 1) ** 2
    assert len(rows) == 1 + len(models)
    for name in ("low", "high"):
        assert np.isnan(rows[0][f"measured_mean_length_{name}_m"])
        assert np.isnan(summary["end"][f"assortativity_of_radii_{name}"])
        assert np.isnan(numbers[f"contact_number_{name}"]).all()
    assert np.isfinite(rows[0]["measured_mean_length_m"])
    assert np.isfinite(summary["end"]["assortativity_of_radii"])


@pytest.mark.filterwarnings("error")
def test_equal_spheres_have_one_class_one_length_and_no_likeness():
    grading = single(2.0)
    _, kept, classes = sample(grading, {0: np.ones_like}, seeds=2, grains=200)
    edges, path = fine_edges(2.0, 2.0), path_of([0])
    models = predictions(grading, edges)
    assert classes.tolist() == [2.0, 2.0]
    rows = rows_of(kept, models, edges, path)
    assert_allclose(rows["kolmogorov_smirnov"], 0.0, atol=1e-12)
    assert_allclose(rows["mode_length_m"], 4.0, rtol=1e-4)
    numbers, _ = contact_number_rows(kept, models, classes, path, **MEASURED)
    assert numbers["contact_number"].tolist() == [6.0]
    assert numbers["grains"].tolist() == [400]
    summary = touching_summary(kept, models, rows.to_dict("records"), path, **MEASURED)
    assert np.isnan(summary["end"]["assortativity_of_radii"])


def test_lengths_of_the_last_state_are_kept_branch_by_branch(growing):
    packings, kept, _ = growing
    for (radii, contacts), seed in zip(packings, kept, strict=True):
        last = contacts[contacts["state"] == STATES[-1]]
        assert_allclose(seed.length, radii[last["i"]] + radii[last["j"]], rtol=1e-15)
        assert seed.lengths.sum(axis=1).tolist() == [3000, 3000]


# --- mean path -----------------------------------------------------------------------------------


def test_mean_path_has_a_row_a_state_with_the_means_of_the_seeds():
    paths = [
        pd.DataFrame(
            {
                "state": [4, 9],
                "solid_fraction": [0.66 + shift, 0.70 + shift],
                "mean_stress_Pa": [1e4 * factor, 5e4 * factor],
                "leg": "loading",
            }
        )
        for shift, factor in ((0.0, 1.0), (0.02, 2.0), (0.01, 3.0))
    ]
    found = mean_path(paths, 0.65)
    assert found.columns.tolist() == [
        "state",
        "solid_fraction",
        "solid_fraction_above_jamming",
        "mean_stress_Pa",
    ]
    assert found["state"].tolist() == [4, 9]
    assert_allclose(found["solid_fraction"], [0.67, 0.71], rtol=1e-12)
    assert_allclose(found["solid_fraction_above_jamming"], [0.02, 0.06], rtol=1e-9)
    assert_allclose(found["mean_stress_Pa"], [2e4, 1e5], rtol=1e-12)
    assert_allclose(mean_path(paths[::-1], 0.65), found, rtol=1e-12)
