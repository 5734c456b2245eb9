"""What a test of a figure needs: its Axes read as numbers, and every figure closed after it."""

import numpy as np
import pytest
from matplotlib import image
from matplotlib import pyplot as plt

from tests.pictures import covered_legends, is_whole, overlapping_letters


class Reading:
    """What an Axes shows, as numbers."""

    def line(self, ax, label):
        """Return x and y, shape (2, n), of the one line or set of points with this label."""
        (line,) = (one for one in ax.lines if str(one.get_label()) == label)
        return self.points(line)

    def points(self, line):
        """Return x and y of a line, shape (2, n)."""
        return np.array([line.get_xdata(), line.get_ydata()], dtype=float)

    def bars(self, container, axis="y"):
        """Return lower and upper ends of the bars of points, shape (2, n)."""
        (bars,) = container[2]
        column = "xy".index(axis)
        return np.array([segment[:, column] for segment in bars.get_segments()], dtype=float).T

    def band(self, collection):
        """Return x, lower and upper end of a band, shape (3, n), at each x it was given."""
        x, y = collection.get_paths()[0].vertices.T
        at = np.unique(x)
        return np.array([at, [y[x == v].min() for v in at], [y[x == v].max() for v in at]])

    def texts(self, ax):
        """Return the texts of the legend."""
        return [text.get_text() for text in ax.get_legend().get_texts()]

    def legend_is_above(self, ax):
        """Return whether the legend is above the panel."""
        ax.figure.canvas.draw()
        return ax.get_legend().get_window_extent().y0 >= ax.get_window_extent().y1


@pytest.fixture
def shown():
    return Reading()


@pytest.fixture
def drawn(tmp_path):
    """Return a function that draws a figure and returns its Axes, having looked at the file."""

    def draw(function, *data):
        path = tmp_path / "folder" / "figure.png"
        figure = function(path, 100, *data)
        assert (image.imread(path)[..., :3].min(axis=-1) < 0.9).any()
        assert is_whole(path)
        # Last drawn as SVG, with other places in dots.
        figure.draw_without_rendering()
        assert overlapping_letters(figure) == []
        assert covered_legends(figure) == []
        for ax in figure.axes:
            # What a panel says is tested; that it has a letter is, in test_style.
            for text in [text for text in ax.texts if text.get_gid() == "letter"]:
                text.remove()
        return figure.axes

    return draw


@pytest.fixture
def given(monkeypatch):
    """Return a function that stands in for plots, and what each of them was given."""
    calls = {}

    def record(module, *names):
        for name in names:

            def plot(*data, ax, name=name):
                calls[name] = data
                return ax

            monkeypatch.setattr(module, name, plot)
        return calls

    return record


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")
