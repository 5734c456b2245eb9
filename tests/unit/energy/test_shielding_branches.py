"""Shielding that was put into the energies of branches is found again, and none where is none."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import stdtrit

from branchcrush.energy.shielding_branches import branch_shielding, network_branches
from branchcrush.errors import FitError
from tests.unit.energy.made_networks import packings


def options(seed=1, resamples=300):
    return {"rng": np.random.default_rng(seed), "resamples": resamples}


def branches(networks, radius_max=1.0):
    return [network_branches(one, radius_max) for one in networks]


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


@pytest.mark.parametrize(
    ("unequal", "claim"),
    [((10, 10, 9), "undecided"), ((10, 10, 10), "contradicted"), ((0, 0, 0), "no such branch")],
)
def test_thirty_branches_as_unequal_as_the_claim_answer_it(unequal, claim):
    # Lengths from 1 to 2 whatever the ratio, and E = l^3 exactly: nothing is shielded.
    seeds = []
    for few in unequal:
        # Those of 0.15 are not as unequal, however many.
        numbers = (few, 50, 100, 100)
        ratio = np.repeat([0.08, 0.15, 0.5, 0.97], numbers)
        length = np.concatenate([np.linspace(1.0, 2.0, n) for n in numbers])
        large = np.log(length / (1.0 + ratio))
        seeds.append((large + np.log(ratio), large, length**3))
    table, summary = branch_shielding(seeds, **options())
    assert summary["claim"] == claim
    assert table["branches"][1] == sum(unequal)


def test_a_radius_ratio_on_an_edge_is_in_the_bin_below():
    rng = np.random.default_rng(12)
    large = np.log(rng.uniform(0.5, 1.0, 400))
    ratio = np.tile([0.1, 0.3, 0.7, 1.0], 100)
    table, _ = branch_shielding([(large + np.log(ratio), large, np.exp(large))] * 2, **options())
    assert table["radius_ratio_high"][[1, 3, 7, 10]].tolist() == [0.1, 0.3, 0.7, 1.0]
    assert table["branches"].tolist() == [0, 200, 0, 200, 0, 0, 0, 200, 0, 0, 200]
    assert_allclose(table["mean_radius_ratio"][[1, 3, 7, 10]], [0.1, 0.3, 0.7, 1.0])


def test_law_of_equal_lengths_is_that_of_narrow_bins():
    # Ratios rise with the length, from 0.1 to 1, and E = l^3 exactly. In wide bins of length the
    # unequal branches of each would seem to hold less than they should.
    ratio = np.linspace(0.11, 1.0, 3000)
    large = np.log(np.geomspace(0.3, 2.0, 3000) / (1.0 + ratio))
    seeds = [(large + np.log(ratio), large, np.geomspace(0.3, 2.0, 3000) ** 3)] * 2
    table, _ = branch_shielding(seeds, **options())
    assert_allclose(table["energy_ratio"][2:], 1.0, atol=0.01)
