"""What no packing has: beyond it a file is damaged, or its unit is another."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.errors import ReadingError
from branchcrush.packings.geometry import solid_volume
from branchcrush.packings.sizes import SMALLEST
from branchcrush.readers.cells import Cell

# How far from the origin anything is [m].
FURTHEST = 1e6
# Beyond it whole numbers are not told apart, and a square is no number.
LARGEST_ID, LARGEST_NUMBER = 2**53, 1e30
# Volume of a cell over that of a box of its edges, below which it is flat, and of all grains over
# that of the cell, above which they are not in it.
_FLAT, _FILLED = 1e-6, 2.0


def sound_cell(cell: Cell, positions: NDArray, radii: NDArray, where: str) -> Cell:
    """Return a cell, or refuse one that cannot hold its grains.

    Parameters
    ----------
    cell : Cell
    positions : ndarray, shape (N, 3)
        Of the grains [m].
    radii : ndarray, shape (N,)
        [m]
    where : str
        The file and its frame, for errors.

    Returns
    -------
    Cell

    Raises
    ------
    ReadingError
        When it is flat or endless, or its grains have more than twice its volume.

    Examples
    --------
    >>> cell = Cell.between([0, 0, 0], [1, 1, 0], (True, True, True))
    >>> sound_cell(cell, np.zeros((1, 3)), np.ones(1), "x.dump")
    Traceback (most recent call last):
    branchcrush.errors.ReadingError: x.dump: its cell has edges of 1, 1 and 0 m: it has no volume...
    """
    with np.errstate(all="ignore"):  # of numbers that are refused below
        edges = np.linalg.norm(cell.vectors, axis=1)
    shown = "{:.3g}, {:.3g} and {:.3g} m".format(*edges)
    # Not `>`, which is false of what is no number.
    if not (edges.max() <= FURTHEST and np.abs(cell.origin).max() <= FURTHEST):
        raise ReadingError(f"{where}: its cell has edges of {shown}: is the unit of length right?")
    if not (edges.min() >= SMALLEST and cell.volume > _FLAT * np.prod(edges)):
        raise ReadingError(
            f"{where}: its cell has edges of {shown}: it has no volume; write the file again, whole"
        )
    # A cell that does not repeat may end at the centres of the outermost grains.
    box = np.prod(np.ptp(positions, axis=0) + 2.0 * radii.max())
    filled = solid_volume(radii) / max(cell.volume, 0.0 if all(cell.periodic) else float(box))
    if filled > _FILLED:
        raise ReadingError(
            f"{where}: its grains have {filled:.3g} times the volume of the cell: are sizes radii "
            "(not diameters), and is their unit that of the cell?"
        )
    return cell
