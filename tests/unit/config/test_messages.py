"""What is wrong with a value, as a line that a user understands."""

import datetime

import pytest
from pydantic import ValidationError

from branchcrush.config.fields import Number, Section, number, number_of
from branchcrush.config.messages import problem, shown


class Root(Section):
    count: number(int, least=2, most=5, unit="grains") = 3
    stiffness: number(above=0, unit="N/m") = 1.0


def message_of(**keys):
    with pytest.raises(ValidationError) as refused:
        Root.model_validate(keys)
    (detail,) = refused.value.errors()
    return problem(detail, Root)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "nothing"),
        (False, "false"),
        (3, "3"),
        (1e6, "1e+06"),
        (float("-inf"), "-inf"),
        ("a b", "'a b'"),
        ("1e6", "1e6"),
        ("two\nlines", r"'two\nlines'"),
        ([1, [None]], "[1, [nothing]]"),
        ({"a": {1: "x"}}, "{a: {1: 'x'}}"),
        (datetime.date(2020, 1, 31), "2020-01-31"),
        pytest.param(10**5000, "a number of thousands of digits", id="huge"),
    ],
)
def test_values_are_shown_as_a_user_writes_them(value, text):
    assert shown(value) == text


@pytest.mark.parametrize("value", ["x" * 500, list(range(500)), {k: k for k in range(500)}])
def test_a_long_value_is_cut(value):
    assert len(shown(value)) == 100
    assert shown(value).endswith("...")


@pytest.mark.parametrize(
    ("text", "value"), [("1e6", 1e6), (" 7 ", 7), ("-0.5", -0.5), (3, 3), (2**53 + 1, 2**53 + 1)]
)
def test_a_number_and_text_that_spells_one_are_numbers(text, value):
    assert number_of(text) == value


@pytest.mark.parametrize(
    "value",
    [
        True,
        None,
        "",
        "five",
        "1,5",
        "5 mm",
        "nan",
        "inf",
        float("nan"),
        float("inf"),
        [1],
        {},
        b"1",
    ],
)
def test_nothing_else_is_a_number(value):
    assert number_of(value) is None


@pytest.mark.parametrize(
    ("bounds", "words"),
    [
        ({"above": 0}, "must be a number above 0"),
        ({"above": 0, "most": 0.4}, "must be a number above 0 and at most 0.4"),
        ({"above": 0, "below": 3, "unit": "m"}, "must be a number above 0 and below 3 m"),
        ({"least": 0, "whole": True}, "must be a whole number from 0 up"),
        ({"least": 2, "most": 10**7, "whole": True}, "must be a whole number from 2 to 10000000"),
    ],
)
def test_bounds_in_words(bounds, words):
    assert Number(**bounds).allowed == words


def test_bounds_that_belong_to_the_range_are_taken():
    assert Root(count=2).count == 2
    assert Root(count="5").count == 5
    assert type(Root(count=4.0).count) is int
    assert type(Root(stiffness=4).stiffness) is float


@pytest.mark.parametrize("value", [1, 6, 2.5])
def test_whole_number_out_of_its_range_is_shown_with_the_unit(value):
    expected = f"count = {value} grains: must be a whole number from 2 to 5 grains"
    assert message_of(count=value) == expected


def test_a_unit_is_shown_beside_numbers_only():
    assert message_of(stiffness="-1").startswith("stiffness = -1 N/m: must be a number above 0 N/m")
    assert message_of(stiffness=[1]).startswith("stiffness = [1]: must be a number above 0 N/m")
    assert message_of(stiffness="1,5") == (
        "stiffness = '1,5': must be a number above 0 N/m, with a decimal point"
    )


def test_a_key_that_is_no_text_is_unknown_and_named():
    with pytest.raises(ValidationError) as refused:
        Root.model_validate({"stifness": 1})
    (detail,) = refused.value.errors()
    assert problem(detail, Root) == "stifness: unknown key; did you mean stiffness?"
