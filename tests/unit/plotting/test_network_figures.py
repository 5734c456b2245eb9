"""Each figure of the networks: one file, every panel given its table, or the reason why."""

import pandas as pd
import pytest

from branchcrush.plotting import branches, forces, network_figures, shielding
from branchcrush.samples.sharing import TABLES

pytestmark = pytest.mark.filterwarnings("error")
TOUCHING = ("contact_numbers", "contact_pairs", "length_predictions")
NOTHING = {"reason": "no packing carries load"}


def test_every_panel_of_who_touches_whom_has_its_table(drawn, given):
    tables = {name: name for name in ("contact_numbers", "contact_pairs", "length_predictions")}
    plots = ("plot_contact_numbers", "plot_pairs", "plot_distances", "plot_mean_lengths")
    calls = given(branches, *plots)
    numbers = {"end": {}}
    drawn(network_figures.draw_who_touches_whom, numbers, tables, 1e-3)
    assert calls == {
        "plot_contact_numbers": ("contact_numbers", numbers, 1e-3),
        "plot_pairs": ("contact_pairs", numbers, 1e-3),
        "plot_distances": ("length_predictions",),
        "plot_mean_lengths": ("length_predictions", 1e-3),
    }


def test_the_legend_of_distances_lies_over_no_line(drawn, given):
    given(branches, "plot_contact_numbers", "plot_pairs", "plot_mean_lengths")
    # As of the paper's case, over most of two decades.
    off = [0.52, 0.18, 0.27, 0.035, 0.016, 0.18, 0.013]
    rows = [
        {"prediction": name, "solid_fraction_above_jamming": x, "kolmogorov_smirnov": distance}
        for name, distance in zip(branches.PREDICTIONS, off, strict=True)
        for x in (0.01, 0.14)
    ]
    tables = dict.fromkeys(TOUCHING) | {"length_predictions": pd.DataFrame(rows)}
    # It looks at the legends of what it has drawn.
    drawn(network_figures.draw_who_touches_whom, {"end": {}}, tables, 1e-3)


def test_every_panel_of_sharing_has_its_table(drawn, given):
    calls = given(shielding, "plot_branch_shielding", "plot_grain_shielding")
    names = ("force_distribution", "force_by_length", "stress_by_radius", "stress_sharing")
    given(forces, *(f"plot_{name}" for name in names), "plot_fabric")
    shared = {"end": {"shielding": {"branches": {}}}}
    drawn(network_figures.draw_sharing, shared, {name: name for name in TABLES}, 1e-3)
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
    axes = drawn(network_figures.draw_sharing, shared, {name: name for name in TABLES}, 1e-3)
    assert axes[0].texts[0].get_text() == "no data: equal radii"
    assert len(calls) == 6


@pytest.mark.parametrize(
    ("function", "tables", "panels"),
    [
        (network_figures.draw_who_touches_whom, TOUCHING, 4),
        (network_figures.draw_sharing, TABLES, 7),
    ],
)
def test_every_panel_without_data_says_why(drawn, function, tables, panels):
    axes = drawn(function, NOTHING, dict.fromkeys(tables), 1e-3)
    texts = [text.get_text() for ax in axes for text in ax.texts]
    assert texts == ["no data: no packing carries load"] * panels
