"""Each figure of a sample: one file, every panel given the table of its name, or the reason why."""

import numpy as np
import pandas as pd
import pytest
from matplotlib import image

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.plotting import branches, crushing, forces, sample_figures, shielding
from branchcrush.samples.sharing import TABLES

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = {"reason": "no packing carries load"}
NO_FIT = EnergySplitFit.read(NOTHING)
EMPTY = pd.DataFrame(NOTHING, index=[0])


@pytest.fixture
def drawn(tmp_path):
    """Return a function that draws a figure and returns its Axes, having looked at the file."""

    def draw(function, *data):
        path = tmp_path / "folder" / "figure.png"
        figure = function(path, 50, *data)
        assert (image.imread(path)[..., :3].min(axis=-1) < 0.9).any()
        return figure.axes

    return draw


@pytest.fixture
def given(monkeypatch):
    """Return a function that stands in for plots, and what each of them was given."""
    calls = {}

    def record(module, *names):
        for name in names:

            def plot(*data, ax, name=name):
                calls[name] = data
                return ax

            monkeypatch.setattr(module, name, plot)
        return calls

    return record


# --- with data -----------------------------------------------------------------------------------


def test_packing_is_drawn_before_and_after_to_one_scale(drawn):
    path = pd.DataFrame(
        {
            "leg": ["loading", "loading", "unloading"],
            "solid_fraction": [0.16, 0.7, 0.65],
            "volume_m3": [8e-9, 1e-9, 1.1e-9],
        }
    )
    packing = (np.zeros((1, 3)), np.array([5e-4]), 2e-3)
    after = {axis: np.array([0.0]) for axis in "xyz"} | {"radius": np.array([5e-4])}
    first, last = drawn(sample_figures.draw_packing, packing, after, path, 1e-3)
    assert first.get_xlim() == last.get_xlim()
    assert "placed at random" in first.get_title() and "0.160" in first.get_title()
    assert "compressed" in last.get_title() and "0.700" in last.get_title()
    # An edge of 2 mm before and of 1 mm after.
    ends = [[line.get_xdata() for line in ax.lines[:12]] for ax in (first, last)]
    np.testing.assert_allclose(ends[0], 2.0 * np.array(ends[1]))


def test_every_panel_of_who_touches_whom_has_its_table(drawn, given):
    tables = {name: name for name in ("contact_numbers", "contact_pairs", "length_predictions")}
    plots = ("plot_contact_numbers", "plot_pairs", "plot_distances", "plot_mean_lengths")
    calls = given(branches, *plots)
    numbers = {"end": {}}
    drawn(sample_figures.draw_who_touches_whom, numbers, tables, 1e-3)
    assert calls == {
        "plot_contact_numbers": ("contact_numbers", numbers, 1e-3),
        "plot_pairs": ("contact_pairs", numbers, 1e-3),
        "plot_distances": ("length_predictions",),
        "plot_mean_lengths": ("length_predictions", 1e-3),
    }


def test_every_panel_of_sharing_has_its_table(drawn, given):
    calls = given(shielding, "plot_branch_shielding", "plot_grain_shielding")
    names = ("force_distribution", "force_by_length", "stress_by_radius", "stress_sharing")
    given(forces, *(f"plot_{name}" for name in names), "plot_fabric")
    shared = {"end": {"shielding": {"branches": {}}}}
    drawn(sample_figures.draw_sharing, shared, {name: name for name in TABLES}, 1e-3)
    assert calls == {
        "plot_branch_shielding": ("shielding_branches", shared),
        "plot_grain_shielding": ("shielding_grains",),
        "plot_force_distribution": ("force_distribution", shared),
        "plot_force_by_length": ("force_by_length", shared, 1e-3),
        "plot_stress_by_radius": ("stress_by_radius", 1e-3),
        "plot_stress_sharing": ("stress_sharing", shared),
        "plot_fabric": ("fabric", shared),
    }


def test_branches_without_shielding_say_why_beside_the_others(drawn, given):
    calls = given(shielding, "plot_branch_shielding", "plot_grain_shielding")
    names = ("force_distribution", "force_by_length", "stress_by_radius", "stress_sharing")
    given(forces, *(f"plot_{name}" for name in names), "plot_fabric")
    shared = {"end": {"shielding": {"branches": {"reason": "equal radii"}}}}
    axes = drawn(sample_figures.draw_sharing, shared, {name: name for name in TABLES}, 1e-3)
    assert axes[0].texts[0].get_text() == "no data: equal radii"
    assert len(calls) == 6


def test_free_energy_and_stress_of_the_model_are_told_apart(drawn, given):
    others = ("plot_reference_energy", "plot_crushing", "plot_driving_force", "plot_dissipation")
    given(crushing, *others)
    rows = [
        {"path": path, "crushing": c, "volumetric_strain": 0.1, "stress_Pa": 2e6, "free": c}
        for path, values in (("fixed", (0.0, 0.25, 0.5, 0.75, 1.0)), ("crushing", (0.0,)))
        for c in values
    ]
    curves = pd.DataFrame(rows).rename(columns={"free": "free_energy_J_per_m3"})
    axes = drawn(sample_figures.draw_crushing_model, curves, {"theta": 0.5})
    assert axes[1].get_ylabel().startswith("free energy")
    assert axes[1].lines[4].get_ydata().tolist() == [1e-6]
    assert axes[2].get_ylabel().startswith("mean stress")
    assert axes[2].lines[4].get_ydata().tolist() == [2.0]


# --- without -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("function", "data", "panels"),
    [
        (sample_figures.draw_energy_split, (EMPTY, NO_FIT), 1),
        (sample_figures.draw_cubic, (EMPTY, NO_FIT), 1),
        (sample_figures.draw_exponent_path, (EMPTY, NO_FIT), 1),
        (sample_figures.draw_predictors, (NO_FIT,), 2),
        (sample_figures.draw_branch_lengths, (EMPTY, NOTHING, 1e-3), 1),
        (sample_figures.draw_crushing_model, (EMPTY, NOTHING), 6),
        (
            sample_figures.draw_who_touches_whom,
            (
                NOTHING,
                dict.fromkeys(("contact_numbers", "contact_pairs", "length_predictions"), EMPTY),
                1e-3,
            ),
            4,
        ),
        (sample_figures.draw_sharing, (NOTHING, dict.fromkeys(TABLES, EMPTY), 1e-3), 7),
    ],
)
def test_every_panel_without_data_says_why(drawn, function, data, panels):
    axes = drawn(function, *data)
    texts = [text.get_text() for ax in axes for text in ax.texts]
    assert texts == ["no data: no packing carries load"] * panels
