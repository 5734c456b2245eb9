"""All samples in one figure: colours and lines by kind, points and lines by the tables."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex
from numpy.testing import assert_allclose

from branchcrush.plotting import study
from branchcrush.study.kinds import SampleKind

pytestmark = pytest.mark.filterwarnings("error")
KIND = SampleKind("walls", "linear", {"form": "any"})


def test_samples_of_one_grading_have_one_colour_and_the_name_they_share():
    other = replace(KIND, grading={"form": "other"})
    hertz = replace(KIND, boundary="periodic", law="hertz")
    styles = study.sample_styles({"sand-a": KIND, "sand-b": hertz, "mud": other})
    assert styles["sand-a"]["color"] == styles["sand-b"]["color"] != styles["mud"]["color"]
    assert [style["grading"] for style in styles.values()] == ["sand", "sand", "mud"]
    assert (styles["sand-a"]["line"], styles["sand-b"]["line"]) == ("--", "-")
    assert styles["sand-a"]["filled"] and not styles["sand-b"]["filled"]
    assert (styles["sand-a"]["law"], styles["sand-b"]["law"]) == ("linear", "hertz")


def test_samples_of_one_grading_and_no_common_word_are_called_by_their_own_names():
    styles = study.sample_styles({"sand": KIND, "mud": KIND})
    assert [style["grading"] for style in styles.values()] == ["sand", "mud"]


def test_legend_tells_boundaries_where_they_vary():
    periodic = replace(KIND, boundary="periodic")
    one = study.sample_styles({"a": KIND})
    both = study.sample_styles({"a-1": KIND, "a-2": periodic})
    assert [mark.get_label() for mark in study.legend_handles(one, lines=True)] == ["a"]
    marks = study.legend_handles(both, lines=True)
    assert [(mark.get_label(), mark.get_linestyle()) for mark in marks[1:]] == [
        ("periodic", "-"),
        ("walls", "--"),
    ]
    assert len(study.legend_handles(both)) == 1


# --- exponents -----------------------------------------------------------------------------------


def path(above=(0.0, 0.1, 0.2), half=(2.0, 0.1, 0.1)):
    exponents = np.array([2.0, 2.5, 3.5])[: len(above)]
    return pd.DataFrame(
        {
            "solid_fraction_above_jamming": above,
            "exponent": exponents,
            "exponent_low": exponents - half[: len(above)],
            "exponent_high": exponents + 0.5 * np.array(half[: len(above)]),
        }
    )


def test_exponents_are_lines_with_bands_of_the_samples_of_one_law(shown):
    styles = study.sample_styles({"one": KIND, "two": replace(KIND, law="hertz")})
    ax = study.plot_exponents({"one": path(), "two": path(above=(0.3,))}, styles, "linear")
    line, three = ax.lines
    # The first state, whose interval is 3 wide, says nothing.
    assert_allclose(shown.points(line), [[0.1, 0.2], [2.5, 3.5]])
    assert_allclose(shown.band(ax.collections[0]), [[0.1, 0.2], [2.4, 3.4], [2.55, 3.55]])
    assert set(three.get_ydata()) == {3.0}
    assert to_hex(line.get_color()) == styles["one"]["color"]
    assert ax.get_ylim() == pytest.approx((0.0, 1.45 * 3.5))
    assert shown.texts(ax) == ["one", "the paper's n = 3"]


@pytest.mark.parametrize("half", [0.1, 3.0])
def test_one_state_is_a_point_with_its_interval_on_an_axis_of_some_width(shown, half):
    styles = study.sample_styles({"one": KIND})
    ax = study.plot_exponents({"one": path(above=(0.19,), half=(half,))}, styles, "linear")
    assert ax.lines[0].get_marker() == "o"
    assert_allclose(shown.points(ax.lines[0]), [[0.19], [2.0]])
    assert_allclose(shown.bars(ax.containers[0]), [[2.0 - half], [2.0 + 0.5 * half]])
    low, high = ax.get_xlim()
    assert high - low > 0.049 and low < 0.19 < high


def test_one_state_whose_jamming_point_is_unknown_is_a_point_too(shown):
    styles = study.sample_styles({"one": KIND})
    ax = study.plot_exponents({"one": path(above=(np.nan,))}, styles, "linear")
    assert shown.texts(ax) == ["one", "the paper's n = 3"]


# --- one number of every prediction --------------------------------------------------------------


def findings():
    return pd.DataFrame(
        {
            "sample": ["sand", "mud"],
            "verdict": ["certified with notes", "certified"],
            "ks_parking_near": [0.03, 0.05],
            "ks_parking_end": [0.3, 0.5],
            "ks_random_contact_near": [0.1, 0.2],
            "explained_reduced_radius_end": [0.18, 0.2],
            "explained_reduced_radius_near": [0.08, 0.1],
        }
    )


def test_lengths_are_distances_near_jamming_a_row_a_sample(shown):
    ax = study.plot_samples(findings(), "lengths")
    assert_allclose(shown.line(ax, "random parking"), [[0.03, 0.05], [0, 1]])
    assert_allclose(shown.line(ax, "Eq. 4, any two alike"), [[0.1, 0.2], [0, 1]])
    assert [text.get_text() for text in ax.get_yticklabels()] == ["sand", "mud"]
    assert ax.get_ylim()[0] > ax.get_ylim()[1]
    assert ax.lines[-1].get_xdata()[0] == 0.06  # called good up to here
    assert ax.get_xscale() == "log"


def test_samples_that_are_not_certified_are_marked():
    rows = findings().assign(verdict=["certified", "not certified"])
    ax = study.plot_samples(rows, "energies")
    labels = [text.get_text() for text in ax.get_yticklabels()]
    assert labels == ["sand", "mud (not certified)"]


def test_energies_are_what_is_explained_at_the_end(shown):
    ax = study.plot_samples(findings(), "energies")
    assert_allclose(shown.line(ax, "reduced radius R*"), [[0.18, 0.2], [0, 1]])
    assert ax.get_xscale() == "linear"
