"""The verdict of a sample on invented states: each reason to withhold it, and each note."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.gradings.forms import uniform
from branchcrush.samples.certificate import LIMITS, state_certificates
from branchcrush.samples.verdict import Refined, sample_certificate, verdict_results
from branchcrush.statistics.intervals import Interval
from tests.unit.samples.sound_paths import path_of


def converged(**verdicts):
    """Return a `convergence.csv` in which nothing changes, judged as given."""
    rows = []
    for quantity, value in (("exponent", 3.0), ("mean_stress_Pa", 1e6), ("force_evaluations", 1e4)):
        judged = "" if quantity == "force_evaluations" else "converged"
        rows.append(
            {
                "quantity": quantity,
                "seeds": 4,
                "value": value,
                "value_at_twice_the_steps": value,
                "difference": 0.0,
                "standard_error_of_difference": 1e-9,
                "seeds_at_twice_the_steps": 4,
                "compared_by": "ensembles" if quantity == "exponent" else "pairs",
                "could_see": 1e-8,
                "tolerance": 0.05 * value,
                "verdict": verdicts.get(quantity, judged),
            }
        )
    return pd.DataFrame(rows)


NO_CONVERGENCE = converged()[:0]
STANDING = {"edge_over_diameter": 4.0, "grains_needed": 2000}


def findings(certificate):
    """Return what the notes of a certificate found."""
    return [note["finding"] for note in certificate["notes"]]


def fit_of(*exponent):
    """Return an energy split with this exponent and interval; n = 3 +- 0.1 by default."""
    fit = EnergySplitFit.without("no matter")
    return replace(fit, exponent=Interval(*(exponent or (3.0, 2.9, 3.1))), reason=None)


def certificate_of(paths, convergence=None, warnings=(), fit=None, **jamming):
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
        {"representativity": {**STANDING, "warnings": list(warnings)}},
        fit_of() if fit is None else fit,
    )


def test_sound_sample_is_certified_with_its_worst_values():
    found = certificate_of([path_of(), path_of(unbalanced_force_ratio=9e-7)])
    assert (found["verdict"], found["reasons"], found["notes"]) == ("certified", [], [])
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


@pytest.mark.parametrize("quantity", ["exponent", "mean_stress_Pa"])
def test_what_is_not_converged_takes_the_certificate_away(quantity):
    found = certificate_of([path_of()], converged(**{quantity: "not converged"}))
    assert found["verdict"] == "not certified"
    (reason,) = found["reasons"]
    assert reason.startswith(f"{dict(exponent='n').get(quantity, 'mean stress')}: not converged, ")
    assert reason.endswith(": raise loading.quality")


def test_stress_that_is_not_decided_is_a_note():
    found = certificate_of([path_of()], converged(mean_stress_Pa="not decided"))
    assert (found["verdict"], found["reasons"]) == ("certified with notes", [])
    assert findings(found)[0].startswith("convergence not decided: mean stress ")


def test_exponent_that_is_not_decided_is_told_and_no_note():
    found = certificate_of([path_of()], converged(exponent="not decided"))
    assert (found["verdict"], found["notes"]) == ("certified", [])
    assert found["convergence_in_words"][0].startswith("n: not decided, +0.00 ± 0.00")


def test_exponent_that_no_seed_gives_is_not_compared():
    found = certificate_of([path_of()], converged(exponent=""))
    assert found["verdict"] == "certified"
    assert [words.split(":")[0] for words in found["convergence_in_words"]] == ["mean stress"]


def test_sample_without_a_second_run_has_a_note():
    found = certificate_of([path_of()], NO_CONVERGENCE)
    assert found["verdict"] == "certified with notes"
    assert findings(found) == [
        "convergence not checked: no seed was run again with twice the strain steps and certified "
        "in both runs"
    ]
    assert found["convergence"] == found["convergence_in_words"] == []


def test_warnings_of_the_grading_are_repeated():
    found = certificate_of([path_of()], warnings=["60 grains: too few for this grading"])
    assert (found["verdict"], found["reasons"]) == ("certified with notes", [])
    assert findings(found) == ["60 grains: too few for this grading"]


def test_deep_overlaps_at_the_end_are_noted_with_their_medians():
    deep = path_of(overlap_ratio_95=[0.0, 0.02, 0.08], median_overlap_ratio=[0.0, 0.01, 0.04])
    found = certificate_of([deep, deep])
    assert (found["verdict"], found["seeds_certified"]) == ("certified with notes", 2)
    (note,) = found["notes"]
    assert (note["check"], note["value"], note["limit"]) == ("overlaps", 0.08, 0.05)
    assert note["text"].startswith("overlaps at the end: 4.0% of the smaller radius in the median")
    passing = path_of(overlap_ratio_95=[0.0, 0.08, 0.02])
    assert certificate_of([passing])["notes"] == []


def test_load_at_the_first_step_is_noted():
    found = certificate_of([path_of()], loaded_from_the_start=True)
    assert found["verdict"] == "certified with notes"
    assert found["notes"][0]["check"] == "load at the first step"


def test_packing_that_comes_loose_on_its_way_back_is_noted_not_refused():
    stopped = [np.nan, np.nan, "state 2 comes loose on the way back"]
    found = certificate_of([path_of("llu", stopped=stopped)])
    assert (found["verdict"], found["reasons"]) == ("certified with notes", [])
    assert findings(found) == ["seed 3: state 2 comes loose on the way back"]


def test_every_note_says_what_to_do_and_what_it_does_to_the_numbers():
    deep = path_of(overlap_ratio_95=0.2)
    few = certificate_of([deep], NO_CONVERGENCE, ["few"], loaded_from_the_start=True)
    checks = [note["check"] for note in few["notes"]]
    assert checks == ["convergence", "few grains", "overlaps", "load at the first step"]
    for note in few["notes"]:
        assert note["advice"]
        assert "n" in note["effect"].split() or "not measured" in note["effect"]


def test_all_reasons_and_notes_are_given_at_once():
    moving = path_of(inertial_number=[np.nan, 1e-7, 1e-2])
    stopped = path_of("ll", (False, True), stopped=[np.nan, "stopped on the way"])
    loose = path_of(loaded=[False] * 3)
    table = converged(exponent="not converged", mean_stress_Pa="not converged")
    found = certificate_of([moving, stopped, loose], table, ["few grains"])
    starts = [reason.split(" ")[0] for reason in found["reasons"]]
    assert starts == ["seed", "1", "seed", "n:", "mean"]
    assert findings(found) == ["few grains"]
    assert found["verdict"] == "not certified"


@pytest.mark.parametrize(
    ("exponent", "told"), [((1.0, 0.51, 1.49), True), ((1.0, 0.49, 1.51), False)]
)
def test_interval_wider_than_the_exponent_takes_the_certificate_away(exponent, told):
    found = certificate_of([path_of()], fit=fit_of(*exponent))
    assert found["verdict"] == ("certified" if told else "not certified")
    assert len(found["reasons"]) == (not told)


def test_reason_names_the_width_of_the_interval():
    found = certificate_of([path_of()], fit=fit_of(1.74, -5.19, 8.67))
    assert found["reasons"] == [
        "too few seeds or branches to tell n: its interval, -5.19 to 8.67, is wider than n itself"
    ]


@pytest.mark.parametrize("fit", [EnergySplitFit.without("one length"), fit_of(3.0, np.nan, np.nan)])
def test_without_an_exponent_or_an_interval_there_is_no_width(fit):
    assert certificate_of([path_of()], fit=fit)["verdict"] == "certified"


# --- the rule ------------------------------------------------------------------------------------

GRADING = uniform(5e-6, 1e-3)


def energies_of(exponent, state):
    """Return the energies of branches of twenty lengths that follow l^n exactly."""
    length = np.linspace(1e-4, 1.9e-3, 20)
    table = {"state": state, "radius_i_m": length / 2, "radius_j_m": length / 2}
    before = pd.DataFrame({**table, "state": state - 1, "energy_J": length})
    return pd.concat([before, pd.DataFrame({**table, "energy_J": length**exponent})])


def rule_on(refined, exponents=(3.0, 3.0), stress=1e6):
    """Return what the rule makes of two seeds, both run again or none."""
    paths = [path_of().assign(**WHOLE) for _ in range(2)]
    jamming = pd.DataFrame(
        {
            "seed": [1, 2],
            "jamming_solid_fraction_loading": 0.61,
            "jamming_solid_fraction_unloading": np.nan,
            "uncertainty_loading": 1e-4,
            "loaded_from_the_start": False,
        }
    )
    states = state_certificates([1, 2], paths)
    again = Refined(
        states,
        jamming,
        [path.assign(mean_stress_Pa=[0.0, stress, stress]) for path in paths],
        lambda number, state: energies_of(exponents[number], state),
    )
    return verdict_results(
        GRADING,
        states,
        jamming,
        paths,
        refined=again if refined else None,
        report={"representativity": {"warnings": []}},
        fit=replace(fit_of(), exponent_of_each_seed=(2.99, 3.01)),
        bins=20,
    )


WHOLE = {
    "elastic_energy_J": 1.0,
    "coordination_number": 6.0,
    "mechanical_coordination_number": 6.0,
}


def test_rule_compares_both_runs_at_the_end_of_the_loading():
    convergence, certificate = rule_on(True)
    assert (certificate["verdict"], certificate["reasons"]) == ("certified", [])
    exponent = convergence.set_index("quantity").loc["exponent"]
    assert_allclose(exponent["value"], 3.0)
    assert_allclose(exponent["value_at_twice_the_steps"], 3.0, atol=1e-2)
    assert (exponent["seeds"], exponent["seeds_at_twice_the_steps"]) == (2, 2)
    assert certificate["unloading"] is None
    assert list(certificate)[-1] == "unloading"


def test_rule_withholds_the_certificate_where_the_exponent_changes():
    convergence, certificate = rule_on(True, (3.5, 3.5))
    difference = convergence.set_index("quantity").loc["exponent", "difference"]
    assert_allclose(difference, 0.5, atol=1e-2)
    assert certificate["verdict"] == "not certified"
    assert certificate["reasons"][0].startswith("n: not converged, +0.50 ± 0.0")


def test_rule_withholds_the_certificate_where_the_stress_of_the_pairs_changes():
    _, certificate = rule_on(True, stress=1.2e6)
    assert certificate["reasons"] == [
        "mean stress: not converged, +20.0 % ± 0.0 % with twice the strain steps (2 seeds, each "
        "run twice, 95 % interval): as much as 20.0 %, 5.0 % is allowed, 0.0 % could be seen: "
        "raise loading.quality"
    ]


def test_rule_without_a_second_run_notes_it():
    convergence, certificate = rule_on(False)
    assert len(convergence) == 0
    assert certificate["verdict"] == "certified with notes"
    assert findings(certificate)[0].startswith("convergence not checked")
