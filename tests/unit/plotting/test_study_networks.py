"""The networks of all samples in one figure: points and lines against their tables."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting import study_networks
from branchcrush.plotting.study import sample_styles
from branchcrush.study.kinds import SampleKind

pytestmark = pytest.mark.filterwarnings("error")
STYLES = sample_styles(
    {
        "sand": SampleKind("walls", "hertz", {"form": "sand"}),
        "mud": SampleKind("periodic", "linear", {"form": "mud"}),
    }
)


def states():
    return pd.DataFrame(
        {
            "sample": ["sand", "sand", "sand", "mud"],
            "void_ratio": [0.6, 0.5, 0.45, 0.4],
            "coordination_number": [4.0, 5.0, 5.5, 6.0],
            "mechanical_coordination_number": [5.54, 7.5, 8.0, 7.0],
            "isostatic_number": [5.5, 5.5, 5.5, 6.0],
            # Too near jamming to tell, and not above isostatic: the first two are left out.
            "solid_fraction_above_jamming": [0.02, 0.0005, 0.09, 0.04],
        }
    )


def drawn(ax, count):
    """Return x and y of the first sets of points."""
    return [
        np.array([line.get_xdata(), line.get_ydata()], dtype=float) for line in ax.lines[:count]
    ]


def test_coordination_stands_at_the_void_ratio_of_each_state():
    ax = study_networks.plot_coordination(states(), STYLES)
    sand, sand_bearing, mud, mud_bearing = drawn(ax, 4)
    assert_allclose(sand, [[0.6, 0.5, 0.45], [4.0, 5.0, 5.5]])
    assert_allclose(sand_bearing, [[0.6, 0.5, 0.45], [5.54, 7.5, 8.0]])
    assert_allclose(mud, [[0.4], [6.0]])
    assert_allclose(mud_bearing, [[0.4], [7.0]])


def test_historic_relations_span_the_void_ratios(shown):
    ax = study_networks.plot_coordination(states(), STYLES)
    for label, at_largest in (
        # At e = 0.6: 26.486 - 10.726 * 1.6, 12/1.6, and pi 1.6/0.6.
        ("Smith 1929", 9.3244),
        ("Field 1963", 7.5),
        ("Gray 1968", 8.37758),
    ):
        e, number = shown.line(ax, label)
        assert (e[0], e[-1]) == pytest.approx((0.4, 0.6))
        assert number[-1] == pytest.approx(at_largest, rel=1e-5)


def test_jamming_law_is_above_isostatic_of_states_that_tell():
    ax = study_networks.plot_jamming_law(states(), STYLES)
    sand, mud = drawn(ax, 2)
    assert_allclose(sand, [[0.09], [2.5]])
    assert_allclose(mud, [[0.04], [1.0]])
    assert [line.get_marker() for line in ax.lines[:2]] == ["^", "o"]
    # 7.8 sqrt(phi - phi_J)
    law = ax.lines[2]
    assert law.get_xdata()[0] == pytest.approx(1e-3)
    assert_allclose(law.get_ydata()[[0, -1]], [7.8 * 1e-3**0.5, 7.8 * 0.2**0.5])


def two_states(columns):
    """Return tables of both samples: the numbers at the end, and ten times them near jamming."""
    near = {key: np.multiply(10, value) for key, value in columns.items()}
    table = pd.concat(
        [pd.DataFrame({"where": "near_jamming", **near}), pd.DataFrame({"where": "end", **columns})]
    )
    return {"sand": table, "mud": table}


def test_branch_shielding_is_that_of_bins_of_20_branches_at_the_end():
    tables = two_states(
        {
            "mean_radius_ratio": [0.1, 0.5, 0.9],
            "branches": [19, 20, 300],
            "energy_ratio": [0.2, 0.6, 1.1],
        }
    )
    ax = study_networks.plot_branch_shielding(tables, STYLES)
    for points in drawn(ax, 2):
        assert_allclose(points, [[0.5, 0.9], [0.6, 1.1]])
    assert [line.get_markerfacecolor() for line in ax.lines[:2]] == ["none", STYLES["mud"]["color"]]
    assert [line.get_linestyle() for line in ax.lines[:2]] == ["--", "-"]
    assert ax.lines[2].get_ydata()[0] == 1.0


def test_grain_shielding_is_that_of_all_grains_at_the_end_with_the_claim():
    tables = two_states(
        {
            "mean_neighbour_ratio": [0.5, 1.5, 3.0],
            "grains": [9, 10, 40],
            "energy_per_contact": [0.2, 1.2, 0.7],
        }
    )
    tables = {name: table.assign(grains_counted="all") for name, table in tables.items()}
    extra = tables["sand"].assign(grains_counted="load-bearing", energy_per_contact=99.0)
    tables["sand"] = pd.concat([extra, tables["sand"]])
    ax = study_networks.plot_grain_shielding(tables, STYLES)
    for points in drawn(ax, 2):
        assert_allclose(points, [[1.5, 3.0], [1.2, 0.7]])
    assert [line.get_xdata()[0] for line in ax.lines[3:4]] == [10.0]
    assert ax.lines[4].get_ydata()[0] == 0.1
    assert ax.get_ylim()[0] == pytest.approx(5e-4)


def test_stress_is_the_share_less_that_of_the_volume():
    tables = two_states({"volume_share": [0.0, 0.5, 1.0], "stress_share": [0.0, 0.4, 1.0]})
    ax = study_networks.plot_stress(tables, STYLES)
    for points in drawn(ax, 2):
        assert_allclose(points, [[0.0, 0.5, 1.0], [0.0, -0.1, 0.0]], atol=1e-12)
    assert ax.get_xlim() == (0.0, 1.0)


def test_forces_are_densities_of_bins_of_five_contacts_at_the_end():
    tables = two_states(
        {
            "force_low": [0.0, 1.0, 2.0],
            "force_high": [1.0, 2.0, 4.0],
            "contacts": [4, 5, 90],
            "density": [0.9, 0.5, 0.1],
        }
    )
    ax = study_networks.plot_forces(tables, STYLES)
    for points in drawn(ax, 2):
        assert_allclose(points, [[1.5, 3.0], [0.5, 0.1]])
    f = ax.lines[2].get_xdata()
    assert_allclose(ax.lines[2].get_ydata(), np.exp(-f))
    assert ax.get_yscale() == "log"
