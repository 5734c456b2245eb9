"""Contacts of lattices and chains whose coordination, rattlers and stress are known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.packings.contacts import (
    contact_number,
    coordination_number,
    mean_stress,
    mechanical_coordination_number,
    rattlers,
    unbalanced_force_ratio,
)

CELLS = 4
# Places of the spheres in a cubic cell of edge 1, and the radius at which nearest ones touch.
LATTICES = {
    "simple cubic": ([[0, 0, 0]], 1 / 2),
    "bcc": ([[0, 0, 0], [0.5, 0.5, 0.5]], 3**0.5 / 4),
    "fcc": ([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]], 2**0.5 / 4),
}


def lattice(name):
    """Return the places of all spheres in a periodic cube of edge CELLS, and the radius."""
    basis, radius = LATTICES[name]
    corners = np.stack(np.meshgrid(*[np.arange(CELLS)] * 3), axis=-1).reshape(-1, 1, 3)
    return (corners + np.array(basis, dtype=float)).reshape(-1, 3), radius


def touching(positions, reach, edge=CELLS):
    """Return i, j and distance of all pairs closer than reach, each once, in a periodic cube."""
    i, j = np.triu_indices(len(positions), k=1)
    gap = positions[i] - positions[j]
    distance = np.linalg.norm(gap - edge * np.round(gap / edge), axis=1)
    near = distance < reach
    return i[near], j[near], distance[near]


def complete(grains, first=0):
    """Return the pairs of grains that all touch each other."""
    i, j = np.triu_indices(grains, k=1)
    return i + first, j + first


# --- lattices ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "stretch", "neighbours"),
    [
        ("simple cubic", 1.01, 6),
        ("bcc", 1.01, 8),
        # The second shell of bcc is 15 percent farther away.
        ("bcc", 1.16, 14),
        ("fcc", 1.01, 12),
        ("fcc", 1.42, 18),
    ],
)
def test_spheres_of_a_lattice_have_its_number_of_neighbours(name, stretch, neighbours):
    positions, radius = lattice(name)
    grains = len(positions)
    i, j, _ = touching(positions, 2 * radius * stretch)
    assert_array_equal(contact_number(i, j, grains), np.full(grains, neighbours))
    assert coordination_number(len(i), grains) == neighbours
    assert mechanical_coordination_number(i, j, rattlers(i, j, grains)) == neighbours
    assert not rattlers(i, j, grains).any()


@pytest.mark.parametrize("name", LATTICES)
def test_compressed_lattice_carries_the_stress_of_its_contact_planes(name):
    positions, radius = lattice(name)
    stiffness, overlap = 1e4, 1e-3
    # The spheres grow, the places stay: all contacts have one force.
    i, _, distance = touching(positions, 2 * radius + overlap / 2)
    force = np.full(len(i), stiffness * overlap)
    stress = mean_stress(distance, force, CELLS**3)
    # What crosses a plane between two layers: the contacts per cell, times the part of the force
    # along its normal; 1 contact straight through, 4 at 1/sqrt(3), 8 at 1/sqrt(2) per unit area.
    crossing = {"simple cubic": 1, "bcc": 4 / 3**0.5, "fcc": 4 * 2**0.5}[name]
    assert_allclose(stress, stiffness * overlap * crossing, rtol=1e-13)


# --- rattlers ------------------------------------------------------------------------------------


def test_all_grains_of_a_chain_are_rattlers():
    links = np.arange(9)
    assert rattlers(links, links + 1, 10).all()
    assert mechanical_coordination_number(links, links + 1, np.ones(10)) == 0.0


def test_grain_with_three_contacts_rattles_and_its_supports_do_not():
    i, j = complete(5)
    i, j = np.append(i, [5, 5, 5]), np.append(j, [0, 1, 2])
    assert rattlers(i, j, 6).tolist() == [False] * 5 + [True]
    assert rattlers(np.append(i, 5), np.append(j, 3), 6).tolist() == [False] * 6


def test_removing_a_rattler_makes_the_grains_loose_that_leaned_on_it():
    # Grains 0 to 4 hold each other; 5 to 8 lie on them in a row, with four contacts each.
    i, j = complete(5)
    on_grains = {5: [0, 1, 2, 6], 6: [0, 1, 7], 7: [0, 1, 8], 8: [0, 1]}
    row = np.array([(grain, other) for grain, others in on_grains.items() for other in others])
    i, j = np.append(i, row[:, 0]), np.append(j, row[:, 1])
    # Grain 8 has but three: it falls, then 7, 6 and 5, one after the other.
    assert contact_number(i, j, 9)[5:].tolist() == [4, 4, 4, 3]
    assert rattlers(i, j, 9).tolist() == [False] * 5 + [True] * 4
    assert not rattlers(np.append(i, 8), np.append(j, 2), 9).any()


def test_contacts_with_walls_hold_a_grain():
    walls = np.array([0, 0, 1, 3])
    i, j = [0, 0, 0, 1, 1, 2], [1, 2, 3, 2, 3, 3]
    # Each of four grains touches the three others.
    assert rattlers(i, j, 4).all()
    assert not rattlers(i, j, 4, [1, 1, 1, 1]).any()
    assert rattlers(i, j, 4, walls).all()
    assert rattlers([], [], 2, [3, 4]).tolist() == [True, False]


@settings(deadline=None, max_examples=60)
@given(st.integers(2, 25), st.integers(0, 2**32), st.floats(0.05, 0.9))
def test_what_does_not_rattle_is_the_largest_set_with_four_contacts_each(grains, seed, share):
    rng = np.random.default_rng(seed)
    i, j = complete(grains)
    linked = rng.random(len(i)) < share
    i, j, walls = i[linked], j[linked], rng.integers(0, 3, grains)
    loose = rattlers(i, j, grains, walls)
    held = ~(loose[i] | loose[j])
    assert np.all(contact_number(i[held], j[held], grains)[~loose] + walls[~loose] >= 4)
    # One at a time, in any order, ends at the same set.
    kept = np.ones(grains, dtype=bool)
    while True:
        inside = kept[i] & kept[j]
        number = contact_number(i[inside], j[inside], grains) + walls
        falling = np.flatnonzero(kept & (number < 4))
        if not falling.size:
            break
        kept[rng.choice(falling)] = False
    assert_array_equal(loose, ~kept)


def test_mechanical_coordination_leaves_out_rattlers_and_their_contacts():
    # Six grains that all touch, and a chain of two that touches one of them.
    i, j = complete(6)
    i, j = np.append(i, [0, 6]), np.append(j, [6, 7])
    assert coordination_number(len(i), 8) == 2 * 17 / 8
    assert mechanical_coordination_number(i, j, rattlers(i, j, 8)) == 5.0


def test_mechanical_coordination_counts_each_wall_contact_once():
    i, j = complete(5)
    # The last grain rattles: its wall contacts do not count either.
    i, j = np.append(i, 5), np.append(j, 0)
    walls = [1, 2, 0, 0, 0, 2]
    assert mechanical_coordination_number(i, j, rattlers(i, j, 6, walls), walls) == (20 + 3) / 5


def test_packing_without_contacts_has_no_coordination():
    assert contact_number([], [], 3).tolist() == [0, 0, 0]
    assert coordination_number(0, 3) == 0.0
    assert rattlers([], [], 3).all()
    assert mechanical_coordination_number([], [], np.ones(3)) == 0.0


# --- stress --------------------------------------------------------------------------------------


def test_two_spheres_between_walls_press_on_them_with_one_force():
    # A column of two spheres along x in a cube of edge 2 - 3 d: each of three contacts overlaps d.
    radius, overlap, stiffness = 0.5, 1e-3, 1e6
    edge = 2.0 - 3 * overlap
    force = stiffness * overlap
    stress = mean_stress(
        [2 * radius - overlap], [force], edge**3, [radius - overlap] * 2, [force] * 2
    )
    # The stress along x is F/L^2; nothing presses along y and z.
    assert_allclose(stress, force / edge**2 / 3, rtol=1e-14)


def test_packing_without_contacts_has_no_stress():
    assert mean_stress([], [], 1.0) == 0.0


# --- balance -------------------------------------------------------------------------------------


def test_unbalanced_force_is_the_mean_length_of_the_net_forces_over_the_mean_contact_force():
    net = [[3.0, 0.0, 4.0], [0.0, 0.0, 0.0], [0.0, -1.0, 0.0]]
    assert_allclose(unbalanced_force_ratio(net, [10.0, 30.0], 1.0), (5 + 1) / 3 / 20, rtol=1e-15)


def test_floor_stands_in_for_the_contact_force_of_an_unloaded_packing():
    assert unbalanced_force_ratio([[0.0, 0.0, 1.0]], [], 4.0) == 0.25
    assert unbalanced_force_ratio([[0.0, 0.0, 1.0]], [1e-9], 4.0) == 0.25
    assert unbalanced_force_ratio([[0.0, 0.0, 1.0]], [8.0], 4.0) == 0.125


def test_lattice_in_balance_has_no_net_force():
    positions, radius = lattice("fcc")
    i, j, distance = touching(positions, 2.1 * radius)
    gap = positions[i] - positions[j]
    direction = (gap - CELLS * np.round(gap / CELLS)) / distance[:, None]
    net = np.zeros_like(positions)
    np.add.at(net, i, direction)
    np.subtract.at(net, j, direction)
    assert unbalanced_force_ratio(net, np.ones(len(i)), 1e-9) < 1e-14
