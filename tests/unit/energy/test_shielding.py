"""What an interval says of the claim that energies vanish."""

import pytest

from branchcrush.energy.shielding import claim_answer
from branchcrush.statistics.intervals import Interval

NAN = float("nan")


@pytest.mark.parametrize(
    ("low", "high", "answer"),
    [
        (0.01, 0.09, "supported"),
        (0.11, 0.50, "contradicted"),
        (0.05, 0.15, "undecided"),
        (NAN, NAN, "undecided"),
    ],
)
def test_interval_is_held_against_a_tenth(low, high, answer):
    assert claim_answer(Interval(0.1, low, high), 10, 10, "grain") == answer


def test_too_few_decide_nothing_and_none_are_told():
    sure = Interval(0.01, 0.0, 0.02)
    assert claim_answer(sure, 9, 10, "grain") == "undecided"
    assert claim_answer(sure, 0, 10, "branch") == "no such branch"
