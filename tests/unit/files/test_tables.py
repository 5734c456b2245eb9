"""Files in and out: what was written is read again, to the last digit and byte."""

import json
import subprocess
import sys

import numpy as np
import pandas as pd
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
    stacked_tables,
    study_provenance,
    write_json,
    write_packing,
    write_table,
    write_text,
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


# --- round trips ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_table_is_read_as_it_was_written(tmp_path, name):
    write_table(tmp_path / name, TABLE, ORIGIN)
    result = read_table(tmp_path / name)
    assert_frame_equal(result, pd.DataFrame(TABLE), check_exact=True)


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_columns_are_read_alone_when_they_are_named(tmp_path, name):
    write_table(tmp_path / name, TABLE, ORIGIN)
    result = read_table(tmp_path / name, ("state", "wall"))
    assert_frame_equal(result, pd.DataFrame(TABLE)[["state", "wall"]], check_exact=True)


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_states_are_read_alone_and_in_their_order_when_they_are_named(tmp_path, name):
    table = {"state": [2, 2, 4, 7, 7], "energy_J": [0.1, 0.2, 0.3, 0.4, 0.5]}
    write_table(tmp_path / name, table, ORIGIN)
    result = read_table(tmp_path / name, ("state", "energy_J"), [7, 2])
    expected = {"state": [2, 2, 7, 7], "energy_J": [0.1, 0.2, 0.4, 0.5]}
    assert_frame_equal(result, pd.DataFrame(expected), check_exact=True)
    assert len(read_table(tmp_path / name, states=[5])) == 0


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_number_that_is_not_known_stays_so(tmp_path, name):
    write_table(tmp_path / name, {"inertial_number": [1.0, np.nan]}, ORIGIN)
    assert_array_equal(read_table(tmp_path / name)["inertial_number"], [1.0, np.nan])


@pytest.mark.parametrize("name", ["table.csv", "table.parquet"])
def test_table_without_rows_keeps_its_columns(tmp_path, name):
    write_table(tmp_path / name, {"i": [], "overlap_m": []}, ORIGIN)
    result = read_table(tmp_path / name)
    assert list(result.columns) == ["i", "overlap_m"]
    assert len(result) == 0


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
    result = read_json(tmp_path / "fit.json")
    del result["provenance"]
    assert result == {
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
    result = read_json(tmp_path / "fit.json")
    assert (result["low"], result["high"], result["each"]) == (None, None, [1.0, None])


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


SAMPLES = {
    "sand": {"grains": 1000, "seeds": [7, 3], "contact": {"law": "hertz", "young_modulus": 7e10}},
    "powder": {"grains": 50, "seeds": [1], "contact": {"law": "linear", "normal_stiffness": 1e6}},
}


def test_first_line_of_a_study_holds_the_settings_and_seeds_of_every_sample(tmp_path):
    path = tmp_path / "comparison.csv"
    write_table(path, [{"sample": name} for name in SAMPLES], study_provenance(SAMPLES, bins=20))
    first, *lines = path.read_text().splitlines()
    assert json.loads(first.removeprefix("# ")) == {
        "branchcrush": __version__,
        "samples": SAMPLES,
        "bins": 20,
    }
    assert lines == ["sample", "sand", "powder"]
    assert read_table(path)["sample"].tolist() == ["sand", "powder"]


# --- all samples ---------------------------------------------------------------------------------


def test_tables_are_stacked_in_the_order_of_their_samples():
    sand = pd.DataFrame({"state": [4, 5], "leg": ["loading", "unloading"]}, index=[7, 9])
    powder = pd.DataFrame({"state": [1], "leg": ["loading"]})
    expected = pd.DataFrame(
        {
            "state": [1, 4, 5],
            "leg": ["loading", "loading", "unloading"],
            "sample": ["powder", "sand", "sand"],
        }
    )
    assert_frame_equal(stacked_tables({"powder": powder, "sand": sand}), expected)
    # What is stacked stays as it was.
    assert list(sand) == ["state", "leg"]


def test_table_without_data_keeps_its_reason_when_it_is_stacked():
    reason, sand = pd.DataFrame({"reason": ["no load"]}), pd.DataFrame({"state": [4]})
    stacked = stacked_tables({"sand": sand, "powder": reason})
    assert list(stacked) == ["state", "sample", "reason"]
    assert stacked["sample"].tolist() == ["sand", "powder"]
    assert stacked["state"].tolist()[0] == 4 and np.isnan(stacked["state"].tolist()[1])
    assert stacked["reason"].tolist()[1] == "no load"


def test_text_is_written_in_utf_8(tmp_path):
    write_text(tmp_path / "below" / "page.html", "κ* of 2 µm\n")
    assert (tmp_path / "below" / "page.html").read_bytes() == "κ* of 2 µm\n".encode()


# --- no data -------------------------------------------------------------------------------------


def test_result_without_data_is_read_as_its_reason_alone(tmp_path):
    table, result = no_data(FitError("no packing carries load, in none of 2 seeds"))
    write_table(tmp_path / "table.csv", table, ORIGIN)
    write_json(tmp_path / "fit.json", result, ORIGIN)
    reason = "no packing carries load, in none of 2 seeds"
    assert read_table(tmp_path / "table.csv").to_dict("records") == [{"reason": reason}]
    assert read_json(tmp_path / "fit.json") == {"reason": reason, "provenance": ORIGIN}
