"""Grains whose stress is known: what each class of radius carries, and how unevenly."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.branches.contact_numbers import radius_classes
from branchcrush.forces.stress import (
    cumulative_sharing,
    stress_by_radius,
    stress_sharing,
    stress_sharing_result,
)
from branchcrush.packings.contacts import mean_stress
from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_stress_volume
from branchcrush.packings.network import Network

SHARES = np.linspace(0.0, 1.0, 101)
NONE = np.zeros(0, dtype=int)


def rng_of(seed=1):
    return np.random.default_rng(seed)


def network(
    radius, i=NONE, j=NONE, overlap=(), force=(), wall=NONE, wall_overlap=(), wall_force=()
):
    arrays = [np.asarray(part, dtype=float) for part in (overlap, force, wall_overlap, wall_force)]
    i, j, wall = (np.asarray(part, dtype=int) for part in (i, j, wall))
    return Network(
        np.asarray(radius, float), i, j, arrays[0], arrays[1], 0.0 * arrays[1], wall, *arrays[2:]
    )


def loaded(radius, stress, held=True):
    """Grains that six walls press with the given mean stress each; one wall where not held.

    The first and the last touch without a force.
    """
    radius = np.asarray(radius, dtype=float)
    walls = np.where(held, 6, 1) * np.ones(radius.size, dtype=int)
    wall = np.repeat(np.arange(radius.size), walls)
    force = 3.0 * np.asarray(stress) * sphere_volume(radius) / radius / walls
    ends = ([0], [radius.size - 1], [0.0], [0.0])
    return network(radius, *ends, wall, np.zeros(wall.size), force[wall])


def random_network(rng, grains, contacts, walls):
    radius = rng.lognormal(0.0, 0.7, grains)
    i = rng.integers(0, grains, contacts)
    j = (i + rng.integers(1, grains, contacts)) % grains
    overlap = rng.uniform(0.0, 0.1, contacts) * np.minimum(radius[i], radius[j])
    wall = rng.integers(0, grains, walls)
    wall_overlap = rng.uniform(0.0, 0.1, walls) * radius[wall]
    force, wall_force = rng.standard_exponential(contacts), rng.standard_exponential(walls)
    return network(radius, i, j, overlap, force, wall, wall_overlap, wall_force)


# --- stress of a grain ---------------------------------------------------------------------------


def test_two_grains_have_the_stress_of_their_contact():
    pair = network([1.0, 3.0], [0], [1], [0.2], [6.0])
    # A third of the force times the distance from the centre to the middle of the overlap.
    assert_allclose(grain_stress_volume(pair), [2.0 * 0.9, 2.0 * 2.9])


def test_one_grain_between_six_walls_has_the_stress_of_the_walls():
    radius, overlap, force = 1.0, 0.05, 2.0
    touching = ([0], [1], [0.0], [0.0])  # another grain that presses on nothing
    packing = network([radius, 1.0], *touching, [0] * 6, [overlap] * 6, [force] * 6)
    edge = 2.0 * (radius - overlap)
    assert_allclose(grain_stress_volume(packing), [force / edge**2 * edge**3, 0.0])


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 2**32), st.integers(2, 40), st.integers(1, 120), st.integers(0, 30))
def test_the_grains_add_up_to_the_stress_of_the_packing(seed, grains, contacts, walls):
    packing = random_network(rng_of(seed), grains, contacts, walls)
    volume = 3.0 * sphere_volume(packing.radius).sum()
    whole = mean_stress(
        packing.length - packing.overlap,
        packing.force,
        volume,
        packing.radius[packing.wall_grain] - packing.wall_overlap,
        packing.wall_force,
    )
    assert_allclose(grain_stress_volume(packing).sum(), whole * volume, rtol=1e-12)


# --- by radius -----------------------------------------------------------------------------------


def test_classes_have_the_stress_of_their_making():
    radius, stress = np.repeat([1.0, 2.0, 4.0], [8, 4, 2]), np.repeat([1.0, 2.0, 3.0], [8, 4, 2])
    edges = radius_classes(radius, np.ones(radius.size))
    table = stress_by_radius([loaded(radius, stress)], edges, rng=None)
    mean = np.average(stress, weights=radius**3)
    assert_allclose(table["stress_ratio"], [1.0 / mean, 2.0 / mean, 3.0 / mean])
    assert_allclose(table["load_bearing_stress_ratio"], table["stress_ratio"])
    assert_array_equal(table["grains"], [8, 4, 2])
    assert_allclose(table["mean_radius_m"], [1.0, 2.0, 4.0])
    assert np.isnan(table["stress_ratio_low"]).all()


def test_rattlers_lower_only_the_stress_of_all():
    radius = np.repeat([1.0, 2.0], [10, 5])
    held = np.append(np.arange(10) < 4, np.ones(5, dtype=bool))
    table = stress_by_radius([loaded(radius, 1.0 * held, held)], [1.0, 1.5, 2.0], rng=None)
    mean = (4.0 + 40.0) / 50.0
    assert_allclose(table["stress_ratio"], [0.4 / mean, 1.0 / mean])
    assert_allclose(table["load_bearing_stress_ratio"], [1.0 / mean, 1.0 / mean])


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.integers(1, 4))
def test_classes_weighted_by_volume_have_the_mean_stress(seed, seeds):
    rng = rng_of(seed)
    networks = [random_network(rng, 40, 120, 20) for _ in range(seeds)]
    radii = np.concatenate([seed.radius for seed in networks])
    edges = radius_classes(radii, np.ones(radii.size), 5)
    table = stress_by_radius(networks, edges, resamples=20, rng=rng)
    group = np.clip(np.searchsorted(edges, radii, side="right") - 1, 0, len(edges) - 2)
    volume = np.bincount(group, sphere_volume(radii), len(edges) - 1)
    assert table["grains"].sum() == radii.size
    filled = table["grains"] > 0
    assert_allclose(np.average(table["stress_ratio"][filled], weights=volume[filled]), 1.0)


def test_intervals_of_classes_cover_the_truth():
    radius, edges = np.repeat([1.0, 1.5, 2.0], [40, 20, 10]), [1.0, 1.2, 1.7, 2.0]
    truth = np.array([0.5, 1.0, 2.0])
    mean = np.average(truth, weights=radius[[0, 40, 60]] ** 3 * [40, 20, 10])
    covered = np.zeros(3)
    for trial in range(60):
        rng = rng_of(trial)
        stress = np.repeat(truth, [40, 20, 10]) * rng.standard_exponential((10, 70))
        table = stress_by_radius(
            [loaded(radius, seed) for seed in stress], edges, resamples=300, rng=rng
        )
        inside = np.abs(truth / mean - table["stress_ratio"])
        covered += inside < (table["stress_ratio_high"] - table["stress_ratio"])
    # 57 expected; 4 standard deviations of 1.7.
    assert np.all(covered >= 50)


# --- cumulative ----------------------------------------------------------------------------------


@settings(deadline=None, max_examples=50)
@given(st.integers(0, 2**32), st.integers(1, 60), st.floats(1e-6, 1e6), st.floats(1e-6, 1e6))
def test_sharing_rises_from_nothing_to_all_whatever_order_and_unit(seed, grains, unit, scale):
    rng = rng_of(seed)
    radius, stress = rng.choice([0.5, 1.0, 1.7, 3.0], grains), rng.standard_exponential(grains)
    share = cumulative_sharing(radius, stress, SHARES)
    assert (share[0], round(share[-1], 12)) == (0.0, 1.0)
    assert np.all(np.diff(share) >= -1e-12)
    order = rng.permutation(grains)
    other = cumulative_sharing(unit * radius[order], scale * stress[order], SHARES)
    assert_allclose(other, share, atol=1e-9)


@pytest.mark.parametrize("power", [-1.0, 0.0, 1.0, 4.0])
def test_a_stress_that_grows_with_radius_has_the_shares_of_its_integral(power):
    # Radii evenly from 0 to 1: x = R^4, S = R^(4+a) = x^(1+a/4), and so I = a/(8+a).
    radius = (np.arange(20_000) + 0.5) / 20_000
    packing = loaded(radius, radius**power)
    table, summary = stress_sharing([packing], rng=None)
    assert_allclose(table["stress_share"], SHARES ** (1.0 + power / 4.0), atol=1e-3)
    assert_allclose(
        summary["coarse_half_stress_share"], 1.0 - 0.5 ** (1.0 + power / 4.0), atol=1e-3
    )
    assert_allclose(summary["sharing_index"], power / (8.0 + power), atol=1e-3)


def test_grains_of_one_radius_share_evenly_whoever_carries():
    packing = loaded(np.ones(50), rng_of().standard_exponential(50))
    table, summary = stress_sharing([packing], rng=None)
    assert_allclose(table["stress_share"], SHARES, atol=1e-12)
    assert_allclose(summary["coarse_half_stress_share"], 0.5)
    assert_allclose(summary["sharing_index"], 0.0, atol=1e-12)


def test_the_mean_of_the_seeds_lies_in_its_interval_between_them():
    radius = np.linspace(0.1, 1.0, 500)
    networks = [loaded(radius, radius**power) for power in (0.8, 1.0, 1.2)]
    single = [stress_sharing([seed], rng=None)[1]["sharing_index"] for seed in networks]
    _, summary = stress_sharing(networks, resamples=400, rng=rng_of())
    assert_allclose(summary["sharing_index"], np.mean(single))
    assert summary["sharing_index_low"] < min(single) < max(single) < summary["sharing_index_high"]


def test_intervals_of_the_index_cover_the_truth():
    radius = (np.arange(400) + 0.5) / 400
    covered = 0
    for trial in range(100):
        rng = rng_of(trial)
        stress = radius * rng.standard_exponential((8, 400))
        _, summary = stress_sharing(
            [loaded(radius, seed) for seed in stress], resamples=300, rng=rng
        )
        covered += summary["sharing_index_low"] < 1.0 / 9.0 < summary["sharing_index_high"]
    # 95 expected; 4 standard deviations of 2.2.
    assert covered >= 86


def test_result_of_three_grains_known_by_hand():
    # Volumes 1, 1 and 8, stresses 1, 1 and 2: a fifth of the volume carries a ninth.
    packing = loaded([1.0, 1.0, 2.0], [1.0, 1.0, 2.0])
    tables, summary = stress_sharing_result([packing] * 2, [0.5, 1.5, 2.5], rng=rng_of())
    assert list(tables) == ["stress_by_radius", "stress_sharing"]
    by_radius, sharing = tables.values()
    assert by_radius["grains"].tolist() == [4, 2]
    assert_allclose(by_radius["stress_ratio"], [1.0 / 1.8, 2.0 / 1.8])
    assert_allclose(sharing["stress_share"][[20, 60, 100]], [1 / 9, 5 / 9, 1.0])
    # S rises to 1/9 at x = 0.2, and on to 1: x - S is a triangle of height 0.2 - 1/9.
    for name, expected in (
        ("coarse_half_stress_share", 1.0 - (1 / 9 + 3 / 8 * 8 / 9)),
        ("sharing_index", 0.2 - 1 / 9),
    ):
        assert_allclose([summary[name + part] for part in ("", "_low", "_high")], expected)
