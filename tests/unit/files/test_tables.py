"""Files in and out: what was written is read again, to the last digit and byte."""

import json
import resource
import subprocess
import sys
import time
import zipfile

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from pandas.testing import assert_frame_equal

from branchcrush import __version__
from branchcrush.errors import FitError
from branchcrush.files.tables import (
    no_data,
    provenance,
    read_json,
    read_packing,
    read_table,
    write_json,
    write_packing,
    write_table,
)

ORIGIN = provenance(sample="paper", seed=3, config={"grains": 1000, "seeds": [1, 2]})
# Numbers that a table written with fewer than 17 digits would lose.
FLOATS = np.array([0.1 + 0.2, 1 / 3, 1e-300, -5e-324, 1.7976931348623157e308, 2.0**53, 0.0])
TABLE = {
    "state": np.arange(7),
    "normal_force_N": FLOATS,
    "wall": ["-x", "+x", "-y", "+y", "-z", "+z", "-x"],
    "carries_load": [True, False] * 3 + [True],
}
POSITIONS, RADII = np.random.default_rng(0).uniform(-1, 1, (2, 3)), np.array([1 / 3, 1e-5])

WRITERS = {
    "table.csv": lambda path: write_table(path, TABLE, ORIGIN),
    "table.parquet": lambda path: write_table(path, TABLE, ORIGIN),
    "fit.json": lambda path: write_json(path, {"exponent": 3.0}, ORIGIN),
    "packing.npz": lambda path: write_packing(path, POSITIONS, RADII, 2.5, ORIGIN),
}
every_file = pytest.mark.parametrize("name", WRITERS)


# --- round trips ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_table_is_read_as_it_was_written(tmp_path, name):
    write_table(tmp_path / name, TABLE, ORIGIN)
    found = read_table(tmp_path / name)
    assert_frame_equal(found, pd.DataFrame(TABLE), check_exact=True)


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_columns_are_read_alone_when_they_are_named(tmp_path, name):
    write_table(tmp_path / name, TABLE, ORIGIN)
    found = read_table(tmp_path / name, ("state", "wall"))
    assert_frame_equal(found, pd.DataFrame(TABLE)[["state", "wall"]], check_exact=True)


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_number_that_is_not_known_stays_so(tmp_path, name):
    write_table(tmp_path / name, {"inertial_number": [1.0, np.nan]}, ORIGIN)
    assert_array_equal(read_table(tmp_path / name)["inertial_number"], [1.0, np.nan])


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_table_without_rows_keeps_its_columns(tmp_path, name):
    write_table(tmp_path / name, {"i": [], "overlap_m": []}, ORIGIN)
    found = read_table(tmp_path / name)
    assert list(found.columns) == ["i", "overlap_m"]
    assert len(found) == 0


def test_table_may_be_a_list_of_rows_that_lack_some_columns(tmp_path):
    rows = [{"sample": "sand", "exponent": 3.0}, {"sample": "powder", "reason": "no load, none"}]
    write_table(tmp_path / "table.csv", rows, {})
    lines = (tmp_path / "table.csv").read_text().splitlines()[1:]
    assert lines == ["sample,exponent,reason", "sand,3.0,", 'powder,,"no load, none"']


def test_csv_is_what_pandas_would_write(tmp_path):
    table = {**TABLE, "said": ['a "b"', "a, b", "", "a\nb", "κ", "0", "nan"], "none": [np.nan] * 7}
    write_table(tmp_path / "table.csv", table, {})
    _, _, text = (tmp_path / "table.csv").read_bytes().decode().partition("\n")
    assert text == pd.DataFrame(table).to_csv(index=False, lineterminator="\n")


