"""The part of a grading that a number of grains stands for: power laws, of which it is known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.gradings.forms import fractal, lognormal, uniform
from branchcrush.gradings.mixtures import from_radii, mixture, single
from branchcrush.gradings.narrower import NarrowerRange, narrower_range
from branchcrush.gradings.representativity import representativity


def grains_for(ratio, alpha, solid_fraction):
    """Return how many grains stand for a fractal grading of a ratio of sizes, by hand."""
    beta = 3 - alpha
    by_mass = lambda share: (1 + share * (ratio**beta - 1)) ** (1 / beta)  # noqa: E731
    number = 1 - ratio**-alpha
    coarse = (by_mass(0.9) ** -alpha - ratio**-alpha) / number
    cube = alpha / beta * (ratio**beta - 1) / number
    by_edge = (10 * by_mass(0.999)) ** 3 * solid_fraction / (4 / 3 * np.pi * cube)
    return max(10 / coarse, by_edge)


# In a loose cell it is the coarsest grains that are too few, in a dense one the box too small.
@pytest.mark.parametrize(
    ("ratio", "solid_fraction"), [(1.7, 0.64), (4.0, 0.64), (15.0, 0.64), (4.0, 0.02)]
)
def test_of_a_fractal_with_most_mass_in_the_coarse_the_fines_are_left_out(ratio, solid_fraction):
    # What is needed depends on the ratio of the ends alone, and mass finer grows as D^0.4.
    grains = int(np.ceil(grains_for(ratio, 2.6, solid_fraction)))
    part = narrower_range(fractal(5e-6, 1e-3, 2.6), grains, solid_fraction)
    assert part.radius_max == pytest.approx(1e-3, rel=1e-12)
    assert part.radius_min == pytest.approx(1e-3 / ratio, rel=5e-3)
    share = (1 - ratio**-0.4) / (1 - 200**-0.4)
    assert part.mass_share == pytest.approx(share, rel=1e-2)
    assert part.number_share == pytest.approx((ratio**2.6 - 1) / (200**2.6 - 1), rel=2e-2)


def test_of_a_fractal_with_most_mass_in_the_fines_the_coarse_are_left_out():
    grains = int(np.ceil(grains_for(4.0, 3.8, 0.64)))
    part = narrower_range(fractal(1e-5, 1e-3, 3.8), grains, 0.64)
    assert part.radius_min == pytest.approx(1e-5, rel=1e-3)
    assert part.radius_max == pytest.approx(4e-5, rel=1e-2)


def test_enough_grains_stand_for_the_whole():
    grading = uniform(1e-4, 1e-3)
    assert narrower_range(grading, 100_000, 0.64) == (*grading.support(), 1.0, 1.0)


def test_no_part_of_a_continuous_grading_has_ten_of_less_than_a_hundred_grains():
    # At any width a tenth of the mass has no more than a tenth of the grains.
    assert narrower_range(uniform(5e-6, 1e-3), 60, 0.64) is None
    assert narrower_range(single(1.0), 20, 0.64) is None


def test_of_two_sizes_the_heavier_one_that_will_do_is_left():
    # A thousand grains hold one of the larger size, though half of the mass.
    sizes = mixture([single(0.1), single(1.0)], [1000.0, 1.0], "number")
    part = narrower_range(sizes, 1000, 0.6)
    assert (part.radius_min, part.radius_max) == (0.1, 0.1)
    assert part.mass_share == pytest.approx(0.5, rel=1e-12)
    assert part.number_share == pytest.approx(1000 / 1001, rel=1e-12)


def test_a_gap_between_two_parts_is_no_range_to_stand_for():
    fine, coarse = uniform(1e-5, 2e-5), uniform(9e-4, 1e-3)
    part = narrower_range(mixture([fine, coarse], [0.4, 0.6], "mass"), 1000, 0.64)
    assert part.radius_min > 0.999 * 2e-5
    assert part.mass_share == pytest.approx(0.6, rel=2e-2)
    part = narrower_range(mixture([fine, coarse], [0.6, 0.4], "mass"), 1000, 0.64)
    assert part.radius_max < 1.001 * 9e-4
    assert part.mass_share == pytest.approx(0.6, rel=2e-2)


def test_a_list_of_grains_ends_at_one_of_them():
    radii = [1.0] * 500 + [2.0] * 100 + [8.0]
    part = narrower_range(from_radii(radii), 601, 0.6)
    assert (part.radius_min, part.radius_max) == (1.0, 2.0)
    assert part.number_share == pytest.approx(600 / 601, rel=1e-12)
    assert part.mass_share == pytest.approx(1300 / (1300 + 512), rel=1e-12)


@settings(deadline=None, max_examples=4)
@given(st.floats(1.3, 3.0), st.integers(200, 20_000), st.floats(0.5, 0.8))
def test_the_range_as_a_user_would_paste_it_is_accepted(width, grains, solid_fraction):
    ends = 1e-5, 1e-2
    part = narrower_range(lognormal(4e-4, width, *ends, "mass"), grains, solid_fraction)
    low, _, high, *_ = part.words("mm", 1e-3).removeprefix("diameters ").split()
    radii = float(low) / 2e3, float(high) / 2e3
    assert ends[0] <= radii[0] * (1 + 1e-9) and radii[1] <= ends[1] * (1 + 1e-9)
    cut = lognormal(4e-4, width, *radii, "mass")
    assert representativity(cut, grains, solid_fraction).grains_needed <= 1.02 * grains
    # To widen it by a tenth at both ends would take more.
    if part.mass_share < 0.99:
        wider = lognormal(4e-4, width, max(ends[0], radii[0] / 1.1), 1.1 * radii[1], "mass")
        assert representativity(wider, grains, solid_fraction).verdict != "accept"


@pytest.mark.parametrize(
    ("part", "unit", "expected"),
    [
        (
            (1.2341e-4, 0.5e-3, 0.999, 1),
            ("um", 1e-6),
            "diameters 247 to 1000 um, 99.9 % of the mass",
        ),
        (
            (1.2341e-4, 4.567e-4, 0.5, 1),
            ("mm", 1e-3),
            "diameters 0.247 to 0.913 mm, 50 % of the mass",
        ),
        ((1.2e-4, 3e-4, 0.051, 1), ("mm", 1e-3), "diameters 0.24 to 0.6 mm, 5.1 % of the mass"),
    ],
)
def test_ends_are_rounded_inwards_in_the_unit_of_the_user(part, unit, expected):
    assert NarrowerRange(*part).words(*unit) == expected
