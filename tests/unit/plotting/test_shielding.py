"""Figures of shielding show the claim's lines wherever the data end, and points where they are."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting.shielding import plot_branch_shielding, plot_grain_shielding
from branchcrush.plotting.style import figure

pytestmark = pytest.mark.filterwarnings("error")


def grains(ratios, grains=50, low=0.8, high=1.2):
    """Energies that fall with the ratio, all grains and load-bearing ones."""
    rows = []
    for where in ("near_jamming", "end"):
        for counted in ("all", "load-bearing"):
            for x in ratios:
                row = {
                    "where": where,
                    "grains_counted": counted,
                    "mean_neighbour_ratio": x,
                    "grains": grains,
                }
                for reading in ("contact", "grain", "volume"):
                    row |= {
                        f"energy_per_{reading}{part}": factor / x
                        for part, factor in (("", 1.0), ("_low", low), ("_high", high))
                    }
                rows.append(row)
    return pd.DataFrame(rows)


def inside(ax, x, y):
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    return left <= x <= right and bottom <= y <= top


@pytest.mark.parametrize("reading", ["contact", "grain", "volume"])
@pytest.mark.parametrize("largest", [2.2, 3.0, 10.0, 20.0])
def test_claims_lines_and_points_are_seen_whatever_the_largest_ratio(tmp_path, reading, largest):
    with figure(tmp_path / "grains.png", 50) as ax:
        plot_grain_shielding(grains(np.geomspace(0.3, largest, 6)), reading, ax)
        assert ax.get_xscale() == ax.get_yscale() == "log"
        for x in (0.3, largest):
            assert inside(ax, x, 1.0 / x)
        assert inside(ax, 10.0, 1.0) and inside(ax, 10.0, 0.1)
        assert {10.0} <= {
            line.get_xdata()[0] for line in ax.lines if len(set(line.get_xdata())) == 1
        }
        assert {0.1, 1.0} <= {
            line.get_ydata()[0] for line in ax.lines if len(line.get_ydata()) == 2
        }
        assert len(ax.containers) == 4
    assert (tmp_path / "grains.png").stat().st_size > 0


def test_energies_of_all_grains_and_of_those_that_bear_load_are_told_apart(shown):
    table = grains([0.5, 2.0])
    table.loc[table["grains_counted"] == "load-bearing", "energy_per_grain"] = 0.9
    ax = plot_grain_shielding(table, "grain")
    near, near_bearing, end, _ = ax.containers
    assert_allclose(shown.points(near[0]), [[0.5, 2.0], [2.0, 0.5]])
    assert_allclose(shown.bars(near), [[1.6, 0.4], [2.4, 0.6]])
    assert_allclose(shown.points(near_bearing[0])[1], 0.9)
    assert [drawn.get_label() for drawn in ax.containers] == [
        "near jamming",
        "near jamming, without rattlers",
        "at the end",
        "at the end, without rattlers",
    ]
    assert_allclose(shown.points(end[0]), [[0.5, 2.0], [2.0, 0.5]])


@pytest.mark.parametrize("reading", ["contact", "grain", "volume"])
def test_each_reading_is_the_column_of_its_name(shown, reading):
    table = grains([2.0])
    table[f"energy_per_{reading}"] = 0.45
    ax = plot_grain_shielding(table, reading)
    assert_allclose(shown.points(ax.containers[0][0]), [[2.0], [0.45]])


def test_bins_of_few_grains_are_not_drawn():
    ax = plot_grain_shielding(grains([0.5, 1.0, 2.0], grains=9))
    assert all(len(drawn[0].get_xdata()) == 0 for drawn in ax.containers)


def test_a_lower_limit_below_zero_is_cut_and_one_seed_has_no_bars():
    ax = plot_grain_shielding(grains([0.5, 1.0], low=-1.0))
    assert np.all([np.isfinite(drawn[2][0].get_segments()).all() for drawn in ax.containers])
    ax = plot_grain_shielding(grains([0.5, 1.0], low=np.nan, high=np.nan))
    assert not any(drawn.has_yerr for drawn in ax.containers)


def test_ratio_of_branches_is_drawn_with_interval_and_exponent():
    q = np.array([0.15, 0.5, 0.95])
    table = pd.concat(
        [
            pd.DataFrame(
                {
                    "where": where,
                    "mean_radius_ratio": q,
                    "branches": [19, 20, 500],
                    "energy_ratio": q,
                    "energy_ratio_low": 0.9 * q,
                    "energy_ratio_high": 1.1 * q,
                }
            )
            for where in ("near_jamming", "end")
        ]
    )
    fit = {"shielding_exponent": 1.0, "shielding_exponent_low": 0.9, "shielding_exponent_high": 1.1}
    summary = {where: {"shielding": {"branches": fit}} for where in ("near_jamming", "end")}
    ax = plot_branch_shielding(table, summary)
    assert_allclose(
        np.asarray(ax.containers[0][0].get_xdata(), dtype=float), q[1:]
    )  # 19 branches are too few
    low, high = np.asarray(ax.containers[0][2][0].get_segments()[0], dtype=float)[:, 1]
    assert_allclose([low, high], [0.45, 0.55])
    assert "s = 1.00 (0.90 to 1.10)" in ax.get_legend().get_texts()[0].get_text()
