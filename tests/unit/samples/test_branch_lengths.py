"""Contacts of a sample drawn by known contact numbers, beside what the predictions say."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.branches.predictions import fine_edges, predictions
from branchcrush.gradings.mixtures import from_radii
from branchcrush.samples.branch_lengths import branch_length_results, length_prediction_rows
from branchcrush.samples.contact_numbers import contact_number_summary
from branchcrush.samples.seed_contacts import sample_contacts
from tests.unit.samples.drawn_contacts import (
    EDGES,
    GRADING,
    MEASURED,
    NO_WALLS,
    STATES,
    contact_table,
    growing_sample,
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
    kept, _ = sample_contacts(grading, lambda _: (radii, table, NO_WALLS), [0], [0])
    edges, path = fine_edges(1.0, 3.0), path_of([0])
    rows = length_prediction_rows(kept, predictions(grading, edges), edges, path, **MEASURED)
    assert rows[0]["prediction"] == "configuration"
    assert rows[0]["kolmogorov_smirnov"] == pytest.approx(0.25, abs=1e-12)
    end = contact_number_summary(kept, {}, rows, path, **MEASURED)["end"]
    assert end["assortativity_of_radii"] == pytest.approx(-1.0, abs=1e-12)
    assert end["assortativity_of_log_radii"] == pytest.approx(-1.0, abs=1e-12)


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


# --- the rule ------------------------------------------------------------------------------------

TABLES = ("table", "predictions", "numbers", "pairs", "coordination")


def rule_on(packings, states, *, end=True):
    """Return what the rule makes of three seeds of which the second is not certified."""
    path = path_of(states).assign(
        leg="loading",
        carries_load=True,
        volume_m3=2.0,
        void_ratio=0.5,
        coordination_number=6.0,
        mechanical_coordination_number=6.0,
        rattler_fraction=0.0,
    )
    parts = [path.assign(seed=seed, certified=end and seed != 1) for seed in range(3)]
    jamming = pd.DataFrame({"jamming_solid_fraction_loading": [0.60, 0.10, 0.62]})
    read = []

    def read_seed(number):
        read.append(number)
        return *packings[number], NO_WALLS

    certificate = pd.concat(parts, ignore_index=True)
    rule = branch_length_results(
        GRADING, certificate, [path] * 3, jamming, read_seed, bins=19, **MEASURED
    )
    return *rule, read


def test_rule_reads_the_certified_seeds_one_by_one_and_tells_of_each_state(growing):
    packings, _, _ = growing
    tables, results, read = rule_on(packings, STATES)
    assert read == [0, 2]
    assert list(tables) == list(TABLES)
    # Branches of the last state, in bins of 2 from the smallest diameter to the largest.
    assert tables["table"]["length_low_m"].tolist() == [2.0 * k for k in range(1, 20)]
    lengths = [
        radii[table["i"]] + radii[table["j"]]
        for radii, contacts in (packings[0], packings[2])
        for table in [contacts[contacts["state"] == STATES[-1]]]
    ]
    counts = np.histogram(np.concatenate(lengths), np.arange(2.0, 41.0, 2.0))[0]
    assert tables["table"]["branches"].tolist() == counts.tolist()
    assert {row["state"] for row in tables["predictions"]} == set(STATES)
    # From the mean of the two points, and each packing from its own.
    assert_allclose(tables["predictions"][0]["solid_fraction_above_jamming"], 0.65 - 0.61)
    assert_allclose(
        tables["coordination"]["solid_fraction_above_jamming"], [0.05, 0.09, 0.03, 0.07]
    )
    assert set(tables["numbers"]["state"]) == set(tables["pairs"]["state"]) == set(STATES)
    statistics, summary = results["statistics"], results["contact_numbers"]
    assert (statistics["grains"], statistics["branches"]) == (1000, 3000)
    assert statistics["branch_density_per_m3"] == 3000 / 2.0
    assert (summary["seeds"], summary["end"]["state"]) == (2, STATES[-1])


def test_rule_without_a_certified_seed_says_why_and_reads_nothing(growing):
    tables, results, read = rule_on(growing[0], STATES, end=False)
    assert read == []
    reason = results["statistics"]["reason"]
    assert reason.startswith("no packing is certified at the end of its loading: 3 of 3 carry")
    assert results == {key: {"reason": reason} for key in ("statistics", "contact_numbers")}
    assert tables == {key: {"reason": [reason]} for key in TABLES}
