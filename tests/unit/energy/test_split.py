"""The energy split of data whose exponent is known, and the paper's cubic."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.energy.split import PAPER_EXPONENT, cubic_r_squared, energy_split
from branchcrush.statistics.power_law import PowerLaw

# --- energy-split function -----------------------------------------------------------------------


def test_energy_split_is_1_at_the_reference_length_on_the_fitted_law():
    length = np.array([0.5, 1.05, 1.5, 2.0])
    counts = np.array([1.0, 2.0, 3.0, 4.0])
    law = PowerLaw(7.0, 2.5)
    sums = np.stack([counts, counts * length, counts * 7 * length**2.5])
    table, reference = energy_split(sums, law, 1.0)
    # The bin nearest to R_max is that of mean length 1.05.
    assert reference == 1.05
    assert_allclose(table["f"], (length / 1.05) ** 2.5, rtol=1e-14)
    assert table["f"][1] == pytest.approx(1.0, rel=1e-14)
    assert_allclose(table["branch_length_m"], length, rtol=1e-15)
    assert_allclose(table["mean_energy_J"], 7 * length**2.5, rtol=1e-14)
    assert table["branches"].tolist() == [1, 2, 3, 4]
    assert table["branches"].dtype.kind == "i"


def test_noise_of_the_reference_bin_does_not_move_the_other_bins():
    sums = np.array([[9.0, 4.0], [9.0, 8.0], [9.0, 32.0]])
    noisy = sums.copy()
    noisy[2, 0] *= 1.3
    law = PowerLaw(1.0, 3.0)
    (table, _), (other, _) = energy_split(sums, law, 1.0), energy_split(noisy, law, 1.0)
    assert table["f"][1] == other["f"][1] == 8.0
    assert other["f"][0] == pytest.approx(1.3)


@pytest.mark.filterwarnings("error")
def test_empty_bins_are_nan_and_never_the_reference():
    sums = np.array([[4.0, 0.0, 2.0], [2.0, 0.0, 4.0], [0.5, 0.0, 16.0]])
    table, reference = energy_split(sums, PowerLaw(1.0, 3.0), 1.0)
    assert reference == 0.5
    assert_array_equal(table["f"], [1.0, np.nan, 64.0])
    assert_array_equal(table["mean_energy_J"], [0.125, np.nan, 8.0])
    assert_array_equal(table["branch_length_m"], [0.5, np.nan, 2.0])
    assert table["branches"].tolist() == [4, 0, 2]


# --- the paper's cubic ---------------------------------------------------------------------------


def test_exact_cubic_has_its_slope_and_an_r_squared_of_1():
    relative = np.array([0.1, 0.5, 1.0, 2.0])
    assert_allclose(cubic_r_squared(relative, 0.8 * relative**3), (0.8, 1.0), rtol=1e-14)
    assert PAPER_EXPONENT == 3.0


def test_cubic_of_three_bins_worked_by_hand():
    # x = 0, 1, 8; f = 1, 0, 8: slope 64/65, residuals 1, -64/65, 8/65.
    slope, r_squared = cubic_r_squared([0.0, 1.0, 2.0], [1.0, 0.0, 8.0])
    assert slope == pytest.approx(64 / 65, rel=1e-14)
    residual = 1 + (64 / 65) ** 2 + (8 / 65) ** 2
    assert r_squared == pytest.approx(1 - residual / (4 + 9 + 25), rel=1e-14)


def test_curve_worse_than_its_mean_has_a_negative_r_squared():
    assert cubic_r_squared([1.0, 2.0], [8.0, 1.0])[1] < 0


@pytest.mark.filterwarnings("error")
def test_empty_bins_are_left_out_of_the_cubic():
    whole = cubic_r_squared([1.0, 1.5, 2.0], [1.0, 3.0, 9.0])
    length, f = [np.nan, 1.0, 1.5, 2.0], [np.nan, 1.0, 3.0, 9.0]
    assert cubic_r_squared(length, f) == whole
