"""Figure 4 of the paper: a picture of the packing, every grain in its place and size."""

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from branchcrush.packings.cells import CELL_EDGES, cell_corners
from branchcrush.plotting.style import axes

# The view: turned about the vertical, then tilted, as a draughtsman's box is drawn.
_TURN, _TILT = np.radians(35.0), np.radians(22.0)
# Half the width of the picture over that of what is seen of the cell: grains stand out of it.
_RIM = 1.19
_LIGHT = np.array([-0.45, -0.7, 0.55]) / np.linalg.norm([-0.45, -0.7, 0.55])


def sphere_image(
    positions: NDArray, radii: NDArray, scale: float, pixels: int, colours: NDArray
) -> NDArray:
    """Return an image of shaded spheres in orthographic view, hidden ones hidden.

    Each sphere fills the pixels of its disc that no nearer one covers; the surface there has a
    known height and normal.

    Parameters
    ----------
    positions : ndarray, shape (N, 3)
        In view axes: right, away from the eye, up [m].
    radii : ndarray, shape (N,)
        [m]
    scale : float
        Half the width of the image [m].
    pixels : int
        Width and height of the image.
    colours : ndarray, shape (N, 3)
        RGB, 0 to 1.

    Returns
    -------
    ndarray, shape (pixels, pixels, 4)
        RGBA, 0 to 1; clear where there is no sphere.

    Examples
    --------
    >>> image = sphere_image(np.zeros((1, 3)), np.ones(1), 2.0, 9, np.ones((1, 3)))
    >>> image[4, 4, 3], image[0, 0, 3]
    (np.float64(1.0), np.float64(0.0))
    """
    image = np.zeros((pixels, pixels, 4))
    depth = np.full((pixels, pixels), np.inf)
    centre = (np.arange(pixels) + 0.5) / pixels * 2.0 * scale - scale
    for place, radius, colour in zip(positions, radii, colours, strict=True):
        columns = np.flatnonzero(np.abs(centre - place[0]) < radius)
        rows = np.flatnonzero(np.abs(centre - place[2]) < radius)
        if not columns.size or not rows.size:
            continue
        window = np.ix_(rows, columns)
        right = (centre[columns] - place[0])[None, :] / radius
        up = (centre[rows] - place[2])[:, None] / radius
        squared = 1.0 - right**2 - up**2
        towards = np.sqrt(np.clip(squared, 0.0, None))
        surface = place[1] - radius * towards
        seen = (squared > 0) & (surface < depth[window])
        light = right * _LIGHT[0] - towards * _LIGHT[1] + up * _LIGHT[2]
        # A dark rim tells touching spheres of one colour apart.
        shade = (0.45 + 0.6 * np.clip(light, 0, 1)) * (0.55 + 0.45 * towards**0.5)
        shaded = np.clip(shade[..., None] * colour, 0, 1)
        patch = np.concatenate([shaded, np.ones((*shade.shape, 1))], axis=-1)
        image[window] = np.where(seen[..., None], patch, image[window])
        depth[window] = np.where(seen, surface, depth[window])
    return image


def plot_packing(
    positions: NDArray,
    radii: NDArray,
    cell: NDArray,
    *,
    extent: NDArray | None = None,
    pixels: int = 900,
    radius_max: float | None = None,
    colours: NDArray | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a packing in its cell, grains coloured by radius (Fig. 4) or as given.

    Parameters
    ----------
    positions : ndarray, shape (N, 3)
        About the centre of the cell [m].
    radii : ndarray, shape (N,)
        [m]
    cell : ndarray, shape (3, 3)
        Vectors of the edges of the cell, a row each [m].
    extent : ndarray, shape (3, 3) or (C, 3, 3), optional
        Cells that the picture is to hold, to draw states to one scale; its own without [m].
    pixels : int
        Width of the picture.
    radius_max : float, optional
        At the dark end of the colours [m].
    colours : ndarray, shape (N, 3), optional
        RGB of each grain, 0 to 1.
    ax : Axes, optional

    Returns
    -------
    Axes

    Examples
    --------
    >>> ax = plot_packing(np.zeros((1, 3)), np.ones(1), 2.0 * np.eye(3), pixels=50)
    """
    from matplotlib import colormaps

    ax = axes(ax)
    view = _rotation()
    scale = _RIM * np.abs(cell_corners(cell if extent is None else extent) @ view.T)[..., ::2].max()
    if colours is None:
        colours = colormaps["viridis"](1.0 - 0.85 * radii / (radius_max or radii.max()))[:, :3]
    image = sphere_image(positions @ view.T, radii, scale, pixels, colours)
    corners = cell_corners(cell) @ view.T
    ends = (-scale * 1e3, scale * 1e3)
    # Of the cell's edges those that meet at the far corner are behind the grains.
    far = np.argmax(corners[:, 1])
    for a, b in CELL_EDGES:
        behind = far in (a, b)
        ax.plot(
            corners[[a, b], 0] * 1e3,
            corners[[a, b], 2] * 1e3,
            color="#555555",
            lw=0.6,
            zorder=1 if behind else 3,
        )
    ax.imshow(image, origin="lower", extent=ends * 2, zorder=2, interpolation="antialiased")
    bar = 10.0 ** np.floor(np.log10(scale * 1e3))
    ax.plot([ends[0], ends[0] + bar], [ends[0] * 0.98] * 2, color="k", lw=1.5, clip_on=False)
    ax.text(
        ends[0] + bar / 2, ends[0] * 0.95, f"{bar:g} mm", ha="center", va="bottom", fontsize=6.5
    )
    ax.set(xlim=ends, ylim=ends, aspect="equal")
    ax.set_axis_off()
    return ax


def _rotation() -> NDArray:
    """Return the axes of the view, a row each: right, away from the eye, up."""
    turn = np.array(
        [
            [np.cos(_TURN), np.sin(_TURN), 0],
            [-np.sin(_TURN), np.cos(_TURN), 0],
            [0, 0, 1],
        ]
    )
    tilt = np.array(
        [
            [1, 0, 0],
            [0, np.cos(_TILT), -np.sin(_TILT)],
            [0, np.sin(_TILT), np.cos(_TILT)],
        ]
    )
    return tilt @ turn
