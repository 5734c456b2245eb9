"""LAMMPS text dumps, of which LIGGGHTS writes the same: custom and local, any columns."""

from os import PathLike

import numpy as np

from branchcrush.errors import ReadingError
from branchcrush.readers.cells import Cell
from branchcrush.readers.frames import ColumnFrame
from branchcrush.readers.limits import LARGEST_ID
from branchcrush.readers.texts import lines_of, numbers_of, significant_digits


def read_dump(path: str | PathLike[str]) -> list[ColumnFrame]:
    r"""Return the frames of a LAMMPS text dump of style custom or local.

    Items in any order and more than are needed (UNITS, TIME), any columns, orthogonal, triclinic
    and general triclinic boxes, scaled, unscaled and unwrapped coordinates.

    Parameters
    ----------
    path : path-like
        Plain, .gz, .zst or .bz2.

    Returns
    -------
    list of ColumnFrame
        With columns x, y and z [m] of whatever coordinates it has.

    Raises
    ------
    ReadingError
        When it is no such dump, or breaks off.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> text = '''ITEM: TIMESTEP
    ... 5
    ... ITEM: NUMBER OF ATOMS
    ... 1
    ... ITEM: BOX BOUNDS pp pp pp
    ... 0 2
    ... 0 2
    ... 0 2
    ... ITEM: ATOMS id radius xs ys zs
    ... 7 0.5 0.25 0.5 0.75
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "grains.dump")
    ...     _ = path.write_text(text)
    ...     frame = read_dump(path)[0]
    >>> frame.step, frame.columns["x"].tolist(), frame.cell.periodic
    (5.0, [0.5], (True, True, True))
    """
    lines = lines_of(path)
    if not lines[0].startswith("ITEM:"):
        raise ReadingError(
            f"{path}: is no LAMMPS text dump: its first line is {lines[0][:60]!r}, where "
            "'ITEM: TIMESTEP' is due; write it by dump custom or dump local, not in binary form"
        )
    frames, place = [], 0
    while place < len(lines):
        frame, place = _frame(lines, place, f"{path}")
        frames.append(frame)
    return frames


def _frame(lines, place, path):
    """Return the frame that begins at a line, and the line after it."""
    items, begun = {}, place
    while True:
        if place >= len(lines):
            raise _broken(path, begun)
        head = lines[place].split()
        if head[:1] != ["ITEM:"] or len(head) < 2:
            raise ReadingError(
                f"{path}, line {place + 1}: 'ITEM: ...' is due, and there is "
                f"{lines[place][:60]!r}: is the number of rows above it right?"
            )
        if "NUMBER" not in items and head[1] in ("ATOMS", "ENTRIES"):
            raise ReadingError(f"{path}, line {place + 1}: the number of rows is not told before")
        if head[1] in ("ATOMS", "ENTRIES"):
            break
        size = 3 if head[1] == "BOX" else 1
        values = lines[place + 1 : place + 1 + size]
        if len(values) < size or any(value.startswith("ITEM:") for value in values):
            raise _broken(path, begun)
        items[head[1]] = (head[2:], values)
        place += 1 + size
    step = _number(items.get("TIMESTEP"), path, begun)
    rows, names = _number(items["NUMBER"], path, begun), head[2:]
    if not 0 <= rows <= len(lines):
        raise _broken(path, begun)
    first, place = place + 1, place + 1 + int(rows)
    where = f"{path}, step {step:.0f}" if step is not None else path
    block = lines[first:place]
    if len(block) < rows or any(line.startswith("ITEM:") for line in block):
        whole = next((n for n, line in enumerate(block) if line.startswith("ITEM:")), len(block))
        raise ReadingError(
            f"{where}: the file breaks off: it has {whole} of {int(rows)} rows; write it again, "
            "whole"
        )
    values = numbers_of(block, len(names), str(path), first=first + 1)
    columns = dict(zip(names, values.T, strict=True))
    cell, told = _cell(items["BOX"], where) if "BOX" in items else (None, False)
    return ColumnFrame(
        where, _placed(columns, cell, where), step, cell, told, significant_digits(block)
    ), place


def _broken(path, line):
    return ReadingError(
        f"{path}: the file breaks off within the frame that begins at line {line + 1}; write it "
        "again, whole"
    )


def _number(item, path, line):
    """Return the number of an item of one line, or None where there is no such item."""
    if item is None:
        return None
    try:
        number = float(item[1][0])
    except ValueError:
        number = np.nan
    if number != np.floor(number) or abs(number) > LARGEST_ID:
        raise ReadingError(
            f"{path}, frame at line {line + 1}: {item[1][0][:40]!r} is no whole number"
        )
    return number


def _cell(item, where):
    """Return the cell that BOX BOUNDS tells, and whether it tells which faces are periodic."""
    words, lines = item
    faces = [word for word in words if len(word) == 2 and set(word) <= set("pfsm")]
    periodic = tuple(face == "pp" for face in faces) if len(faces) == 3 else (False,) * 3
    told = len(faces) == 3
    try:
        bounds = np.array([[float(word) for word in line.split()] for line in lines])
        if words[:2] == ["abc", "origin"]:
            return Cell(bounds[:, 3], bounds[:, :3], periodic), told
        if bounds.shape[1] == 2:
            return Cell.between(bounds[:, 0], bounds[:, 1], periodic), told
        xy, xz, yz = bounds[:, 2]
    except (ValueError, IndexError):
        raise ReadingError(f"{where}: its BOX BOUNDS are no three lines of numbers") from None
    # LAMMPS writes the box around the tilted one.
    low = bounds[:, 0] - [min(0.0, xy, xz, xy + xz), min(0.0, yz), 0.0]
    high = bounds[:, 1] - [max(0.0, xy, xz, xy + xz), max(0.0, yz), 0.0]
    return Cell.between(low, high, periodic, (xy, xz, yz)), told


def _placed(columns, cell, where):
    """Return columns with x, y and z, of whatever coordinates there are."""
    if {"x", "y", "z"} <= set(columns):
        return columns
    for suffix in ("u", "s", "su"):
        names = [axis + suffix for axis in "xyz"]
        if not set(names) <= set(columns):
            continue
        places = np.column_stack([columns[name] for name in names])
        if suffix != "u":
            if cell is None:
                raise ReadingError(f"{where}: scaled coordinates, and no BOX BOUNDS to scale by")
            with np.errstate(all="ignore"):  # what is no number then is refused as such
                places = cell.origin + places @ cell.vectors
        return columns | dict(zip("xyz", places.T, strict=True))
    return columns
