"""What is judged of the pictures of figures, whatever they show."""

from matplotlib import image
from matplotlib.transforms import Bbox


def is_whole(path):
    """Return whether nothing of a picture on white is cut off at its edges."""
    dots = image.imread(path)[..., :3].min(axis=-1)
    edges = (dots[:1], dots[-1:], dots[:, :1], dots[:, -1:])
    return all((edge > 0.98).all() for edge in edges)


def overlapping_letters(figure):
    """Return the letters of panels that lie over an axis label or a title."""
    words = [text for ax in figure.axes for text in (ax.yaxis.label, ax.xaxis.label, ax.title)]
    taken = [text.get_window_extent() for text in words if text.get_text()]
    letters = [text for ax in figure.axes for text in ax.texts if text.get_gid() == "letter"]
    return [
        text.get_text()
        for text in letters
        if any(text.get_window_extent().overlaps(other) for other in taken)
    ]


def covered_legends(figure):
    """Return the words of legends that a drawn line goes through."""
    return [
        text.get_text()
        for ax in figure.axes
        if ax.get_legend() is not None
        for text in ax.get_legend().get_texts()
        if any(_goes_through(line, text.get_window_extent()) for line in ax.lines)
    ]


def _goes_through(line, box):
    """Return whether a line is seen in a box, as itself or by its marks."""
    path = line.get_transform().transform_path(line.get_path())
    seen = Bbox.intersection(box.padded(-1.0), line.axes.bbox)
    if seen is None or not len(path.vertices):
        return False
    if line.get_linestyle() != "None" and path.intersects_bbox(seen, filled=False):
        return True
    marked = line.get_marker() not in ("None", None, "", " ")
    return marked and any(seen.contains(*place) for place in path.vertices)
