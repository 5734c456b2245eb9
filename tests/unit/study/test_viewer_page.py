"""The view of grains in a browser: what it draws, what it reacts to, and what it does without."""

import numpy as np
import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin

from branchcrush.study.viewer import viewer_data
from tests.unit.study.browser import at_rest, browser, difference, open_page, picture, requests
from tests.unit.study.viewed import CUBE, state, write_page

# The view that a page begins with.
TURN, TILT = 0.61, 0.38
C, S, CT, ST = np.cos(TURN), np.sin(TURN), np.cos(TILT), np.sin(TILT)
AXES = np.array([[C, S, 0], [-ST * S, ST * C, CT], [CT * S, -CT * C, ST]])
RIGHT, UP, TOWARD = AXES
CHAIN = np.array([0x8F, 0x1D, 0x14]) / 255
GREY, YELLOW, RED = np.array([[201, 206, 214], [232, 176, 74], [193, 68, 14]]) / 255

# Sizes and places [mm]: a large first grain; before it a fragment, seen in front of it; behind it
# another, hidden; and two at opposite faces that touch through them.
PLACES = np.array([[0, 0, 0], 3.0 * TOWARD, -3.0 * TOWARD, [-4.6, 0, 3.5], [4.6, 0, 3.5]])
RADII = np.array([2.0, 0.7, 1.0, 0.45, 0.45])
STATES = [
    state(PLACES[:1], RADII[:1], generation=np.array([0])),
    state(
        PLACES,
        RADII,
        number=1,
        pairs=[(3, 4), (0, 4)],
        force=[2.0, 2.0],
        generation=np.array([0, 1, 2, 0, 0]),
    ),
]


@pytest.fixture(scope="module")
def driver():
    with browser() as started:
        yield started


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    many = np.stack(np.meshgrid(*[np.linspace(-4, 4, 5)] * 3), axis=-1).reshape(-1, 3)
    walled = state(many, np.full(125, 0.9), walls=[(0, 0, 0, -1, 1.0)])
    views = {
        "view": viewer_data(STATES, periodic=[True] * 3, saved_states=3),
        "walled": viewer_data([walled], periodic=[False] * 3),
        "large": viewer_data([walled], periodic=[False] * 3, limit_bytes=100),
    }
    return write_page(tmp_path_factory.mktemp("viewed"), views)


@pytest.fixture
def opened(driver, page):
    open_page(driver, page)
    return driver


def control(driver, name, figure="view"):
    return driver.find_element("css selector", f"#{figure} [name={name}]")


def put(driver, name, value, figure="view"):
    driver.execute_script(
        "arguments[0].value = arguments[1];"
        "for (const kind of ['input', 'change']) arguments[0].dispatchEvent(new Event(kind))",
        control(driver, name, figure),
        str(value),
    )
    at_rest(driver, figure)


def half_height(cell, image):
    """Return half of what the view shows, from below to above: the cell and a rim of a tenth."""
    right, up, _ = 0.55 * np.abs(AXES @ np.transpose(cell)).sum(axis=1)
    height, width = (size + 6 for size in image.shape[:2])
    return max(up, right * height / width)


def per_mm(image):
    """Return the pixels of a millimetre in the first view."""
    # The rim that the picture goes without is part of what the view fills.
    return (image.shape[0] + 6) / 2 / half_height(CUBE * 1e3, image)


def at(image, place):
    """Return the pixel at which a place is seen [mm]."""
    place = per_mm(image) * np.asarray(place)
    return int(image.shape[0] / 2 - UP @ place), int(image.shape[1] / 2 + RIGHT @ place)


def hue(image, place):
    """Return the colour at a place, brought to its own largest part."""
    colour = image[at(image, place)]
    return colour / colour.max()


def same_hue(image, place, colour):
    return np.abs(hue(image, place) - colour / colour.max()).max() < 0.06


