"""The crushing without a simulation, as the rule has it, and where it says nothing."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from branchcrush.branches.crushing_gradings import crushing_gradings
from branchcrush.gradings.forms import uniform
from branchcrush.samples.crushing_predicted import QUANTITIES, measured_states, predicted_states
from branchcrush.samples.crushing_prediction import crushing_prediction, prediction_errors
from tests.unit.samples.crushed_runs import SAMPLE, run
from tests.unit.samples.test_crushing_predicted import RULES

GRADING = uniform(0.4e-3, 0.6e-3)
STEP = 2e-2


@pytest.fixture(scope="module")
def said():
    """Return states that are as they are predicted, but for a stress that is half of it."""
    path = crushing_gradings(GRADING, SAMPLE.law, RULES, 0.72, step=STEP)
    states = predicted_states(path, RULES, np.linspace(0.66, 0.72, 5))
    states["mean_stress_Pa"] /= 2.0
    return states.assign(state=range(3, 8))


def prediction(measured, rules=RULES, walls=False):
    return crushing_prediction(GRADING, SAMPLE.law, rules, measured, walls=walls, step=STEP)


def test_what_is_as_predicted_has_no_error_and_half_the_stress_that_of_2(said):
    predicted, beside, summary = prediction({1: said, 2: said})
    assert summary["reason"] is None
    assert predicted["solid_fraction"].iloc[[0, -1]].tolist() == pytest.approx(
        [summary["jamming_solid_fraction"], 0.72]
    )
    assert predicted["grains_ratio"].iloc[0] == 1.0
    assert summary["mean_stress_Pa_rms_ln"] == pytest.approx(np.log(2.0), abs=0.01)
    assert summary["mean_stress_Pa_bias_ln"] == pytest.approx(np.log(2.0), abs=0.01)
    for quantity in ("grains_ratio", "broken_mass_fraction", "dissipated_J_per_m3"):
        assert summary[f"{quantity}_rms_ln"] == pytest.approx(0.0, abs=0.02)
    yields = said["broken_mass_fraction"] >= 0.05
    assert 0 < summary["states_that_yield"] == yields.sum() == summary["grains_ratio_states"]
    assert set(beside["state"]) == set(said["state"])
    (sentence,) = summary["sentences"]
    of = f"{yields.sum()} of {yields.sum()} states"
    assert of in sentence and "the number of grains 0 %" in sentence
    stress = 100.0 * np.expm1(summary["mean_stress_Pa_rms_ln"])
    assert f"the stress {stress:.0f} %" in sentence


def test_between_walls_the_errors_are_said_to_be_those_of_the_walls_too(said):
    *errors, last = prediction({1: said}, walls=True).summary["sentences"]
    assert len(errors) == 1 and "between walls a packing is looser" in last


def nothing(why, *given, **more):
    predicted, beside, summary = prediction(*given, **more)
    assert not len(predicted) and not len(beside)
    assert set(QUANTITIES) <= set(predicted)
    assert why in summary["reason"] and summary["reason"] in summary["sentences"][0]
    assert np.isnan(summary["mean_stress_Pa_rms_ln"])


def test_where_nothing_can_be_predicted_it_says_why(said):
    octahedral = replace(RULES, criterion="octahedral_stress")
    nothing("breakage.criterion is octahedral_stress", {1: said}, octahedral)
    loose = said.assign(solid_fraction=said["solid_fraction"] - 0.1)
    nothing("must be above 0.6", {1: loose}, walls=True)
    path, grains, _ = run()
    idle = measured_states(path.assign(carries_load=False), grains, RULES, SAMPLE.law)
    nothing("no state that all seeds have carries load", {1: said, 2: idle})
    nothing("no state that all seeds have", {1: said, 2: said.assign(state=said["state"] + 9)})


def test_only_states_that_yield_are_judged(said):
    whole = said.assign(broken_mass_fraction=0.01)
    summary = prediction({1: whole}).summary
    assert (summary["states_that_yield"], summary["grains_ratio_states"]) == (0, 0)
    assert "is not judged: nowhere 5% of the mass is broken" in summary["sentences"][0]


def test_errors_are_root_mean_squares_and_means_of_what_is_known():
    rows = [(3, 0.3), (4, 0.5), (5, np.nan)]
    table = pd.DataFrame(
        [(state, name, 0.2, error) for state, error in rows for name in QUANTITIES],
        columns=["state", "quantity", "measured", "error"],
    )
    errors = prediction_errors(table).set_index("quantity").loc["grains_ratio"]
    assert (errors["states"], errors["states_asked"]) == (2, 3)
    assert errors["rms_ln"] == pytest.approx(np.sqrt((0.09 + 0.25) / 2.0))
    assert errors["bias_ln"] == pytest.approx(0.4)
