"""Crushing predicted beside measured: of a crushing whose every number is known."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.samples.crushed_sizes import exponent_of_larger, number_exponent
from branchcrush.samples.crushing_predicted import QUANTITIES, beside_predicted, measured_states
from tests.unit.samples.crushed_runs import BROKEN, GRAINS, SAMPLE, STRAIN, run

RULES = Breakage(
    strength=Strength(
        strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3, size_exponent=1.0
    ),
    smallest_diameter=SAMPLE.limit,
)


@pytest.fixture
def states():
    path, grains, _ = run()
    path["coordination_number"] = 5.0
    return measured_states(path, grains, RULES, SAMPLE.law)


def test_states_that_carry_load_are_measured(states):
    assert states["state"].tolist() == [2, 3, 4, 5]
    assert states["grains_ratio"].tolist() == [(GRAINS + 7 * n) / GRAINS for n in BROKEN[2:]]
    # E = p V eps / 2 with linear contacts, so that 2E / (pV) is the strain.
    assert np.allclose(states["elastic_strain"], STRAIN, rtol=1e-12)
    assert states["broken_mass_fraction"].tolist() == [n / GRAINS for n in BROKEN[2:]]
    assert states["einav_breakage"].iloc[0] == pytest.approx(0.0, abs=1e-6)
    assert (np.diff(states["einav_breakage"]) > 0.0).all()


def test_what_is_lost_counts_from_the_last_state_without_load(states):
    path, *_ = run()
    lost = path["dissipated_breakage_J"] + path["dissipated_rearrangement_J"]
    expected = (lost[2:] - lost[1]) / path["volume_m3"][1]
    assert np.allclose(states["dissipated_J_per_m3"], expected, rtol=1e-12)


def test_a_crushing_without_load_has_no_states():
    path, grains, _ = run()
    path["carries_load"] = False
    table = measured_states(path, grains, RULES, SAMPLE.law)
    assert not len(table) and set(QUANTITIES) <= set(table)


def test_only_states_of_all_seeds_are_compared(states):
    predicted = states.assign(mean_stress_Pa=2.0 * states["mean_stress_Pa"])
    table = beside_predicted(predicted, {1: states, 2: states[states["state"] < 4]})
    assert set(table["state"]) == {2, 3}
    stress = table[table["quantity"] == "mean_stress_Pa"]
    assert np.allclose(stress["error"], np.log(2.0), rtol=1e-12)
    # Nothing is extrapolated.
    below = beside_predicted(predicted[predicted["state"] > 3], {1: states})
    assert below.loc[below["state"] < 4, "predicted"].isna().all()
    assert below.loc[below["state"] < 4, "error"].isna().all()


def test_numbers_and_shares_of_larger_grains_tell_one_exponent():
    sizes = np.arange(1.0, 20001.0) ** -0.5
    counted = number_exponent(sizes, 0.01, 0.1)
    shares = pd.Series(sizes)
    told = exponent_of_larger(lambda d: np.array([(shares > x).mean() for x in d]), 0.01, 0.1)
    assert told == pytest.approx(counted, rel=1e-9)
    assert np.isnan(exponent_of_larger(lambda d: d**-2.0, 0.06, 0.1))
