"""The certificate on invented states: each limit from both sides, each reason to withhold it."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.loading.targets import STEP_UNBALANCED_FORCE_RATIO
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.samples.certificate import (
    LIMITS,
    jamming_points,
    sample_certificate,
    state_certificates,
)

STRESS, WORK = 1e6, 2.0


def path_of(legs="lll", loaded=(False, True, True), **columns):
    """Return a `path.csv` of sound states; l is a loading state, u an unloading one."""
    states, loaded = len(legs), np.array(loaded)
    table = {
        "state": range(states),
        "leg": ["loading" if leg == "l" else "unloading" for leg in legs],
        "solid_fraction": 0.6 + 0.02 * np.arange(states),
        "mean_stress_Pa": np.where(loaded, STRESS, 0.0),
        "boundary_stress_Pa": np.where(loaded, STRESS, 0.0),
        "work_J": np.where(loaded, WORK, 0.0),
        "dissipated_J": np.where(loaded, WORK / 10, 0.0),
        "rattler_fraction": 0.1,
        "carries_load": loaded,
        "unbalanced_force_ratio": 1e-8,
        # Without stress it has no meaning.
        "inertial_number": np.where(loaded, 1e-7, np.nan),
        "median_overlap_ratio": 0.01,
        "overlap_ratio_95": 0.02,
        "max_overlap_ratio": 0.03,
        "contact_law_error": 1e-15,
        "escaped": 0,
        "lost": 0,
        "force_evaluations": 1000 * np.arange(states),
        # As read from a CSV file: an empty cell is nan.
        "stopped": np.nan,
    }
    return pd.DataFrame(table).assign(**columns)


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
    assert (beyond["verdict"], beyond["certified"]) == ("flagged", True)
    assert beyond["reasons"] == "overlap at 95 % of the contacts is 5% of the radius"


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


# --- samples -------------------------------------------------------------------------------------


def converged(**changes):
    """Return a `convergence.csv` in which nothing changes but what is given."""
    rows = []
    for quantity, value in (("exponent", 3.0), ("mean_stress_Pa", 1e6), ("force_evaluations", 1e4)):
        difference, error = changes.get(quantity, (0.0, 1e-9))
        rows.append(
            {
                "quantity": quantity,
                "seeds": changes.get("seeds", 4),
                "value": value,
                "value_at_twice_the_steps": value + difference,
                "difference": difference,
                "standard_error_of_difference": error,
            }
        )
    return pd.DataFrame(rows)


NO_CONVERGENCE = converged()[:0]


def certificate_of(paths, convergence=None, warnings=(), **jamming):
    seeds = list(range(3, 3 + len(paths)))
    points = {
        "seed": seeds,
        "jamming_solid_fraction_loading": 0.64 + 0.002 * np.arange(len(paths)),
        "jamming_solid_fraction_unloading": np.nan,
        "uncertainty_loading": 1e-4,
        "loaded_from_the_start": False,
    }
    return sample_certificate(
        state_certificates(seeds, paths),
        paths,
        pd.DataFrame({**points, **jamming}),
        converged() if convergence is None else convergence,
        {"representativity": {"warnings": list(warnings)}},
    )


def test_sound_sample_is_certified_with_its_worst_values():
    found = certificate_of([path_of(), path_of(unbalanced_force_ratio=9e-7)])
    assert (found["verdict"], found["reasons"], found["flags"]) == ("certified", [], [])
    assert (found["seeds"], found["seeds_certified"]) == (2, 2)
    assert (found["states"], found["states_loaded"], found["states_certified"]) == (6, 4, 4)
    assert found["limits"] == LIMITS
    assert found["worst"]["unbalanced_force_ratio"] == 9e-7
    assert found["worst"]["escaped"] == 0
    assert_allclose(found["jamming_solid_fraction"], 0.641)
    assert_allclose(found["jamming_solid_fraction_scatter"], 0.002 / np.sqrt(2))
    assert found["jamming_solid_fraction_unloading"] is None
    assert_allclose(found["dissipated_share_at_end"], 0.1)
    assert found["force_evaluations"] == 2000
    assert [row["quantity"] for row in found["convergence"]] == list(converged()["quantity"])


def test_what_tells_of_the_end_is_of_the_end_of_the_loading():
    path = path_of("llu", (False, True, True), rattler_fraction=[1.0, 0.1, 0.4])
    assert certificate_of([path])["rattler_fraction_at_end"] == 0.1


def test_seed_that_stopped_is_named_with_its_reason():
    stopped = [np.nan, "stopped at an edge of 1 m: no rest"]
    short = path_of("ll", (False, True), stopped=stopped)
    found = certificate_of([path_of(), short])
    assert found["verdict"] == "not certified"
    assert found["reasons"] == ["seed 4: stopped at an edge of 1 m: no rest"]


def test_packings_without_load_are_counted_with_the_fractions_reached():
    loose = [path_of(loaded=[False] * 3, solid_fraction=[0.1, 0.2, end]) for end in (0.5, 0.52)]
    found = certificate_of([path_of(), *loose])
    assert found["reasons"] == [
        "2 of 3 packings carry no load at the end of their loading, solid fraction 0.5000 to "
        "0.5200: load further"
    ]
    assert found["seeds_certified"] == 1


def test_sample_that_never_carries_load_has_no_worst_values():
    found = certificate_of([path_of(loaded=[False] * 3)])
    assert set(found["worst"].values()) == {None}
    assert found["verdict"] == "not certified"


def test_packing_unloaded_on_its_way_back_carried_load_at_the_end_of_its_loading():
    path = path_of("lluu", (False, True, True, False))
    assert certificate_of([path])["verdict"] == "certified"


def test_first_five_states_that_fail_are_named_and_the_others_counted():
    moving = path_of("l" * 8, [True] * 8, inertial_number=[1e-7] + [1e-2] * 7)
    reasons = certificate_of([moving])["reasons"]
    assert reasons[0] == "seed 3, state 1: moving: inertial number 0.01, at most 0.0001"
    assert [reason.split(":")[0] for reason in reasons[:5]] == [
        f"seed 3, state {state}" for state in range(1, 6)
    ]
    assert reasons[5:] == ["and 2 more states"]


@pytest.mark.parametrize(
    ("quantity", "within", "beyond"),
    [("exponent", 0.099, 0.101), ("mean_stress_Pa", 1.99e4, 2.01e4)],
)
@pytest.mark.parametrize("sign", [-1, 1])
def test_change_beyond_what_is_allowed_and_beyond_noise_is_not_converged(
    quantity, within, beyond, sign
):
    for change, reasons in ((within, 0), (beyond, 1)):
        table = converged(**{quantity: (sign * change, 1e-12)})
        found = certificate_of([path_of()], table)["reasons"]
        assert len(found) == reasons
        assert all(text.startswith(f"not converged: {quantity} changes from ") for text in found)


@pytest.mark.parametrize(("seeds", "student"), [(4, 3.1824463), (2, 12.7062047)])
def test_change_within_the_noise_of_its_pairs_is_no_change(seeds, student):
    for times, reasons in ((0.999, 1), (1.001, 0)):
        table = converged(exponent=(0.5, times * 0.5 / student), seeds=seeds)
        found = certificate_of([path_of()], table)
        assert len(found["reasons"]) == reasons
        # What is left to chance is said: too few pairs to tell.
        assert [
            flag.startswith("convergence not decided: exponent") for flag in found["flags"]
        ] == [True] * (1 - reasons)


def test_change_of_one_pair_has_no_noise_to_hide_in():
    table = converged(exponent=(0.11, np.nan), seeds=1)
    assert len(certificate_of([path_of()], table)["reasons"]) == 1


def test_cost_of_twice_the_steps_is_no_matter_of_convergence():
    table = converged(force_evaluations=(1e4, 1.0))
    assert certificate_of([path_of()], table)["verdict"] == "certified"


def test_exponent_that_no_seed_gives_is_not_compared():
    table = converged(exponent=(np.nan, np.nan))
    assert certificate_of([path_of()], table)["verdict"] == "certified"


def test_sample_without_a_second_run_is_flagged():
    found = certificate_of([path_of()], NO_CONVERGENCE)
    assert found["verdict"] == "flagged"
    assert found["flags"] == [
        "convergence not checked: no seed was run again with twice the strain steps and certified "
        "in both runs"
    ]
    assert found["convergence"] == []


def test_warnings_of_the_grading_are_repeated():
    found = certificate_of([path_of()], warnings=["60 grains: too few for this grading"])
    assert (found["verdict"], found["reasons"]) == ("flagged", [])
    assert found["flags"] == ["60 grains: too few for this grading"]


def test_deep_overlaps_at_the_end_are_flagged_with_their_medians():
    deep = path_of(overlap_ratio_95=[0.0, 0.02, 0.08], median_overlap_ratio=[0.0, 0.01, 0.04])
    found = certificate_of([deep, deep])
    assert (found["verdict"], found["seeds_certified"]) == ("flagged", 2)
    (flag,) = found["flags"]
    assert flag.startswith("overlaps at the end: 4.0% of the smaller radius in the median, 8.0% at")
    passing = path_of(overlap_ratio_95=[0.0, 0.08, 0.02])
    assert certificate_of([passing])["flags"] == []


def test_load_at_the_first_step_is_flagged():
    found = certificate_of([path_of()], loaded_from_the_start=True)
    assert "lower loading.approach_solid_fraction" in found["flags"][0]


def test_all_reasons_and_flags_are_given_at_once():
    moving = path_of(inertial_number=[np.nan, 1e-7, 1e-2])
    stopped = path_of("ll", (False, True), stopped=[np.nan, "stopped on the way"])
    loose = path_of(loaded=[False] * 3)
    table = converged(exponent=(0.5, 1e-9), mean_stress_Pa=(1e5, 1.0))
    found = certificate_of([moving, stopped, loose], table, ["few grains"])
    assert [reason.split(" ")[0] for reason in found["reasons"]] == ["seed", "1", "seed"] + [
        "not"
    ] * 2
    assert found["flags"] == ["few grains"]
    assert found["verdict"] == "not certified"
