"""Networks made by hand: what a grain touches, in which state, and what holds it."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_array_equal

from branchcrush.packings.contacts import mechanical_coordination_number
from branchcrush.packings.network import COLUMNS, WALL_COLUMNS, state_network

RADII = [1.0, 2.0, 3.0, 4.0, 5.0, 0.5]


def contact_table(state, pairs, first=0.0):
    """Return contacts whose values tell the pair: the k-th has k tenths of overlap, and so on."""
    i, j = np.reshape(pairs, (-1, 2)).T
    number = first + np.arange(len(i))
    values = (state, i, j, number / 10, number + 1.0, number * 100.0)
    return pd.DataFrame(dict(zip(COLUMNS, values, strict=True)))


def wall_table(state, grains):
    number = np.arange(len(grains))
    values = (state, np.array(grains, dtype=int), number / 10, number + 7.0)
    return pd.DataFrame(dict(zip(WALL_COLUMNS, values, strict=True)))


def all_pairs(grains):
    return np.stack(np.triu_indices(grains, k=1), axis=1)


def test_every_contact_keeps_its_grains_radii_and_forces():
    network = state_network(RADII, contact_table(0, [(0, 3), (4, 1)]), wall_table(0, []), 0)
    assert network.radius_i.tolist() == [1.0, 5.0]
    assert network.radius_j.tolist() == [4.0, 2.0]
    # The sum of the radii, not the distance of the centres.
    assert network.length.tolist() == [5.0, 7.0]
    assert network.overlap.tolist() == [0.0, 0.1]
    assert network.force.tolist() == [1.0, 2.0]
    assert network.energy.tolist() == [0.0, 100.0]
    assert network.contacts.tolist() == [1, 1, 0, 1, 1, 0]


def test_states_of_one_table_are_kept_apart():
    contacts = pd.concat(
        [contact_table(3, [(0, 1)]), contact_table(3, [(4, 5)]), contact_table(7, [(1, 2), (2, 3)])]
    )
    walls = pd.concat([wall_table(3, [0]), wall_table(7, [5, 5])])
    first, second = (state_network(RADII, contacts, walls, state) for state in (3, 7))
    assert (first.i.tolist(), first.j.tolist()) == ([0, 4], [1, 5])
    assert (second.i.tolist(), second.j.tolist()) == ([1, 2], [2, 3])
    assert first.wall_grain.tolist() == [0]
    assert second.wall_grain.tolist() == [5, 5]
    assert first.radius.tolist() == second.radius.tolist() == RADII


def test_a_state_without_contacts_has_a_network_of_rattlers():
    network = state_network(RADII, contact_table(0, [(0, 1)]), wall_table(0, [2]), 1)
    assert network.length.size == network.force.size == network.wall_force.size == 0
    assert network.contacts.tolist() == network.wall_contacts.tolist() == [0] * 6
    assert network.rattlers.all()


def test_contacts_with_walls_are_counted_apart_from_those_with_grains():
    network = state_network(RADII, contact_table(0, [(0, 1)]), wall_table(0, [0, 5, 5]), 0)
    assert network.contacts.tolist() == [1, 1, 0, 0, 0, 0]
    assert network.wall_contacts.tolist() == [1, 0, 0, 0, 0, 2]
    assert network.wall_overlap.tolist() == [0.0, 0.1, 0.2]
    assert network.wall_force.tolist() == [7.0, 8.0, 9.0]


@pytest.mark.parametrize(("walls", "loose"), [([], True), ([0, 1], True), ([5], False)])
def test_a_wall_may_be_the_fourth_contact_that_holds_a_grain(walls, loose):
    pairs = [*all_pairs(5), (5, 0), (1, 5), (5, 2)]
    network = state_network(RADII, contact_table(0, pairs), wall_table(0, walls), 0)
    assert network.rattlers.tolist() == [False] * 5 + [loose]
    # What a rattler touches it still touches.
    assert network.contacts.tolist() == [5, 5, 5, 4, 4, 3]


def test_grains_that_lean_on_a_rattler_rattle_as_well():
    # Grain 6 has three contacts; without it grain 5 has three as well.
    pairs = [*all_pairs(5), (5, 0), (5, 1), (5, 2), (5, 6), (6, 0), (6, 1)]
    network = state_network([1.0] * 7, contact_table(0, pairs), wall_table(0, []), 0)
    assert network.rattlers.tolist() == [False] * 5 + [True, True]


def test_order_of_rows_and_of_the_two_grains_does_not_matter():
    rng = np.random.default_rng(1)
    pairs = all_pairs(12)[rng.random(66) < 0.6]
    radii = rng.uniform(1.0, 2.0, 12)
    table = contact_table(0, pairs)
    other = table.sample(frac=1.0, random_state=2)
    swapped = rng.random(len(other)) < 0.5
    other.loc[swapped, ["i", "j"]] = other.loc[swapped, ["j", "i"]].to_numpy()
    walls = wall_table(0, [1, 1, 4])
    one, two = (state_network(radii, rows, walls, 0) for rows in (table, other))
    for name in ("contacts", "wall_contacts", "rattlers"):
        assert_array_equal(getattr(one, name), getattr(two, name))
    assert_array_equal(np.sort(one.length), np.sort(two.length))
    assert_array_equal(np.sort(one.force), np.sort(two.force))


def test_rattlers_are_those_that_the_coordination_of_a_table_leaves_out():
    rng = np.random.default_rng(3)
    # Fifteen grains in a dense net, and five that hang on it in a chain.
    net = all_pairs(15)[rng.random(105) < 0.8]
    pairs = np.concatenate([net, np.stack([np.arange(14, 19), np.arange(15, 20)], axis=1)])
    held = rng.integers(0, 15, 12)
    network = state_network(np.ones(20), contact_table(0, pairs), wall_table(0, held), 0)
    bearing = ~network.rattlers
    inside = bearing[network.i] & bearing[network.j]
    number = 2 * inside.sum() + network.wall_contacts[bearing].sum()
    assert 0 < bearing.sum() <= 15
    assert number / bearing.sum() == mechanical_coordination_number(
        network.i, network.j, network.rattlers, network.wall_contacts
    )
