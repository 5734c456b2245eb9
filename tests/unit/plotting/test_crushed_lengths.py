"""The figure of branch lengths while grains break, by the data that it draws."""

import numpy as np
import pytest
from matplotlib import image
from matplotlib import pyplot as plt

from branchcrush.plotting.crushed_lengths import draw_lengths, plot_lengths
from branchcrush.samples.crushed_lengths import no_lengths
from tests.unit.samples.test_crushed import results


@pytest.fixture(scope="module")
def result():
    return results()


def test_every_stage_and_both_predictions_of_the_last_are_drawn(result):
    table, ax = result.lengths, plot_lengths(result.lengths)
    drawn = {line.get_label(): line for line in ax.lines}
    for _, rows in table.groupby("state"):
        line = drawn[rf"$\phi$ = {rows['solid_fraction'].iloc[0]:.3f}"]
        assert line.get_ydata().tolist() == rows["density"].tolist()
        low, high = rows["length_over_diameter_low"], rows["length_over_diameter_high"]
        assert ((low < line.get_xdata()) & (line.get_xdata() < high)).all()
    for line in ax.lines:
        if name := line.get_gid():
            assert line.get_ydata().tolist() == rows[name].tolist()
    assert len([line for line in ax.lines if line.get_gid()]) == 2
    plt.close("all")


def test_a_prediction_that_is_not_known_is_not_in_the_legend(result):
    ax = plot_lengths(result.lengths.assign(density_by_rods=np.nan))
    told = [text.get_text() for text in ax.get_legend().get_texts()]
    assert not any("rods" in text for text in told) and any("Eq. 4" in text for text in told)
    plt.close("all")


def test_without_contacts_the_figure_says_so(tmp_path):
    draw_lengths(tmp_path / "none.png", 50, no_lengths(), {"breakages": 3})
    assert (image.imread(tmp_path / "none.png")[..., :3].min(axis=-1) < 0.9).any()