def test_radii_are_true_and_nearer_grains_hide_those_behind(opened):
    put(opened, "mode", "generation")
    image = picture(opened)
    ground = image[2, 2]
    two = 2 / per_mm(image)
    # Around the large grain, and around a small one.
    for place, radius in ((PLACES[0], 2.0), (PLACES[3], 0.45)):
        for angle in np.arange(8) * np.pi / 4:
            rim = np.cos(angle) * RIGHT + np.sin(angle) * UP
            # Two pixels on either side of the outline.
            inside = image[at(image, place + (radius - two) * rim)]
            outside = image[at(image, place + (radius + two) * rim)]
            assert np.abs(inside - ground).max() > 0.1, (radius, angle)
            assert np.abs(outside - ground).max() < 0.1, (radius, angle)
    assert same_hue(image, np.zeros(3), YELLOW)
    assert same_hue(image, 0.6 * RIGHT, YELLOW)
    assert same_hue(image, 0.85 * RIGHT, GREY)
    colours = image[np.ptp(image, axis=-1) > 0.2]
    red = np.abs(colours / colours.max(axis=1, keepdims=True) - RED / RED.max()).max(axis=1)
    assert not np.any(red < 0.03), "the grain behind is seen"


def test_a_cut_takes_away_what_is_before_it_and_shows_faces(opened):
    put(opened, "mode", "generation")
    put(opened, "axis", "1")
    image = picture(opened)
    # The plane y = 0 takes away the fragment in front and halves the large grain, which shows a
    # face of one shade.
    assert same_hue(image, np.zeros(3), GREY)
    face = [image[at(image, place)] for place in ([1, 0, 1], [-1, 0, -1], [0, 0, 1.5])]
    assert np.ptp(face, axis=0).max() < 0.02
    put(opened, "cut", 0.4)
    assert not np.any(np.ptp(picture(opened), axis=-1) > 0.2)
    put(opened, "cut", -0.4)
    assert same_hue(picture(opened), np.zeros(3), YELLOW)


def test_force_chains_go_through_the_faces_of_a_periodic_cell(opened):
    control(opened, "grains").click()
    control(opened, "chains").click()
    image = picture(opened)
    ground = image[2, 2]
    for beyond in (-4.8, 4.8):
        assert same_hue(image, [beyond, 0, 3.5], CHAIN)
    # Not across the cell.
    for between in (-3.0, 0.0, 3.0):
        assert np.abs(image[at(image, [between, 0, 3.5])] - ground).max() < 0.05
    assert same_hue(image, [2.3, 0, 1.75], CHAIN)
    legend = opened.find_element("css selector", "#view .viewer-bar").text
    assert "widest 2 N in this state" in legend
    control(opened, "grains").click()
    veiled = picture(opened)
    assert difference(image, veiled) > 0.02


def test_each_colour_mode_and_each_state_is_drawn(opened):
    pictures = {}
    for mode in ("radius", "energy", "pressure", "generation"):
        put(opened, "mode", mode)
        pictures[mode] = picture(opened)
        legend = opened.find_element("css selector", "#view .viewer-bar").text
        assert {"radius": "[mm]", "energy": "[J]", "pressure": "[Pa]"}.get(
            mode, "further"
        ) in legend
    names = list(pictures)
    for k, name in enumerate(names):
        for other in names[k + 1 :]:
            assert difference(pictures[name], pictures[other]) > 0.005, (name, other)
    put(opened, "state", 0)
    assert difference(picture(opened), pictures["generation"]) > 0.005
    told = opened.find_element("css selector", "#view .viewer-state").text
    assert told == "state 0, loading: φ = 0.250, mean stress 1 MPa, 1 grain, 0 contacts"


