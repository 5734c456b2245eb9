"""Points and lines as VTK XML files of PolyData (.vtp), which ParaView, VisIt and PyVista open."""

import base64
from collections.abc import Mapping
from os import PathLike
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.files.replacing import replacing

_TYPES = {"f8": "Float64", "i8": "Int64", "u1": "UInt8"}


def write_polydata(
    path: str | PathLike[str],
    points: ArrayLike,
    lines: ArrayLike | None = None,
    point_data: Mapping[str, ArrayLike] | None = None,
    cell_data: Mapping[str, ArrayLike] | None = None,
) -> None:
    """Write points, or lines between two points each, with the data of each, as a .vtp file.

    Without lines every point is a cell of its own, which ParaView shows and draws glyphs at.

    Parameters
    ----------
    path : path-like
        Ends in .vtp.
    points : array_like, shape (P, 3)
        [m]
    lines : array_like of int, shape (L, 2), optional
        The two points of each line, from 0.
    point_data : mapping of str to array_like, shape (P,) or (P, 3), optional
        Numbers or yes and no, by name.
    cell_data : mapping of str to array_like, shape (L,) or (L, 3), optional
        Of lines.

    Raises
    ------
    ValueError
        When an array does not have an entry for each point or line.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "pair.vtp"
    ...     write_polydata(file, [[0, 0, 0], [1, 0, 0]], [[0, 1]], cell_data={"force_N": [2.0]})
    ...     print(file.read_text().count("<DataArray"))
    6

    References
    ----------
    VTK file formats, section "XML formats", PolyData.
    """
    points = np.asarray(points, dtype=float).reshape(-1, 3)
    lines = None if lines is None else np.asarray(lines, dtype=np.int64).reshape(-1, 2)
    vertices = np.arange(len(points)).reshape(-1, 1) if lines is None else _NONE
    cells = len(vertices if lines is None else lines)
    head = (
        f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="{len(vertices)}" '
        f'NumberOfLines="{0 if lines is None else cells}" NumberOfStrips="0" NumberOfPolys="0">'
    )
    parts = [
        '<?xml version="1.0"?>',
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
        "<PolyData>",
        head,
        _section("PointData", point_data or {}, len(points)),
        _section("CellData", cell_data or {}, cells),
        f"<Points>{_array('Points', points)}</Points>",
        f"<Verts>{_cells(vertices)}</Verts>",
        f"<Lines>{_cells(_NONE if lines is None else lines)}</Lines>",
        "</Piece>",
        "</PolyData>",
        "</VTKFile>",
        "",
    ]
    with replacing(path) as file:
        file.write("\n".join(parts).encode())


_NONE = np.zeros((0, 2), dtype=np.int64)


def _section(kind: str, data: Mapping[str, ArrayLike], entries: int) -> str:
    arrays = {name: np.asarray(values) for name, values in data.items()}
    wrong = [name for name, values in arrays.items() if len(values) != entries]
    if wrong:
        raise ValueError(f"{', '.join(wrong)} must have {entries} entries, one of each in {kind}")
    return f"<{kind}>{''.join(_array(name, values) for name, values in arrays.items())}</{kind}>"


def _cells(cells: NDArray) -> str:
    """Return the points of cells of one size, one after another, and where each ends."""
    ends = np.arange(1, len(cells) + 1, dtype=np.int64) * cells.shape[1]
    return _array("connectivity", cells.ravel()) + _array("offsets", ends)


def _array(name: str, values: NDArray) -> str:
    """Return an array as the format has it: its bytes behind their number, in base 64."""
    kind = {"b": "u1", "i": "i8", "u": "i8"}.get(values.dtype.kind, "f8")
    data = np.ascontiguousarray(values, dtype=f"<{kind}").tobytes()
    text = base64.b64encode(np.uint64(len(data)).astype("<u8").tobytes() + data).decode()
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    return (
        f'<DataArray type="{_TYPES[kind]}" Name={quoteattr(name)}{components} format="binary">'
        f"{text}</DataArray>"
    )
