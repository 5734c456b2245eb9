"""Grains between walls, in lattices and at random, whose energy and stress are known."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.packings.contact_laws import HertzContact, LinearContact, reduced_radius
from branchcrush.packings.contacts import mean_stress
from branchcrush.packings.grains import grain_energy, grain_stress_volume, neighbour_ratio
from branchcrush.packings.network import Network

LAWS = [LinearContact(3e4), HertzContact(2e7)]
NONE = np.zeros(0, dtype=int)


def network(law, radius, i=NONE, j=NONE, overlap=NONE, wall=NONE, wall_overlap=NONE):
    """Return grains whose contacts have the forces and energies that a law gives their overlaps."""
    radius, overlap, wall_overlap = (
        np.asarray(part, dtype=float) for part in (radius, overlap, wall_overlap)
    )
    i, j, wall = (np.asarray(part, dtype=int) for part in (i, j, wall))
    between = reduced_radius(radius[i], radius[j])
    force = law.force(overlap, between)
    at_walls = law.force(wall_overlap, radius[wall])
    energy = law.energy(force, between)
    return Network(radius, i, j, overlap, force, energy, wall, wall_overlap, at_walls)


def random_network(law, seed, grains, contacts, walls):
    rng = np.random.default_rng(seed)
    radius = rng.lognormal(0.0, 1.0, grains)
    i = rng.integers(0, grains, contacts)
    j = (i + rng.integers(1, grains, contacts)) % grains
    overlap = rng.uniform(0.0, 0.2, contacts) * np.minimum(radius[i], radius[j])
    wall = rng.integers(0, grains, walls)
    return network(law, radius, i, j, overlap, wall, rng.uniform(0.0, 0.2, walls) * radius[wall])


any_network = given(
    law=st.sampled_from(LAWS),
    seed=st.integers(0, 2**32),
    grains=st.integers(2, 30),
    contacts=st.integers(0, 100),
    walls=st.integers(0, 30),
)
varied = settings(deadline=None, max_examples=60)


# --- sums over the grains ------------------------------------------------------------------------


@varied
@any_network
def test_energies_of_grains_add_up_to_that_of_the_contacts_and_walls(law, **parts):
    packing = random_network(law, **parts)
    # What the law itself says of a wall, which is a grain without end.
    of_walls = law.energy(packing.wall_force, packing.radius[packing.wall_grain])
    result = grain_energy(packing, law.exponent)
    assert_allclose(result.sum(), packing.energy.sum() + of_walls.sum(), rtol=1e-12, atol=1e-300)
    assert np.all(result[packing.contacts + packing.wall_contacts == 0] == 0.0)


@varied
@any_network
def test_stresses_of_grains_add_up_to_that_of_the_packing(law, **parts):
    packing, volume = random_network(law, **parts), 123.0
    whole = mean_stress(
        packing.length - packing.overlap,
        packing.force,
        volume,
        packing.radius[packing.wall_grain] - packing.wall_overlap,
        packing.wall_force,
    )
    result = grain_stress_volume(packing)
    assert_allclose(result.sum(), whole * volume, rtol=1e-12, atol=1e-300)
    assert np.all(result[packing.contacts + packing.wall_contacts == 0] == 0.0)


@varied
@any_network
def test_order_of_contacts_and_of_their_two_grains_changes_nothing(law, **parts):
    packing = random_network(law, **parts)
    rng = np.random.default_rng(1)
    rows, turned = rng.permutation(packing.i.size), rng.random(packing.i.size) < 0.5
    i, j = np.where(turned, packing.j, packing.i), np.where(turned, packing.i, packing.j)
    held = rng.permutation(packing.wall_grain.size)
    other = Network(
        packing.radius,
        i[rows],
        j[rows],
        *(part[rows] for part in (packing.overlap, packing.force, packing.energy)),
        packing.wall_grain[held],
        packing.wall_overlap[held],
        packing.wall_force[held],
    )
    for value in (
        lambda one: grain_energy(one, law.exponent),
        grain_stress_volume,
        neighbour_ratio,
    ):
        assert_allclose(value(other), value(packing), rtol=1e-12, atol=1e-300)


# --- known grains --------------------------------------------------------------------------------


@pytest.mark.parametrize("law", LAWS)
def test_grain_between_two_walls_holds_twice_their_energy_and_the_stress_of_its_column(law):
    radius, overlap = 0.3, 2e-3
    alone = network(law, [radius], wall=[0, 0], wall_overlap=[overlap] * 2)
    work = np.trapezoid(law.force(x := np.linspace(0.0, overlap, 20_001), radius), x)
    assert_allclose(grain_energy(alone, law.exponent), 2.0 * work, rtol=1e-5)
    # The force goes through all of the grain, between planes as far apart as the walls.
    through = law.force(overlap, radius) * 2.0 * (radius - overlap)
    assert_allclose(grain_stress_volume(alone), through / 3.0, rtol=1e-14)
    assert np.isnan(neighbour_ratio(alone)).all()


def test_contact_is_shared_in_halves_of_energy_but_by_radius_in_stress():
    law, overlap = LAWS[0], 0.1
    pair = network(law, [1.0, 3.0], [0], [1], [overlap])
    assert_allclose(grain_energy(pair, law.exponent), [pair.energy[0] / 2.0] * 2)
    assert_allclose(grain_stress_volume(pair), pair.force[0] / 3.0 * np.array([0.95, 2.95]))


@pytest.mark.parametrize("law", LAWS)
def test_all_grains_of_a_compressed_lattice_have_its_energy_and_stress(law):
    # Simple cubic, 4 x 4 x 4 and periodic: three contacts a grain and cell.
    cells, radius, edge = 4, 0.5, 0.98
    place = np.stack(np.unravel_index(np.arange(cells**3), (cells,) * 3), axis=1)
    after = [(place + step) % cells for step in np.eye(3, dtype=int)]
    i = np.tile(np.arange(cells**3), 3)
    j = np.concatenate([np.ravel_multi_index(each.T, (cells,) * 3) for each in after])
    overlap = np.full(i.size, 2.0 * radius - edge)
    packing = network(law, np.full(cells**3, radius), i, j, overlap)
    force = packing.force[0]
    assert_allclose(grain_energy(packing, law.exponent), 3.0 * packing.energy[0])
    # One contact through each face of its cell: p = F/edge^2 in the cell, which a grain fills.
    assert_allclose(grain_stress_volume(packing), force / edge**2 * edge**3)
    assert_allclose(neighbour_ratio(packing), 1.0)


def test_stress_is_the_moment_of_the_forces_where_they_act():
    # Spheres at random places: forces act on the middle of the overlaps, along the branches.
    rng = np.random.default_rng(1)
    place, radius = rng.uniform(0.0, 3.0, (40, 3)), rng.uniform(0.3, 0.8, 40)
    i, j = np.triu_indices(40, k=1)
    length = np.linalg.norm(place[i] - place[j], axis=1)
    near = (length < radius[i] + radius[j]) & (length > np.abs(radius[i] - radius[j]))
    i, j, length = i[near], j[near], length[near]
    packing = network(LAWS[0], radius, i, j, radius[i] + radius[j] - length)
    expected = np.zeros(40)
    for a, b, distance, force in zip(i, j, length, packing.force, strict=True):
        along = (place[b] - place[a]) / distance
        ends = place[a] + radius[a] * along, place[b] - radius[b] * along
        point = (ends[0] + ends[1]) / 2.0
        # Compression positive: the force on a grain points to its centre.
        expected[a] += (point - place[a]) @ along * force / 3.0
        expected[b] -= (point - place[b]) @ along * force / 3.0
    assert len(i) > 100
    assert_allclose(grain_stress_volume(packing), expected, rtol=1e-12)


def test_grains_without_any_contact_hold_nothing():
    nothing = network(LAWS[0], [1.0, 2.0])
    assert_array_equal(grain_energy(nothing, 1.0), [0.0, 0.0])
    assert_array_equal(grain_stress_volume(nothing), [0.0, 0.0])
    assert_array_equal(neighbour_ratio(nothing), [np.nan, np.nan])
    walled = network(LAWS[0], [1.0, 2.0], wall=[1], wall_overlap=[0.1])
    assert_array_equal(grain_energy(walled, 1.0) > 0.0, [False, True])


# --- neighbours ----------------------------------------------------------------------------------


@pytest.mark.filterwarnings("error")
def test_neighbours_are_averaged_by_contact_and_walls_are_none():
    i, j = [0, 0, 3, 0], [1, 2, 0, 1]  # 0 and 1 touch twice, as in a narrow periodic cell
    packing = network(LAWS[0], [6.0, 1.0, 3.0, 5.0, 9.0], i, j, [0.1] * 4, [4, 2], [0.1, 0.1])
    mean = (1.0 + 3.0 + 5.0 + 1.0) / 4.0
    assert_allclose(neighbour_ratio(packing), [6.0 / mean, 1.0 / 6.0, 0.5, 5.0 / 6.0, np.nan])


@varied
@given(seed=st.integers(0, 2**32), unit=st.floats(1e-6, 1e6))
def test_the_ratio_to_neighbours_does_not_know_the_unit(seed, unit):
    packing = random_network(LAWS[0], seed, 20, 40, 5)
    scaled = replace(packing, radius=unit * packing.radius)
    assert_allclose(neighbour_ratio(scaled), neighbour_ratio(packing), rtol=1e-12)
