"""Shielding that was put into the energies is found again, and none where there is none."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import stdtrit

from branchcrush.energy.shielding import branch_shielding, grain_shielding, network_branches
from branchcrush.errors import FitError
from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_energy
from branchcrush.packings.network import Network

READINGS = ("contact", "grain", "volume")


def options(seed=1, resamples=300):
    return {"rng": np.random.default_rng(seed), "resamples": resamples}


def network(radius, pairs, energy, walls=(), wall_energy=()):
    """Contacts with given energies; a wall's of exponent 1 holds F d/2."""
    i, j = np.array(pairs, dtype=int).reshape(-1, 2).T
    radius, energy = np.asarray(radius, float), np.asarray(energy, float)
    ones = np.ones(len(walls))
    held = 2.0 * np.asarray(wall_energy, float) * ones
    return Network(
        radius, i, j, 0.0 * energy, 0.0 * energy, energy, np.array(walls, int), ones, held
    )


def packings(rng, s, n=3.0, seeds=8, contacts=4000, smallest=0.05):
    """Pairs of grains at random, E = l^n q^s times gamma noise and a factor of each packing."""
    found = []
    for _ in range(seeds):
        radius = rng.uniform(smallest, 1.0, 800)
        i = rng.integers(0, 800, contacts)
        j = (i + rng.integers(1, 800, contacts)) % 800
        first, second = radius[i], radius[j]
        mean = (first + second) ** n * (np.minimum(first, second) / np.maximum(first, second)) ** s
        energy = mean * rng.gamma(1.0, 1.0, contacts) * rng.uniform(0.8, 1.2)
        found.append(network(radius, np.stack([i, j], axis=1), energy))
    return found


def branches(networks, radius_max=1.0):
    return [network_branches(one, radius_max) for one in networks]


# --- branches ------------------------------------------------------------------------------------


@pytest.mark.parametrize("s", [0.0, 0.7, 1.5])
def test_interval_contains_the_known_shielding_exponent_for_most_seeds(s):
    inside = []
    for seed in range(12):
        seeds = branches(packings(np.random.default_rng([seed, int(10 * s)]), s, contacts=1500))
        found = branch_shielding(seeds, **options(resamples=200))[1]
        inside.append(
            [
                found["shielding_exponent_low"] < s < found["shielding_exponent_high"],
                found["length_exponent_low"] < 3.0 < found["length_exponent_high"],
            ]
        )
    # 95 % each: fewer than 8 of 12 is one in thousands.
    assert np.all(np.sum(inside, axis=0) >= 8)


def test_without_shielding_every_ratio_is_one_within_its_interval():
    inside, used = 0, 0
    for seed in range(8):
        table, found = branch_shielding(
            branches(packings(np.random.default_rng(seed), 0.0)), **options(seed)
        )
        many = table["branches"] > 100
        inside += ((table["energy_ratio_low"] < 1) & (table["energy_ratio_high"] > 1))[many].sum()
        used += many.sum()
        assert found["claim"] == "contradicted"
    assert inside > 0.8 * used


def test_ratios_fall_as_the_known_shielding_does():
    # Of equal lengths, so that the fit of A l^n takes nothing of the shielding.
    rng = np.random.default_rng(5)
    ratio = rng.uniform(0.01, 1.0, (6, 20000))
    large = 1.0 / (1.0 + ratio) * rng.choice([1.0, 1.5], ratio.shape)
    energy = (large * (1.0 + ratio)) ** 3 * ratio * rng.gamma(1.0, 1.0, ratio.shape)
    seeds = [(np.log(q * g), np.log(g), e) for q, g, e in zip(ratio, large, energy, strict=True)]
    table, found = branch_shielding(seeds, **options())
    assert_allclose(table["energy_ratio"], table["mean_radius_ratio"] / ratio.mean(), rtol=0.1)
    # Branches up to 0.1 hold 0.055 of the mean over those near 1, 0.95; five standard errors.
    assert_allclose(found["unequal_over_equal"], 0.055 / 0.95, rtol=0.08)
    assert (found["claim"], found["radius_ratio_to"]) == ("supported", 0.1)


def test_draws_refit_amplitude_and_exponent():
    # Two packings without shielding, of different exponents: in a draw of one of them twice every
    # ratio is 1 with its own law, and far from it with that of both, as lengths go with ratios.
    ratio = np.linspace(0.02, 0.98, 4000)
    seeds = [(np.log(ratio), np.zeros(4000), (1.0 + ratio) ** n) for n in (1.0, 5.0)]
    table, _ = branch_shielding(seeds, **options())
    spread = (table["energy_ratio_high"] - table["energy_ratio_low"]) / 2.0 / stdtrit(1, 0.975)
    off = np.abs(table["energy_ratio"] - 1.0)
    # Half of all draws are of both packings: the deviation over the draws is half of that of their
    # estimate, times sqrt(2).
    assert_allclose(spread, off / np.sqrt(2.0), atol=0.02)


