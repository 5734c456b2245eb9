"""The view of grains in cells of any shape: its box, contacts through faces, and walls."""

import numpy as np
import pytest

from branchcrush.packings.cells import CELL_EDGES, cell_corners
from branchcrush.readers.cells import Cell
from branchcrush.study.viewer import viewer_data
from tests.unit.study.browser import at_rest, browser, open_page, picture
from tests.unit.study.test_viewer_page import AXES, CHAIN, RIGHT, UP, half_height
from tests.unit.study.viewed import state, write_page

# Vectors of the edges [mm]: a cuboid, tilted cells as LAMMPS has them, one with more than half an
# edge of tilt, and one that is turned in space.
TURNED = AXES @ np.array([[9.0, 0, 0], [3, 8, 0], [-2, 3, 10]])
CELLS = {
    "cuboid": np.diag([6.0, 9.0, 14.0]),
    "tilted": np.array([[9.0, 0, 0], [4.0, 8, 0], [-3, 2, 10]]),
    "much": np.array([[9.0, 0, 0], [13.0, 8, 0], [-7, 6, 10]]),
    "turned": TURNED,
}
PERIODIC = {"cuboid": (True, False, True)}
# In the first view, of the tilted cell: two grains on either side of the faces of b.
SHARES = np.array([[0.1, -0.47, -0.2], [0.1, 0.47, -0.2]])


@pytest.fixture(scope="module")
def driver():
    with browser() as started:
        yield started


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    tilted = CELLS["tilted"]
    across = SHARES @ tilted
    pair = state(across, [0.3, 0.3], pairs=[(0, 1)], force=[1.0], cell=1e-3 * tilted)
    # The same grains against a slope.
    slope = np.array([0.6, 0.0, -0.8])
    walled = state(
        [[0, 0, 0]], [2.0], walls=[(0, *slope, 1.0)], cell=1e-3 * np.diag([8.0, 8.0, 10.0])
    )
    views = {
        "view": viewer_data([pair], periodic=[True] * 3),
        "walled": viewer_data([walled], periodic=[True, True, False]),
    }
    return write_page(tmp_path_factory.mktemp("cells"), views)


@pytest.fixture
def opened(driver, page):
    open_page(driver, page)
    return driver


def only_chains(driver, figure="view"):
    driver.execute_script("document.getElementById(arguments[0]).scrollIntoView()", figure)
    at_rest(driver, figure)
    for name in ("grains", "chains"):
        driver.find_element("css selector", f"#{figure} [name={name}]").click()
    return picture(driver, figure)


def seen(image, place, cell):
    """Return the pixels about where a place is seen [mm]."""
    # The rim that the picture goes without is part of what the view fills.
    place = (image.shape[0] + 6) / 2 / half_height(cell, image) * np.asarray(place)
    row, column = image.shape[0] / 2 - UP @ place, image.shape[1] / 2 + RIGHT @ place
    return image[int(row) - 2 : int(row) + 3, int(column) - 2 : int(column) + 3].reshape(-1, 3)


def has(pixels, colour):
    return np.abs(pixels - colour).max(axis=1).min() < 0.15


def test_the_box_of_a_tilted_cell_is_drawn_along_its_vectors(opened):
    image = only_chains(opened)
    ground, cell = image[2, 2], CELLS["tilted"]
    corners = cell_corners(cell)
    for a, b in CELL_EDGES:
        for share in (0.2, 0.8):
            pixels = seen(image, corners[a] + share * (corners[b] - corners[a]), cell)
            assert np.abs(pixels - ground).max() > 0.2, (a, b)
    # Nothing where the edges of a cube of that volume would be.
    cube = cell_corners(np.cbrt(abs(np.linalg.det(cell))) * np.eye(3))
    upright = [(cube[a] + cube[b]) / 2 for a, b in CELL_EDGES if abs((cube[a] - cube[b])[2]) > 1]
    assert any(np.abs(seen(image, place, cell) - ground).max() < 0.05 for place in upright)


