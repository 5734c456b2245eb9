"""Branch lengths of grains that break, of a crushing whose every number is known."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.samples.crushed_lengths import crushed_lengths, length_counts, no_lengths
from tests.unit.samples.crushed_runs import INTERVALS, run
from tests.unit.samples.test_crushed import results

WIDTH = np.log(2.0) / 6.0


@pytest.fixture(scope="module")
def whole():
    return results()


def at(table, state, ratio):
    low, high = (table[f"length_over_diameter_{end}"] for end in ("low", "high"))
    return table[(table["state"] == state) & (low <= ratio) & (ratio < high)].iloc[0]


def test_lengths_are_told_in_mean_diameters_of_the_state(whole):
    # At the end 40 grains of 1 mm and 320 of half of that; half of the branches join the large.
    diameter = (40 * 1.0 + 320 * 0.5) / 360
    table = whole.lengths
    assert table["state"].unique().tolist() == whole.summary["stages"]
    for length in (1.0, 0.5):
        row = at(table, 5, length / diameter)
        assert row["mean_diameter_m"] == pytest.approx(diameter * 1e-3)
        assert row["branches"] == 80  # 40 of each seed
        assert row["density"] == pytest.approx(0.5 / WIDTH)
        assert row["density_low"] == pytest.approx(row["density"])
    ratio = 0.75 / diameter
    assert whole.summary["final_branch_over_diameter"] == pytest.approx(ratio)
    assert whole.summary["final_branch_over_diameter_high"] == pytest.approx(ratio)


def test_every_density_integrates_to_one(whole):
    for _, rows in whole.lengths.groupby("state"):
        for name in ("density", "density_by_rods", "density_random_contact"):
            assert rows[name].sum() * WIDTH == pytest.approx(1.0), name


def test_eq_4_draws_ends_by_number_and_rods_draw_those_that_carry_load(whole):
    diameter = 200 / 360
    two_fragments = at(whole.lengths, 5, 0.5 / diameter)
    assert two_fragments["density_random_contact"] == pytest.approx((8 / 9) ** 2 / WIDTH)
    assert two_fragments["density_by_rods"] < two_fragments["density_random_contact"]
    # By Eq. 4 it is 1; large grains have more contacts.
    assert whole.summary["final_branch_over_diameter_by_rods"] > 1.05


def test_before_grains_break_every_branch_is_one_diameter_long(whole):
    row = at(whole.lengths, 2, 1.0)
    for name in ("density", "density_by_rods", "density_random_contact"):
        assert row[name] == pytest.approx(1.0 / WIDTH), name


def test_stages_without_contacts_are_left_out_and_without_any_nothing_is_told(whole):
    _, grains, branches = run()
    few = {1: length_counts(branches[branches["state"] == 3], grains)}
    given = {1: grains}, whole.states, [2, 3, 5], INTERVALS
    table, told = crushed_lengths(few, *given)
    assert table["state"].unique().tolist() == [3]
    assert table.columns.tolist() == no_lengths().columns.tolist()
    assert told["final_branch_over_diameter_low"] is None or np.isnan(
        told["final_branch_over_diameter_low"]
    )
    none = {1: length_counts(branches.iloc[:0], grains)}
    table, told = crushed_lengths(none, *given)
    assert not len(table) and np.isnan(told["final_branch_over_diameter"])


def test_lengths_beyond_the_bins_count_in_the_last_ones():
    grains = pd.DataFrame({"state": 1, "radius_m": [0.5]})
    branches = pd.DataFrame({"state": 1, "branch_length_m": [1e-3, 1e3]})
    counts = length_counts(branches, grains)["counts"].loc[1]
    assert (counts[0], counts[-1], counts.sum()) == (1, 1, 2)