def test_branches_do_not_know_the_unit_of_length_or_energy_or_the_order_of_seeds():
    made = packings(np.random.default_rng(3), 1.0, seeds=4, contacts=1000)
    in_micro = [replace(one, radius=1e-3 * one.radius, energy=1e-9 * one.energy) for one in made]
    turned = [replace(one, i=one.j, j=one.i) for one in made]
    table, found = branch_shielding(branches(made), **options())
    for others, scale in ((in_micro, 1e-3), (turned, 1.0)):
        table_too, found_too = branch_shielding(branches(others, scale), **options())
        for name in table:
            assert_allclose(table_too[name], table[name], rtol=1e-5, atol=1e-12)
        assert found_too.pop("claim") == found["claim"]
        assert_allclose(list(found_too.values()), [found[k] for k in found_too], rtol=1e-5)
    turned_round = branch_shielding(branches(made[::-1]), **options())
    assert_allclose(turned_round[0]["energy_ratio"], table["energy_ratio"], rtol=1e-6)


def test_few_unequal_branches_are_counted_and_answer_nothing():
    seeds = branches(packings(np.random.default_rng(4), 3.0, smallest=0.3))
    _, none = branch_shielding(seeds, **options())
    assert none["claim"] == "no such branch"
    assert none["radius_ratio_to"] == 0.4 and none["unequal_branches"] >= 10
    few = [*seeds[1:], tuple(np.append(a, b) for a, b in zip(seeds[0], (-3, 0, 1e-5), strict=True))]
    _, found = branch_shielding(few, **options())
    assert found["claim"] == "undecided"
    assert found["unequal_over_equal_high"] < 0.1


def test_a_ratio_of_ten_but_for_rounding_is_one_of_ten():
    small = np.nextafter(np.log(0.1), 0)  # r_min/r_max just above 0.1
    rng = np.random.default_rng(6)
    seeds = []
    for _ in range(3):
        large = np.log(rng.uniform(0.5, 1.0, 60))
        below = np.where(np.arange(60) < 20, small, -0.02)
        seeds.append((large + below, large, np.ones(60)))
    table, found = branch_shielding(seeds, **options())
    assert (table["branches"][1], found["unequal_branches"]) == (60, 60)


def test_one_seed_has_no_interval_and_decides_nothing():
    _, found = branch_shielding(
        branches(packings(np.random.default_rng(1), 0.0, seeds=1)), **options()
    )
    assert np.isnan(found["shielding_exponent_low"]) and found["claim"] == "undecided"


def test_two_sizes_of_which_the_large_are_apart_cannot_tell_length_from_ratio():
    # All branches are of 0.2 with a ratio of 1, or of 1.1 with a ratio of 0.1.
    small, large = np.log([0.1, 0.1, 0.1]), np.log([0.1, 1.0, 1.0])
    with pytest.raises(FitError, match="tell the parameters apart"):
        branch_shielding([(small, large, np.array([1.0, 2.0, 3.0]))] * 3, **options())


def test_seeds_without_branches_have_no_fit():
    nothing = (np.zeros(0),) * 3
    some = branches(packings(np.random.default_rng(8), 1.0, seeds=1))
    for seeds in ([nothing], [nothing] * 2, [*some, nothing]):
        # Of the last a draw may be twice the one without.
        with pytest.raises(FitError, match="finite energy"):
            branch_shielding(seeds, **options())


def test_ratios_are_over_what_all_branches_hold_on_average():
    # Two ratios of the same lengths: what is expected of both is the same, so their mean is 1.
    rng = np.random.default_rng(9)
    ratio = np.repeat([0.35, 0.95], 300)
    seeds = []
    for length in np.tile(rng.uniform(0.2, 1.0, (3, 300)), 2):
        large = np.log(length / (1.0 + ratio))
        energy = length**3 * ratio * rng.standard_exponential(600)
        seeds.append((large + np.log(ratio), large, energy))
    table, _ = branch_shielding(seeds, **options())
    assert table["branches"][[4, 10]].tolist() == [900, 900]
    assert_allclose(table["energy_ratio"][[4, 10]].mean(), 1.0, rtol=1e-9)


# --- grains --------------------------------------------------------------------------------------


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
