"""Files of gradings: what people and machines write is read, and what is wrong in them is named."""

import pytest
from numpy.testing import assert_array_equal

from branchcrush.errors import GradingError
from branchcrush.files.declared import Declared
from branchcrush.files.grading_tables import read_density_table, read_radii, read_sieve_table

OPENING, PERCENT = [0.063, 0.5, 2.0, 8.0], [0.0, 12.5, 60.0, 100.0]
PLAIN = "0.063,0\n0.5,12.5\n2,60\n8,100\n"


@pytest.fixture
def written(tmp_path):
    """Return a function that writes text or bytes to a file and returns its path."""

    def write(content, name="sand.csv"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


def between(smallest, largest):
    return Declared(smallest=smallest, largest=largest)


def problems_of(read, path, *arguments):
    with pytest.raises(GradingError) as refused:
        read(path, *arguments)
    lines = str(refused.value).split("\n")
    assert all(line.startswith(str(path)) for line in lines), lines
    return [line.removeprefix(str(path)).lstrip(",: ") for line in lines]


# --- read ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "content",
    [
        PLAIN,
        PLAIN.rstrip("\n"),
        "opening_mm,percent_finer\n" + PLAIN,
        "opening,percent finer\nmm,%\n" + PLAIN,
        "Sieve 4, ISO 3310\n" + PLAIN,
        "# of the river, 2019\n\n" + PLAIN + "\n\n# the end\n",
        PLAIN.replace("12.5", "12.5  # weighed twice"),
        "\ufeff" + PLAIN,
        b"\xef\xbb\xbfopening,finer\n" + PLAIN.encode(),
        ("\ufeff" + PLAIN).encode("utf-16-le"),
        PLAIN.replace("\n", "\r\n"),
        PLAIN.replace("\n", "\r"),
        PLAIN.replace(",", ";"),
        PLAIN.replace(",", ";").replace(".", ","),
        "Öffnung [mm];Durchgang\n" + PLAIN.replace(",", "; ").replace(".", ","),
        PLAIN.replace(",", "\t"),
        PLAIN.replace(",", "   "),
        PLAIN.replace(",", ", "),
        "  " + PLAIN.replace("\n", "  \n  "),
        PLAIN.replace("\n", ",,\n"),
        PLAIN.replace("\n", ";;\n").replace(",", ";").replace(";;;", ";;"),
        '"0.063","0"\n"0.5","12.5"\n"2","60"\n"8","100"\n',
        "8,100\n2,60\n0.5,12.5\n0.063,0\n",
        "0.063,0\n8,100\n0.5,12.5\n2,60\n",
        PLAIN + "2,60\n2.0,60.0\n",
        "6.3e-2,0\n5E-1,12.5\n2,60\n8,1e2\n",
        ("Öffnung [mm];Durchgang\n" + PLAIN.replace(",", ";")).encode("cp1252"),
        PLAIN.replace(",", "\t").replace(".", ","),
        PLAIN.replace(",", " ").replace(".", ","),
        PLAIN.replace("\n", " %\n"),
        "63 µm,0\n0.5 mm,12.5\n0.2 cm,60\n8,100\n",
        "\n\n".join([PLAIN, "pan,0\n"]),
        "Sand of the river\nweighed; twice\n\nopening,finer\n" + PLAIN,
        "Sample;12\nMass (g);500,5\nmm;Durchgang\n" + PLAIN.replace(",", ";").replace(".", ","),
        PLAIN + "Total,100\n",
    ],
)
def test_every_usual_way_to_write_a_table_is_read(written, content):
    table = read_sieve_table(written(content))
    assert_array_equal(table.sizes, OPENING)
    assert_array_equal(table.values, PERCENT)


def test_level_part_of_a_curve_is_no_mistake(written):
    percent = read_sieve_table(written("1,0\n2,40\n4,40\n8,100\n")).values
    assert percent.tolist() == [0, 40, 40, 100]


