"""The figures of the certificate draw whatever a sample has: all of it, or nothing at all."""

import numpy as np
import pandas as pd
import pytest
from matplotlib import pyplot as plt

from branchcrush.packings.contact_laws import OVERLAP_FLAG
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


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")


def drawn(tmp_path, plot, *data):
    """Draw a figure to its file, as the workflow does, and return its Axes."""
    with figure(tmp_path / "figure.png", 50) as ax:
        assert plot(*data, ax) is ax
    assert (tmp_path / "figure.png").stat().st_size > 0
    return ax


def shown(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()] if ax.get_legend() else []


def test_measures_are_shown_with_their_limits(tmp_path):
    ax = drawn(tmp_path, certificate.plot_rest, BOTH_WAYS, LIMITS)
    heights = {line.get_ydata()[0] for line in ax.lines if line.get_linestyle() == "--"}
    assert heights == {1e-6, 1e-4}
    ax = drawn(tmp_path, certificate.plot_overlaps, LOADING, OVERLAP_FLAG)
    assert "flagged from 5%" in shown(ax)


@pytest.mark.parametrize(
    ("states", "legs"), [(BOTH_WAYS, ["loading", "unloading"]), (LOADING, ["loading"])]
)
def test_dissipation_names_the_legs_that_there_are(tmp_path, states, legs):
    assert shown(drawn(tmp_path, certificate.plot_dissipation, states)) == legs


@pytest.mark.parametrize("states", NO_LOAD.values(), ids=NO_LOAD)
@pytest.mark.parametrize(
    ("plot", "data"),
    [
        (certificate.plot_rest, [LIMITS]),
        (certificate.plot_overlaps, [OVERLAP_FLAG]),
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
    assert shown(ax) == labels
    assert ax.get_xlim() == (-0.5, len(loading) - 0.5)
    # Each mark names the seed it stands at.
    for place, label in zip(ax.get_xticks(), ax.get_xticklabels(), strict=True):
        assert label.get_text() == str(int(place) + 3)


@pytest.mark.parametrize("seeds", [0, 2])
def test_packings_that_never_jam_are_no_data(tmp_path, seeds):
    nothing = [np.nan] * seeds
    ax = drawn(tmp_path, certificate.plot_jamming, jamming_of(nothing, nothing))
    assert ax.texts[0].get_text().startswith("no data: in no packing")


def test_figure_without_data_says_why(tmp_path):
    text = "no packing is certified at the end of its loading: 0 of 1 carry load there"
    ax = drawn(tmp_path, lambda ax: reason(ax, text))
    assert ax.texts[0].get_text().replace("\n", " ") == f"no data: {text}"
