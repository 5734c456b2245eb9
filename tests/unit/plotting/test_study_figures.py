"""Each figure of all samples: one file, of the samples that have data."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting import study_figures
from branchcrush.plotting.study import sample_styles
from branchcrush.study.kinds import SampleKind

pytestmark = pytest.mark.filterwarnings("error")
STYLES = sample_styles(
    {
        "sand": SampleKind("walls", "linear", {"form": "sand"}),
        "mud": SampleKind("periodic", "hertz", {"form": "mud"}),
    }
)
NOTHING = pd.DataFrame({"reason": ["no load"]})


def texts(axes):
    return [text.get_text().replace("\n", " ") for ax in axes for text in ax.texts]


def path(above=(0.05, 0.1)):
    n = np.array([2.5, 3.5])[: len(above)]
    columns = {"exponent": n, "exponent_low": n - 0.1, "exponent_high": n + 0.1}
    return pd.DataFrame({"solid_fraction_above_jamming": above, **columns})


def test_each_contact_law_has_a_panel_of_its_samples(drawn, shown):
    linear, hertz = drawn(
        study_figures.draw_exponents, {"sand": path(), "mud": path((0.2, 0.3))}, STYLES
    )
    assert_allclose(shown.points(linear.lines[0]), [[0.05, 0.1], [2.5, 3.5]])
    assert_allclose(shown.points(hertz.lines[0])[0], [0.2, 0.3])
    assert linear.get_title() != hertz.get_title()


@pytest.mark.parametrize("mud", [NOTHING, path((np.nan, np.nan))])
def test_a_law_without_an_exponent_says_why(drawn, mud):
    axes = drawn(study_figures.draw_exponents, {"sand": path(), "mud": mud}, STYLES)
    assert texts(axes) == ["no data: of no sample are n and phi_J known"]
    assert axes[0].lines


ROWS = pd.DataFrame(
    {
        "sample": ["sand", "one", "loose"],
        "verdict": ["certified", "certified with notes", "not certified"],
        "exponent_at_end": [3.0, 3.0, np.nan],
        "ks_parking_near": [0.03, np.nan, np.nan],
        "explained_reduced_radius_end": [0.19, 0.2, np.nan],
    }
)


def test_lengths_leave_out_samples_without_a_state_near_jamming(drawn, shown):
    (ax,) = drawn(study_figures.draw_lengths, ROWS)
    assert_allclose(shown.line(ax, "random parking"), [[0.03], [0]])
    (ax,) = drawn(study_figures.draw_energies, ROWS)
    assert_allclose(shown.line(ax, "reduced radius R*"), [[0.19, 0.2], [0, 1]])


@pytest.mark.parametrize("rows", [ROWS[1:], ROWS[2:], ROWS[["sample"]]])
def test_lengths_of_no_sample_say_so(drawn, rows):
    axes = drawn(study_figures.draw_lengths, rows)
    assert texts(axes) == ["no data: no sample has a state near jamming"]


def test_coordination_leaves_out_samples_that_only_say_why(drawn, shown):
    states = pd.DataFrame(
        {
            "sample": ["sand", "loose"],
            "state": [4, np.nan],
            "void_ratio": [0.5, np.nan],
            "coordination_number": [5.0, np.nan],
            "mechanical_coordination_number": [7.0, np.nan],
            "isostatic_number": [5.5, np.nan],
            "solid_fraction_above_jamming": [0.1, np.nan],
            "reason": [None, "no load"],
        }
    )
    by_void_ratio, by_distance = drawn(study_figures.draw_coordination, states, STYLES)
    assert_allclose(shown.points(by_void_ratio.lines[0]), [[0.5], [5.0]])
    assert_allclose(shown.points(by_distance.lines[0]), [[0.1], [1.5]])
    # Beside one state, relations are shown over a range.
    assert_allclose(shown.line(by_void_ratio, "Field 1963")[0][[0, -1]], [0.45, 0.55])


@pytest.mark.parametrize(
    ("function", "kinds"),
    [(study_figures.draw_shielding, 2), (study_figures.draw_forces, 2)],
)
def test_panels_of_no_data_say_so(drawn, function, kinds):
    axes = drawn(function, *[{"sand": NOTHING}] * kinds, STYLES)
    assert texts(axes) == ["no data: no sample has any"] * 2


def test_shielding_and_forces_have_their_own_tables(drawn, shown):
    end = {"where": ["end"]}
    branches = pd.DataFrame(
        {**end, "mean_radius_ratio": [0.5], "branches": [50], "energy_ratio": [0.7]}
    )
    grains = pd.DataFrame(
        {
            **end,
            "grains_counted": ["all"],
            "mean_neighbour_ratio": [2.0],
            "grains": [50],
            "energy_per_contact": [0.8],
        }
    )
    first, second = drawn(
        study_figures.draw_shielding, {"sand": branches}, {"sand": grains}, STYLES
    )
    assert_allclose(shown.points(first.lines[0]), [[0.5], [0.7]])
    assert_allclose(shown.points(second.lines[0]), [[2.0], [0.8]])
    stress = pd.DataFrame({**end, "volume_share": [0.5], "stress_share": [0.6]})
    forces = pd.DataFrame(
        {**end, "force_low": [1.0], "force_high": [2.0], "contacts": [50], "density": [0.3]}
    )
    first, second = drawn(study_figures.draw_forces, {"sand": stress}, {"sand": forces}, STYLES)
    assert_allclose(shown.points(first.lines[0]), [[0.5], [0.1]])
    assert_allclose(shown.points(second.lines[0]), [[1.5], [0.3]])
