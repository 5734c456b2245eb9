"""Force chains: known by hand, and what holds of any packing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.forces.chains import FEWEST_GRAINS, force_chains, grain_stress
from branchcrush.packings.grains import grain_stress_volume
from branchcrush.packings.network import Network

NONE = np.zeros(0)


def row(count, forces, turn=0.0, aside=4):
    """Return grains of radius 1 that walls press along a line, and others that are only held.

    The line turns by an angle in its middle.
    """
    angles = np.where(np.arange(count - 1) < (count - 1) // 2, 0.0, np.radians(turn))
    vectors = 2.0 * np.column_stack([np.cos(angles), np.sin(angles), 0.0 * angles])
    held = np.repeat(np.arange(count + aside), 4)
    ends = vectors[[0, -1]] / 2.0 * [[-1.0], [1.0]]
    walls = np.concatenate([ends, np.tile([0.0, 0.0, 1.0], (held.size, 1))])
    wall_force = np.r_[np.broadcast_to(forces, count - 1)[[0, -1]], np.full(held.size, 0.01)]
    i = np.arange(count - 1)
    force = np.broadcast_to(np.asarray(forces, dtype=float), count - 1).copy()
    network = Network(
        np.ones(count + aside), i, i + 1, np.zeros(i.size), force, force,
        np.r_[0, count - 1, held], np.zeros(wall_force.size), wall_force, vectors,
    )  # fmt: skip
    return network, walls


def test_a_row_that_is_pressed_is_one_chain():
    chains = force_chains(*row(6, 1.0))
    assert chains.contacts.tolist() == [0, 1, 2, 3, 4]
    assert set(chains.chain) == {0}
    assert set(chains.grains) == {6}


def test_a_pair_is_too_short_for_a_chain():
    assert FEWEST_GRAINS == 3
    assert not force_chains(*row(2, 1.0)).contacts.size
    assert force_chains(*row(3, 1.0)).contacts.size == 2


@pytest.mark.parametrize(("turn", "links"), [(30.0, [0, 1, 2, 3]), (80.0, [0, 1])])
def test_a_chain_ends_where_a_branch_is_too_far_from_the_major_direction(turn, links):
    # By hand: of forces 1 and 0.7 at 30 and 80 degrees it is 12.1 and 17.5 degrees off the first.
    assert force_chains(*row(5, [1.0, 1.0, 0.7, 0.7], turn)).contacts.tolist() == links


def test_a_weak_link_parts_two_chains():
    network, walls = row(7, [1, 1, 1e-6, 1e-6, 1, 1])
    # The ends beside the weak link are held by walls, or would not be at rest; here they feel half.
    chains = force_chains(network, walls)
    assert set(chains.chain) <= {0, 1}
    assert not {2, 3} & set(chains.contacts.tolist())


def test_without_load_there_is_no_chain_and_without_vectors_an_error():
    network, walls = row(4, 1.0)
    nothing = Network(
        np.ones(2), *2 * [NONE.astype(int)], *3 * [NONE], NONE.astype(int), NONE, NONE
    )
    assert not force_chains(nothing).contacts.size
    with pytest.raises(ValueError, match="directions of walls"):
        grain_stress(network)
    assert grain_stress(network, walls).shape == (8, 3, 3)


@given(st.integers(0, 2**32 - 1), st.floats(0.1, 1e6))
@settings(max_examples=40, deadline=None)
def test_of_any_packing(seed, scale):
    rng = np.random.default_rng(seed)
    grains, count = 30, 90
    i, j = np.sort(rng.permuted(np.tile(np.arange(grains), (count, 1)), axis=1)[:, :2], axis=1).T
    radius = rng.uniform(0.5, 2.0, grains)
    vector = rng.normal(size=(count, 3))
    overlap = rng.uniform(0.0, 0.01, count)
    vector *= ((radius[i] + radius[j] - overlap) / np.linalg.norm(vector, axis=1))[:, None]
    force = rng.exponential(1.0, count)
    made = [
        Network(radius, i, j, overlap, factor * force, force, NONE.astype(int), NONE, NONE, vector)
        for factor in (1.0, scale)
    ]
    stress = grain_stress(made[0])
    # A third of the trace is the mean stress that is known without directions.
    trace = np.trace(stress, axis1=1, axis2=2) / 3.0 * (4.0 / 3.0 * np.pi * radius**3)
    assert np.allclose(trace, grain_stress_volume(made[0]))
    assert np.allclose(stress, stress.transpose(0, 2, 1))
    chains, scaled = map(force_chains, made)
    assert chains.contacts.tolist() == scaled.contacts.tolist()  # forces have no unit in it
    for chain in np.unique(chains.chain):
        links = chains.contacts[chains.chain == chain]
        of_chain = np.union1d(i[links], j[links])
        assert of_chain.size == chains.grains[chains.chain == chain][0] >= FEWEST_GRAINS
        others = chains.contacts[chains.chain != chain]
        assert not np.intersect1d(of_chain, np.union1d(i[others], j[others])).size
