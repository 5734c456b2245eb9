"""The forms of the crushing model along C: lines against the columns, in MPa; where dashed."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.plotting import crushing
from tests.unit.plotting.crushing_tables import (
    CRUSHING,
    FORMS,
    RATIOS,
    curves_table,
    forms_table,
    model,
)

pytestmark = pytest.mark.filterwarnings("error")
FRONT, PAPER = FORM_LABELS["moving_jamming"], FORM_LABELS["paper"]


def dashed(ax):
    """Return x and y of the lines of forms that are drawn as inadmissible."""
    return [np.array(line.get_data()) for line in ax.lines if line.get_alpha() == 0.45]


def test_compression_line_is_void_ratio_against_stress(shown):
    ax = crushing.plot_compression_line(forms_table(), curves_table(), model())
    stress = 10.0**CRUSHING
    assert_allclose(shown.line(ax, PAPER), [2.0 * stress, 0.7 - 0.2 * CRUSHING])
    assert_allclose(shown.line(ax, FRONT), [stress[:3], 0.7 - 0.1 * CRUSHING[:3]])
    assert ax.get_xscale() == "log"


def test_compression_line_goes_on_dashed_where_crushing_costs_energy():
    ax = crushing.plot_compression_line(forms_table(), curves_table(), model())
    (line,) = dashed(ax)
    assert_allclose(line, [10.0 ** CRUSHING[2:], 0.7 - 0.1 * CRUSHING[2:]])


def test_a_form_that_costs_energy_is_left_out_of_the_compression_line_but_for_the_front(shown):
    tables = forms_table(), curves_table()
    assert FORM_LABELS["density"] not in str(
        [line.get_label() for line in crushing.plot_compression_line(*tables, model()).lines]
    )
    ax = crushing.plot_compression_line(*tables, model("density"))
    assert_allclose(dashed(ax)[0], [3.0 * 10.0**CRUSHING, 0.7 - 0.3 * CRUSHING])


def test_c_is_written_along_the_line_of_the_form_on_the_front():
    ax = crushing.plot_compression_line(forms_table(), curves_table(), model())
    # By hand: a tenth of a decade and 0.01 of the void ratio for each tenth of C, to 0.5.
    marks = {text.get_text(): text.xy for text in ax.texts}
    assert next(iter(marks)) == "C = 0"
    assert_allclose(marks["C = 0"], [1.0, 0.7])
    assert_allclose(marks["0.5"], [10.0**0.5, 0.65])


def test_loading_and_unloading_of_the_front_are_dotted_from_the_jamming_point(shown):
    ax = crushing.plot_compression_line(forms_table(), curves_table(), model())
    # e = (1 - eps)/0.6 - 1; the unloaded state has no place on a logarithmic axis.
    drawn = shown.line(ax, "loading and unloading")
    assert_allclose(drawn, [[2.0, 1.0], [0.9 / 0.6 - 1.0, 0.95 / 0.6 - 1.0]])


def test_where_c_jumps_under_stress_is_marked_on_line_and_locus():
    snapping = model()
    snapping["forms"]["moving_jamming"]["snaps"] = [0.25]
    line = crushing.plot_compression_line(forms_table(), curves_table(), snapping)
    locus = crushing.plot_yield_stress(forms_table(), snapping)
    (on_line,) = (mark for mark in line.lines if mark.get_marker() == "v")
    (on_locus,) = (mark for mark in locus.lines if mark.get_marker() == "v")
    assert_allclose(on_line.get_xydata(), [[10.0**0.25, 0.675]])
    assert_allclose(on_locus.get_xydata(), [[0.25, 10.0**0.25]])


def test_jamming_points_that_stay_are_one_line(shown):
    ax = crushing.plot_jamming(forms_table(), model())
    assert_allclose(shown.line(ax, FRONT), [CRUSHING[:3], 0.6 + 0.1 * CRUSHING[:3]])
    assert PAPER not in [line.get_label() for line in ax.lines]
    assert [text.get_text() for text in ax.texts] == ["all other forms"]
    assert ax.texts[0].xy[1] == pytest.approx(0.6)


@pytest.mark.parametrize("column", RATIOS)
def test_energy_is_its_column_along_c_and_the_front_is_wider_and_last(shown, column):
    table = forms_table()
    ax = crushing.plot_energy(table, model(), column)
    for name in ("paper", "einav"):
        drawn = table.loc[table["form"] == name, column]
        assert_allclose(shown.line(ax, FORM_LABELS[name]), [CRUSHING, drawn])
    names = [line.get_label() for line in ax.lines if line.get_label() in FORM_LABELS.values()]
    assert names[-1] == FRONT
    widths = {line.get_label(): line.get_linewidth() for line in ax.lines}
    assert widths[FRONT] > widths[PAPER]
    assert ax.get_title() == crushing.COMPARED[column]


def test_a_form_without_energy_at_the_end_does_not_stretch_the_axis():
    table = forms_table()
    table.loc[table["form"] == "paper", RATIOS[0]] = 1.0 - 0.99999 * CRUSHING
    ax = crushing.plot_energy(table, model(), RATIOS[0])
    assert ax.get_ylim() == pytest.approx((0.01, 3.0))  # to twice 1 + C of the front, to C = 0.5


def test_energies_of_front_and_paper_alone_make_the_axis():
    table = forms_table()
    table.loc[table["form"] == "einav", RATIOS[0]] = 1.0 - CRUSHING
    ax = crushing.plot_energy(table, model(), RATIOS[0])
    # From 1 to 1 + 2 C of the paper: half as much again below, twice above.
    assert ax.get_ylim() == pytest.approx((1.0 / 1.5, 6.0))


def test_the_whole_of_a_moving_jamming_point_is_seen_whatever_is_on_the_front():
    for front in ("moving_jamming", "paper"):
        said = model(front)
        said["forms"]["moving_jamming"]["inadmissible_from"] = None
        low, high = crushing.plot_jamming(forms_table(), said).get_ylim()
        assert low < 0.6 and high > 0.7


def test_yield_is_dashed_where_it_is_beyond_the_measured_law(shown):
    table = forms_table()
    paper = table["form"] == "paper"
    table.loc[paper, "yield_elastic_strain"] = [0.01, 0.05, 0.09, 0.2, 0.3]
    stress = 2.0 * 10.0**CRUSHING
    for ax, y, known in (
        (crushing.plot_yield_stress(table, model()), stress, 3),
        (crushing.plot_driving_force(table, model()), 0.6 * (0.6 - CRUSHING), 3),
    ):
        solid = np.where(np.arange(5) < known, y, np.nan)
        assert_allclose(shown.line(ax, PAPER)[1], solid)
        # From the last point that is known, so that the line goes on.
        law = shown.line(ax, "beyond the measured law")
        assert_allclose(law[1], np.where(np.arange(5) < known - 1, np.nan, y))


def test_a_line_too_short_for_marks_has_one_that_says_how_far_it_goes():
    table = forms_table()
    paper = table["form"] == "paper"
    table.loc[paper, "yield_stress_Pa"] = 1e6
    table.loc[paper, "void_ratio"] = 0.7 - 1e-4 * CRUSHING
    ax = crushing.plot_compression_line(table, curves_table(), model("paper"))
    assert [text.get_text() for text in ax.texts] == ["C = 0 to 1"]


def test_driving_force_is_drawn_with_the_region_where_crushing_costs_energy(shown):
    ax = crushing.plot_driving_force(forms_table(), model())
    assert_allclose(shown.line(ax, FRONT), [CRUSHING[:3], 0.3 * (0.6 - CRUSHING[:3])])
    assert [text.get_text() for text in ax.texts] == ["crushing would cost elastic energy"]
    (region,) = ax.patches
    assert region.get_y() + region.get_height() == pytest.approx(0.0)
    assert ax.get_ylim()[0] == pytest.approx(region.get_y())


def test_yield_stress_is_in_mpa_along_c(shown):
    ax = crushing.plot_yield_stress(forms_table(), model())
    assert_allclose(shown.line(ax, PAPER), [CRUSHING, 2.0 * 10.0**CRUSHING])
    assert ax.get_ylim() == pytest.approx((0.5, 80.0))  # of 1 to 4 10^C, twice as wide


def test_a_grading_that_never_yields_has_no_line_and_no_mark():
    table = forms_table().assign(yield_stress_Pa=np.nan, void_ratio=np.nan)
    snapping = model()
    snapping["forms"]["paper"]["snaps"] = [0.5]
    line = crushing.plot_compression_line(table, curves_table(), snapping)
    locus = crushing.plot_yield_stress(table, snapping)
    for ax in (line, locus):
        assert [text.get_text() for text in ax.texts] == ["crushing never begins"]
    assert all(mark.get_marker() != "v" for mark in (*line.lines, *locus.lines))


def test_tables_have_every_form_that_the_tests_count_on():
    assert set(FORMS) < set(FORM_LABELS)
