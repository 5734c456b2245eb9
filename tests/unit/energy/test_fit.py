"""The energy split of a sample, to its file and back."""

import json
import math
from dataclasses import replace

import pytest

from branchcrush.energy.fit import EndState, EnergySplitFit
from branchcrush.energy.local_exponents import LocalExponent
from branchcrush.energy.state_fit import Curvature, FittedPredictor, StateFit
from branchcrush.files.tables import read_json, write_json
from branchcrush.statistics.intervals import Interval

NAN = float("nan")
LENGTH = FittedPredictor(
    "branch_length",
    "A l^n",
    {"exponent": Interval(3.0, 2.9, 3.1)},
    explained=Interval(0.15, 0.14, 0.16),
    difference=Interval(0.0, 0.0, 0.0),
    exponent=3.0,
)
SURFACE = FittedPredictor.without("surface", "exp of a quadratic", "two lengths")
BEND = Curvature(
    Interval(0.4, 0.2, 0.6), Interval(2.9, 2.8, 3.0), Interval(3.2, 3.1, 3.3), Interval(3.5, 3, 4)
)
PART = LocalExponent(0.9, 1.2, 123, Interval(2.8, 2.5, 3.1), Interval(3.1, 2.9, 3.3))
END = EndState(16, 43235, 0.74, 0.6, 4.5e7, 4.1e6, 0.027, 5.4, 7.8, 0.25)
FIT = EnergySplitFit(
    exponent=Interval(3.12, 3.03, 3.21),
    confidence=0.95,
    amplitude=1e6,
    reference_length=9.6e-4,
    exponent_of_each_seed=(3.1, 3.2),
    mean_of_seed_exponents=3.15,
    packings=END,
    cubic_slope=1.06,
    cubic_r_squared=0.994,
    end=StateFit((LENGTH, SURFACE), BEND, local_exponents=(PART,)),
    near_jamming=StateFit((SURFACE,), Curvature.without("two lengths"), 6, 0.605),
    estimators={"least_squares": Interval(2.95, 2.8, 3.1)},
)
# Written by hand: what programs that read the file rely on, in this order.
WRITTEN = """{
  "exponent": 3.12, "exponent_low": 3.03, "exponent_high": 3.21, "confidence": 0.95,
  "amplitude_J_per_m_n": 1000000.0, "reference_length_m": 0.00096,
  "exponent_of_each_seed": [3.1, 3.2], "mean_of_seed_exponents": 3.15,
  "seeds": 16, "branches": 43235, "solid_fraction": 0.74, "jamming_solid_fraction": 0.6,
  "mean_stress_Pa": 45000000.0, "elastic_energy_J_per_m3": 4100000.0,
  "median_overlap_over_length": 0.027, "coordination_number": 5.4,
  "mechanical_coordination_number": 7.8, "rattler_fraction": 0.25,
  "cubic_slope": 1.06, "cubic_r_squared": 0.994,
  "estimators": {"least_squares": {"estimate": 2.95, "low": 2.8, "high": 3.1}},
  "predictors": [
    {"name": "branch_length", "formula": "A l^n",
     "parameters": {"exponent": {"estimate": 3.0, "low": 2.9, "high": 3.1}},
     "explained_deviance": 0.15, "explained_deviance_low": 0.14, "explained_deviance_high": 0.16,
     "difference_to_branch_length": 0.0, "difference_to_branch_length_low": 0.0,
     "difference_to_branch_length_high": 0.0, "exponent": 3.0},
    {"name": "surface", "formula": "exp of a quadratic", "reason": "two lengths"}],
  "curvature": {
    "curvature": 0.4, "curvature_low": 0.2, "curvature_high": 0.6,
    "slope_at_10_percent": 2.9, "slope_at_10_percent_low": 2.8, "slope_at_10_percent_high": 3.0,
    "slope_at_mean": 3.2, "slope_at_mean_low": 3.1, "slope_at_mean_high": 3.3,
    "slope_at_90_percent": 3.5, "slope_at_90_percent_low": 3, "slope_at_90_percent_high": 4},
  "local_exponents": [
    {"length_low_over_R_max": 0.9, "length_high_over_R_max": 1.2, "branches": 123,
     "exponent": 2.8, "exponent_low": 2.5, "exponent_high": 3.1, "exponent_at_equal_ratio": 3.1,
     "exponent_at_equal_ratio_low": 2.9, "exponent_at_equal_ratio_high": 3.3}],
  "near_jamming": {
    "state": 6, "solid_fraction": 0.605,
    "predictors": [{"name": "surface", "formula": "exp of a quadratic", "reason": "two lengths"}],
    "curvature": {"reason": "two lengths"}}
}"""


def test_result_holds_the_keys_of_the_file_in_their_order():
    assert json.dumps(FIT.result()) == json.dumps(json.loads(WRITTEN))


def test_what_is_read_is_what_was_written():
    assert EnergySplitFit.read(json.loads(WRITTEN)).result() == FIT.result()
    # A fit with a reason holds nan, which differs from itself.
    assert repr(EnergySplitFit.read(json.loads(WRITTEN))) == repr(FIT)


def test_provenance_of_a_file_is_no_part_of_the_fit(tmp_path):
    write_json(tmp_path / "energy_split.json", FIT.result(), {"branchcrush": "1"})
    assert repr(EnergySplitFit.read(read_json(tmp_path / "energy_split.json"))) == repr(FIT)


def test_missing_numbers_are_null_in_the_file_and_nan_when_read(tmp_path):
    one_seed = FittedPredictor(
        "branch_length",
        "A l^n",
        {"exponent": Interval(3.0, NAN, NAN)},
        explained=Interval(NAN, NAN, NAN),
        difference=None,
        exponent=3.0,
        left_out_reason="one seed",
    )
    write_json(tmp_path / "predictor.json", one_seed.result(), {})
    held = read_json(tmp_path / "predictor.json")
    assert held["parameters"]["exponent"] == {"estimate": 3.0, "low": None, "high": None}
    assert "difference_to_branch_length" not in held
    assert "reason" not in held
    read = FittedPredictor.read(held)
    assert repr(read) == repr(one_seed)
    assert math.isnan(read.explained.estimate)


def test_fit_whose_first_loaded_state_is_its_end_has_none_near_jamming():
    alone = replace(FIT, near_jamming=None)
    held = json.loads(WRITTEN)
    del held["near_jamming"]
    assert json.dumps(alone.result()) == json.dumps(held)
    assert EnergySplitFit.read(held).near_jamming is None


@pytest.mark.parametrize("packings", [None, END])
def test_sample_without_data_says_why_and_what_is_known_of_its_packings(packings):
    fit = EnergySplitFit.without("all branches of one length", packings)
    expected = {} if packings is None else END.result()
    assert fit.result() == {**expected, "reason": "all branches of one length"}
    read = EnergySplitFit.read(json.loads(json.dumps(fit.result())))
    assert (read.reason, read.packings) == ("all branches of one length", packings)
    assert math.isnan(read.exponent.estimate)
    assert read.end.predictors == read.near_jamming.predictors == ()
    assert read.end.curvature.reason == "all branches of one length"
