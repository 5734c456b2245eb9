"""The rod map: lengths of chords, jamming points, and who pushes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.branches.nodes import grading_nodes
from branchcrush.gradings.forms import fractal, lognormal, uniform
from branchcrush.gradings.mixtures import mixture
from branchcrush.gradings.rods import GAP, PUBLISHED_GAP, chord_quantile, gap_at, rod_map

EQUAL = np.array([1.0]), np.array([1.0])
COARSE = uniform(0.5e-3, 1.0e-3, "number")
FINE = fractal(0.1e-3, 1.0e-3, 2.6)
SKELETON = uniform(0.5e-3, 0.6e-3, "number")
FINES = uniform(0.085e-3, 0.1e-3, "number")


def nodes(first, second, share):
    """Return the nodes of a mixture by mass."""
    parts = [(first, 1.0 - share), (second, share)]
    kept = [(grading, weight) for grading, weight in parts if weight]
    return grading_nodes(mixture(*zip(*kept, strict=True), "mass"))


def test_chords_of_one_sphere_have_the_density_2l_over_d_squared():
    level = np.linspace(0.0, 1.0, 11)
    np.testing.assert_allclose(chord_quantile(*EQUAL, level), 2.0 * np.sqrt(level), atol=1e-15)


def test_chords_of_two_sizes_are_those_of_a_line_through_many_spheres():
    radius, share = np.array([0.5, 1.0]), np.array([0.8, 0.2])
    rng = np.random.default_rng(1)
    hit = rng.choice(2, 200_000, p=share * radius**2 / (share @ radius**2))
    chords = 2.0 * radius[hit] * np.sqrt(rng.random(hit.size))
    level = np.array([0.1, 0.3, 0.5, 0.7, 0.9])
    expected = np.quantile(chords, level)
    np.testing.assert_allclose(chord_quantile(radius, share, level), expected, rtol=0.01)


def test_three_rods_by_hand():
    # L^2 = 4 * 5/6, 4 * 3/6, 4 * 1/6; f = 0.5. The first brings a gap of half its length, which
    # has no room for the second, nor what is left for the third.
    lengths = 2.0 * np.sqrt(np.array([5.0, 3.0, 1.0]) / 6.0)
    rods = rod_map(*EQUAL, gap=0.5, rods=3)
    first, second, third = lengths
    # The second takes the only gap and leaves two of half its length; the third takes one of them.
    gaps = [0.5 * second, 0.5 * third, 0.5 * third]
    assert 0.5 * first < 2.0 * second and 0.5 * second < 2.0 * third
    np.testing.assert_allclose(rods.length, lengths)
    np.testing.assert_allclose(rods.solid_fraction, lengths.sum() / (lengths.sum() + sum(gaps)))
    assert rods.pushes.all()


@pytest.mark.parametrize(
    ("share", "jamming"),
    [
        (0.0, 0.65149),
        (1 / 8, 0.68615),
        (1 / 4, 0.72079),
        (3 / 8, 0.75101),
        (1 / 2, 0.76504),
        (3 / 4, 0.75969),
        (1.0, 0.74335),
    ],
)
def test_jamming_points_computed_by_another_program(share, jamming):
    assert rod_map(*nodes(COARSE, FINE, share)).solid_fraction == pytest.approx(jamming, abs=1e-4)


@pytest.mark.parametrize(
    ("share", "jamming", "bearing_fines"), [(0.15, 0.7540, 0.0), (0.25, 0.7952, 0.63)]
)
def test_gap_graded_by_another_program(share, jamming, bearing_fines):
    radius, weight = nodes(SKELETON, FINES, share)
    rods = rod_map(radius, weight)
    fines = radius < 0.2e-3
    bearing = (weight * rods.load_bearing(radius))[fines].sum() / weight[fines].sum()
    assert rods.solid_fraction == pytest.approx(jamming, abs=1e-4)
    assert bearing == pytest.approx(bearing_fines, abs=0.01)


def test_two_published_gaps_of_equal_spheres():
    assert rod_map(*EQUAL, gap=GAP).solid_fraction == pytest.approx(0.6400, abs=1e-4)
    # Farr and Groot give 0.6435 for theirs.
    assert rod_map(*EQUAL, gap=PUBLISHED_GAP).solid_fraction == pytest.approx(0.6435, abs=5e-4)


def test_more_rods_change_little():
    some = nodes(COARSE, FINE, 0.5)
    coarse, fine = (rod_map(*some, rods=rods).solid_fraction for rods in (10_000, 80_000))
    assert coarse == pytest.approx(fine, abs=5e-5)


def test_load_bearing_beyond_one_length_has_a_closed_form():
    radius, share = grading_nodes(FINE)
    rods = rod_map(radius, share)
    last = np.flatnonzero(rods.pushes)[-1]
    assert rods.pushes[: last + 1].all()
    cut = rods.edge[last + 1]
    expected = np.maximum(1.0 - (cut / (2.0 * radius)) ** 2, 0.0)
    np.testing.assert_allclose(rods.load_bearing(radius), expected, atol=1e-3)


def test_a_gap_covers_what_was_asked():
    radius, share = nodes(COARSE, FINE, 0.25)
    gap = gap_at(radius, share, 0.75)
    assert rod_map(radius, share, gap=gap).solid_fraction == pytest.approx(0.75, abs=1e-6)
    assert gap < GAP


@settings(max_examples=25, deadline=None)
@given(
    spread=st.floats(1.05, 3.0),
    unit=st.floats(1e-6, 1e3),
    mass=st.floats(1e-3, 1e3),
)
def test_neither_unit_nor_number_of_grains_matters(spread, unit, mass):
    radius, share = grading_nodes(lognormal(1.0, spread, 0.2, 5.0, "mass"), cells=30)
    rods, scaled = (
        rod_map(radius, share, rods=500),
        rod_map(unit * radius, mass * share, rods=500),
    )
    # The widest of equal gaps is chosen by rounding.
    assert scaled.solid_fraction == pytest.approx(rods.solid_fraction, abs=1e-6)
    bearing = rods.load_bearing(radius)
    assert ((bearing >= 0.0) & (bearing <= 1.0)).all()
    assert 0.63 < rods.solid_fraction < 1.0


@pytest.mark.parametrize(
    ("radius", "share", "gap"),
    [
        ([], [], GAP),
        ([0.0], [1.0], GAP),
        ([1.0], [-1.0], GAP),
        ([1.0], [0.0], GAP),
        ([1.0], [1.0], 0.0),
        ([1.0, 2.0], [1.0], GAP),
        ([np.nan], [1.0], GAP),
    ],
)
def test_no_such_grading(radius, share, gap):
    with pytest.raises(ValueError, match="above 0"):
        rod_map(np.array(radius), np.array(share), gap)


@pytest.mark.parametrize("phi", [0.0, 1.0, -0.1])
def test_no_such_solid_fraction(phi):
    with pytest.raises(ValueError, match="must be from 0 to 1"):
        gap_at(*EQUAL, phi)
