"""Points with bars, and bands along a path, against the limits they are given."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting import intervals, style

pytestmark = pytest.mark.filterwarnings("error")


def rows(low=(0.5, -1.0)):
    return pd.DataFrame({"y": [1.0, 2.0], "y_low": low, "y_high": [1.25, 4.0]})


def test_points_have_their_own_ends_down_and_up_and_end_at_the_floor(shown):
    ax = style.axes()
    intervals.draw_points(ax, [0.0, 1.0], rows(), "y", "black", "a", floor=0.25)
    assert_allclose(shown.bars(ax.containers[0]), [[0.5, 0.25], [1.25, 4.0]])
    assert_allclose(shown.points(ax.containers[0][0]), [[0, 1], [1, 2]])


def test_points_without_limits_have_no_bars():
    ax = style.axes()
    intervals.draw_points(ax, [0.0, 1.0], rows((np.nan, np.nan)), "y", "black", "a")
    assert not ax.containers[0].has_yerr


def test_a_path_has_a_band_between_its_limits(shown):
    ax = style.axes()
    intervals.draw_band(ax, [0.0, 1.0], rows(), "y", "black", "a")
    assert_allclose(shown.band(ax.collections[0]), [[0, 1], [0.5, -1.0], [1.25, 4.0]])
    assert not ax.containers


def test_one_state_has_a_bar(shown):
    ax = style.axes()
    intervals.draw_band(ax, [0.3], rows()[:1], "y", "black", "a")
    assert_allclose(shown.bars(ax.containers[0]), [[0.5], [1.25]])
    assert ax.containers[0].get_label() == "a"
