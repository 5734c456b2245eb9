"""Figures of who breaks and how energy is split meanwhile, by the data that they draw."""

import numpy as np
import pandas as pd
import pytest
from matplotlib import pyplot as plt

from branchcrush.plotting.crushed_grains import (
    plot_exponents,
    plot_hazard,
    plot_loads,
    plot_roc,
)


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def with_limits(name, values, width):
    values = np.array(values, dtype=float)
    return {name: values, f"{name}_low": values - width, f"{name}_high": values + width}


EXPONENTS = pd.DataFrame(
    {"solid_fraction": [0.66, 0.70]}
    | with_limits("exponent", [2.5, 3.5], 0.5)
    | with_limits("control_exponent", [2.0, 2.2], 0.1)
)


def test_both_exponents_are_drawn_with_their_bands():
    ax = plot_exponents(EXPONENTS)
    assert labels(ax) == ["grains break", "grains do not break", "paper, 3"]
    assert ax.lines[0].get_ydata().tolist() == [2.5, 3.5]
    assert ax.lines[1].get_ydata().tolist() == [2.0, 2.2]
    band = ax.collections[0].get_paths()[0].vertices
    assert (band[:, 1].min(), band[:, 1].max()) == (2.0, 4.0)


def test_an_unknown_control_is_not_in_the_legend_and_no_exponent_is_said_to_be_none():
    ax = plot_exponents(EXPONENTS.assign(control_exponent=np.nan))
    assert labels(ax) == ["grains break", "paper, 3"]
    ax = plot_exponents(EXPONENTS.assign(exponent=np.nan))
    assert ax.texts[0].get_text() == "no data: no loaded state bears an exponent"


LOADS = pd.DataFrame(
    {
        "low": [0.5, 1.0, 2.0],
        "high": [1.0, 2.0, 4.0],
        "kind": ["fragments", "fragments", "first grains"],
    }
    | {"largest_force_N": [1.0, 2.0, 8.0]}
    | {"largest_force_low_N": [-1.0, 1.5, 7.0], "largest_force_high_N": [3.0, 2.5, 9.0]}
)


def test_forces_stand_at_the_middle_of_their_class():
    ax = plot_loads(LOADS)
    assert labels(ax) == ["first grains", "fragments"]
    line = ax.containers[1].lines[0]
    assert line.get_xdata().tolist() == pytest.approx([0.5**0.5, 2.0**0.5])
    assert line.get_ydata().tolist() == [1.0, 2.0]
    # A limit below 0 has no place on the axis.
    bars = ax.containers[1].lines[2][0].get_segments()
    assert [bar[:, 1].tolist() for bar in bars] == [pytest.approx([0.1, 3.0]), [1.5, 2.5]]


def test_who_bears_no_load_is_not_in_the_legend():
    left = LOADS.assign(largest_force_N=[1.0, 2.0, np.nan])
    assert labels(plot_loads(left)) == ["fragments"]
    ax = plot_loads(LOADS.assign(largest_force_N=np.nan))
    assert ax.texts[0].get_text() == "no data: no grain bears load at the end"


def test_roc_curves_are_those_of_the_grains_asked_for():
    areas = pd.DataFrame({"among": ["bearing", "all"], "foreteller": "stress", "area": [0.75, 0.9]})
    curves = pd.DataFrame(
        {"among": ["bearing", "bearing", "all"], "foreteller": "stress"}
        | {"false_alarms": [0.0, 0.5, 1.0], "found": [0.0, 1.0, 1.0]}
    )
    ax = plot_roc(areas, curves)
    assert labels(ax) == ["stress: 0.75", "by chance: 0.50"]
    assert ax.lines[0].get_xdata().tolist() == [0.0, 0.5]
    none = plot_roc(areas.assign(area=np.nan), curves)
    assert none.texts[0].get_text() == "no data: no grain broke"


def test_hazards_are_drawn_in_percent_by_class():
    table = pd.DataFrame({"group": "all", "by": "radius", "low": [1.0, 2.0], "high": [2.0, np.inf]})
    table = table.assign(**with_limits("hazard", [0.1, 0.3], 0.05))
    ax = plot_hazard(table, "radius")
    assert ax.containers[0].lines[0].get_ydata().tolist() == pytest.approx([10.0, 30.0])
    assert [text.get_text() for text in ax.get_xticklabels()] == ["1–2", "2+"]
    nothing = plot_hazard(table, "contacts")
    assert nothing.texts[0].get_text() == "no data: no grain broke"
