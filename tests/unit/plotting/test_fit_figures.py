"""Each figure of the fits: one file, every panel given its table, or the reason why."""

import pandas as pd
import pytest

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.plotting import fit_figures, loading

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = {"reason": "no packing carries load"}
NO_FIT = EnergySplitFit.read(NOTHING)
EMPTY = pd.DataFrame(NOTHING, index=[0])


@pytest.mark.parametrize(
    ("function", "data", "panels"),
    [
        (fit_figures.draw_energy_split, (EMPTY, NO_FIT), 1),
        (fit_figures.draw_cubic, (EMPTY, NO_FIT), 1),
        (fit_figures.draw_exponent_path, (EMPTY, NO_FIT), 1),
        (fit_figures.draw_predictors, (NO_FIT,), 2),
        (fit_figures.draw_branch_lengths, (EMPTY, NOTHING, 1e-3), 1),
    ],
)
def test_every_panel_without_data_says_why(drawn, function, data, panels):
    texts = [text.get_text() for ax in drawn(function, *data) for text in ax.texts]
    assert texts == ["no data: no packing carries load"] * panels


def test_every_panel_of_the_loading_path_has_its_table_and_no_law_says_why(drawn, given):
    plots = ("plot_mean_stress", "plot_energy_balance", "plot_coordination")
    calls = given(loading, *plots)
    axes = drawn(fit_figures.draw_loading_path, "path", {"reason": "no elastic law"})
    assert calls == {name: ("path",) for name in plots}
    assert axes[3].texts[0].get_text() == "no data: no elastic law"


def test_the_elastic_law_is_drawn_with_its_fit(drawn, given):
    plots = ("plot_mean_stress", "plot_energy_balance", "plot_coordination", "plot_elastic_law")
    calls = given(loading, *plots)
    drawn(fit_figures.draw_loading_path, "path", {"theta": 0.5})
    assert calls["plot_elastic_law"] == ("path", {"theta": 0.5})
