"""YADE's VTKExporter: spheres as points, interactions as lines, in legacy VTK."""

from os import PathLike

import numpy as np

from branchcrush.errors import ReadingError
from branchcrush.readers.frames import ColumnFrame
from branchcrush.readers.texts import lines_of, numbers_of, significant_digits

_KINDS = ("SCALARS", "VECTORS", "TENSORS")


def read_vtk(path: str | PathLike[str]) -> ColumnFrame:
    r"""Return spheres or interactions of a legacy VTK file in ASCII.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    ColumnFrame
        Of points: x, y, z and each quantity by its name. Of lines: start and end, (n, 3), and each
        quantity; the second end is where the periodic image of the grain is.

    Raises
    ------
    ReadingError
        When it is no such file, or breaks off.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> text = '''# vtk DataFile Version 3.0.
    ... spheres
    ... ASCII
    ...
    ... DATASET POLYDATA
    ... POINTS 1 double
    ... 1 2 3
    ... POINT_DATA 1
    ... SCALARS radius double 1
    ... LOOKUP_TABLE default
    ... 0.5
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "spheres.vtk")
    ...     _ = path.write_text(text)
    ...     columns = read_vtk(path).columns
    >>> columns["z"].tolist(), columns["radius"].tolist()
    ([3.0], [0.5])
    """
    lines = lines_of(path)
    if not lines[0].startswith("# vtk DataFile") or "ASCII" not in (
        line.strip() for line in lines[:4]
    ):
        raise ReadingError(
            f"{path}: is no legacy VTK file in ASCII, as YADE's export.VTKExporter writes it"
        )
    points, cells, data, digits = np.empty((0, 3)), None, {}, 0
    place = rows = 0
    while place < len(lines):
        words = lines[place].split() or [""]
        place += 1
        if words[0] in ("POINTS", "LINES", "POINT_DATA", "CELL_DATA"):
            rows = _count(words, place, path)
        if words[0] == "POINTS":
            points, place = _block(lines, place, rows, 3, path)
            digits = significant_digits(lines[place - len(points) : place])
        elif words[0] == "LINES":
            cells, place = _block(lines, place, rows, 3, path)
        elif words[0] in _KINDS:
            if len(words) < 2:
                raise ReadingError(f"{path}, line {place}: {words[0]} has no name")
            width = {"SCALARS": 1, "VECTORS": 3, "TENSORS": 9}[words[0]]
            if place < len(lines) and lines[place].startswith("LOOKUP_TABLE"):
                place += 1
            values, place = _numbers(lines, place, rows, width, path)
            data[words[1]] = values[:, 0] if width == 1 else values
    due = len(points) if cells is None else len(cells)
    for name, values in data.items():
        if len(values) != due:
            raise ReadingError(
                f"{path}: it has {len(values)} rows of {name[:60]}, where {due} are due; write it "
                "again, whole"
            )
    if cells is None:
        return ColumnFrame(str(path), dict(zip("xyz", points.T, strict=True)) | data, digits=digits)
    ends = _ends(cells, len(points), path)
    return ColumnFrame(
        str(path), {"start": points[ends[:, 0]], "end": points[ends[:, 1]]} | data, digits=digits
    )


def _count(words, line, path):
    """Return how many rows a line tells."""
    if len(words) < 2 or not words[1].isdecimal():
        told = words[1][:40] if len(words) > 1 else "nothing"
        raise ReadingError(
            f"{path}, line {line}: {words[0]} has to tell how many rows follow, not {told!r}"
        )
    # More digits than that are no number of rows, and slow to read.
    return int(words[1][:18])


def _ends(cells, points, path):
    """Return the two points of each line."""
    ends = cells[:, 1:]
    if np.any(cells[:, 0] != 2) or np.any((ends < 0) | (ends >= points) | (ends != np.floor(ends))):
        raise ReadingError(
            f"{path}: its lines do not each join two of its {points} points; write it again, whole"
        )
    return ends.astype(int)


def _block(lines, place, rows, width, path):
    """Return rows of so many numbers each, and the line after them."""
    block = [line for line in lines[place : place + rows] if line.strip()]
    if len(block) < rows:
        raise _broken(path, len(block), rows)
    return numbers_of(block, width, str(path), first=place + 1), place + rows


def _numbers(lines, place, rows, width, path):
    """Return as many numbers, however many stand on a line, and the line after them."""
    found: list[float] = []
    while place < len(lines) and len(found) < rows * width:
        try:
            found += [float(word) for word in lines[place].split()]
        except ValueError:
            break
        place += 1
    if len(found) != rows * width or not np.isfinite(found).all():
        raise _broken(path, len(found) // width, rows)
    return np.reshape(found, (rows, width)), place


def _broken(path, there, due):
    return ReadingError(
        f"{path}: the file breaks off: it has {there} of {due} rows; write it again, whole"
    )
