"""The seeds of a sample together, on contacts whose energies follow a known law exactly."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from pandas.testing import assert_frame_equal

from branchcrush.energy_split import bin_edges, binned_sums
from branchcrush.ensemble import (
    certified_loading,
    end_of_loading,
    exponents_along_path,
    final_branches,
    final_energy_split,
    on_the_way_in,
    split_sums,
    stacked,
)
from branchcrush.errors import FitError

RADIUS_MAX, STIFFNESS, AMPLITUDE = 1e-3, 1e6, 50.0
EDGES = bin_edges(5e-6, RADIUS_MAX, 20)
CENTRES = (EDGES[1:] + EDGES[:-1]) / 2
SETTINGS = {"jamming": 0.65, "confidence": 0.95, "resamples": 200}


def contacts_of(seed, exponents):
    """Return a contacts table: a state for each exponent, with energies A l^n exactly.

    The lengths of a bin are equal, so that bin means follow the law as the branches do.
    """
    rng = np.random.default_rng(seed)
    states = []
    for state, exponent in enumerate(exponents):
        length = np.sort(rng.choice(CENTRES, 300 + 10 * seed + 100 * state))
        share = rng.uniform(0.2, 0.8, length.size)
        energy = AMPLITUDE * length**exponent
        force = np.sqrt(2 * STIFFNESS * energy)
        table = {
            "state": state,
            "i": 0,
            "j": 1,
            "radius_i_m": share * length,
            "radius_j_m": length - share * length,
            "branch_length_m": length - force / STIFFNESS,
            "overlap_m": force / STIFFNESS,
            "normal_force_N": force,
            "energy_J": energy,
        }
        states.append(pd.DataFrame(table))
    return pd.concat(states, ignore_index=True)


def path_of(carries_load, solid_fraction=0.7):
    states = np.arange(len(carries_load))
    return pd.DataFrame(
        {
            "state": states,
            "leg": "loading",
            "solid_fraction": solid_fraction + 0.01 * states,
            "volume_m3": 2.0,
            "mean_stress_Pa": 1e5 * states,
            "elastic_energy_J": 3.0 * states,
            "carries_load": carries_load,
            "coordination_number": 5.0 + states,
            "mechanical_coordination_number": 6.0 + states,
            "rattler_fraction": 0.2 - 0.05 * states,
        }
    )


def certificate_of(*seeds):
    """Return a `certificate.csv`: a word for each seed, of c certified and n not, u unloading."""
    rows = [
        {
            "seed": seed,
            "state": state,
            "leg": "unloading" if letter == "u" else "loading",
            "certified": letter in "cu",
        }
        for seed, letters in enumerate(seeds, start=3)
        for state, letter in enumerate(letters)
    ]
    return pd.DataFrame(rows)


@pytest.fixture
def sample():
    """Three seeds: n = 2 in state 1 and n = 3 at the end, as `certified_loading` leaves them."""
    contacts = [contacts_of(seed, [1.0, 2.0, 3.0]) for seed in range(3)]
    paths = [path_of([False, True, True], 0.7 + 0.001 * seed) for seed in range(3)]
    _, paths, contacts = certified_loading(certificate_of("ncc", "ncc", "ncc"), paths, contacts)
    return contacts, paths


# --- states --------------------------------------------------------------------------------------


def tables_of(seeds, states=4):
    paths = [path_of([False] + [True] * (states - 1), 0.7 + 0.01 * seed) for seed in range(seeds)]
    contacts = [pd.DataFrame({"state": list(range(states)) * 2}) for _ in range(seeds)]
    return paths, contacts


def states_in(tables):
    return [sorted(set(table["state"])) for table in tables]


def test_certified_states_of_all_seeds_are_used():
    used, paths, contacts = certified_loading(certificate_of("nccc", "nccc"), *tables_of(2))
    assert used == [0, 1]
    assert states_in(paths) == states_in(contacts) == [[1, 2, 3]] * 2
    assert [len(table) for table in contacts] == [6, 6]
    assert paths[0].index.tolist() == [0, 1, 2]


def test_state_that_is_not_certified_in_one_seed_is_left_out_of_all():
    used, paths, contacts = certified_loading(certificate_of("nccc", "nncc"), *tables_of(2))
    assert used == [0, 1]
    assert states_in(paths) == states_in(contacts) == [[2, 3]] * 2


def test_seed_that_is_not_certified_at_its_end_is_dropped_and_its_states_do_not_count():
    used, paths, _ = certified_loading(certificate_of("nccc", "nncn", "nccc"), *tables_of(3))
    assert used == [0, 2]
    assert states_in(paths) == [[1, 2, 3]] * 2
    assert [path["solid_fraction"].iloc[0] for path in paths] == pytest.approx([0.71, 0.73])


def test_seed_that_stopped_on_the_way_is_dropped():
    paths, contacts = tables_of(2)
    used, _, _ = certified_loading(
        certificate_of("nccc", "ncc"), [paths[0], paths[1][:3]], contacts
    )
    assert used == [0]


def test_states_on_the_way_back_are_left_out():
    paths, contacts = tables_of(1, states=5)
    paths[0].loc[3:, "leg"] = "unloading"
    used, paths, contacts = certified_loading(certificate_of("nccuu"), paths, contacts)
    assert used == [0]
    assert states_in(paths) == states_in(contacts) == [[1, 2]]


def test_only_the_first_seeds_of_a_certificate_may_be_asked_for():
    used, _, _ = certified_loading(certificate_of("nccc", "nncc", "nccn"), *tables_of(2))
    assert used == [0, 1]


def test_sample_without_a_certified_end_is_no_data_and_says_how_far_it_came():
    paths, contacts = tables_of(2)
    paths[1]["carries_load"] = False
    with pytest.raises(FitError) as refused:
        certified_loading(certificate_of("nccn", "nnnn"), paths, contacts)
    # The mean of 0.73 and 0.74.
    assert str(refused.value) == (
        "no packing is certified at the end of its loading: 1 of 2 carry load there, at a solid "
        "fraction of 0.7350"
    )


def test_end_of_the_loading_is_before_the_way_back():
    path = path_of([True] * 4)
    assert end_of_loading(path)["state"] == 3
    path.loc[2:, "leg"] = "unloading"
    assert end_of_loading(path)["state"] == 1


def test_way_in_keeps_the_states_before_any_load():
    paths, _ = tables_of(3)
    for path in paths:
        path.loc[3, "leg"] = "unloading"
    assert states_in(on_the_way_in(paths, [0, 2])) == [[0, 1, 2]] * 2


def test_stacked_paths_keep_their_seeds_apart():
    together = stacked([path_of([True, True]), path_of([True, True], 0.8)])
    assert together["seed_number"].tolist() == [0, 0, 1, 1]
    assert together["solid_fraction"].tolist() == [0.7, 0.71, 0.8, 0.81]
    assert together.index.tolist() == [0, 1, 2, 3]


# --- branches ------------------------------------------------------------------------------------


def test_branches_of_the_end_are_those_of_the_last_state_of_each_seed(sample):
    contacts, _ = sample
    found = final_branches(contacts)
    assert [length.size for length in found] == [500, 510, 520]
    for length, table in zip(found, contacts, strict=True):
        last = table[table["state"] == 2]
        # The radii, not the distance of the centres that overlap has shortened.
        assert_array_equal(length, last["radius_i_m"] + last["radius_j_m"])


def test_sums_are_binned_seed_by_seed_for_one_state(sample):
    contacts, _ = sample
    sums = split_sums(contacts, 1, EDGES)
    assert sums.shape == (3, 3, 20)
    last = contacts[2][contacts[2]["state"] == 1]
    length = last["radius_i_m"] + last["radius_j_m"]
    assert_array_equal(sums[2], binned_sums(length, last["energy_J"], EDGES))
    assert sums[:, 0].sum(axis=1).tolist() == [400, 410, 420]


# --- the end of the path -------------------------------------------------------------------------


def test_exact_cubic_energies_give_an_exponent_of_3_however_it_is_found(sample):
    _, fit = final_energy_split(*sample, EDGES, **SETTINGS)
    found = [fit["exponent"], fit["exponent_low"], fit["exponent_high"]]
    found += [*fit["exponent_of_each_seed"], fit["mean_of_seed_exponents"]]
    found += [predictor["exponent"] for predictor in fit["predictors"]]
    assert_allclose(found, 3.0, rtol=0, atol=1e-9)
    assert_allclose(fit["amplitude_J_per_m_n"], AMPLITUDE, rtol=1e-8)
    assert_allclose([fit["cubic_slope"], fit["cubic_r_squared"]], 1.0, rtol=1e-9)


def test_fit_says_what_it_is_made_from(sample):
    contacts, paths = sample
    _, fit = final_energy_split(contacts, paths, EDGES, **SETTINGS)
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
    assert_allclose(fit["median_overlap_ratio"], ratio, rtol=1e-14)


def test_table_holds_the_bins_and_the_split_relative_to_the_largest_radius(sample):
    table, fit = final_energy_split(*sample, EDGES, **SETTINGS)
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
    _, fit = final_energy_split(contacts, paths, EDGES, **SETTINGS)
    assert_allclose(fit["exponent_of_each_seed"], [2.9, 3.0, 3.1], atol=1e-9)
    assert fit["mean_of_seed_exponents"] == pytest.approx(3.0, abs=1e-9)
    assert fit["exponent_low"] < 2.9
    assert fit["exponent_high"] > 3.1
    # Energies at a millimetre differ by 1000^0.1 = 2, so that the pooled fit is no plain mean.
    assert 2.9 < fit["exponent"] < 3.0


def test_one_seed_gives_a_fit_without_an_interval():
    contacts, paths = [contacts_of(0, [3.0])], [path_of([True])]
    _, fit = final_energy_split(contacts, paths, EDGES, **SETTINGS)
    assert fit["exponent"] == pytest.approx(3.0, abs=1e-9)
    assert np.isnan([fit["exponent_low"], fit["exponent_high"]]).all()


def test_same_tables_give_the_same_result():
    contacts = [contacts_of(seed, [2.8 + 0.1 * seed]) for seed in range(4)]
    paths = [path_of([True])] * 4
    (table, fit), (other_table, other_fit) = (
        final_energy_split(contacts, paths, EDGES, **SETTINGS) for _ in range(2)
    )
    assert fit == other_fit
    for name in table:
        assert_array_equal(table[name], other_table[name])


def test_branches_of_one_length_bear_no_exponent(sample):
    contacts, paths = sample
    same = [
        table.assign(radius_i_m=CENTRES[9] / 2, radius_j_m=CENTRES[9] / 2) for table in contacts
    ]
    with pytest.raises(FitError, match="two or more branch lengths"):
        final_energy_split(same, paths, EDGES, **SETTINGS)


# --- along the path ------------------------------------------------------------------------------


def test_exponent_is_followed_along_the_loaded_states(sample):
    contacts, paths = sample
    along = exponents_along_path(contacts, paths, EDGES, **SETTINGS)
    assert along["state"].tolist() == [1, 2]
    for name in ("exponent", "exponent_low", "exponent_high"):
        assert_allclose(along[name], [2.0, 3.0], rtol=0, atol=1e-9)
    assert along["branches"].tolist() == [400 + 410 + 420, 500 + 510 + 520]
    assert_allclose(along["solid_fraction"], [0.711, 0.721], rtol=1e-14)
    assert_allclose(along["solid_fraction_above_jamming"], [0.061, 0.071], rtol=1e-12)
    assert_allclose(along["mean_stress_Pa"], [1e5, 2e5], rtol=1e-14)
    assert along["median_overlap_ratio"].is_monotonic_decreasing


def test_state_with_too_few_branches_has_no_exponent_and_the_others_keep_theirs(sample):
    contacts, paths = sample
    # One length alone is left in state 1, as close to jamming.
    few = [table[table["state"] == 2] for table in contacts]
    few[0] = pd.concat([contacts[0][contacts[0]["state"] == 1][:1], few[0]])
    along = exponents_along_path(few, paths, EDGES, **SETTINGS)
    assert along["state"].tolist() == [1, 2]
    assert along.loc[0, ["exponent", "exponent_low", "exponent_high"]].isna().all()
    assert along["exponent"][1] == pytest.approx(3.0, abs=1e-9)


def test_last_row_along_the_path_is_the_fit_of_its_end():
    contacts = [contacts_of(seed, [2.0, 2.8 + 0.1 * seed]) for seed in range(4)]
    paths = [path_of([True, True])] * 4
    _, fit = final_energy_split(contacts, paths, EDGES, **SETTINGS)
    along = exponents_along_path(contacts, paths, EDGES, **SETTINGS)
    names = ["exponent", "exponent_low", "exponent_high", "branches", "median_overlap_ratio"]
    assert along.iloc[-1][names].tolist() == [fit[name] for name in names]


def test_rows_of_a_table_may_be_in_any_order(sample):
    contacts, paths = sample
    shuffled = [table.sample(frac=1, random_state=0) for table in contacts]
    along = [
        exponents_along_path(tables, paths, EDGES, **SETTINGS) for tables in (contacts, shuffled)
    ]
    assert_frame_equal(*along, rtol=1e-10)
