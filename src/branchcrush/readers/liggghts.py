"""LIGGGHTS's compute pair/gran/local and wall/gran/local: what its columns are, which it hides."""

from collections.abc import Sequence

import numpy as np

from branchcrush.errors import ReadingError
from branchcrush.readers.frames import ColumnFrame

# The order of the columns, whatever the order of the keywords; history takes what is left.
_COLUMNS = {
    "pos": 6,
    "vel": 6,
    "id": 3,
    "force": 3,
    "force_normal": 3,
    "force_tangential": 3,
    "torque": 3,
    "torque_normal": 3,
    "torque_tangential": 3,
    "history": None,
    "contactArea": 1,
    "delta": 1,
    "contactPoint": 3,
    "ms_id": 2,
    "heatFlux": 1,
}
KEYWORDS = tuple(_COLUMNS)
DEFAULT = ("pos", "vel", "id", "force", "torque", "history", "contactArea")


def named_columns(frame: ColumnFrame, keywords: Sequence[str] = DEFAULT) -> ColumnFrame:
    """Return a frame of compute pair/gran/local with its columns named.

    Parameters
    ----------
    frame : ColumnFrame
        From `dumps.read_dump`: its names, such as c_fc[3], say nothing.
    keywords : sequence of str
        Those of the compute, in any order; by default those that it takes without any.

    Returns
    -------
    ColumnFrame
        id1, id2, through_boundary; start, end, force, force_normal, point, each (n, 3); overlap;
        of what there is.

    Raises
    ------
    ReadingError
        When the keywords make another number of columns.

    Examples
    --------
    >>> columns = {f"c_fc[{k}]": np.array([float(k)]) for k in range(1, 8)}
    >>> named = named_columns(ColumnFrame("fc", columns), ["force", "id", "delta"])
    >>> [named.columns[name].tolist() for name in ("id1", "force", "overlap")]
    [[1.0], [[4.0, 5.0, 6.0]], [7.0]]
    """
    given = [keyword for keyword in KEYWORDS if keyword in keywords]
    known = sum(_COLUMNS[keyword] or 0 for keyword in given)
    values = list(frame.columns.values())
    rest = len(values) - known
    if rest < 0 or (rest > 0 and "history" not in given):
        due = f"{known}{' or more' if 'history' in given else ''}"
        raise ReadingError(
            f"{frame.where}: it has {len(values)} columns, and the keywords {', '.join(given)} of "
            f"compute pair/gran/local make {due}: give packing.keywords as they stand in that "
            "compute"
        )
    parts, place = {}, 0
    for keyword in given:
        width = rest if _COLUMNS[keyword] is None else _COLUMNS[keyword]
        parts[keyword] = values[place : place + width]
        place += width
    named = {}
    if "pos" in parts:
        named["start"] = np.column_stack(parts["pos"][:3])
        named["end"] = np.column_stack(parts["pos"][3:])
    if "id" in parts:
        named |= dict(zip(("id1", "id2", "through_boundary"), parts["id"], strict=True))
    for keyword, name in (("force", "force"), ("force_normal", "force_normal")):
        if keyword in parts:
            named[name] = np.column_stack(parts[keyword])
    if "delta" in parts:
        named["overlap"] = parts["delta"][0]
    if "contactPoint" in parts:
        named["point"] = np.column_stack(parts["contactPoint"])
    return ColumnFrame(
        frame.where, named, frame.step, frame.cell, frame.boundary_told, frame.digits
    )