def test_mouse_wheel_keys_and_the_button_turn_and_zoom(opened):
    first = picture(opened)
    stage = opened.find_element("css selector", "#view .viewer-stage")
    ActionChains(opened).drag_and_drop_by_offset(stage, 120, 40).perform()
    dragged = picture(opened)
    assert difference(first, dragged) > 0.005
    control(opened, "reset").click()
    assert difference(first, picture(opened)) < 0.001
    # The wheel scrolls the page until the view is chosen.
    opened.execute_script("document.activeElement.blur()")
    wheel = ScrollOrigin.from_element(stage)
    ActionChains(opened).scroll_from_origin(wheel, 0, -200).perform()
    assert difference(first, picture(opened)) < 0.001
    stage.click()
    ActionChains(opened).scroll_from_origin(wheel, 0, -200).perform()
    before = picture(opened)
    assert difference(first, before) > 0.005
    for key in ("\ue012", "\ue013", "+", "-", "c", "f", "g", "g", "f", "x", "["):
        stage.send_keys(key)
        after = picture(opened)
        assert difference(before, after) > 0.0005, key
        before = after
    stage.send_keys("0")
    assert opened.execute_script("return document.activeElement.classList[0]") == "viewer-stage"


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [1300, 420])
def test_it_fits_the_window_and_asks_for_nothing(driver, page, width, dark):
    open_page(driver, page, width=width, height=900, dark=dark)
    image = picture(driver)
    ground = np.array([0x1B, 0x1E, 0x24] if dark else [0xFB, 0xFB, 0xFA]) / 255
    np.testing.assert_allclose(image[2, 2], ground, atol=0.01)
    assert np.mean(np.abs(image - ground).max(axis=-1) > 0.1) > 0.02
    assert driver.execute_script("return document.documentElement.scrollWidth") <= width
    if width == 420:
        low = driver.execute_script(
            "return [...document.querySelectorAll('#view select, #view button, #view summary, "
            "#view input[type=range], #view label')]"
            ".filter(e => e.getBoundingClientRect().height < 44).map(e => e.outerHTML)"
        )
        assert low == []
    assert driver.get_log("browser") == []
    assert requests(driver) == []


def test_fingers_turn_and_pinch(driver, page):
    open_page(driver, page, width=420, height=900)
    stage = driver.find_element("css selector", "#view .viewer-stage")
    box = stage.rect
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def touch(kind, *points):
        points = [{"x": x + dx, "y": y + dy, "id": k} for k, (dx, dy) in enumerate(points)]
        driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    first = picture(driver)
    touch("touchStart", (-60, 0))
    for step in range(-50, 60, 10):
        touch("touchMove", (step, 0))
    touch("touchEnd")
    turned = picture(driver)
    assert difference(first, turned) > 0.005
    driver.execute_script("arguments[0].focus()", stage)
    touch("touchStart", (-30, 0), (30, 0))
    for half in range(35, 100, 10):
        touch("touchMove", (-half, 0), (half, 0))
    touch("touchEnd")
    near = picture(driver)
    assert np.mean(np.ptp(near, axis=-1) > 0.1) > 1.5 * np.mean(np.ptp(turned, axis=-1) > 0.1)


def test_several_views_each_begin_when_seen(driver, page):
    open_page(driver, page)
    drawn = "return document.getElementById('walled').dataset.drawn"
    assert driver.execute_script(drawn) is None
    driver.execute_script("document.getElementById('walled').scrollIntoView()")
    at_rest(driver, "walled")
    assert driver.execute_script(drawn) == "live"
    assert driver.execute_script("return document.getElementById('view').dataset.drawn") == "closed"
    put(driver, "mode", "energy", "walled")
    for name in ("grains", "chains"):
        control(driver, name, "walled").click()
    # The contact of the grain at a corner with the wall below it.
    assert same_hue(picture(driver, "walled"), [-4, -4, -4.6], CHAIN)
    driver.execute_script("document.getElementById('view').scrollIntoView()")
    image = picture(driver)
    assert np.mean(np.ptp(image, axis=-1) > 0.1) > 0.01
    text = driver.find_element("css selector", "#large .viewer-why").text
    assert text == (
        "A still picture: 125 grains are more than a page can hold; the result files hold them."
    )
    caption = driver.find_element("css selector", "#view figcaption").text
    assert "Positions are known of 2 of 3 saved states." in caption


def test_without_webgl_a_still_picture_stays_and_says_why(page):
    with browser("--disable-3d-apis") as driver:
        open_page(driver, page)
        assert at_rest(driver)["drawn"] == "still"
        still = driver.find_element("css selector", "#view .viewer-still")
        assert still.is_displayed() and still.size["width"] > 400
        assert not driver.find_element("css selector", "#view .viewer-live").is_displayed()
        why = driver.find_element("css selector", "#view .viewer-why").text
        assert why == "A still picture: this browser draws no WebGL 2."
        assert [line for line in driver.get_log("browser") if line["level"] == "SEVERE"] == []


def test_print_has_the_still_picture(opened):
    opened.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    still = opened.find_element("css selector", "#view .viewer-still")
    live = opened.find_element("css selector", "#view .viewer-live")
    shown = still.is_displayed(), live.is_displayed()
    opened.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert shown == (True, False)
