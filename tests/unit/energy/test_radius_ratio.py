"""The energy by the ratio of the radii: what was put in comes out, whatever its form."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.energy.radius_ratio import radius_ratio_table


def radii(rng, number, ratios=(0.0, 1.0)):
    large = np.log(rng.uniform(0.2, 1.0, number))
    return large + np.log(rng.uniform(*ratios, number)), large


def test_energies_of_any_form_come_out_in_their_bins():
    rng = np.random.default_rng(1)
    held = np.array([0.1, 0.1, 0.3, 0.2, 0.5, 0.4, 0.6, 0.7, 1.2, 0.9, 1.0])
    seeds = []
    for scale in (1.0, 7.0, 0.2):
        small, large = radii(rng, 600)
        length, ratio = np.exp(small) + np.exp(large), np.exp(small - large)
        edges = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
        seeds.append((small, large, scale * length**2.5 * held[np.searchsorted(edges, ratio)]))
    # One scale: exact. Of three, each with its own ratios, near.
    alone = radius_ratio_table(seeds[:1], 2.5, 3.0, resamples=50)
    last = alone["g_fitted"][-1]
    assert 0.99 < last < 1.0
    assert_allclose(alone["g"], held * last, rtol=1e-9)
    assert np.isnan(alone["g_low"]).all()
    every = radius_ratio_table(seeds, 2.5, 3.0, resamples=50)
    assert_allclose(every["g"], held * last, rtol=0.6)
    assert (every["g_low"][:-1] < every["g_high"][:-1]).all()
    assert every["branches"].sum() == 1800
    assert every["radius_ratio_low"][0] == 0.0 and every["radius_ratio_high"][-1] == 1.0


def test_the_fitted_one_is_its_mean_in_the_bin_and_1_for_equal_radii():
    small, large = np.log([0.25, 0.5]), np.log([0.75, 0.5])
    table = radius_ratio_table([(small, large, np.array([1.0, 2.0]))] * 2, 2.0, 2.0, resamples=20)
    # 4 0.25 0.75 = 0.75, squared.
    assert table["g_fitted"][[4, -1]] == pytest.approx([0.5625, 1.0])
    assert table["g"][[4, -1]] == pytest.approx([0.5, 1.0])
    assert table["mean_radius_ratio"][4] == pytest.approx(1 / 3)
    assert table["branches"][[3, 4, 5]].tolist() == [0, 2, 0]
    assert np.isnan([table[name][3] for name in ("g", "g_fitted", "mean_radius_ratio")]).all()


def test_without_equal_radii_the_most_equal_bin_is_as_fitted():
    rng = np.random.default_rng(2)
    small, large = radii(rng, 400, (0.2, 0.5))
    length = np.exp(small) + np.exp(large)
    energy = length**3 * (4 * np.exp(small + large) / length**2) ** 1.5
    table = radius_ratio_table([(small, large, energy)] * 2, 3.0, 1.5, resamples=20)
    assert_allclose(table["g"][3:6], table["g_fitted"][3:6], rtol=1e-9)
    assert np.isnan(table["g"][6:]).all()
