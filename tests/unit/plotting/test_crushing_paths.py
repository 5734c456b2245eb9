"""The crushing model along the strain: lines against the columns, in MPa and per cent."""

import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.plotting import crushing_paths
from tests.unit.plotting.crushing_tables import FORMS, curves_table, model

pytestmark = pytest.mark.filterwarnings("error")
PERCENT = [0.0, 10.0, 5.0]


def test_crushing_of_every_form_is_drawn_the_front_last(shown):
    ax = crushing_paths.plot_crushing(curves_table(), model("paper"))
    for k, name in enumerate(FORMS, start=1):
        assert_allclose(shown.line(ax, FORM_LABELS[name]), [PERCENT, [0.0, 0.1 * k, 0.1 * k]])
    assert ax.lines[-1].get_label() == FORM_LABELS["paper"]


def test_stress_is_that_of_the_front_with_c_evolving_and_held(shown):
    ax = crushing_paths.plot_stress(curves_table(), model("paper"))
    assert_allclose(shown.line(ax, "C evolves"), [PERCENT, [0.0, 4.0, 2.0]])
    for held in (0.0, 0.25, 0.5, 0.75, 1.0):
        expected = [[0.0, 10.0], [0.0, 4.0 * (1.0 + held)]]
        assert_allclose(shown.line(ax, f"C = {held:g}"), expected)
    assert len(ax.lines) == 6


def test_the_band_of_the_stress_is_that_of_the_way_in(shown):
    table = curves_table()
    table["stress_low_Pa"], table["stress_high_Pa"] = table["stress_Pa"] / 2, table["stress_Pa"] * 2
    ax = crushing_paths.plot_stress(table, model("paper"))
    (band,) = ax.collections
    assert_allclose(shown.band(band), [[0.0, 10.0], [0.0, 2.0], [0.0, 8.0]])
    assert "its band" in shown.texts(ax)


def test_a_history_of_the_configuration_is_points_beside(shown):
    table = curves_table()
    own = table[(table["path"] == "crushing") & (table["form"] == "moving_jamming")]
    own = own.assign(path="history", stress_Pa=5e6)
    ax = crushing_paths.plot_stress(pd.concat([table, own]), model())
    assert_allclose(shown.line(ax, "history"), [PERCENT, [5.0] * 3])
    assert ax.lines[-1].get_linestyle() == "None"
    assert shown.legend_is_above(ax)
    assert ax.get_ylim()[1] > 5.0


def test_driving_force_and_resistance_are_told_apart(shown):
    ax = crushing_paths.plot_resistance(curves_table(), model())
    assert_allclose(shown.line(ax, "driving force"), [PERCENT, [0.0, 2.0, 2.0]])
    assert_allclose(shown.line(ax, "resistance"), [PERCENT, [0.0, 3.0, 3.0]])


def test_work_stored_dissipated_and_plastic_energy_are_told_apart(shown):
    ax = crushing_paths.plot_work(curves_table(), model())
    for label, value in (("work", 6), ("stored", 1), ("dissipated", 4), ("plastic work", 5)):
        assert_allclose(shown.line(ax, label), [PERCENT, [0.0, value, value]])
