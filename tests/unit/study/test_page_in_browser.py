"""The report in headless Chromium: wide and narrow, light and dark, sorted, explained, printed."""

import base64
import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib import image
from selenium.webdriver.support.wait import WebDriverWait

from branchcrush.statistics.intervals import Interval
from tests.unit.study.browser import browser, requests
from tests.unit.study.conftest import fit as known_fit
from tests.unit.study.report_parts import NO_FIT, NOTHING, REASON, page_rendering

WIDTHS = (1300, 420)


@pytest.fixture(scope="module")
def driver():
    with browser() as started:
        yield started


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Return the pages of one sample, and of three: two with n and one without any data."""
    folder = tmp_path_factory.mktemp("page")
    fit = replace(known_fit(), packings=replace(known_fit().packings, solid_fraction=0.74))
    render = page_rendering(folder, fit)
    # A picture of the shape of a figure of one column.
    image.imsave(folder / "figure.png", np.random.default_rng(1).random((66, 85, 3)))
    lower = replace(fit, exponent=Interval(2.5, 2.4, 2.6))
    loose = {"fit": NO_FIT, "model": REASON, "statistics": REASON, "certificate": NOTHING}
    made = {"one": [{}], "three": [{"name": "loose", **loose}, {}, {"name": "low", "fit": lower}]}
    for name, samples in made.items():
        (folder / f"{name}.html").write_text(render(*samples), encoding="utf-8")
    return {name: (folder / f"{name}.html").as_uri() for name in made}


def see(driver, page, width=1300, scheme="light"):
    """Open a page in a window of a width."""
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    for kind in ("browser", "performance"):
        driver.get_log(kind)
    driver.get(page)


def settled(driver, script, *arguments):
    """Return what a script gives once the page has drawn twice."""
    wait = "requestAnimationFrame(() => requestAnimationFrame(() => done((() => {%s})())))"
    return driver.execute_async_script(
        "const done = arguments[arguments.length - 1];" + wait % script, *arguments
    )


def column(driver, number):
    cells = driver.find_elements("css selector", f"table.sortable td:nth-child({number})")
    return [cell.text.split(" ")[0] for cell in cells[:3]]


@pytest.mark.parametrize("page", ["one", "three"])
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_fits_shows_every_figure_and_asks_for_nothing(driver, pages, page, width, scheme):
    see(driver, pages[page], width, scheme)
    assert [line["message"] for line in driver.get_log("browser")] == []
    assert requests(driver) == []
    assert driver.execute_script("return document.documentElement.scrollWidth") <= width
    drawn = driver.execute_script(
        "return [...document.images].map(one => one.complete && one.naturalWidth * one.clientWidth)"
    )
    assert len(drawn) >= 15 and all(drawn)
    back = driver.execute_script("return getComputedStyle(document.body).backgroundColor")
    shade = np.mean([int(part) for part in re.findall(r"\d+", back)[:3]])
    assert shade > 200 if scheme == "light" else shade < 60


@pytest.mark.parametrize("width", WIDTHS)
def test_every_section_is_reached_from_the_contents_which_follow(driver, pages, width):
    see(driver, pages["three"], width)
    links = driver.execute_script(
        "return [...document.querySelectorAll('.contents a')].map(link => link.hash)"
    )
    assert len(links) > 30 and len(set(links)) == len(links)
    for number in range(0, len(links), 4):
        settled(
            driver,
            "document.documentElement.style.scrollBehavior = 'auto';"
            f"document.querySelector('.contents').open = true;"
            f"document.querySelectorAll('.contents a')[{number}].click();",
        )
        top, now = settled(
            driver,
            f"const place = document.getElementById({links[number][1:]!r});"
            "return [place.getBoundingClientRect().top,"
            "document.querySelector('.contents a.now').hash];",
        )
        assert -1 < top < 900
        assert now == links[number] or top > 72  # the last ones cannot come to the top
    folded = driver.execute_script("return !document.querySelector('.contents').open")
    assert folded == (width == 420)


def test_table_sorts_both_ways_and_keeps_what_has_no_number_below(driver, pages):
    see(driver, pages["three"])
    assert column(driver, 3) == ["none", "3.00", "2.50"]
    head = driver.find_element("css selector", "table.sortable th:nth-child(3)")
    for order, expected in (
        ("ascending", ["2.50", "3.00", "none"]),
        ("descending", ["3.00", "2.50", "none"]),
    ):
        driver.execute_script("arguments[0].querySelector('button').click()", head)
        assert column(driver, 3) == expected
        assert head.get_attribute("aria-sort") == order
    driver.execute_script("document.querySelector('table.sortable th button').click()")
    assert column(driver, 1) == ["loose", "low", "paper"]


def test_table_is_copied_with_tabs(driver, pages):
    see(driver, pages["three"])
    driver.execute_script(
        "document.addEventListener('copy', () => {window.copied = document.activeElement.value});"
        "document.querySelector('.copy').scrollIntoView({block: 'center', behavior: 'instant'})"
    )
    # By hand: a browser copies nothing that no one asked for.
    driver.find_element("css selector", ".copy").click()
    waited = WebDriverWait(driver, 10).until(lambda at: at.execute_script("return window.copied"))
    lines = waited.split("\n")
    assert lines[0].startswith("sample\tcertificate\tn and its interval\t")
    assert lines[1].startswith("loose\tnot certified\tnone\t") and len(lines) == 4


@pytest.mark.parametrize("width", WIDTHS)
def test_a_term_is_explained_where_it_stands_and_in_the_glossary(driver, pages, width):
    see(driver, pages["three"], width)
    lost = driver.execute_script(
        "return [...document.querySelectorAll('.term')]"
        ".filter(term => !document.getElementById(decodeURIComponent(term.hash.slice(1)))).length"
    )
    assert lost == 0
    box = driver.find_element("css selector", "#meaning")
    assert not box.is_displayed()
    driver.execute_script("document.querySelector('th .term[href=\"#term-jamming\"]').focus()")
    assert "solid fraction from which on a packing carries load" in box.text
    left, right = driver.execute_script(
        "const box = document.getElementById('meaning').getBoundingClientRect();"
        "return [box.left, box.right]"
    )
    assert left >= 0 and right <= width
    driver.execute_script("document.activeElement.blur()")
    assert not box.is_displayed()


def test_page_prints_with_nothing_folded(driver, pages):
    see(driver, pages["one"])
    driver.execute_script(
        "addEventListener('beforeprint', () => {window.folded ="
        "document.querySelectorAll('main details:not([open])').length})"
    )
    printed = driver.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})
    pdf = base64.b64decode(printed["data"])
    assert pdf.startswith(b"%PDF") and len(re.findall(rb"/Type\s*/Page\b", pdf)) > 5
    assert driver.execute_script("return window.folded") == 0


def test_one_sample_reads_like_one(driver, pages):
    see(driver, pages["one"])
    words = driver.find_element("css selector", "main").text
    assert words.startswith("paper\n")
    assert "Samples side by side" not in words and "1 of 1 sample" not in words
    assert driver.find_elements("css selector", "table.sortable") == []
