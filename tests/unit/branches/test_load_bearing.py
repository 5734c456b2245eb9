"""Who carries load by rods that push, and the stiffness of such a network."""

import numpy as np
import pytest

from branchcrush.branches.affine import affine_modulus
from branchcrush.branches.coordination import Coordination
from branchcrush.branches.load_bearing import (
    compressed_coordination,
    load_bearing,
    rod_contacts,
    rod_coordination,
)
from branchcrush.branches.nodes import grading_nodes
from branchcrush.errors import FitError
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import mixture
from branchcrush.gradings.rods import RodMap, rod_map
from branchcrush.packings.contact_laws import HertzContact, LinearContact

COARSE = uniform(0.5e-3, 1.0e-3, "number")
FINE = fractal(0.1e-3, 1.0e-3, 2.6)
MIXED = {0.0: COARSE, 1.0: FINE} | {
    share: mixture([COARSE, FINE], [1.0 - share, share], "mass")
    for share in (1 / 8, 1 / 4, 3 / 8, 1 / 2, 3 / 4)
}


def half_pushing():
    """Return a map of two sizes in which every rod above a length of 1 pushes."""
    return RodMap(
        length=np.array([1.5, 0.5]),
        edge=np.array([2.0, 1.0, 0.0]),
        pushes=np.array([True, False]),
        solid_fraction=0.7,
    )


def test_contacts_by_hand():
    radius, share = np.array([0.5, 1.0]), np.array([0.5, 0.5])
    coordination = rod_coordination(radius, share, half_pushing(), mechanical=7.0)
    # Grains of diameter 1 have no chord above 1; of those of diameter 2 1 - 1/4 push.
    np.testing.assert_allclose(coordination.load_bearing, [0.0, 0.75])
    np.testing.assert_allclose(coordination.contacts, [0.0, 0.75 * 7.0])


@pytest.mark.parametrize("share_of_fines", [0.0, 0.25, 0.5, 1.0])
def test_grains_that_carry_load_are_isostatic_at_jamming(share_of_fines):
    radius, share = grading_nodes(MIXED[share_of_fines])
    coordination = rod_contacts(radius, share)
    mean = share @ coordination.contacts / (share @ coordination.load_bearing)
    assert mean == pytest.approx(6.0, abs=1e-9)


def test_no_rod_pushes():
    rods = half_pushing()
    still = RodMap(rods.length, rods.edge, np.zeros(2, dtype=bool), rods.solid_fraction)
    with pytest.raises(FitError, match="nothing carries load"):
        rod_coordination(np.array([1.0]), np.array([1.0]), still)


@pytest.mark.parametrize(
    ("share", "near", "far"),
    [
        (0.0, 0.95, 0.95),
        (1 / 8, 0.24, 0.28),
        (1 / 4, 0.23, 0.30),
        (3 / 8, 0.37, 0.58),
        (1 / 2, 0.71, 0.79),
        (3 / 4, 0.85, 0.89),
        (1.0, 0.89, 0.91),
    ],
)
def test_load_bearing_along_the_path_by_another_program(share, near, far):
    radius, weight = grading_nodes(MIXED[share])
    for strain, expected in ((0.02, near), (0.07, far)):
        coordination, _ = compressed_coordination(radius, weight, strain)
        assert weight @ coordination.load_bearing == pytest.approx(expected, abs=0.006)


def test_compressed_by_the_jamming_law():
    one = np.array([1.0]), np.array([1.0])
    jammed, start = compressed_coordination(*one, 0.0)
    pressed, phi = compressed_coordination(*one, 0.05)
    assert jammed.contacts / jammed.load_bearing == pytest.approx(6.0)
    assert phi == pytest.approx(start / 0.95)
    law = 6.0 + 7.8 * np.sqrt(phi - start)
    assert pressed.contacts / pressed.load_bearing == pytest.approx(law)


@pytest.mark.parametrize(
    ("grading", "jamming", "by_number", "finest"),
    [(MIXED[0.0], 0.65149, 0.95, 1.0e-3), (MIXED[1 / 4], 0.72079, 0.23, None)],
)
def test_who_carries_load_by_another_program(grading, jamming, by_number, finest):
    found = load_bearing(*grading_nodes(grading))
    assert found.solid_fraction == pytest.approx(jamming, abs=1e-4)
    assert found.by_number == pytest.approx(by_number, abs=0.02)
    assert found.coordination_number == pytest.approx(6.0 * found.by_number)
    # The grains that carry load have most of the mass.
    assert found.by_number < found.by_mass <= 1.0
    if finest is not None:
        assert 2.0 * found.finest == pytest.approx(finest, rel=0.01)


def test_fines_in_the_pores_carry_nothing():
    grading = mixture([uniform(0.5e-3, 0.6e-3), uniform(0.085e-3, 0.1e-3)], [0.85, 0.15], "mass")
    found = load_bearing(*grading_nodes(grading))
    assert 2.0 * found.finest == pytest.approx(1.0e-3, rel=0.01)
    assert found.by_mass == pytest.approx(0.85 * 0.95, abs=0.02)


@pytest.mark.parametrize("strain", [-0.01, 0.4, 1.0])
def test_no_such_strain(strain):
    with pytest.raises(ValueError, match="beyond jamming"):
        compressed_coordination(np.array([1.0]), np.array([1.0]), strain)


def test_affine_modulus_of_two_sizes_by_hand():
    radius, share = np.array([1.0, 2.0]), np.array([0.5, 0.5])
    coordination = Coordination(np.array([2.0, 6.0]), np.ones(2))
    # kappa = 4, Q = 1/4, 3/4; <V> = 4/3 pi 4.5; <l^2> = 4/16 + 2 * 9 * 3/16 + 16 * 9/16.
    linear = 0.6 * 4.0 / (2.0 * 4.0 / 3.0 * np.pi * 4.5) * (4 + 54 + 144) / 16 * 5.0
    assert affine_modulus(radius, share, coordination, 0.6, LinearContact(5.0)) == pytest.approx(
        linear
    )
    # R* = 1/2, 2/3 and 1 at lengths of 2, 3 and 4, with weights of 1, 6 and 9 in 16.
    mean = 1 * 0.5**0.5 * 2**2.5 + 6 * (2 / 3) ** 0.5 * 3**2.5 + 9 * 1.0 * 4**2.5
    hertz = 0.6 * 4.0 / (2.0 * 4.0 / 3.0 * np.pi * 4.5) * mean / 16 * 5.0
    assert affine_modulus(radius, share, coordination, 0.6, HertzContact(5.0)) == pytest.approx(
        hertz
    )


@pytest.mark.parametrize(
    ("law", "expected"),
    [
        (LinearContact(1e6), [1.0, 1.20, 1.53, 2.26, 3.83, 4.73, 4.90]),
        (HertzContact(1e9), [1.0, 1.04, 1.16, 1.45, 2.03, 2.10, 1.86]),
    ],
)
def test_stiffness_of_mixtures_by_another_program(law, expected):
    moduli = []
    for share in (0.0, 1 / 8, 1 / 4, 3 / 8, 1 / 2, 3 / 4, 1.0):
        radius, weight = grading_nodes(MIXED[share])
        rods = rod_map(radius, weight)
        coordination = rod_coordination(radius, weight, rods)
        moduli.append(affine_modulus(radius, weight, coordination, rods.solid_fraction, law))
    np.testing.assert_allclose(np.divide(moduli, moduli[0]), expected, atol=0.006)
