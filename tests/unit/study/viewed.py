"""Grains at known places, and a page that shows them."""

from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

from branchcrush.study.templates import page_environment, page_parts
from branchcrush.study.viewer import ViewerState

REPORT = Path(__file__).parents[3] / "workflow/report"
PAGE = """<!doctype html><html lang="en"><head><meta charset="utf-8"><title>grains</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>body {margin: 0 1rem}</style>
{% from "viewer.html.jinja" import viewer, viewer_assets %}{{ viewer_assets() }}</head><body>
{% for name, packed in views %}{{ viewer(name, packed.header, packed.data, still) }}
<div style="height: 60rem"></div>
{% endfor %}</body></html>"""
EDGE = 10e-3
CUBE = EDGE * np.eye(3)


def state(positions, radius, *, number=0, pairs=(), force=(), walls=(), generation=None, **others):
    """Return a state of grains at places in millimetres; walls: grain, direction, force."""
    radius = np.asarray(radius, dtype=float) * 1e-3
    ends = np.array(pairs, dtype=int).reshape(-1, 2)
    at_walls = np.array(walls, dtype=float).reshape(-1, 5)
    values = {
        "energy": np.geomspace(1e-9, 1e-4, radius.size),
        "pressure": np.geomspace(1e6, 1e3, radius.size),
        "cell": CUBE,
        **others,
    }
    return ViewerState(
        state=number,
        label="loading",
        solid_fraction=0.25 + number / 10,
        mean_stress=1e6 * (1 + number),
        positions=np.asarray(positions, dtype=float) * 1e-3,
        radius=radius,
        i=ends[:, 0],
        j=ends[:, 1],
        force=np.asarray(force, dtype=float),
        wall_grain=at_walls[:, 0].astype(int),
        wall_direction=at_walls[:, 1:4],
        wall_force=at_walls[:, 4],
        generation=generation,
        **values,
    )


def write_page(folder, views):
    """Write a page with the views, by their names, and return its path."""
    still = folder / "still.png"
    plt.imsave(still, np.full((40, 80, 3), 0.4))
    page = page_environment(page_parts(REPORT)).from_string(PAGE)
    path = folder / "page.html"
    path.write_text(page.render(views=list(views.items()), still=still), encoding="utf-8")
    return path
