"""What the rows say together: which samples are on which side of each question."""

import pytest

from branchcrush.study.findings import finding_row
from branchcrush.study.verdicts import verdicts

INTERVALS = {"confidence": 0.95, "resamples": 100}
ONE = {"sample": "one", "verdict": "certified"}
SIDES = ("holds", "below", "above", "too_wide", "no_interval")


def row_of(results):
    return finding_row(results, 0.1, INTERVALS)


@pytest.mark.parametrize(
    ("n", "side"),
    [
        ((3.0, 2.9, 3.1), "holds"),
        ((2.5, 2.4, 2.6), "below"),
        ((3.5, 3.4, 3.6), "above"),
        ((3.0, 3.0, 3.5), "holds"),
        ((2.9, 2.7, 3.1), "holds"),
        ((3.1, 2.9, 3.3), "holds"),
        # Wider than n itself, on whatever side.
        ((3.0, 1.4, 4.6), "too_wide"),
        ((1.0, 0.3, 1.7), "too_wide"),
        ((3.0, 1.6, 4.4), "holds"),
        ((3.0, None, None), "no_interval"),
        ((3.0, float("nan"), float("nan")), "no_interval"),
    ],
)
@pytest.mark.parametrize("place", ["at_end", "at_distance"])
def test_each_sample_is_on_one_side_of_three(n, side, place):
    keys = (f"exponent_{place}{limit}" for limit in ("", "_low", "_high"))
    answers = verdicts([{**ONE, **dict(zip(keys, n, strict=True))}])
    assert {s: answers[f"three_{place}_{s}"] for s in SIDES} == {
        s: ["one"] if s == side else [] for s in SIDES
    }
    other = {"at_end": "at_distance", "at_distance": "at_end"}[place]
    assert not any(answers[f"three_{other}_{s}"] for s in SIDES)


def test_lengths_are_judged_near_jamming(sample):
    # At the end both are 0.3 worse, and bad.
    rows = [row_of(sample("good", parking=0.06)), row_of(sample("bad", parking=0.07))]
    answers = verdicts(rows)
    assert (answers["lengths_good"], answers["lengths_bad"]) == (["good"], ["bad"])


def test_lengths_that_are_good_at_the_end_alone_are_bad():
    answers = verdicts([{**ONE, "ks_parking_near": 0.2, "ks_parking_end": 0.01}])
    assert (answers["lengths_good"], answers["lengths_bad"]) == ([], ["one"])


@pytest.mark.parametrize(
    ("low", "high", "fails"), [(0.1, 0.5, True), (-0.5, -0.1, True), (-0.1, 0.5, False)]
)
def test_power_law_fails_by_the_curvature_at_the_end(low, high, fails):
    row = {**ONE, "curvature_low_end": low, "curvature_high_end": high}
    row |= {"curvature_low_near": -low, "curvature_high_near": 2.0 if fails else -3.0}
    assert verdicts([row])["power_law_fails"] == (["one"] if fails else [])


@pytest.mark.parametrize(("low", "better"), [(0.01, True), (-0.01, False)])
def test_reduced_radius_is_better_by_the_lower_limit_of_the_difference(low, better):
    row = {**ONE, "reduced_radius_over_length_end": 0.03}
    row |= {"reduced_radius_over_length_low_end": low, "reduced_radius_over_length_high_end": 0.1}
    assert verdicts([row])["reduced_radius_better"] == (["one"] if better else [])


@pytest.mark.parametrize(("high", "worse"), [(-0.01, True), (0.01, False)])
def test_grain_size_is_worse_by_the_upper_limit_of_the_difference(high, worse):
    row = {**ONE, "grain_size_over_length_end": -0.04}
    row |= {"grain_size_over_length_low_end": -0.1, "grain_size_over_length_high_end": high}
    assert verdicts([row])["grain_size_worse"] == (["one"] if worse else [])


def test_best_predictor_is_that_of_the_end():
    row = {**ONE, "best_predictor_end": "both_radii", "best_predictor_near": "grain_size"}
    answers = verdicts([row])
    assert answers["best_both_radii"] == ["one"]
    assert answers["best_grain_size"] == answers["best_branch_length"] == []


def test_claims_are_told_by_reading(sample):
    rows = [
        row_of(sample("no")),
        row_of(sample("yes", claim="contradicted", branch_claim="supported")),
        row_of(sample("open", claim="undecided", branch_claim="undecided")),
    ]
    answers = verdicts(rows)
    for reading in ("contact", "grain", "volume"):
        assert answers[f"claim_{reading}_contradicted"] == ["yes"]
        assert answers[f"claim_{reading}_undecided"] == ["open"]
        assert answers[f"claim_{reading}_no_such"] == ["no"]
        assert answers[f"claim_{reading}_supported"] == []
    assert answers["claim_branch_supported"] == ["yes"]
    assert answers["claim_branch_no_such"] == ["no"]


def test_samples_of_one_state_are_named(sample, one_state):
    answers = verdicts(
        [row_of(sample("path")), row_of(one_state("alone")), {**ONE, "sample": "loose"}]
    )
    assert answers["one_state"] == ["alone"]
    assert answers["known"] == ["path", "alone"]
    assert answers["lengths_good"] == ["path"] and answers["lengths_bad"] == []


def test_a_sample_without_data_is_on_no_side():
    assert not any(verdicts([{**ONE, "reason": "no load"}]).values())


def test_a_sample_that_is_not_certified_is_named_and_on_no_side(sample, one_state):
    rows = [
        row_of(sample("good")),
        row_of(sample("noted", verdict="certified with notes", n=(2.5, 2.4, 2.6))),
        row_of(sample("bad", verdict="not certified", claim="contradicted")),
        row_of(one_state("alone", verdict="not certified")),
    ]
    answers = verdicts(rows)
    assert answers["not_certified"] == ["bad", "alone"]
    assert answers["known"] == ["good", "noted"]
    assert answers["three_at_end_holds"] == ["good"]
    assert answers["three_at_end_below"] == ["noted"]
    # What it has is no answer.
    assert answers["one_state"] == ["alone"]
    others = set(answers) - {"not_certified", "one_state"}
    assert not [answer for answer in others if {"bad", "alone"} & set(answers[answer])]
