"""What contact networks share, put together: every table, of every state, however few the data."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose
from pandas.testing import assert_frame_equal

from branchcrush.branches.contact_numbers import radius_classes
from branchcrush.energy.shielding_grains import grain_shielding
from branchcrush.forces.distribution import THRESHOLDS, force_tail, relative_forces
from branchcrush.forces.fabric import fabric_result
from branchcrush.forces.stress import stress_sharing
from branchcrush.packings.network import Network
from branchcrush.samples.sharing import TABLES, shared_in_state, states_together
from branchcrush.statistics.bins import bin_edges

OPTIONS = {"confidence": 0.95, "resamples": 100}
# Few sizes: the mean of l^n over a bin is not the mean of l to the n.
RADII = [0.02, 0.11, 0.5, 1.0]
EDGES = bin_edges(0.02, 1.0)


def sample(seed=1, seeds=4, radii=RADII, exponent=3.0, noise=True):
    """Return networks of grains that touch at random, E = l^n times noise."""
    rng, networks = np.random.default_rng(seed), []
    for _ in range(seeds):
        radius = rng.choice(radii, 120)
        i = rng.integers(0, 120, 700)
        j = (i + rng.integers(1, 120, 700)) % 120
        length = radius[i] + radius[j]
        energy = length**exponent * (rng.standard_exponential(700) if noise else 1.0)
        overlap, wall = 0.01 * np.minimum(radius[i], radius[j]), rng.integers(0, 120, 30)
        along = rng.standard_normal((700, 3))
        networks.append(
            Network(
                radius,
                i,
                j,
                overlap,
                2.0 * energy / overlap,
                energy,
                wall,
                0.01 * radius[wall],
                radius[wall] ** 2,
                along * (length / np.linalg.norm(along, axis=1))[:, None],
            )
        )
    return networks


def classes_of(networks):
    radii, contacts = (
        np.concatenate([getattr(one, name) for one in networks]) for name in ("radius", "contacts")
    )
    return radius_classes(radii, contacts)


def shared(networks, edges=EDGES, exponent=1.0):
    classes = classes_of(networks)
    return shared_in_state(networks, edges, classes, exponent, **OPTIONS)


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


def test_numbers_are_those_of_the_parts(made, found):
    networks, (tables, summary) = made, found
    rng = np.random.default_rng(1)
    forces = [network.force for network in networks]
    rows, fabric = fabric_result([network.vector for network in networks], forces)
    assert summary["fabric"] == fabric
    assert tables["fabric"]["force_deviator"].tolist() == [row["force_deviator"] for row in rows]
    assert tables["fabric"]["seed_number"].tolist() == [0, 1, 2, 3]
    _, stress = stress_sharing(networks, rng=rng)
    assert summary["stress"]["sharing_index"] == stress["sharing_index"]
    _, grains = grain_shielding(networks, 1.0, rng=rng)
    assert summary["shielding"]["grains"]["energy_per_grain"] == grains["energy_per_grain"]
    for tail in summary["forces"]["tails"]:
        expected = force_tail([relative_forces(f) for f in forces], tail["threshold"], rng=rng)
        assert tail["decay_rate"] == expected["decay_rate"]


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
