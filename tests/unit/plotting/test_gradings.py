"""The grading: its curves against the columns of the table, in mm or µm."""

import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting.gradings import plot_grading, plot_preview

pytestmark = pytest.mark.filterwarnings("error")


def table(scale=1.0, ultimate=True):
    columns = {
        "diameter_m": [1e-3 * scale, 2e-3 * scale, 4e-3 * scale],
        "percent_finer_by_mass_target": [0.0, 40.0, 100.0],
        "percent_finer_by_mass_realised": [0.0, 45.0, 100.0],
        "percent_finer_by_mass_realised_min": [0.0, 30.0, 100.0],
        "percent_finer_by_mass_realised_max": [0.0, 50.0, 100.0],
        "percent_finer_by_number_target": [0.0, 80.0, 100.0],
    }
    if ultimate:
        columns["percent_finer_by_mass_ultimate"] = [0.0, 60.0, 100.0]
    return pd.DataFrame(columns)


def test_curves_are_those_of_the_table(shown):
    ax = plot_grading(table())
    for label, middle in (
        ("by mass, mean of seeds", 45),
        ("by mass, target", 40),
        ("by mass, ultimate", 60),
        ("by number, target", 80),
    ):
        assert_allclose(shown.line(ax, label), [[1, 2, 4], [0, middle, 100]])
    assert_allclose(shown.band(ax.collections[0]), [[1, 2, 4], [0, 30, 100], [0, 50, 100]])
    assert ax.get_xlabel() == "grain diameter D [mm]"
    assert ax.get_xscale() == "log" and ax.get_ylim() == (0, 102)


def test_no_ultimate_grading_is_no_line(shown):
    assert "by mass, ultimate" not in shown.texts(plot_grading(table(ultimate=False)))


def test_fines_are_told_in_micrometres(shown):
    ax = plot_grading(table(scale=0.02))
    assert_allclose(shown.line(ax, "by mass, target")[0], [20, 40, 80])
    assert ax.get_xlabel() == "grain diameter D [µm]"


@pytest.mark.parametrize("ratio", [1.5, 4.0, 20.0, 1000.0])
def test_the_axis_names_two_sizes_or_more_whatever_its_width(ratio):
    ax = plot_grading(table().assign(diameter_m=[1e-3, 1.2e-3, 1e-3 * ratio]))
    ax.figure.canvas.draw()
    low, high = ax.get_xlim()
    inside = [tick for tick in ax.get_xticks() if low <= tick <= high]
    assert len(inside) >= 2


def test_a_preview_shows_what_is_asked_for_and_drawn_by_mass_and_by_number(shown):
    columns = table().assign(percent_finer_by_number_realised=[0.0, 75.0, 100.0])
    ax = plot_preview(columns, "um", "seed 3")
    for label, middle in (
        ("by mass", 40),
        ("by mass, seed 3", 45),
        ("by mass, ultimate", 60),
        ("by number", 80),
        ("by number, seed 3", 75),
    ):
        assert_allclose(shown.line(ax, label), [[1000, 2000, 4000], [0, middle, 100]])
    assert ax.get_xlabel() == "grain diameter D [µm]"


@pytest.mark.parametrize(("unit", "label"), [("inch", "inch"), ("cm", "cm"), ("m", "mm")])
def test_a_preview_is_in_the_unit_of_the_user(shown, unit, label):
    ax = plot_preview(table(), unit)
    metres = {"inch": 0.0254, "cm": 0.01, "m": 1e-3}[unit]
    assert_allclose(shown.line(ax, "by mass")[0] * metres, [1e-3, 2e-3, 4e-3])
    assert ax.get_xlabel() == f"grain diameter D [{label}]"


def test_a_table_alone_is_two_curves(shown):
    columns = ["diameter_m", "percent_finer_by_mass_target", "percent_finer_by_number_target"]
    assert shown.texts(plot_preview(table()[columns], "mm")) == ["by mass", "by number"]
