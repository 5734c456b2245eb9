"""The figure of predicted crushing, by the data that it draws."""

import pandas as pd

from branchcrush.plotting.crushing_predicted import plot_predicted, plot_predicted_line
from branchcrush.samples.crushing_predicted import QUANTITIES, beside_predicted

PREDICTED = pd.DataFrame(
    {"solid_fraction": [0.64, 0.68], "void_ratio": [1 / 0.64 - 1, 1 / 0.68 - 1]}
).assign(**{name: [1.0e6, 3.0e6] for name in QUANTITIES})
SEED = pd.DataFrame({"state": [3], "solid_fraction": [0.66]}).assign(
    **dict.fromkeys(QUANTITIES, 4.0e6)
)


def test_prediction_and_mean_of_the_seeds_are_drawn():
    beside = beside_predicted(PREDICTED, {1: SEED, 2: SEED.assign(grains_ratio=2.0e6)})
    ax = plot_predicted("grains_ratio", PREDICTED, beside)
    line, points = ax.lines[:2]
    assert line.get_ydata().tolist() == [1.0e6, 3.0e6]
    assert (points.get_xdata().tolist(), points.get_ydata().tolist()) == ([0.66], [3.0e6])
    ax = plot_predicted_line(PREDICTED, beside)
    assert ax.lines[1].get_xdata().tolist() == [4.0]
    assert beside["predicted"].tolist() == [2.0e6] * len(QUANTITIES)
