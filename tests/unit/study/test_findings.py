"""The rows of all samples: each number of the results in its own column, of its own state."""

from dataclasses import replace

import pytest

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.state_fit import Curvature, StateFit
from branchcrush.study.findings import finding_row, finding_rows

INTERVALS = {"confidence": 0.95, "resamples": 100}


def row_of(results, distance=0.1):
    return finding_row(results, distance, INTERVALS)


def test_row_is_of_its_sample_and_of_its_exponents(sample):
    row = row_of(sample())
    assert (row["sample"], row["boundary"], row["contact_law"]) == ("one", "walls", "hertz")
    assert (row["verdict"], row["verdict_reasons"], row["reason"]) == ("certified", None, None)
    assert (row["seeds"], row["solid_fraction"]) == (3, 0.7407)
    assert [row[f"exponent_at_end{limit}"] for limit in ("", "_low", "_high")] == [3.0, 2.9, 3.1]
    assert (row["distance"], row["distance_at_end"]) == (0.1, 0.15)
    for limit, n in (("", 3.0), ("_low", 2.9), ("_high", 3.1)):
        assert row[f"exponent_at_distance{limit}"] == pytest.approx(n)
    assert row["distance_of_exponent_3"] == pytest.approx(0.1)


@pytest.mark.parametrize(("where", "shift"), [("end", 0.0), ("near", 0.05)])
def test_fits_of_each_state_are_in_the_columns_of_that_state(sample, where, shift):
    row = row_of(sample())
    expected = {
        "curvature": 0.5,
        "curvature_low": 0.4,
        "curvature_high": 0.7,
        "explained_branch_length": 0.16,
        "explained_reduced_radius": 0.19,
        "explained_both_radii": 0.185,
        "explained_grain_size": 0.12,
        "explained_length_and_ratio": 0.188,
        "length_exponent": 2.6,
        "length_exponent_low": 2.5,
        "ratio_exponent": 3.2,
        "ratio_exponent_high": 3.4,
        "explained_surface": 0.20,
        "reduced_radius_over_length": 0.03,
        "reduced_radius_over_length_low": 0.02,
        "reduced_radius_over_length_high": 0.05,
        "grain_size_over_length": -0.04,
        "exponent_of_branch_length": 3.1,
        "exponent_of_reduced_radius": 2.8,
        "exponent_of_reduced_radius_low": 2.7,
    }
    for name, value in expected.items():
        assert row[f"{name}_{where}"] == pytest.approx(value - shift), name


def test_the_surface_is_the_ceiling_and_no_rival(sample):
    row = row_of(sample())
    assert row["explained_surface_end"] > row["explained_reduced_radius_end"]
    assert row["best_predictor_end"] == row["best_predictor_near"] == "reduced_radius"


@pytest.mark.parametrize("kept", [(0,), (0, 0)])
def test_one_predictor_or_two_that_say_the_same_have_no_best(sample, kept):
    whole = sample()
    length = whole.fit.end.predictors[0]
    rivals = tuple(replace(length, name=name) for name, _ in zip(("a", "b"), kept, strict=False))
    end = StateFit(rivals, Curvature.without("one length"))
    row = row_of(replace(whole, fit=replace(whole.fit, end=end)))
    assert row["best_predictor_end"] is None
    assert row["curvature_end"] != row["curvature_end"]


def test_lengths_and_contacts_are_of_the_state_their_column_says(sample):
    row = row_of(sample())
    expected = {
        "distance_near": 0.10,
        "mean_length_near_m": 1.5e-3 + 0.05,
        "ks_parking_near": 0.03,
        "ks_random_contact_near": 0.35,
        "ks_configuration_near": 0.06,
        "ks_surface_near": 0.25,
        "ks_rods_near": 0.12,
        "ks_rods_end": 0.07,
        "ks_parking_end": 0.33,
        "ks_random_contact_end": 0.4,
        "ks_configuration_end": 0.01,
        "assortativity_of_radii": -0.1,
        "assortativity_of_radii_low": -0.2,
        "assortativity_of_radii_high": 0.1,
        "coordination_number_near": 6.45,
        "rattler_fraction_near": 0.15,
        "coordination_number_end": 6.5,
        "rods_coordination_number_near": 6.15,
        "rods_coordination_number_end": 6.2,
        "rods_rattler_fraction_near": 0.17,
        "parking_coordination_number": 5.4,
        "parking_rattler_fraction": 0.2,
    }
    for name, value in expected.items():
        assert row[name] == pytest.approx(value), name
    assert "ks_surface_end" not in row
    assert row["parking_solution"] == "only"
    assert "parking_other_coordination_number" not in row


def test_a_second_solution_of_random_parking_is_told(sample):
    row = row_of(sample(solutions=2))
    assert row["parking_solution"] == "coarse"
    assert row["parking_other_coordination_number"] == 5.8
    assert row["parking_other_rattler_fraction"] == 0.04