def test_curve_that_is_cut_need_not_run_to_its_ends(written):
    path = written("0.1,5\n1,50\n4,95\n")
    assert read_sieve_table(path, between(0.1, 4.0)).sizes.tolist() == [0.1, 1.0, 4.0]
    assert read_sieve_table(path, between(0.5, 3.0)).values.tolist() == [5.0, 50.0, 95.0]


def test_grains_beyond_the_sieves_go_to_the_smallest_and_the_largest(written):
    table = read_sieve_table(written("0.1,5\n1,50\n4,95\n"), between(0.02, 9.0))
    assert table.sizes.tolist() == [0.02, 0.1, 1.0, 4.0, 9.0]
    assert table.values.tolist() == [0.0, 5.0, 50.0, 95.0, 100.0]


def test_density_table_is_sorted(written):
    table = read_density_table(written("size;density\n2;0,5\n1;3\n4;0\n1;3\n"))
    assert (table.sizes.tolist(), table.values.tolist()) == ([1, 2, 4], [3, 0.5, 0])


def test_every_line_of_radii_is_a_grain(written):
    radii = read_radii(written("radius\n2\n1.5\n2  # again\n\n1\n"))
    assert radii.tolist() == [1.0, 1.5, 2.0, 2.0]


# --- refused: the file ---------------------------------------------------------------------------


@pytest.mark.parametrize("read", [read_sieve_table, read_density_table, read_radii])
@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", ["empty", "one row of numbers on each line"]),
        (" \n\t\r\n", ["empty"]),
        (b"PK\x03\x04\x00\x00\x08\x00", ["no text in UTF-8", "save the table as CSV"]),
        (b"\x89PNG\r\n\x1a\n", ["no text in UTF-8"]),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0\0", ["old .xls", "as .xlsx"]),
    ],
)
def test_file_without_text_is_refused(written, read, content, words):
    (message,) = problems_of(read, written(content))
    for word in words:
        assert word in message


@pytest.mark.parametrize("read", [read_sieve_table, read_density_table, read_radii])
def test_missing_file_and_folder_are_refused(tmp_path, read):
    (message,) = problems_of(read, tmp_path / "none.csv")
    assert "no such file" in message and "relative" in message
    (message,) = problems_of(read, tmp_path)
    assert "folder" in message


@pytest.mark.parametrize("content", ["# nothing\n", "opening,finer\n", "one two three\n"])
def test_file_without_numbers_is_refused(written, content):
    for read in (read_sieve_table, read_density_table, read_radii):
        (message,) = problems_of(read, written(content))
        assert message.startswith("line 1: no ") and "numbers" in message


# --- refused: its lines --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("1,0\n", ["line 1: one row", "two or more"]),
        ("h,h\n1,0\n1,0\n", ["line 2: one row", "two or more"]),
        ("1,0\n2,50,7\n4,100\n", ["line 2: 3 columns, 2 | 50 | 7", "opening, percent finer"]),
        ("1,0\n2\n4,100\n", ["line 2: 1 column, 2;", "must have 2"]),
        ("0,5 1,5 0\n8 1 9\n", ["line 1: 3 columns", "Decimal commas need semicolons"]),
        ("1,000\t0\n8,100\t100\n", ["line 1: opening = '1,000'", "Decimal commas need"]),
        ("0,5;0\n8.1;100\n", ["line 1: opening = '0,5'", "Decimal commas need semicolons"]),
        ("1,0\n2,abc\n4,100\n", ["line 2: percent finer = 'abc'", "no finite number"]),
        ("1,0\nx,50\n4,100\n", ["line 2: opening = 'x'", "no finite number"]),
        ("1,zero\n4,100\n", ["line 1: percent finer = 'zero'"]),
        ("1,0\n2,nan\n4,100\n", ["line 2: percent finer = 'nan'"]),
        ("1,0\n2,50\ninf,100\n", ["line 3: opening = 'inf'"]),
        ("1,0\n2,\n4,100\n", ["line 2: 1 column"]),
        ("1,0\n,50\n4,100\n", ["line 2: opening = ''"]),
        ("1,0\n1_000,100\n", ["line 2: opening = '1_000'"]),
        ("0,0\n1,50\n2,100\n", ["line 2: percent finer = 50", "how small", "Set min"]),
        ("0,5\n1,50\n2,100\n", ["line 1: percent finer = 5 at the pan; must be 0"]),
        ("-1,0\n1,0\n2,100\n", ["line 1: opening = -1;", "above 0"]),
        ("1,-5\n2,0\n4,100\n", ["line 1: percent finer = -5;", "between 0 and 100"]),
        ("1,0\n2,50\n4,100.5\n8,100\n", ["line 3: percent finer = 100.5;", "between 0 and 100"]),
        (
            "# x\n1,0\n2,50\n4,30\n8,100\n",
            ["line 4: percent finer = 30 at opening 4", "50", "line 3", "not fall"],
        ),
        ("1,0\n2,50\n2,60\n4,100\n", ["line 3: opening 2", "= 60", "50 on line 2"]),
        ("1,5\n4,100\n", ["line 1: percent finer = 5", "below 1, and 0", "Set min to its size"]),
        ("1,0\n4,90\n", ["line 2: percent finer = 90", "above 4, and 100", "Set max to its size"]),
        ("1,0\n4,1.0\n", ["line 2", "fractions", "by 100"]),
    ],
)
def test_wrong_sieve_table_is_refused_with_line_value_and_remedy(written, content, expected):
    messages = problems_of(read_sieve_table, written(content))
    if "Decimal" not in expected[-1]:
        assert len(messages) == 1, messages
    for words in expected:
        assert words in messages[0]


