"""MercuryDPM's .data and .fstat files: grains, and contacts of which each pair stands twice."""

from os import PathLike

import numpy as np

from branchcrush.errors import ReadingError
from branchcrush.readers.cells import Cell
from branchcrush.readers.frames import ColumnFrame
from branchcrush.readers.texts import lines_of, numbers_of, significant_digits

_DATA_COLUMNS, _FSTAT_COLUMNS = 14, 16


def read_data(path: str | PathLike[str]) -> list[ColumnFrame]:
    r"""Return the frames of a .data file of three dimensions.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    list of ColumnFrame
        id counts lines from 0; x, y, z and radius [m]; step is the time [s].

    Raises
    ------
    ReadingError
        When it is no such file, or breaks off.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "packing.data")
    ...     _ = path.write_text("1 0.5 0 0 0 2 2 2\n1 1 1 0 0 0 0.5 0 0 0 0 0 0 0\n")
    ...     frame = read_data(path)[0]
    >>> frame.step, frame.columns["radius"].tolist(), frame.cell.volume
    (0.5, [0.5], 8.0)
    """
    lines, frames, place = lines_of(path), [], 0
    while place < len(lines):
        words = lines[place].split()
        try:
            rows, time, *bounds = (float(word) for word in words)
        except ValueError:
            rows, time, bounds = -1.0, 0.0, []
        whole = 0 <= rows <= len(lines) and rows == int(rows)
        if len(bounds) != 6 or not whole or not np.isfinite(time):
            raise ReadingError(
                f"{path}, line {place + 1}: 'N time xmin ymin zmin xmax ymax zmax' is due, and "
                f"there is {lines[place][:60]!r}: write it in three dimensions, by "
                "setParticleDimensions(3), and with the number of rows that it tells"
            )
        first, end = place + 1, place + 1 + int(rows)
        block = lines[first:end]
        if len(block) < rows:
            raise ReadingError(
                f"{path}, time {time:g}: the file breaks off: it has {len(block)} of {int(rows)} "
                "rows; write it again, whole"
            )
        values = numbers_of(block, _DATA_COLUMNS, str(path), first=first + 1)
        columns = dict(zip("xyz", values.T[:3], strict=True))
        columns |= {"id": np.arange(int(rows)), "radius": values.T[6]}
        cell = Cell.between(bounds[:3], bounds[3:], (False,) * 3)
        digits = significant_digits(block)
        frames.append(ColumnFrame(f"{path}, time {time:g}", columns, time, cell, digits=digits))
        place = end
    return frames


def read_fstat(path: str | PathLike[str]) -> list[ColumnFrame]:
    r"""Return the frames of an .fstat file, each pair twice, a wall by its negative number once.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    list of ColumnFrame
        id1, id2; point (n, 3), overlap [m], normal_force [N], force (n, 3) with the tangential
        part; step is the time [s].

    Raises
    ------
    ReadingError
        When it is no such file, or breaks off within a line.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> line = "0.5 3 7 0 0 0 1e-3 0 2 0 1 0 0 0 0 0"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "packing.fstat")
    ...     _ = path.write_text("# 0.5 1\n# 0 0 0 1 1 1\n# 1 1 0 0 0 0\n" + line + "\n")
    ...     frame = read_fstat(path)[0]
    >>> frame.columns["id2"].tolist(), frame.columns["force"].tolist()
    ([7.0], [[2.0, 0.0, 0.0]])
    """
    lines, frames, place = lines_of(path), [], 0
    if not lines[0].startswith("#"):
        raise ReadingError(
            f"{path}: is no .fstat of MercuryDPM: its first line is {lines[0][:60]!r}, where "
            "'# time info' is due"
        )
    while place < len(lines):
        head = lines[place].removeprefix("#").split()
        # Three lines begin a frame, and only the next three end it.
        first = place + 3
        end = next((n for n in range(first, len(lines)) if lines[n].startswith("#")), len(lines))
        try:
            time = float(head[0])
        except (ValueError, IndexError):
            time = np.nan
        if not np.isfinite(time):
            raise ReadingError(
                f"{path}, line {place + 1}: '# time info' is due, and there is "
                f"{lines[place][:60]!r}"
            )
        if not all(line.startswith("#") for line in lines[place:first]) or first > len(lines):
            raise ReadingError(f"{path}, line {place + 1}: three lines with # begin a frame")
        block = lines[first:end]
        values = numbers_of(block, _FSTAT_COLUMNS, str(path), first=first + 1).T
        normal, tangent = values[10:13].T, values[13:16].T
        with np.errstate(all="ignore"):  # what is no number then is refused as such
            force = normal * values[8][:, None] + tangent * values[9][:, None]
        columns = {
            "id1": values[1],
            "id2": values[2],
            "point": values[3:6].T,
            "overlap": values[6],
            "normal_force": values[8],
            "force": force,
        }
        where = f"{path}, time {time:g}"
        frames.append(ColumnFrame(where, columns, time, digits=significant_digits(block)))
        place = end
    return frames
