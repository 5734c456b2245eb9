"""Force chains, energies of branches and roses: what is drawn of a few grains at known places."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.collections import LineCollection

from branchcrush.plotting import chains, network_figures

pytestmark = pytest.mark.filterwarnings("error")

# Two grains in the middle that touch, one above the slab that touches the first, and a pair that
# touches through the face at x = 5 mm.
GRAINS = pd.DataFrame(
    {
        "x_m": [-1e-3, 1e-3, -1e-3, -4.5e-3, 4.5e-3],
        "y_m": [0.0, 0.0, 2e-3, 0.0, 0.0],
        "z_m": [0.0, 0.0, 0.0, 3e-3, 3e-3],
        "radius_m": [1e-3, 1e-3, 1e-3, 0.5e-3, 0.5e-3],
    }
)
CONTACTS = pd.DataFrame(
    {
        "state": 7,
        "i": [0, 0, 3],
        "j": [1, 2, 4],
        "branch_x": [2e-3, 0.0, -1e-3],
        "branch_y": [0.0, 2e-3, 0.0],
        "branch_z": [0.0, 0.0, 0.0],
        "normal_force_N": [4.0, 2.0, 1.0],
        "energy_J": [6.0, 2.0, 1.0],
    }
)
CELL = 1e-2 * np.eye(3)
PATH = pd.DataFrame(
    {"leg": ["loading"] * 2, "state": [6, 7], "volume_m3": [2e-6, 1e-6], "solid_fraction": 0.6}
)


def lines_of(ax):
    (lines,) = (one for one in ax.collections if isinstance(one, LineCollection))
    return lines, np.array([path.vertices for path in lines.get_paths()])


def test_slab_has_its_own_contacts_as_wide_as_their_forces():
    lines, segments = lines_of(chains.plot_slab(GRAINS, CONTACTS, CELL, 1e-3))
    # Two halves each of the pair in the middle and of the one through the face.
    np.testing.assert_allclose(segments[0], [[-1, 0], [0, 0]], atol=1e-12)
    np.testing.assert_allclose(segments[1], [[1, 0], [0, 0]], atol=1e-12)
    np.testing.assert_allclose(segments[2], [[-4.5, 3], [-5, 3]], atol=1e-12)
    np.testing.assert_allclose(segments[3], [[4.5, 3], [5, 3]], atol=1e-12)
    widths = np.array(lines.get_linewidths())
    np.testing.assert_allclose(widths / widths[0], [1, 1, 0.25, 0.25])


def test_a_thicker_slab_holds_the_grain_above():
    _, segments = lines_of(chains.plot_slab(GRAINS, CONTACTS, CELL, 4.1e-3))
    assert len(segments) == 6


def test_branches_are_coloured_by_energy_over_the_mean():
    lines, _ = lines_of(chains.plot_branch_energy(GRAINS, CONTACTS, CELL, 1e-3))
    np.testing.assert_allclose(lines.get_array(), [2.0, 2.0, 1 / 3, 1 / 3])


def test_rose_of_parallel_branches_is_one_sector_and_its_opposite():
    angles = np.full(24, np.radians(40.0))
    contacts = pd.DataFrame(
        {"branch_x": np.cos(angles), "branch_y": 0.3, "branch_z": np.sin(angles)}
    )
    contacts.loc[12:, ["branch_x", "branch_y", "branch_z"]] *= -1.0  # without head or tail
    ax = chains.plot_rose(contacts, "y")
    middles = [round(float(np.degrees(bar.get_x() + bar.get_width() / 2))) for bar in ax.patches]
    heights = {middle: bar.get_height() for middle, bar in zip(middles, ax.patches, strict=True)}
    assert {angle for angle, height in heights.items() if height} <= {37, 38, 217, 218}
    assert sum(heights.values()) == 2 * chains.SECTORS


def test_figures_show_the_end_of_the_loading_alone(drawn):
    earlier = CONTACTS.assign(state=6, normal_force_N=100.0)
    both = pd.concat([earlier, CONTACTS])
    slab, energy, *_ = drawn(network_figures.draw_chains, GRAINS, both, PATH)
    assert "widest 4 N, mean 2.33 N" in slab.get_title()
    assert slab.get_xlim() == pytest.approx((-5.3, 5.3)) == energy.get_xlim()
    # The whole of a cell that another code tilted.
    tilted = [[[1e-2, 0, 0], [4e-3, 1e-2, 0], [0, 0, 1e-2]]] * 2
    slab, *_ = drawn(network_figures.draw_chains, GRAINS, both, PATH, {"cells_m": tilted})
    assert slab.get_xlim() == pytest.approx((-7.42, 7.42))
    roses = drawn(network_figures.draw_rose, both, PATH)
    assert [ax.get_title() for ax in roses] == [f"seen along {axis}" for axis in "xyz"]


def test_grains_without_contacts_say_so(drawn):
    for draw, data in (
        (network_figures.draw_chains, (GRAINS, CONTACTS[:0], PATH)),
        (network_figures.draw_rose, (CONTACTS[:0], PATH)),
    ):
        assert all("no grain touches" in ax.texts[0].get_text() for ax in drawn(draw, *data))