def test_all_problems_of_a_file_are_told_at_once(written):
    content = "h,h\n0,0\n1,x\n2,150\n3,1,1\n4,60\n5,50\n4,70\n"
    messages = problems_of(read_sieve_table, written(content))
    lines = sorted(message.split(":")[0] for message in messages)
    assert lines == [f"line {n}" for n in (3, 4, 5, 7, 8)]


def test_both_ends_of_a_curve_are_told_at_once(written):
    messages = problems_of(read_sieve_table, written("1,5\n4,90\n"))
    assert [message[:6] for message in messages] == ["line 1", "line 2"]


def test_many_problems_are_counted(written):
    messages = problems_of(read_radii, written("1\n" + "x\n" * 1000))
    assert len(messages) == 21
    assert messages[-1] == "and 980 more problems"


def test_bounds_beside_a_curve_are_refused(written):
    path = written(PLAIN)
    (message,) = problems_of(read_sieve_table, path, between(8.0, None))
    assert "min = 8 must be below the largest size 8" in message
    for largest in (0.01, 0.063):
        (message,) = problems_of(read_sieve_table, path, between(None, largest))
        assert f"max = {largest} must be above the smallest size 0.063" in message
    (message,) = problems_of(read_density_table, written("1,1\n4,1\n"), between(4.0, None))
    assert "line 2: min = 4 must be below the largest size 4" in message


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("1,1\n2,-3\n", ["line 2: density = -3;", "not be negative"]),
        ("1,0\n2,0\n", ["lines 1 to 2", "every density = 0", "above 0"]),
        ("1,1\n0,3\n2,1\n", ["line 2: size = 0;", "above 0"]),
        ("1,1\n1,3\n2,1\n", ["line 2: size 1 has density = 3", "1 on line 1"]),
        ("1,1\n", ["one row"]),
        ("1,1\n2,inf\n", ["line 2: density = 'inf'"]),
    ],
)
def test_wrong_density_table_is_refused(written, content, expected):
    (message,) = problems_of(read_density_table, written(content))
    for words in expected:
        assert words in message


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("1\n0\n", "line 2: size = 0;"),
        ("1\n-2\n", "line 2: size = -2;"),
        ("1\n2,5\n", "line 2: 2 columns"),
        ("1\nnan\n", "line 2: size = 'nan'"),
        ("1\ntwo\n", "line 2: size = 'two'"),
    ],
)
def test_wrong_radii_are_refused(written, content, expected):
    (message,) = problems_of(read_radii, written(content))
    assert message.startswith(expected)
