"""Strengths follow Weibull's distribution and the effect of size, each told by descent alone."""

from math import gamma

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from branchcrush.breakage.strength import Strength, rotation_stream, weibull_factor


@pytest.fixture(scope="module")
def factors():
    return np.sort([weibull_factor(7, (number,), 3.0) for number in range(10_000)])


def test_ten_thousand_strengths_have_the_mean_of_weibull(factors):
    # The standard deviation of the mean is 0.0036 of it.
    assert factors.mean() == pytest.approx(gamma(1.0 + 1.0 / 3.0), rel=0.0125)


def test_survival_falls_with_the_modulus(factors):
    survival = 1.0 - (np.arange(factors.size) + 0.5) / factors.size
    middle = (survival > 0.02) & (survival < 0.98)
    slope, start = np.polyfit(np.log(factors[middle]), np.log(-np.log(survival[middle])), 1)
    assert slope == pytest.approx(3.0, rel=0.03)
    # 37 % survive the strength itself.
    assert np.exp(start) == pytest.approx(1.0, abs=0.03)


@given(st.floats(1e-5, 1e-1), st.floats(0.0, 4.0), st.floats(0.1, 3.0), st.floats(1.1, 10.0))
def test_strength_falls_as_a_power_of_size(diameter, exponent, factor, ratio):
    law = Strength(
        strength=1e7, weibull_modulus=3.0, reference_diameter=1e-3, size_exponent=exponent
    )
    small, large = law.of(diameter, factor), law.of(ratio * diameter, factor)
    assert large / small == pytest.approx(ratio**-exponent, rel=1e-9)
    assert law.of(1e-3, 1.0) == 1e7


def test_descent_alone_decides():
    lines = [(1,), (2,), (1, 0), (1, 1), (1, 0, 0), (0, 1)]
    drawn = [weibull_factor(1, line, 3.0) for line in lines]
    assert len(set(drawn)) == len(lines)
    assert drawn[::-1] == [weibull_factor(1, line, 3.0) for line in lines[::-1]]
    assert weibull_factor(2, (1,), 3.0) != drawn[0]
    assert rotation_stream(1, (1,)).random() != rotation_stream(1, (2,)).random()
    # Of their own streams: how a grain's fragments are turned says nothing of its strength.
    u = np.exp(-(drawn[0] ** 3.0))
    assert rotation_stream(1, (1,)).random() != pytest.approx(1.0 - u, abs=1e-12)
