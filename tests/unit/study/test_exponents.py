"""The exponent along the loading: where it is what, and how far all samples go."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.study.exponents import at_distance, common_distance, crossing

DISTANCES = np.array([0.0, 0.05, 0.1, 0.15])


def path_of(exponents, half=0.1, distances=DISTANCES):
    exponents = np.asarray(exponents, dtype=float)
    return pd.DataFrame(
        {
            "solid_fraction_above_jamming": distances,
            "exponent": exponents,
            "exponent_low": exponents - half,
            "exponent_high": exponents + half,
        }
    )


def test_exponent_between_states_is_on_the_line_between_them():
    value, low, high = at_distance(path_of([2.0, 2.5, 3.0, 3.5]), 0.075)
    assert (value, low, high) == pytest.approx((2.75, 2.65, 2.85))


@pytest.mark.parametrize("distance", [-0.01, 0.16])
def test_beyond_the_states_there_is_no_exponent(distance):
    assert np.isnan(at_distance(path_of([2.0, 2.5, 3.0, 3.5]), distance)).all()


def test_states_without_an_exponent_are_left_out():
    assert at_distance(path_of([np.nan, 2.5, np.nan, 3.5]), 0.1)[0] == pytest.approx(3.0)
    assert np.isnan(at_distance(path_of([np.nan] * 4), 0.1)).all()


@pytest.mark.parametrize(
    ("exponents", "distance"),
    [
        ([2.0, 2.5, 3.5, 4.0], 0.075),
        # Above, below again, and above for good.
        ([3.2, 2.8, 3.2, 3.4], 0.075),
        ([3.1, 3.2, 3.3, 3.4], np.nan),
        ([2.0, 2.2, 3.2, 2.4], np.nan),
    ],
)
def test_crossing_is_where_the_exponent_is_above_three_for_good(exponents, distance):
    assert crossing(path_of(exponents)) == pytest.approx(distance, nan_ok=True)


def test_common_distance_is_the_shortest_rounded_down():
    ends = [path_of([2.0, 3.0], distances=[0.0, end]) for end in (0.131, 0.2, 0.149)]
    assert common_distance(ends) == 0.13
    assert np.isnan(common_distance([]))
    unknown = path_of([2.0, 3.0], distances=[np.nan, np.nan])
    assert np.isnan(common_distance([unknown]))
    # A sample whose jamming point is unknown does not blank the others.
    assert common_distance([unknown, *ends]) == 0.13


def test_one_state_is_no_path_and_does_not_limit_the_others():
    one = path_of([2.0], distances=[0.05])
    assert np.isnan(common_distance([one]))
    assert common_distance([one, path_of([2.0, 3.0], distances=[0.0, 0.2])]) == 0.2
