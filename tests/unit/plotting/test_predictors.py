"""Predictors and local exponents: points and bars against the fit."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex
from numpy.testing import assert_allclose

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.local_exponents import LocalExponent
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


def part(low, n, q, half=0.2):
    exponents = (Interval(value, value - half, value + 2 * half) for value in (n, q))
    return LocalExponent(low, low + 0.5, 100, *exponents)


BY_RATIO = FittedPredictor(
    "length_and_ratio",
    "formula",
    {"length_exponent": Interval(2.5, 2.4, 2.6), "ratio_exponent": Interval(2.0, 1.9, 2.1)},
    UNKNOWN,
    None,
)


def with_parts(*parts, predictors=(BY_RATIO,)):
    return replace(FIT, end=StateFit(predictors, bend(), local_exponents=parts))


def test_local_exponents_are_drawn_over_their_ranges_beside_those_at_equal_ratio(shown):
    ax = predictors.plot_local_exponents(with_parts(part(1.0, 2.0, 2.4), part(1.5, 3.0, 2.6)))
    every, equal = ax.containers
    assert_allclose(shown.points(every[0]), [[1.22, 1.72], [2.0, 3.0]])
    assert_allclose(shown.bars(every), [[1.8, 2.8], [2.4, 3.4]])
    assert_allclose(shown.points(equal[0]), [[1.28, 1.78], [2.4, 2.6]])
    assert shown.line(ax, "the paper's n = 3")[1].tolist() == [3.0, 3.0]
    assert shown.line(ax, "q = 2.50")[1].tolist() == [2.5, 2.5]


def test_local_exponents_of_one_seed_have_no_bars_and_of_too_few_lengths_say_so():
    ax = predictors.plot_local_exponents(with_parts(part(1.0, 2.0, 2.4, half=np.nan)))
    assert not any(container.has_yerr for container in ax.containers)
    assert "too few lengths" in predictors.plot_local_exponents(with_parts()).texts[0].get_text()


def test_ratios_of_many_branches_are_drawn_with_the_curve_that_was_fitted(shown):
    table = pd.DataFrame(
        {
            "mean_radius_ratio": [0.1, 0.5, 1.0],
            "branches": [19, 20, 500],
            "g": [0.9, 0.6, 1.0],
            "g_low": [0.1, 0.5, 1.0],
            "g_high": [1.9, 0.8, 1.0],
        }
    )
    ax = predictors.plot_radius_ratio(table, with_parts())
    assert_allclose(shown.points(ax.containers[0][0]), [[0.5, 1.0], [0.6, 1.0]])
    assert_allclose(shown.bars(ax.containers[0]), [[0.5, 1.0], [0.8, 1.0]])
    ratio, g = shown.line(ax, "$(4 r_1 r_2/l^2)^t$, t = 2.00")
    assert_allclose(g, (4 * ratio / (1 + ratio) ** 2) ** 2)
    assert g[-1] == pytest.approx(1.0)


def test_one_ratio_says_so():
    ax = predictors.plot_radius_ratio(pd.DataFrame(), with_parts(predictors=()))
    assert "no two ratios of radii" in ax.texts[0].get_text()
