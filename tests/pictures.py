"""What is judged of the pictures of figures, whatever they show."""

from matplotlib import image


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
