"""Files in and out: tables, fits and packings, each with where it came from."""

import csv
import io
import json
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from branchcrush import __version__
from branchcrush.files.encoding import arrow_array, cells, json_line, json_page
from branchcrush.files.replacing import replacing

# pandas is imported where it is needed: the jobs of the seeds write tables without it, and start in
# half the time.
if TYPE_CHECKING:
    import pandas as pd

# What `read_table` returns, for hints in rooms that do not import pandas.
Table: TypeAlias = "pd.DataFrame"


def provenance(**origin: Any) -> dict[str, Any]:
    """Return what made a result: the version and, by name, sample, seed and config sections.

    Parameters
    ----------
    **origin
        What else is known, as plain values.

    Returns
    -------
    dict
        For `write_table`, `write_json` and `write_packing`.

    Examples
    --------
    >>> sorted(provenance(sample="paper", seed=1))
    ['branchcrush', 'sample', 'seed']
    """
    return {"branchcrush": __version__, **origin}


def study_provenance(samples: Mapping[str, Mapping], **origin: Any) -> dict[str, Any]:
    """Return what made a result of all samples: the version and the settings of every one.

    Parameters
    ----------
    samples : mapping
        By name of the sample its settings, from `config.schema.Sample.settings`: the seeds are
        among them.
    **origin
        What else is known, as plain values: sections of the configuration for all samples.

    Returns
    -------
    dict
        As `provenance`, with all samples under "samples".

    Examples
    --------
    >>> origin = study_provenance({"sand": {"grains": 10, "seeds": [1, 2]}}, bins=20)
    >>> origin["samples"]["sand"]["seeds"], origin["bins"]
    ([1, 2], 20)
    """
    return provenance(samples={name: dict(sample) for name, sample in samples.items()}, **origin)


def write_table(
    path: str | PathLike[str],
    table: "Table | Mapping[str, ArrayLike] | Sequence[Mapping[str, Any]]",
    origin: Mapping[str, Any],
) -> None:
    """Write a table as CSV, its provenance in a first comment line, or as Parquet.

    A number has all its digits; in CSV one that is not known is an empty cell.

    Parameters
    ----------
    path : path-like
        Ends in .csv or .parquet.
    table : DataFrame, dict of columns, or sequence of dict, one a row
        A row may lack columns that another has.
    origin : dict
        From `provenance`.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_table(f"{folder}/sand.csv", {"state": [0, 1]}, {"seed": 3})
    ...     print(Path(folder, "sand.csv").read_text(), end="")
    # {"seed": 3}
    state
    0
    1
    """
    if Path(path).suffix == ".parquet":
        import pyarrow as pa
        import pyarrow.parquet as pq

        arrow = pa.table({name: arrow_array(column) for name, column in _columns(table).items()})
        metadata = {b"provenance": json_line(origin).encode()}
        with replacing(path) as file:
            pq.write_table(arrow.replace_schema_metadata(metadata), file, compression="zstd")
    else:
        columns = _columns(table)
        text = io.StringIO(f"# {json_line(origin)}\n")
        text.seek(0, io.SEEK_END)
        lines = csv.writer(text, lineterminator="\n")
        lines.writerow(columns)
        lines.writerows(zip(*map(cells, columns.values()), strict=True))
        write_text(path, text.getvalue())


def _columns(table):
    """Return the columns of a table by name."""
    if isinstance(table, list | tuple):
        names = dict.fromkeys(name for row in table for name in row)
        return {name: [row.get(name) for row in table] for name in names}
    return dict(table.items())


