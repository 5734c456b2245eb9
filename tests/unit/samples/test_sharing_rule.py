"""Rule sharing: which seeds and states are read, and what is said where there are none."""

import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.gradings.mixtures import from_radii
from branchcrush.samples.sharing import TABLES, sharing_results
from tests.unit.samples.random_networks import OPTIONS, RADII, sample, shared

RULE = {"bins": 20, **OPTIONS}


@pytest.fixture(scope="module")
def made():
    return sample()


def tables_of(network, states):
    """Return the contacts and wall contacts of a network, the same in each of some states."""
    contacts = pd.DataFrame(
        {
            "i": network.i,
            "j": network.j,
            "overlap_m": network.overlap,
            "normal_force_N": network.force,
            "energy_J": network.energy,
            **{f"branch_{axis}": network.vector[:, k] for k, axis in enumerate("xyz")},
        }
    )
    walls = pd.DataFrame(
        {
            "i": network.wall_grain,
            "overlap_m": network.wall_overlap,
            "normal_force_N": network.wall_force,
        }
    )
    return tuple(
        pd.concat([table.assign(state=state) for state in states], ignore_index=True)
        for table in (contacts, walls)
    )


def rule_on(networks, states, certified=(True, False, True, True)):
    """Return what the rule makes of the networks, the same in each state, and the seeds read."""
    read = []

    def read_seed(number, wanted):
        read.append((number, wanted))
        return networks[number].radius, *tables_of(networks[number], states)

    path = pd.DataFrame({"state": states, "leg": "loading", "carries_load": True})
    path["solid_fraction"] = 0.7
    parts = [path.assign(seed=seed, certified=one) for seed, one in enumerate(certified)]
    certificate = pd.concat(parts, ignore_index=True)
    grading = from_radii(RADII)
    return *sharing_results(grading, 1.0, certificate, [path] * 4, read_seed, **RULE), read


def test_rule_reads_the_certified_seeds_one_by_one_and_tells_of_two_states(made):
    tables, summary, read = rule_on(made, [3, 5, 8])
    assert read == [(0, [3, 8]), (2, [3, 8]), (3, [3, 8])]
    assert list(tables) == list(TABLES)
    assert [(where, part["state"]) for where, part in summary.items()] == [
        ("near_jamming", 3),
        ("end", 8),
    ]
    fabric = tables["fabric"]
    assert fabric["where"].tolist() == ["near_jamming"] * 3 + ["end"] * 3
    assert fabric["branches"].tolist() == [700] * 6
    expected, _ = shared([made[number] for number in (0, 2, 3)])
    told = fabric.loc[fabric["where"] == "end", "deviator"]
    assert_allclose(told, expected["fabric"]["deviator"], rtol=1e-12)


def test_rule_tells_one_state_as_the_end_alone(made):
    tables, summary, _ = rule_on(made, [8])
    assert list(summary) == ["end"]
    for table in tables.values():
        assert set(table["where"]) == {"end"}


def test_rule_without_a_certified_seed_says_why_and_reads_nothing(made):
    tables, summary, read = rule_on(made, [3, 8], certified=[False] * 4)
    assert read == []
    assert list(summary) == ["reason"]
    assert summary["reason"].startswith("no packing is certified at the end of its loading")
    assert tables == {name: {"reason": [summary["reason"]]} for name in TABLES}
