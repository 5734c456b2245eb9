"""What holds of any crushing: mass, energy, and no grain overloaded where it is saved."""

import numpy as np
import pytest

from tests.physics.crushings import LIMIT, loose, rules, stored_in, variables


def test_grains_break_and_no_mass_is_lost(usual):
    grains, path = usual.grains, usual.path
    assert path["breakages"][-1] > 5
    mass = np.bincount(grains["state"], grains["radius_m"] ** 3)
    assert mass == pytest.approx(mass[0], rel=1e-9)
    for state in path["state"]:
        of_state = grains["grain"][grains["state"] == state]
        assert np.unique(of_state).size == of_state.size == path["grains"][state]


def test_fragments_are_those_of_their_parents(usual):
    first = {number: n for n, number in reversed(list(enumerate(usual.grains["grain"])))}
    broken = set(usual.breakages["grain"])
    fragments = [row for number, row in first.items() if usual.grains["parent"][row] >= 0]
    assert {usual.grains["parent"][row] for row in fragments} == broken
    radius = dict(zip(usual.breakages["grain"], usual.breakages["radius_m"], strict=True))
    generation = dict(zip(usual.breakages["grain"], usual.breakages["generation"], strict=True))
    for row in fragments:
        parent = usual.grains["parent"][row]
        assert usual.grains["radius_m"][row] < radius[parent]
        assert usual.grains["generation"][row] == generation[parent] + 1


def test_work_is_stored_or_taken_by_what_is_booked(usual):
    assert np.all(stored_in(usual.path) < 1e-6)
    for name in ("dissipated_breakage_J", "dissipated_rearrangement_J", "released_by_parents_J"):
        assert np.all(np.diff(usual.path[name])[1:] >= 0.0)
    # By parts that are not made of each other.
    released = usual.breakages["released_J"].sum()
    assert usual.path["released_by_parents_J"][-1] <= released * (1.0 + 1e-12)


def test_what_is_lost_by_the_size_of_the_strain_step_halves_with_it(crushed):
    packing, excess = loose(), {}
    for step in (2e-3, 1e-3):
        path = crushed(packing, variables(packing, strain_step=step), rules(np.inf)).path
        assert not path["breakages"].any()
        lost = path["dissipated_rearrangement_J"]
        assert np.all(path["step_excess_J"][1:] <= lost[1:] * (1.0 + 1e-9))
        excess[step] = path["step_excess_J"][-1] - path["step_excess_J"][1]
    assert excess[2e-3] > 0.0
    assert excess[1e-3] / excess[2e-3] == pytest.approx(0.5, rel=0.2)


def test_without_dashpots_all_that_is_taken_is_motion_at_the_stops(crushed):
    packing = loose()
    # Without dashpots a packing comes to rest by its stops alone, and in shorter time steps its
    # energy is kept between them.
    given = variables(packing, solid_fraction=0.68, normal_damping=0.0, time_step=0.3)
    path = crushed(packing, given, rules(3e6)).path
    assert path["breakages"][-1] > 5
    stopped = path["stopped_kinetic_energy_J"][-1] - path["stopped_kinetic_energy_J"][1]
    taken = path["dissipated_breakage_J"][-1] + path["dissipated_rearrangement_J"][-1]
    put_in, out = path["growth_work_J"][-1], path["exchanged_energy_J"][-1]
    assert out + stopped == pytest.approx(taken + put_in, rel=0.05)
    assert stopped > 0.5 * taken


def test_no_grain_above_the_limit_is_overloaded_at_a_saved_state(usual):
    grains = usual.grains
    large = 2.0 * grains["radius_m"] > LIMIT
    assert np.all(grains["stress_Pa"][large] < grains["strength_Pa"][large])
    assert np.all(usual.breakages["stress_Pa"] >= usual.breakages["strength_Pa"])
    assert not usual.path["escaped"].any()
    assert np.all(usual.path["contact_law_error"] < 1e-9)
    loaded = usual.path["carries_load"]
    assert loaded.any()
    assert np.all(usual.path["unbalanced_force_ratio"][loaded] <= 1e-6)
