"""Notes: each check on values on both sides of its limit, and what a note says."""

import csv
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from branchcrush.samples import note_effects, notes
from branchcrush.samples.convergence import convergence_table
from branchcrush.samples.note_effects import EFFECTS, MEASURED, Effect, effect_of

ROOT = Path(__file__).parents[3]


def ends(overlaps, certified=True):
    """Return the rows of `certificate.csv` at the end, with these overlaps at 95 %."""
    table = {"overlap_ratio_95": overlaps, "median_overlap_ratio": np.array(overlaps) / 2}
    return pd.DataFrame({**table, "certified": certified})


@pytest.mark.parametrize(
    ("overlaps", "values"),
    [([0.049, 0.05], []), ([0.02, 0.051], []), ([0.049, 0.053], [0.051]), ([0.08, 0.09], [0.085])],
)
def test_overlaps_are_noted_from_a_median_of_five_per_cent_of_the_radius(overlaps, values):
    found = notes.overlap_notes(ends(overlaps))
    assert [note.value for note in found] == pytest.approx(values)
    assert all(note.value > note.limit for note in found)


def test_overlaps_of_packings_that_are_not_certified_are_no_note():
    assert notes.overlap_notes(ends([0.2, 0.2], certified=False)) == []
    (note,) = notes.overlap_notes(ends([0.06, 0.2, 0.3], certified=[True, False, False]))
    assert note.value == 0.06
    assert "3.0% of the smaller radius in the median, 6.0% at 95 %" in note.finding


def test_note_of_overlaps_has_value_limit_and_the_medians():
    (note,) = notes.overlap_notes(ends([0.07, 0.08, 0.10]))
    assert (note.check, note.value, note.limit) == ("overlaps", 0.08, 0.05)
    assert "4.0% of the smaller radius in the median, 8.0% at 95 %" in note.finding
    assert "a stiffer contact leads to the same overlaps" in note.advice


def grains_of(diameters, warnings):
    return {"warnings": warnings, "edge_over_diameter": diameters, "grains_needed": 3790}


def test_few_grains_are_noted_where_the_grading_warns():
    assert notes.grains_notes(grains_of(5.2, [])) == []
    (note,) = notes.grains_notes(grains_of(4.1, ["2000 grains make a box of 4.1"]))
    assert (note.check, note.value, note.limit) == ("few grains", 4.1, 5)
    assert note.finding == "2000 grains make a box of 4.1"
    assert "raise grains to 3790" in note.advice


def test_cell_narrower_than_any_measured_says_so():
    (narrow,) = notes.grains_notes(grains_of(2.0, ["few"]))
    (known,) = notes.grains_notes(grains_of(3.5, ["few"]))
    assert "narrower ones were not measured" in narrow.effect
    assert "narrower" not in known.effect


def packings(**columns):
    table = {
        "mean_stress_Pa": 2.0,
        "elastic_energy_J": 1.0,
        "mechanical_coordination_number": 6.0,
        "jamming_solid_fraction": 0.6,
    }
    others = ("solid_fraction", "work_J", "coordination_number", "force_evaluations")
    table |= dict.fromkeys(others, 1.0)
    return pd.DataFrame({**table, **columns}, index=[1, 2, 3])


def test_what_is_not_decided_is_noted_with_the_most_that_it_may_change():
    twice = packings(mean_stress_Pa=[2.1, 2.2, 2.3])
    table = convergence_table(packings(), twice, [3.0, 3.5], [2.0, 4.0])
    (note,) = notes.convergence_notes(table)
    # A mean of 0.2; Student's t of two degrees of freedom 4.3027, times 0.1 over sqrt(3).
    assert note.value == pytest.approx(0.2 + 4.30265 * 0.1 / np.sqrt(3), rel=1e-5)
    assert note.limit == pytest.approx(0.1)
    assert note.finding.startswith("convergence not decided: mean stress +10.0 % ±")
    assert "refined_seeds" in note.advice