def test_contacts_through_the_faces_of_a_tilted_cell_are_two_short_lines(opened):
    image = only_chains(opened)
    cell, dark = CELLS["tilted"], CHAIN * 0.9
    for share in (-0.49, 0.49):
        assert has(seen(image, [0.1, share, -0.2] @ cell, cell), dark)
    ground = image[2, 2]
    for share in (-0.4, -0.1, 0.1, 0.4):
        assert np.abs(seen(image, [0.1, share, -0.2] @ cell, cell) - ground).max() < 0.05
    caption = opened.find_element("css selector", "#view figcaption").text
    assert caption.startswith("The cell is periodic: a contact through a face is drawn as two")


def test_a_contact_with_a_slope_ends_at_the_surface_of_the_grain(opened):
    image = only_chains(opened, "walled")
    cell, slope = np.diag([8.0, 8.0, 10.0]), np.array([0.6, 0.0, -0.8])
    assert has(seen(image, 1.8 * slope, cell), CHAIN * 0.9)
    assert not has(seen(image, 2.4 * slope, cell), CHAIN * 0.9)
    caption = opened.find_element("css selector", "#walled figcaption").text
    assert "periodic along 2 of its edges" in caption
    assert "A contact with a wall is drawn to where the grain touches it." in caption


@pytest.mark.parametrize("name", CELLS)
def test_lines_are_the_nearest_images_that_readers_find(opened, name):
    """The page and the room that reads packings find the same images, each by code of its own."""
    vectors, periodic = CELLS[name], PERIODIC.get(name, (True, True, True))
    rng = np.random.default_rng(len(name))
    places = rng.uniform(-0.5, 0.5, (40, 3)) @ vectors
    i, j = rng.integers(0, 40, (2, 300))
    known = state(places, np.ones(40), cell=1e-3 * vectors, force=np.ones(300),
                  pairs=np.column_stack([i, j]))  # fmt: skip
    header, data = viewer_data([known], periodic=periodic)
    ends = opened.execute_script(
        "const [header, data] = arguments, D = branchcrushData;"
        "return Array.from(D.chains(header, D.state(header, D.words(data), 0)).ends)",
        header,
        data,
    )
    lines = 1e3 * np.reshape(ends, (-1, 2, 3))
    apart = places[j] - places[i]
    nearest = Cell(-vectors.sum(axis=0) / 2, vectors, periodic).nearest(apart)
    through = np.abs(nearest - apart).max(axis=1) > 1e-6
    assert 50 < through.sum() < 300
    expected = []
    for a, b, vector, two in zip(i, j, nearest, through, strict=True):
        start = [(a, vector / 2), (b, -vector / 2)] if two else [(a, vector)]
        expected += [[places[grain], places[grain] + way] for grain, way in start]
    np.testing.assert_allclose(lines, expected, atol=1e-3)
    if all(periodic):
        longest = np.linalg.norm(2 * cell_corners(vectors), axis=1).max()
        assert np.linalg.norm(np.diff(lines, axis=1), axis=-1).max() < longest / 2


def test_sizes_of_cells_are_those_of_their_corners(driver, page):
    open_page(driver, page)
    told = driver.execute_script(
        "const D = branchcrushData, [cell] = arguments;"
        "return [D.size(cell), D.width(cell, [1, 0, 0])]",
        CELLS["tilted"].tolist(),
    )
    assert told == pytest.approx([np.cbrt(9 * 8 * 10), 9 + 4 + 3])


def test_the_whole_of_a_long_cell_is_in_the_first_view(driver, page, tmp_path):
    for name, cell in {"high": np.diag([3.0, 3, 30]), "broad": np.diag([30.0, 3, 3])}.items():
        view = {
            "view": viewer_data([state([[0, 0, 0]], [0.1], cell=1e-3 * cell)], periodic=[True] * 3)
        }
        (tmp_path / name).mkdir()
        for width in (1300, 420):
            open_page(driver, write_page(tmp_path / name, view), width=width)
            driver.execute_script("document.querySelector('.viewer-scale').hidden = true")
            image = picture(driver)
            drawn = np.argwhere(np.abs(image - image[2, 2]).max(axis=-1) > 0.15)
            ends = np.ptp(drawn, axis=0) / image.shape[:2]
            # But for a rim of a tenth, whichever way the cell is long.
            assert ends.max() == pytest.approx(1 / 1.1, abs=0.02), (name, width)
