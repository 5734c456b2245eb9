"""Forces, stress and fabric: points, bars and lines against the tables they are drawn from."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex
from numpy.testing import assert_allclose

from branchcrush.plotting import forces
from branchcrush.plotting.style import STATES

pytestmark = pytest.mark.filterwarnings("error")
# R_M [m]: lengths and radii are drawn over it.
LARGEST = 2e-3


def both(columns):
    """Return columns as rows near jamming, and ten times the numbers but for `x` at the end."""
    tables = []
    for where, scale in (("near_jamming", 1.0), ("end", 10.0)):
        scaled = {
            key: np.multiply(scale, value) for key, (value, grows) in columns.items() if grows
        }
        kept = {key: value for key, (value, grows) in columns.items() if not grows}
        tables.append(pd.DataFrame({"where": where, **kept, **scaled}))
    return pd.concat(tables, ignore_index=True)


def measured(**estimates):
    """Return columns that grow, each with limits 0.2 below and 0.3 above."""
    return {
        name + part: (np.add(values, shift), True)
        for name, values in estimates.items()
        for part, shift in (("", 0.0), ("_low", -0.2), ("_high", 0.3))
    }


# --- distribution of forces ----------------------------------------------------------------------


DENSITIES = {
    "force_low": ([0.0, 1.0, 3.0], False),
    "force_high": ([1.0, 3.0, 5.0], False),
    "contacts": ([50, 20, 0], False),
    **measured(density=[0.8, 0.4, 0.0]),
}
TAIL = {"share_above": 0.25, "decay_rate": 2.0}


def tails(end=TAIL):
    def part(tail):
        return {"forces": {"tails": [{"threshold": 1.0, **TAIL}, {"threshold": 2.0, **tail}]}}

    return {"near_jamming": part(TAIL), "end": part(end)}


def test_forces_are_densities_in_the_middle_of_bins_that_hold_contacts(shown):
    near, end = forces.plot_force_distribution(both(DENSITIES), tails()).containers
    assert_allclose(shown.points(near[0]), [[0.5, 2.0], [0.8, 0.4]])
    assert_allclose(shown.bars(near), [[0.6, 0.2], [1.1, 0.7]])
    assert_allclose(shown.points(end[0]), [[0.5, 2.0], [8.0, 4.0]])
    for drawn, where in ((near, "near_jamming"), (end, "end")):
        assert drawn.get_label() == STATES[where][0]
        assert to_hex(drawn[0].get_color()) == STATES[where][1]


def test_tail_holds_the_share_of_the_forces_above_its_threshold(shown):
    ax = forces.plot_force_distribution(both(DENSITIES), tails())
    dashed = [line for line in ax.lines if line.get_linestyle() == "--"]
    assert len(dashed) == 2
    f, density = shown.points(dashed[0])
    # 0.25 * 2 exp(-2 (f - 2)) from 2 to the last bin, or 3.
    assert (f[0], f[-1]) == (2.0, 3.0)
    assert_allclose(density, 0.5 * np.exp(-2.0 * (f - 2.0)))


def test_forces_without_a_tail_have_no_line_of_it():
    none = {"share_above": 0.0, "decay_rate": None}
    ax = forces.plot_force_distribution(both(DENSITIES), tails(end=none))
    assert sum(line.get_linestyle() == "--" for line in ax.lines) == 1


def test_one_state_is_drawn_alone():
    table = both(DENSITIES)
    ends = table[table["where"] == "end"]
    (only,) = forces.plot_force_distribution(ends, {"end": tails()["end"]}).containers
    assert only.get_label() == "at the end"


# --- force by length -----------------------------------------------------------------------------


def test_force_by_length_is_drawn_over_the_largest_radius(shown):
    table = both(
        {
            "branch_length_low_m": ([1e-3, 2e-3, 3e-3], False),
            "branch_length_high_m": ([2e-3, 3e-3, 4e-3], False),
            "branches": ([19, 20, 500], False),
            **measured(mean_force=[0.5, 1.0, 1.5]),
        }
    )
    fit = {"exponent": 2.0, "exponent_low": 1.5, "exponent_high": 2.5}
    summary = {"near_jamming": {"forces": {"by_length": {}}}, "end": {"forces": {"by_length": fit}}}
    ax = forces.plot_force_by_length(table, summary, LARGEST)
    near, end = ax.containers
    # Bins of 19 branches are left out.
    assert_allclose(shown.points(near[0]), [[1.25, 1.75], [1.0, 1.5]])
    assert_allclose(shown.bars(near), [[0.8, 1.3], [1.3, 1.8]])
    assert_allclose(shown.points(end[0])[1], [10.0, 15.0])
    assert near.get_label() == "near jamming"
    assert end.get_label() == "at the end: m = 2.00 (1.50 to 2.50)"
    assert ax.lines[-1].get_ydata()[0] == 1.0


# --- stress --------------------------------------------------------------------------------------


def stresses():
    return both(
        {
            "mean_radius_m": ([0.5e-3, 2e-3], False),
            "grains": ([700, 30], False),
            "load_bearing_stress_ratio": ([0.9, 1.1], True),
            **measured(stress_ratio=[0.5, 1.25]),
        }
    )


def test_stress_stands_at_the_radius_of_the_grains(shown):
    ax = forces.plot_stress_by_radius(stresses(), LARGEST)
    near, end = ax.containers
    assert_allclose(shown.points(near[0]), [[0.25, 1.0], [0.5, 1.25]])
    assert_allclose(shown.bars(near), [[0.3, 1.05], [0.8, 1.55]])
    assert_allclose(shown.points(end[0]), [[0.25, 1.0], [5.0, 12.5]])
    without = shown.line(ax, "near jamming, without rattlers")
    assert_allclose(without, [[0.25, 1.0], [0.9, 1.1]])
    assert_allclose(shown.line(ax, "at the end, without rattlers")[1], [9.0, 11.0])


@pytest.mark.parametrize(("largest", "top"), [(1.0, 1.5), (2.0, 2.3), (50.0, 3.5)])
def test_stress_has_a_scale_that_holds_it_but_for_few_large_ratios(largest, top):
    table = stresses()
    table["stress_ratio"] = table["load_bearing_stress_ratio"] = largest
    ax = forces.plot_stress_by_radius(table, LARGEST)
    assert ax.get_ylim() == pytest.approx((0.0, top))


def test_shares_of_stress_are_lines_with_bands_beside_the_diagonal(shown):
    x = [0.0, 0.5, 1.0]
    table = pd.concat(
        pd.DataFrame(
            {
                "where": where,
                "volume_share": x,
                "stress_share": [0.0, middle, 1.0],
                "stress_share_low": [0.0, middle - 0.05, 1.0],
                "stress_share_high": [0.0, middle + 0.1, 1.0],
            }
        )
        for where, middle in (("near_jamming", 0.3), ("end", 0.4))
    )
    index = {"sharing_index": 0.1, "sharing_index_low": 0.05, "sharing_index_high": 0.15}
    one = {"sharing_index": 0.2, "sharing_index_low": None, "sharing_index_high": None}
    summary = {"near_jamming": {"stress": index}, "end": {"stress": one}}
    ax = forces.plot_stress_sharing(table, summary)
    near, end, same = ax.lines
    assert_allclose(shown.points(near), [x, [0.0, 0.3, 1.0]])
    assert_allclose(shown.points(end), [x, [0.0, 0.4, 1.0]])
    assert_allclose(shown.points(same), [[0, 1], [0, 1]])
    assert_allclose(shown.band(ax.collections[0])[1:, 1], [0.25, 0.4])
    assert_allclose(shown.band(ax.collections[1])[1:, 1], [0.35, 0.5])
    assert shown.texts(ax)[:2] == [
        "near jamming: I = 0.10 (0.05 to 0.15)",
        "at the end: I = 0.20 (one seed: no interval)",
    ]


# --- fabric --------------------------------------------------------------------------------------


def fabric(where="near_jamming", scale=1.0):
    return pd.DataFrame(
        {
            "where": where,
            "expected_deviator": [0.02, 0.025],
            "deviator": [0.01 * scale, 0.03 * scale],
            "expected_force_deviator": [0.04, 0.05],
            "force_deviator": [0.02 * scale, 0.06 * scale],
        }
    )


def ratios(branches, normal):
    kinds = {"branches": branches, "forces": normal}
    return {"fabric": {kind: {"deviator_over_expected": one} for kind, one in kinds.items()}}


SUMMARY = {"near_jamming": ratios(0.5, 0.75), "end": ratios(1.5, 1.75)}


def test_fabric_is_a_point_a_seed_of_branches_and_of_forces(shown):
    table = pd.concat([fabric(), fabric("end", 2.0)])
    ax = forces.plot_fabric(table, SUMMARY)
    for label, points in (
        ("branches, near jamming: 0.50", [[0.02, 0.025], [0.01, 0.03]]),
        ("forces, near jamming: 0.75", [[0.04, 0.05], [0.02, 0.06]]),
        ("branches, at the end: 1.50", [[0.02, 0.025], [0.02, 0.06]]),
        ("forces, at the end: 1.75", [[0.04, 0.05], [0.04, 0.12]]),
    ):
        assert_allclose(shown.line(ax, label), points)
    assert ax.get_xlim()[1] == pytest.approx(1.1 * 0.05)
    assert ax.get_ylim()[1] > 0.12
    assert shown.legend_is_above(ax)


def test_fabric_of_one_state_is_drawn_alone():
    texts = forces.plot_fabric(fabric("end"), {"end": SUMMARY["end"]}).get_legend().get_texts()
    assert [text.get_text().split(":")[0] for text in texts[:2]] == [
        "branches, at the end",
        "forces, at the end",
    ]


def test_band_is_that_of_one_seed_by_chance(shown):
    (band,) = forces.plot_fabric(fabric(), SUMMARY).collections
    x, low, high = shown.band(band)
    # 3/2 times the squared deviator over the expected is chi-squared of five degrees over 5 here:
    # 95 % of it from 0.831 to 12.833.
    assert_allclose(
        [low[-1] / x[-1], high[-1] / x[-1]], np.sqrt([0.8312 / 5, 12.8325 / 5]), rtol=1e-3
    )
