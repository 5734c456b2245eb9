"""The study of grains that break: its comparison on made-up results."""

import shutil
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from branchcrush.files.tables import write_table
from branchcrush.samples.crushing_predicted import QUANTITIES
from tests.unit.studies import REPOSITORY, scripts_of


@pytest.fixture(scope="module")
def study():
    return scripts_of("crushing")


@pytest.fixture
def docs(tmp_path):
    """Return a folder with the page, whose places are to be filled."""
    folder = tmp_path / "docs"
    for name in ("results", "figures"):
        (folder / name).mkdir(parents=True)
    shutil.copy(REPOSITORY / "docs" / "crushing_study.md", folder)
    return folder


def states(**columns):
    """Return means of five states, of which the last four yield."""
    columns["broken_mass_fraction"] = [0.01, 0.05, 0.1, 0.2, 0.3]
    return pd.DataFrame({"state": range(5), "halved_step": False} | columns)


def test_every_case_of_the_configuration_is_told_on_the_page(study):
    assert list(study.page.CHANGED) == list(study.predict.settings_of())
    assert set(study.verdicts.HELD_OUT) == set(study.predict.PREDICTED) - {"base"}


def test_where_nothing_was_crushed_the_page_says_so_of_every_case(study, docs, tmp_path):
    missing = study.compare.main(tmp_path / "results", docs)
    page = (docs / "crushing_study.md").read_text(encoding="utf-8")
    assert missing == list(study.page.CHANGED)
    assert page.count("not crushed yet |") == len(missing)
    assert page.count("Nothing of this was crushed yet.") == 9
    assert "0." not in page.split("## Compression line")[1].split("## Gradings")[0]


def test_a_form_that_says_twice_the_stress_is_off_by_ln_2(study, tmp_path):
    sample = tmp_path / "base"
    sample.mkdir()
    stress = np.array([1.0, 2.0, 3.0, 4.0, 5.0]) * 1e6
    lost = np.array([np.nan, 1.0, 2.0, 3.0, 4.0]) * 1e3
    means = states(mean_stress_Pa=stress, dissipated_J_per_m3=lost)
    said = pd.DataFrame({"form": "paper", "state": range(5)})
    # The first state does not yield, whatever is said of it; of the last one nothing is.
    said["stress_Pa"] = np.where(np.arange(5) == 0, 99.0, 2.0) * stress
    said.loc[4, "stress_Pa"] = np.nan
    said["dissipated_J_per_m3"] = lost / [1.0, 1.0, 1.0, 1.0, 2.0]
    write_table(sample / "crushing_means.csv", means, {})
    write_table(sample / "crushing_beside_forms.csv", said, {})
    (row,) = study.measured.form_rows(tmp_path, ["base"])
    assert (row["states"], row["stress_states"], row["dissipated_states"]) == (4, 3, 4)
    assert (
        row["stress_bias_ln"] == pytest.approx(np.log(2.0)) == pytest.approx(row["stress_rms_ln"])
    )
    assert row["dissipated_bias_ln"] == pytest.approx(-np.log(2.0) / 4.0)
    assert row["dissipated_rms_ln"] == pytest.approx(np.log(2.0) / 2.0)
    assert "(3 of 4 states)" in study.page.form_block(pd.DataFrame([row]))[2]


def test_errors_of_a_prediction_are_of_the_states_that_yield(study):
    rows = [
        {
            "sample": "hertz",
            "state": state,
            "quantity": name,
            "measured": 0.01 if state == 0 else 0.1,
            "error": 9.0 if state == 0 else (-1.0) ** state * 0.3,
        }
        for state in range(5)
        for name in QUANTITIES
    ]
    rows[-1]["error"] = np.nan  # the prediction ends before the last state
    table = pd.DataFrame(study.measured.errors_of_samples(pd.DataFrame(rows)))
    last = table.set_index("quantity").loc[QUANTITIES[-1]]
    first = table.set_index("quantity").loc[QUANTITIES[0]]
    assert (first["states"], last["states"], last["states_asked"]) == (4, 3, 4)
    assert first["rms_ln"] == pytest.approx(0.3) and first["bias_ln"] == pytest.approx(0.0)
    assert last["bias_ln"] == pytest.approx(-0.1)


