"""The figures of the certificate draw whatever a sample has: all of it, or nothing at all."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting import certificate
from branchcrush.plotting.style import figure, reason
from branchcrush.samples.certificate import LIMITS

pytestmark = pytest.mark.filterwarnings("error")


def states_of(loaded, legs="lluu"):
    count = len(legs)
    return pd.DataFrame(
        {
            "leg": ["loading" if leg == "l" else "unloading" for leg in legs],
            "carries_load": loaded,
            "solid_fraction": 0.6 + 0.02 * np.arange(count),
            "unbalanced_force_ratio": 1e-8,
            "inertial_number": 1e-7,
            "stress_identity_error": 0.0,
            "dissipated_share": 0.2,
            "median_overlap_ratio": 0.01,
            "overlap_ratio_95": 0.02,
            "max_overlap_ratio": 0.03,
        }
    )


BOTH_WAYS = states_of([True] * 4)
LOADING = states_of([False, True, True, True], "llll")
NO_LOAD = {"no load": states_of([False] * 4), "no state": BOTH_WAYS[:0]}


def jamming_of(loading, unloading):
    return pd.DataFrame(
        {
            "seed": np.arange(3, 3 + len(loading)),
            "jamming_solid_fraction_loading": loading,
            "uncertainty_loading": 1e-4,
            "jamming_solid_fraction_unloading": unloading,
            "uncertainty_unloading": 1e-4,
        }
    )


def drawn(tmp_path, plot, *data):
    """Draw a figure to its file, as the workflow does, and return its Axes."""
    with figure(tmp_path / "figure.png", 50) as ax:
        assert plot(*data, ax) is ax
    assert (tmp_path / "figure.png").stat().st_size > 0
    return ax


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()] if ax.get_legend() else []


def test_measures_are_shown_with_their_limits(tmp_path, shown):
    limits = {
        "unbalanced_force_ratio": 1e-6,
        "inertial_number": 1e-4,
        "stress_identity_error": 1e-5,
    }
    ax = drawn(tmp_path, certificate.plot_rest, BOTH_WAYS, limits)
    phi = [0.6, 0.62, 0.64, 0.66]
    for column, label, floor in (
        ("unbalanced_force_ratio", "unbalanced force ratio", 1e-8),
        ("inertial_number", "inertial number", 1e-7),
        # 0 has no place on a logarithmic axis.
        ("stress_identity_error", "stress of branches against boundary", 1e-16),
    ):
        assert_allclose(shown.line(ax, label), [phi, [floor] * 4])
        measure = next(line for line in ax.lines if line.get_label() == label)
        dashed = [line for line in ax.lines if line.get_linestyle() == "--"]
        (limit,) = (line for line in dashed if line.get_color() == measure.get_color())
        assert limit.get_ydata()[0] == limits[column]


def test_overlaps_are_in_per_cent_of_loaded_states(tmp_path, shown):
    ax = drawn(tmp_path, certificate.plot_overlaps, LOADING, 0.05)
    for label, percent in (("median", 1.0), ("95 % of the contacts", 2.0), ("largest", 3.0)):
        assert_allclose(shown.line(ax, label), [[0.62, 0.64, 0.66], [percent] * 3])
    assert_allclose(shown.line(ax, "noted from 5%")[1], 5.0)


def test_dissipation_is_in_per_cent_of_the_work_by_leg(tmp_path, shown):
    states = BOTH_WAYS.assign(dissipated_share=[0.1, 0.2, 0.3, 0.4])
    ax = drawn(tmp_path, certificate.plot_dissipation, states)
    assert_allclose(shown.line(ax, "loading"), [[0.6, 0.62], [10, 20]])
    assert_allclose(shown.line(ax, "unloading"), [[0.64, 0.66], [30, 40]])
    assert ax.get_ylim()[0] == 0.0


def test_states_that_differ_by_rounding_are_drawn_on_an_axis_of_some_width(tmp_path):
    one = BOTH_WAYS.assign(solid_fraction=[0.71, 0.71 + 1e-9, 0.71, 0.71])
    for plot, *data in (
        (certificate.plot_rest, LIMITS),
        (certificate.plot_overlaps, 0.05),
        (certificate.plot_dissipation,),
    ):
        low, high = drawn(tmp_path, plot, one, *data).get_xlim()
        assert high - low > 0.049 and low < 0.71 < high


@pytest.mark.parametrize(
    ("states", "legs"), [(BOTH_WAYS, ["loading", "unloading"]), (LOADING, ["loading"])]
)
def test_dissipation_names_the_legs_that_there_are(tmp_path, states, legs):
    assert legend(drawn(tmp_path, certificate.plot_dissipation, states)) == legs


@pytest.mark.parametrize("states", NO_LOAD.values(), ids=NO_LOAD)
@pytest.mark.parametrize(
    ("plot", "data"),
    [
        (certificate.plot_rest, [LIMITS]),
        (certificate.plot_overlaps, [0.05]),
        (certificate.plot_dissipation, []),
    ],
)
def test_without_load_each_panel_says_so(tmp_path, states, plot, data):
    ax = drawn(tmp_path, plot, states, *data)
    assert ax.texts[0].get_text() == "no data: no saved state carries load"


@pytest.mark.parametrize(
    ("loading", "unloading", "labels"),
    [
        ([0.64, 0.65], [0.66, np.nan], ["loading: mean 0.6450", "unloading: mean 0.6600"]),
        ([0.64], [np.nan], ["loading: mean 0.6400"]),
        ([0.64 + 0.001 * k for k in range(16)], [np.nan] * 16, ["loading: mean 0.6475"]),
    ],
)
def test_jamming_points_are_shown_seed_by_seed(tmp_path, loading, unloading, labels):
    ax = drawn(tmp_path, certificate.plot_jamming, jamming_of(loading, unloading))
    assert legend(ax) == labels
    assert ax.get_xlim() == (-0.5, len(loading) - 0.5)
    # Each mark names the seed it stands at.
    for place, label in zip(ax.get_xticks(), ax.get_xticklabels(), strict=True):
        assert label.get_text() == str(int(place) + 3)


def test_each_jamming_point_has_the_uncertainty_of_its_leg(tmp_path, shown):
    table = jamming_of([0.64, 0.65], [0.66, 0.68]).assign(uncertainty_unloading=[2e-3, 3e-3])
    ax = drawn(tmp_path, certificate.plot_jamming, table)
    loading, unloading = ax.containers
    assert_allclose(shown.points(loading[0]), [[-0.1, 0.9], [0.64, 0.65]])
    assert_allclose(shown.points(unloading[0]), [[0.1, 1.1], [0.66, 0.68]])
    assert_allclose(shown.bars(loading), [[0.6399, 0.6499], [0.6401, 0.6501]])
    assert_allclose(shown.bars(unloading), [[0.658, 0.677], [0.662, 0.683]])


@pytest.mark.parametrize("seeds", [0, 2])
def test_packings_that_never_jam_are_no_data(tmp_path, seeds):
    nothing = [np.nan] * seeds
    ax = drawn(tmp_path, certificate.plot_jamming, jamming_of(nothing, nothing))
    assert ax.texts[0].get_text().startswith("no data: in no packing")


def test_figure_without_data_says_why(tmp_path):
    text = "no packing is certified at the end of its loading: 0 of 1 carry load there"
    ax = drawn(tmp_path, lambda ax: reason(ax, text))
    assert ax.texts[0].get_text().replace("\n", " ") == f"no data: {text}"


def convergence_row(quantity, verdict, difference=0.0, could_see=0.02, by="pairs"):
    return {
        "quantity": quantity,
        "verdict": verdict,
        "difference": difference,
        "could_see": could_see,
        "tolerance": 0.1,
        "seeds": 16 if by == "ensembles" else 4,
        "seeds_at_twice_the_steps": 4,
        "compared_by": by,
    }


def test_convergence_is_drawn_over_what_is_allowed_with_its_interval(tmp_path, shown):
    rows = [
        convergence_row("exponent", "not decided", 0.05, 0.15, by="ensembles"),
        convergence_row("work_J", ""),
        convergence_row("mean_stress_Pa", "converged", -0.03, 0.02),
        convergence_row("jamming_solid_fraction", "not converged", 0.2, 0.05),
    ]
    ax = drawn(tmp_path, certificate.plot_convergence, rows)
    places = [text.get_text() for text in ax.get_yticklabels()]
    assert places == ["$n$ (16 against 4)", "mean stress (4 pairs)", r"$\phi_J$ (4 pairs)"]
    points = {
        container.get_label(): (shown.points(container[0]), shown.bars(container, "x"))
        for container in ax.containers
    }
    for verdict, place, change, ends in (
        ("not decided", 0, 0.5, [-1.0, 2.0]),
        ("converged", 1, -0.3, [-0.5, -0.1]),
        ("not converged", 2, 2.0, [1.5, 2.5]),
    ):
        point, bar = points[verdict]
        assert_allclose(point.ravel(), [change, place])
        assert_allclose(bar.ravel(), ends)
    assert legend(ax) == ["allowed", "converged", "not converged", "not decided"]


def test_one_pair_is_a_point_without_a_bar(tmp_path):
    rows = [convergence_row("mean_stress_Pa", "not decided", 0.01, missing) for missing in (None,)]
    ax = drawn(tmp_path, certificate.plot_convergence, rows)
    assert legend(ax) == ["allowed", "not decided"]


@pytest.mark.parametrize("sign", [-1, 1])
def test_far_changes_are_at_the_edge_and_do_not_hide_the_near_ones(tmp_path, shown, sign):
    rows = [convergence_row("mean_stress_Pa", "not converged", sign * 50.0, 1.0)]
    ax = drawn(tmp_path, certificate.plot_convergence, rows)
    low, high = ax.get_xlim()
    assert low >= -4.5 and high <= 4.5
    (points,) = ax.containers
    assert low <= shown.points(points[0])[0, 0] <= high


@pytest.mark.parametrize("rows", [[], [convergence_row("work_J", "")]])
def test_without_a_second_run_the_panel_says_so(tmp_path, rows):
    ax = drawn(tmp_path, certificate.plot_convergence, rows)
    assert ax.texts[0].get_text().startswith("no data: no packing certified with twice")