def test_tables_are_written_without_pandas(tmp_path):
    program = """
import sys
import numpy as np
from branchcrush.files.tables import write_table

table = {"i": np.arange(2), "overlap_m": np.array([0.5, 0.1]), "wall": np.array(["-x", "+z"])}
for name in ("table.csv", "table.parquet"):
    write_table(name, table, {})
assert "pandas" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True)
    for name in ("table.csv", "table.parquet"):
        assert read_table(tmp_path / name)["wall"].tolist() == ["-x", "+z"]


@settings(deadline=None, max_examples=50)
@given(st.lists(st.floats(allow_nan=False), min_size=1, max_size=20))
def test_csv_holds_every_digit_of_a_number(tmp_path_factory, numbers):
    path = tmp_path_factory.mktemp("digits") / "table.csv"
    write_table(path, {"x": numbers}, ORIGIN)
    assert_array_equal(read_table(path)["x"].to_numpy(), np.array(numbers))


def test_table_may_be_a_data_frame_whose_index_is_not_written(tmp_path):
    frame = pd.DataFrame({"state": [4, 5]}, index=[7, 9])
    for name in ("table.csv", "table.parquet"):
        write_table(tmp_path / name, frame, ORIGIN)
        assert_frame_equal(read_table(tmp_path / name), frame.reset_index(drop=True))


def test_json_holds_arrays_and_numpy_numbers_as_plain_values(tmp_path):
    result = {
        "exponent": np.float64(1 / 3),
        "seeds": np.int64(16),
        "loaded": np.bool_(True),
        "each": np.array([1.0, 2.0]),
        "predictors": [{"name": "branch_length", "pair": (1, 2)}],
        "text": "κ*",
    }
    write_json(tmp_path / "fit.json", result, ORIGIN)
    found = read_json(tmp_path / "fit.json")
    del found["provenance"]
    assert found == {
        "exponent": 1 / 3,
        "seeds": 16,
        "loaded": True,
        "each": [1.0, 2.0],
        "predictors": [{"name": "branch_length", "pair": [1, 2]}],
        "text": "κ*",
    }


def test_json_has_null_where_a_number_is_not_finite(tmp_path):
    result = {"low": np.nan, "high": float("inf"), "each": np.array([1.0, -np.inf])}
    write_json(tmp_path / "fit.json", result, ORIGIN)
    assert "NaN" not in (tmp_path / "fit.json").read_text()
    found = read_json(tmp_path / "fit.json")
    assert (found["low"], found["high"], found["each"]) == (None, None, [1.0, None])


def test_json_keeps_the_order_of_its_keys(tmp_path):
    write_json(tmp_path / "fit.json", {"z": 1, "a": 2}, ORIGIN)
    assert list(read_json(tmp_path / "fit.json")) == ["z", "a", "provenance"]


def test_packing_is_read_as_it_was_written(tmp_path):
    path = tmp_path / "packing.npz"
    write_packing(path, POSITIONS, RADII, np.float64(2.5), ORIGIN)
    positions, radii, edge = read_packing(path)
    assert_array_equal(positions, POSITIONS)
    assert_array_equal(radii, RADII)
    assert (edge, type(edge)) == (2.5, float)


def test_packing_holds_its_box_and_units_for_other_programs(tmp_path):
    write_packing(tmp_path / "packing.npz", POSITIONS, RADII, 2.5, ORIGIN)
    with np.load(tmp_path / "packing.npz") as file:
        assert set(file) == {"positions", "radii", "box", "meta"}
        assert file["box"].tolist() == [2.5, 2.5, 2.5]
        meta = json.loads(str(file["meta"]))
    assert meta["units"] == "m"
    assert meta["origin"] == "centre of the box"


# --- provenance ----------------------------------------------------------------------------------


def test_provenance_names_the_version_and_what_it_is_told():
    assert provenance(sample="a", seed=1) == {
        "branchcrush": __version__,
        "sample": "a",
        "seed": 1,
    }


@every_file
def test_every_file_says_where_it_came_from(tmp_path, name):
    path = tmp_path / name
    WRITERS[name](path)
    if name.endswith("csv"):
        first = path.read_text().splitlines()[0]
        assert first.startswith("# ")
        found = json.loads(first.removeprefix("# "))
    elif name.endswith("parquet"):
        found = json.loads(pq.read_schema(path).metadata[b"provenance"])
    elif name.endswith("json"):
        found = read_json(path)["provenance"]
    else:
        with np.load(path) as file:
            found = json.loads(str(file["meta"]))
    assert {key: found[key] for key in ORIGIN} == ORIGIN


# --- no data -------------------------------------------------------------------------------------


def test_result_without_data_is_read_as_its_reason_alone(tmp_path):
    table, result = no_data(FitError("no packing carries load, in none of 2 seeds"))
    write_table(tmp_path / "table.csv", table, ORIGIN)
    write_json(tmp_path / "fit.json", result, ORIGIN)
    reason = "no packing carries load, in none of 2 seeds"
    assert read_table(tmp_path / "table.csv").to_dict("records") == [{"reason": reason}]
    assert read_json(tmp_path / "fit.json") == {"reason": reason, "provenance": ORIGIN}


# --- bytes ---------------------------------------------------------------------------------------


@every_file
def test_same_content_gives_the_same_bytes_at_any_time(tmp_path, name, monkeypatch):
    WRITERS[name](tmp_path / name)
    first = (tmp_path / name).read_bytes()
    later = time.time() + 1e7
    monkeypatch.setattr(time, "time", lambda: later)
    WRITERS[name](tmp_path / "elsewhere" / name)
    assert (tmp_path / "elsewhere" / name).read_bytes() == first


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
def test_nothing_but_the_file_itself_is_left(tmp_path, name):
    WRITERS[name](tmp_path / "deep" / "folder" / name)
    WRITERS[name](tmp_path / "deep" / "folder" / name)
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == [name]


@every_file
def test_file_is_replaced_as_a_whole(tmp_path, name):
    path = tmp_path / name
    path.write_bytes(b"the old content")
    with path.open("rb") as reader:
        WRITERS[name](path)
        # Who opened the old file reads it to its end; only a new opening finds the new one.
        assert reader.read() == b"the old content"
    assert path.read_bytes() != b"the old content"


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
