"""Crushing between walls, with Hertz contacts, on ranks, there and back, and how a run ends."""

import re

import numpy as np
import pytest

from branchcrush.errors import SimulationError
from branchcrush.lammps import crush
from tests.physics.crushings import GLASS, LIMIT, loose, rules, stored_in, variables


@pytest.mark.parametrize(
    ("case", "how"),
    [
        ({"periodic": False, "approach": 0.5, "solid_fraction": 0.62}, {"strength": 2e7}),
        ({"law": GLASS}, {"strength": 5e7}),
        ({"unloading": True}, {"strength": 1e7}),
        ({}, {"strength": 1e7, "criterion": "octahedral_stress", "per_round": "one"}),
        ({}, {"strength": 1e7, "growth_stages": 0, "fragments": 20}),
        ({"solid_fraction": 0.655}, {"strength": 1e7, "stepping": "events"}),
        ({"law": GLASS, "solid_fraction": 0.69, "states": 1}, {"strength": 3e7}),
    ],
    ids=["walls", "Hertz", "unloading", "octahedral", "at once", "events", "Hertz in many rounds"],
)
def test_the_account_closes_in_every_case(crushed, case, how):
    periodic = case.get("periodic", True)
    packing = loose(periodic=periodic)
    out = crushed(packing, variables(packing, **case), rules(**how))
    assert out.path["breakages"][-1] > 0
    assert np.all(stored_in(out.path) < 1e-6)
    mass = np.bincount(out.grains["state"], out.grains["radius_m"] ** 3)
    assert mass == pytest.approx(mass[0], rel=1e-9)
    large = 2.0 * out.grains["radius_m"] > LIMIT
    assert np.all(out.grains["stress_Pa"][large] < out.grains["strength_Pa"][large])
    loaded = out.path["carries_load"]
    assert out.path["boundary_stress_Pa"][loaded] == pytest.approx(
        out.path["mean_stress_Pa"][loaded], rel=1e-4
    )
    if not periodic:
        assert out.walls["i"].size


def test_unloading_and_reloading(crushed):
    packing = loose()
    given = variables(packing)
    *_, before, end = given["targets"]
    out = crushed(packing, {**given, "targets": [*given["targets"], before, end]}, rules())
    stress, grains = out.path["mean_stress_Pa"], out.path["grains"]
    assert stress[-2] < stress[-3]
    assert np.all(stored_in(out.path) < 1e-6)
    assert grains[-1] >= grains[-2] >= grains[-3]


def test_ranks_give_the_same_strengths_and_a_closed_account(crushed, usual):
    packing = loose()
    out = crushed(packing, variables(packing), rules(), ranks=2)
    first = usual.grains["state"] == 0
    assert np.array_equal(
        out.grains["strength_Pa"][out.grains["state"] == 0], usual.grains["strength_Pa"][first]
    )
    assert np.all(stored_in(out.path) < 1e-6)
    assert out.path["breakages"][-1] > 0


def test_a_run_ends_validly_before_it_has_too_many_grains(crushed):
    packing = loose()
    out = crushed(packing, variables(packing), rules(largest_grains=100))
    assert "largest_grains 100" in out.path["stopped"][-1]
    assert out.path["grains"].max() <= 100
    assert np.all(stored_in(out.path) < 1e-6)


def test_a_run_ends_validly_at_a_stress(crushed):
    packing = loose()
    out = crushed(packing, variables(packing), rules(np.inf, largest_mean_stress=1e5))
    assert "largest_mean_stress" in out.path["stopped"][-1]
    assert np.all(out.path["mean_stress_Pa"][:-1] < 1e5)


def test_a_run_that_cannot_go_on_says_why_and_where_as_a_compression_does(crushed, monkeypatch):
    monkeypatch.setattr(crush, "LARGEST_RELAXATION", 3000)
    packing = loose()
    # No packing that carries load comes to rest so far.
    out = crushed(packing, variables(packing, state_tolerance=1e-18), rules(np.inf))
    reason = r"stopped at an edge of 0\.00\d+ m: not at rest after 3000 force evaluations: "
    assert re.match(reason, out.path["stopped"][-1])
    assert 2 <= len(out.path["state"]) < 7


def test_a_packing_that_is_crushed_by_the_approach_says_so(crushed):
    packing = loose()
    with pytest.raises(SimulationError, match="approach_solid_fraction"):
        crushed(packing, variables(packing, approach=0.66), rules(1e5))


def test_a_loading_to_stresses_is_refused(crushed):
    packing = loose()
    given = {**variables(packing), "control": "stress"}
    with pytest.raises(SimulationError, match="way to a strain"):
        crushed(packing, given, rules())
