"""The grid finds every sphere that is near, whatever the cells, and names each once."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.packings.cell_grid import EMPTY, CellGrid


def pairs_of(grid, places, radius, before=EMPTY):
    listed = [
        (int(place), int(sphere))
        for which, near in grid.near(places, radius, before)
        for place, sphere in zip(which, near, strict=True)
    ]
    assert len(listed) == len(set(listed))
    return set(listed)


def within(places, centres, reach, edge, periodic):
    gap = places[:, None] - centres[None]
    if periodic:
        gap -= edge * np.round(gap / edge)
    return set(map(tuple, np.argwhere(np.linalg.norm(gap, axis=2) < reach).tolist()))


@settings(deadline=None, max_examples=60)
@given(
    seed=st.integers(0, 2**32),
    spheres=st.integers(1, 200),
    largest=st.floats(0.01, 0.5),
    radius=st.floats(0.01, 0.5),
    periodic=st.booleans(),
)
def test_all_that_could_touch_are_named_once(seed, spheres, largest, radius, periodic):
    rng = np.random.default_rng(seed)
    centres, places = (rng.uniform(-1.0, 1.0, (number, 3)) for number in (spheres, 20))
    grid = CellGrid(2.0, periodic, largest, spheres)
    for part in np.array_split(np.arange(spheres), 3):
        if part.size:
            grid.add(part, centres[part])
    near = pairs_of(grid, places, radius)
    assert within(places, centres, largest + radius, 2.0, periodic) <= near
    # Only spheres before a number, of all places or of each.
    assert pairs_of(grid, places, radius, 50) == {pair for pair in near if pair[1] < 50}
    before = rng.integers(0, spheres + 1, 20)
    expected = {(place, sphere) for place, sphere in near if sphere < before[place]}
    assert pairs_of(grid, places, radius, before) == expected


def test_a_wide_cell_is_not_searched_whole():
    centres = np.random.default_rng(1).uniform(-1.0, 1.0, (2000, 3))
    grid = CellGrid(2.0, True, 0.05, 2000)
    grid.add(np.arange(2000), centres)
    # Cells of 0.13 and a reach of 0.1: three or four cells of 15 in each direction.
    assert len(pairs_of(grid, np.zeros((1, 3)), 0.05)) < 100


@pytest.mark.parametrize("periodic", [False, True])
def test_spheres_on_the_faces_and_in_one_place_are_kept(periodic):
    grid = CellGrid(2.0, periodic, 0.2, 9)
    corner = np.full((9, 3), 1.0)
    grid.add(np.arange(9), corner)
    assert pairs_of(grid, corner[:1], 0.2) == {(0, sphere) for sphere in range(9)}
    other = pairs_of(grid, -corner[:1], 0.2)
    # The far corner is the same place where the faces are joined.
    assert other == {(0, sphere) for sphere in range(9)} or not periodic
