"""Gradings of single sizes, of given grains, and of other gradings."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import GradingError
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import from_radii, mixture, single

bases = pytest.mark.parametrize("by", ["number", "mass"])


def test_single_size():
    grading = single(2.0)
    assert grading.support() == (2.0, 2.0)
    assert grading.number_cdf([1.9, 2.0, 2.1]).tolist() == [0, 1, 1]
    assert grading.mass_cdf([1.9, 2.0, 2.1]).tolist() == [0, 1, 1]
    assert grading.number_ppf([0.0, 0.5, 1.0]).tolist() == [2.0, 2.0, 2.0]
    assert grading.moment(3) == 8.0


def test_radii_count_alike():
    grading = from_radii([3.0, 1.0, 1.0, 2.0])
    assert grading.number_cdf([0.9, 1.0, 2.0, 3.0]).tolist() == [0.0, 0.5, 0.75, 1.0]
    assert_allclose(grading.mass_cdf([1.0, 2.0, 3.0]), np.array([2, 10, 37]) / 37, rtol=1e-15)
    assert grading.number_ppf([0.5, 0.51, 0.75, 0.76]).tolist() == [1.0, 2.0, 2.0, 3.0]


def test_two_sizes_by_number_and_by_mass():
    radius = [0.9, 1.0, 1.9, 2.0]
    sizes = [single(1.0), single(2.0)]
    by_number = mixture(sizes, [3.0, 1.0], "number")
    assert by_number.number_cdf(radius).tolist() == [0.0, 0.75, 0.75, 1.0]
    assert_allclose(by_number.mass_cdf(radius), [0, 3 / 11, 3 / 11, 1], rtol=1e-15)
    by_mass = mixture(sizes, [3.0, 1.0], "mass")
    assert by_mass.mass_cdf(radius).tolist() == [0.0, 0.75, 0.75, 1.0]
    assert_allclose(by_mass.number_cdf(radius), [0, 24 / 25, 24 / 25, 1], rtol=1e-15)


@bases
def test_mixture_is_the_weighted_mean_of_the_curves_of_its_basis(by):
    parts = [uniform(1.0, 5.0), fractal(2.0, 90.0, 2.5), single(3.0)]
    weights = np.array([0.5, 0.3, 0.2])
    radius = np.append(np.geomspace(0.9, 91.0, 50), 3.0)
    whole = mixture(parts, 7 * weights, by)
    curves = [getattr(part, f"{by}_cdf")(radius) for part in parts]
    assert_allclose(getattr(whole, f"{by}_cdf")(radius), weights @ curves, rtol=1e-12)


def test_mixture_of_parts_that_leave_a_gap():
    whole = mixture([uniform(1.0, 2.0), uniform(4.0, 5.0)], [1.0, 1.0], "number")
    assert_allclose(whole.number_cdf([1.5, 2.0, 3.0, 4.5]), [0.25, 0.5, 0.5, 0.75], rtol=1e-13)
    assert whole.number_pdf(3.0) == 0.0
    assert_allclose(whole.number_ppf([0.25, 0.75]), [1.5, 4.5], rtol=1e-13)


@pytest.mark.parametrize(
    "refused",
    [
        lambda: single(0.0),
        lambda: single(-1.0),
        lambda: from_radii([]),
        lambda: from_radii([1.0, np.nan]),
        lambda: mixture([single(1.0), single(2.0)], [1.0, 0.0], "mass"),
        lambda: mixture([], [], "mass"),
        lambda: mixture([single(1.0)], [1.0], "volume"),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_unusable_mixture_is_refused(refused):
    with pytest.raises(GradingError):
        refused()
