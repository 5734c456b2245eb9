"""Histories of loads from tables: columns, units, and what no packing can have."""

import pytest

from branchcrush.errors import GradingError
from branchcrush.files.histories import MOST_LOADS, read_history


def written(tmp_path, text):
    path = tmp_path / "loads.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("text", "quantity", "unit", "loads"),
    [
        ("0.01\n0.05\n0.02\n", "strain", "-", [0.01, 0.05, 0.02]),
        ("1\n5\n", "strain", "percent", [0.01, 0.05]),
        ("strain [%]\n1.5\n2.5\n", "strain", "percent", [0.015, 0.025]),
        ("time;axial strain;stress [kPa]\n0;0;0\n1;0,1;250\n", "stress", "kPa", [0.0, 250e3]),
        ("time,stress (MPa)\n0,2\n1,0.5\n", "stress", "MPa", [2e6, 5e5]),
        ("Pressure [Pa],note\n1e5,a\n2e5,b\n", "stress", "Pa", [1e5, 2e5]),
    ],
)
def test_loads_are_read_in_their_order(tmp_path, text, quantity, unit, loads):
    assert read_history(written(tmp_path, text), quantity, unit) == pytest.approx(loads, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "quantity", "unit", "message"),
    [
        ("stress [kPa]\n1\n", "stress", "Pa", "line 1: the words above the column say kPa"),
        ("strain [%]\n1\n", "strain", "-", "say percent, but unit: -"),
        ("1\n5\n", "strain", "-", "line 1: strain = 1 -: .*are these percent"),
        ("0.1\n0.5\n", "strain", "-", "line 2: strain = 0.5 -: .*below 0.5: no elastic law"),
        ("0.1\n-0.1\n", "strain", "-", "line 2: strain = -0.1 -: .*compression is positive"),
        ("1e5\n-1\n", "stress", "kPa", "line 2: stress = -1 kPa: must be from 0"),
        ("0.1\nnone\nnan\n", "strain", "-", "(?s)line 2: strain = 'none'.*line 3: strain = 'nan'"),
        ("stress\n", "stress", "Pa", "line 1: no numbers in the file"),
        ("a,b\n1,2\n", "stress", "Pa", "2 columns, 1: 'a', 2: 'b'; none named stress"),
        ("stress,stress at peak\n1,2\n", "stress", "Pa", "2 of them named stress"),
        ("0.1\n" * (MOST_LOADS + 1), "strain", "-", "more than 1000 loads"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(tmp_path, text, quantity, unit, message):
    path = written(tmp_path, text)
    with pytest.raises(GradingError, match=message) as error:
        read_history(path, quantity, unit)
    assert str(error.value).startswith(str(path))


def test_no_file(tmp_path):
    with pytest.raises(GradingError, match=r"no\.csv"):
        read_history(tmp_path / "no.csv", "strain", "-")
