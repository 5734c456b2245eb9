"""Random placement: no overlap, inside its cell, one by one, and clear when it cannot succeed."""

import re

import numpy as np
import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial import cKDTree
from scipy.stats import kstest

from branchcrush.errors import PackingError
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

boundaries = pytest.mark.parametrize("periodic", [False, True], ids=["walls", "periodic"])


def placed(grains, seed, solid_fraction, *, periodic, radius_min=5e-6, radius_max=1e-3):
    rng = np.random.default_rng(seed)
    grading = uniform(radius_min, radius_max)
    radii = np.sort(grading.rvs(size=grains, random_state=rng))[::-1]
    edge = cube_edge(radii, solid_fraction)
    return random_packing(radii, edge, periodic=periodic, rng=rng), radii, edge


def smallest_gap(positions, radii, period=None):
    """Smallest distance between the surfaces of two spheres, over all images of a periodic cell."""
    shifts = (-1, 0, 1) if period else (0,)
    first, second = np.triu_indices(len(radii), k=1)
    touching = radii[first] + radii[second]
    gaps = [
        np.linalg.norm(positions[first] - positions[second] + period_shift, axis=1) - touching
        for period_shift in np.stack(np.meshgrid(*[shifts] * 3), axis=-1).reshape(-1, 3)
        * (period or 0.0)
    ]
    return np.min(gaps)


@settings(deadline=None, max_examples=25)
@given(st.integers(2, 150), st.integers(0, 2**32), st.floats(0.01, 0.16))
def test_spheres_behind_walls_stay_inside_and_do_not_overlap(grains, seed, solid_fraction):
    try:
        positions, radii, edge = placed(grains, seed, solid_fraction, periodic=False)
    except PackingError as error:
        # The first of a few grains may leave no room for the second.
        assert grains < 30, error
        reject()
    # An ulp of the cell: what is added to a centre is rounded.
    tolerance = 4 * np.finfo(float).eps * edge
    assert np.all(np.abs(positions) + radii[:, None] <= edge / 2 + tolerance)
    assert smallest_gap(positions, radii) >= -tolerance


@settings(deadline=None, max_examples=15)
@given(st.integers(2, 100), st.integers(0, 2**32), st.floats(0.01, 0.2))
def test_spheres_in_a_periodic_cell_do_not_overlap_any_image(grains, seed, solid_fraction):
    try:
        positions, radii, edge = placed(grains, seed, solid_fraction, periodic=True)
    except PackingError as error:
        assert grains < 30, error
        reject()
    tolerance = 4 * np.finfo(float).eps * edge
    assert np.all(np.abs(positions) <= edge / 2)
    assert smallest_gap(positions, radii, period=edge) >= -tolerance


def test_spheres_of_a_periodic_cell_reach_through_its_faces():
    positions, radii, edge = placed(200, 1, 0.2, periodic=True)
    assert np.any(np.abs(positions) + radii[:, None] > edge / 2)


@boundaries
def test_packing_of_the_paper_is_placed(periodic):
    positions, radii, edge = placed(1000, 1, 0.16, periodic=periodic)
    assert positions.shape == (1000, 3)
    assert_allclose(4 / 3 * np.pi * np.sum(radii**3) / edge**3, 0.16, rtol=1e-13)
    # Spread over the whole cell: each coordinate's mean and spread are those of a uniform one.
    assert_allclose(positions.mean(axis=0) / edge, 0.0, atol=0.04)
    assert_allclose(positions.std(axis=0) / edge, 12**-0.5, atol=0.03)


@boundaries
def test_same_seed_places_the_same_spheres(periodic):
    first, second, other = (placed(50, seed, 0.16, periodic=periodic)[0] for seed in (7, 7, 8))
    assert_array_equal(first, second)
    assert not np.any(first == other)


def test_centres_are_in_the_order_of_the_radii():
    radii = np.array([1.0, 0.1, 0.1])
    edge = 2.02
    centres = random_packing(radii, edge, periodic=False, rng=np.random.default_rng(0))
    # The large sphere nearly fills the cube, so its centre is the middle; the others are not.
    assert np.abs(centres[0]).max() <= 0.0100001
    assert np.abs(centres[1:]).max(axis=1).min() > 0.5


def test_one_sphere_may_fill_the_whole_edge():
    rng = np.random.default_rng(0)
    assert_array_equal(random_packing([1.0], 2.0, periodic=False, rng=rng), [[0.0, 0.0, 0.0]])


