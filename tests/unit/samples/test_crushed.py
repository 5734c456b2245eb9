"""All seeds of a crushing together: means, stages, the halved step, and what is said."""

import numpy as np
import pytest

from branchcrush.samples.crushed import crushed_results
from branchcrush.samples.crushed_path import PARTS
from tests.unit.samples.crushed_runs import INTERVALS, RADIUS, SAMPLE, control, run

SETTINGS = {"hardening_exponent": 2.0, "rod_gap": 0.7769, "exponent": 3.0}


def results(seeds=2, halved=None, settings=SETTINGS, **more):
    runs = {seed: lambda: run(**more) for seed in range(1, seeds + 1)}
    again = {} if halved is None else {1: lambda: run(**{**more, **halved})}
    controls = {seed: control() for seed in runs}
    return crushed_results(runs, again, controls, SAMPLE, settings, INTERVALS)


@pytest.fixture(scope="module")
def whole():
    return results(halved={"lost": (0.5, 0.4, 0.1)})


def test_seeds_that_agree_have_means_without_width(whole):
    means = whole.means[~whole.means["halved_step"]]
    assert means["seeds"].tolist() == [2, 2, 2, 2]
    last = means.iloc[-1]
    assert last["mean_stress_low_Pa"] == pytest.approx(last["mean_stress_Pa"])
    lost = last["dissipated_J_per_m3"]
    states = whole.states.iloc[4]
    volume = states["solid_fraction"] * states["volume_m3"] / states["jamming_before"]
    assert lost == pytest.approx(3e-3 / volume)  # 3 mJ, by the run


def test_gradings_go_from_the_first_grains_to_the_last_state(whole):
    table = whole.gradings
    assert table["state"].unique().tolist() == whole.summary["stages"] == [2, 3, 4, 5]
    between = (table["diameter_m"] > 1.1 * RADIUS) & (table["diameter_m"] < 1.9 * RADIUS)
    finer = table[between].groupby("state")["percent_finer_by_mass"].mean()
    assert finer.to_list() == pytest.approx([0.0, 10.0, 25.0, 50.0])


def test_the_split_of_the_work_stands_beside_that_of_half_the_step(whole):
    path, halved = run()[0], run(lost=(0.5, 0.4, 0.1))[0]
    for name, table, ending in (("whole", path, "_same_seeds"), ("half", halved, "_halved")):
        work = table["work_J"].iloc[-1] - table["work_J"].iloc[2]
        share = 3e-3 * (0.2 if name == "whole" else 0.1) / work
        assert whole.summary[f"rearrangement_share{ending}"] == pytest.approx(share)
        assert whole.summary[f"step_excess_share{ending}"] == pytest.approx(share / 4.0)
    assert sum(whole.summary[f"{part}_share_halved"] for part in PARTS) == pytest.approx(1.0)
    assert any(
        "With the strain step and with half of it, 1 seed" in line
        for line in whole.summary["sentences"]
    )


def test_without_the_halved_step_the_split_is_said_to_be_unchecked():
    summary = results().summary
    assert summary["rearrangement_share_halved"] is None
    assert "The split of the work is not checked" in " ".join(summary["sentences"])


def test_one_seed_has_no_interval_and_says_so():
    result = results(seeds=1)
    assert np.isnan(result.summary["final_mean_stress_low_Pa"])
    assert "One seed: no number has an interval." in result.summary["sentences"]


def test_where_no_grain_breaks_all_results_are_there_and_say_why():
    result = results(broken=(0,) * 6)
    assert result.summary["breakages"] == 0
    assert result.summary["sentences"][0].startswith("No grain broke")
    assert len(result.line) == len(result.beside) == 0
    assert result.summary["form_sentences"] == [
        "No form of the model is drawn: no packing yields, so none is given its critical energy."
    ]
    assert np.isnan(result.summary["stored_share"])


def test_a_run_that_ended_early_gives_its_reason():
    sentences = results(stopped="20000 grains").summary["sentences"]
    assert "Seed 1 ended early: 20000 grains." in sentences


def test_without_an_exponent_the_forms_take_that_of_the_paper():
    result = results(settings={**SETTINGS, "exponent": float("nan")})
    assert "the forms take 3" in result.summary["form_sentences"][0]
    assert result.beside.equals(results().beside)