def test_exponent_that_is_not_decided_is_no_note():
    table = convergence_table(packings(), packings(), [3.0, 3.5], [2.0, 4.0])
    assert table.set_index("quantity").loc["exponent", "verdict"] == "not decided"
    assert notes.convergence_notes(table) == []


def test_convergence_that_nobody_asked_for_is_noted():
    table = convergence_table(packings(), packings()[:0], [3.0], [])
    (note,) = notes.convergence_notes(table)
    assert note.finding.startswith("convergence not checked")
    assert "refined_seeds" in note.advice


def test_packings_loaded_from_the_start_are_counted():
    early = pd.DataFrame({"loaded_from_the_start": [True, False, True]})
    (note,) = notes.loaded_early_notes(early)
    assert (note.value, note.limit) == (2, 0)
    assert note.finding.startswith("2 of 3 packings")
    assert "lower loading.approach_solid_fraction" in note.advice
    assert notes.loaded_early_notes(early[1:2]) == []


def test_every_stop_on_the_way_back_is_a_note_of_its_own():
    found = notes.late_stop_notes(["seed 3: comes loose on the way back"])
    assert [note.finding for note in found] == ["seed 3: comes loose on the way back"]
    assert "none on n, stress and energy" in found[0].effect


def test_text_has_finding_effect_and_advice():
    note = notes.Note("overlaps", 0.1, 0.05, "A", "B", "C")
    assert note.result() == {
        "check": "overlaps",
        "value": 0.1,
        "limit": 0.05,
        "finding": "A",
        "effect": "B",
        "advice": "C",
        "text": "A. Likely effect: B. What to do: C.",
    }


# --- effects -------------------------------------------------------------------------------------

INVENTED = (
    Effect("overlaps", 0.05, "one", (1.0, 0.1), (2.0, 0.2), (0.01, 0.02)),
    Effect("overlaps", 0.10, "one", (3.0, 0.3), (-4.0, 0.4), (-0.03, 0.04)),
    Effect("overlaps", 0.10, "other", (5.0, 0.5), (6.0, 0.6), (0.05, 0.06)),
)


@pytest.mark.parametrize(
    ("value", "level", "told"),
    [(0.05, "5%", ["+1.0"]), (0.06, "10%", ["+3.0", "+5.0"]), (0.3, "10%", ["+3.0", "+5.0"])],
)
def test_effect_is_of_the_next_level_that_was_measured(monkeypatch, value, level, told):
    monkeypatch.setattr(note_effects, "EFFECTS", INVENTED)
    text = effect_of("overlaps", value)
    assert f"at {level} of the radius" in text
    assert re.findall(r"mean stress (\S+)", text) == told
    assert ("deeper ones were not measured" in text) == (value > 0.1)


def test_effect_has_its_errors_where_and_when_it_was_measured(monkeypatch):
    monkeypatch.setattr(note_effects, "EFFECTS", INVENTED)
    text = effect_of("overlaps", 0.1)
    assert (
        "mean stress +3.0 ± 0.3 %, energy -4.0 ± 0.4 %, n -0.03 ± 0.04, measured on one; " in text
    )
    assert text.endswith(f"measured on other ({MEASURED})")


def test_table_of_the_package_is_that_of_the_documents():
    with (ROOT / "docs/results/note_effects.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(EFFECTS)
    for row, effect in zip(rows, EFFECTS, strict=True):
        assert (row["check"], float(row["level"])) == (effect.check, effect.level)
        assert effect.measured_on.startswith(row["measured_on"])
        for name, places in (("stress_percent", 1), ("energy_percent", 1), ("exponent", 2)):
            told = getattr(effect, name.removesuffix("_percent"))
            for value, column in zip(told, (name, f"{name}_error"), strict=True):
                assert value == pytest.approx(float(row[column]), abs=0.51 * 10**-places)
