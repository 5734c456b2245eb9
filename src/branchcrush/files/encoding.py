"""How values are written to files: as JSON, as cells of CSV, as arrays of Arrow."""

import json
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

# Arrow is imported where it is needed: most jobs write no Parquet.
if TYPE_CHECKING:
    import pyarrow as pa


def json_line(value: Any) -> str:
    """Return a value as JSON on one line, its keys sorted.

    Parameters
    ----------
    value : object
        Of plain values, NumPy's numbers and arrays.

    Returns
    -------
    str
        With null for a number that is not finite.

    Raises
    ------
    TypeError
        When JSON has no such value.

    Examples
    --------
    >>> json_line({"seed": np.int64(3), "each": np.array([0.5, np.nan])})
    '{"each": [0.5, null], "seed": 3}'
    """
    return json.dumps(_plain(value), sort_keys=True, allow_nan=False)


def json_page(value: Any) -> str:
    r"""Return a value as JSON over many lines, its keys in their order.

    Parameters
    ----------
    value : object
        As for `json_line`.

    Returns
    -------
    str

    Raises
    ------
    TypeError
        When JSON has no such value.

    Examples
    --------
    >>> json_page({"b": 1, "a": (2,)})
    '{\n  "b": 1,\n  "a": [\n    2\n  ]\n}\n'
    """
    return json.dumps(_plain(value), indent=2, allow_nan=False) + "\n"


def cells(column: Iterable) -> list:
    """Return a column as Python's own values, which print with all digits, None if not known.

    Parameters
    ----------
    column : iterable

    Returns
    -------
    list

    Examples
    --------
    >>> cells(np.array([0.1, np.nan]))
    [0.1, None]
    """
    values = (value.item() if isinstance(value, np.generic) else value for value in column)
    return [None if value != value else value for value in values]


def arrow_array(column: ArrayLike) -> "pa.Array":
    """Return a column as Arrow's array, which is made of buffers: `pa.array` imports pandas.

    Parameters
    ----------
    column : array_like, shape (n,)
        Numbers, words or truth values.

    Returns
    -------
    pyarrow.Array

    Examples
    --------
    >>> arrow_array(["-x", "+z"]).to_pylist()
    ['-x', '+z']
    """
    import pyarrow as pa

    column = np.asarray(column)
    if column.dtype.kind in "if":
        kind, buffers = pa.from_numpy_dtype(column.dtype), [np.ascontiguousarray(column)]
    elif column.dtype.kind == "U":
        words = [word.encode() for word in column.tolist()]
        ends = np.cumsum([0, *map(len, words)], dtype=np.int64)
        kind, buffers = pa.large_string(), [ends, b"".join(words)]
    else:
        return pa.array(column)
    return pa.Array.from_buffers(kind, len(column), [None, *map(pa.py_buffer, buffers)])


def _plain(value):
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value
