"""The solid angle of a neighbour against rays, and closest packing."""

import numpy as np
import pytest

from branchcrush.branches.coordination import solid_angle

SPHERE = 4.0 * np.pi


@pytest.mark.parametrize(("radius", "neighbour"), [(1.0, 1.0), (1.0, 0.2), (0.05, 1.0), (3.0, 2.0)])
def test_solid_angle_is_the_share_of_directions_that_hit_the_neighbour(radius, neighbour):
    # Even steps of the cosine are even steps of area. A ray from the centre misses the
    # neighbour's by the distance times the sine.
    cosine = (np.arange(400_000) + 0.5) / 200_000 - 1.0
    miss = (radius + neighbour) * np.sqrt(1.0 - cosine**2)
    hit = (cosine > 0) & (miss <= neighbour)
    assert solid_angle(radius, neighbour) == pytest.approx(SPHERE * hit.mean(), abs=SPHERE * 5e-6)


def test_twelve_neighbours_of_closest_packing_cover_0_80_of_the_sphere():
    # Each hides a cone of half angle 30 degrees, and centres are 60 degrees apart.
    covered = 12 * solid_angle(1.0, 1.0) / SPHERE
    assert covered == pytest.approx(6 * (1 - np.cos(np.pi / 6)), rel=1e-14)
    assert covered == pytest.approx(0.8038, abs=5e-5)


def test_huge_neighbour_covers_half_the_sphere_and_a_tiny_one_its_own_shadow():
    assert solid_angle(1.0, 1e9) == pytest.approx(2 * np.pi, rel=1e-4)
    assert solid_angle(1.0, 1e-3) == pytest.approx(np.pi * 1e-6, rel=3e-3)
