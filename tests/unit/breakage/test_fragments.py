"""Fragments: touching spheres within the grain, of known sizes, that grow to its mass."""

from itertools import combinations

import numpy as np
import pytest

from branchcrush.breakage.fragments import (
    FEWEST_FRAGMENTS,
    MOST_FRAGMENTS,
    broken,
    growth,
    packed_spheres,
)


def gaps(spheres):
    """Return the gap between each two spheres, and to the surface of the unit sphere."""
    between = np.array([
        np.linalg.norm(a[:3] - b[:3]) - a[3] - b[3] for a, b in combinations(spheres, 2)
    ])  # fmt: skip
    return between, 1.0 - np.linalg.norm(spheres[:, :3], axis=1) - spheres[:, 3]


@pytest.mark.parametrize("number", [4, 8, 14, 20, 30])
def test_spheres_touch_and_never_overlap(number):
    spheres = packed_spheres(number)
    between, outer = gaps(spheres)
    assert between.min() > -1e-9 and outer.min() > -1e-9
    touching = np.zeros(number, int)
    for (a, b), gap in zip(combinations(range(number), 2), between, strict=True):
        touching[[a, b]] += abs(gap) < 1e-9
    # Four of those there were before, the unit sphere among them; the first four touch three.
    assert np.all(touching + (np.abs(outer) < 1e-9) >= 4)


def test_sizes_are_those_of_the_shells():
    radius = packed_spheres(20)[:, 3]
    assert radius[:4] == pytest.approx(np.sqrt(6.0) - 2.0, rel=1e-12)
    # The next ones touch three of these and the surface: Descartes' theorem in space,
    # (sum of curvatures)^2 = 3 (sum of their squares).
    first = 1.0 / (np.sqrt(6.0) - 2.0)
    s, q = 3.0 * first - 1.0, 3.0 * first**2 + 1.0
    roots = np.roots([2.0, -2.0 * s, 3.0 * q - s**2])
    assert 1.0 / radius[4:8] == pytest.approx(max(roots.real), rel=1e-9)
    assert np.all(np.diff(radius) <= 1e-9)


@pytest.mark.parametrize(("number", "fill"), [(14, 0.5195), (20, 0.5782), (22, 0.5838)])
def test_a_part_of_the_grain_is_filled(number, fill):
    assert (packed_spheres(number)[:, 3] ** 3).sum() == pytest.approx(fill, abs=5e-5)


@pytest.mark.parametrize("number", [FEWEST_FRAGMENTS - 1, MOST_FRAGMENTS + 1])
def test_other_numbers_are_refused(number):
    with pytest.raises(ValueError, match=f"4 to 50 fragments, not {number}"):
        packed_spheres(number)


def test_fragments_lie_within_the_grain_and_are_turned():
    place, radius = np.array([1.0, 2.0, 3.0]), 0.5
    pieces, others = (broken(place, radius, 14, np.random.default_rng(seed)) for seed in (1, 2))
    distance = np.linalg.norm(pieces.position - place, axis=1)
    assert np.all(distance + pieces.radius <= radius * (1.0 + 1e-9))
    assert not np.allclose(pieces.position, others.position)
    assert pieces.radius.tolist() == others.radius.tolist()
    assert (pieces.full_radius**3).sum() == pytest.approx(radius**3, rel=1e-12)
    # A rotation and no mirror: as seen from the first four, the hand is the same.
    hands = [np.linalg.det(each.position[1:4] - each.position[0]) for each in (pieces, others)]
    assert hands[0] == pytest.approx(hands[1], rel=1e-9)


def test_turns_are_uniform_over_the_sphere():
    first = np.array([
        broken(np.zeros(3), 1.0, 4, np.random.default_rng(seed)).position[0] for seed in range(500)
    ])  # fmt: skip
    unit = first / np.linalg.norm(first, axis=1)[:, None]
    # The mean of 500 unit vectors: each component has a standard deviation of 0.026.
    assert np.all(np.abs(unit.mean(axis=0)) < 0.1)
    assert (unit**2).mean(axis=0) == pytest.approx([1 / 3] * 3, abs=0.06)


@pytest.mark.parametrize("stages", [0, 1, 5])
def test_growth_ends_with_all_the_mass(stages):
    factors = growth(14, stages)
    assert len(factors) == max(stages, 1)
    assert np.all(np.diff([1.0, *factors]) > 0.0)
    assert factors[-1] ** 3 * (packed_spheres(14)[:, 3] ** 3).sum() == pytest.approx(1.0)
