"""Random parking, with binomials summed up by another library."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from scipy.stats import binom

from branchcrush.branches.affine import affine_modulus
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.parking import parking_contacts, parking_solutions
from branchcrush.errors import FitError
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import mixture
from branchcrush.gradings.rods import rod_map
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from tests.unit.branches.model_gradings import NODES, any_nodes, mean_angle

SPHERE = 4.0 * np.pi
# A sphere of the same size hides a cone of half angle 30 degrees.
EQUAL = 2.0 * np.pi * (1.0 - np.cos(np.pi / 6.0))


def stable_binomial(room, touching):
    """Return the mean of z if four or more, else 0, and the chance of that; by summing up."""
    expected, bearing = [], []
    for places in room:
        low = int(places)
        z = np.arange(4, low + 2)
        part = places - low
        chance = (1 - part) * binom.pmf(z, low, touching) + part * binom.pmf(z, low + 1, touching)
        expected.append(z @ chance)
        bearing.append(chance.sum())
    return np.array(expected), np.array(bearing)


@any_nodes
def test_parked_neighbours_touch_with_one_probability(nodes):
    # Room from the result's own contacts, one probability for six on average: both come back.
    radius, share = nodes
    found = parking_contacts(radius, share)
    room = 0.547 * SPHERE / mean_angle(radius, share, found)
    assert np.all(found.contacts <= room)

    def excess(touching):
        expected, bearing = stable_binomial(room, touching)
        return share @ expected - 6.0 * (share @ bearing)

    touching = brentq(excess, 1.0 / room.max(), 1.0, xtol=1e-13)
    expected, bearing = stable_binomial(room, touching)
    assert_allclose(found.contacts, expected, rtol=1e-5, atol=1e-9)
    assert_allclose(found.load_bearing, bearing, rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("places", [7.0, 8.0, 10.0, 7.5, 9.25])
def test_places_on_equal_spheres_are_taken_as_binomials_say(places):
    found = parking_contacts(np.array([1.0]), np.ones(1), coverage=places * EQUAL / SPHERE)

    def stable(touching):
        return np.ravel(stable_binomial([places], touching))

    touching = brentq(lambda p: stable(p)[0] - 6.0 * stable(p)[1], 0.1, 1.0, xtol=1e-13)
    assert_allclose([found.contacts[0], found.load_bearing[0]], stable(touching), rtol=1e-6)


def test_fines_among_coarse_grains_are_mostly_rattlers():
    radius, share = NODES["uniform"]
    contacts, bearing = parking_contacts(radius, share)
    assert bearing[radius < 0.1].max() < 0.01
    assert bearing[radius > 0.9].min() > 0.99
    # Measured 3.9 near jamming, where Eq. 4 knows nothing of it and equal spheres have 6.
    assert 3.0 < share @ contacts < 4.5


def test_grains_without_room_for_six_neighbours_are_an_error():
    assert 0.35 * SPHERE / EQUAL < 6.0
    with pytest.raises(FitError, match="no room for six"):
        parking_contacts(np.array([1.0]), np.ones(1), coverage=0.35)


@pytest.mark.parametrize("ratio", [90.0, 170.0, 300.0])
@pytest.mark.parametrize("surface", [1e-8, 0.02, 0.15, 5.0])
def test_huge_grains_among_fines_carry_all_the_load_or_hardly_change_it(ratio, surface):
    # A huge grain has room for so many that few contacts on average need very unlikely ones.
    radius, share = np.array([1.0, ratio]), np.array([ratio**2, surface])
    contacts, bearing = parking_contacts(radius, share / share.sum())
    single, held = parking_contacts(np.ones(1), np.ones(1))
    # Fines that fit into the pores of the coarse: 0.64 of what is left of 0.64.
    fines = 1.0 / (1.0 + surface * ratio)
    coarse_alone = fines < 0.64 * 0.36 / (0.64 + 0.64 * 0.36)
    # Without neighbours of the other size each is a packing of equal spheres.
    assert contacts[int(coarse_alone)] == pytest.approx(single[0], rel=2e-3)
    assert bearing[int(coarse_alone)] == pytest.approx(held[0], rel=5e-3)
    if coarse_alone:
        assert contacts[0] < 1e-9
    else:
        assert contacts[1] > 1e3


# --- solutions, and which ------------------------------------------------------------------------

LINEAR, HERTZ = LinearContact(1e6), HertzContact(1e9)
PARTS = {
    "crushed": (uniform(0.5e-3, 1.0e-3, "number"), fractal(0.1e-3, 1.0e-3, 2.6)),
    "ratio 200": (uniform(0.005e-3, 1.0e-3, "number"), fractal(0.005e-3, 1.0e-3, 2.6)),
    "gap-graded": (uniform(0.5e-3, 0.6e-3, "number"), uniform(0.085e-3, 0.1e-3, "number")),
}


@cache
def solved(name, share):
    """Return the nodes of a mixture by mass, its solid fraction at jamming, and its solutions."""
    shares = [1.0 - share, share]
    kept = [(part, weight) for part, weight in zip(PARTS[name], shares, strict=True) if weight]
    radius, number = grading_nodes(mixture(*zip(*kept, strict=True), "mass"))
    phi = rod_map(radius, number).solid_fraction
    return radius, number, phi, parking_solutions(radius, number)


def stiffness(name, share, law):
    """Return H of each solution of a mixture by its name, the chosen one first."""
    radius, number, phi, solutions = solved(name, share)
    return {
        solution.name: affine_modulus(radius, number, solution.coordination, phi, law)
        for solution in solutions
    }


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        (LINEAR, [1.062, 1.196, 3.631, 4.063, 4.514, 4.712]),
        (HERTZ, [1.017, 1.063, 1.965, 2.006, 1.922, 1.756]),
    ],
)
def test_stiffness_of_mixtures_by_another_program(law, expected):
    first = stiffness("crushed", 0.0, law)["only"]
    found = [
        stiffness("crushed", share, law)["only"] / first
        for share in (1 / 8, 1 / 4, 3 / 8, 1 / 2, 3 / 4, 1.0)
    ]
    assert_allclose(found, expected, atol=6e-4)


@pytest.mark.parametrize(
    ("parts", "share", "coarse", "fine", "chosen"),
    [
        ("crushed", 0.27, None, None, "coarse"),
        ("crushed", 0.30, 1.33, 3.16, "coarse"),
        ("crushed", 0.32, None, None, "coarse"),
        # Its fine solution is reached from above only, with p held step by step.
        ("ratio 200", 0.10, 1.04, 49.0, "coarse"),
        ("gap-graded", 0.15, 1.00, 4.98, "coarse"),
        ("gap-graded", 0.25, 0.93, 6.17, "fine"),
        ("gap-graded", 0.30, 0.86, 6.42, "fine"),
    ],
)
def test_two_solutions_and_the_one_that_rods_choose(parts, share, coarse, fine, chosen):
    found = stiffness(parts, share, LINEAR)
    assert set(found) == {"coarse", "fine"}
    assert next(iter(found)) == chosen
    if coarse is not None:
        first = stiffness(parts, 0.0, LINEAR)["only"]
        expected = {"coarse": coarse, "fine": fine}
        assert {name: H / first for name, H in found.items()} == pytest.approx(expected, rel=0.01)


def test_one_fine_solution_beyond_the_window():
    assert list(stiffness("crushed", 0.34, LINEAR)) == ["only"]
