"""The certificate on invented states: each limit from both sides, each reason to withhold it."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.loading.targets import STEP_UNBALANCED_FORCE_RATIO
from branchcrush.packings.contact_laws import OVERLAP_FLAG, LinearContact
from branchcrush.samples.certificate import (
    LIMITS,
    certificate_tables,
    jamming_points,
    state_certificates,
)
from tests.unit.samples.sound_paths import STRESS, WORK, path_of


def with_measure(name, value):
    """Return a path whose last state has a measure of this value."""
    path, last = path_of(), 2
    path[["escaped", "lost"]] = path[["escaped", "lost"]].astype(float)
    if name == "stress_identity_error":
        path.loc[last, "boundary_stress_Pa"] = STRESS / (1 + value)
    elif name == "energy_excess":
        path.loc[last, "dissipated_J"] = -value * WORK
    else:
        path.loc[last, name] = value
    return path


def verdict_of(path, number=-1):
    return state_certificates([1], [path]).iloc[number]


# --- states --------------------------------------------------------------------------------------


def test_sound_states_are_certified_where_they_carry_load():
    states = state_certificates([3, 5], [path_of(), path_of()])
    assert states["seed"].tolist() == [3, 3, 3, 5, 5, 5]
    assert states["state"].tolist() == [0, 1, 2] * 2
    assert states["verdict"].tolist() == ["no load", "certified", "certified"] * 2
    assert states["certified"].tolist() == [False, True, True] * 2
    assert (states["reasons"] == "").all()
    assert_allclose(states["dissipated_share"], [np.nan, 0.1, 0.1] * 2)


@pytest.mark.parametrize("name", LIMITS)
def test_state_just_within_a_limit_is_certified(name):
    value = LIMITS[name] * (1 - 1e-6)
    found = verdict_of(with_measure(name, value))
    assert_allclose(found[name], value, rtol=1e-8, atol=0)
    assert (found["certified"], found["verdict"], found["reasons"]) == (True, "certified", "")


@pytest.mark.parametrize("name", LIMITS)
def test_state_just_beyond_a_limit_is_not_and_says_by_how_much(name):
    value = LIMITS[name] * (1 + 1e-6) or 1
    found = verdict_of(with_measure(name, value))
    assert (found["certified"], found["verdict"]) == (False, "not certified")
    assert found["reasons"].endswith(f"{value:.3g}, at most {LIMITS[name]:g}")
    # The state before it is as sound as ever.
    assert verdict_of(with_measure(name, value), 1)["certified"]


@pytest.mark.parametrize("name", [name for name in LIMITS if name != "energy_excess"])
def test_loaded_state_with_a_measure_that_is_no_number_is_not_certified(name):
    assert verdict_of(with_measure(name, np.nan))["verdict"] == "not certified"


def test_energy_without_work_is_not_certified():
    path = path_of(work_J=[0.0, WORK, 0.0], dissipated_J=[0.0, 0.1, -1.0])
    assert verdict_of(path)["verdict"] == "not certified"


def test_reasons_of_a_state_stand_side_by_side():
    path = path_of(escaped=[0, 0, 2], unbalanced_force_ratio=[1e-8, 1e-8, 1e-3])
    assert verdict_of(path)["reasons"] == (
        "not at rest: unbalanced force ratio 0.001, at most 1e-06; "
        "grains outside the cell: 2, at most 0"
    )


def test_stress_may_err_to_either_side():
    for sign in (-1, 1):
        path = path_of(mean_stress_Pa=STRESS * (1 + sign * 1e-5))
        assert "differs from that of the boundary" in verdict_of(path)["reasons"]


def test_state_without_load_may_lack_measures_but_not_grains():
    loose = path_of(loaded=(False, False, False))
    found = verdict_of(loose)
    assert found[["inertial_number", "stress_identity_error", "energy_excess"]].isna().all()
    assert (found["certified"], found["verdict"], found["reasons"]) == (False, "no load", "")
    assert verdict_of(loose.assign(lost=1))["verdict"] == "not certified"


def test_deep_overlaps_flag_a_state_and_leave_its_certificate():
    at_limit, beyond = (
        verdict_of(path_of(overlap_ratio_95=value)) for value in (OVERLAP_FLAG, 0.0501)
    )
    assert at_limit["verdict"] == "certified"
    assert (beyond["verdict"], beyond["certified"]) == ("certified with notes", True)
    assert beyond["reasons"] == "overlap at 95 % of the contacts is 5% of the radius"


def test_limits_are_those_that_the_documents_name():
    # docs/model.md, "Certificate".
    assert LIMITS == {
        "unbalanced_force_ratio": 1e-6,
        "inertial_number": 1e-4,
        "stress_identity_error": 1e-6,
        "contact_law_error": 1e-9,
        "energy_excess": 1e-4,
        "escaped": 0,
        "lost": 0,
    }


def test_certificate_and_jamming_of_a_sample_come_with_the_floor_of_its_grains():
    # The floor of equal grains: F_0 = k 1e-4 R, over pi R^2.
    law, radius = LinearContact(1e6), 1e-3
    floor = 1e6 * 1e-4 * radius / (np.pi * radius**2)
    steps = steps_of(WAY_IN, 0.641)
    steps["mean_stress_Pa"] += 0.999 * floor
    path = path_of(solid_fraction=[0.6, 0.64, 0.68])
    radii = [np.full(10, radius)]
    states, points = certificate_tables(law, [3], [path], [steps], radii)
    assert states["seed"].tolist() == [3, 3, 3]
    assert states["verdict"].tolist() == ["no load", "certified", "certified"]
    assert points["steps_loading"].tolist() == [8]
    steps["mean_stress_Pa"] += 0.002 * floor
    _, points = certificate_tables(law, [3], [path], [steps], radii)
    assert points["loaded_from_the_start"].tolist() == [True]


# --- jamming -------------------------------------------------------------------------------------


def steps_of(phi, jamming):
    phi = np.asarray(phi)
    stress = 1e8 * np.maximum(phi - np.asarray(jamming), 0.0)
    return pd.DataFrame(
        {"solid_fraction": phi, "mean_stress_Pa": stress, "unbalanced_force_ratio": 1e-2}
    )


WAY_IN, WAY_BACK = np.linspace(0.60, 0.68, 17), np.linspace(0.675, 0.60, 16)


def test_each_packing_jams_on_the_way_in_and_on_the_way_back():
    there_and_back = steps_of(
        np.append(WAY_IN, WAY_BACK), np.append(np.full(17, 0.641), np.full(16, 0.648))
    )
    path = path_of("llu", solid_fraction=[0.6, 0.68, 0.6])
    only_in = steps_of(WAY_IN, 0.643), path_of("lll", solid_fraction=[0.6, 0.64, 0.68])
    found = jamming_points([3, 5], [there_and_back, only_in[0]], [path, only_in[1]], 1.0, [1, 1])
    assert found["seed"].tolist() == [3, 5]
    assert_allclose(found["jamming_solid_fraction_loading"], [0.641, 0.643], atol=1e-9)
    assert_allclose(found["jamming_solid_fraction_unloading"], [0.648, np.nan], atol=1e-9)
    assert found["steps_loading"].tolist() == [8, 8]
    assert found["steps_unloading"].tolist() == [6, 0]
    assert not found["loaded_from_the_start"].any()


@pytest.mark.parametrize("asked", STEP_UNBALANCED_FORCE_RATIO.values())
def test_a_step_that_came_to_rest_as_far_as_it_was_asked_counts(asked):
    steps = steps_of(WAY_IN, 0.641)
    steps["unbalanced_force_ratio"] = asked
    path = path_of(solid_fraction=[0.6, 0.64, 0.68])
    points = jamming_points([1], [steps], [path], 1.0, [1.0])
    assert points["steps_loading"].tolist() == [8]


def test_steps_that_went_on_before_they_came_to_rest_are_left_out():
    steps = steps_of(WAY_IN, 0.641)
    # Below jamming a packing in motion has stress, and would seem to carry load.
    moving = steps["solid_fraction"].between(0.61, 0.65)
    assert 3 < moving.sum() < len(steps) - 3
    steps.loc[moving, "mean_stress_Pa"] += 2e5
    steps.loc[moving, "unbalanced_force_ratio"] = 0.05
    path = path_of(solid_fraction=[0.6, 0.64, 0.68])
    found = jamming_points([1], [steps], [path], 1.0, [1.0])
    assert_allclose(found["jamming_solid_fraction_loading"], 0.641, atol=1e-9)


def test_stress_of_hertz_contacts_is_extrapolated_with_its_own_exponent():
    steps = steps_of(WAY_IN, 0.641)
    steps["mean_stress_Pa"] = steps["mean_stress_Pa"] ** 1.5
    path = path_of(solid_fraction=[0.6, 0.64, 0.68])
    found = jamming_points([1], [steps], [path], 1.5, [1.0])
    assert_allclose(found["jamming_solid_fraction_loading"], 0.641, atol=1e-9)


@pytest.mark.parametrize("count", [0, 1, 3])
def test_too_few_loaded_steps_give_no_jamming_point(count):
    # None at all: the run stopped on its approach.
    steps = steps_of(WAY_IN[-count:] if count else [], 0.0)
    path = path_of(solid_fraction=[0.6, 0.64, 0.68])
    found = jamming_points([1], [steps], [path], 1.0, [1.0])
    assert found.filter(like="jamming_solid_fraction").isna().all(axis=None)
    assert found.filter(like="uncertainty").isna().all(axis=None)
    assert found["steps_loading"].tolist() == [0]
    assert found["loaded_from_the_start"].tolist() == [count > 0]
