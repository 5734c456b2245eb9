"""How values are written: to the last digit, and as null or nothing where they are not known."""

import numpy as np
import pytest

from branchcrush.files.encoding import arrow_array, cells, json_line, json_page


def test_json_on_a_line_is_sorted_and_on_a_page_is_not():
    value = {"seed": 3, "config": {"z": True, "a": None}}
    assert json_line(value) == '{"config": {"a": null, "z": true}, "seed": 3}'
    page = '{\n  "seed": 3,\n  "config": {\n    "z": true,\n    "a": null\n  }\n}\n'
    assert json_page(value) == page


def test_numbers_of_numpy_are_plain_in_json():
    value = {1: np.float64(0.1), "b": np.bool_(False), "c": (np.int32(2), np.array([[1.5]]))}
    assert json_line(value) == '{"1": 0.1, "b": false, "c": [2, [[1.5]]]}'


@pytest.mark.parametrize("number", [float("nan"), np.float32("inf"), np.array(-np.inf)[()]])
def test_number_that_is_not_finite_is_null(number):
    assert json_line([number]) == "[null]"


@pytest.mark.parametrize("write", [json_line, json_page])
def test_value_that_json_does_not_know_is_refused(write):
    with pytest.raises(TypeError):
        write({"a": {1, 2}})


def test_cells_are_values_of_python():
    numbers = cells(np.array([0.1 + 0.2, np.nan, np.inf]))
    assert numbers == [0.30000000000000004, None, float("inf")]
    assert [type(number) for number in numbers] == [float, type(None), float]
    assert [type(cell) for cell in cells([np.int64(1), np.bool_(True), "a"])] == [int, bool, str]


@pytest.mark.parametrize(
    ("column", "kind"),
    [
        (np.array([1, -2]), "int64"),
        (np.array([1, 2], dtype=np.int32)[::-1], "int32"),
        (np.arange(6.0).reshape(2, 3)[:, 1], "double"),
        ([0.5, 2], "double"),
        (["κ", ""], "large_string"),
        ([True, False], "bool"),
        ([], "double"),
    ],
)
def test_array_of_arrow_holds_the_column(column, kind):
    array = arrow_array(column)
    assert str(array.type) == kind
    assert array.to_pylist() == list(column)
