"""Two runs of the same seeds, invented, whose differences and noise are known beforehand."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.samples.convergence import (
    compared_packings,
    convergence_table,
    convergence_words,
    decision,
)

NAMES = (
    "solid_fraction",
    "mean_stress_Pa",
    "elastic_energy_J",
    "work_J",
    "coordination_number",
    "mechanical_coordination_number",
    "force_evaluations",
)


def packings(seeds=(1, 2), **columns):
    """Return packings that have 1 in all that is compared but what is given."""
    table = {name: 1.0 for name in (*NAMES, "jamming_solid_fraction")}
    return pd.DataFrame({**table, **columns}, index=list(seeds))


def compared(once, twice, exponents=(3.0, 3.0), exponents_at_twice=(3.0, 3.0)):
    return convergence_table(once, twice, exponents, exponents_at_twice).set_index("quantity")


# --- what is compared ----------------------------------------------------------------------------


def path_of(end):
    """Return a path that loads to an end and goes back."""
    table = {name: [0.0, 0.5, end, 0.25] for name in NAMES}
    legs = ["loading"] * 3 + ["unloading"]
    loaded = [False, True, True, True]
    return pd.DataFrame({"state": [0, 1, 2, 3], "leg": legs, "carries_load": loaded, **table})


def certificate_of(**certified_ends):
    """Return a `certificate.csv` of seeds, named s5, that are certified at their end or not."""
    rows = [
        {"seed": int(seed[1:]), "state": state, "leg": "loading", "certified": (False, True, end)}
        for seed, end in certified_ends.items()
        for state in range(3)
    ]
    return pd.DataFrame([{**row, "certified": row["certified"][row["state"]]} for row in rows])


JAMMING = pd.DataFrame({"seed": [5, 7], "jamming_solid_fraction_loading": [0.61, np.nan]})


def test_packings_are_those_certified_at_the_end_of_their_loading_by_their_seed():
    certificate = certificate_of(s5=True, s9=False, s7=True)
    table = compared_packings(certificate, [path_of(end) for end in (2.0, 3.0, 4.0)], JAMMING)
    assert table.index.tolist() == [5, 7]
    assert table["mean_stress_Pa"].tolist() == [2.0, 4.0]
    assert_allclose(table["jamming_solid_fraction"], [0.61, np.nan])


def test_without_a_certified_packing_there_is_none_to_compare():
    table = compared_packings(certificate_of(s5=False), [path_of(2.0)], JAMMING)
    assert len(table) == 0
    assert "jamming_solid_fraction" in table


# --- pairs ---------------------------------------------------------------------------------------


def test_differences_of_pairs_are_those_put_in():
    once = packings(mean_stress_Pa=[1.0, 2.0])
    twice = packings(mean_stress_Pa=[1.3, 2.1])
    table = compared(once, twice)
    stress = table.loc["mean_stress_Pa"]
    assert_allclose([stress["value"], stress["value_at_twice_the_steps"]], [1.5, 1.7])
    assert_allclose(stress["difference"], 0.2)
    # Pairs of 0.3 and 0.1: a standard deviation of 0.2/sqrt(2), over sqrt(2).
    assert_allclose(stress["standard_error_of_difference"], 0.1)
    # Student's t of one degree of freedom, 95 % between both sides: tan(0.475 pi).
    assert_allclose(stress["could_see"], 0.1 * np.tan(0.475 * np.pi))
    assert_allclose(stress["tolerance"], 0.05 * 1.5)
    assert (stress["compared_by"], stress["seeds"]) == ("pairs", 2)
    same = table.drop(["exponent", "mean_stress_Pa"])
    assert (same["difference"] == 0).all()
    assert "force_evaluations" in same.index


def test_scatter_of_packings_that_both_runs_share_is_no_error():
    once = packings(mean_stress_Pa=[1.0, 5.0])
    stress = compared(once, once.assign(mean_stress_Pa=[1.5, 5.5])).loc["mean_stress_Pa"]
    assert_allclose(stress[["standard_error_of_difference", "could_see"]].astype(float), 0.0)


def test_only_seeds_in_both_runs_are_paired_whatever_their_order():
    once = packings((1, 2, 4), mean_stress_Pa=[1.0, 2.0, 4.0])
    twice = packings((4, 3, 2), mean_stress_Pa=[4.5, 9.0, 2.7])
    stress = compared(once, twice).loc["mean_stress_Pa"]
    assert (stress["seeds"], stress["value"], stress["value_at_twice_the_steps"]) == (2, 3.0, 3.6)


def test_packings_without_a_jamming_point_are_left_out_of_its_row_only():
    once = packings((1, 2, 3), jamming_solid_fraction=[0.6, np.nan, 0.62])
    twice = packings((1, 2, 3), jamming_solid_fraction=[0.601, 0.6, 0.623])
    table = compared(once, twice)
    assert table.loc["jamming_solid_fraction", "seeds"] == 2
    assert_allclose(table.loc["jamming_solid_fraction", "difference"], 0.002)
    assert table.loc["mean_stress_Pa", "seeds"] == 3


def test_without_a_seed_in_both_runs_the_table_is_empty_and_keeps_its_columns():
    table = convergence_table(packings((1, 2)), packings((3,)), [3.0, 3.0], [3.0])
    assert len(table) == 0
    assert {"quantity", "seeds", "value", "difference", "verdict"} <= set(table)
    assert convergence_words(table) == []


def test_one_pair_has_no_interval_and_decides_nothing():
    table = compared(packings((1,)), packings((1,)), [3.0], [3.5])
    assert np.isnan(table.loc["mean_stress_Pa", "could_see"])
    assert table.loc["mean_stress_Pa", "verdict"] == "not decided"
    assert table.loc["exponent", "verdict"] == "not decided"


def test_what_is_told_only_is_not_judged():
    table = compared(packings(), packings(force_evaluations=[9.0, 10.0], work_J=[7.0, 7.0]))
    for quantity in ("force_evaluations", "work_J", "solid_fraction", "coordination_number"):
        assert table.loc[quantity, "verdict"] == ""


# --- ensembles -----------------------------------------------------------------------------------


def test_exponents_are_compared_as_two_ensembles_of_one_scatter():
    exponents = [2.9, 3.0, 3.1, 3.2]
    row = compared(packings(), packings(), exponents, [3.2, 3.4]).loc["exponent"]
    assert_allclose([row["value"], row["value_at_twice_the_steps"]], [3.05, 3.3])
    # Squares 0.05 and 0.02 over 4 degrees of freedom; 1/4 + 1/2 packings.
    error = np.sqrt(0.07 / 4 * 0.75)
    assert_allclose(row["standard_error_of_difference"], error)
    assert_allclose(row["could_see"], 2.7764451 * error)
    assert (row["seeds"], row["seeds_at_twice_the_steps"]) == (4, 2)
    assert (row["compared_by"], row["tolerance"]) == ("ensembles", 0.1)


def test_packings_without_an_exponent_are_left_out():
    row = compared(packings(), packings(), [3.0, np.nan, 3.2], [3.1, np.nan]).loc["exponent"]
    assert (row["seeds"], row["seeds_at_twice_the_steps"]) == (2, 1)
    assert_allclose(row["standard_error_of_difference"], np.sqrt(0.02 * 1.5))


@pytest.mark.parametrize("exponents", [([], []), ([np.nan] * 2, [np.nan] * 2), ([3.0, 3.1], [])])
def test_grains_of_one_size_are_compared_in_all_but_the_exponent(exponents):
    table = compared(packings(), packings(), *exponents)
    assert np.isnan(table.loc["exponent", "difference"])
    assert table.loc["exponent", "verdict"] == ""
    assert table.loc["mean_stress_Pa", "verdict"] == "converged"


# --- the decision --------------------------------------------------------------------------------


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(
    ("difference", "could_see", "expected"),
    [
        (0.03, 0.06, "converged"),
        (0.03, 0.08, "not decided"),
        (0.15, 0.06, "not decided"),
        (0.15, 0.04, "not converged"),
        (0.0, 0.0, "converged"),
        (0.11, 0.0, "not converged"),
        (0.0, np.nan, "not decided"),
        (9.0, np.nan, "not decided"),
    ],
)
def test_interval_within_the_tolerance_is_converged_and_beyond_it_is_not(
    sign, difference, could_see, expected
):
    assert decision(sign * difference, could_see, 0.1) == expected


# Of each judged pair a value and what may change of it; one table holds a trial of each.
JUDGED = {
    "mean_stress_Pa": (2.0, 0.1),
    "elastic_energy_J": (4.0, 0.2),
    "mechanical_coordination_number": (7.0, 0.1),
    "jamming_solid_fraction": (0.6, 0.01),
}


def drawn_verdicts(change, noise, tables):
    """Return the verdicts on four pairs of a known change and noise, over what is allowed."""
    rng, verdicts = np.random.default_rng(20), []
    for _ in range(tables):
        once, twice = {}, {}
        for name, (value, tolerance) in JUDGED.items():
            # The mean, by which what is allowed goes, is the value.
            once[name] = value * np.array([0.8, 0.9, 1.1, 1.2])
            twice[name] = once[name] + tolerance * rng.normal(change, noise, 4)
        table = compared(packings(range(4), **once), packings(range(4), **twice))
        verdicts += table.loc[list(JUDGED), "verdict"].tolist()
    return verdicts


@pytest.mark.parametrize(
    ("change", "noise", "wrong"),
    [
        # As much as is just allowed, or just not: the worst that there is to decide.
        (0.999, 0.4, "not converged"),
        (-1.001, 0.4, "converged"),
        (1.001, 2.0, "converged"),
        # Nothing changes and the noise is large: either side may be taken for a change.
        (0.0, 8.0, "not converged"),
    ],
)
def test_at_most_five_of_a_hundred_decisions_are_wrong(change, noise, wrong):
    verdicts = drawn_verdicts(change, noise, 75)
    # Three standard errors of the count above 5 %.
    assert verdicts.count(wrong) <= 300 * 0.05 + 3 * np.sqrt(300 * 0.05 * 0.95)


@pytest.mark.parametrize(
    ("change", "noise", "expected"),
    [(0.0, 0.2, "converged"), (2.0, 0.2, "not converged"), (0.0, 2.0, "not decided")],
)
def test_what_can_be_decided_is_decided(change, noise, expected):
    assert drawn_verdicts(change, noise, 10).count(expected) >= 34


def test_at_most_five_of_a_hundred_decisions_on_the_exponent_are_wrong():
    rng, wrong = np.random.default_rng(13), 0
    for _ in range(150):
        once, twice = rng.normal(3.1, 0.16, 16), rng.normal(3.2 - 1e-4, 0.16, 4)
        row = compared(packings(), packings(), once, twice).loc["exponent"]
        wrong += row["verdict"] == "not converged"
    assert wrong <= 150 * 0.05 + 3 * np.sqrt(150 * 0.05 * 0.95)


# --- in words ------------------------------------------------------------------------------------


def test_words_say_what_changes_what_is_allowed_and_what_could_be_seen():
    once = packings(mean_stress_Pa=[1.0, 2.0], jamming_solid_fraction=[0.6, 0.6])
    twice = packings(mean_stress_Pa=[1.3, 2.1], jamming_solid_fraction=[0.603, 0.603])
    table = convergence_table(once, twice, [2.9, 3.0, 3.1, 3.2], [3.2, 3.4])
    words = convergence_words(table)
    assert [text.split(":")[0] for text in words] == [
        "n",
        "mean stress",
        "elastic energy",
        "κ*",
        "φ_J",
    ]
    assert words[0] == (
        "n: not decided, +0.25 ± 0.32 with twice the strain steps (4 packings against 2, "
        "unpaired, 95 % interval): as much as 0.57, 0.10 is allowed, 0.32 could be seen"
    )
    assert words[1] == (
        "mean stress: not decided, +13.3 % ± 84.7 % with twice the strain steps (2 seeds, each "
        "run twice, 95 % interval): as much as 98.0 %, 5.0 % is allowed, 84.7 % could be seen"
    )
    assert words[4].startswith("φ_J: converged, +0.0030 ± 0.0000 with")


def test_words_of_one_pair_say_that_nothing_could_be_seen():
    once, twice = packings((1,)), packings((1,), elastic_energy_J=[1.01])
    words = convergence_words(convergence_table(once, twice, [3.0], [3.0]))
    assert words[2] == (
        "elastic energy: not decided, +1.0 % with twice the strain steps (1 seed, each run twice, "
        "95 % interval): 5.0 % is allowed, nothing could be seen"
    )
