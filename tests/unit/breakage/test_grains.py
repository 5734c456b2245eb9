"""Grains exchanged for fragments, by number and descent, and where the energy is booked."""

import numpy as np
import pytest

from branchcrush.breakage.account import Account
from branchcrush.breakage.grains import exchange, first_grains
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength, weibull_factor

SAND = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3, size_exponent=1.0)
RULES = Breakage(strength=SAND, smallest_diameter=2.5e-4)
RADII = np.array([5e-4, 6e-4, 4e-4])
PLACES = np.arange(9.0).reshape(3, 3) * 1e-3


def test_fragments_take_the_place_of_a_grain():
    before = first_grains(RADII, 1, RULES)
    after, change = exchange(before, [1], PLACES, 1, RULES)
    assert after.number.tolist() == [0, 2, *range(3, 17)]
    assert after.next_number == 17
    assert change.gone.tolist() == [1] and change.number.tolist() == list(range(3, 17))
    assert after.parent[2:].tolist() == [1] * 14
    assert after.generation.tolist() == [0, 0] + [1] * 14
    assert (after.radius**3).sum() == pytest.approx((RADII**3).sum(), rel=1e-12)
    assert np.all(np.linalg.norm(change.position - PLACES[1], axis=1) < 6e-4)
    assert np.all(change.touching_radius < after.radius[2:])
    # Those that stay are as they were.
    assert after.strength[:2].tolist() == before.strength[[0, 2]].tolist()


def test_the_order_of_breaking_changes_no_strength():
    grains = first_grains(RADII, 1, RULES)
    one, _ = exchange(grains, [0], PLACES, 1, RULES)
    one, _ = exchange(one, [2], np.zeros((one.number.size, 3)), 1, RULES)
    other, _ = exchange(grains, [2], PLACES, 1, RULES)
    other, _ = exchange(other, [0], np.zeros((other.number.size, 3)), 1, RULES)
    of = [dict(zip(each.descent, each.strength, strict=True)) for each in (one, other)]
    assert of[0] == of[1]
    line = one.descent[-1]
    diameter = 2.0 * one.radius[-1]
    assert of[0][line] == SAND.of(diameter, weibull_factor(1, line, 3.0))


def test_fragments_of_fragments_know_whence_they_come():
    grains = first_grains(RADII, 1, RULES)
    grains, _ = exchange(grains, [0], PLACES, 1, RULES)
    number = int(grains.number[2])
    grains, _ = exchange(grains, [number], np.zeros((grains.number.size, 3)), 1, RULES)
    assert grains.generation[-1] == 2
    assert grains.descent[-1] == (0, 0, 13)
    assert grains.parent[-1] == number


def test_there_is_no_row_of_a_grain_that_is_gone():
    grains, _ = exchange(first_grains(RADII, 1, RULES), [1], PLACES, 1, RULES)
    assert grains.rows([2, 3]).tolist() == [1, 2]
    for number in (1, 99):
        with pytest.raises(KeyError, match="no grain of this number"):
            grains.rows([number])


def test_the_finest_fragment_is_one_of_a_grain_at_the_limit():
    grains, _ = exchange(first_grains([1.25e-4], 1, RULES), [0], np.zeros((1, 3)), 1, RULES)
    assert 2.0 * grains.radius.min() == pytest.approx(RULES.finest_diameter, rel=1e-12)


def test_the_account_closes_and_counts_rounds_that_end_above():
    account = Account(stored=2.0)
    account.strained(work=3.0, after=4.0, quasi_static=2.5)
    account.broken(after=1.0, parents=0.5, exchanged=0.4, put_in=9.0, breakages=3)
    account.strained(work=1.0, after=1.5, quasi_static=0.75)
    account.broken(after=1.8, parents=0.1, exchanged=0.1, put_in=1.0)
    account.relaxed(after=1.7)
    assert account.work == 6.0 and account.stored == 1.7
    taken = account.breakage + account.rearrangement
    assert account.work - account.stored - taken == pytest.approx(0.0, abs=1e-15)
    assert account.step_excess == pytest.approx(0.75)
    assert account.avalanches == pytest.approx(account.breakage - 0.6)
    assert (account.rounds, account.breakages, account.rounds_upwards) == (2, 4, 1)
    assert account.largest_rise == pytest.approx(0.3 / 1.5)
    assert Account(**account.plain()) == account
