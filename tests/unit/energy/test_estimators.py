"""Estimators of n: alike on a power law, and each what an independent fit of the bins gives."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import curve_fit

from branchcrush.energy.estimators import binned_estimators
from branchcrush.errors import FitError

EDGES = np.linspace(0.0, 2.0, 11)
CENTRES = (EDGES[1:] + EDGES[:-1]) / 2


def seed_of(length, energy):
    """Return equal radii of these branch lengths over R_max."""
    return np.log(length / 2), np.log(length / 2), energy


@pytest.mark.parametrize("n", [-1.0, 2.0, 3.3])
def test_of_a_power_law_both_give_its_exponent(n):
    rng = np.random.default_rng(1)
    seeds = []
    for scale in (1e-9, 1e-9, 2e-9):
        length = rng.choice(CENTRES, 200)
        seeds.append(seed_of(length, scale * length**n))
    found = binned_estimators(seeds[:2], EDGES, resamples=100)
    assert list(found) == ["least_squares", "log_log"]
    for exponent in found.values():
        assert_allclose(exponent, n, atol=1e-8)
    # Seeds of another scale move the bins that they are in, and so widen the interval.
    assert binned_estimators(seeds, EDGES, resamples=100)["log_log"].high > n + 1e-3


def test_energies_that_follow_no_power_law_are_fitted_as_by_other_programs():
    rng = np.random.default_rng(2)
    lengths = [rng.triangular(0.3, 1.2, 2.0, 400) for _ in range(4)]
    seeds = [seed_of(x, np.tanh(x - 0.2) * rng.exponential(size=x.size)) for x in lengths]
    every = np.concatenate(lengths)
    energies = np.concatenate([seed[2] for seed in seeds])
    number = np.digitize(every, EDGES) - 1
    used = [k for k in range(10) if (number == k).any()]
    x = np.array([every[number == k].mean() for k in used])
    y = np.array([energies[number == k].mean() for k in used])
    found = binned_estimators(seeds, EDGES, resamples=200)
    (_, n), _ = curve_fit(lambda x, a, n: a * x**n, x, y, p0=(1, 1), ftol=1e-14, xtol=1e-14)
    assert found["least_squares"].estimate == pytest.approx(n, abs=1e-6)
    slope = np.polyfit(np.log(x), np.log(y), 1)[0]
    assert found["log_log"].estimate == pytest.approx(slope, abs=1e-10)
    assert abs(n - slope) > 0.1
    for exponent in found.values():
        assert exponent.low < exponent.estimate < exponent.high


def test_one_seed_has_no_interval():
    length = np.repeat(CENTRES, 3)
    for exponent in binned_estimators([seed_of(length, length**2)], EDGES).values():
        assert exponent.estimate == pytest.approx(2.0)
        assert np.isnan([exponent.low, exponent.high]).all()


@pytest.mark.parametrize("length", [[], [1.1, 1.1]])
def test_branches_in_one_bin_have_no_exponent(length):
    length = np.array(length)
    with pytest.raises(FitError, match="two bins"):
        binned_estimators([seed_of(length, length)] * 2, EDGES)
