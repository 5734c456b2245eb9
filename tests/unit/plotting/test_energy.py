"""Figures 5 and 6 and the exponent along the path: points and lines against table and fit."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.energy.fit import EndState, EnergySplitFit
from branchcrush.energy.state_fit import Curvature, StateFit
from branchcrush.plotting import energy
from branchcrush.statistics.intervals import Interval

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = float("nan")


def fit_of(exponent=(2.0, 1.5, 2.5), seeds=4):
    packings = dict.fromkeys(EndState.__dataclass_fields__, 0.0)
    packings |= {"seeds": seeds, "branches": 1000, "solid_fraction": 0.7}
    return EnergySplitFit(
        exponent=Interval(*exponent),
        confidence=0.9,
        amplitude=1.0,
        reference_length=2e-3,
        exponent_of_each_seed=(2.0,) * seeds,
        mean_of_seed_exponents=2.0,
        packings=EndState(**packings),
        cubic_slope=0.5,
        cubic_r_squared=0.98,
        end=StateFit((), Curvature.without("not asked")),
        near_jamming=None,
    )


TABLE = pd.DataFrame(
    {
        "branch_length_m": [np.nan, 1e-3, 2e-3, 4e-3],
        "branches": [0, 99, 100, 500],
        "f": [np.nan, 0.2, 1.0, 3.0],
    }
)


def test_energy_split_is_the_table_over_the_reference_length(shown):
    ax = energy.plot_energy_split(TABLE, fit_of())
    assert_allclose(shown.line(ax, "4 seeds, bin means"), [[0.5, 1.0, 2.0], [0.2, 1.0, 3.0]])
    x, y = shown.line(ax, "$(l/l_r)^n$, n = 2.00 (1.50 to 2.50)")
    assert (x[0], x[-1]) == pytest.approx((0.0, 2.06))
    assert_allclose(y, x**2)
    assert ax.get_ylim() == pytest.approx((0.0, 1.35 * 3.0))
    assert ax.get_legend().get_title().get_text() == r"$\phi$ = 0.700, 90% interval"


def test_band_is_between_the_limits_of_the_exponent(shown):
    x, low, high = shown.band(energy.plot_energy_split(TABLE, fit_of()).collections[0])
    # Below the reference length the larger exponent is the lower end.
    assert low[-1] == pytest.approx(x[-1] ** 1.5)
    assert high[-1] == pytest.approx(x[-1] ** 2.5)
    assert low[50] == pytest.approx(x[50] ** 2.5)
    assert high[50] == pytest.approx(x[50] ** 1.5)


def test_one_seed_has_no_band(shown):
    ax = energy.plot_energy_split(TABLE, fit_of((2.0, NOTHING, NOTHING), seeds=1))
    assert not ax.collections
    assert "$(l/l_r)^n$, n = 2.00 (one seed: no interval)" in shown.texts(ax)
    assert ax.get_legend().get_title().get_text() == r"$\phi$ = 0.700"


def test_thin_bins_are_marked_with_their_counts_and_empty_ones_counted(shown):
    ax = energy.plot_energy_split(TABLE, fit_of())
    (count,) = ax.texts
    assert count.get_text() == "99"
    assert count.xy == pytest.approx((0.5, 0.2))
    assert "small numbers: branches in bins\nbelow 100; 1 bins are empty" in shown.texts(ax)


def test_cubic_is_the_table_over_the_cube_of_the_length(shown):
    ax = energy.plot_cubic(TABLE, fit_of())
    assert_allclose(shown.line(ax, "4 seeds, bin means"), [[0.125, 1.0, 8.0], [0.2, 1.0, 3.0]])
    x, y = shown.line(ax, "f = 0.500 $(l/l_r)^3$, $R^2$ = 0.9800")
    assert_allclose(x, [0.0, 8.24])
    assert_allclose(y, [0.0, 4.12])
    assert "bins below 100 branches: 99" in shown.texts(ax)


# --- along the path ------------------------------------------------------------------------------


def path(exponents=(2.5, 3.5), above=(0.01, 0.05), half=0.25):
    exponents = np.array(exponents)
    return pd.DataFrame(
        {
            "solid_fraction": [0.65, 0.69][: len(exponents)],
            "solid_fraction_above_jamming": above,
            "mean_stress_Pa": [1e6, 2e7][: len(exponents)],
            "exponent": exponents,
            "exponent_low": exponents - half,
            "exponent_high": exponents + 2 * half,
        }
    )


def test_exponents_are_drawn_with_their_band_and_the_papers(shown):
    ax = energy.plot_exponent_path(path(), fit_of())
    assert_allclose(shown.line(ax, "binned fit of all seeds"), [[0.01, 0.05], [2.5, 3.5]])
    band = shown.band(ax.collections[0])
    assert_allclose(band, [[0.01, 0.05], [2.25, 3.25], [3.0, 4.0]])
    assert ax.collections[0].get_label() == "90% interval, 4 seeds"
    assert shown.line(ax, "the paper's n = 3")[1].tolist() == [3.0, 3.0]


def test_stresses_stand_above_the_states_they_belong_to():
    ax = energy.plot_exponent_path(path(), fit_of())
    (top,) = (other for other in ax.figure.axes if other is not ax)
    assert top.get_xlim() == ax.get_xlim()
    assert_allclose(top.get_xticks(), [0.01, 0.05])
    assert [text.get_text() for text in top.get_xticklabels()] == ["1", "20"]


def test_stresses_that_would_overlap_are_left_out_but_for_the_last():
    ax = energy.plot_exponent_path(path(above=(0.01, 0.012)), fit_of())
    (top,) = (other for other in ax.figure.axes if other is not ax)
    assert [text.get_text() for text in top.get_xticklabels()] == ["20"]


def test_states_without_an_exponent_are_left_out(shown):
    ax = energy.plot_exponent_path(path(exponents=(np.nan, 3.5)), fit_of())
    assert_allclose(shown.line(ax, "binned fit of all seeds"), [[0.05], [3.5]])


def test_wide_bands_do_not_dwarf_the_exponents():
    ax = energy.plot_exponent_path(path(half=50.0), fit_of())
    assert ax.get_ylim() == pytest.approx((0.5, 5.5))


@pytest.mark.parametrize("unknown", [False, True])
def test_one_state_is_a_point_with_its_interval_on_an_axis_of_some_width(shown, unknown):
    table = path(exponents=(2.5,), above=(np.nan if unknown else 0.19,))
    ax = energy.plot_exponent_path(table, fit_of())
    x = 0.65 if unknown else 0.19
    assert_allclose(shown.line(ax, "binned fit of all seeds"), [[x], [2.5]])
    assert_allclose(shown.bars(ax.containers[0]), [[2.25], [3.0]])
    low, high = ax.get_xlim()
    assert high - low > 0.049 and low < x < high