@boundaries
def test_grain_larger_than_the_cell_is_refused_with_both_lengths(periodic):
    rng = np.random.default_rng(0)
    with pytest.raises(PackingError, match=r"radius 1\.01 m .* cube of 2 m: use more grains"):
        random_packing([1.01, 0.1], 2.0, periodic=periodic, rng=rng)


@boundaries
def test_too_dense_packing_names_the_solid_fraction_it_reached(periodic):
    radii = np.full(100, 0.5)
    edge = cube_edge(radii, 0.6)
    rng = np.random.default_rng(0)
    with pytest.raises(PackingError, match="lower initial_solid_fraction") as refused:
        random_packing(radii, edge, periodic=periodic, rng=rng, largest_attempts=2000)
    grain, reached = re.search(
        r"grain (\d+) of 100 .* solid fraction of (\d\.\d+)", str(refused.value)
    ).groups()
    assert float(reached) == pytest.approx(0.6 * (int(grain) - 1) / 100, abs=5e-4)
    # Random sequential addition of equal spheres ends at 0.38 in an infinite cell.
    assert 0.15 < float(reached) < 0.4


def test_one_attempt_is_enough_in_an_empty_cell():
    rng = np.random.default_rng(0)
    centre = random_packing([0.5], 10.0, periodic=False, rng=rng, largest_attempts=1)
    assert np.all(np.abs(centre) <= 4.5)


def one_by_one(radii, edge, *, periodic, rng, attempts):
    """Place spheres one after the other, each at its first free place, and return those placed.

    A sphere draws 64 places at a time: the stream of random numbers is part of what a seed means.
    """
    centres = np.empty((len(radii), 3))
    for n, radius in enumerate(radii):
        reach = edge / 2 if periodic else edge / 2 - radius
        for place in (
            place
            for start in range(0, attempts, 64)
            for place in rng.uniform(-reach, reach, (64, 3))[: attempts - start]
        ):
            gap = centres[:n] - place
            if periodic:
                gap -= edge * np.round(gap / edge)
            if np.all(np.sum(gap**2, axis=1) >= (radii[:n] + radius) ** 2):
                centres[n] = place
                break
        else:
            return centres[:n]
    return centres


def assert_placed_one_by_one(radii, edge, seed, *, periodic, attempts=20_000):
    rng, other = np.random.default_rng(seed), np.random.default_rng(seed)
    expected = one_by_one(radii, edge, periodic=periodic, rng=other, attempts=attempts)
    options = {"periodic": periodic, "rng": rng, "largest_attempts": attempts}
    if len(expected) < len(radii):
        failure = f"grain {len(expected) + 1} of {len(radii)} after {attempts} attempts"
        with pytest.raises(PackingError, match=failure):
            random_packing(radii, edge, **options)
        return
    assert_array_equal(random_packing(radii, edge, **options), expected)
    # What is drawn next does not depend on the method either.
    assert rng.random() == other.random()


@settings(deadline=None, max_examples=50)
@given(
    grains=st.integers(1, 150),
    ratio=st.floats(1, 200),
    # Exponents of a power law by number: from many large grains to many small ones.
    alpha=st.sampled_from([-2.0, 0.5, 2.5]),
    order=st.sampled_from(["falling", "rising", "none"]),
    solid_fraction=st.floats(0.01, 0.4),
    periodic=st.booleans(),
    attempts=st.sampled_from([1, 64, 100, 1000]),
    seed=st.integers(0, 2**32),
)
def test_batches_place_what_one_by_one_does(
    grains, ratio, alpha, order, solid_fraction, periodic, attempts, seed
):
    q = np.random.default_rng(seed).random(grains)
    radii = (ratio**alpha + q * (1 - ratio**alpha)) ** (-1 / alpha)
    radii = {"falling": np.sort(radii)[::-1], "rising": np.sort(radii), "none": radii}[order]
    edge = max(cube_edge(radii, solid_fraction), 2.0 * radii.max())
    assert_placed_one_by_one(radii, edge, seed, periodic=periodic, attempts=attempts)


