"""Figures of measured materials, by the data that they draw."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.plotting.measured import (
    draw_compression,
    draw_gradings,
    plot_compression,
    plot_gradings,
    plot_residuals,
)

GRADINGS = pd.DataFrame(
    {
        "diameter_m": [1e-4, 1e-3],
        "percent_finer_by_mass_before": [0.0, 100.0],
        "percent_finer_by_mass_after": [30.0, 100.0],
    }
)
NAMES = ("elastic_strain_limit", "critical_energy")


@pytest.fixture(params=["void_ratio", "volumetric_strain"])
def tables(request):
    value, stress = request.param, np.array([1e6, 2e6, 4e6])
    curve = pd.DataFrame({"mean_stress_Pa": stress, value: [0.7, 0.6, 0.5]})
    line = pd.DataFrame({"mean_stress_Pa": stress})
    for k, name in enumerate(NAMES):
        curve[f"{value}_{name}"] = line[f"{value}_{name}"] = [0.7, 0.61, 0.5 + 0.01 * k]
    return curve, line


def lines(ax):
    return {line.get_label(): line for line in ax.get_lines()}


def test_gradings_are_drawn_in_the_unit_that_the_axis_names_and_none_that_is_not_known():
    ax = plot_gradings(GRADINGS)
    assert ax.get_xlabel() == "grain diameter D [mm]"
    assert set(lines(ax)) == {"before the test", "after the test"}
    assert lines(ax)["after the test"].get_xydata().tolist() == [[0.1, 30.0], [1.0, 100.0]]


def test_a_compression_is_points_and_two_lines_and_goes_down(tables):
    ax = plot_compression(*tables)
    drawn = lines(ax)
    assert set(drawn) == {"measured", "elastic strain limit", "critical energy"}
    assert drawn["measured"].get_xydata().tolist() == [[1.0, 0.7], [2.0, 0.6], [4.0, 0.5]]
    assert drawn["critical energy"].get_ydata().tolist() == [0.7, 0.61, 0.51]
    # Compression is downwards: void ratios fall, and strains grow that way.
    assert ax.yaxis_inverted() == ("strain" in ax.get_ylabel())


def test_residuals_are_measured_less_fitted(tables):
    ax = plot_residuals(tables[0])
    drawn = lines(ax)
    assert ax.get_ylabel().startswith("void" if "void_ratio" in tables[0] else "volumetric strain")
    np.testing.assert_allclose(drawn["critical energy"].get_ydata(), [0, -0.01, -0.01], atol=1e-12)


def test_figures_are_files_and_a_curve_without_a_fit_says_why(tmp_path, tables):
    draw_gradings(tmp_path / "gradings.png", 50, GRADINGS)
    draw_compression(tmp_path / "compression.png", 50, *tables)
    none = pd.DataFrame({"reason": ["no load"]})
    draw_compression(tmp_path / "none.png", 50, none, none, "no load")
    assert {file.name for file in tmp_path.iterdir()} == {
        f"{name}.{kind}" for name in ("gradings", "compression", "none") for kind in ("png", "svg")
    }
