"""What a grain feels, against cases told by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from branchcrush.breakage.criterion import (
    CRITERIA,
    largest_force,
    octahedral_stress,
    sides,
    stress_of_largest_force,
)

NONE = np.zeros((0, 3))


def of_one(force, direction):
    """Return what one grain feels of some walls."""
    grain = np.zeros(len(force), int)
    return sides([], [], [], NONE, grain, force, direction)


def by_hand(force, direction, radius):
    """Return q/0.900 from the eigenvalues of the stress tensor."""
    volume = 4.0 / 3.0 * np.pi * radius**3
    tensor = sum(
        f * radius / volume * np.outer(n, n) for f, n in zip(force, direction, strict=True)
    )
    a, b, c = np.linalg.eigvalsh(tensor)
    q = np.sqrt((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) / 3.0
    return q / (np.sqrt(2.0) / 3.0 * 6.0 / np.pi)


def test_between_two_plates_both_criteria_say_the_same():
    felt = of_one([5.0, 5.0], [[0, 0, 1.0], [0, 0, -1.0]])
    for criterion in CRITERIA.values():
        assert criterion.stress(felt, [0.5e-3]) == pytest.approx([5.0 / 1e-6], rel=1e-12)


def test_equal_forces_from_all_sides_are_no_shear():
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    felt = of_one(np.full(6, 2.0), axes)
    assert octahedral_stress(felt, [1.0]) == pytest.approx([0.0], abs=1e-12)
    assert stress_of_largest_force(felt, [1.0]) == pytest.approx([0.5])


def test_each_grain_feels_its_contacts_and_walls():
    felt = sides([0, 0], [1, 2], [3.0, 4.0], np.eye(3)[:2], [2], [7.0], [[0, 1.0, 0]])
    assert largest_force(felt, np.ones(4)).tolist() == [4.0, 3.0, 7.0, 0.0]
    # The second grain sees the first one the other way round.
    assert felt.direction[felt.grain == 1].tolist() == [[-1.0, 0.0, 0.0]]
    assert octahedral_stress(felt, np.ones(4))[3] == 0.0


@given(st.lists(st.floats(0.01, 100.0), min_size=1, max_size=9), st.integers(0, 1000))
def test_octahedral_stress_is_that_of_the_principal_stresses(force, seed):
    rng = np.random.default_rng(seed)
    direction = rng.normal(size=(len(force), 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    turned = Rotation.random(random_state=rng).apply(direction)
    found = [float(octahedral_stress(of_one(force, n), [2.0])[0]) for n in (direction, turned)]
    expected = by_hand(force, direction, 2.0)
    assert found == pytest.approx([expected] * 2, rel=1e-7, abs=1e-9)
