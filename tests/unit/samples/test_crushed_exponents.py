"""The energy split while grains break, who carries load by size, and the rule's results together.

Of networks whose answers are counted by hand.
"""

from itertools import combinations

import numpy as np
import pandas as pd
import pytest

from branchcrush.packings.network import Network
from branchcrush.samples.crushed_exponents import (
    exponent_of,
    exponents_beside_control,
    load_by_radius,
)
from branchcrush.samples.crushed_grains import crushed_grains
from tests.unit.samples.test_crushed_who import NO_WALLS, run

OPTIONS = {"confidence": 0.95, "resamples": 50}


def network(radius, i, j, force, energy, wall=()):
    grain, wall_force = (np.array(part) for part in zip(*wall, strict=True)) if wall else ([], [])
    return Network(
        *(np.asarray(part) for part in (radius, i, j)),
        np.full(len(i), 0.01),
        *(np.asarray(part, dtype=float) for part in (force, energy)),
        np.asarray(grain, dtype=int),
        np.full(len(grain), 0.01),
        np.asarray(wall_force, dtype=float),
    )


def power_law(exponent, seed=1, branches=150):
    """Return a network whose branches have the energy l^n, exactly."""
    rng = np.random.default_rng(seed)
    radius = rng.uniform(0.5, 2.0, 60)
    i, j = rng.permuted(np.tile(np.arange(60), (branches, 1)), axis=1)[:, :2].T
    energy = (radius[i] + radius[j]) ** exponent
    return network(radius, i, j, np.ones(branches), energy)


@pytest.mark.parametrize("n", [1.5, 3.0])
def test_the_exponent_of_a_power_law_is_found(n):
    found = exponent_of([power_law(n, seed) for seed in (1, 2, 3)], **OPTIONS)
    assert found.estimate == pytest.approx(n, abs=1e-6)


def test_few_branches_and_equal_ones_bear_no_exponent():
    assert np.isnan(exponent_of([power_law(3.0, branches=99)], **OPTIONS).estimate)
    one = power_law(3.0)
    equal = network(np.ones(60), one.i, one.j, one.force, np.ones(one.i.size))
    assert np.isnan(exponent_of([equal], **OPTIONS).estimate)


def path(densities, carries=True):
    return pd.DataFrame(
        {
            "state": range(1, len(densities) + 1),
            "leg": "loading",
            "solid_fraction": densities,
            "carries_load": carries,
            "broken_mass_fraction": 0.1,
            "coordination_number": 4.0,
            "mechanical_coordination_number": 6.0,
            "rattler_fraction": 0.3,
        }
    )


def test_the_control_stands_beside_states_of_equal_solid_fraction_alone():
    crushed = [{1: power_law(2.0), 2: power_law(2.5)}]
    control = [{1: power_law(3.0), 2: power_law(3.5)}]
    paths, controls = [path([0.66, 0.70])], [path([0.66, 0.71])]
    table = exponents_beside_control(crushed, control, paths, controls, **OPTIONS)
    assert table["exponent"].tolist() == pytest.approx([2.0, 2.5], abs=1e-6)
    assert table["control_exponent"].iloc[0] == pytest.approx(3.0, abs=1e-6)
    assert np.isnan(table["control_exponent"].iloc[1])
    assert table["branches"].tolist() == [150, 150]
    assert table["control_rattler_fraction"].iloc[0] == 0.3


def test_only_loaded_states_of_all_seeds_bear_an_exponent():
    crushed = [{1: power_law(2.0), 2: power_law(2.0)}] * 2
    paths = [path([0.66, 0.70]), path([0.66, 0.70], [False, True])]
    table = exponents_beside_control(crushed, crushed, paths, paths, **OPTIONS)
    assert table["state"].tolist() == [2]


def test_loads_by_size_are_counted_by_hand():
    # Four first grains of diameter 4 and a fragment of 2, each touching all others, and one
    # fragment of 2 that touches nothing but a wall: a rattler.
    pairs = list(combinations(range(5), 2))
    i, j = zip(*pairs, strict=True)
    force = [1.0 + 4 * (4 in pair) for pair in pairs]
    made = network([2.0] * 4 + [1.0] * 2, i, j, force, force, wall=[(0, 9.0), (5, 50.0)])
    table = load_by_radius([made], [np.arange(6) < 4], limit=1.0, **OPTIONS)
    first = table[table["kind"] == "first grains"].iloc[0]
    assert (first["low"], first["high"], first["grains"]) == (4.0, 8.0, 4)
    assert (first["rattlers"], first["contacts"]) == (0.0, (5 + 3 * 4) / 4)
    assert first["largest_force_N"] == pytest.approx((9.0 + 3 * 5.0) / 4)
    fragments = table[table["kind"] == "fragments"].iloc[0]
    assert (fragments["low"], fragments["grains"], fragments["rattlers"]) == (2.0, 2, 0.5)
    # The force of the rattler is in no mean of those that bear load.
    assert fragments["largest_force_N"] == 5.0


def of_run(broken):
    grains, contacts = run()
    if not broken:
        grains, contacts = (t[t["state"] == 0] for t in (grains, contacts))
        grains, contacts = (
            pd.concat([t.assign(state=state) for state in range(3)]) for t in (grains, contacts)
        )
    crushing = path([0.60, 0.65, 0.70]).assign(state=range(3))
    rows = [0, 1] if broken else []
    breakages = pd.DataFrame(
        {"radius_m": [1.0, 2.0], "stress_Pa": [11.0, 9.0], "strength_Pa": 10.0}
    ).iloc[rows]
    return crushing, grains, contacts, NO_WALLS, breakages


def results(broken):
    grains, contacts = run()
    radii = grains.loc[grains["state"] == 0, "radius_m"].to_numpy()
    control = path([0.60, 0.65, 0.70]).assign(state=range(3)), radii, contacts.iloc[:0], NO_WALLS
    rules = {"smallest_diameter": 1.0, "size_exponent": 0.5}
    given = lambda _: of_run(broken), lambda _: control
    return crushed_grains([4, 9], *given, rules, **OPTIONS)


def test_the_tables_of_a_crushing_are_of_all_its_seeds():
    found = results(broken=True)
    summary = found.summary
    assert (summary["seeds"], summary["comminution_limit_m"]) == ([4, 9], 1.0)
    assert (summary["breakages"], summary["breakages_seen_in_a_state"]) == (4, 4)
    assert summary["sentences"][0].startswith("4 grains broke (2 seeds, comminution limit 1e+03 mm")
    whole = found.hazards[(found.hazards["group"] == "all") & (found.hazards["by"] == "radius")]
    assert whole["breakages"].sum() == 4
    below = found.overshoots.iloc[0]
    assert (below["breakages"], below["below"]) == (4, 2)
    assert below["size_exponent_asked"] == 0.5
    assert found.loads["grains"].sum() == 2 * 4  # of the last state of both


def test_a_crushing_where_no_grain_broke_says_so():
    found = results(broken=False)
    assert found.summary["breakages"] == 0
    assert found.summary["sentences"] == [
        "No grain broke between saved states: nothing is told of who breaks."
    ]
    assert found.hazards.empty and found.overshoots.empty
