"""ROC curves: areas by hand, against scipy's statistic, and identities for any values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.stats import mannwhitneyu

from branchcrush.statistics.roc import places, roc_curve

# Few different values: many ties.
tables = st.lists(st.tuples(st.integers(-3, 3), st.booleans()), min_size=2, max_size=40).filter(
    lambda rows: len({met for _, met in rows}) == 2
)


def test_area_by_hand():
    found = places([1.0, 2.0, 2.0, 3.0], [False, True, False, True])
    # 2 is above 1 and level with 2: 3/4; 3 is above both.
    assert_allclose(found.below, [0.75, 1.0])
    assert_allclose(roc_curve(found, [0.0, 0.25, 0.5, 1.0]), [0.5, 0.75, 1.0, 1.0])


@given(tables)
def test_area_is_mann_whitneys(rows):
    values, met = (np.array(column) for column in zip(*rows, strict=True))
    u = mannwhitneyu(values[met], values[~met]).statistic
    assert_allclose(places(values, met).below.mean(), u / (met.sum() * (~met).sum()))


@given(tables)
def test_turning_the_values_turns_the_area_and_stretching_them_does_not(rows):
    values, met = (np.array(column) for column in zip(*rows, strict=True))
    area = places(values, met).below.mean()
    assert_allclose(places(-values, met).below.mean(), 1.0 - area, atol=1e-12)
    assert_allclose(places(values, ~met).below.mean(), 1.0 - area, atol=1e-12)
    assert_allclose(places(np.exp(values), met).below.mean(), area)


@given(tables)
def test_curve_rises_to_one_and_holds_the_area(rows):
    values, met = (np.array(column) for column in zip(*rows, strict=True))
    found = places(values, met)
    alarms = np.linspace(0.0, 1.0, 20001)
    curve = roc_curve(found, alarms)
    assert np.all(np.diff(curve) >= -1e-12)
    assert_allclose(curve[-1], 1.0)
    assert_allclose(np.trapezoid(curve, alarms), found.below.mean(), atol=2e-4)


def test_nothing_met_and_no_number():
    assert places([1.0, 2.0], [False, False]).below.size == 0
    assert np.isnan(roc_curve(places([1.0], [True]), [0.5])).all()
    with pytest.raises(ValueError, match="nan has no place"):
        places([1.0, np.nan], [True, False])
