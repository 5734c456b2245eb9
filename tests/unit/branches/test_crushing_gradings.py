"""A grading along its crushing without a simulation: identities and limits that are known."""

import numpy as np
import pytest

from branchcrush.branches.coordination import Coordination
from branchcrush.branches.crushing_gradings import crushing_gradings
from branchcrush.branches.uniform_stress import force_network
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.crushing.breakage import einav_breakage
from branchcrush.gradings.forms import uniform
from branchcrush.packings.contact_laws import HertzContact, LinearContact

SAND = uniform(0.4e-3, 0.6e-3)
LINEAR = LinearContact(1e6)
COARSE = {"classes": 10, "strengths": 20, "step": 4e-3}


def rules(**changed) -> Breakage:
    strength = {
        "strength": 2e7,
        "weibull_modulus": 3.0,
        "reference_diameter": 1e-3,
        "size_exponent": 1.0,
    }
    return Breakage(strength=Strength(**(strength | changed)), smallest_diameter=2.5e-4)


def test_mass_is_kept_and_breakage_never_falls():
    path = crushing_gradings(SAND, LINEAR, rules(), 0.72, **COARSE)
    np.testing.assert_allclose(path.mass.sum(axis=1), 1.0, rtol=0.0, atol=1e-12)
    finest = rules().finest_diameter / 2.0
    breakage = [
        einav_breakage(path.grading(0), path.grading(n), 2.6, 0.6e-3, finest)
        for n in range(len(path.mass))
    ]
    assert np.all(np.diff(breakage) >= -1e-12) and breakage[-1] > 0.1
    assert np.all(np.diff(path.broken_mass) >= -1e-15) and path.grains[-1] > 5.0


def test_grains_of_infinite_strength_never_break():
    path = crushing_gradings(SAND, LINEAR, rules(strength=np.inf), 0.68, **COARSE)
    assert np.all(path.broken_mass == 0.0) and np.all(path.dissipated == 0.0)
    np.testing.assert_allclose(path.elastic_strain, 1.0 - path.jamming[0] / path.solid_fraction)
    # The stress goes as the strain, times what contacts are won.
    stiffness = path.mean_stress[1:] / path.elastic_strain[1:]
    assert np.all(np.diff(stiffness) > 0.0) and stiffness[-1] < 1.5 * stiffness[0]


def test_a_finer_computation_says_the_same():
    coarse = crushing_gradings(SAND, LINEAR, rules(), 0.70, classes=20, strengths=30, step=2e-3)
    fine = crushing_gradings(SAND, LINEAR, rules(), 0.70, classes=30, strengths=60, step=2e-3)
    assert coarse.grains[-1] == pytest.approx(fine.grains[-1], rel=0.02)
    assert coarse.mean_stress[-1] == pytest.approx(fine.mean_stress[-1], rel=0.02)


def test_grains_twice_as_strong_break_at_twice_the_strain():
    """With b = 1 and linear contacts nothing but s d0/k sets the strain at which grains break."""
    soft = crushing_gradings(SAND, LINEAR, rules(), 0.68, **COARSE)
    stiff = crushing_gradings(SAND, LinearContact(2e6), rules(strength=4e7), 0.68, **COARSE)
    np.testing.assert_allclose(stiff.mass, soft.mass, atol=1e-12)
    np.testing.assert_allclose(stiff.mean_stress, 2.0 * soft.mean_stress, rtol=1e-9)


def test_another_criterion_and_too_loose_a_packing_are_refused():
    octahedral = Breakage(
        strength=rules().strength, smallest_diameter=2.5e-4, criterion="octahedral_stress"
    )
    with pytest.raises(ValueError, match=r"breakage\.criterion is octahedral_stress"):
        crushing_gradings(SAND, LINEAR, octahedral, 0.7)
    with pytest.raises(ValueError, match=r"must be above 0\.64"):
        crushing_gradings(SAND, LINEAR, rules(), 0.6)


@pytest.mark.parametrize(("law", "power"), [(LINEAR, 1.0), (HertzContact(2e10), 1.5)])
def test_every_grain_that_carries_load_bears_the_same_stress(law, power):
    radius, share = np.array([1e-3, 0.5e-3]), np.array([0.4, 0.6])
    coordination = Coordination(np.array([8.0, 2.0]), np.array([1.0, 0.4]))
    network = force_network(radius, share, coordination, 0.65, law)
    carrying = share * network.bearing
    # Sum of F R over the contacts of grains is 3 p V.
    volume = share @ (4.0 / 3.0 * np.pi * radius**3) / 0.65
    borne = carrying * network.contacts * network.force * radius
    assert borne.sum() == pytest.approx(3.0 * volume)
    assert network.stress(0.02) == pytest.approx(2.0**power * network.stress(0.01))


def test_a_lone_contact_breaks_as_its_force_is_drawn():
    one = np.array([1.0])
    network = force_network(one, one, Coordination(6.0 * one, one), 0.64, LinearContact(1.0))
    twice = np.array([[2.0 * network.force[0]]])
    alone = 5.0 * np.exp(-4.0)
    assert network.overloaded(twice, 1.0)[0, 0] == pytest.approx(1.0 - (1.0 - alone) ** 6)
    # The largest of six forces, drawn.
    drawn = np.random.default_rng(1).gamma(2.0, 0.5, (200_000, 6)).max(axis=1).mean()
    assert network.largest_force[0] / network.force[0] == pytest.approx(drawn, rel=0.01)
