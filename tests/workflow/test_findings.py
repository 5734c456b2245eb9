"""What the contact networks of the tiny study give, and the page of all its samples."""

import pytest

from branchcrush.files.tables import read_json, read_table

RIVALS = ["branch_length", "reduced_radius", "both_radii", "grain_size", "length_and_ratio"]
PREDICTORS = [*RIVALS, "surface"]
PREDICTIONS = {
    "configuration",
    "random_contact",
    "mean_neighbour",
    "surface",
    "self_consistent",
    "parking",
    "rods",
}


def test_predictors_are_judged_on_seeds_left_out(sample):
    fit = read_json(sample / "energy_split.json")
    assert [predictor["name"] for predictor in fit["predictors"]] == PREDICTORS
    length = fit["predictors"][0]
    assert length["difference_to_branch_length"] == 0
    assert length["exponent"] == length["parameters"]["exponent"]["estimate"]
    for predictor in fit["predictors"]:
        assert predictor["explained_deviance_low"] <= predictor["explained_deviance"] < 1
    assert fit["curvature"]["curvature_low"] <= fit["curvature"]["curvature_high"]


def test_contacts_of_all_files_add_up(sample):
    numbers, table = (
        read_json(sample / "contact_numbers.json"),
        read_table(sample / "contact_numbers.csv"),
    )
    lengths, pairs = (
        read_table(sample / "length_predictions.csv"),
        read_table(sample / "contact_pairs.csv"),
    )
    assert set(lengths["prediction"]) == PREDICTIONS
    assert lengths["kolmogorov_smirnov"].between(0, 1).all()
    fit = read_json(sample / "energy_split.json")
    end = table[table["state"] == numbers["end"]["state"]]
    ends = (end["grains"] * end["contact_number"]).sum()
    assert ends == pytest.approx(2 * fit["branches"], rel=1e-9)
    assert pairs.loc[pairs["state"] == numbers["end"]["state"], "contacts"].sum() == ends
    assert numbers["end"]["coordination_number"] == pytest.approx(fit["coordination_number"])
    assert numbers["end"]["rattler_fraction"] == pytest.approx(fit["rattler_fraction"])


def test_what_is_shared_adds_up_to_the_whole(sample):
    shared = read_json(sample / "sharing.json")
    assert set(shared) - {"provenance"} == {"near_jamming", "end"}
    grains = read_table(sample / "shielding_grains.csv")
    stress = read_table(sample / "stress_by_radius.csv")
    for where, state in (("end", shared["end"]), ("near_jamming", shared["near_jamming"])):
        rows = stress[stress["where"] == where]
        assert (rows["state"] == state["state"]).all()
        assert rows["grains"].sum() == 2 * 60
        part = grains[(grains["where"] == where) & (grains["grains_counted"] == "all")]
        # All that stores energy touches something, a wall perhaps.
        energy = (part["grains"] * part["energy_per_grain"]).sum() / (2 * 60)
        assert 0.9 < energy <= 1 + 1e-9
    curve = read_table(sample / "stress_sharing.csv")
    assert curve.groupby("where")["stress_share"].max().tolist() == pytest.approx([1, 1])
    assert len(read_table(sample / "fabric.csv")) == 2 * 2


def test_the_findings_are_those_of_the_sample(finished, sample):
    results = finished.folder / "results"
    row = read_table(results / "findings.csv").iloc[0]
    fit = read_json(sample / "energy_split.json")
    assert row["exponent_at_end"] == fit["exponent"]
    certificate = read_json(sample / "certificate.json")
    assert row["verdict"] == certificate["verdict"]
    assert row["best_predictor_end"] in RIVALS
    states = read_table(results / "coordination.csv")
    assert set(states["seed_number"]) == {0, 1}
    # Its own figures show all of one sample.
    assert not (results / "figures/findings").exists()
