"""Energies of grains far larger than their neighbours, by hand, and what they claim."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.energy.shielding_grains import grain_shielding
from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_energy
from tests.unit.energy.made_networks import network, packings

READINGS = ("contact", "grain", "volume")


def options(seed=1, resamples=300):
    return {"rng": np.random.default_rng(seed), "resamples": resamples}


def large_in_fines(per_contact, size=1.0, fine=0.1, fines=100, contacts=20):
    """One large grain and fines that touch each other and it; a fine contact holds 1."""
    pairs = [(k, k % fines + 1) for k in range(1, fines + 1)]
    pairs += [(0, k) for k in range(1, contacts + 1)]
    energy = [1.0] * fines + [per_contact] * contacts
    return network([size] + [fine] * fines, pairs, energy)


def test_energy_of_the_large_grain_over_the_mean_is_that_of_the_sums():
    _, found = grain_shielding([large_in_fines(0.5)] * 10, 1.0, **options())
    total, contacts = 100.0 + 20 * 0.5, 240.0
    large = 20 * 0.25
    assert found["neighbour_ratio_from"] == 10.0 and found["grains"] == 10
    assert_allclose(found["energy_per_contact"], (large / 20) / (total / contacts))
    assert_allclose(found["energy_per_grain"], large / (total / 101))
    assert_allclose(found["energy_per_volume"], large / (total / (1 + 100 * 0.1**3)))


@pytest.mark.parametrize(
    ("per_contact", "claims"),
    [
        (0.01, ["supported", "contradicted", "supported"]),
        (0.001, ["supported", "supported", "supported"]),
        (3.0, ["contradicted", "contradicted", "contradicted"]),
    ],
)
def test_claims_follow_the_intervals(per_contact, claims):
    _, found = grain_shielding([large_in_fines(per_contact)] * 10, 1.0, **options())
    assert [found[f"claim_per_{reading}"] for reading in READINGS] == claims


def test_claim_is_undecided_where_packings_disagree():
    made = [large_in_fines(per_contact) for per_contact in (1e-3, 1e-3, 0.4, 0.3, 1e-3)] * 2
    _, found = grain_shielding(made, 1.0, **options())
    assert found["energy_per_contact_low"] < 0.1 < found["energy_per_contact_high"]
    assert found["claim_per_contact"] == "undecided"


def test_ten_times_larger_but_for_rounding_is_ten_times_larger():
    # The mean of many radii of 0.1 is not 0.1 to the last digit.
    table, found = grain_shielding(
        [large_in_fines(1.0, contacts=n) for n in range(3, 60)], 1.0, **options()
    )
    assert found["grains_ten_times_larger"] == 57
    assert table["grains"][:12].tolist()[-2:] == [0, 57]


def test_without_grains_ten_times_larger_the_largest_are_given_and_no_claim():
    _, found = grain_shielding([large_in_fines(1.0, size=0.3)] * 10, 1.0, **options())
    assert {found[f"claim_per_{reading}"] for reading in READINGS} == {"no such grain"}
    assert found["neighbour_ratio_from"] == 2.5 and found["grains"] == 10
    assert found["grains_ten_times_larger"] == 0 and found["energy_per_grain"] > 1


def test_fewer_than_ten_such_grains_decide_nothing_and_are_shown_with_the_next_largest():
    made = [large_in_fines(3.0)] * 3 + [large_in_fines(3.0, size=0.6)] * 7
    _, found = grain_shielding(made, 1.0, **options())
    assert (found["grains_ten_times_larger"], found["grains"]) == (3, 10)
    assert found["neighbour_ratio_from"] == 5.0
    assert found["energy_per_contact_low"] > 0.1 and found["claim_per_contact"] == "undecided"


@pytest.mark.parametrize(("large", "claim"), [(9, "undecided"), (10, "contradicted")])
def test_ten_such_grains_decide(large, claim):
    made = [large_in_fines(3.0)] * large + [large_in_fines(3.0, size=0.6)] * (20 - large)
    _, found = grain_shielding(made, 1.0, **options())
    assert (found["grains_ten_times_larger"], found["claim_per_contact"]) == (large, claim)


def test_grains_that_are_judged_are_all_from_the_given_ratio_on():
    made = [large_in_fines(3.0)] * 3 + [large_in_fines(1.0, size=0.6)] * 7
    table, found = grain_shielding(made, 1.0, **options())
    above = (table["grains_counted"] == "all") & (table["neighbour_ratio_low"] >= 5.0)
    assert table["grains"][above].tolist() == [7, 3]
    mean = np.average(table["energy_per_grain"][above], weights=[7, 3])
    assert_allclose(found["energy_per_grain"], mean, rtol=1e-12)


def test_grains_without_neighbours_have_no_ratio_but_count_in_the_mean():
    alone = network([1.0, 1.0, 1.0, 1.0], [(0, 1)], [4.0], walls=[2], wall_energy=[1.0])
    table, found = grain_shielding([alone] * 2, 1.0, **options())
    assert table["grains"].sum() == 2 * 2  # no rattler among them is left out: see below
    assert_allclose(np.nansum(table["energy_per_grain"]), 2.0 / (5.0 / 4.0))
    # A contact with a wall is one of the three ends of contacts.
    assert_allclose(np.nansum(table["energy_per_contact"]), (4.0 / 2) / (5.0 / 3))
    assert found["largest_neighbour_ratio"] == 1.0


def test_rattlers_are_left_out_of_the_second_half_of_the_table():
    # A tetrahedron around a grain bears load, each corner held by a wall besides; one hangs on.
    pairs = [(a, b) for a in range(5) for b in range(a)] + [(0, 5)]
    table, _ = grain_shielding([network(np.ones(6), pairs, np.ones(11))] * 2, 1.0, **options())
    counts = {
        name: table["grains"][table["grains_counted"] == name].sum()
        for name in ("all", "load-bearing")
    }
    assert counts == {"all": 12, "load-bearing": 10}


def test_grains_do_not_know_the_units():
    made = [large_in_fines(x) for x in np.linspace(0.5, 2.0, 10)]
    scaled = [replace(one, radius=1e-3 * one.radius, energy=1e-7 * one.energy) for one in made]
    (table, found), (table_too, found_too) = (
        grain_shielding(networks, 1.5, **options()) for networks in (made, scaled)
    )
    assert found_too["claim_per_grain"] == found["claim_per_grain"]
    for name in table:
        if name != "grains_counted":
            assert_allclose(table_too[name], table[name], rtol=1e-9)


def test_ratios_of_all_classes_and_of_grains_without_neighbours_have_the_mean_of_all():
    made = packings(np.random.default_rng(2), 0.5, seeds=3, contacts=900)
    made = [replace(one, wall_grain=np.arange(800)[::3]) for one in made]
    walls = np.linspace(0.0, 0.1, 267)
    made = [replace(one, wall_overlap=walls, wall_force=walls) for one in made]
    table, _ = grain_shielding(made, 1.0, **options())
    every = table["grains_counted"] == "all"
    energy = np.concatenate([grain_energy(one, 1.0) for one in made])
    volume = np.concatenate([sphere_volume(one.radius) for one in made])
    alone = np.concatenate([one.contacts == 0 for one in made])
    filled = every & (table["grains"] > 0)
    assert 0 < alone.sum() == 2400 - table["grains"][every].sum()
    of_classes = table["energy_per_grain"][filled] @ table["grains"][filled] / 2400
    assert_allclose(of_classes + energy[alone].sum() / energy.sum(), 1.0, rtol=1e-12)
    # Energies of the classes over their volumes: those volumes are what the ratios give.
    held = table["energy_per_grain"][filled] * table["grains"][filled] * energy.sum() / 2400
    found = held / (table["energy_per_volume"][filled] * energy.sum() / volume.sum())
    assert_allclose(found.sum(), volume[~alone].sum(), rtol=1e-12)


def test_even_stress_alone_lowers_the_energy_per_volume_of_a_large_grain():
    # Contacts are on surfaces. A grain x times as large as fines that carry the same at each of
    # their contacts has x^2 as many: per contact nothing vanishes, per volume it has 1/x of theirs.
    x, fine = 20.0, 0.05
    chains = [(k, k + 1) for k in range(1, 20_000)]
    around = [(0, k) for k in range(1, int(2 * x**2) + 1)]
    one = network(
        np.append(x * fine, np.full(20_000, fine)),
        chains + around,
        np.ones(len(chains) + len(around)),
    )
    table, found = grain_shielding([one] * 10, 1.0, **options())
    assert_allclose(found["energy_per_contact"], 1.0, rtol=1e-12)
    fines = table["energy_per_volume"][table["neighbour_ratio_low"] == 1.0][0]
    assert_allclose(found["energy_per_volume"] / fines, 1.0 / x, rtol=1e-2)
