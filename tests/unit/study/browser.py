"""A page with views of grains in headless Chromium, and what is seen of it."""

import io
import json
import shutil
import time
from contextlib import contextmanager

import numpy as np
import pytest
from matplotlib.image import imread
from selenium import webdriver
from selenium.webdriver.chrome.service import Service

# WebGL by the processor, as a machine without a graphics card draws it.
FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)


@contextmanager
def browser(*flags):
    """Start Chromium, and end it."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    found = [chromium, shutil.which("chromedriver")]
    if None in found:
        pytest.skip("no chromium or no chromedriver: apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = found[0]
    for flag in (*FLAGS, *flags):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(found[1]))
    try:
        yield driver
    finally:
        driver.quit()


def open_page(driver, page, width=640, height=1000, dark=False):
    """Open a page in a window of a width, and wait until its first view has come to rest."""
    driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600},
    )
    driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": width < 600})
    scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})
    for kind in ("browser", "performance"):
        driver.get_log(kind)
    driver.get(page.as_uri())
    at_rest(driver)


def at_rest(driver, figure="view"):
    """Wait until a view is drawn and at rest, and return what it tells of itself."""
    now, until = {}, time.monotonic() + 20
    while time.monotonic() < until:
        now = driver.execute_script(
            "return {...document.getElementById(arguments[0]).dataset}", figure
        )
        if now.get("drawn") == "still" or now.get("busy") == "false":
            return now
        time.sleep(0.03)
    raise AssertionError(f"the view does not come to rest: {now}")


def picture(driver, figure="view"):
    """Return what the stage of a view shows, shape (height, width, 3), 0 to 1, without its rim."""
    at_rest(driver, figure)
    stage = driver.find_element("css selector", f"#{figure} .viewer-stage")
    image = imread(io.BytesIO(stage.screenshot_as_png))[:, :, :3]
    return image[4:-4, 4:-4]


def difference(one, other):
    """Return the share of the pixels in which two pictures differ clearly."""
    return float(np.mean(np.abs(one - other).max(axis=-1) > 0.1))


def requests(driver):
    """Return the addresses that the page asked for, but for itself and what it holds."""
    messages = (json.loads(line["message"])["message"] for line in driver.get_log("performance"))
    asked = [
        message["params"]["request"]["url"]
        for message in messages
        if message["method"] == "Network.requestWillBeSent"
    ]
    assert any(url.startswith("file:") for url in asked), "the log does not see requests"
    return [url for url in asked if not url.startswith(("file:", "data:"))]
