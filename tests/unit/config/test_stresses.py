"""The mean stresses of a loading: a number, a list or a range, and nothing else."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from pydantic_core import PydanticCustomError

from branchcrush.config.stresses import increasing_stresses


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (None, None),
        (5, [5.0]),
        ("1e5", [1e5]),
        ([1, 2.5, "1e3"], [1.0, 2.5, 1000.0]),
        ({"from": 1, "to": 100, "states": 3}, [1.0, 10.0, 100.0]),
        ({"from": "1e5", "to": "1e7", "states": "2"}, [1e5, 1e7]),
    ],
)
def test_every_way_to_give_stresses(value, expected):
    assert increasing_stresses(value) == (expected and pytest.approx(expected))


NUMBER = "each must be a number above 0 and at most 1e15"


@pytest.mark.parametrize(
    ("value", "what"),
    [
        (0, NUMBER),
        (-1, NUMBER),
        (True, NUMBER),
        (float("nan"), NUMBER),
        (float("inf"), NUMBER),
        (1e16, NUMBER),
        (10**400, NUMBER),
        ("high", NUMBER),
        ("nan", NUMBER),
        ([1, None], NUMBER),
        ([[1]], NUMBER),
        ([], "the list is empty"),
        ([1, 1], "1 does not rise above 1 before it"),
        ([1, 3, 2], "2 does not rise above 3 before it"),
        (list(range(1, 1002)), "1001 stresses are more than 1000"),
        ({}, "its keys are none"),
        ({"from": 1, "to": 2}, "its keys are from, to"),
        ({"from": 1, "to": 2, "states": 3, 4: 5}, "its keys are from, to, states, 4"),
        ({"from": 2, "to": 1, "states": 3}, "from 2 Pa must be below to 1 Pa"),
        ({"from": 1, "to": 1, "states": 3}, "from 1 Pa must be below to 1 Pa"),
        ({"from": 0, "to": 1, "states": 3}, NUMBER),
        ({"from": 1, "to": [2], "states": 3}, NUMBER),
        ({"from": 1, "to": 2, "states": 1}, "states must be a whole number from 2 to 1000"),
        ({"from": 1, "to": 2, "states": 1e9}, "states must be a whole number from 2 to 1000"),
        ({"from": 1, "to": 2, "states": 2.5}, "states must be a whole number from 2 to 1000"),
        ({"from": 1, "to": 2, "states": True}, "states must be a whole number from 2 to 1000"),
    ],
)
def test_anything_else_is_refused_with_what_is_allowed(value, what):
    with pytest.raises(PydanticCustomError) as refused:
        increasing_stresses(value)
    words = refused.value.context["words"]
    assert words.startswith("must be a stress in Pa, an increasing list of them, or a range {from:")
    assert words.endswith(f"; {what}")
    assert refused.value.context["unit"] == "Pa"


@given(st.floats(1e-3, 1e6), st.floats(1.1, 1e5), st.integers(2, 30))
def test_a_range_of_stresses_is_even_in_the_logarithm(first, ratio, states):
    stresses = increasing_stresses({"from": first, "to": first * ratio, "states": states})
    assert len(stresses) == states
    assert_allclose([stresses[0], stresses[-1]], [first, first * ratio], rtol=1e-12)
    assert_allclose(np.diff(np.log(stresses)), np.log(ratio) / (states - 1), rtol=1e-6)
    # NumPy's numbers print as no number that LAMMPS reads.
    assert {type(value) for value in stresses} == {float}