def growth_path(folder, taken):
    folder.mkdir(parents=True)
    path = {"leg": ["loading"] * 2, "dissipated_breakage_J": [0.0, taken], "growth_work_J": [0, 9]}
    path |= {"grains": [10, 50], "mean_stress_Pa": [0.0, 1e6]}
    write_table(folder / "path.csv", pd.DataFrame(path), {})


def test_growth_is_compared_with_the_same_packing_of_the_base_case(study, tmp_path):
    for name, taken in (("base", (2.0, 4.0, 8.0)), ("growth_20", (1.0, 5.0))):
        for seed, energy in enumerate(taken, start=1):
            growth_path(tmp_path / name / "crushing" / f"seed_{seed}", energy)
    rows = pd.DataFrame(study.measured.growth_rows(tmp_path, ["base", "growth_20"]))
    other = rows[rows["sample"] == "growth_20"]
    assert other["over_base"].tolist() == [0.5, 1.25]
    assert len(study.page.growth_block(rows)) == 2 + 5
    (said,) = study.verdicts._growth(rows)
    assert "changes by -50 to +25 %" in said


def test_the_part_of_the_strain_step_is_told_apart_for_each_step(study):
    rows = [
        {
            "strain_step": step,
            "step_tolerance": 1e-2,
            "stepping": "strain_step",
            "seed": seed,
            "breakages": 80,
            "mean_stress_Pa": 5e6,
            "stored_share": 0.1,
            "released_by_parents_share": 0.1,
            "avalanches_share": 0.7 - 50.0 * step,
            "rearrangement_share": 0.05 + 50.0 * step + 0.01 * seed,
            "step_excess_share": 50.0 * step,
            "force_evaluations": 120000,
        }
        for step in (2e-3, 1e-3)
        for seed in (-1, 1)
    ]
    table = study.page.step_block(pd.DataFrame(rows))
    cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table[2:]]
    assert [(line[0], line[9], line[10]) for line in cells] == [
        ("0.002", "10.0 ± 0.0", "5.0 ± 1.0"),
        ("0.001", "5.0 ± 0.0", "5.0 ± 1.0"),
    ]
    (said,) = study.verdicts._steps(pd.DataFrame(rows))
    assert "10.0 % at 0.002, 5.0 % at 0.001" in said


def test_the_figure_shows_what_was_simulated_and_what_was_predicted(study, tmp_path):
    sample = tmp_path / "base"
    sample.mkdir()
    phi = np.linspace(0.65, 0.74, 5)
    means = states(
        seeds=2, solid_fraction=phi, void_ratio=1 / phi - 1, mean_stress_Pa=1e6 * np.arange(1, 6),
        number_exponent=np.linspace(0, 2, 5),
    )  # fmt: skip
    write_table(sample / "crushing_means.csv", means, {})
    shares = {f"{part}_share": [0.25] for part in study.page._PARTS}
    told = pd.DataFrame({"sample": ["base"]} | shares)
    said = means.assign(sample="base", mean_stress_Pa=2e6 * np.arange(1, 6))
    drawn = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(study.figure, "figure", keeping(study.figure.figure, drawn))
        study.figure.draw(Path(tmp_path, "picture.png"), tmp_path, ["base"], told, said)
    compression, _, _, energy = drawn["axes"].flat
    simulated, predicted = compression.lines
    assert simulated.get_xdata().tolist() == [1, 2, 3, 4, 5]
    assert predicted.get_xdata().tolist() == [2, 4, 6, 8, 10]
    assert [bar.get_width() for bar in energy.patches] == [25.0] * 4
    assert (tmp_path / "picture.png").stat().st_size > 10_000


def keeping(figure, drawn):
    """Return a context of a figure that keeps its panels."""

    @contextmanager
    def kept(*arguments):
        with figure(*arguments) as axes:
            drawn["axes"] = axes
            yield axes

    return kept
