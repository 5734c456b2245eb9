"""Contact statistics of contacts drawn by a known rule."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.branches.contact_numbers import (
    assortativity,
    contact_number_table,
    contact_sums,
    pair_table,
    radius_classes,
)
from branchcrush.packings.network import Network

SIZES = np.arange(1.0, 7.0)
EDGES = np.append(SIZES - 0.5, 6.5)
# Contacts of a grain of each size.
CONTACTS = 2.0 + 0.3 * SIZES**2


def network_of(radius, i, j):
    i, j = np.asarray(i, dtype=int), np.asarray(j, dtype=int)
    ones, none = np.ones(i.size), np.empty(0)
    return Network(
        np.asarray(radius, dtype=float), i, j, ones, ones, ones, none.astype(int), none, none
    )


def drawn(rng, grains=200, sizes=SIZES, contacts=CONTACTS):
    """Return a network in which both ends of a contact are drawn by their contact numbers."""
    radius, number = np.repeat(sizes, grains), np.repeat(contacts, grains)
    pairs = rng.poisson(number.sum() / 2)
    return network_of(radius, *rng.choice(radius.size, (2, pairs), p=number / number.sum()))


def sums_of(networks, edges=EDGES):
    return [contact_sums(network, edges) for network in networks]


def both_orders(networks):
    """Return the two radii of all contacts, each in both orders."""
    first = np.concatenate([np.append(n.radius_i, n.radius_j) for n in networks])
    second = np.concatenate([np.append(n.radius_j, n.radius_i) for n in networks])
    return first, second


# --- contact numbers -----------------------------------------------------------------------------


def test_contact_numbers_by_radius_are_those_the_contacts_were_drawn_with():
    rng = np.random.default_rng(1)
    sums = sums_of(drawn(rng) for _ in range(16))
    table = contact_number_table(sums, EDGES, rng=rng)
    # Contacts of a class are nearly Poisson numbers.
    error = np.sqrt(CONTACTS / (16 * 200))
    assert np.all(np.abs(table["contact_number"] - CONTACTS) < 4.5 * error)
    assert table["grains"].tolist() == [3200] * 6
    assert_array_equal(table["mean_radius_m"], SIZES)
    assert_array_equal(table["radius_low_m"], EDGES[:-1])
    assert_array_equal(table["radius_high_m"], EDGES[1:])


def test_intervals_cover_the_contact_numbers_of_most_classes():
    rng = np.random.default_rng(2)
    covered = []
    for _ in range(60):
        sums = sums_of(drawn(rng, grains=20) for _ in range(10))
        table = contact_number_table(sums, EDGES, resamples=300, rng=rng)
        low, high = table["contact_number_low"], table["contact_number_high"]
        covered.append((low <= CONTACTS) & (high >= CONTACTS))
    assert 0.87 <= np.mean(covered) <= 0.99


@pytest.mark.filterwarnings("error")
def test_rattlers_count_in_the_contact_number_but_not_in_the_load_bearing_one():
    # Five large grains that all touch, two small ones on them, an empty class, one seed.
    i, j = np.triu_indices(5, k=1)
    network = network_of([3.0] * 5 + [1.0] * 3, np.append(i, [5, 6, 6]), np.append(j, [0, 0, 5]))
    table = contact_number_table(sums_of([network], [1.0, 1.5, 2.0, 3.0]), range(4), rng=None)
    assert table["grains"].tolist() == [3, 0, 5]
    assert_array_equal(table["contact_number"], [4 / 3, np.nan, 22 / 5])
    assert_array_equal(table["load_bearing_contact_number"], [np.nan, np.nan, 22 / 5])
    assert_array_equal(table["rattler_fraction"], [1.0, np.nan, 0.0])
    assert_array_equal(table["mean_radius_m"], [1.0, np.nan, 3.0])
    assert np.isnan(table["contact_number_low"]).all()


# --- who touches whom ----------------------------------------------------------------------------


def test_ends_drawn_apart_are_not_alike_and_all_pairs_are_as_expected():
    rng = np.random.default_rng(3)
    sums = sums_of(drawn(rng) for _ in range(8))
    alike = assortativity(sums, rng=rng)
    contacts = sum(seed.pairs.sum() for seed in sums) / 2
    assert np.all(np.abs(alike.estimate) < 4.5 / np.sqrt(contacts))
    table = pair_table(sums, EDGES)
    # Pairs of one class come in twos.
    noise = np.sqrt(2.0 / table["expected_contacts"])
    assert np.all(np.abs(table["ratio"] - 1.0) < 4.5 * noise)
    assert table["contacts"].sum() == 2 * contacts
    assert table["expected_contacts"].sum() == pytest.approx(2 * contacts, rel=1e-12)


def test_interval_of_contacts_drawn_apart_covers_nothing_alike():
    rng = np.random.default_rng(4)
    covered = []
    for _ in range(100):
        _, low, high = assortativity(
            sums_of(drawn(rng, grains=40) for _ in range(10)), resamples=300, rng=rng
        )
        covered.append((low < 0.0) & (high > 0.0))
    assert 0.86 <= np.mean(covered) <= 1.0


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 0.9, 1.0])
def test_two_sizes_are_as_alike_as_the_share_of_equal_pairs_says(share):
    # Half of the equal pairs are of small grains: the correlation is 2 s - 1, of logarithms too.
    grains, pairs = 100, 400
    small = round(share * pairs / 2)
    i = np.concatenate([np.zeros(small), np.full(small, grains), np.zeros(pairs - 2 * small)])
    j = np.concatenate([np.zeros(small), np.full(small, grains), np.full(pairs - 2 * small, 150)])
    network = network_of(np.repeat([1.0, 7.0], grains), i, j)
    sums = sums_of([network, network], [1.0, 3.0, 7.0])
    alike = assortativity(sums, resamples=50, rng=np.random.default_rng(0))
    assert_allclose(alike, np.full((3, 2), 2 * share - 1), atol=1e-12)
    ratio = pair_table(sums, [1.0, 3.0, 7.0])["ratio"]
    assert_allclose(ratio, [2 * share, 2 - 2 * share, 2 - 2 * share, 2 * share], atol=1e-12)


def test_grains_that_touch_only_their_own_size_are_wholly_alike():
    rng = np.random.default_rng(5)
    i = rng.integers(0, 60, 500)
    j = i // 10 * 10 + rng.integers(0, 10, 500)
    sums = sums_of([network_of(np.repeat(SIZES, 10), i, j)])
    assert_allclose(assortativity(sums, rng=None).estimate, 1.0, rtol=1e-12)
    ratio = pair_table(sums, EDGES)["ratio"].reshape(6, 6)
    assert np.all(ratio[~np.eye(6, dtype=bool)] == 0.0)
    assert np.all(np.diag(ratio) > 1.0)


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.floats(1e-6, 1e6), st.integers(1, 4))
def test_likeness_is_the_correlation_over_both_orders_in_any_unit(seed, unit, seeds):
    rng = np.random.default_rng(seed)
    networks = []
    for _ in range(seeds):
        i, j = rng.integers(0, 20, (2, rng.integers(5, 60)))
        # The larger a grain the more it touches of the next ones.
        networks.append(network_of(unit * np.sort(rng.uniform(0.01, 1.0, 20)), i, (i + j) // 2))
    edges = unit * np.array([0.01, 0.3, 1.0])
    found = assortativity(sums_of(networks, edges), resamples=5, rng=rng).estimate
    first, second = both_orders(networks)
    expected = [np.corrcoef(first, second)[0, 1], np.corrcoef(np.log(first), np.log(second))[0, 1]]
    assert_allclose(found, expected, atol=1e-9)


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32))
def test_order_of_the_two_grains_does_not_matter(seed):
    rng = np.random.default_rng(seed)
    network = drawn(rng, grains=5)
    swap = rng.random(network.i.size) < 0.5
    i, j = np.where(swap, (network.j, network.i), (network.i, network.j))
    for one, other in zip(*sums_of([network, network_of(network.radius, i, j)]), strict=True):
        assert_allclose(one, other, rtol=1e-12)


@pytest.mark.filterwarnings("error")
def test_likeness_of_equal_grains_is_unknown():
    network = network_of([2.0, 2.0, 2.0], [0, 1], [1, 2])
    edges = radius_classes(network.radius, network.contacts)
    assert edges.tolist() == [2.0, 2.0]
    sums = sums_of([network, network], edges)
    alike = assortativity(sums, resamples=10, rng=np.random.default_rng(0))
    assert np.isnan(alike.estimate).all()
    assert sums[0].grains.tolist() == [3]
    assert pair_table(sums, edges)["ratio"].tolist() == [1.0]
    # Neither do rounded sums tell anything, where others are larger but touch nothing.
    for radius in (0.1, 0.7, 1.1):
        network = network_of([radius] * 3 + [3.0], [0, 1, 0], [1, 2, 2])
        alike = assortativity(sums_of([network], [radius, 2.0, 3.0]), rng=None)
        assert np.isnan(alike.estimate).all()


@pytest.mark.filterwarnings("error")
def test_pairs_of_a_class_without_contacts_have_no_ratio():
    table = pair_table(sums_of([network_of([1.0, 3.0, 3.0], [1], [2])], [1.0, 2.0, 3.0]), [1, 2, 3])
    assert_array_equal(table["ratio"], [np.nan, np.nan, np.nan, 1.0])
    assert table["contacts"].tolist() == [0, 0, 0, 2]
    assert table["radius_i_low_m"].tolist() == [1, 1, 2, 2]
    assert table["radius_j_high_m"].tolist() == [2, 3, 2, 3]


# --- sums and classes ----------------------------------------------------------------------------


def test_every_grain_and_contact_is_in_one_class():
    rng = np.random.default_rng(6)
    radius = rng.uniform(0.5, 8.0, 300)
    network = network_of(radius, *rng.integers(0, 300, (2, 900)))
    # Some radii lie beyond both ends, as those of another seed may.
    sums = contact_sums(network, np.array([1.0, 2.0, 4.0, 7.0]))
    assert sums.grains.sum() == 300
    assert sums.contacts.sum() == sums.pairs.sum() == 1800
    assert sums.radii.sum() == pytest.approx(radius.sum(), rel=1e-12)
    assert sums.bearing.sum() == (~network.rattlers).sum()
    assert_array_equal(sums.pairs, sums.pairs.T)
    assert_array_equal(sums.pairs.sum(axis=1), sums.contacts)
    assert sums.grains.tolist() == np.histogram(radius, [0.0, 2.0, 4.0, 9.0])[0].tolist()


@settings(deadline=None, max_examples=80)
@given(st.integers(1, 400), st.integers(0, 2**32), st.booleans(), st.integers(1, 12))
def test_classes_increase_and_hold_all_radii(grains, seed, rounded, classes):
    rng = np.random.default_rng(seed)
    radius = rng.lognormal(size=grains)
    radius = np.ceil(2 * radius) if rounded else radius
    edges = radius_classes(radius, rng.poisson(radius**2), classes)
    assert edges[0] == radius.min() and edges[-1] == radius.max()
    assert np.all(np.diff(edges) > 0) or np.unique(radius).size == 1
    assert edges.size <= classes + 1


def test_classes_share_out_grains_and_contacts():
    rng = np.random.default_rng(7)
    radius = rng.uniform(1.0, 3.0, 20_000) ** 2
    contacts = rng.poisson(radius**2)
    edges = radius_classes(radius, contacts)
    shares = sum(
        np.histogram(radius, edges, weights=w)[0] / w.sum() for w in (np.ones(20_000), contacts)
    )
    assert_allclose(shares, 0.2, atol=0.03)


def test_few_sizes_have_a_class_each():
    rng = np.random.default_rng(8)
    radius = rng.choice([1.0, 4.0, 9.0], 100)
    edges = radius_classes(radius, np.ones(100))
    assert_allclose(edges, [1.0, 2.0, 6.0, 9.0], rtol=1e-12)
    sums = contact_sums(network_of(radius, [], []), edges)
    assert sums.grains.tolist() == [(radius == size).sum() for size in (1.0, 4.0, 9.0)]
