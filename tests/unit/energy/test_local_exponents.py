"""The exponent along the length, of energies in which length and ratio play known parts."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.energy.local_exponents import local_exponents, trend
from branchcrush.statistics.intervals import Interval

NAN = float("nan")


def branches(rng, number, sharing):
    """Return logarithms of radii; `sharing` takes lengths, returns shares of the smaller one."""
    length = rng.uniform(0.4, 2.0, number)
    share = sharing(length)
    return np.log(share * length), np.log((1.0 - share) * length), length, share


def test_exponent_of_each_range_is_that_of_its_branches():
    rng = np.random.default_rng(1)
    length = np.sort(rng.uniform(0.5, 2.0, 4000))
    low, high = np.quantile(length, [0.05, 0.99])
    middle = (low + high) / 2
    energy = np.where(length < middle, (length / middle) ** 1.5, (length / middle) ** 4.0)
    equal = np.log(length / 2)
    parts = local_exponents([(equal, equal, energy)] * 2, resamples=50)
    edges = np.linspace(low, high, 5)
    assert_allclose([part.length_low for part in parts], edges[:-1])
    assert_allclose([part.length_high for part in parts], edges[1:])
    assert_allclose([part.exponent.estimate for part in parts], [1.5, 1.5, 4.0, 4.0], atol=1e-7)
    expected = np.histogram(length, edges)[0] * 2
    assert [part.branches for part in parts] == pytest.approx(expected, abs=4)
    # Of equal radii alone nothing is told at equal ratio.
    assert np.isnan([part.at_equal_ratio.estimate for part in parts]).all()


def test_what_the_ratio_adds_is_gone_at_equal_ratio():
    # Middle lengths join the most unequal grains: n rises and falls, q does not.
    rng = np.random.default_rng(2)

    def sharing(length):
        likeness = 0.1 + 0.35 * np.abs(length - 1.0)
        return likeness * rng.uniform(0.9, 1.1, length.size)

    seeds = []
    for _ in range(4):
        small, large, length, share = branches(rng, 3000, sharing)
        mean = length**2.5 * (4.0 * share * (1.0 - share)) ** 3.0
        seeds.append((small, large, mean * rng.exponential(size=length.size)))
    parts = local_exponents(seeds, resamples=200)
    n = [part.exponent.estimate for part in parts]
    assert n[0] < 1.0 and max(n) > 4.0
    for part in parts:
        q = part.at_equal_ratio
        # Four standard errors; the half width is Student's 3.18 of them.
        assert abs(q.estimate - 2.5) < 4 / 3.18 * (q.high - q.estimate)


@pytest.mark.parametrize("size", [0, 300])
def test_without_lengths_that_differ_there_are_none(size):
    equal = np.full(size, -1.0)
    assert local_exponents([(equal, equal, np.ones(size))] * 2) == ()


def around(value, half=0.1):
    return Interval(value, value - half, value + half)


@pytest.mark.parametrize(
    ("exponents", "words"),
    [
        ([around(2.4), around(3.8), around(3.4), around(2.2)], "rises and then falls"),
        ([around(3.0), around(2.0), around(2.5)], "falls and then rises"),
        ([around(2.0), around(2.5), around(3.0)], "rises"),
        ([around(3.0), around(2.5), around(2.6)], "falls"),
        # By 0.3 together, further than 0.2 times the root of 2 and not than 0.25 times it.
        ([around(2.0), around(2.14), around(2.3, 0.2)], "rises"),
        ([around(2.0, 0.25), around(2.3, 0.25)], "does not change by more than"),
        ([around(2.0, NAN), around(3.0, NAN)], "has no intervals"),
        ([around(2.0), around(NAN), around(3.0)], "rises"),
    ],
)
def test_trend_is_told_beyond_the_intervals(exponents, words):
    assert trend(exponents).startswith(words)
    if words in ("rises", "falls"):
        assert trend(exponents) == words
