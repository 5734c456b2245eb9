"""Rows of numbers: which line each is of, and what is passed over, read or refused."""

import pytest

from branchcrush.errors import GradingError
from branchcrush.files.rows import Row, read_rows, refuse

NAMES = ("opening", "percent finer")


@pytest.fixture
def rows_of(tmp_path):
    """Return a function that reads the rows of a text, and what is wrong with it."""

    def rows(content):
        path = tmp_path / "sand.csv"
        path.write_text(content)
        return read_rows(path, NAMES)

    return rows


def test_rows_know_their_lines_from_1(rows_of):
    rows, problems = rows_of("of the river\n\nopening,finer\n1,0\n# weighed twice\n2,50\n")
    assert rows == [Row(4, (1.0, 0.0)), Row(6, (2.0, 50.0))]
    assert problems == []


def test_words_are_passed_over_above_the_numbers_only(rows_of):
    rows, problems = rows_of("opening,finer\n1,0\nthe,end\n")
    assert [row.line for row in rows] == [2]
    assert len(problems) == 2
    assert all(problem.startswith("line 3: ") for problem in problems)
    # A first line that holds a number is meant to be a row.
    rows, problems = rows_of("1,none\nopening,finer\n2,0\n")
    assert [row.line for row in rows] == [3]
    assert [problem[:7] for problem in problems] == ["line 1:", "line 2:", "line 2:"]


@pytest.mark.parametrize(
    ("line", "values"),
    [
        ("1.5,2", (1.5, 2.0)),
        ("1,5;2", (1.5, 2.0)),
        ("1.5;2", (1.5, 2.0)),
        ("1.5\t2", (1.5, 2.0)),
        ("1.5 2", (1.5, 2.0)),
        ("1,2", (1.0, 2.0)),
        ("1;2;;", (1.0, 2.0)),
        ("-1e-3,+2", (-1e-3, 2.0)),
        ("1,2 # 3,4", (1.0, 2.0)),
    ],
)
def test_first_mark_of_a_line_parts_its_columns(rows_of, line, values):
    assert rows_of(line + "\n") == ([Row(1, values)], [])


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("1,2,3", "line 1: 3 columns, 1 | 2 | 3; must have 2: opening, percent finer."),
        ("1", "line 1: 1 column, 1; must have 2: opening, percent finer."),
        ("1,inf", "line 1: percent finer = 'inf' is no finite number; correct it"),
        ("1_0,2", "line 1: opening = '1_0' is no finite number; correct it"),
    ],
)
def test_line_that_is_no_row_is_a_problem_of_its_number(rows_of, line, problem):
    rows, (only,) = rows_of(line + "\n")
    assert rows == []
    assert only.startswith(problem)


def test_twenty_problems_are_told_and_the_others_counted():
    problems = [f"line {n}: wrong" for n in range(1, 22)]
    with pytest.raises(GradingError) as refused:
        refuse("sand.csv", problems)
    assert str(refused.value).split("\n") == [
        *(f"sand.csv, line {n}: wrong" for n in range(1, 21)),
        "sand.csv: and 1 more problem",
    ]
    with pytest.raises(GradingError) as refused:
        refuse("sand.csv", problems[:20])
    assert "more" not in str(refused.value)
