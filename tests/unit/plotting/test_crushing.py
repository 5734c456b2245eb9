"""The crushing model: lines against the columns of its table, in MPa and per cent."""

import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting import crushing

pytestmark = pytest.mark.filterwarnings("error")

COLUMNS = {
    "elastic_energy_J_per_m3": 1e6,
    "reference_energy_J_per_m3": 2e6,
    "free_energy_J_per_m3": 3e6,
    "stress_Pa": 4e6,
    "driving_force_J_per_m3": 5e6,
    "resistance_J_per_m3": 6e6,
    "dissipated_J_per_m3": 7e6,
    "work_J_per_m3": 8e6,
}
STRAIN = [0.0, 0.1]


def curves():
    """Every quantity is a number of its own times 1 and 2; fixed C adds C to it."""
    rows = [
        {
            "path": path,
            "crushing": value,
            "volumetric_strain": strain,
            **{name: (k + 1) * scale + 1e6 * value for name, scale in COLUMNS.items()},
        }
        for path, values in (("crushing", (0.0,)), ("fixed", (0.0, 0.25, 0.5, 0.75, 1.0)))
        for value in values
        for k, strain in enumerate(STRAIN)
    ]
    table = pd.DataFrame(rows)
    table.loc[table["path"] == "crushing", "crushing"] = [0.0, 0.5]
    return table


def test_reference_energy_is_drawn_beside_the_elastic_energy(shown):
    ax = crushing.plot_reference_energy(curves())
    assert_allclose(shown.points(ax.lines[0]), [[0.0, 10.0], [1.0, 2.0]])
    assert_allclose(shown.points(ax.lines[1]), [[0.0, 10.0], [2.0, 4.0]])
    assert [line.get_label().split()[0] for line in ax.lines] == [r"$\Psi_0$", r"$\psi_r"]


@pytest.mark.parametrize(("column", "scale"), [("free_energy_J_per_m3", 3.0), ("stress_Pa", 4.0)])
def test_family_is_the_column_at_each_crushing_and_along_the_path(shown, column, scale):
    ax = crushing.plot_family(curves(), column, "a label")
    for value in (0.0, 0.25, 0.5, 0.75, 1.0):
        drawn = shown.line(ax, f"C = {value:g}")
        assert_allclose(drawn, [[0.0, 10.0], [scale + value, 2 * scale + value]])
    assert_allclose(shown.line(ax, "C evolves, unloads"), [[0.0, 10.0], [scale, 2 * scale]])
    assert ax.get_ylabel() == "a label"


@pytest.mark.parametrize("yields", [True, False])
def test_crushing_is_drawn_with_its_yield_strain_where_that_is_on_the_path(shown, yields):
    model = {"theta": 0.25, "yield_strain": 0.05, "yields_on_path": yields}
    ax = crushing.plot_crushing(curves(), model)
    assert_allclose(shown.line(ax, "loading, unloading"), [[0.0, 10.0], [0.0, 0.5]])
    marks = [line.get_xdata()[0] for line in ax.lines if line.get_linestyle() == ":"]
    assert marks == pytest.approx([5.0] if yields else [])
    assert ax.get_ylim() == (0.0, 1.0)
    assert ax.get_legend().get_title().get_text() == r"$\theta$ = 0.25"


def test_driving_force_and_resistance_are_told_apart(shown):
    ax = crushing.plot_driving_force(curves())
    assert_allclose(shown.line(ax, r"driving force $E_C=\theta\Psi_0$"), [[0, 10], [5, 10]])
    assert_allclose(shown.line(ax, r"resistance $E_{c0}/(1-C)^s$"), [[0, 10], [6, 12]])


def test_work_stored_and_dissipated_energy_are_told_apart(shown):
    ax = crushing.plot_dissipation(curves())
    for label, scale in (("work", 8), (r"stored $\Psi$", 3), (r"dissipated $\int E_C\,dC$", 7)):
        assert_allclose(shown.line(ax, label), [[0, 10], [scale, 2 * scale]])