@boundaries
@pytest.mark.parametrize(
    ("radii", "solid_fraction"),
    [
        (np.ones(200), 0.26),
        (np.linspace(1.0, 0.97, 200), 0.26),
        (uniform(0.005, 1.0).number_ppf(np.linspace(1, 0, 300)), 0.36),
        (fractal(0.05, 1.0, 2.5).number_ppf(np.linspace(1, 0, 1500)), 0.35),
    ],
    ids=["equal", "nearly equal", "uniform", "fractal"],
)
def test_crowded_packing_is_the_one_placed_one_by_one(radii, solid_fraction, periodic):
    edge = cube_edge(radii, solid_fraction)
    assert_placed_one_by_one(radii, edge, 5, periodic=periodic)


@pytest.mark.parametrize("seed", [2, 3, 24])
def test_spheres_a_little_smaller_than_the_first_find_places_nearer_to_the_corners(seed):
    # One sphere leaves the corners of the cube only. Of spheres that are tried together the small
    # ones reach farther out, along the diagonals by 1.7 of what their radii differ by; with these
    # seeds one of them lies where a larger one would not.
    radii = np.append(0.9, np.tile([0.27, 0.981 * 0.27], 3))
    assert_placed_one_by_one(radii, 2.0, seed, periodic=False)


@pytest.mark.parametrize("generator", [np.random.MT19937, np.random.Philox, np.random.SFC64])
def test_any_generator_of_random_numbers_will_do(generator):
    radii = np.linspace(1.0, 0.5, 100)
    edge = cube_edge(radii, 0.25)
    rng, other = np.random.Generator(generator(3)), np.random.Generator(generator(3))
    expected = one_by_one(radii, edge, periodic=True, rng=other, attempts=20_000)
    assert_array_equal(random_packing(radii, edge, periodic=True, rng=rng), expected)


@boundaries
@pytest.mark.parametrize("ratio", [1.0001, 20.0])
def test_thousands_of_grains_are_uniform_and_free_of_overlap(ratio, periodic):
    radii = fractal(1.0 / ratio, 1.0, 2.5).number_ppf(np.linspace(1, 0, 3000))
    edge = cube_edge(radii, 0.2)
    rng = np.random.default_rng(11)
    positions = random_packing(radii, edge, periodic=periodic, rng=rng)
    # Trees take a periodic cell from 0 to its edge.
    tree = cKDTree((positions + edge / 2) % edge, boxsize=edge) if periodic else cKDTree(positions)
    first, second = tree.query_pairs(2.01, output_type="ndarray").T
    gap = positions[first] - positions[second]
    if periodic:
        gap -= edge * np.round(gap / edge)
    distance = np.linalg.norm(gap, axis=1)
    assert np.all(distance >= (radii[first] + radii[second]) * (1 - 1e-14))
    # Random places come close to contact; a lattice or a margin would not.
    assert np.min(distance / (radii[first] + radii[second])) < 1.001
    if periodic:
        p_values = [kstest(x, "uniform").pvalue for x in positions.T / edge + 0.5]
        assert min(p_values) > 0.01
    else:
        assert np.all(np.abs(positions) + radii[:, None] <= edge / 2 * (1 + 1e-15))


def test_sphere_that_fills_a_periodic_cell_leaves_its_corners_only():
    positions = random_packing([1.0, 0.2], 2.0, periodic=True, rng=np.random.default_rng(2))
    gap = positions[1] - positions[0]
    gap -= 2.0 * np.round(gap / 2.0)
    assert np.linalg.norm(gap) >= 1.2
    with pytest.raises(PackingError, match="grain 2 of 2"):
        random_packing([1.0, 0.8], 2.0, periodic=True, rng=np.random.default_rng(2))


@pytest.mark.parametrize(
    ("large", "small", "needed"), [(0.9, 0.25, 48), (0.9, 0.3, 376), (0.8, 0.4, 6960)]
)
def test_no_more_places_are_tried_than_said(large, small, needed):
    rng = np.random.default_rng(4)
    first = rng.uniform(large - 1, 1 - large, (64, 3))[0]
    places = rng.uniform(small - 1, 1 - small, (7000, 3))
    free = np.linalg.norm(places - first, axis=1) >= large + small
    assert np.argmax(free) == needed - 1
    centres = random_packing(
        [large, small], 2.0, periodic=False, rng=np.random.default_rng(4), largest_attempts=needed
    )
    assert_array_equal(centres, [first, places[needed - 1]])
    with pytest.raises(PackingError, match=f"grain 2 of 2 after {needed - 1} attempts"):
        random_packing(
            [large, small],
            2.0,
            periodic=False,
            rng=np.random.default_rng(4),
            largest_attempts=needed - 1,
        )
