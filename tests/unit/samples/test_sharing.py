"""What contact networks share, put together: every table, of every state, however few the data."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose
from pandas.testing import assert_frame_equal

from branchcrush.forces.distribution import THRESHOLDS
from branchcrush.samples.sharing import TABLES, shared_in_state, states_together
from branchcrush.statistics.bins import bin_edges
from tests.unit.samples.random_networks import EDGES, OPTIONS, RADII, sample, shared


def text(tables, summary):
    return [table.to_csv() for table in tables.values()] + [json.dumps(summary)]


def numbers(part, name=""):
    """Return all numbers of a summary by their path."""
    if isinstance(part, dict | list):
        items = part.items() if isinstance(part, dict) else enumerate(part)
        return {k: v for key, value in items for k, v in numbers(value, f"{name}.{key}").items()}
    return {} if isinstance(part, str) else {name: part}


@pytest.fixture(scope="module")
def made():
    return sample()


@pytest.fixture(scope="module")
def found(made):
    return shared(made)


# --- one state -----------------------------------------------------------------------------------


def test_a_state_has_every_table_and_every_part_of_the_summary(found):
    tables, summary = found
    assert set(tables) == set(TABLES)
    assert all(isinstance(table, pd.DataFrame) and len(table) for table in tables.values())
    assert set(summary) == {"shielding", "forces", "fabric", "stress"}
    assert set(summary["shielding"]) == {"grains", "branches", "grain_energy"}
    assert [tail["threshold"] for tail in summary["forces"]["tails"]] == list(THRESHOLDS)
    json.dumps(summary)


def test_every_part_is_told_of_the_networks_that_it_is_about():
    # Branches along x with forces of 1 N and no overlap, E = l^3: each part has an answer by hand.
    networks = [
        replace(
            network,
            overlap=0.0 * network.overlap,
            force=np.ones(network.force.size),
            energy=network.length**3,
            wall_overlap=0.0 * network.wall_overlap,
            wall_force=0.0 * network.wall_force,
            vector=network.length[:, None] * [1.0, 0.0, 0.0],
        )
        for network in sample(noise=False)
    ]
    tables, summary = shared(networks)
    # Equal forces: none is below the mean.
    assert summary["forces"]["share_below_mean"] == 0.0
    assert_allclose(summary["forces"]["by_length"]["exponent"], 0.0, atol=1e-9)
    # In bins of branch length, not in classes of radius.
    assert tables["force_by_length"]["branch_length_low_m"].tolist() == EDGES[:-1].tolist()
    assert tables["force_by_length"]["branch_length_high_m"].tolist() == EDGES[1:].tolist()
    # All parallel: a deviator of 1, of the branches and of the forces.
    assert tables["fabric"]["seed_number"].tolist() == [0, 1, 2, 3]
    assert_allclose(tables["fabric"][["deviator", "force_deviator"]], 1.0)
    assert_allclose(tables["fabric"]["expected_deviator"], 700**-0.5)
    # p_g V_g = R_g z_g/3: over the volume, in the class of each of the four radii.
    radius, contacts = (
        np.concatenate([getattr(one, name) for one in networks]) for name in ("radius", "contacts")
    )
    stress = radius * contacts / (4.0 * np.pi)
    mean = stress.sum() / (radius**3 / 3.0).sum()
    expected = [
        stress[radius == r].sum() / (radius[radius == r] ** 3 / 3.0).sum() / mean for r in RADII
    ]
    assert_allclose(tables["stress_by_radius"]["stress_ratio"], expected, rtol=1e-9)
    branches = summary["shielding"]["branches"]
    assert_allclose(branches["length_exponent"], 3.0, atol=1e-7)
    # Energy of each grain: half of what its branches hold, in every seed alike.
    held = np.concatenate(
        [
            np.bincount(one.i, one.length**3 / 2.0, 120)
            + np.bincount(one.j, one.length**3 / 2.0, 120)
            for one in networks
        ]
    )
    grains = tables["shielding_grains"]
    everyone = grains[grains["grains_counted"] == "all"]
    told = everyone["energy_per_grain"] * everyone["grains"]
    assert_allclose(np.nansum(told) * held.mean(), held.sum(), rtol=1e-9)


def test_stress_is_told_in_the_classes_that_were_given():
    networks = sample(radii=np.linspace(0.02, 1.0, 500))
    classes = np.array([0.02, 0.3, 0.4, 1.0])
    tables, _ = shared_in_state(networks, EDGES, classes, 1.0, **OPTIONS)
    assert tables["stress_by_radius"]["radius_low_m"].tolist() == classes[:-1].tolist()
    assert tables["stress_by_radius"]["radius_high_m"].tolist() == classes[1:].tolist()


def test_every_contact_is_in_every_table_of_contacts(found):
    tables, _ = found
    assert tables["force_distribution"]["contacts"].sum() == 4 * 700
    assert tables["force_by_length"]["branches"].sum() == 4 * 700
    assert tables["shielding_branches"]["branches"].sum() == 4 * 700
    assert tables["fabric"]["branches"].sum() == 4 * 700
    assert tables["stress_by_radius"]["grains"].sum() == 4 * 120


def test_energies_of_an_exact_power_law_have_its_exponents():
    _, summary = shared(sample(noise=False, exponent=2.5))
    branches = summary["shielding"]["branches"]
    assert_allclose(branches["length_exponent"], 2.5, atol=1e-7)
    assert_allclose(branches["shielding_exponent"], 0.0, atol=1e-7)


def test_the_contact_law_changes_the_energy_of_walls_alone(made, found):
    _, summary = found
    _, hertz = shared(made, exponent=1.5)
    changed = {k for k, value in numbers(hertz).items() if value != numbers(summary)[k]}
    parts = (".shielding.grains.energy", ".shielding.grain_energy.exponent")
    assert all(name.startswith(parts) for name in changed)
    assert all(any(name.startswith(part) for name in changed) for part in parts)


def test_same_input_gives_the_same_result_to_the_last_digit(made, found):
    assert text(*shared(made)) == text(*found)


def test_units_do_not_matter(made, found):
    networks = made
    scaled = [
        replace(
            network,
            radius=1e-3 * network.radius,
            overlap=1e-3 * network.overlap,
            force=1e4 * network.force,
            energy=10.0 * network.energy,
            wall_overlap=1e-3 * network.wall_overlap,
            wall_force=1e4 * network.wall_force,
        )
        for network in networks
    ]
    _, other = shared(scaled, 1e-3 * EDGES)
    expected = numbers(found[1])
    assert len(expected) > 60
    for name, value in numbers(other).items():
        assert_allclose(value, expected[name], rtol=1e-6, atol=1e-9, err_msg=name)


def test_order_of_seeds_leaves_the_estimates(made, found):
    networks = made
    _, other = shared(networks[::-1])
    expected = numbers(found[1])
    for name, value in numbers(other).items():
        if not name.endswith(("_low", "_high")):
            assert_allclose(value, expected[name], rtol=1e-7, atol=1e-10, err_msg=name)


# --- few data ------------------------------------------------------------------------------------


def test_one_seed_has_every_table_and_no_interval():
    tables, summary = shared(sample(seeds=1))
    assert set(tables) == set(TABLES)
    limits = {
        name: value
        for name, value in numbers(summary).items()
        if name.endswith(("_low", "_high")) and "by_chance" not in name
    }
    assert len(limits) > 20
    assert np.all(np.isnan(list(limits.values())))
    assert set(summary["shielding"]["grains"]) >= {"claim_per_contact", "grains"}


def test_grains_of_one_size_have_reasons_in_place_of_power_laws():
    networks = sample(radii=[0.5])
    tables, summary = shared(networks, bin_edges(0.5, 0.5))
    assert set(TABLES) - set(tables) == {"shielding_branches"}
    assert list(summary["shielding"]["branches"]) == ["reason"]
    assert list(summary["shielding"]["grain_energy"]) == ["reason"]
    assert summary["forces"]["by_length"] == {}
    assert_allclose(summary["stress"]["sharing_index"], 0.0, atol=1e-12)
    assert_allclose(tables["stress_by_radius"]["stress_ratio"], 1.0)
    whole, _ = states_together({("end", 3): (tables, summary)})
    assert list(whole["shielding_branches"]) == ["reason"]
    assert len(whole["shielding_branches"]) == 1


# --- two states ----------------------------------------------------------------------------------


def test_states_stand_one_after_the_other_with_their_names_and_numbers(found):
    other = shared(sample(seed=2, seeds=3))
    tables, summary = states_together({("near_jamming", 4): found, ("end", 17): other})
    assert list(tables) == list(TABLES)
    for name, table in tables.items():
        assert list(table)[:2] == ["where", "state"]
        for where, state, (parts, _) in (("near_jamming", 4, found), ("end", 17, other)):
            rows = table[(table["where"] == where) & (table["state"] == state)]
            rows = rows.drop(columns=["where", "state"]).reset_index(drop=True)
            assert_frame_equal(rows, parts[name], check_dtype=False)
        assert len(table) == len(found[0][name]) + len(other[0][name])
    assert list(summary) == ["near_jamming", "end"]
    assert summary["end"] == {"state": 17, **other[1]}
    assert summary["near_jamming"] == {"state": 4, **found[1]}


def test_a_table_that_one_state_lacks_has_that_of_the_other(found):
    lacking = {name: table for name, table in found[0].items() if name != "shielding_branches"}
    tables, _ = states_together({("near_jamming", 0): (lacking, {}), ("end", 1): found})
    assert set(tables["shielding_branches"]["where"]) == {"end"}
    assert len(tables["shielding_branches"]) == len(found[0]["shielding_branches"])
    assert set(tables["fabric"]["where"]) == {"near_jamming", "end"}
