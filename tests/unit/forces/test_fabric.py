"""Directions whose fabric is known, and how much of a deviator chance alone makes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.stats import binom

from branchcrush.forces.fabric import (
    chance_range,
    deviator,
    effective_branches,
    expected_deviator,
    fabric_result,
    fabric_tensor,
    orientation_band,
)

TRIALS, BRANCHES = 4000, 60


def rng_of(seed=1):
    return np.random.default_rng(seed)


def isotropic(rng, *shape):
    return rng.standard_normal((*shape, 3))


def deviators(rng, weigh=None):
    """Deviators of many samples of isotropic branches, whose lengths do not matter."""
    weights = np.ones((TRIALS, BRANCHES)) if weigh is None else weigh(rng, (TRIALS, BRANCHES))
    tensors = [
        fabric_tensor(vectors, weight)
        for vectors, weight in zip(isotropic(rng, TRIALS, BRANCHES), weights, strict=True)
    ]
    return deviator(tensors), weights


# --- tensors -------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.integers(1, 30), st.floats(1e-6, 1e6))
def test_a_tensor_has_trace_one_and_neither_unit_nor_sign_changes_it(seed, number, unit):
    rng = rng_of(seed)
    vectors, weights = isotropic(rng, number), rng.uniform(0.1, 2.0, number)
    tensor = fabric_tensor(vectors, weights)
    assert_allclose(np.trace(tensor), 1.0)
    assert_allclose(tensor, tensor.T, atol=1e-15)
    signs = rng.choice([-1.0, 1.0], (number, 1))
    assert_allclose(fabric_tensor(unit * signs * vectors, 3.0 * weights), tensor, atol=1e-14)


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32))
def test_the_deviator_does_not_know_how_axes_are_turned(seed):
    rng = rng_of(seed)
    vectors = isotropic(rng, 20)
    turn, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    assert_allclose(deviator(fabric_tensor(vectors @ turn)), deviator(fabric_tensor(vectors)))


@pytest.mark.parametrize(
    ("vectors", "expected"),
    [
        (np.eye(3), 0.0),
        ([[1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]], 0.0),
        ([[0, 0, 3.0], [0, 0, -1.0]], 1.0),
        # In a plane, evenly: diag(1/2, 1/2, 0).
        ([[1, 0, 0], [0, 1, 0]], 0.5),
    ],
)
def test_known_directions_have_known_deviators(vectors, expected):
    assert_allclose(deviator(fabric_tensor(vectors)), expected, atol=1e-15)


def test_weights_count_as_repeated_branches():
    vectors = isotropic(rng_of(), 4)
    repeated = np.repeat(vectors, [1, 2, 3, 4], axis=0)
    assert_allclose(fabric_tensor(vectors, [1, 2, 3, 4]), fabric_tensor(repeated))


# --- chance --------------------------------------------------------------------------------------


def test_mean_square_of_isotropic_tensors_is_two_thirds_over_their_number():
    found, _ = deviators(rng_of())
    # q^2 is about chi-square with 5 degrees of freedom over 5: its relative scatter is sqrt(2/5).
    error = np.sqrt(0.4 / TRIALS)
    assert_allclose(np.mean(found**2), expected_deviator(BRANCHES) ** 2, rtol=4.5 * error)
    assert_allclose(np.mean(found**2) / 1.5, 2.0 / 3.0 / BRANCHES, rtol=4.5 * error)


def test_one_branch_alone_has_the_deviator_expected():
    assert_allclose(deviator(fabric_tensor(isotropic(rng_of(), 1))), expected_deviator(1))


@pytest.mark.parametrize(
    "weigh",
    [
        lambda rng, shape: rng.standard_exponential(shape),
        lambda rng, shape: rng.lognormal(0.0, 1.0, shape),
    ],
)
def test_forces_make_as_much_noise_as_fewer_equal_branches(weigh):
    found, weights = deviators(rng_of(), weigh)
    expected = [expected_deviator(effective_branches(BRANCHES, weight)) for weight in weights]
    ratio = np.mean((found / expected) ** 2)
    assert_allclose(ratio, 1.0, atol=4.5 * np.sqrt(0.4 / TRIALS))


@pytest.mark.parametrize("seeds", [1, 4, 20])
@pytest.mark.parametrize("confidence", [0.5, 0.95])
def test_chance_leaves_the_range_as_often_as_it_should(seeds, confidence):
    found, _ = deviators(rng_of(3))
    ratio = np.sqrt(np.mean(found.reshape(-1, seeds) ** 2, axis=1)) / expected_deviator(BRANCHES)
    low, high = chance_range(seeds, confidence)
    for outside in (ratio < low, ratio > high):
        rare = (1.0 - confidence) / 2.0
        # A tenth of it more or less for the branches' being no infinite number.
        margin = 4.0 * np.sqrt(rare * (1.0 - rare) / len(ratio)) + 0.1 * rare
        assert abs(outside.mean() - rare) < margin


def test_effective_number_is_at_most_the_number():
    assert effective_branches(7) == 7.0
    assert_allclose(effective_branches(7, np.full(7, 3.0)), 7.0)
    assert_allclose(effective_branches(3, [1e-12, 1.0, 1e-12]), 1.0)


# --- all of it -----------------------------------------------------------------------------------


def sample(rng, stretch, seeds=30, branches=400):
    vectors = isotropic(rng, seeds, branches) * [1.0, 1.0, stretch]
    return list(vectors), list(rng.standard_exponential((seeds, branches)))


def test_isotropic_packings_are_as_even_as_chance_and_their_mean_more():
    rows, summary = fabric_result(*sample(rng_of(), 1.0), confidence=0.999)
    assert [row["branches"] for row in rows] == [400] * 30
    for kind, branches in (("branches", 400), ("forces", 200)):
        found = summary[kind]
        assert found["by_chance_low"] < found["deviator_over_expected"] < found["by_chance_high"]
        # Exponential forces count half.
        expected = 1.0 / np.sqrt(30 * branches)
        assert_allclose(found["expected_deviator_of_mean"], expected, rtol=0.03)
        assert found["deviator_of_mean"] < chance_range(1, 0.9999)[1] * expected
    assert_allclose(rows[0]["expected_deviator"], 0.05)


def test_packings_that_lean_one_way_are_less_even_and_their_mean_no_more():
    rows, summary = fabric_result(*sample(rng_of(), 1.5))
    for kind, key in (("branches", ""), ("forces", "force_")):
        found = summary[kind]
        assert found["deviator_over_expected"] > found["by_chance_high"]
        typical = np.mean([row[f"{key}deviator"] for row in rows])
        assert_allclose(found["deviator_of_mean"], typical, rtol=0.15)


def test_only_forces_that_depend_on_direction_lean():
    vectors, _ = sample(rng_of(), 1.0)
    forces = [1.0 + vector[:, 2] ** 2 / np.sum(vector**2, axis=1) for vector in vectors]
    _, summary = fabric_result(vectors, forces, confidence=0.999)
    found = summary["branches"]
    assert found["deviator_over_expected"] < found["by_chance_high"]
    assert summary["forces"]["deviator_over_expected"] > summary["forces"]["by_chance_high"]
    # <n n (1 + z^2)> is diag(6, 6, 8)/20.
    assert_allclose(summary["forces"]["deviator_of_mean"], 0.1, atol=0.03)


def test_each_seed_counts_by_its_own_number_of_branches():
    # One branch alone has q = 1 of 1 expected, three at right angles 0; their mean F is
    # diag(4, 1, 1)/6, so q = sqrt(3/2) |diag(2, -1, -1)|/6 = 1/2.
    one, three = np.array([[1.0, 0.0, 0.0]]), np.eye(3)
    _, summary = fabric_result([one, three], [np.ones(1), np.ones(3)])
    for found in summary.values():
        assert_allclose(found["deviator_over_expected"], np.sqrt(0.5), atol=1e-12)
        assert_allclose(found["deviator_of_mean"], 0.5)
        assert_allclose(found["expected_deviator_of_mean"], np.sqrt(1.0 + 1 / 3) / 2)


def test_as_many_forces_as_branches_are_needed():
    with pytest.raises(ValueError, match="zip"):
        fabric_result([np.eye(3)], [])


def test_sectors_of_independent_branches_lie_in_the_band_as_often_as_it_says():
    rng = np.random.default_rng(5)
    counts = rng.multinomial(300, np.full(12, 1 / 12), size=2000)
    low, high = orientation_band(300, 12)
    inside = np.mean((counts * 12 / 300 >= low) & (counts * 12 / 300 <= high))
    # Counts are whole numbers, so a little more than 95 % are within.
    assert 0.945 < inside < 0.975


def test_the_band_is_the_quantiles_of_the_binomial_distribution():
    for branches in (1, 2, 7, 300, 4001, 1_000_000):
        for sectors in (2, 12, 36):
            ends = binom.ppf([0.025, 0.975], branches, 1.0 / sectors) * sectors / branches
            assert_allclose(orientation_band(branches, sectors), ends)
