"""LAMMPS data and dump files: written for, and read back from, `lammps_inputs/in.compress`."""

import gzip
import io
import mmap
import shutil
from collections.abc import Iterator
from itertools import islice
from os import PathLike

import numpy as np
import pyarrow as pa
from numpy.typing import ArrayLike
from pyarrow import csv

from branchcrush.files.replacing import replacing

_ROWS_AT_ONCE = 10_000
_HEADER_LINES = 9
_BUFFER = 2**20  # [bytes]


def write_data_file(
    path: str | PathLike[str],
    positions: ArrayLike,
    radii: ArrayLike,
    edge: float,
    numbers: ArrayLike | None = None,
) -> None:
    """Write a packing as a LAMMPS data file of atom style sphere; ids count from 1.

    Parameters
    ----------
    path : path-like
    positions : array_like, shape (N, 3)
        Centres, origin at the centre of the cube [m].
    radii : array_like, shape (N,)
        [m]
    edge : float
        Edge of the cube [m].
    numbers : array_like of int, shape (N,), optional
        Of the grains, from 0; without, they are numbered in their order.

    Raises
    ------
    ValueError
        When there are not as many radii as positions.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "packing.data")
    ...     write_data_file(path, [[0.0, 0.1, -0.2]], [0.5], 2.0)
    ...     print(path.read_text().splitlines()[-1])
    1 1 1.0 1.0 0.0 0.1 -0.2
    """
    diameters, positions = 2.0 * np.asarray(radii, float), np.asarray(positions, float)
    if len(diameters) != len(positions):
        raise ValueError(
            f"one is shorter than the other: {len(diameters)} radii, {len(positions)} positions"
        )
    ids = np.arange(len(diameters)) if numbers is None else np.asarray(numbers)
    half = float(edge) / 2.0
    lines = ["branchcrush packing, SI units", "", f"{len(diameters)} atoms", "1 atom types", ""]
    lines += [f"{-half!r} {half!r} {axis}lo {axis}hi" for axis in "xyz"]
    # The density only fills its column: the grain mass is set by mod.contact.
    lines += ["", "Atoms # sphere  (id type diameter density x y z)", ""]
    # A packing that breaks off would be read as a smaller one.
    with replacing(path) as binary, io.TextIOWrapper(binary, encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")
        # Python's own floats print in a fraction of the time that NumPy's take; all of a large
        # packing at once would fill the memory.
        for start in range(0, len(diameters), _ROWS_AT_ONCE):
            part = slice(start, start + _ROWS_AT_ONCE)
            columns = (ids[part] + 1, diameters[part], positions[part])
            rows = zip(*(column.tolist() for column in columns), strict=True)
            file.writelines(
                f"{n} 1 {diameter!r} 1.0 {x!r} {y!r} {z!r}\n" for n, diameter, (x, y, z) in rows
            )


def read_dump(path: str | PathLike[str]) -> Iterator[dict[str, np.ndarray]]:
    """Yield the frames of a LAMMPS text dump of atoms or of local data, reading one at a time.

    Parameters
    ----------
    path : path-like
        Plain or gzipped.

    Yields
    ------
    dict of ndarray
        Columns as named in the dump; numbers as floats, each the one nearest to its text.

    Raises
    ------
    ValueError
        When the dump breaks off, or a line is not made of one number a column.
    OSError
        When the dump cannot be read or gunzipped.
    """
    # Arrow gunzips what is named .gz, somewhat faster than Python; a BufferedReader iterates lines.
    with io.BufferedReader(pa.input_stream(path), _BUFFER) as file:
        while file.peek(1):
            header = _lines(file, _HEADER_LINES).decode("ascii").splitlines()
            # "ITEM: NUMBER OF ..." and below it the number; "ITEM: ATOMS id type ...".
            yield _frame(file, int(header[3]), header[8].split()[2:])


def last_frame(path: str | PathLike[str]) -> int:
    r"""Return where the last frame of a plain LAMMPS dump begins.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    int
        Counted from the start of the file [bytes].

    Raises
    ------
    ValueError
        When there is no frame in it.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "pairs.dump")
    ...     _ = path.write_text("ITEM: TIMESTEP\n0\nITEM: TIMESTEP\n7\n")
    ...     last_frame(path)
    17
    """
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as text:
        start = text.rfind(b"ITEM: TIMESTEP")
    if start < 0:
        raise ValueError("the dump holds no frame")
    return start


def compress_file(source: str | PathLike[str], target: str | PathLike[str], start: int = 0) -> None:
    """Write a file gzipped, as one stream, the same bytes whenever it is done.

    Parameters
    ----------
    source, target : path-like
    start : int
        What lies before is left out [bytes].

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "pairs.dump")
    ...     _ = path.write_text("ITEM: TIMESTEP")
    ...     compress_file(path, f"{path}.gz")
    ...     print(gzip.decompress(pathlib.Path(f"{path}.gz").read_bytes()).decode())
    ITEM: TIMESTEP
    """
    # Text of LAMMPS hardly becomes smaller by a higher level, which takes several times as long.
    with (
        open(source, "rb") as plain,
        open(target, "wb") as file,
        gzip.GzipFile("", "wb", compresslevel=1, fileobj=file, mtime=0) as packed,
    ):
        plain.seek(start)
        shutil.copyfileobj(plain, packed, _BUFFER)


def _frame(file, rows, columns):
    """Return the values of each column in the next rows of a dump."""
    values = np.empty((len(columns), rows))
    parse = csv.ParseOptions(delimiter=" ", quote_char=False, ignore_empty_lines=False)
    convert = csv.ConvertOptions(
        column_types=dict.fromkeys(columns, pa.float64()), null_values=[], include_columns=columns
    )
    for start in range(0, rows, _ROWS_AT_ONCE):
        part = slice(start, min(start + _ROWS_AT_ONCE, rows))
        text = _lines(file, part.stop - part.start)
        # LAMMPS ends the lines of local data with a space: to Arrow one more column, not read.
        names = [*columns, ""] if text.endswith(b" \n") else columns
        read = csv.ReadOptions(column_names=names, block_size=len(text), use_threads=False)
        table = csv.read_csv(pa.py_buffer(text), read, parse, convert)
        for row, column in zip(values, table.itercolumns(), strict=True):
            # Arrow's own `to_numpy` would import pandas, which takes half a second.
            row[part] = np.concatenate([np.from_dlpack(chunk) for chunk in column.chunks])
    return dict(zip(columns, values, strict=True))


def _lines(file, number):
    """Return the next lines of a dump, all of them whole."""
    lines = list(islice(file, number))
    if len(lines) < number or not lines[-1].endswith(b"\n"):
        raise ValueError("the dump breaks off within a frame")
    return b"".join(lines)
