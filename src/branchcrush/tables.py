"""Files in and out: tables, fits and packings, each with where it came from."""

import contextlib
import io
import json
import math
import os
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

from branchcrush import __version__


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
    table : DataFrame or mapping of columns
    origin : dict
        From `provenance`.
    """
    table = pd.DataFrame(table)
    if Path(path).suffix == ".parquet":
        arrow = pa.Table.from_pandas(table, preserve_index=False)
        metadata = {**(arrow.schema.metadata or {}), b"provenance": _json(origin).encode()}
        with _replacing(path) as file:
            pq.write_table(arrow.replace_schema_metadata(metadata), file, compression="zstd")
    else:
        text = f"# {_json(origin)}\n" + table.to_csv(index=False, lineterminator="\n")
        _write(path, text.encode())


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
