"""Files in and out: tables, fits and packings, each with where it came from."""

import contextlib
import csv
import io
import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from branchcrush import __version__

# pandas is imported where it is needed: the jobs of the seeds write tables without it, and start in
# half the time.
if TYPE_CHECKING:
    import pandas as pd

# What `read_table` returns, for hints in rooms that do not import pandas.
Table: TypeAlias = "pd.DataFrame"


def provenance(**origin):
    """Return what made a result: the version and, by name, sample, seed and config sections.

    Examples
    --------
    >>> sorted(provenance(sample="paper", seed=1))
    ['branchcrush', 'sample', 'seed']
    """
    return {"branchcrush": __version__, **origin}


def write_table(path, table, origin):
    """Write a table as CSV, its provenance in a first comment line, or as Parquet.

    Parameters
    ----------
    path : path-like
        Ends in .csv or .parquet.
    table : DataFrame, dict of columns, or sequence of dict, one a row
    origin : dict
        From `provenance`.
    """
    if Path(path).suffix == ".parquet":
        import pyarrow as pa
        import pyarrow.parquet as pq

        arrow = pa.table({name: _arrow(column) for name, column in _columns(table).items()})
        metadata = {b"provenance": _json(origin).encode()}
        with _replacing(path) as file:
            pq.write_table(arrow.replace_schema_metadata(metadata), file, compression="zstd")
    else:
        columns = _columns(table)
        text = io.StringIO(f"# {_json(origin)}\n")
        text.seek(0, io.SEEK_END)
        lines = csv.writer(text, lineterminator="\n")
        lines.writerow(columns)
        lines.writerows(zip(*map(_cells, columns.values()), strict=True))
        _write(path, text.getvalue().encode())


def _columns(table):
    if isinstance(table, list | tuple):
        names = dict.fromkeys(name for row in table for name in row)
        return {name: [row.get(name) for row in table] for name in names}
    return dict(table.items())


def _arrow(column):
    """Return a column as Arrow's array, which is made of buffers: `pa.array` imports pandas."""
    import pyarrow as pa

    column = np.asarray(column)
    if column.dtype.kind in "if":
        kind, buffers = pa.from_numpy_dtype(column.dtype), [np.ascontiguousarray(column)]
    elif column.dtype.kind == "U":
        texts = [text.encode() for text in column.tolist()]
        ends = np.cumsum([0, *map(len, texts)], dtype=np.int64)
        kind, buffers = pa.large_string(), [ends, b"".join(texts)]
    else:
        return pa.array(column)
    return pa.Array.from_buffers(kind, len(column), [None, *map(pa.py_buffer, buffers)])


def _cells(column):
    """Return a column as Python's own values, which print with all digits, None if not known."""
    values = (value.item() if isinstance(value, np.generic) else value for value in column)
    return [None if value != value else value for value in values]


def read_table(path, columns=None):
    """Return a table that `write_table` wrote.

    Parameters
    ----------
    path : path-like
    columns : sequence of str, optional
        Read these alone: contacts are many.

    Returns
    -------
    DataFrame
    """
    import pandas as pd

    chosen = None if columns is None else list(columns)
    if Path(path).suffix == ".parquet":
        # Column by column, each freed as soon as it is converted: half the memory.
        lean = {"split_blocks": True, "self_destruct": True}
        return pd.read_parquet(path, columns=chosen, to_pandas_kwargs=lean)
    return pd.read_csv(path, comment="#", usecols=chosen)


def write_json(path, result, origin):
    """Write a fit or other small result as JSON; a number that is not finite becomes null."""
    text = _json({**result, "provenance": origin}, indent=2)
    _write(path, (text + "\n").encode())


def read_json(path):
    """Return what `write_json` wrote."""
    return json.loads(Path(path).read_text(encoding="utf-8"))


def write_text(path, text):
    """Write a page or other text as it is."""
    _write(path, text.encode())


def no_data(error):
    """Return an empty result as table and as JSON: each says only why.

    Parameters
    ----------
    error : Exception

    Returns
    -------
    table : dict
        One row with a column `reason`.
    result : dict

    Examples
    --------
    >>> no_data(ValueError("no load"))
    ({'reason': ['no load']}, {'reason': 'no load'})
    """
    return {"reason": [str(error)]}, {"reason": str(error)}


def write_packing(path, positions, radii, edge, origin):
    """Write a packing as npz: positions (N, 3) about the centre, radii (N,), box (3,), meta.

    All in metres; meta is JSON.
    """
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        positions=positions,
        radii=radii,
        box=np.full(3, float(edge)),
        meta=np.array(_json({**origin, "units": "m", "origin": "centre of the box"})),
    )
    _write(path, buffer.getvalue())


def read_packing(path):
    """Return positions, radii and edge of a packing that `write_packing` wrote [m]."""
    with np.load(path) as file:
        return file["positions"], file["radii"], float(file["box"][0])


def _json(value, indent=None):
    return json.dumps(_plain(value), indent=indent, sort_keys=indent is None, allow_nan=False)


def _plain(value):
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _write(path, content):
    with _replacing(path) as file:
        file.write(content)


@contextlib.contextmanager
def _replacing(path):
    """Open a file that takes the place of another when it is complete."""
    # Written beside and renamed, so that a killed job leaves no half file.
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with beside.open("wb") as file:
            yield file
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)
