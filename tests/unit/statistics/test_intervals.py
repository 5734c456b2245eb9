"""Intervals by their names in tables, and as text."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from branchcrush.statistics.intervals import Interval, interval_names, interval_text


def test_an_interval_is_read_back_under_the_names_that_it_gives_itself():
    named = Interval(3.0, 2.5, 3.75).named("theta")
    assert named == {"theta": 3.0, "theta_low": 2.5, "theta_high": 3.75}
    assert tuple(named) == interval_names("theta")
    assert Interval.read({"other": 1.0, **named}, "theta") == (3.0, 2.5, 3.75)


def test_what_a_result_does_not_hold_is_no_number():
    known = Interval.read({"theta": 2.0, "theta_low": None}, "theta")
    assert known.estimate == 2.0
    assert np.isnan([known.low, known.high]).all()
    assert np.isnan(Interval.read({}, "theta")).all()


def test_one_of_many_intervals_is_of_plain_numbers():
    many = Interval(*(np.array([[1.0, 2.0], [3.0, 4.0]]) + shift for shift in (0.0, -0.5, 0.5)))
    one = many.part((1, 0))
    assert one == (3.0, 2.5, 3.5)
    assert {type(value) for value in one} == {float}
    assert_array_equal(many.part(1), [[3.0, 4.0], [2.5, 3.5], [3.5, 4.5]])


@pytest.mark.parametrize(
    ("limits", "expected"),
    [
        ((2.966, 3.154), "3.06 (2.97 to 3.15)"),
        ((None, None), "3.06 (one seed: no interval)"),
        ((np.nan, np.nan), "3.06 (one seed: no interval)"),
    ],
)
def test_text_of_an_interval_has_two_decimals_or_says_that_there_is_none(limits, expected):
    assert interval_text(3.0649, *limits) == expected
