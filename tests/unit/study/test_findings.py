"""All samples beside each other: which side of each question they are on, and the page of it."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.study.exponents import at_distance, common_distance, crossing
from branchcrush.study.findings import finding_row, verdicts
from branchcrush.study.kinds import SampleKind

INTERVALS = {"confidence": 0.95, "resamples": 100}
DISTANCES = np.array([0.0, 0.05, 0.1, 0.15])


def path_of(exponents, half=0.1, distances=DISTANCES):
    exponents = np.asarray(exponents, dtype=float)
    return pd.DataFrame(
        {
            "solid_fraction_above_jamming": distances,
            "exponent": exponents,
            "exponent_low": exponents - half,
            "exponent_high": exponents + half,
        }
    )


# --- along the path ------------------------------------------------------------------------------


def test_exponent_between_states_is_on_the_line_between_them():
    value, low, high = at_distance(path_of([2.0, 2.5, 3.0, 3.5]), 0.075)
    assert (value, low, high) == pytest.approx((2.75, 2.65, 2.85))


@pytest.mark.parametrize("distance", [-0.01, 0.16])
def test_beyond_the_states_there_is_no_exponent(distance):
    assert np.isnan(at_distance(path_of([2.0, 2.5, 3.0, 3.5]), distance)).all()


def test_states_without_an_exponent_are_left_out():
    assert at_distance(path_of([np.nan, 2.5, np.nan, 3.5]), 0.1)[0] == pytest.approx(3.0)
    assert np.isnan(at_distance(path_of([np.nan] * 4), 0.1)).all()


@pytest.mark.parametrize(
    ("exponents", "distance"),
    [
        ([2.0, 2.5, 3.5, 4.0], 0.075),
        # Above, below again, and above for good.
        ([3.2, 2.8, 3.2, 3.4], 0.075),
        ([3.1, 3.2, 3.3, 3.4], np.nan),
        ([2.0, 2.2, 3.2, 2.4], np.nan),
    ],
)
def test_crossing_is_where_the_exponent_is_above_three_for_good(exponents, distance):
    assert crossing(path_of(exponents)) == pytest.approx(distance, nan_ok=True)


def test_common_distance_is_the_shortest_rounded_down():
    ends = [path_of([2.0, 3.0], distances=[0.0, end]) for end in (0.131, 0.2, 0.149)]
    assert common_distance(ends) == 0.13
    assert np.isnan(common_distance([]))
    unknown = path_of([2.0, 3.0], distances=[np.nan, np.nan])
    assert np.isnan(common_distance([unknown]))
    # A sample whose jamming point is unknown does not blank the others.
    assert common_distance([unknown, *ends]) == 0.13


# --- rows ----------------------------------------------------------------------------------------


def states_of(prefactor=8.0):
    above = np.array([0.02, 0.04])
    part = pd.DataFrame(
        {
            "state": [3, 4],
            "solid_fraction_above_jamming": above,
            "isostatic_number": 5.5,
            "mechanical_coordination_number": 5.5 + prefactor * np.sqrt(above),
        }
    )
    return pd.concat([part.assign(seed_number=number) for number in range(2)])


def predictor(name, explained, difference=(0.0, 0.0, 0.0)):
    keys = ("difference_to_branch_length" + part for part in ("", "_low", "_high"))
    return {
        "name": name,
        "parameters": {"exponent": {"estimate": 3.0, "low": 2.9, "high": 3.1}},
        "explained_deviance": explained,
        **dict(zip(keys, difference, strict=True)),
    }


def split(curvature=(0.5, 0.2, 0.8)):
    return {
        "curvature": dict(
            zip(("curvature", "curvature_low", "curvature_high"), curvature, strict=True)
        ),
        "predictors": [
            predictor("branch_length", 0.16),
            predictor("reduced_radius", 0.19, (0.03, 0.02, 0.04)),
            predictor("grain_size", 0.12, (-0.04, -0.05, -0.03)),
            predictor("surface", 0.20, (0.04, 0.03, 0.05)),
        ],
    }


def results(exponent=(3.0, 2.9, 3.1), parking=0.03, claim="no such grain", branches=None):
    low = {"exponent": exponent[0], "exponent_low": exponent[1], "exponent_high": exponent[2]}
    fit = {**low, "seeds": 3, "solid_fraction": 0.75, **split(), "near_jamming": split()}
    lengths = [{"name": "parking", "kolmogorov_smirnov": parking}]
    state = {
        "solid_fraction_above_jamming": 0.01,
        "mean_length_m": 1e-3,
        "coordination_number": 5.0,
        "rattler_fraction": 0.1,
        "predictions": lengths,
    }
    grains = {"largest_neighbour_ratio": 2.0, "neighbour_ratio_from": 1.6, "grains": 20}
    for reading in ("contact", "grain", "volume"):
        grains |= {f"energy_per_{reading}{part}": 0.9 for part in ("", "_low", "_high")}
        grains[f"claim_per_{reading}"] = claim
    tail = {
        f"{name}{part}": 1.0
        for name in ("decay_rate", "squared_variation")
        for part in ("", "_low", "_high")
    }
    fabric = {"deviator_over_expected": 0.5, "by_chance_low": 0.8, "by_chance_high": 1.2}
    stress = {
        f"{name}{part}": 0.5
        for name in ("coarse_half_stress_share", "sharing_index")
        for part in ("", "_low", "_high")
    }
    end = {
        "shielding": {"grains": grains, "branches": branches or {}, "grain_energy": {}},
        "forces": {"tails": [{"threshold": t, **tail} for t in (1.0, 2.0)], "by_length": low},
        "fabric": {"branches": fabric, "forces": fabric},
        "stress": stress,
    }
    return fit, {"near_jamming": state, "end": state}, {"near_jamming": end, "end": end}


def row_of(name="one", exponents=(2.5, 2.8, 3.0, 3.2), **options):
    kind = SampleKind("walls", "hertz", {"form": "single"})
    return finding_row(
        name, kind, *results(**options), path_of(exponents), states_of(), 0.1, INTERVALS
    )


def test_row_says_what_the_results_say():
    row = row_of()
    assert (row["sample"], row["boundary"], row["contact_law"]) == ("one", "walls", "hertz")
    assert row["reason"] is None
    assert row["exponent_at_distance"] == pytest.approx(3.0)
    assert row["exponent_at_end"] == 3.0
    assert row["distance_at_end"] == 0.15
    assert row["distance_of_exponent_3"] == pytest.approx(0.1)
    assert row["ks_parking_near"] == 0.03
    # kappa* was made with this prefactor.
    assert row["jamming_law_prefactor"] == pytest.approx(8.0)
    assert row["jamming_law_exponent"] == pytest.approx(0.5)
    # The surface is the ceiling of the others and no rival.
    assert row["best_predictor_end"] == "reduced_radius"


@pytest.mark.parametrize(
    ("part", "column"),
    [(0, "exponent_at_end"), (1, "coordination_number_near"), (2, "sharing_index")],
)
def test_row_of_a_sample_without_some_data_says_why_and_has_the_rest(part, column):
    parts = list(results())
    parts[part] = {"reason": "no load"}
    kind = SampleKind("periodic", "linear", {"form": "single"})
    row = finding_row("part", kind, *parts, path_of([2.0] * 4), states_of(), 0.1, INTERVALS)
    assert row["reason"] == "no load"
    kept = {"exponent_at_end", "coordination_number_near", "sharing_index"} - {column}
    assert kept <= set(row) and column not in row
    assert verdicts([row])["known"] == ([] if part == 0 else ["part"])


def test_row_of_a_sample_without_any_data_says_only_why():
    kind = SampleKind("periodic", "linear", {"form": "single"})
    nothing = [{"reason": "no load"}] * 3
    row = finding_row("loose", kind, *nothing, None, None, 0.1, INTERVALS)
    assert set(row) == {"sample", "boundary", "contact_law", "reason"}
    found = verdicts([row])
    assert not any(found.values())


# --- verdicts ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("interval", "side"),
    [((3.0, 2.9, 3.1), "holds"), ((2.5, 2.4, 2.6), "below"), ((3.5, 3.4, 3.6), "above")],
)
def test_three_holds_where_the_interval_holds_it(interval, side):
    found = verdicts([row_of(exponent=interval)])
    for other in ("holds", "below", "above"):
        assert found[f"three_at_end_{other}"] == (["one"] if other == side else [])


def test_claims_of_branches_are_told_beside_those_of_grains():
    found = verdicts([row_of("few"), row_of("most", branches={"claim": "supported"})])
    assert found["claim_branch_supported"] == ["most"]
    assert found["claim_branch_no_such"] == []


def test_one_seed_has_no_interval_and_is_on_no_side():
    found = verdicts([row_of(exponent=(3.0, None, None))])
    assert not any(found[f"three_at_end_{side}"] for side in ("holds", "below", "above"))


def test_each_sample_is_on_its_side_of_each_question():
    rows = [row_of("good"), row_of("bad", parking=0.07, claim="contradicted")]
    found = verdicts(rows)
    assert found["known"] == ["good", "bad"]
    assert (found["lengths_good"], found["lengths_bad"]) == (["good"], ["bad"])
    assert found["power_law_fails"] == ["good", "bad"]
    assert found["reduced_radius_better"] == ["good", "bad"]
    assert found["grain_size_worse"] == ["good", "bad"]
    assert found["claim_volume_contradicted"] == ["bad"]
    assert found["claim_volume_no_such"] == ["good"]
    assert found["best_reduced_radius"] == ["good", "bad"]
    assert found["best_branch_length"] == []
