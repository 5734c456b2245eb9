"""Densities cut at two radii, and resolved whatever their shape."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from branchcrush.errors import GradingError
from branchcrush.gradings.truncation import (
    is_by_mass,
    share_within,
    truncated,
    truncated_distribution,
)


@pytest.mark.parametrize("width", [0.2, 0.05, 0.02])
def test_a_peak_that_no_break_announces_is_resolved_to_rounding(width):
    bell = stats.norm(2.0, width)
    grading = truncated(
        lambda r: np.exp(-((r - 2.0) ** 2) / (2 * width**2)), [], 1.0, 3.0, "number"
    )
    radius = np.linspace(2.0 - 4 * width, 2.0 + 4 * width, 41)
    whole = bell.cdf(3.0) - bell.cdf(1.0)
    expected = (bell.cdf(radius) - bell.cdf(1.0)) / whole
    assert_allclose(grading.number_cdf(radius), expected, rtol=0, atol=1e-12)
    assert_allclose(grading.moment(1), 2.0, rtol=1e-12)


def test_a_density_by_mass_has_its_cube_in_numbers():
    # g ~ R^3 on 1 to 3 is even by number; the scale does not matter.
    grading = truncated(lambda r: 7e9 * r**3, [], 1.0, 3.0, "mass")
    assert_allclose(grading.number_pdf([0.9, 1.0, 2.0, 3.0]), [0.0, 0.5, 0.5, 0.5], rtol=1e-12)
    assert_allclose(grading.mass_cdf(2.0), (2**4 - 1) / (3**4 - 1), rtol=1e-13)


def test_a_jump_at_a_break_is_kept():
    grading = truncated(lambda r: np.where(r < 2.0, 1.0, 3.0), [2.0, 9.0], 1.0, 3.0, "number")
    assert_allclose(grading.number_cdf([1.5, 2.0, 2.5]), [1 / 8, 1 / 4, 5 / 8], rtol=1e-12)


def test_shares_of_both_tails_keep_their_digits():
    for low, high in ((8.0, 9.0), (-9.0, -8.0)):
        assert_allclose(share_within(stats.norm(), low, high), 6.2198e-16, rtol=1e-4)
    assert_allclose(share_within(stats.expon(), 0.0, np.log(2.0)), 0.5, rtol=1e-15)


def test_a_millionth_of_a_distribution_must_lie_between_the_radii():
    # exp(-R) from R on: a millionth lies beyond 13.8155.
    assert truncated_distribution(stats.expon(), 13.8, 99.0, "number").support() == (13.8, 99.0)
    with pytest.raises(GradingError, match="expon distribution"):
        truncated_distribution(stats.expon(), 13.82, 99.0, "number")


@pytest.mark.parametrize("by", ["volume", "", None])
def test_a_basis_is_number_or_mass(by):
    with pytest.raises(GradingError, match="by number or by mass"):
        is_by_mass(by)
    assert (is_by_mass("mass"), is_by_mass("number")) == (True, False)
