"""Energy of grains: all of the packing's, and the exponent of radius that was put in."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.errors import FitError
from branchcrush.grain_size_split import grain_energy_exponents
from branchcrush.grains import grain_energy, neighbour_ratio
from branchcrush.networks import Network


def network(radius, pairs, energy, walls=(), overlap=(), force=()):
    i, j = np.array(pairs, dtype=int).reshape(-1, 2).T
    energy, nothing = np.asarray(energy, float), np.zeros(len(energy))
    held = np.array(walls, int), np.array(overlap, float), np.array(force, float)
    return Network(np.asarray(radius, float), i, j, nothing, nothing, energy, *held)


# --- energy of each grain ------------------------------------------------------------------------


@pytest.mark.parametrize(("exponent", "of_wall"), [(1.0, 0.5), (1.5, 0.4)])
def test_a_contact_is_shared_in_halves_and_a_wall_takes_nothing(exponent, of_wall):
    three = network([1, 1, 1, 1], [(0, 1), (1, 2)], [2.0, 6.0], [2, 2], [0.1, 0.2], [10.0, 20.0])
    expected = [1.0, 4.0, 3.0 + of_wall * (0.1 * 10.0 + 0.2 * 20.0), 0.0]
    assert_allclose(grain_energy(three, exponent), expected)


@settings(deadline=None, max_examples=50)
@given(
    grains=st.integers(2, 30),
    contacts=st.integers(0, 100),
    walls=st.integers(0, 20),
    exponent=st.sampled_from([1.0, 1.5]),
    seed=st.integers(0, 2**32),
)
def test_grains_hold_all_energy_of_contacts_and_walls(grains, contacts, walls, exponent, seed):
    rng = np.random.default_rng(seed)
    i = rng.integers(0, grains, contacts)
    j = (i + rng.integers(1, grains, contacts)) % grains
    overlap, force = rng.random((2, walls))
    one = network(
        rng.random(grains) + 0.1,
        np.stack([i, j], axis=1),
        rng.random(contacts),
        rng.integers(0, grains, walls),
        overlap,
        force,
    )
    total = one.energy.sum() + (overlap * force).sum() / (exponent + 1.0)
    assert_allclose(grain_energy(one, exponent).sum(), total, rtol=1e-12, atol=1e-300)
    turned = one._replace(i=one.j, j=one.i)
    assert_allclose(grain_energy(turned, exponent), grain_energy(one, exponent), rtol=1e-12)
    assert_allclose(neighbour_ratio(turned), neighbour_ratio(one), rtol=1e-12)


def test_neighbours_are_the_grains_that_a_grain_touches():
    ratio = neighbour_ratio(
        network([4, 1, 3, 2, 5], [(0, 1), (2, 0), (2, 1)], np.ones(3), [3], [0.1], [1])
    )
    assert_allclose(ratio[:3], [4 / 2, 1 / 3.5, 3 / 2.5])
    assert_array_equal(np.isnan(ratio), [False, False, False, True, True])


# --- exponent in the radius ----------------------------------------------------------------------


def chains(rng, a, grains=500, loaded=1.0):
    """Pairs of grains of one radius, so that each holds half of its contacts: e = R^a, and noise.

    Every pair is held by four contacts with each other, or by none.
    """
    radius = np.repeat(rng.uniform(0.2, 1.0, grains), 2)
    held = np.flatnonzero(rng.random(grains) < loaded)
    pairs = np.repeat(np.stack([2 * held, 2 * held + 1], axis=1), 4, axis=0)
    energy = radius[pairs[:, 0]] ** a * np.repeat(rng.gamma(2.0, 0.5, held.size), 4) / 2.0
    return network(radius, pairs, energy)


@pytest.mark.parametrize("a", [2.0, 3.0, 5.0])
def test_interval_contains_the_known_exponent_for_most_random_states(a):
    inside = 0
    for seed in range(12):
        rng = np.random.default_rng([seed, int(a)])
        made = [chains(rng, a) for _ in range(8)]
        found = grain_energy_exponents(made, 1.0, resamples=200, rng=rng)
        inside += found["exponent_all_grains_low"] < a < found["exponent_all_grains_high"]
    assert inside >= 8


def test_load_that_does_not_know_the_radius_leaves_the_exponent():
    rng = np.random.default_rng(1)
    made = [chains(rng, 3.0, 2000, loaded=0.5) for _ in range(8)]
    found = grain_energy_exponents(made, 1.0, rng=rng)
    assert_allclose(found["exponent_all_grains"], 3.0, atol=0.25)
    assert_allclose(found["exponent_load_bearing"], 3.0, atol=0.25)


def test_small_grains_without_load_raise_the_exponent_of_all_grains_alone():
    # A share of R/R_max is loaded: the mean of all goes as R^(3 + 1), that of the loaded as R^3.
    made = []
    rng = np.random.default_rng(2)
    for _ in range(8):
        one = chains(rng, 3.0, 2000)
        kept = np.repeat(rng.random(2000) < one.radius[::2], 4)
        made.append(
            one._replace(
                **{
                    name: getattr(one, name)[kept]
                    for name in ("i", "j", "overlap", "force", "energy")
                }
            )
        )
    found = grain_energy_exponents(made, 1.0, rng=rng)
    assert_allclose(found["exponent_all_grains"], 4.0, atol=0.25)
    assert_allclose(found["exponent_load_bearing"], 3.0, atol=0.25)


def test_exponents_do_not_know_the_units():
    rng = np.random.default_rng(3)
    made = [chains(rng, 3.0) for _ in range(4)]
    scaled = [one._replace(radius=1e-3 * one.radius, energy=1e-7 * one.energy) for one in made]
    found, found_too = (
        grain_energy_exponents(networks, 1.0, resamples=100, rng=np.random.default_rng(1))
        for networks in (made, scaled)
    )
    assert_allclose(list(found_too.values()), list(found.values()), rtol=1e-6)


def test_grains_of_one_radius_have_no_exponent():
    one = network(np.ones(4), [(0, 1), (2, 3)] * 4, np.ones(8))
    with pytest.raises(FitError):
        grain_energy_exponents([one] * 3, 1.0, rng=np.random.default_rng(1))
