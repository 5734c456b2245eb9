"""How neighbours are searched: which grading gets which grid, and that none is left out."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from branchcrush.lammps.neighbours import neighbour_settings
from branchcrush.packings.geometry import cube_edge


def settings_of(radii, solid_fraction=0.6):
    return neighbour_settings(radii, cube_edge(radii, solid_fraction))


def fractal(grains, ratio, alpha=2.5):
    share = (np.arange(grains) + 0.5) / grains
    return (1.0 - share * (1.0 - ratio**-alpha)) ** (-1.0 / alpha)


def bounds_of(settings):
    number, *bounds = settings["collections"].split()
    assert int(number) == len(bounds)
    return np.array(bounds, dtype=float)


@pytest.mark.parametrize(
    "radii",
    [np.ones(1000), np.linspace(0.005, 1.0, 1000), np.geomspace(0.1, 1.0, 1000), fractal(2000, 5)],
    ids=["one size", "uniform", "log-uniform", "fractal of ratio 5"],
)
def test_gradings_whose_largest_grain_meets_few_others_have_one_grid(radii):
    settings = settings_of(radii)
    assert (settings["neighbour_style"], settings["collections"]) == ("bin", "none")


@pytest.mark.parametrize("ratio", [20, 200])
def test_wide_fractal_gradings_have_a_grid_for_each_collection(ratio):
    settings = settings_of(fractal(20_000, ratio))
    assert settings["neighbour_style"] == "multi"
    bounds = bounds_of(settings)
    assert 1 < len(bounds) <= 2 + np.log(ratio) / np.log(2.7)
    assert (np.diff(bounds) > 0).all()


# Mean diameter 2.18, so a skin of 0.654: a cube as large as the largest grain holds 50 grains at an
# edge of 56.1, and one without the skin at 54.3.
TWO_SIZES = [1.0] * 990 + [10.0] * 10


@pytest.mark.parametrize(("edge", "style"), [(55.0, "multi"), (57.0, "bin")])
def test_largest_grain_and_its_skin_tell_whether_a_grid_is_crowded(edge, style):
    assert neighbour_settings(TWO_SIZES, edge)["neighbour_style"] == style


def test_collections_are_as_wide_as_similar_grains_or_their_distance():
    # 2.7 times the smallest diameter.
    assert bounds_of(neighbour_settings(TWO_SIZES, 55.0)) == pytest.approx([5.4, 20.0])
    # A tenth of the edge, but for the skin of 0.3 * 1.19.
    half = [0.5] * 990 + [10.0] * 10
    assert bounds_of(neighbour_settings(half, 55.0)) == pytest.approx([5.143, 20.0])
    # From 2.7 to 2.7^3, in equal ratios.
    wide = [0.5] * 99_990 + [2.7**3 / 2] * 10
    settings = neighbour_settings(wide, 40.0)
    assert bounds_of(settings) == pytest.approx([2.7, 2.7**2, 2.7**3])
    assert settings["neighbours"] == 102_000


def test_skin_goes_with_the_mean_diameter():
    assert settings_of([1.0] * 100)["skin"] == pytest.approx(0.6)
    assert settings_of([1e-3] * 50 + [3e-3] * 50)["skin"] == pytest.approx(0.3 * 4e-3)


def test_lengths_in_another_unit_are_searched_alike():
    one, other = settings_of(fractal(5000, 20)), settings_of(1e-3 * fractal(5000, 20))
    assert other["skin"] == pytest.approx(1e-3 * one["skin"])
    np.testing.assert_allclose(bounds_of(other), 1e-3 * bounds_of(one))


@given(
    radii=st.lists(st.floats(1e-6, 1e-2), min_size=1, max_size=60),
    solid_fraction=st.floats(0.01, 1.2),
)
def test_every_grain_is_in_a_collection_and_no_grid_is_finer_than_the_grains(radii, solid_fraction):
    edge = cube_edge(radii, solid_fraction)
    settings = neighbour_settings(radii, edge)
    assert settings["neighbours"] > len(radii)
    assert settings["skin"] > 0
    if settings["neighbour_style"] == "multi":
        bounds = bounds_of(settings)
        assert 2 * max(radii) <= bounds[-1] <= 2.001 * max(radii)
        cells = (edge / ((bounds[0] + settings["skin"]) / 2.0)) ** 3
        assert cells <= 8.001 * len(radii)
    else:
        assert settings["collections"] == "none"
