"""Whether grains can stand for a grading: numbers worked out by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.gradings.forms import fractal, lognormal, normal, uniform
from branchcrush.gradings.mixtures import from_radii, mixture, single
from branchcrush.gradings.representativity import (
    realised_gap,
    representativity,
    representativity_report,
)
from branchcrush.gradings.sampling import sampled_radii

# --- before drawing ------------------------------------------------------------------------------


def test_one_size_needs_a_box_of_five_diameters_only():
    standing = representativity(single(1e-3), 1000, np.pi / 6)
    # At pi/6 a grain has a cube of its own diameter.
    assert_allclose(standing.box_edge, 10 * 2e-3, rtol=1e-12)
    assert_allclose(standing.edge_over_diameter, 10.0, rtol=1e-12)
    assert standing.coarse_grains == 1000
    assert (standing.largest_diameter, standing.expected_largest_diameter) == (2e-3, 2e-3)
    assert (standing.grains_needed, standing.verdict) == (125, "accept")
    verdicts = [representativity(single(1.0), n, np.pi / 6).verdict for n in (26, 27, 124, 125)]
    assert verdicts == ["refuse", "warn", "warn", "accept"]


def test_five_coarse_grains_are_refused_ten_accepted_where_the_box_is_large():
    # A fortieth of the grains carry the coarsest tenth; at a solid fraction of 0.1 the box of five
    # diameters needs 96 grains only.
    share = 1 - 0.9**0.25
    few, enough = int(np.ceil(5 / share)), int(np.ceil(10 / share))
    judged = [
        representativity(uniform(1e-9, 1.0), grains, 0.1).verdict
        for grains in (few - 1, few, enough - 1, enough)
    ]
    assert judged == ["refuse", "warn", "warn", "accept"]
    assert representativity(uniform(1e-9, 1.0), few, 0.1).grains_needed == enough


def test_coarsest_tenth_of_the_uniform_grading_is_a_fortieth_of_the_grains():
    # (R/R_M)^4 = 0.9 leaves 1 - 0.9^(1/4) = 2.6 % of the number.
    share = 1 - 0.9**0.25
    standing = representativity(uniform(1e-9, 1.0), 1000, 0.5)
    assert_allclose(standing.coarse_grains, 1000 * share, rtol=1e-6)
    assert_allclose(standing.largest_diameter, 2 * 0.999**0.25, rtol=1e-6)
    assert_allclose(standing.expected_largest_diameter, 2 * 0.5**1e-3, rtol=1e-6)
    # <R^3> = 1/4
    assert_allclose(standing.box_edge, (1000 * 4 / 3 * np.pi / 4 / 0.5) ** (1 / 3), rtol=1e-6)
    by_edge = (5 * 2 * 0.999**0.25) ** 3 * 0.5 / (np.pi / 3)
    assert standing.grains_needed == np.ceil(max(10 / share, by_edge))
    assert standing.verdict == "accept"


def test_wide_fractal_grading_by_1000_grains_is_refused_with_the_number_needed():
    grading = fractal(5e-6, 1e-3, 2.6)
    # F = 0.9 is at R_90^0.4 = 0.1 R_m^0.4 + 0.9 R_M^0.4.
    coarse = (0.1 + 0.9 * 200**0.4) ** (1 / 0.4)
    share = (coarse**-2.6 - 200**-2.6) / (1 - 200**-2.6)
    standing = representativity(grading, 1000, 0.74)
    assert_allclose(standing.coarse_grains, 1000 * share, rtol=1e-8)
    assert standing.verdict == "refuse"
    # The box needs more still: (5 D_99.9)^3 phi over the mean volume.
    largest = 5e-6 * (0.001 + 0.999 * 200**0.4) ** (1 / 0.4)
    cube = 5e-6**3 * 2.6 / 0.4 * (200**0.4 - 1) / (1 - 200**-2.6)
    by_edge = (10 * largest) ** 3 * 0.74 / (4 / 3 * np.pi * cube)
    assert by_edge > 10 / share
    assert standing.grains_needed == np.ceil(by_edge)
    for words in ("1000 grains", f"{1000 * share:.3g} grains", str(standing.grains_needed), "0.74"):
        assert words in standing.message
    assert representativity(grading, standing.grains_needed, 0.74).verdict == "accept"
    assert representativity(grading, standing.grains_needed - 1, 0.74).verdict == "warn"


def test_few_large_grains_among_many_small_ones_are_seen_by_the_box():
    # A tenth of a percent by number of ten times the size: half of the mass.
    grading = mixture([single(0.1), single(1.0)], [1000.0, 1.0], "number")
    standing = representativity(grading, 1000, 0.6)
    assert_allclose(standing.coarse_grains, 1000 / 1001, rtol=1e-12)
    assert standing.largest_diameter == 2.0
    assert_allclose(standing.box_edge, (1000 * 4 / 3 * np.pi * 2 / 1001 / 0.6) ** (1 / 3))
    assert standing.verdict == "refuse"


def test_size_that_ends_the_mass_counts_as_a_whole():
    # 30 % of the mass is in the large ones, so the last 10 % are all among them.
    grading = mixture([single(1.0), single(2.0)], [7.0, 3.0], "mass")
    share = (3 / 8) / (7 + 3 / 8)
    assert_allclose(representativity(grading, 500, 0.6).coarse_grains, 500 * share, rtol=1e-12)


def test_far_end_of_a_tail_without_grains_does_not_count():
    near, far = (normal(1.0, 0.1, 0.1, end) for end in (1.6, 50.0))
    standing = [representativity(grading, 1000, 0.6) for grading in (near, far)]
    assert_allclose(standing[0].largest_diameter, standing[1].largest_diameter, rtol=1e-4)
    assert standing[1].verdict == "accept"


@settings(deadline=None, max_examples=20)
@given(st.floats(1.1, 3.0), st.integers(10, 10**6), st.floats(0.3, 0.8))
def test_verdict_agrees_with_the_number_needed(width, grains, solid_fraction):
    grading = lognormal(1.0, width, 0.01, 100.0)
    standing = representativity(grading, grains, solid_fraction)
    assert (standing.verdict == "accept") == (grains >= standing.grains_needed)
    again = representativity(grading, standing.grains_needed, solid_fraction)
    assert again.coarse_grains >= 10 * (1 - 1e-6)
    assert again.edge_over_diameter >= 5 * (1 - 1e-6)
    if standing.verdict == "refuse":
        assert standing.coarse_grains < 5 or standing.edge_over_diameter < 3


def test_message_of_an_accepted_number_asks_for_nothing():
    message = representativity(single(1.0), 1000, 0.6).message
    assert "need" not in message and "few" not in message


# --- after drawing -------------------------------------------------------------------------------


def test_gap_is_read_on_both_sides_of_a_step():
    # By mass (R^4 - 1)/80: the one grain at 2 jumps from 0 to 100 % where the target has 18.75 %.
    assert_allclose(realised_gap(uniform(1.0, 3.0), [2.0]), 100 - 18.75, rtol=1e-12)
    assert_allclose(realised_gap(uniform(1.0, 3.0), [2.9]), 100 * (2.9**4 - 1) / 80, rtol=1e-12)


def test_gap_to_single_sizes():
    target = mixture([single(1.0), single(2.0)], [1.0, 1.0], "mass")
    assert realised_gap(target, [2.0] + [1.0] * 8) == pytest.approx(0.0, abs=1e-12)
    assert realised_gap(target, [2.0]) == pytest.approx(50.0, rel=1e-12)
    assert realised_gap(target, [1.5]) == pytest.approx(50.0, rel=1e-12)
    assert realised_gap(from_radii([1.0, 2.0, 3.0]), [3.0, 1.0, 2.0]) < 1e-12


@settings(deadline=None, max_examples=20)
@given(st.integers(1, 60), st.integers(0, 1000))
def test_gap_is_the_largest_of_a_fine_search(grains, seed):
    grading = mixture([single(2.0), uniform(1.0, 3.0)], [1.0, 2.0], "mass")
    radii = sampled_radii(grading, grains, "random", np.random.default_rng(seed))
    fine = np.unique(np.concatenate([np.linspace(1, 3, 500), radii, radii - 1e-9, [2.0 - 1e-9]]))
    volume = np.array([np.sum(radii[radii <= r] ** 3) for r in fine]) / np.sum(radii**3)
    search = 100 * np.max(np.abs(volume - grading.mass_cdf(fine)))
    assert_allclose(realised_gap(grading, radii), search, atol=1e-5)


def test_gap_of_mass_quantiles_falls_with_their_number():
    grading = fractal(5e-6, 1e-3, 2.6)
    gaps = [
        realised_gap(grading, sampled_radii(grading, n, "mass_quantiles", None))
        for n in (100, 1000, 10_000)
    ]
    assert gaps[0] > gaps[1] > gaps[2]


def test_report_has_the_mean_and_the_largest_gap_of_the_seeds():
    target = mixture([single(1.0), single(2.0)], [1.0, 1.0], "mass")
    standing = representativity(target, 9, 0.5)
    # Eight grains of 1 m weigh as much as one of 2 m; the second seed has the latter only.
    report = representativity_report(standing, target, [[2.0] + [1.0] * 8, [2.0]])
    stands = report["representativity"]
    assert stands["largest_gap_percent_mean"] == pytest.approx(25.0, rel=1e-12)
    assert stands["largest_gap_percent_max"] == pytest.approx(50.0, rel=1e-12)
    assert report["target"]["D_min_m"] == 2.0
    # Smallest diameters of 2 and of 4 m; <R> of 10/9 and of 2 m.
    assert report["realised"]["D_min_m"] == 3.0
    assert report["realised"]["mean_radius_1_m1"] == pytest.approx((10 / 9 + 2) / 2, rel=1e-12)


def test_report_warns_unless_the_number_is_accepted():
    enough, few = (representativity(single(1.0), grains, np.pi / 6) for grains in (125, 124))
    warnings = [
        representativity_report(standing, single(1.0), [[1.0]])["representativity"]["warnings"]
        for standing in (enough, few)
    ]
    assert warnings == [[], [few.message]]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("median", [3.14e-5, 3.17e-5, 4.33e-5, 5e-5])
def test_a_grading_as_narrow_as_rounding_needs_few_grains(median):
    width = 1.0 + 2.0**-52
    found = representativity(lognormal(median, width, 2.5e-5, 9e-5, "mass"), 1500, 0.69)
    assert found.coarse_grains >= 150
    assert 100 < found.grains_needed < 1000
