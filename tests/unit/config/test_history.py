"""The keys of a history of loads: one way to give them, checked before any job."""

import pytest

from branchcrush.config.checks import checked_study
from branchcrush.config.history import history_loads
from branchcrush.errors import ConfigError

SAMPLE = {
    "grading": {
        "form": "uniform",
        "basis": "number",
        "size": "radius",
        "unit": "mm",
        "min": 0.8,
        "max": 1,
    },
    "grains": 2000,
    "loading": {"edge_reduction": 0.4},
    "seeds": 2,
}


def study(tmp_path, history):
    return plain(tmp_path, {"history": history})


def plain(tmp_path, thermodynamics):
    raw = {"samples": {"sand": SAMPLE}, "thermodynamics": thermodynamics}
    return checked_study(raw, tmp_path).thermodynamics.model_dump()["history"]


@pytest.mark.parametrize(
    ("history", "read"),
    [
        ({"strain": [0.1, "5e-2", 0]}, ("strain", [0.1, 0.05, 0.0])),
        ({"stress": [1e6, 0.0, "2e6"]}, ("stress", [1e6, 0.0, 2e6])),
    ],
)
def test_lists(tmp_path, history, read):
    quantity, loads = history_loads(study(tmp_path, history))
    assert (quantity, loads.tolist()) == read


def test_none(tmp_path):
    assert history_loads(plain(tmp_path, {})) is None


def test_file(tmp_path):
    (tmp_path / "loads.csv").write_text("kPa\n100\n50\n")
    file = {"file": str(tmp_path / "loads.csv"), "column": "stress", "unit": "kPa"}
    quantity, loads = history_loads(study(tmp_path, file))
    assert (quantity, loads.tolist()) == ("stress", [1e5, 5e4])


@pytest.mark.parametrize(
    ("history", "message"),
    [
        ({"unit": "kPa"}, "must have one of strain, .*; none is given"),
        (None, "must be a section"),
        ({"strain": [0.1], "stress": [1.0]}, "strain and stress are given"),
        ({"strain": []}, "must be a list of 1 to 1000 numbers"),
        ({"strain": 0.1}, "must be a list of 1 to 1000 numbers"),
        ({"strain": [0.1, "x"]}, "number 2 is none"),
        ({"strain": [0.1, 0.6]}, "number 2 is 0.6, .*no elastic law is meant for more"),
        ({}, "must have one of strain, .*; none is given"),
        ({"stress": None}, "must have one of strain, .*; none is given"),
        ({"strain": [0.1, 5.0]}, "number 2 is 5, .*are these percent"),
        ({"stress": [-1.0]}, "number 1 is -1, must be from 0"),
        ({"strain": [0.1], "unit": "percent"}, "column and unit are for a file"),
        ({"file": "loads.csv"}, "a file must have column"),
        ({"file": "loads.csv", "column": "strain", "unit": "kPa"}, "a unit of it"),
        ({"file": "no.csv", "column": "strain", "unit": "-"}, r"history\.file = 'no\.csv'"),
        ({"loads": [1.0]}, r"thermodynamics\.history\.loads"),
    ],
)
def test_refused(tmp_path, history, message):
    with pytest.raises(ConfigError, match=message) as error:
        study(tmp_path, history)
    assert "thermodynamics.history" in str(error.value)
    assert len(str(error.value).splitlines()) == 1
