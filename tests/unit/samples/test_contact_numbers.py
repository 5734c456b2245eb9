"""Contact numbers by radius of contacts drawn by a known law, beside those of the models."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.branches.predictions import fine_edges, predictions
from branchcrush.gradings.mixtures import from_radii, mixture, single
from branchcrush.samples.branch_lengths import length_prediction_rows
from branchcrush.samples.contact_numbers import (
    contact_number_rows,
    contact_number_summary,
    coordination_table,
)
from branchcrush.samples.seed_contacts import seed_contacts
from tests.unit.samples.drawn_contacts import (
    EDGES,
    GRADING,
    MEASURED,
    NO_WALLS,
    STATES,
    contact_table,
    growing_sample,
    packing,
    path_of,
    sample,
)


@pytest.fixture(scope="module")
def models():
    return predictions(GRADING, EDGES)


@pytest.fixture(scope="module")
def growing():
    return growing_sample()


def rows_of(kept, models, edges=EDGES, path=None):
    path = path_of() if path is None else path
    return pd.DataFrame(length_prediction_rows(kept, models, edges, path, **MEASURED))


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


# --- summary -------------------------------------------------------------------------------------


def test_summary_says_what_the_rows_say_of_the_first_and_the_last_state(growing, models):
    _, kept, _ = growing
    rows = length_prediction_rows(kept, models, EDGES, path_of(), **MEASURED)
    summary = contact_number_summary(kept, models, rows, path_of(), **MEASURED)
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
    assert said["parking"]["solution"] == "only"
    assert "solution" not in said["rods"]


def test_two_solutions_of_random_parking_are_told(growing):
    # A fifth of the mass six times finer.
    grading = mixture([single(6.0), single(1.0)], [0.8, 0.2], "mass")
    _, kept, _ = growing
    models = predictions(grading, fine_edges(1.0, 6.0))
    rows = length_prediction_rows(kept, models, EDGES, path_of(), **MEASURED)
    summary = contact_number_summary(kept, models, rows, path_of(), **MEASURED)
    (parking,) = (model for model in summary["models"] if model["name"] == "parking")
    assert parking["solution"] == "coarse"
    assert parking["rattler_fraction"] > 0.97
    assert parking["other_rattler_fraction"] < 0.1
    assert parking["other_coordination_number"] == pytest.approx(
        6.0 * (1.0 - parking["other_rattler_fraction"])
    )


def test_one_seed_has_no_limits_and_one_state_is_the_end_and_not_near_jamming(models):
    _, kept, classes = sample(GRADING, {3: np.square}, seeds=1)
    path = path_of([3])
    rows = length_prediction_rows(kept, models, EDGES, path, **MEASURED)
    summary = contact_number_summary(kept, models, rows, path, **MEASURED)
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
    summary = contact_number_summary(kept, models, rows.to_dict("records"), path, **MEASURED)
    assert np.isnan(summary["end"]["assortativity_of_radii"])


# --- coordination --------------------------------------------------------------------------------


def test_distance_to_jamming_is_that_to_the_packings_own_point():
    columns = ("void_ratio", "coordination_number", "mechanical_coordination_number")
    columns += ("rattler_fraction",)
    paths = [
        path_of().assign(solid_fraction=[0.65, 0.70], **dict.fromkeys(columns, float(seed)))
        for seed in range(2)
    ]
    _, kept, _ = sample(GRADING, {2: np.ones_like, 5: np.ones_like}, seeds=2, grains=100)
    kept = [seed._replace(isostatic=np.array([6.0, 5.5])) for seed in kept]
    table = coordination_table(kept, paths, [0.64, 0.60])
    assert table["seed_number"].tolist() == [0, 0, 1, 1]
    assert table["state"].tolist() == [2, 5, 2, 5]
    assert_allclose(table["solid_fraction_above_jamming"], [0.01, 0.06, 0.05, 0.10], rtol=1e-9)
    assert table["isostatic_number"].tolist() == [6.0, 5.5, 6.0, 5.5]
    for name in columns:
        assert table[name].tolist() == [0.0, 0.0, 1.0, 1.0]


def test_numbers_of_a_tetrahedron_and_a_rattler_are_counted_by_hand():
    # Four grains that all touch each other and a fifth that touches one of them: no grain has
    # four contacts left when it is gone, so all are rattlers.
    radii = np.array([1.0, 1.0, 1.0, 1.0, 2.0])
    i, j = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3], [0, 4]]).T
    grading = from_radii([1.0, 1.0, 1.0, 1.0, 2.0])
    kept = [seed_contacts(grading, [1.0, 1.5, 2.0], radii, contact_table(7, i, j), NO_WALLS, [7])]
    numbers, pairs = contact_number_rows(kept, {}, [1.0, 1.5, 2.0], path_of([7]), **MEASURED)
    assert numbers["contact_number"].tolist() == [13 / 4, 1.0]
    assert numbers["rattler_fraction"].tolist() == [1.0, 1.0]
    assert pairs["contacts"].tolist() == [12, 1, 1, 0]
    edges = fine_edges(1.0, 2.0)
    rows = length_prediction_rows(
        kept, predictions(grading, edges), edges, path_of([7]), **MEASURED
    )
    end = contact_number_summary(kept, {}, rows, path_of([7]), **MEASURED)["end"]
    assert (end["coordination_number"], end["rattler_fraction"]) == (14 / 5, 1.0)
    # Six branches of length 2 and one of 3.
    assert end["mean_length_m"] == pytest.approx(15 / 7, rel=1e-3)
