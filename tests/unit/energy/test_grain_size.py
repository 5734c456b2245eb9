"""Energies of grains that are a power of the radius: the power is found, and what rattlers do."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.energy.grain_size import EINAV, grain_energy_exponents
from branchcrush.errors import FitError
from branchcrush.packings.network import Network

NONE = np.zeros(0, dtype=int)
FEW = {"resamples": 100}


def rng_of(*seed):
    return np.random.default_rng(seed or 1)


def held(radius, energy, contact_exponent=1.0, walls=4):
    """Grains that walls press and hold with the given energy each; three walls hold none."""
    radius, number = np.asarray(radius, float), np.broadcast_to(walls, np.shape(radius))
    wall = np.repeat(np.arange(radius.size), number)
    force = (np.asarray(energy) / np.maximum(number, 1))[wall] * (contact_exponent + 1.0)
    nothing = np.zeros(0)
    return Network(radius, NONE, NONE, nothing, nothing, nothing, wall, np.ones(wall.size), force)


def radii(rng, grains=300):
    return np.append([0.1, 1.0], rng.uniform(0.1, 1.0, grains - 2))


def exponents(found, name):
    return [found[f"exponent_{name}{part}"] for part in ("", "_low", "_high")]


# --- exact ---------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=40)
@given(
    exponent=st.floats(-1.0, 6.0),
    contact_exponent=st.sampled_from([1.0, 1.5]),
    unit=st.sampled_from([1e-6, 1e-3, 1.0, 1e3]),
    scale=st.sampled_from([1e-12, 1.0, 1e9]),
    seed=st.integers(0, 2**32),
)
def test_an_exact_power_of_the_radius_is_found_whatever_the_units(
    exponent, contact_exponent, unit, scale, seed
):
    rng = rng_of(seed)
    packings = [
        held(unit * radius, scale * radius**exponent, contact_exponent)
        for radius in (radii(rng, 30), radii(rng, 50))
    ]
    found = grain_energy_exponents(packings, contact_exponent, rng=rng, **FEW)
    assert_allclose(list(found.values()), exponent, rtol=0, atol=1e-7)


def test_pairs_of_equal_grains_have_the_exponent_of_their_contacts():
    # Each grain has half of four contacts with its like, and no walls.
    radius = np.repeat(radii(rng_of()), 2)
    i = np.repeat(np.arange(0, radius.size, 2), 4)
    zeros = 0.0 * i
    packing = held(radius, 0.0 * radius, walls=0)
    packing = replace(packing, i=i, j=i + 1, overlap=zeros, force=zeros, energy=radius[i] ** EINAV)
    found = grain_energy_exponents([packing], 1.5, rng=None)
    assert_allclose(exponents(found, "load_bearing")[0], 5.0, atol=1e-7)
    assert_allclose(exponents(found, "all_grains")[0], 5.0, atol=1e-7)


def test_packings_of_the_same_radii_may_each_have_a_scale_of_their_own():
    radius = radii(rng_of())
    packings = [held(radius, scale * radius**3) for scale in (1.0, 5.0, 0.02)]
    found = grain_energy_exponents(packings, 1.0, rng=rng_of(), **FEW)
    for name in ("all_grains", "load_bearing"):
        assert_allclose(exponents(found, name), 3.0, atol=1e-6)


# --- noise ---------------------------------------------------------------------------------------


def noisy(rng, exponent, seeds=8):
    for _ in range(seeds):
        radius = radii(rng, 100)
        noise = rng.standard_exponential(radius.size) * rng.uniform(0.5, 2.0)
        yield held(radius, radius**exponent * noise, walls=rng.choice([3, 4, 5], radius.size))


def test_intervals_cover_the_exponent_as_often_as_they_should():
    trials, covered = 200, {"all_grains": 0, "load_bearing": 0}
    for trial in range(trials):
        rng = rng_of(trial, 7)
        exponent = rng.uniform(1.0, 6.0)
        found = grain_energy_exponents(list(noisy(rng, exponent)), 1.0, rng=rng, resamples=200)
        for name in covered:
            _, low, high = exponents(found, name)
            covered[name] += low < exponent < high
    # Eight packings cover a little less than 95 %: 187 expected; 4 standard deviations of 3.5.
    assert all(number >= 173 for number in covered.values())


def test_one_packing_has_an_exponent_without_an_interval():
    found = grain_energy_exponents(list(noisy(rng_of(), 3.0, seeds=1)), 1.0, rng=rng_of())
    for name in ("all_grains", "load_bearing"):
        estimate, low, high = exponents(found, name)
        assert np.isfinite(estimate) and np.isnan(low) and np.isnan(high)


def test_order_of_packings_and_of_grains_leaves_the_exponents():
    packings = list(noisy(rng_of(), 3.0, seeds=4))
    found = grain_energy_exponents(packings, 1.0, rng=rng_of(), **FEW)
    other = []
    for packing in packings[::-1]:
        order = rng_of(2).permutation(packing.radius.size)
        places = np.argsort(order)
        other.append(
            replace(packing, radius=packing.radius[order], wall_grain=places[packing.wall_grain])
        )
    same = grain_energy_exponents(other, 1.0, rng=rng_of(), **FEW)
    for name in ("exponent_all_grains", "exponent_load_bearing"):
        assert_allclose(same[name], found[name], rtol=1e-7)


# --- rattlers ------------------------------------------------------------------------------------


def test_rattlers_count_with_nothing_in_the_exponent_of_all_grains_alone():
    # Of 100 grains of a radius so many are held as that the mean energy of all has another power.
    values = np.array([0.1, 0.2, 0.5, 1.0])
    number = np.array([10, 20, 50, 100])
    radius = np.repeat(values, 100)
    bearing = (np.arange(100) < number[:, None]).ravel()
    packing = held(radius, radius**3 * bearing, walls=np.where(bearing, 4, 0))
    assert np.array_equal(packing.rattlers, ~bearing)
    found = grain_energy_exponents([packing] * 2, 1.0, rng=rng_of(), **FEW)
    assert_allclose(exponents(found, "load_bearing"), 3.0, atol=1e-7)
    assert_allclose(exponents(found, "all_grains"), 4.0, atol=1e-7)


def test_energy_of_rattlers_counts_among_all_grains_and_not_among_the_load_bearing():
    radius = np.tile(radii(rng_of()), 2)
    loose = np.repeat([False, True], radius.size // 2)
    energy = radius ** np.where(loose, 1.0, 4.0)
    packing = held(radius, energy, walls=np.where(loose, 3, 4))
    found = grain_energy_exponents([packing], 1.0, rng=None)
    assert_allclose(found["exponent_load_bearing"], 4.0, atol=1e-7)
    assert 1.1 < found["exponent_all_grains"] < 3.9


@pytest.mark.parametrize(
    "packing",
    [
        held(np.ones(10), np.ones(10)),
        held([1.0, 2.0, 3.0], [1.0, 8.0, 27.0], walls=3),
        held([1.0, 2.0, 3.0], np.zeros(3)),
    ],
    ids=["one radius", "rattlers only", "no energy"],
)
def test_grains_of_one_radius_or_without_load_have_no_exponent(packing):
    with pytest.raises(FitError):
        grain_energy_exponents([packing] * 3, 1.0, rng=rng_of(), **FEW)
