"""Grains of which a share has broken: by hand, and what holds of any of them."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from branchcrush.breakage.cascade import broken_down
from branchcrush.breakage.fragments import packed_spheres
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength

SHARES = st.floats(0.0, 1.0)
RATIOS = st.floats(1.01, 50.0)
FRAGMENTS = st.sampled_from([4, 14, 30])


def finest(ratio, fragments):
    sand = Strength(strength=1.0, weibull_modulus=3.0, reference_diameter=1.0, size_exponent=1.0)
    rules = Breakage(strength=sand, smallest_diameter=1.0 / ratio, fragments=fragments)
    return rules.finest_diameter


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_two_generations_by_hand(share):
    # Of 14 fragments of a grain of 1, four are larger than 0.5: 0.4495 * 1.2439. Those break again,
    # and their fragments are finer than 0.5.
    diameter, number = broken_down([1.0], [1.0], share, 0.5, 14)
    whole, once, twice = 1 - share, share * (10 + 4 * (1 - share)), 4 * 14 * share**2
    assert number.sum() == pytest.approx(whole + once + twice)
    full = (packed_spheres(14)[:, 3] ** 3).sum() ** (-1 / 3)
    coarse = np.abs(diameter - 0.449489743 * full) < 1e-6
    assert number[coarse].sum() == pytest.approx(4 * share * (1 - share))


@given(SHARES, RATIOS, FRAGMENTS)
@example(2.6e-65, 11.0, 14)  # grains of later generations so few that no digit of them is left
def test_no_mass_is_lost_and_none_is_finer_than_the_finest_fragment(share, ratio, fragments):
    diameter, number = broken_down([1.0, 0.4], [1.0, 3.0], share, 1.0 / ratio, fragments)
    assert number @ diameter**3 == pytest.approx(1.0 + 3.0 * 0.4**3, rel=1e-9)
    assert np.all(number >= 0.0)
    assert diameter.min() > (1.0 - 1e-9) * min(finest(ratio, fragments), 0.4)


@given(RATIOS, FRAGMENTS)
def test_where_all_break_none_is_left_above_the_limit(ratio, fragments):
    diameter, number = broken_down([1.0], [1.0], 1.0, 1.0 / ratio, fragments)
    assert number[diameter > 1.0 / ratio].sum() == 0.0


@given(SHARES, SHARES, RATIOS)
def test_more_broken_are_more_grains(one, other, ratio):
    less, more = (
        broken_down([1.0], [1.0], share, 1.0 / ratio, 14)[1].sum() for share in sorted([one, other])
    )
    assert more >= less * (1.0 - 1e-12)


def test_grains_at_the_limit_stay():
    diameter, number = broken_down([0.5, 0.3], [2.0, 5.0], 1.0, 0.5, 14)
    assert diameter.tolist() == [0.5, 0.3] and number.tolist() == [2.0, 5.0]
