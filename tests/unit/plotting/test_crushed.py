"""Figures of grains that break, by the data that they draw."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from branchcrush.plotting import crushed, crushed_figures, crushed_forms
from tests.unit.samples.crushed_runs import control, run
from tests.unit.samples.test_crushed import results


@pytest.fixture(scope="module")
def result():
    return results(broken=(0, 0, 8, 16, 24, 40), halved={"lost": (0.5, 0.4, 0.1)})


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def line(ax, label):
    return next(line for line in ax.lines if line.get_label() == label)


def of(ax, gid):
    return [line for line in ax.lines if line.get_gid() == gid]


def test_the_compression_line_has_every_seed_and_the_slope_of_the_law(result):
    ax = crushed.plot_line(result.states, result.line, [control()] * 2, result.summary)
    seed = line(ax, "seed 2").get_xydata()
    rows = result.states[(result.states["seed"] == 2) & result.states["carries_load"]]
    assert seed[:, 0] == pytest.approx(rows["mean_stress_Pa"] / 1e6)
    assert seed[:, 1] == pytest.approx(rows["void_ratio"])
    (law,) = of(ax, "law")
    (x0, y0), (x1, y1) = law.get_xydata()
    assert np.log(y1 / y0) / np.log(x1 / x0) == pytest.approx(-0.5)


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_without_a_slope_no_law_and_without_predictions_no_line_is_drawn_or_named(result):
    unknown = result.line.assign(predicted_stress_Pa=np.nan)
    for missing in (None, np.nan):
        summary = {**result.summary, "slope": missing}
        ax = crushed.plot_line(result.states, unknown, [control()], summary)
        assert not of(ax, "law")
        assert labels(ax) == ["seed 1", "seed 2", "grains do not break"]


def test_void_ratios_are_marked_without_small_marks_between(result):
    ax = crushed.plot_line(result.states, result.line, [control()], result.summary)
    ax.figure.canvas.draw()
    low, high = ax.get_ylim()
    marks = [float(text.get_text()) for text in ax.get_yticklabels() if text.get_text()]
    assert sum(low <= mark <= high for mark in marks) >= 3
    assert not ax.yaxis.get_minorticklabels()


def test_forms_and_measures_that_are_unknown_are_not_named(result):
    means = result.means.assign(compaction_work_J_per_m3=np.nan)
    beside = result.beside.copy()
    beside.loc[beside["form"] == "paper", "dissipated_J_per_m3"] = np.nan
    ax = crushed_forms.plot_dissipation(means, beside)
    told = labels(ax)
    assert "simulated" in told and not any("by rods" in label for label in told)
    assert not of(ax, "paper") and "paper, no branch density" not in told
    assert of(ax, "einav")
    nothing = crushed_forms.plot_dissipation(
        means.assign(dissipated_J_per_m3=np.nan), beside.iloc[:0]
    )
    assert nothing.texts[0].get_text() == "no data: no grain broke under load"


def test_the_jamming_point_of_gradings_stands_over_the_measured_one(result):
    ax = crushed.plot_jamming(result.states)
    rows = result.states[~result.states["halved_step"] & result.states["carries_load"]]
    assert line(ax, "states").get_ydata() == pytest.approx(rows["jamming_by_rods"])
    assert line(ax, "half the step").get_xdata().size == 4


def test_gradings_end_at_all_and_the_limit_is_marked(result):
    ax = crushed.plot_gradings(result.gradings, result.summary)
    assert line(ax, "$\\phi$ = 0.700").get_ydata()[-1] == pytest.approx(100.0)
    assert [0.25, 0.25] in [list(each.get_xdata()) for each in ax.lines]


def test_shares_are_drawn_with_those_of_half_the_step_dashed(result):
    whole, half = of(crushed.plot_energy(result.means), "rearrangement")
    assert (whole.get_linestyle(), half.get_linestyle()) == ("-", "--")
    # A fifth of what is lost with whole steps, a tenth with half: of the same work.
    assert half.get_ydata()[-1] == pytest.approx(whole.get_ydata()[-1] / 2.0)


def test_measures_and_forms_are_drawn_over_solid_fraction(result):
    ax = crushed_forms.plot_measures(result.means, result.beside)
    whole, _ = of(ax, "einav_breakage")
    means = result.means[~result.means["halved_step"]]
    assert whole.get_ydata() == pytest.approx(means["einav_breakage"])
    (paper,) = of(ax, "paper")
    expected = result.beside.query("form == 'paper'")["crushing"]
    assert paper.get_ydata() == pytest.approx(expected, nan_ok=True)


def test_stress_and_dissipation_are_in_megapascals(result):
    ax = crushed_forms.plot_stress(result.means, result.beside, [control()])
    means = result.means[~result.means["halved_step"]]
    assert of(ax, "mean_stress_Pa")[0].get_ydata() == pytest.approx(means["mean_stress_Pa"] / 1e6)
    ax = crushed_forms.plot_dissipation(result.means, result.beside)
    drawn = of(ax, "dissipated_J_per_m3")[0].get_ydata()
    assert drawn == pytest.approx(means["dissipated_J_per_m3"] / 1e6, nan_ok=True)


@pytest.mark.parametrize("broken", [(0, 0, 8, 16, 24, 40), (0,) * 6])
def test_all_figures_are_drawn_also_where_no_grain_broke(broken, tmp_path):
    result = results(broken=broken)
    tables, summary = result._asdict(), result.summary
    path, grains, _ = run(broken=broken)
    for name in ("x_m", "y_m", "z_m"):
        grains[name] = np.linspace(-1e-3, 1e-3, len(grains))
    controls = [control()] * 2
    crushed_figures.draw_line(tmp_path / "line.png", 50, tables, controls, summary)
    crushed_figures.draw_gradings(tmp_path / "gradings.png", 50, result.gradings, summary)
    crushed_figures.draw_energy(tmp_path / "energy.png", 50, result.means, summary)
    crushed_figures.draw_measures(
        tmp_path / "measures.png", 50, result.means, result.beside, summary
    )
    crushed_figures.draw_forms(tmp_path / "forms.png", 50, result.means, result.beside, controls)
    crushed_figures.draw_packing(tmp_path / "packing.png", 50, grains, path, summary)
    assert len(list(tmp_path.glob("*.png"))) == 6
