"""Files of every format: they say where they came from, are the same bytes, and never half."""

import json
import resource
import time
import zipfile

import numpy as np
import pyarrow.parquet as pq
import pytest

from branchcrush.files.tables import (
    provenance,
    read_json,
    write_json,
    write_packing,
    write_table,
)

ORIGIN = provenance(sample="paper", seed=3, config={"grains": 1000, "seeds": [1, 2]})
TABLE = {"state": np.arange(3), "force_N": [0.1, 1 / 3, np.nan], "wall": ["-x", "+x", "-y"]}
POSITIONS, RADII = np.random.default_rng(0).uniform(-1, 1, (2, 3)), np.array([1 / 3, 1e-5])

WRITERS = {
    "table.csv": lambda path: write_table(path, TABLE, ORIGIN),
    "table.parquet": lambda path: write_table(path, TABLE, ORIGIN),
    "fit.json": lambda path: write_json(path, {"exponent": 3.0}, ORIGIN),
    "packing.npz": lambda path: write_packing(path, POSITIONS, RADII, 2.5, ORIGIN),
}
every_file = pytest.mark.parametrize("name", WRITERS)


@every_file
def test_every_file_says_where_it_came_from(tmp_path, name):
    path = tmp_path / name
    WRITERS[name](path)
    if name.endswith("csv"):
        first = path.read_text().splitlines()[0]
        assert first.startswith("# ")
        result = json.loads(first.removeprefix("# "))
    elif name.endswith("parquet"):
        result = json.loads(pq.read_schema(path).metadata[b"provenance"])
    elif name.endswith("json"):
        result = read_json(path)["provenance"]
    else:
        with np.load(path) as file:
            result = json.loads(str(file["meta"]))
    assert {key: result[key] for key in ORIGIN} == ORIGIN


# --- bytes ---------------------------------------------------------------------------------------


@every_file
def test_same_content_gives_the_same_bytes_at_any_time(tmp_path, name, monkeypatch):
    WRITERS[name](tmp_path / name)
    first = (tmp_path / name).read_bytes()
    later = time.time() + 1e7
    monkeypatch.setattr(time, "time", lambda: later)
    WRITERS[name](tmp_path / "elsewhere" / name)
    assert (tmp_path / "elsewhere" / name).read_bytes() == first


def test_parquet_is_packed_for_size(tmp_path):
    WRITERS["table.parquet"](tmp_path / "table.parquet")
    group = pq.read_metadata(tmp_path / "table.parquet").row_group(0)
    assert {group.column(k).compression for k in range(group.num_columns)} == {"ZSTD"}


def test_packing_file_carries_no_date(tmp_path):
    WRITERS["packing.npz"](tmp_path / "packing.npz")
    with zipfile.ZipFile(tmp_path / "packing.npz") as file:
        assert {entry.date_time for entry in file.infolist()} == {(1980, 1, 1, 0, 0, 0)}


@every_file
def test_different_origin_gives_different_bytes(tmp_path, name):
    WRITERS[name](tmp_path / name)
    first = (tmp_path / name).read_bytes()
    other = {**ORIGIN, "seed": 4}
    if name.startswith("table"):
        write_table(tmp_path / name, TABLE, other)
    elif name == "fit.json":
        write_json(tmp_path / name, {"exponent": 3.0}, other)
    else:
        write_packing(tmp_path / name, POSITIONS, RADII, 2.5, other)
    assert (tmp_path / name).read_bytes() != first


# --- half files ----------------------------------------------------------------------------------


@every_file
def test_full_disk_leaves_the_old_file_and_nothing_else(tmp_path, name):
    path = tmp_path / name
    path.write_bytes(b"the old content")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    # Every file ends after 20 bytes, as on a disk that is full.
    resource.setrlimit(resource.RLIMIT_FSIZE, (20, limits[1]))
    try:
        with pytest.raises(OSError, match="large"):
            WRITERS[name](path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert path.read_bytes() == b"the old content"
    assert list(tmp_path.iterdir()) == [path]


def test_result_that_cannot_be_written_leaves_the_old_file(tmp_path):
    path = tmp_path / "fit.json"
    write_json(path, {"exponent": 3.0}, ORIGIN)
    before = path.read_bytes()
    with pytest.raises(TypeError):
        write_json(path, {"exponent": object()}, ORIGIN)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]
