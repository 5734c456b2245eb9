"""The files of a figure: what they show is what was drawn."""

import numpy as np
import pytest
from matplotlib import image
from matplotlib.figure import Figure
from PIL import Image

from branchcrush.plotting.saving import save

pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture
def drawing():
    """Return what takes many colours: a scale of them, discs over each other, thin lines, words."""
    rng = np.random.default_rng(1)
    drawing = Figure(figsize=(4.0, 3.0), layout="constrained")
    ax = drawing.add_subplot()
    places = rng.random((2, 400))
    discs = ax.scatter(*places, s=200 * rng.random(400), c=places[0], alpha=0.5, edgecolors="k")
    ax.plot([0, 1], [0, 1], color="#c1440e", lw=0.7)
    ax.set(xlabel=r"$\phi$ [-]", ylabel="stress [Pa]")
    drawing.colorbar(discs, label="radius [m]")
    return drawing


def test_a_png_of_256_colours_shows_what_one_of_all_colours_does(tmp_path, drawing):
    shown = drawing.canvas
    png, svg = save(drawing, tmp_path / "few.png", 150)
    assert drawing.canvas is shown and drawing.dpi == 150
    # Laid out by now.
    drawing.savefig(tmp_path / "all.png", dpi=150)
    assert [png.name, svg.name] == ["few.png", "few.svg"]
    few, every = (255.0 * image.imread(tmp_path / f"{name}.png") for name in ("few", "all"))
    off = np.abs(few - every)[..., :3]
    assert len(np.unique(every.reshape(-1, 4), axis=0)) > 10_000
    # A tenth of the range at most; one that is hard to see on average.
    assert off.max() <= 25.5 and off.mean() < 3.0
    with Image.open(png) as written:
        assert written.mode == "P" and written.info["dpi"] == pytest.approx((150, 150), abs=0.1)


def test_a_white_page_stays_white_and_a_line_keeps_its_colour(tmp_path):
    drawing = Figure(figsize=(2.0, 1.0))
    drawing.add_axes((0.1, 0.4, 0.8, 0.2), facecolor="#c1440e").set_axis_off()
    drawing.axes[0].patch.set_visible(True)
    drawing.axes[0].axhspan(0.0, 1.0, color="#1f4e79")
    png, _ = save(drawing, tmp_path / "plain.png", 100)
    with Image.open(png) as written:
        colours = written.convert("RGB")
    assert colours.getpixel((1, 1)) == (255, 255, 255)
    assert colours.getpixel((100, 50)) == (0x1F, 0x4E, 0x79)


def test_what_is_laid_out_is_laid_out_once_for_all_its_files(tmp_path, drawing):
    png, svg = save(drawing, tmp_path / "new" / "both.png", 100)
    places = [ax.get_position().bounds for ax in drawing.axes]
    drawing.draw_without_rendering()
    assert [ax.get_position().bounds for ax in drawing.axes] == places
    left, bottom, right, top = drawing.axes[0].get_tightbbox().extents
    assert left >= 0 and bottom >= 0 and right <= 400 and top <= 300
    again, _ = save(drawing, tmp_path / "again.png", 100)
    assert again.read_bytes() == png.read_bytes() and svg.exists()
