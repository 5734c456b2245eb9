"""Each figure of the packings: one file, every panel given its table."""

from functools import partial

import numpy as np
import pandas as pd
import pytest

from branchcrush.plotting import certificate, packing_figures

pytestmark = pytest.mark.filterwarnings("error")


PATH = pd.DataFrame(
    {
        "leg": ["loading", "loading", "unloading"],
        "solid_fraction": [0.16, 0.7, 0.65],
        "volume_m3": [8e-9, 1e-9, 1.1e-9],
    }
)
PACKING = (np.zeros((1, 3)), np.array([5e-4]), 2e-3)
AFTER = pd.DataFrame({"x_m": [0.0], "y_m": [0.0], "z_m": [0.0], "radius_m": [5e-4]})


def test_packing_is_drawn_before_and_after_to_one_scale(drawn):
    first, last = drawn(packing_figures.draw_packing, PACKING, AFTER, PATH, 1e-3)
    assert first.get_xlim() == last.get_xlim()
    assert "placed at random" in first.get_title() and "0.160" in first.get_title()
    assert "compressed" in last.get_title() and "0.700" in last.get_title()
    # An edge of 2 mm before and of 1 mm after.
    ends = [[line.get_xdata() for line in ax.lines[:12]] for ax in (first, last)]
    np.testing.assert_allclose(ends[0], 2.0 * np.array(ends[1]))


def test_packing_of_another_code_is_drawn_in_the_cells_that_were_read(drawn):
    cells = 1e-3 * np.array([np.diag([1.0, 1.0, edge]) for edge in (4.0, 6.0, 5.0)])
    draw = partial(packing_figures.draw_packing, reading={"cells_m": cells.tolist()})
    first, last = drawn(draw, PACKING, AFTER, PATH, 1e-3)
    assert "first frame" in first.get_title() and "densest frame" in last.get_title()
    # To the scale of the longer one, and its upright edges half as long again.
    assert first.get_xlim() == last.get_xlim()
    heights = [max(np.ptp(line.get_ydata()) for line in ax.lines[:12]) for ax in (first, last)]
    assert (
        heights[1] == pytest.approx(1.5 * heights[0]) == pytest.approx(6 * np.cos(np.radians(22)))
    )
    lowest = min(line.get_ydata().min() for line in last.lines[:12])
    assert lowest / last.get_ylim()[0] == pytest.approx(1 / 1.19)


def test_every_panel_of_the_certificate_has_its_table(drawn, given):
    plots = ("plot_rest", "plot_overlaps", "plot_dissipation", "plot_jamming", "plot_convergence")
    calls = given(certificate, *plots)
    limits = {"inertial_number": 1e-4}
    verdict = {"limits": limits, "convergence": ["row"]}
    drawn(packing_figures.draw_certificate, "states", "jamming", verdict)
    assert calls == {
        "plot_rest": ("states", limits),
        "plot_overlaps": ("states", 0.05),
        "plot_dissipation": ("states",),
        "plot_jamming": ("jamming",),
        "plot_convergence": (["row"],),
    }
