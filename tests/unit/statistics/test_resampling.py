"""Intervals of means, whose scatter is known, from resampling seeds."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy import stats

from branchcrush.statistics.resampling import (
    Resampling,
    interval_of_refits,
    pooled_interval,
    seed_draws,
)


def seeded(state):
    return np.random.default_rng(state)


def ratio(sums):
    """Return the mean that sums of values and numbers of them make."""
    return sums[..., 0] / sums[..., 1]


def with_number(values):
    """Return what seeds of one value each add to sum and number."""
    return np.stack([values, np.ones_like(values)], axis=1)


# --- draws ---------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=30)
@given(st.integers(1, 30), st.integers(1, 50), st.integers(0, 2**32))
def test_every_draw_has_as_many_seeds_as_there_are(seeds, resamples, state):
    draws = seed_draws(seeds, resamples, np.random.default_rng(state))
    assert draws.shape == (resamples, seeds)
    assert np.all(draws >= 0)
    assert np.all(draws.sum(axis=1) == seeds)


def test_seeds_are_drawn_alike_and_with_replacement():
    # Numbers of a multinomial: mean 1, variance 1 - 1/S, covariance -1/S.
    draws, seeds = seed_draws(5, 100_000, np.random.default_rng(1)), 5
    assert_allclose(draws.mean(axis=0), 1.0, atol=5 * (0.8 / 100_000) ** 0.5)
    assert_allclose(np.cov(draws.T), np.eye(seeds) - 1 / seeds, atol=0.02)


# --- interval of refits --------------------------------------------------------------------------


@pytest.mark.parametrize("seeds", [2, 3, 5, 16, 100])
@pytest.mark.parametrize("confidence", [0.5, 0.9, 0.95])
def test_half_width_is_students_t_times_the_corrected_deviation_of_the_refits(seeds, confidence):
    refits = np.random.default_rng(seeds).normal(3.0, 0.2, 50)
    estimate, low, high = interval_of_refits(2.9, refits, seeds, confidence)
    quantile = stats.t.ppf((1 + confidence) / 2, seeds - 1)
    half = quantile * np.std(refits, ddof=1) * (seeds / (seeds - 1)) ** 0.5
    assert estimate == 2.9
    assert_allclose([low, high], [2.9 - half, 2.9 + half], rtol=1e-12)
    assert all(type(limit) is float for limit in (estimate, low, high))


@pytest.mark.filterwarnings("error")
def test_draws_without_an_estimate_are_left_out_of_their_own_column_only():
    refits = np.random.default_rng(1).normal(size=(20, 2))
    holed = refits.copy()
    holed[3:8, 1], holed[8, 1] = np.nan, np.inf
    kept = np.delete(refits[:, 1], np.arange(3, 9))
    whole = interval_of_refits([0.0, 0.0], holed, 4)
    assert whole.low.shape == whole.high.shape == (2,)
    for column, values in enumerate((refits[:, 0], kept)):
        expected = interval_of_refits(0.0, values, 4)
        assert_allclose([whole.low[column], whole.high[column]], expected[1:], rtol=1e-12)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("refits", [[np.nan, np.nan], [1.0, np.nan], [1.0], []])
def test_fewer_than_two_refits_give_no_interval(refits):
    estimate, low, high = interval_of_refits(1.0, refits, 5)
    assert estimate == 1.0
    assert np.isnan([low, high]).all()


def test_one_seed_gives_no_interval():
    assert_array_equal(interval_of_refits(1.5, [1.0, 2.0], 1), [1.5, np.nan, np.nan])
    many = interval_of_refits([[1.0, 2.0]], [], 1)
    assert_array_equal(many.estimate, [[1.0, 2.0]])
    assert np.isnan([many.low, many.high]).all()


# --- interval of pooled sums ---------------------------------------------------------------------


def test_interval_of_a_mean_is_the_textbook_one():
    # The mean of a draw scatters by s sqrt((S - 1)/S)/sqrt(S), s being the deviation of the seeds.
    for seeds in (2, 3, 8, 20):
        values = np.random.default_rng(seeds).normal(5.0, 1.0, seeds)
        result = pooled_interval(
            with_number(values), ratio, resamples=40_000, rng=np.random.default_rng(1)
        )
        expected = stats.t.interval(0.95, seeds - 1, values.mean(), stats.sem(values))
        assert result.estimate == pytest.approx(values.mean(), rel=1e-12)
        assert (result.high - result.low) / 2 == pytest.approx(np.diff(expected)[0] / 2, rel=0.02)


@pytest.mark.parametrize("seeds", [3, 6])
def test_interval_of_a_mean_holds_it_as_often_as_it_says(seeds):
    rng, trials = np.random.default_rng(seeds), 2000
    held = 0
    for _ in range(trials):
        result = pooled_interval(
            with_number(rng.normal(1.0, 1.0, seeds)), ratio, resamples=200, rng=rng
        )
        held += result.low <= 1.0 <= result.high
    # Four standard deviations of a share of 0.95, and what 200 resamples blur.
    assert 0.925 <= held / trials <= 0.975


def test_larger_seeds_count_by_what_they_add():
    sums = np.array([[10.0, 10.0], [300.0, 100.0]])
    result = pooled_interval(sums, ratio, resamples=40_000, rng=np.random.default_rng(1))
    # Draws: twice the first, one of each (half of all), twice the second.
    draws = np.repeat([1.0, 310 / 110, 3.0], [1, 2, 1])
    half = stats.t.ppf(0.975, 1) * draws.std() * 2**0.5
    assert result.estimate == pytest.approx(310 / 110)
    assert result.high - result.estimate == pytest.approx(half, rel=0.02)


def test_seeds_that_agree_leave_no_doubt():
    result = pooled_interval([[6.0, 2.0], [9.0, 3.0], [3.0, 1.0]], ratio, rng=seeded(1))
    assert_allclose(result, 3.0, rtol=1e-14)


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32), st.integers(2, 12), st.floats(1e-9, 1e9), st.floats(-5, 5))
def test_units_scale_and_offset_the_interval_with_the_estimate(state, seeds, unit, offset):
    values = seeded(state).normal(3.0, 1.0, seeds)
    result = pooled_interval(with_number(values), ratio, resamples=50, rng=seeded(1))
    other = pooled_interval(
        with_number((values + offset) * unit), ratio, resamples=50, rng=seeded(1)
    )
    assert_allclose(other, (np.array(result) + offset) * unit, rtol=1e-9, atol=1e-9 * unit)


def test_order_of_seeds_matters_to_the_limits_no_more_than_the_draws_do():
    values = with_number(seeded(3).normal(size=10))
    first, other = (
        pooled_interval(sums, ratio, resamples=20_000, rng=seeded(1))
        for sums in (values, values[::-1])
    )
    assert other.estimate == pytest.approx(first.estimate, abs=1e-14)
    assert_allclose(other[1:], first[1:], atol=0.02 * (first.high - first.low))


def test_many_quantities_are_estimated_at_once_as_one_by_one():
    sums = seeded(4).uniform(1.0, 2.0, (6, 2, 3))
    together = pooled_interval(sums, lambda x: x[:, 0] / x[:, 1], rng=seeded(1))
    for k in range(3):
        alone = pooled_interval(sums[:, :, k], ratio, rng=seeded(1))
        assert_allclose([values[k] for values in together], alone, rtol=1e-12)


def test_bins_that_some_draws_leave_empty_take_their_interval_from_the_others():
    sums = np.array([[0.0, 0.0], [3.0, 1.0], [10.0, 2.0]])

    def mean(x):
        with np.errstate(invalid="ignore"):
            return ratio(x)

    result = pooled_interval(sums, mean, rng=seeded(1))
    assert result.estimate == pytest.approx(13 / 3)
    assert result.low < result.estimate < result.high


def test_one_pooled_seed_has_an_estimate_and_draws_nothing():
    assert_array_equal(pooled_interval([[6.0, 2.0]], ratio, rng=None), [3.0, np.nan, np.nan])


def test_same_random_state_gives_the_same_limits():
    sums = with_number(seeded(5).normal(size=8))
    first, again, other = (pooled_interval(sums, ratio, rng=seeded(k)) for k in (1, 1, 2))
    assert first == again
    assert first.low != other.low


# --- random states -------------------------------------------------------------------------------


def test_kinds_of_results_have_random_states_of_their_own():
    # A published interval is that of these states.
    states = {"EXPONENTS": 20, "CONTACTS": 21, "PREDICTORS": 22, "SHARING": 23, "FINDINGS": 24}
    states |= {"CRUSHED": 25, "CRUSHED_GRAINS": 26}
    assert {kind.name: int(kind) for kind in Resampling} == states
    first, again = Resampling.SHARING.rng(), Resampling.SHARING.rng()
    assert first.random() == again.random() == np.random.default_rng(23).random()
