"""Who touches whom: points, bars and lines against the tables they are drawn from."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex
from numpy.testing import assert_allclose

from branchcrush.plotting import branches
from branchcrush.plotting.style import STATES

pytestmark = pytest.mark.filterwarnings("error")

# R_M [m]: lengths are drawn over it.
LARGEST = 2e-3


def numbers(states=(4, 7), low=0.5):
    """Contact numbers of two classes of radius, ten times as large in the later state."""
    rows = [
        {
            "state": state,
            "mean_radius_m": radius,
            "contact_number": scale * contacts,
            "contact_number_low": scale * contacts - low,
            "contact_number_high": scale * contacts + 0.25,
            "contact_number_mean_neighbour": 2.0,
            "contact_number_self_consistent": 3.0,
            "contact_number_parking": 4.0 * contacts,
            "contact_number_rods": 5.0 * contacts,
        }
        for state, scale in zip(states, (1.0, 10.0), strict=False)
        for radius, contacts in ((1e-3, 1.0), (2e-3, 3.0))
    ]
    return pd.DataFrame(rows)


SUMMARY = {
    "near_jamming": {"state": 4, "solid_fraction": 0.65, "assortativity_of_radii": 0.5},
    "end": {"state": 7, "solid_fraction": 0.7, "assortativity_of_radii": -0.1},
}


def test_contact_numbers_stand_at_their_radii_in_the_colour_of_their_state(shown):
    ax = branches.plot_contact_numbers(numbers(), SUMMARY, LARGEST)
    near, end = ax.containers
    assert_allclose(shown.points(near[0]), [[0.5, 1.0], [1.0, 3.0]])
    assert_allclose(shown.points(end[0]), [[0.5, 1.0], [10.0, 30.0]])
    assert_allclose(shown.bars(end), [[9.5, 29.5], [10.25, 30.25]])
    for drawn, where in ((near, "near_jamming"), (end, "end")):
        assert to_hex(drawn[0].get_color()) == STATES[where][1]
    assert [drawn.get_label() for drawn in (near, end)] == [
        r"near jamming, $\phi$ = 0.650",
        r"at the end, $\phi$ = 0.700",
    ]


def test_models_are_lines_of_their_own_columns(shown):
    ax = branches.plot_contact_numbers(numbers(), SUMMARY, LARGEST)
    assert_allclose(shown.line(ax, "random parking"), [[0.5, 1.0], [4.0, 12.0]])
    assert_allclose(shown.line(ax, "rods that push"), [[0.5, 1.0], [5.0, 15.0]])
    assert_allclose(shown.line(ax, "solid angle, mean neighbour")[1], 2.0)
    assert_allclose(shown.line(ax, "self-consistent, rattler cut")[1], 3.0)


def test_one_state_is_the_end(shown):
    table = numbers(states=(7,))
    ax = branches.plot_contact_numbers(table, {"end": SUMMARY["end"]}, LARGEST)
    (end,) = ax.containers
    assert end.get_label() == r"at the end, $\phi$ = 0.700"
    assert_allclose(shown.points(end[0]), [[0.5, 1.0], [1.0, 3.0]])


def test_contact_numbers_of_one_seed_have_no_bars():
    ax = branches.plot_contact_numbers(numbers(low=np.nan), SUMMARY, LARGEST)
    assert not any(drawn.has_yerr for drawn in ax.containers)


def pairs(expected=100.0, ratios=(2.0, 0.5, 0.5, 1.0), state=7):
    ends = ((0.4e-3, 1e-3), (1e-3, 2e-3))
    rows = [
        {
            "state": state,
            "radius_i_low_m": first[0],
            "radius_i_high_m": first[1],
            "radius_j_low_m": second[0],
            "radius_j_high_m": second[1],
            "expected_contacts": expected,
        }
        for first in ends
        for second in ends
    ]
    return pd.DataFrame(rows).assign(ratio=ratios)


def test_pairs_are_squares_of_the_logarithm_to_base_two():
    ax = branches.plot_pairs(pairs(), SUMMARY, LARGEST)
    (mesh,) = ax.collections
    assert_allclose(mesh.get_array(), [[1.0, -1.0], [-1.0, 0.0]])
    assert_allclose(mesh.get_coordinates()[0, :, 0], [0.2, 0.5, 1.0])
    assert_allclose(mesh.get_clim(), (-1.0, 1.0))
    assert "-0.10" in ax.get_title() and "0.700" in ax.get_title()


def test_pairs_of_few_contacts_and_of_other_states_are_left_out():
    few = pairs().assign(expected_contacts=[100.0, 19.9, 20.0, 100.0])
    other = pairs(state=4, ratios=[4.0] * 4)
    mesh = branches.plot_pairs(pd.concat([other, few]), SUMMARY, LARGEST).collections[0]
    assert np.ma.getmaskarray(mesh.get_array()).tolist() == [[False, True], [False, False]]
    assert mesh.get_clim()[1] == 1.0


def test_pairs_that_never_touch_are_drawn_as_a_quarter():
    mesh = branches.plot_pairs(pairs(ratios=[0.0] * 4), SUMMARY, LARGEST).collections[0]
    assert_allclose(mesh.get_array(), -2.0)


def test_pairs_of_one_radius_are_no_figure():
    one = pairs()[:1]
    ax = branches.plot_pairs(one, SUMMARY, LARGEST)
    assert ax.texts[0].get_text() == "no data: grains of one radius"


def lengths(above=(0.01, 0.05)):
    rows = [
        {
            "solid_fraction": 0.64 + phi,
            "solid_fraction_above_jamming": phi,
            "prediction": name,
            "kolmogorov_smirnov": distance * (1.0 + number),
            "mean_length_m": 1e-3,
            "measured_mean_length_m": 3e-3 - 1e-3 * number,
            "measured_mean_length_low_m": 2.8e-3 - 1e-3 * number,
            "measured_mean_length_high_m": 3.4e-3 - 1e-3 * number,
        }
        for number, phi in enumerate(above)
        for name, distance in (("parking", 0.03), ("configuration", 1e-5))
    ]
    return pd.DataFrame(rows)


def test_distances_are_those_of_each_prediction_along_the_path(shown):
    ax = branches.plot_distances(lengths())
    assert_allclose(shown.line(ax, "random parking"), [[0.01, 0.05], [0.03, 0.06]])
    # Exact but for rounding, on a logarithmic axis.
    assert_allclose(shown.line(ax, "measured contact numbers")[1], 1e-3)
    assert ax.get_yscale() == "log"


def test_where_jamming_is_unknown_the_solid_fraction_itself_is_drawn(shown):
    table = lengths().assign(solid_fraction_above_jamming=np.nan)
    ax = branches.plot_distances(table)
    assert_allclose(shown.line(ax, "random parking")[0], [0.65, 0.69])
    assert ax.get_xlabel() == r"solid fraction $\phi$ [-]"


def test_mean_lengths_are_measured_with_a_band_and_predicted_as_a_level(shown):
    ax = branches.plot_mean_lengths(lengths(), LARGEST)
    assert_allclose(shown.line(ax, "measured"), [[0.01, 0.05], [1.5, 1.0]])
    assert_allclose(shown.band(ax.collections[0]), [[0.01, 0.05], [1.4, 0.9], [1.7, 1.2]])
    levels = [line for line in ax.lines if line.get_linestyle() == "--" and len(line.get_ydata())]
    assert [line.get_ydata()[0] for line in levels] == [0.5]


def test_mean_length_of_one_state_is_a_point_with_a_bar_on_an_axis_of_some_width(shown):
    ax = branches.plot_mean_lengths(lengths(above=(0.05,)), LARGEST)
    assert_allclose(shown.line(ax, "measured"), [[0.05], [1.5]])
    assert_allclose(shown.bars(ax.containers[0]), [[1.4], [1.7]])
    low, high = ax.get_xlim()
    assert high - low == pytest.approx(0.05) and low < 0.05 < high


def test_branch_lengths_are_bars_of_densities_over_the_largest_radius(shown):
    table = pd.DataFrame(
        {
            "length_low_m": [0.0, 2e-3],
            "length_high_m": [2e-3, 4e-3],
            "branches": [400, 1600],
            "density_measured_per_m": [100.0, 400.0],
            "density_measured_standard_error_per_m": [10.0, 20.0],
            "density_random_contact_per_m": [200.0, 300.0],
            "density_parking_per_m": [150.0, 350.0],
            "density_rods_per_m": [250.0, 250.0],
        }
    )
    means = {"mean_length_1_m1": 2.5e-3, "eq4_length_1_m1": 2.2e-3}
    ax = branches.plot_branch_lengths(table, means, LARGEST)
    assert [bar.get_height() for bar in ax.patches] == pytest.approx([0.2, 0.8])
    assert [bar.get_x() + bar.get_width() / 2 for bar in ax.patches] == pytest.approx([0.5, 1.5])
    assert [bar.get_width() for bar in ax.patches] == pytest.approx([1.0, 1.0])
    errors = next(drawn for drawn in ax.containers if drawn.get_label().startswith("standard"))
    assert_allclose(shown.bars(errors), [[0.18, 0.76], [0.22, 0.84]])
    assert_allclose(shown.line(ax, "Eq. 4: any two grains touch alike"), [[0.5, 1.5], [0.4, 0.6]])
    assert_allclose(shown.line(ax, "random parking, at jamming")[1], [0.3, 0.7])
    assert_allclose(shown.line(ax, "rods that push, at jamming")[1], [0.5, 0.5])
    dotted = [line.get_xdata()[0] for line in ax.lines if line.get_linestyle() == ":"]
    assert dotted == pytest.approx([1.25, 1.1])
    assert ax.get_xlim() == (0.0, 2.0)
    assert "measured, 2 000 branches" in shown.texts(ax)
    assert shown.legend_is_above(ax)


def test_states_have_the_colours_of_their_names():
    assert STATES["end"][0] == "at the end" and STATES["near_jamming"][0] == "near jamming"
