"""What a compression is asked for: targets in order, and steps small enough."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.loading.targets import (
    STATE_TOLERANCES,
    STRAIN_STEPS,
    STRAIN_TARGETS,
    Loading,
    expected_overlap_ratio,
    final_solid_fraction,
    loading_targets,
    planned_steps,
    strain_step,
)
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.samples.certificate import LIMITS

RADII = np.array([1.0, 0.5, 0.25])


def loading(target, value, *, states=4, unloading=False, approach=0.3):
    return Loading(target, value, states, approach, unloading)


@given(st.floats(0.01, 0.3), st.floats(0.01, 0.5))
def test_the_three_ways_to_tell_the_end_of_a_path_agree(initial, edge_reduction):
    by_edge = final_solid_fraction(initial, "edge_reduction", edge_reduction)
    # The solid volume stays; the cell's is that of the shrunk cube.
    assert_allclose(by_edge * (1 - edge_reduction) ** 3, initial, rtol=1e-13)
    by_volume = final_solid_fraction(initial, "volume_reduction", 1 - (1 - edge_reduction) ** 3)
    assert_allclose(by_volume, by_edge, rtol=1e-12)
    assert final_solid_fraction(initial, "solid_fraction", by_edge) == by_edge


def test_no_reduction_is_where_the_packing_is():
    assert final_solid_fraction(0.16, "edge_reduction", 0.0) == 0.16
    assert final_solid_fraction(0.16, "volume_reduction", 0.0) == 0.16


def test_stresses_are_those_of_the_states():
    assert loading("mean_stress", 2).stresses == [2.0]
    assert loading("mean_stress", [1.0, 5, 7.0]).stresses == [1.0, 5.0, 7.0]
    assert loading("solid_fraction", 0.7).stresses == []
    # NumPy's numbers print as no number that LAMMPS reads.
    assert {type(value) for value in loading("mean_stress", np.float64(2)).stresses} == {float}


def test_a_loading_knows_where_it_ends():
    assert loading("edge_reduction", 0.5).end(0.08) == 0.64
    assert loading("volume_reduction", 0.75).end(0.16) == 0.64
    assert loading("solid_fraction", 0.7).end(0.16) == 0.7


@pytest.mark.parametrize("target", STRAIN_TARGETS)
def test_edges_go_evenly_from_the_approach_to_the_end(target):
    value = {"edge_reduction": 0.4, "volume_reduction": 0.784, "solid_fraction": 0.1 / 0.6**3}
    control, edges = loading_targets(RADII, 0.1, loading(target, value[target]))
    assert control == "edge"
    first = cube_edge(RADII, 0.3)
    assert_allclose(edges[-1], 0.6 * cube_edge(RADII, 0.1), rtol=1e-13)
    assert_allclose(np.diff([first, *edges]), (edges[-1] - first) / 4, rtol=1e-12)
    assert {type(edge) for edge in edges} == {float}


def test_stresses_are_the_targets_as_they_are():
    asked = loading("mean_stress", [1.0, 10.0, 100.0], states=7)
    control, targets = loading_targets(RADII, 0.1, asked)
    assert (control, targets) == ("stress", [1.0, 10.0, 100.0])


@pytest.mark.parametrize("states", [1, 2, 5])
def test_unloading_goes_the_same_way_back_but_for_the_last(states):
    there = loading_targets(RADII, 0.1, loading("edge_reduction", 0.4, states=states))[1]
    cycle = loading("edge_reduction", 0.4, states=states, unloading=True)
    targets = loading_targets(RADII, 0.1, cycle)[1]
    assert len(targets) == 2 * states - 1
    assert targets[:states] == there
    assert targets == targets[::-1]


def test_a_single_stress_has_no_way_back():
    asked = loading("mean_stress", 5.0, unloading=True)
    assert loading_targets(RADII, 0.1, asked) == ("stress", [5.0])


def test_a_better_quality_and_a_refinement_take_smaller_steps():
    draft, standard, fine = (strain_step(quality) for quality in ("draft", "standard", "fine"))
    assert draft > standard > fine > 0
    assert list(STRAIN_STEPS) == list(STATE_TOLERANCES) == ["draft", "standard", "fine"]
    assert strain_step("standard", 2) == standard / 2
    assert strain_step("draft", 4) == strain_step("standard")


def test_a_state_of_any_quality_may_be_certified():
    # Half of the tolerance is what relaxation aims at.
    assert max(STATE_TOLERANCES.values()) <= LIMITS["unbalanced_force_ratio"]


# --- what is expected of a loading ----------------------------------------------------------------


def test_expected_overlap_of_linear_contacts_is_the_force_over_the_stiffness():
    # Half a metre and 3.84/pi Pa: F = 4 pi P R^2/(0.64 x 6) = 1 N, over 4 N/m a quarter.
    assert_allclose(expected_overlap_ratio(3.84 / np.pi, 0.5, LinearContact(4.0)), 0.5, rtol=1e-14)


def test_expected_overlap_of_hertz_contacts_is_that_of_two_equal_grains():
    # R* = R/2 = 1/4: 1 N = 16 x sqrt(1/4) x (1/4)^1.5.
    assert_allclose(expected_overlap_ratio(3.84 / np.pi, 0.5, HertzContact(16.0)), 0.5, rtol=1e-14)


@pytest.mark.parametrize(("law", "power"), [(LinearContact, 1.0), (HertzContact, 2 / 3)])
def test_expected_overlap_over_the_radius_goes_with_stress_over_stiffness(law, power):
    one = expected_overlap_ratio(1e5, 1e-3, law(1e8))
    assert_allclose(expected_overlap_ratio(8e5, 1e-3, law(1e8)), 8**power * one, rtol=1e-13)
    assert_allclose(expected_overlap_ratio(1e5, 1e-3, law(8e8)), one / 8**power, rtol=1e-13)


# From this solid fraction to 0.64 it is a linear strain of 0.1.
APPROACH = 0.64 * np.exp(-0.3)


@pytest.mark.parametrize(("step", "steps"), [(0.01, 4 * 3), (0.025, 4), (0.024, 4 * 2), (0.1, 4)])
def test_every_state_of_a_strain_has_the_same_whole_number_of_steps(step, steps):
    asked = loading("solid_fraction", 0.64, approach=APPROACH)
    assert planned_steps(asked, 0.1, step) == (steps, 4)


def test_steps_to_stresses_go_as_far_as_grains_overlap_and_four_more_to_each():
    asked = loading("mean_stress", [1.0, 2.0, 3.0], approach=APPROACH)
    # (0.1 + 0.05)/0.02 = 7.5
    assert planned_steps(asked, 0.1, 0.02, overlap=0.05) == (8 + 4 * 3, 3)


def test_a_way_that_begins_beyond_0_64_takes_the_steps_of_the_overlap_only():
    asked = loading("mean_stress", [1.0], approach=0.7)
    assert planned_steps(asked, 0.1, 0.02, overlap=0.05) == (3 + 4, 1)


@pytest.mark.parametrize(
    ("target", "value", "there"),
    [("solid_fraction", 0.64, (12, 4)), ("mean_stress", [1.0, 2.0], (10 + 8, 2))],
)
def test_the_way_back_takes_as_many_steps_and_saves_the_end_once(target, value, there):
    steps, states = there
    asked = loading(target, value, approach=APPROACH)
    back = loading(target, value, approach=APPROACH, unloading=True)
    # A little more, so that rounding does not decide.
    assert planned_steps(asked, 0.1, 0.0100001) == there
    assert planned_steps(back, 0.1, 0.0100001) == (2 * steps, 2 * states - 1)
