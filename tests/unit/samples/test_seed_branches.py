"""What is kept of the branches of a seed, and that it holds no part of the table."""

import gc
import weakref

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.samples.seed_branches import COLUMNS, ENERGY_COLUMNS, seed_branches, state_sums
from branchcrush.statistics.bins import binned_sums
from tests.unit.samples.exact_contacts import EDGES, branches_of, contacts_of


@pytest.fixture
def contacts():
    """Three seeds: n = 2 in state 1 and n = 3 at the end; state 0 is not certified."""
    return [contacts_of(seed, [1.0, 2.0, 3.0]) for seed in range(3)]


def test_sums_are_binned_state_by_state(contacts):
    for seed, found in enumerate(branches_of(contacts, 1, 2)):
        assert found.sums.shape == (2, 3, 20)
        for sums, state in zip(found.sums, (1, 2), strict=True):
            rows = contacts[seed][contacts[seed]["state"] == state]
            length = rows["radius_i_m"] + rows["radius_j_m"]
            assert_array_equal(sums, binned_sums(length, rows["energy_J"], EDGES))
            assert_array_equal(state_sums(contacts[seed], state, EDGES), sums)
        assert found.sums[:, 0].sum(axis=1).tolist() == [400 + 10 * seed, 500 + 10 * seed]


def test_branches_of_the_first_and_last_state_are_kept_one_by_one(contacts):
    found = seed_branches(contacts[1], [0, 2], EDGES)
    last = contacts[1][contacts[1]["state"] == 2]
    small, large, energy = found.last
    radii = np.sort(last[["radius_i_m", "radius_j_m"]], axis=1) / (EDGES[-1] / 2.0)
    assert_allclose(np.exp([small, large]), radii.T, rtol=1e-14)
    assert_array_equal(energy, last["energy_J"])
    assert found.first[2].size == 310
    assert [ratio.size for ratio in found.overlap_over_length] == [310, 510]
    assert_array_equal(found.overlap_over_length[1], last["overlap_m"] / last["branch_length_m"])


def test_state_without_contacts_has_sums_of_zero_and_no_lengths(contacts):
    table = contacts[0][contacts[0]["state"] != 1]
    assert not state_sums(table, 1, EDGES).any()
    found = seed_branches(table, [0, 1, 2], EDGES)
    assert found.sums[:, 0].sum(axis=1).tolist() == [300, 0, 500]
    assert not found.overlap_over_length[1].size


def test_named_columns_are_all_that_is_needed(contacts):
    assert_array_equal(
        state_sums(contacts[0][[*ENERGY_COLUMNS]], 2, EDGES), state_sums(contacts[0], 2, EDGES)
    )
    assert seed_branches(contacts[0][[*COLUMNS]], [2], EDGES).last[2].size == 500


def test_what_is_kept_holds_no_part_of_the_table():
    table = contacts_of(0, [2.0, 3.0])
    # The arrays behind the columns, which any part of them would keep.
    held = [weakref.ref(_owner(table[name].to_numpy())) for name in COLUMNS]
    kept = seed_branches(table, [0, 1], EDGES)
    del table
    gc.collect()
    assert kept.last[2].size == 400
    assert not any(reference() is not None for reference in held)


def _owner(array):
    while array.base is not None:
        array = array.base
    return array


def test_a_table_whose_states_are_not_one_after_the_other_is_refused(contacts):
    with pytest.raises(ValueError, match="state after state"):
        branches_of([table.iloc[::-1] for table in contacts], 1, 2)
