"""Volumes of spheres and cells, against shells and by hand."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.packings.geometry import (
    cube,
    cube_edge,
    shared_volume,
    solid_volume,
    sphere_volume,
)


def test_volume_of_a_sphere_is_that_of_its_shells():
    shells = np.linspace(0.0, 2.0, 10_001)
    assert_allclose(sphere_volume(2.0), np.trapezoid(4.0 * np.pi * shells**2, shells), rtol=1e-7)
    assert_allclose(sphere_volume([1.0, 3.0])[1] / sphere_volume(1.0), 27.0)


def test_grains_fill_the_sum_of_their_volumes():
    assert_allclose(solid_volume([1.0, 2.0, 3.0]), 48 * np.pi, rtol=1e-15)
    assert solid_volume([]) == 0.0


@pytest.mark.parametrize(
    ("radius", "other", "overlap"), [(1.0, 1.0, 0.3), (1.0, 0.4, 0.2), (0.1, 2.0, 0.05)]
)
def test_lens_is_two_caps_that_meet_in_a_plane(radius, other, overlap):
    distance = radius + other - overlap
    plane = (distance**2 + radius**2 - other**2) / (2 * distance)
    heights = (radius - plane, other - (distance - plane))
    caps = [np.pi * h**2 * (3 * r - h) / 3 for h, r in zip(heights, (radius, other), strict=True)]
    assert_allclose(shared_volume(radius, other, overlap), sum(caps), rtol=1e-12)


def test_lens_is_nothing_at_a_touch_and_all_of_a_grain_that_is_swallowed():
    assert shared_volume(1.0, 2.0, 0.0) == 0.0
    assert_allclose(shared_volume(1.0, 2.0, 2.0), 4 / 3 * np.pi, rtol=1e-14)


def test_volume_of_a_cube_is_the_same_to_the_last_bit_one_by_one_and_at_once():
    edges = np.random.default_rng(1).uniform(1e-3, 1e-2, 1000)
    assert_array_equal(cube(edges), [cube(float(edge)) for edge in edges])
    assert cube(3.0) == 27.0


def test_edge_of_the_cube_gives_back_the_solid_fraction():
    assert cube_edge([1.0, 1.0], 8 / 3 * np.pi / 27) == pytest.approx(3.0, rel=1e-15)
    radii = np.array([1e-6, 2e-4, 1e-3])
    edge = cube_edge(radii, 0.16)
    assert 4 / 3 * np.pi * np.sum(radii**3) / edge**3 == pytest.approx(0.16, rel=1e-14)
