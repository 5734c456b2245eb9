"""How a drawn figure becomes files."""

import os
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

# Of what no file of a figure tells: date and version of the plotting library.
_UNTOLD: dict[str, dict[str, None]] = {
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def save(drawing: Figure, path: str | os.PathLike, dpi: int) -> list[Path]:
    """Lay a figure out and write it, and return its files.

    Parameters
    ----------
    drawing : Figure
        By its layout engine, if it has one, and with none after that.
    path : path-like
        A PNG file, of 256 colours as pages show it, beside which the same is written as SVG; or a
        file of another ending, as .pdf, which is written alone. Its folder is made.
    dpi : int
        Dots per inch, of what is no line or letter too.

    Returns
    -------
    list of Path

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [file.name for file in save(Figure(), Path(folder) / "new" / "empty.png", 50)]
    ['empty.png', 'empty.svg']
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    shown = drawing.canvas
    drawing.set_dpi(dpi)
    # By the canvases themselves: to lay out, savefig would draw the whole figure once more, for
    # each file.
    dots = FigureCanvasAgg(drawing)
    if (layout := drawing.get_layout_engine()) is not None:
        layout.execute(drawing)
        drawing.set_layout_engine("none")
    if path.suffix == ".png":
        dots.draw()
        _in_colours(np.asarray(dots.buffer_rgba())).save(path, dpi=(dpi, dpi))
        files = [path, path.with_suffix(".svg")]
        FigureCanvasSVG(drawing).print_svg(files[1], metadata=_UNTOLD["svg"])
        drawing.set_dpi(dpi)
    else:
        drawing.savefig(path, dpi=dpi, metadata=_UNTOLD.get(path.suffix.removeprefix(".")))
        files = [path]
    drawing.set_canvas(shown)
    return files


def _in_colours(dots: NDArray) -> Image.Image:
    """Return a picture in 256 colours, those that no colour is far from."""
    # Not by median cut, which spends the colours on what is frequent and takes twice as long.
    opaque = Image.fromarray(dots).convert("RGB")
    return opaque.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
