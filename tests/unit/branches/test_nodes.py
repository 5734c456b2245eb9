"""Nodes that stand for a grading have its moments and its cumulative curves."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.branches.nodes import grading_nodes
from branchcrush.gradings.forms import (
    fractal,
    fuller,
    lognormal,
    loguniform,
    normal,
    uniform,
    weibull,
)
from branchcrush.gradings.mixtures import from_radii, mixture, single


@st.composite
def gradings(draw):
    """Return gradings of every form, of ratios to 200; by number, by mass or of single radii."""
    ratio = draw(st.floats(1.01, 200.0))
    by = draw(st.sampled_from(["number", "mass"]))
    seed = draw(st.integers(0, 2**32))
    whole = uniform(1.0, ratio, by)
    forms = {
        "uniform": lambda: whole,
        "loguniform": lambda: loguniform(1.0, ratio, by),
        "normal": lambda: normal((1.0 + ratio) / 2, (ratio - 1.0) / 6, 1.0, ratio, by),
        # Cut far beyond their tails.
        "lognormal": lambda: lognormal(1.0, 1.0 + draw(st.floats(0.05, 1.0)), 0.01, 100.0, by),
        "weibull": lambda: weibull(1.0, draw(st.floats(1.0, 4.0)), 0.05, 20.0, by),
        "fractal": lambda: fractal(1.0, ratio, draw(st.floats(2.0, 2.9))),
        "fuller": lambda: fuller(1.0, ratio, draw(st.floats(0.3, 1.0))),
        "few radii": lambda: from_radii(whole.rvs(20, seed)),
        "many radii": lambda: from_radii(whole.rvs(700, seed)),
        "mixed": lambda: mixture([whole, single(1.0 + ratio)], [3.0, 1.0], by),
        "mixed with many": lambda: mixture([whole, from_radii(whole.rvs(150, seed))], [1, 1], by),
    }
    return forms[draw(st.sampled_from(sorted(forms)))]()


@settings(deadline=None, max_examples=120)
@given(gradings())
def test_nodes_have_the_moments_of_their_grading(grading):
    radius, share = grading_nodes(grading)
    assert share.sum() == pytest.approx(1.0, rel=1e-12)
    assert np.all(share > 0)
    # However many single radii there are.
    assert radius.size <= 500
    smallest, largest = grading.support()
    assert np.all((radius >= smallest * (1 - 1e-12)) & (radius <= largest * (1 + 1e-12)))
    assert share @ radius == pytest.approx(grading.moment(1), rel=1e-9)
    assert share @ radius**2 == pytest.approx(grading.moment(2), rel=3e-3)
    assert share @ radius**3 == pytest.approx(grading.moment(3), rel=5e-3)


@settings(deadline=None, max_examples=60)
@given(gradings(), st.floats(0.01, 0.99))
def test_nodes_follow_both_cumulative_curves(grading, level):
    radius, share = grading_nodes(grading)
    mass = share * radius**3 / (share @ radius**3)
    for weight, quantile, cumulative in (
        (share, grading.number_ppf, grading.number_cdf),
        (mass, grading.mass_ppf, grading.mass_cdf),
    ):
        # A cell may be on either side, and a single radius steps.
        here = float(quantile(level))
        below = weight[radius < here * (1 - 1e-9)].sum()
        upto = weight[radius <= here * (1 + 1e-9)].sum()
        assert below <= level + 0.011
        assert upto >= min(level, float(cumulative(here))) - 0.011


def test_single_radii_beside_a_continuous_part_keep_their_shares():
    grading = mixture([uniform(1.0, 2.0), from_radii([1.5, 3.0])], [3.0, 1.0], by="number")
    radius, share = grading_nodes(grading)
    for size in (1.5, 3.0):
        assert_allclose(share[radius == size].max(), 0.125, rtol=1e-12)
    assert share[(radius != 1.5) & (radius != 3.0)].sum() == pytest.approx(0.75, rel=1e-12)


def test_coarse_grains_few_by_number_have_nodes_as_well():
    radius, _ = grading_nodes(fractal(1.0, 200.0, 2.6))
    # Half the mass is in grains above this radius: fewer than 1 in 10 000 by number.
    assert (radius > fractal(1.0, 200.0, 2.6).mass_ppf(0.5)).sum() >= 95


@pytest.mark.parametrize("fines", [101, 699, 5000])
def test_one_heavy_grain_among_many_fines_keeps_its_radius(fines):
    radius, share = grading_nodes(from_radii([*np.linspace(1.0, 1.5, fines), 200.0]))
    assert radius.max() == 200.0
    assert share[radius.argmax()] == pytest.approx(1 / (fines + 1), rel=1e-9)


def test_a_long_tail_of_no_grains_has_no_part_in_the_moments():
    grading = lognormal(1.0, 1.2, 0.01, 100.0)
    radius, share = grading_nodes(grading)
    for order in (1, 2, 3):
        assert share @ radius**order == pytest.approx(grading.moment(order), rel=1e-3)


def test_a_hundred_single_radii_are_kept_as_they_are_and_more_are_cut_into_cells():
    kept, cut = (np.linspace(1.0, 2.0, number) for number in (100, 101))
    assert grading_nodes(from_radii(kept), cells=10)[0].tolist() == kept.tolist()
    assert grading_nodes(from_radii(cut), cells=10)[0].size <= 20