def read_table(
    path: str | PathLike[str],
    columns: Sequence[str] | None = None,
    states: Sequence[int] | None = None,
) -> Table:
    """Return a table that `write_table` wrote.

    Parameters
    ----------
    path : path-like
    columns : sequence of str, optional
        Read these alone: contacts are many.
    states : sequence of int, optional
        Keep the rows of these alone, by their column state. Of a Parquet file only these are read:
        where few of many are wanted, it takes half the time and half the memory.

    Returns
    -------
    DataFrame
    """
    import pandas as pd

    chosen = None if columns is None else list(columns)
    rows = None if states is None else [("state", "in", list(states))]
    if Path(path).suffix == ".parquet":
        # Column by column, each freed as soon as it is converted: half the memory.
        lean = {"split_blocks": True, "self_destruct": True}
        return pd.read_parquet(path, columns=chosen, filters=rows, to_pandas_kwargs=lean)
    table = pd.read_csv(path, comment="#", usecols=chosen)
    return table if states is None else table[table["state"].isin(states)].reset_index(drop=True)


def stacked_tables(tables: Mapping[str, Table]) -> Table:
    """Return the tables of all samples one below the other, with the sample of each row.

    Parameters
    ----------
    tables : mapping
        By name of the sample.

    Returns
    -------
    DataFrame
        The columns of each table and, as its last, sample. A table that lacks a column of another
        is empty there.

    Examples
    --------
    >>> import pandas as pd
    >>> sand, powder = pd.DataFrame({"state": [0, 1]}), pd.DataFrame({"state": [0]})
    >>> stacked_tables({"sand": sand, "powder": powder}).to_dict("list")
    {'state': [0, 1, 0], 'sample': ['sand', 'sand', 'powder']}
    """
    import pandas as pd

    named = [table.assign(sample=name) for name, table in tables.items()]
    return pd.concat(named, ignore_index=True)


def write_json(
    path: str | PathLike[str], result: Mapping[str, Any], origin: Mapping[str, Any]
) -> None:
    """Write a fit or other small result as JSON; a number that is not finite becomes null.

    Parameters
    ----------
    path : path-like
    result : dict
        Of plain values, NumPy's numbers and arrays; keys keep their order.
    origin : dict
        From `provenance`, the last key of the file.

    Raises
    ------
    TypeError
        When JSON has no such value.
    """
    write_text(path, json_page({**result, "provenance": origin}))


def read_json(path: str | PathLike[str]) -> dict[str, Any]:
    """Return what `write_json` wrote, its provenance included; a number not known is None.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    dict
    """
    return json.loads(Path(path).read_text(encoding="utf-8"))


def write_text(path: str | PathLike[str], text: str) -> None:
    """Write a page or other text as it is, in UTF-8.

    Parameters
    ----------
    path : path-like
    text : str
    """
    with replacing(path) as file:
        file.write(text.encode())


def no_data(error: Exception) -> tuple[dict[str, list[str]], dict[str, str]]:
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


def write_packing(
    path: str | PathLike[str],
    positions: ArrayLike,
    radii: ArrayLike,
    edge: float,
    origin: Mapping[str, Any],
) -> None:
    """Write a packing as npz: positions (N, 3) about the centre, radii (N,), box (3,), meta.

    Parameters
    ----------
    path : path-like
    positions : array_like, shape (N, 3)
        Centres, origin at the centre of the cube [m].
    radii : array_like, shape (N,)
        [m]
    edge : float
        Of the cube [m].
    origin : dict
        From `provenance`; becomes meta, as JSON.
    """
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        positions=positions,
        radii=radii,
        box=np.full(3, float(edge)),
        meta=np.array(json_line({**origin, "units": "m", "origin": "centre of the box"})),
    )
    with replacing(path) as file:
        file.write(buffer.getvalue())


def read_packing(path: str | PathLike[str]) -> tuple[np.ndarray, np.ndarray, float]:
    """Return positions, radii and edge of a packing that `write_packing` wrote.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    positions : ndarray, shape (N, 3)
        Centres, origin at the centre of the cube [m].
    radii : ndarray, shape (N,)
        [m]
    edge : float
        Of the cube [m].
    """
    with np.load(path) as file:
        return file["positions"], file["radii"], float(file["box"][0])
