"""What made a result, read from the file itself."""

import json
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np


def read_provenance(path: str | PathLike[str]) -> dict[str, Any]:
    """Return what made a result that `files.tables` wrote, and read nothing else of a table.

    Parameters
    ----------
    path : path-like
        A table, JSON, or a packing.

    Returns
    -------
    dict
        From `files.tables.provenance`; empty where the file does not say.

    Examples
    --------
    >>> import tempfile
    >>> from branchcrush.files.tables import write_table
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_table(f"{folder}/sand.parquet", {"state": [0, 1]}, {"seed": 3})
    ...     read_provenance(f"{folder}/sand.parquet")
    {'seed': 3}
    """
    path = Path(path)
    if path.suffix == ".parquet":
        import pyarrow.parquet as pq

        return json.loads((pq.read_schema(path).metadata or {}).get(b"provenance", b"{}"))
    if path.suffix == ".npz":
        with np.load(path) as file:
            return json.loads(str(file["meta"])) if "meta" in file else {}
    with path.open(encoding="utf-8") as file:
        if path.suffix == ".json":
            return json.load(file).get("provenance", {})
        line = file.readline()
    return json.loads(line.removeprefix("#")) if line.startswith("# {") else {}
