"""Each figure of the fits: one file, every panel given its table, or the reason why."""

import pandas as pd
import pytest

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.plotting import crushing, fit_figures

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = {"reason": "no packing carries load"}
NO_FIT = EnergySplitFit.read(NOTHING)
EMPTY = pd.DataFrame(NOTHING, index=[0])


def test_free_energy_and_stress_of_the_model_are_told_apart(drawn, given):
    others = ("plot_reference_energy", "plot_crushing", "plot_driving_force", "plot_dissipation")
    given(crushing, *others)
    rows = [
        {"path": path, "crushing": c, "volumetric_strain": 0.1, "stress_Pa": 2e6, "free": c}
        for path, values in (("fixed", (0.0, 0.25, 0.5, 0.75, 1.0)), ("crushing", (0.0,)))
        for c in values
    ]
    curves = pd.DataFrame(rows).rename(columns={"free": "free_energy_J_per_m3"})
    axes = drawn(fit_figures.draw_crushing_model, curves, {"theta": 0.5})
    assert axes[1].get_ylabel().startswith("free energy")
    assert axes[1].lines[4].get_ydata().tolist() == [1e-6]
    assert axes[2].get_ylabel().startswith("mean stress")
    assert axes[2].lines[4].get_ydata().tolist() == [2.0]


@pytest.mark.parametrize(
    ("function", "data", "panels"),
    [
        (fit_figures.draw_energy_split, (EMPTY, NO_FIT), 1),
        (fit_figures.draw_cubic, (EMPTY, NO_FIT), 1),
        (fit_figures.draw_exponent_path, (EMPTY, NO_FIT), 1),
        (fit_figures.draw_predictors, (NO_FIT,), 2),
        (fit_figures.draw_branch_lengths, (EMPTY, NOTHING, 1e-3), 1),
        (fit_figures.draw_crushing_model, (EMPTY, NOTHING), 6),
    ],
)
def test_every_panel_without_data_says_why(drawn, function, data, panels):
    texts = [text.get_text() for ax in drawn(function, *data) for text in ax.texts]
    assert texts == ["no data: no packing carries load"] * panels
