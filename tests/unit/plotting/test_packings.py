"""Fig. 4: grains in their places, sizes and order of depth, and the cell about them."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting.packings import plot_packing, sphere_image

pytestmark = pytest.mark.filterwarnings("error")

CUBE = np.eye(3)
RED, BLUE = [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]


def image_of(positions, radii, colours, pixels=200):
    return sphere_image(np.array(positions), np.array(radii), 2.0, pixels, np.array(colours))


def test_sphere_fills_its_disc_at_its_place():
    image = image_of([[0.5, 0.0, -1.0]], [0.5], [RED])
    filled = image[..., 3] == 1.0
    # A circle of 0.5 on a square of 4: pi/64 of it.
    assert filled.mean() == pytest.approx(np.pi * 0.25 / 16.0, rel=0.02)
    rows, columns = np.nonzero(filled)
    # Pixels of 0.02 from -2: right 0.5, up -1.
    assert (columns.mean() + 0.5) * 0.02 - 2.0 == pytest.approx(0.5, abs=0.01)
    assert (rows.mean() + 0.5) * 0.02 - 2.0 == pytest.approx(-1.0, abs=0.01)
    assert image[..., :3][filled][:, 1:].max() == 0.0


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_nearer_sphere_hides_the_other_whatever_their_order(order):
    places, colours = [[0.0, -2.0, 0.0], [0.0, 2.0, 0.0]], [RED, BLUE]
    image = image_of([places[k] for k in order], [1.0, 1.0], [colours[k] for k in order])
    middle = image[100, 100]
    assert middle[0] > 0.0 and middle[2] == 0.0


def test_light_falls_from_above_on_the_left():
    image = image_of([[0.0, 0.0, 0.0]], [1.5], [[1.0, 1.0, 1.0]])
    bright = image[..., 0]
    assert bright[140, 60] > bright[60, 140]


def test_sphere_outside_the_picture_leaves_it_clear():
    assert image_of([[9.0, 0.0, 0.0]], [1.0], [RED])[..., 3].max() == 0.0


def test_larger_grains_are_darker():
    def brightness(radius):
        ax = plot_packing(
            np.zeros((1, 3)), np.array([radius]), 4e-3 * CUBE, pixels=60, radius_max=1e-3
        )
        image = ax.images[0].get_array()
        return image[30, 30, :3].sum()

    assert brightness(0.95e-3) < brightness(0.3e-3)


def test_cell_is_drawn_to_the_scale_of_the_larger_one():
    whole = plot_packing(np.zeros((1, 3)), np.ones(1) * 1e-4, 2e-3 * CUBE, pixels=20)
    both = np.array([2e-3 * CUBE, 1e-3 * CUBE])
    part = plot_packing(np.zeros((1, 3)), np.ones(1) * 1e-4, 1e-3 * CUBE, extent=both, pixels=20)
    # 0.86 of the edge of a cube, in mm.
    assert_allclose(whole.get_xlim(), (-1.72, 1.72), rtol=5e-3)
    assert_allclose(part.get_xlim(), whole.get_xlim())
    edges, halves = ([line.get_xdata() for line in ax.lines[:12]] for ax in (whole, part))
    assert_allclose(np.array(halves), np.array(edges) / 2.0)
    lengths = [
        np.hypot(np.diff(line.get_xdata()), np.diff(line.get_ydata())) for line in whole.lines
    ]
    # The upright edges, tilted by 22 degrees.
    assert np.sum(np.isclose(np.ravel(lengths[:12]), 2.0 * np.cos(np.radians(22.0)))) == 4
    assert lengths[12] == pytest.approx(1.0)
    assert whole.texts[0].get_text() == "1 mm"


def test_a_tilted_cell_has_edges_along_its_vectors():
    tilted = 1e-3 * np.array([[2.0, 0, 0], [1.0, 2, 0], [0, 0, 3]])
    ax = plot_packing(np.zeros((1, 3)), np.ones(1) * 1e-4, tilted, pixels=20)
    ways = [(np.ptp(line.get_xdata()), np.ptp(line.get_ydata())) for line in ax.lines[:12]]
    # Turned by 35 degrees about the vertical, and tilted by 22.
    (c, s), (ct, st) = ((np.cos(np.radians(one)), np.sin(np.radians(one))) for one in (35.0, 22.0))
    seen = [(abs(c * x + s * y), abs(st * (c * y - s * x) + ct * z)) for x, y, z in 1e3 * tilted]
    assert sorted(np.round(ways, 9).tolist()) == sorted(np.round(4 * seen, 9).tolist())
