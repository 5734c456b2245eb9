"""The figure of the fabric: one state or two, one seed or many, beside what chance gives."""

import numpy as np
import pandas as pd
import pytest
from matplotlib import pyplot as plt
from numpy.testing import assert_allclose

from branchcrush.files.tables import read_json, read_table, write_json, write_table
from branchcrush.forces.fabric import chance_range, fabric_result
from branchcrush.plotting.forces import plot_fabric
from branchcrush.plotting.style import figure

pytestmark = pytest.mark.filterwarnings("error")

BOTH = ("near_jamming", "end")


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")


def results(folder, seeds, places=BOTH):
    """Return table and summary as the workflow writes and reads them, of isotropic branches."""
    rng = np.random.default_rng(1)
    tables, summary = [], {}
    for where in places:
        vectors = list(rng.standard_normal((seeds, 600, 3)))
        rows, fabric = fabric_result(vectors, list(rng.standard_exponential((seeds, 600))))
        tables.append(pd.DataFrame({"where": where} | dict(pd.DataFrame(rows).items())))
        summary[where] = {"fabric": fabric}
    write_table(folder / "fabric.csv", pd.concat(tables, ignore_index=True), {})
    write_json(folder / "sharing.json", summary, {})
    return read_table(folder / "fabric.csv"), read_json(folder / "sharing.json")


def markers(ax):
    """Return the lines of an Axes that are points."""
    return [line for line in ax.get_lines() if line.get_marker() != "None"]


@pytest.mark.parametrize("places", [BOTH, BOTH[:1], BOTH[1:]])
@pytest.mark.parametrize("seeds", [1, 4])
def test_branches_and_forces_of_every_seed_are_points(tmp_path, seeds, places):
    table, summary = results(tmp_path, seeds, places)
    with figure(tmp_path / "figure.png", 50) as ax:
        assert plot_fabric(table, summary, ax) is ax
    assert (tmp_path / "figure.png").stat().st_size > 0
    assert len(markers(ax)) == 2 * len(places)
    for name, axis in (("deviator", "y"), ("expected_deviator", "x")):
        columns = (name, name.replace("deviator", "force_deviator"))
        measured = table[list(columns)].to_numpy().ravel()
        points = np.concatenate([getattr(line, f"get_{axis}data")() for line in markers(ax)])
        assert_allclose(np.sort(points), np.sort(measured))
        assert getattr(ax, f"get_{axis}lim")()[1] > measured.max()


def test_the_legend_tells_the_deviators_over_the_expected(tmp_path):
    table, summary = results(tmp_path, 4)
    texts = [text.get_text() for text in plot_fabric(table, summary).get_legend().get_texts()]
    for where in BOTH:
        for kind in ("branches", "forces"):
            ratio = f"{summary[where]['fabric'][kind]['deviator_over_expected']:.2f}"
            assert any(text.startswith(kind) and text.endswith(ratio) for text in texts)


def test_the_band_is_that_of_one_seed_by_chance(tmp_path):
    (band,) = plot_fabric(*results(tmp_path, 3)).collections
    x, y = band.get_paths()[0].vertices.T
    slopes = y[x > 0] / x[x > 0]
    assert_allclose([slopes.min(), slopes.max()], chance_range(1))
