"""The dictionary of result files: what is written in it agrees with itself."""

import re

import pytest

from branchcrush.files.dictionary import (
    Column,
    ResultFile,
    expanded,
    result_files,
    stages,
)

# How a name ends whose number has a unit; the rest of the name may follow, as in length_low_m.
ENDINGS = {
    "m": ("_m", "_m1"),
    "m2": ("_m2",),
    "m3": ("_m3",),
    "1/m": ("_per_m",),
    "1/m3": ("_per_m3",),
    "Pa": ("_Pa",),
    "J": ("_J",),
    "N": ("_N",),
    "J/m3": ("_J_per_m3",),
    "J/m^n": ("_J_per_m_n",),
}
ALL_ENDINGS = tuple(ending for endings in ENDINGS.values() for ending in endings)
# Without a unit in their names: vectors, moments of any power, and what grading.json calls so.
WITHOUT = re.compile(
    r"branch_[xyz]|(initial|ultimate)_moment"
    r"|representativity\.(expected_)?(largest_diameter|box_edge)"
    r"|(convergence\[\]\.)?(value(_at_twice_the_steps)?|(standard_error_of_)?difference)"
    r"|(convergence\[\]\.)?(could_see|tolerance)|notes\[\]\.(value|limit)"
    r"|predicted|measured(_(low|high))?"
)
# Names of LAMMPS and of NumPy's arrays are as their readers want them.
OTHERS = (".dump.gz", ".npz", "config.json")


def test_braces_stand_for_every_choice_in_order():
    assert list(expanded("{a,b}_{c,d}")) == ["a_c", "a_d", "b_c", "b_d"]
    assert list(expanded("n{,_low}")) == ["n", "n_low"]
    assert list(expanded("plain")) == ["plain"]


def test_limits_of_an_interval_say_so_and_stand_beside_their_value():
    line = Column("{a,b}{,_low,_high}_m", "number", "m", "mean length")
    columns = ResultFile("t.csv", "r", "", (line,)).columns()
    assert [column.name for column in columns] == [
        "a_m",
        "a_low_m",
        "a_high_m",
        "b_m",
        "b_low_m",
        "b_high_m",
    ]
    assert [column.meaning for column in columns[:3]] == [
        "mean length",
        "mean length; lower end of its interval",
        "mean length; upper end of its interval",
    ]


@pytest.mark.parametrize(
    ("path", "matched"),
    [
        ("sand/seed_12/path.csv", True),
        ("sand-refined/seed_1/path.csv", True),
        ("sand/seed_x/path.csv", False),
        ("sand/more/seed_1/path.csv", False),
        ("sand/seed_1/pathxcsv", False),
    ],
)
def test_a_path_matches_any_sample_and_seed(path, matched):
    assert ResultFile("<sample>/seed_<seed>/path.csv", "", "").matches(path) is matched


def is_percent(name):
    return name.rpartition(".")[2].startswith(("percent_", "largest_gap_percent_"))


@pytest.mark.parametrize("file", result_files(), ids=lambda file: file.path)
def test_a_name_ends_in_the_unit_of_its_number(file):
    for name, _, unit, _ in () if file.path.endswith(OTHERS) else file.columns():
        if WITHOUT.fullmatch(name):
            assert unit not in ("", "-"), name
        elif is_percent(name):
            assert unit == "%", name
        elif unit in ENDINGS:
            assert name.endswith(ENDINGS[unit]), name
        else:
            assert unit in ("", "-"), name
            assert not name.endswith(ALL_ENDINGS), name


@pytest.mark.parametrize("file", result_files(), ids=lambda file: file.path)
def test_a_file_names_each_column_once_with_a_known_type(file):
    names = [column.name for column in file.columns()]
    assert len(names) == len(set(names))
    assert file.rare <= set(names)  # or it is written otherwise there
    for column in file.columns():
        assert column.type in ("number", "integer", "string", "boolean", "array", "object")
        assert (column.type in ("number", "integer")) <= bool(column.unit), column
        assert column.meaning


def test_each_figure_that_shows_a_table_is_a_file_as_well():
    files = {file.path for file in result_files()}
    shown = {f"figures/{name}.png" for file in result_files() for name in file.figures}
    assert shown <= files
    assert len(files) == len(result_files())
    assert all(stage.title and stage.text and stage.files for stage in stages())
