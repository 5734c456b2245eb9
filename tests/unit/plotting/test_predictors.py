"""Predictors and local exponents: points and bars against the fit."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_hex
from numpy.testing import assert_allclose

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.state_fit import Curvature, FittedPredictor, StateFit
from branchcrush.plotting import predictors
from branchcrush.plotting.style import STATES
from branchcrush.statistics.intervals import Interval

pytestmark = pytest.mark.filterwarnings("error")
UNKNOWN = Interval(float("nan"), float("nan"), float("nan"))


def predictor(name, *explained):
    return FittedPredictor(name, "formula", {}, Interval(*explained), None)


def bend(shift=0.0, half=0.5):
    slopes = [
        Interval(value + shift, value + shift - half, value + shift + 2 * half)
        for value in (0.4, 2.0, 2.5, 3.0)
    ]
    return Curvature(*slopes)


END = StateFit(
    (
        predictor("branch_length", 0.16, 0.15, 0.18),
        predictor("grain_size", 0.12, 0.11, 0.14),
        FittedPredictor.without("surface", "formula", "too few lengths"),
    ),
    bend(),
)
NEAR = StateFit((predictor("reduced_radius", 0.08, 0.05, 0.09),), bend(-1.0), 4, 0.65)
FIT = replace(EnergySplitFit.without("only its states count"), end=END, near_jamming=NEAR)


def test_explained_deviances_stand_in_the_rows_of_their_predictors(shown):
    ax = predictors.plot_predictors(FIT)
    end, near = ax.containers
    assert_allclose(shown.points(end[0]), [[0.16, 0.12], [-0.12, 2.88]])
    assert_allclose(shown.bars(end, "x"), [[0.15, 0.11], [0.18, 0.14]])
    assert_allclose(shown.points(near[0]), [[0.08], [1.12]])
    assert_allclose(shown.bars(near, "x"), [[0.05], [0.09]])
    names = [text.get_text() for text in ax.get_yticklabels()]
    assert (names[0], names[1], names[3]) == (
        "branch length l",
        "reduced radius R*",
        "grain size (Einav)",
    )
    assert ax.get_xlim()[0] == 0.0
    for drawn, where in ((end, "end"), (near, "near_jamming")):
        assert (drawn.get_label(), to_hex(drawn[0].get_color())) == STATES[where]


def test_negative_deviances_are_seen():
    end = StateFit((predictor("branch_length", -0.1, -0.2, 0.0),), bend())
    assert predictors.plot_predictors(replace(FIT, end=end)).get_xlim()[0] < -0.2


def test_without_seeds_to_leave_out_it_says_so():
    alone = StateFit((predictor("branch_length", *UNKNOWN),), bend())
    ax = predictors.plot_predictors(replace(FIT, end=alone, near_jamming=None))
    assert ax.texts[0].get_text() == "needs two seeds or more"


def test_local_exponents_are_drawn_at_short_mean_and_long_branches(shown):
    ax = predictors.plot_slopes(FIT)
    end, near = ax.containers
    assert_allclose(shown.points(end[0]), [[0.05, 1.05, 2.05], [2.0, 2.5, 3.0]])
    assert_allclose(shown.bars(end), [[1.5, 2.0, 2.5], [3.0, 3.5, 4.0]])
    assert_allclose(shown.points(near[0]), [[-0.05, 0.95, 1.95], [1.0, 1.5, 2.0]])
    assert [drawn.get_label() for drawn in (end, near)] == [
        "at the end: c = 0.40 (-0.10 to 1.40)",
        "near jamming: c = -0.60 (-1.10 to 0.40)",
    ]
    assert to_hex(near[0].get_color()) == STATES["near_jamming"][1]
    assert shown.line(ax, "the paper's n = 3")[1].tolist() == [3.0, 3.0]


def test_one_seed_has_no_bars_and_one_state_is_the_end():
    end = StateFit((), bend(half=np.nan))
    (only,) = predictors.plot_slopes(replace(FIT, end=end, near_jamming=None)).containers
    assert not only.has_yerr
    assert only.get_label() == "at the end: c = 0.40"


def test_a_state_without_a_curvature_is_left_out():
    near = replace(NEAR, curvature=Curvature.without("one length"))
    (only,) = predictors.plot_slopes(replace(FIT, near_jamming=near)).containers
    assert only.get_label().startswith("at the end")
