"""Figures of the crushing model: one file each, one legend, and in words what is not admissible."""

import pandas as pd
import pytest

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.plotting import crushing
from branchcrush.plotting import crushing_figures as figures
from branchcrush.plotting.form_lines import form_handles
from branchcrush.plotting.form_words import extrapolated, form_notes, warnings
from tests.unit.plotting.crushing_tables import FORMS, curves_table, forms_table, model

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = {"reason": "no packing carries load"}
EMPTY = pd.DataFrame(NOTHING, index=[0])
DEGENERATE = "The paper's form sets nearly all energy free."
UNTESTED = "Size ratios above 20 are untested."


def legend(axes):
    (one,) = axes[0].figure.legends
    return [text.get_text() for text in one.get_texts()]


def words(axes):
    return axes[0].figure.get_supxlabel().replace("\n", " ")


@pytest.mark.parametrize(
    ("function", "data", "panels"),
    [
        (figures.draw_crushing_model, (EMPTY, EMPTY, NOTHING), 2),
        (figures.draw_crushing_energy, (EMPTY, NOTHING), 4),
        (figures.draw_crushing_yield, (EMPTY, EMPTY, NOTHING), 3),
        (figures.draw_crushing_path, (EMPTY, NOTHING), 3),
    ],
)
def test_every_panel_without_data_says_why(drawn, function, data, panels):
    written = [text for ax in drawn(function, *data) for text in ax.texts]
    texts = [text.get_text().replace("\n", " ") for text in written]
    assert texts == ["no data: no packing carries load"] * panels


def test_compression_line_names_the_forms_it_shows_and_where_they_end(drawn):
    axes = drawn(figures.draw_crushing_model, forms_table(), curves_table(), model())
    shown = ("moving_jamming", "paper", "einav")
    assert legend(axes) == [
        *(FORM_LABELS[name] for name in shown),
        "not admissible",
        "loading and unloading",
    ]
    assert words(axes) == (
        "Crushing would cost elastic energy: moving jamming point, from C = 0.60."
    )


def test_energies_of_all_forms_are_on_one_axis_with_one_legend(drawn):
    axes = drawn(figures.draw_crushing_energy, forms_table(), model())
    assert legend(axes) == [*(FORM_LABELS[name] for name in FORMS), "not admissible"]
    assert len({ax.get_ylim() for ax in axes}) == 1
    assert [ax.get_title() for ax in axes] == list(crushing.COMPARED.values())
    assert "density, at all C" in words(axes)


def all_forms():
    """Tables and model with every form there is."""
    tables = [forms_table(), curves_table()]
    said = model()
    for name in set(FORM_LABELS) - set(FORMS):
        said["forms"][name] = said["forms"]["einav"]
        tables = [
            pd.concat([table, table[table["form"] == "einav"].assign(form=name)])
            for table in tables
        ]
    return (*tables, said)


def test_legends_with_every_form_are_whole(drawn):
    forms, curves, said = all_forms()
    for function, data in (
        (figures.draw_crushing_model, (forms, curves, said)),
        (figures.draw_crushing_energy, (forms, said)),
        (figures.draw_crushing_yield, (forms, curves, said)),
    ):
        drawing = drawn(function, *data)[0].figure
        extent = drawing.legends[0].get_window_extent()
        assert 0 <= extent.x0 < extent.x1 <= drawing.bbox.x1


def test_legends_along_the_path_are_whole_with_a_band_and_a_history(drawn):
    curves = curves_table()
    curves["stress_low_Pa"], curves["stress_high_Pa"] = curves["stress_Pa"], curves["stress_Pa"]
    own = curves[curves["path"] == "crushing"].assign(path="history")
    axes = drawn(figures.draw_crushing_path, pd.concat([curves, own]), model())
    for ax in axes:
        extent = ax.get_legend().get_window_extent()
        assert 0 <= extent.x0 < extent.x1 <= ax.figure.bbox.x1
        # And the panels are no narrower for it.
        assert ax.get_position().width > 0.65


def test_what_the_panels_of_yield_do_not_show_is_said(drawn):
    forms, curves, said = all_forms()
    forms.loc[forms["form"] == "density", "yield_stress_Pa"] = float("nan")
    forms.loc[forms["form"] == "paper", "driving_force_over_pressure"] = 5.0
    text = words(drawn(figures.draw_crushing_yield, forms, curves, said))
    assert "C never grows: paper with branch density." in text
    assert "Outside the panel of driving force: paper, no branch density;" in text
    same = [FORM_LABELS[name] for name in ("measured_contacts", "einav", "tengattini")]
    assert f"One line of yield stress: {'; '.join(same)}." in text


def test_energies_outside_of_the_axis_are_said(drawn):
    forms = forms_table()
    forms.loc[forms["form"] == "einav", "energy_at_equal_solid_fraction"] = 1e-3
    text = words(drawn(figures.draw_crushing_energy, forms, model()))
    assert "Outside the panel at equal solid fraction: Einav, breakage." in text


def test_a_degenerate_form_and_untested_sizes_are_said_on_the_figure(drawn):
    said = model(paper_degenerate=DEGENERATE, untested=UNTESTED)
    axes = drawn(figures.draw_crushing_model, forms_table(), curves_table(), said)
    assert f"from C = 0.60. {DEGENERATE} {UNTESTED}" in words(axes)


def test_a_form_on_the_front_that_is_not_there_says_why(drawn):
    absent = model("measured_contacts", form_reason="no contacts were measured")
    absent["forms"]["measured_contacts"] = {"reason": "no contacts were measured"}
    axes = drawn(figures.draw_crushing_path, curves_table(), absent)
    assert [ax.texts[0].get_text() for ax in axes] == ["no data: no contacts were measured"] * 3
    crushing.plot_compression_line(forms_table(), curves_table(), absent)
    assert warnings(absent) == ["no contacts were measured."]


def test_jumps_under_stress_are_in_the_legend_of_the_figures_that_mark_them():
    snapping = model()
    snapping["forms"]["einav"]["snaps"] = [0.25]
    labels = [handle.get_label() for handle in form_handles(snapping, FORMS)]
    assert labels[-2:] == ["not admissible", "under stress C jumps"]
    assert len(form_handles(snapping, FORMS, snaps=False)) == len(labels) - 1
    assert len(form_handles(snapping, ["paper"])) == 1


def test_yield_beyond_the_measured_strains_is_said_of_the_front_alone():
    assert extrapolated(forms_table(), model("einav")) == []
    (text,) = extrapolated(forms_table(), model("einav", largest_strain=0.035))
    assert text.startswith("From C = 0.00 on the front form yields at elastic strains above 3.5 %")
    assert extrapolated(forms_table(), model("density", largest_strain=0.035)) == []


def test_a_warning_is_its_first_sentence_and_none_is_none():
    said = model(paper_degenerate=DEGENERATE, untested=f"{UNTESTED} At C = 0.5 more.")
    assert warnings(said) == [DEGENERATE, UNTESTED]
    assert warnings(model(paper_degenerate=None, untested=None)) == []
    assert form_notes(model(), ["paper"]) == []