def test_jamming_law_is_about_the_isostatic_number_of_each_state(sample):
    row = row_of(sample())
    # kappa* was made with these, above 5.5.
    assert row["jamming_law_prefactor"] == pytest.approx(8.0)
    assert row["jamming_law_exponent"] == pytest.approx(0.5)
    assert row["jamming_law_prefactor_low"] == pytest.approx(8.0)


def test_what_is_shared_is_that_of_the_end(sample):
    row = row_of(sample(claim="undecided", branch_claim="supported"))
    expected = {
        "shielding_exponent": 0.9,
        "shielding_exponent_high": 1.1,
        "shielding_unequal_over_equal": 0.14,
        "shielding_radius_ratio_to": 0.2,
        "shielding_unequal_branches": 137,
        "shielding_claim_per_branch": "supported",
        "shielding_largest_neighbour_ratio": 2.0,
        "shielding_neighbour_ratio_from": 1.6,
        "shielding_grains": 20,
        "shielding_energy_per_contact": 0.7,
        "shielding_energy_per_grain": 1.7,
        "shielding_energy_per_volume": 2.7,
        "shielding_energy_per_volume_low": 2.6,
        "shielding_claim_per_contact": "undecided",
        "shielding_claim_per_volume": "undecided",
        "grain_energy_exponent_load_bearing": 2.6,
        "force_exponent": 1.7,
        # Of the tail above twice the mean force.
        "force_tail_decay_rate": 2.0,
        "force_tail_squared_variation": 0.5,
        "fabric_branches_deviator_over_expected": 0.4,
        "fabric_branches_by_chance_low": 1.4,
        "fabric_branches_by_chance_high": 2.4,
        "fabric_forces_deviator_over_expected": 0.6,
        "coarse_half_stress_share": 0.48,
        "sharing_index": -0.02,
        "sharing_index_low": -0.12,
    }
    for name, value in expected.items():
        wanted = value if isinstance(value, str) else pytest.approx(value)
        assert row[name] == wanted, name


def test_one_state_has_nothing_near_jamming_and_no_path(one_state):
    row = row_of(one_state())
    assert not [name for name in row if name.endswith("_near") or "_near_" in name]
    assert row["exponent_at_end"] == 3.0
    assert row["exponent_at_distance"] != row["exponent_at_distance"]
    assert row["distance_of_exponent_3"] != row["distance_of_exponent_3"]
    assert row["coordination_number_end"] == 6.5
    assert row["ks_parking_end"] == pytest.approx(0.33)


@pytest.mark.parametrize(
    ("part", "column"),
    [
        ("fit", "exponent_at_end"),
        ("numbers", "coordination_number_near"),
        ("shared", "sharing_index"),
    ],
)
def test_row_of_a_sample_without_some_data_says_why_and_has_the_rest(sample, part, column):
    nothing = {"reason": "no load"}
    missing = EnergySplitFit.read(nothing) if part == "fit" else nothing
    row = row_of(replace(sample(), **{part: missing}))
    assert row["reason"] == "no load"
    kept = {"exponent_at_end", "coordination_number_near", "sharing_index"} - {column}
    assert kept <= set(row) and column not in row


def test_row_of_a_sample_without_any_data_says_only_why(sample):
    nothing = {"reason": "no load"}
    parts = {"fit": EnergySplitFit.read(nothing), "numbers": nothing, "shared": nothing}
    row = row_of(replace(sample("loose", verdict="not certified"), **parts))
    assert row == {
        "sample": "loose",
        "boundary": "walls",
        "contact_law": "hertz",
        "verdict": "not certified",
        "verdict_reasons": "seed 2: stopped",
        "reason": "no load",
    }


def test_all_rows_are_at_the_distance_that_all_paths_reach(sample, one_state):
    short = sample("short")
    short = replace(short, path=short.path[:3])  # to 0.10
    loose = replace(sample("loose"), fit=EnergySplitFit.read({"reason": "no load"}))
    rows = finding_rows([sample("long"), short, one_state(), loose], **INTERVALS)
    assert [row["sample"] for row in rows] == ["long", "short", "alone", "loose"]
    assert [row.get("distance") for row in rows] == [0.1, 0.1, 0.1, None]
    assert rows[0]["exponent_at_distance"] == pytest.approx(3.0)


def test_the_distance_is_that_of_the_certified_samples(sample):
    short = sample("short", verdict="not certified")
    short = replace(short, path=short.path[:3])  # to 0.10
    rows = finding_rows([sample("long"), short], **INTERVALS)
    assert [row["distance"] for row in rows] == [0.15, 0.15]
    assert rows[0]["exponent_at_distance"] == pytest.approx(3.2)
    assert rows[1]["exponent_at_distance"] != rows[1]["exponent_at_distance"]
    # Of no certified ones it is that of all.
    alone = finding_rows([short], **INTERVALS)
    assert alone[0]["distance"] == 0.1
