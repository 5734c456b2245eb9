"""The energy split of all seeds, on contacts whose energies follow a known law exactly."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.energy.designs import log_length
from branchcrush.errors import FitError
from branchcrush.gradings.forms import uniform
from branchcrush.samples.energy_split import (
    end_state,
    energy_split_results,
    exponents_along_path,
    final_energy_split,
)
from branchcrush.statistics.bins import binned_sums
from branchcrush.statistics.power_law import power_law_fit
from tests.unit.samples.exact_contacts import (
    AMPLITUDE,
    CENTRES,
    EDGES,
    branches_of,
    contacts_of,
)

JAMMING, OPTIONS = 0.65, {"confidence": 0.95, "resamples": 200}


def path_of(*states, solid_fraction=0.7):
    states = np.array(states)
    return pd.DataFrame(
        {
            "state": states,
            "solid_fraction": solid_fraction + 0.01 * states,
            "volume_m3": 2.0,
            "mean_stress_Pa": 1e5 * states,
            "elastic_energy_J": 3.0 * states,
            "coordination_number": 5.0 + states,
            "mechanical_coordination_number": 6.0 + states,
            "rattler_fraction": 0.2 - 0.05 * states,
        }
    )


def split_of(branches, paths):
    """Return the bins and what `energy_split.json` holds."""
    packings = end_state(branches, paths, JAMMING)
    table, fit = final_energy_split(branches, paths, EDGES, packings, **OPTIONS)
    return table, fit.result()


def exponents_of(branches, paths):
    return exponents_along_path(branches, paths, JAMMING, **OPTIONS)


@pytest.fixture
def contacts():
    """Three seeds: n = 2 in state 1 and n = 3 at the end; state 0 is not certified."""
    return [contacts_of(seed, [1.0, 2.0, 3.0]) for seed in range(3)]


@pytest.fixture
def sample(contacts):
    paths = [path_of(1, 2, solid_fraction=0.7 + 0.001 * seed) for seed in range(3)]
    return branches_of(contacts, 1, 2), paths


def test_seed_by_seed_gives_what_all_contacts_at_once_give(sample, contacts):
    # The same from all contacts in one table.
    ends = pd.concat([table[table["state"] == 2] for table in contacts])
    length = ends["radius_i_m"] + ends["radius_j_m"]
    branches, paths = sample
    table, fit = split_of(branches, paths)
    counts, lengths, energies = binned_sums(length, ends["energy_J"], EDGES)
    assert_array_equal(table["branches"], counts)
    assert_allclose(table["branch_length_m"], lengths / counts, rtol=1e-13)
    assert_allclose(table["mean_energy_J"], energies / counts, rtol=1e-13)
    whole = power_law_fit(length, ends["energy_J"])
    assert fit["predictors"][0]["exponent"] == pytest.approx(float(whole.exponent), rel=1e-12)


def test_drawn_energies_give_back_the_exponent_and_an_interval_that_holds_it():
    rng = np.random.default_rng(3)
    contacts = [contacts_of(seed, [2.6, 2.6]) for seed in range(8)]
    for table in contacts:
        table["energy_J"] *= rng.standard_exponential(len(table))
    branches, paths = branches_of(contacts, 0, 1), [path_of(0, 1)] * 8
    _, fit = split_of(branches, paths)
    along = exponents_of(branches, paths)
    assert (along["exponent_low"] < 2.6).all()
    assert (along["exponent_high"] > 2.6).all()
    lengths = np.concatenate([log_length(*seed.last[:2]) for seed in branches])
    # Of energies whose coefficient of variation is 1.
    error = 1.0 / (lengths.std() * np.sqrt(lengths.size))
    assert fit["predictors"][0]["exponent"] == pytest.approx(2.6, abs=3 * error)


# --- the end of the path -------------------------------------------------------------------------


def test_exact_cubic_energies_give_an_exponent_of_3_however_it_is_found(sample):
    _, fit = split_of(*sample)
    found = [fit["exponent"], fit["exponent_low"], fit["exponent_high"]]
    found += [*fit["exponent_of_each_seed"], fit["mean_of_seed_exponents"]]
    found += [fit["predictors"][0]["exponent"], fit["curvature"]["slope_at_90_percent"]]
    found += [part["exponent"] for part in fit["local_exponents"]]
    assert list(fit["estimators"]) == ["gamma_regression", "least_squares", "log_log"]
    found += [value["estimate"] for value in fit["estimators"].values()]
    assert_allclose(found, 3.0, rtol=0, atol=1e-9)
    assert_allclose(fit["amplitude_J_per_m_n"], AMPLITUDE, rtol=1e-8)
    assert_allclose([fit["cubic_slope"], fit["cubic_r_squared"]], 1.0, rtol=1e-9)


@pytest.mark.parametrize("loaded", [0, 1])
def test_first_state_with_energy_in_hardly_a_seed_leaves_the_fit_of_the_last(contacts, loaded):
    # Close to jamming one packing may carry load and the others not yet.
    kept = [table[(table["state"] != 1) | (seed < loaded)] for seed, table in enumerate(contacts)]
    paths = [path_of(1, 2)] * 3
    _, fit = split_of(branches_of(kept, 1, 2), paths)
    assert fit["exponent"] == pytest.approx(3.0, abs=1e-9)
    near = fit["near_jamming"]["predictors"]
    assert all(("reason" in entry) != ("left_out_reason" in entry) for entry in near)
    assert ("exponent" in near[0]) == bool(loaded)


def test_energy_density_is_the_mean_of_those_of_the_packings(sample):
    branches, paths = sample
    paths = [path.assign(volume_m3=volume) for path, volume in zip(paths, (2, 3, 4), strict=True)]
    _, fit = split_of(branches, paths)
    # 6 J in 2, 3 and 4 m3: 3, 2 and 1.5 J/m3.
    assert_allclose(fit["elastic_energy_J_per_m3"], 6.5 / 3, rtol=1e-14)


def test_fit_says_what_it_is_made_from(sample, contacts):
    branches, paths = sample
    _, fit = split_of(branches, paths)
    assert (fit["seeds"], fit["branches"], fit["confidence"]) == (3, 500 + 510 + 520, 0.95)
    assert_allclose(fit["solid_fraction"], 0.721, rtol=1e-14)
    assert (fit["jamming_solid_fraction"], fit["mean_stress_Pa"]) == (0.65, 2e5)
    # 6 J in 2 m3.
    assert fit["elastic_energy_J_per_m3"] == 3.0
    assert fit["coordination_number"] == 7.0
    assert fit["mechanical_coordination_number"] == 8.0
    assert fit["rattler_fraction"] == pytest.approx(0.1, rel=1e-14)
    ends = pd.concat([table[table["state"] == 2] for table in contacts])
    ratio = np.median(ends["overlap_m"] / ends["branch_length_m"])
    assert_allclose(fit["median_overlap_over_length"], ratio, rtol=1e-14)


def test_table_holds_the_bins_and_the_split_relative_to_the_largest_radius(sample):
    table, fit = split_of(*sample)
    assert_array_equal(table["length_low_m"], EDGES[:-1])
    assert_array_equal(table["length_high_m"], EDGES[1:])
    assert table["branches"].sum() == fit["branches"]
    assert_allclose(table["branch_length_m"], CENTRES, rtol=1e-12)
    assert_allclose(table["mean_energy_J"], AMPLITUDE * CENTRES**3, rtol=1e-9)
    # R_max is nearer to the tenth centre than to the eleventh.
    assert fit["reference_length_m"] == pytest.approx(CENTRES[9], rel=1e-12)
    assert_allclose(table["f"], (CENTRES / CENTRES[9]) ** 3, rtol=1e-9)


def test_seeds_of_different_exponents_are_listed_and_widen_the_interval(sample):
    _, paths = sample
    contacts = [contacts_of(0, [1.0, 2.0, exponent]) for exponent in (2.9, 3.0, 3.1)]
    branches = branches_of(contacts, 1, 2)
    _, fit = split_of(branches, paths)
    assert_allclose(fit["exponent_of_each_seed"], [2.9, 3.0, 3.1], atol=1e-9)
    assert fit["mean_of_seed_exponents"] == pytest.approx(3.0, abs=1e-9)
    assert fit["exponent_low"] < 2.9
    assert fit["exponent_high"] > 3.1
    # Energies at a millimetre differ by 1000^0.1 = 2, so that the pooled fit is no plain mean.
    assert 2.9 < fit["exponent"] < 3.0


def test_one_seed_gives_a_fit_without_an_interval():
    branches, paths = branches_of([contacts_of(0, [3.0])], 0), [path_of(0)]
    _, fit = split_of(branches, paths)
    assert fit["exponent"] == pytest.approx(3.0, abs=1e-9)
    assert np.isnan([fit["exponent_low"], fit["exponent_high"]]).all()


def test_what_is_told_near_jamming_is_of_the_first_state(sample):
    _, fit = split_of(*sample)
    near = fit["near_jamming"]
    assert near["state"] == 1
    # 0.71, 0.711 and 0.712.
    assert near["solid_fraction"] == pytest.approx(0.711, rel=1e-12)
    assert near["predictors"][0]["exponent"] == pytest.approx(2.0, abs=1e-9)
    assert near["curvature"]["slope_at_mean"] == pytest.approx(2.0, abs=1e-7)
    assert near["curvature"]["curvature"] == pytest.approx(0.0, abs=1e-7)
    assert fit["curvature"]["slope_at_mean"] == pytest.approx(3.0, abs=1e-7)


def test_one_state_is_the_end_and_not_near_jamming(contacts):
    _, fit = split_of(branches_of(contacts, 2), [path_of(2)] * 3)
    assert "near_jamming" not in fit
    _, fit = split_of(branches_of(contacts, 1, 2), [path_of(1, 2)] * 3)
    assert fit["near_jamming"]["state"] == 1


def test_same_tables_give_the_same_result():
    branches = branches_of([contacts_of(seed, [2.8 + 0.1 * seed]) for seed in range(4)], 0)
    paths = [path_of(0)] * 4
    (table, fit), (other_table, other_fit) = (split_of(branches, paths) for _ in range(2))
    # As text: there is no interval where all energies are exact, and nan differs from itself.
    assert repr(fit) == repr(other_fit)
    for name in table:
        assert_array_equal(table[name], other_table[name])


def test_branches_of_one_length_bear_no_exponent(sample, contacts):
    _, paths = sample
    same = [
        table.assign(radius_i_m=CENTRES[9] / 2, radius_j_m=CENTRES[9] / 2) for table in contacts
    ]
    with pytest.raises(FitError, match="two or more branch lengths"):
        split_of(branches_of(same, 1, 2), paths)


# --- along the path ------------------------------------------------------------------------------


def test_exponent_is_followed_along_the_loaded_states(sample):
    along = exponents_of(*sample)
    assert along["state"].tolist() == [1, 2]
    for name in ("exponent", "exponent_low", "exponent_high"):
        assert_allclose(along[name], [2.0, 3.0], rtol=0, atol=1e-9)
    assert along["branches"].tolist() == [400 + 410 + 420, 500 + 510 + 520]
    assert_allclose(along["solid_fraction"], [0.711, 0.721], rtol=1e-14)
    assert_allclose(along["solid_fraction_above_jamming"], [0.061, 0.071], rtol=1e-12)
    assert_allclose(along["mean_stress_Pa"], [1e5, 2e5], rtol=1e-14)
    assert along["median_overlap_over_length"].is_monotonic_decreasing


def test_state_with_too_few_branches_has_no_exponent_and_the_others_keep_theirs(sample, contacts):
    _, paths = sample
    # One length alone is left in state 1, as close to jamming.
    few = [table[table["state"] == 2] for table in contacts]
    few[0] = pd.concat([contacts[0][contacts[0]["state"] == 1][:1], few[0]])
    along = exponents_of(branches_of(few, 1, 2), paths)
    assert along["state"].tolist() == [1, 2]
    assert along.loc[0, ["exponent", "exponent_low", "exponent_high"]].isna().all()
    assert along["exponent"][1] == pytest.approx(3.0, abs=1e-9)


def test_last_row_along_the_path_is_the_fit_of_its_end():
    contacts = [contacts_of(seed, [2.0, 2.8 + 0.1 * seed]) for seed in range(4)]
    branches, paths = branches_of(contacts, 0, 1), [path_of(0, 1)] * 4
    _, fit = split_of(branches, paths)
    along = exponents_of(branches, paths)
    names = ["exponent", "exponent_low", "exponent_high", "branches", "median_overlap_over_length"]
    assert along.iloc[-1][names].tolist() == [fit[name] for name in names]


# --- the rule ------------------------------------------------------------------------------------

GRADING = uniform(5e-6, 1e-3)
RULE = {"bins": 20, **OPTIONS}


def rule_on(contacts, *, last_certified=True):
    """Return what the rule makes of three seeds of which the second is not certified."""
    paths = [
        path_of(0, 1, 2).assign(leg="loading", carries_load=[False, True, True]) for _ in range(3)
    ]
    parts = [
        path.assign(seed=seed, certified=[False, True, last_certified and seed != 1])
        for seed, path in enumerate(paths)
    ]
    jamming = pd.DataFrame({"jamming_solid_fraction_loading": [0.60, 0.10, 0.62]})
    read = []

    def read_seed(number):
        read.append(number)
        return contacts[number]

    certificate = pd.concat(parts, ignore_index=True)
    return *energy_split_results(GRADING, certificate, paths, jamming, read_seed, **RULE), read


def test_rule_reads_the_certified_seeds_one_by_one_and_takes_their_own_jamming(contacts):
    tables, fit, read = rule_on(contacts)
    assert read == [0, 2]
    assert fit.exponent.estimate == pytest.approx(3.0, abs=1e-9)
    assert fit.packings.seeds == 2
    assert fit.packings.branches == 500 + 520
    assert fit.packings.jamming_solid_fraction == pytest.approx(0.61)
    assert tables["path"]["state"].tolist() == [1, 2]
    assert_allclose(tables["path"]["solid_fraction_above_jamming"], [0.10, 0.11], rtol=1e-9)
    assert tables["table"]["branches"].sum() == 500 + 520


def test_rule_without_a_certified_seed_says_why_and_reads_nothing(contacts):
    tables, fit, read = rule_on(contacts, last_certified=False)
    assert read == []
    assert fit.reason.startswith("no packing is certified at the end of its loading: 3 of 3")
    assert fit.packings is None
    assert tables == {name: {"reason": [fit.reason]} for name in ("table", "path", "ratio")}


def test_rule_on_branches_of_one_length_keeps_what_is_known_of_the_packings(contacts):
    same = [table.assign(radius_i_m=2e-4, radius_j_m=3e-4) for table in contacts]
    tables, fit, _ = rule_on(same)
    assert "two or more branch lengths" in fit.reason
    assert fit.packings.branches == 500 + 520
    assert tables["table"] == {"reason": [fit.reason]}
