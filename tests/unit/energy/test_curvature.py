"""Curvature of energies that are a known quadratic of the logarithm of the length."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.energy.curvature import curvature
from branchcrush.errors import FitError


def logarithm(small, large):
    return np.log(np.exp(small) + np.exp(large))


def radii(rng, branches):
    """Return logarithms of the smaller and the larger radius, over the largest of all."""
    return np.sort(np.log(rng.uniform(0.03, 1.0, (2, branches))), axis=0)


@pytest.mark.parametrize("bend", [0.0, 0.4, -0.7])
def test_exact_quadratic_has_its_own_curvature_and_slopes(bend):
    rng = np.random.default_rng(8)
    pairs = [radii(rng, 200) for _ in range(5)]
    logs = np.concatenate([logarithm(*pair) for pair in pairs])
    centre = logs.mean()

    def mean(small, large):
        x = logarithm(small, large) - centre
        return 1e-7 * np.exp(2.8 * x + bend * x**2)

    found = curvature([(*pair, mean(*pair)) for pair in pairs])
    short, long = np.quantile(logs, [0.1, 0.9]) - centre
    expected = {
        "curvature": bend,
        "slope_at_10_percent": 2.8 + 2 * bend * short,
        "slope_at_mean": 2.8,
        "slope_at_90_percent": 2.8 + 2 * bend * long,
    }
    for name, value in expected.items():
        assert_allclose(getattr(found, name), value, atol=1e-7)


def test_three_lengths_of_two_sizes_have_a_curvature_and_two_lengths_none():
    small, large = np.log([[0.25, 0.25, 0.5], [0.25, 0.5, 0.5]])
    # Lengths 1/2, 3/4 and 1.
    energy = np.array([1.0, 4.0, 9.0])
    expected = np.polyfit(np.log([0.5, 0.75, 1.0]), np.log(energy), 2)[0]
    bend = curvature([(small, large, energy)] * 2).curvature
    assert bend.estimate == pytest.approx(expected)
    for kept in (slice(2), slice(1), slice(0)):
        with pytest.raises(FitError):
            curvature([(small[kept], large[kept], energy[kept])] * 2)


def test_one_seed_has_a_curvature_without_an_interval():
    rng = np.random.default_rng(9)
    small, large = radii(rng, 500)
    found = curvature([(small, large, np.exp(3 * large) * rng.exponential(size=500))])
    assert np.isfinite(found.curvature.estimate)
    assert np.isnan([found.curvature.low, found.slope_at_mean.high]).all()
