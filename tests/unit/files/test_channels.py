"""Channels and densities of files: where channels meet, and what words and numbers say of them."""

import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import GradingError
from branchcrush.files.declared import Declared
from branchcrush.files.grading_tables import read_density_table, read_histogram


@pytest.fixture
def written(tmp_path):
    """Return a function that writes a table and returns its path."""

    def write(content):
        path = tmp_path / "powder.csv"
        path.write_text(content, encoding="utf-8")
        return path

    return write


def message_of(read, path, **keys):
    with pytest.raises(GradingError) as refused:
        read(path, Declared(**keys))
    return str(refused.value)


@pytest.mark.parametrize(
    ("content", "keys", "edges", "values"),
    [
        ("10,20\n20,50\n40,30\n", {"sizes": "lower"}, [10, 20, 40, 80], [20, 50, 30]),
        ("10,20\n20,50\n40,30\n", {"sizes": "upper"}, [5, 10, 20, 40], [20, 50, 30]),
        ("10,2\n20,5\n30,3\n", {"sizes": "lower"}, [10, 20, 30, 40], [2, 5, 3]),
        ("20,2\n30,5\n40,3\n", {"sizes": "upper"}, [10, 20, 30, 40], [2, 5, 3]),
        # Nothing in the last channel: its other edge is nowhere needed.
        ("10,2\n25,5\n30,0\n", {"sizes": "lower"}, [10, 25, 30], [2, 5]),
        ("10,0\n25,5\n30,3\n", {"sizes": "upper"}, [10, 25, 30], [5, 3]),
        ("10,2\n25,5\n30,3\n", {"sizes": "lower", "largest": 50.0}, [10, 25, 30, 50], [2, 5, 3]),
        ("10,2\n20,5\n", {"sizes": "upper", "smallest": 1.0}, [1, 10, 20], [2, 5]),
        ("10,2\n20,5\n30,3\n", {"sizes": "upper", "smallest": 1.0}, [1, 10, 20, 30], [2, 5, 3]),
        ("20,1\n40,2\n80,1\n", {"sizes": "middles", "scale": "log"},
         [20 / 2**0.5, 20 * 2**0.5, 40 * 2**0.5, 80 * 2**0.5], [1, 2, 1]),
        ("10,1\n20,2\n30,1\n", {"sizes": "middles", "scale": "linear"}, [5, 15, 25, 35], [1, 2, 1]),
        ("30,1\n10,1\n20,2\n", {"sizes": "middles", "scale": "linear"}, [5, 15, 25, 35], [1, 2, 1]),
        ("1,2,30\n2,4,70\n", {"sizes": "edges"}, [1, 2, 4], [30, 70]),
        ("4-8,70\n1 - 2,30\n", {"sizes": "edges"}, [1, 2, 4, 8], [30, 0, 70]),
        ("1,30\n2,70\n4,\n", {"sizes": "edges"}, [1, 2, 4], [30, 70]),
        ("1,\n2,30\n4,70\n", {"sizes": "edges"}, [1, 2, 4], [30, 70]),
        ("1-2,30\n2-4,70\nTotal,100\n", {"sizes": "edges"}, [1, 2, 4], [30, 70]),
    ],
)  # fmt: skip
def test_channels_meet_where_they_are_declared_to(written, content, keys, edges, values):
    table = read_histogram(written(content), Declared(**keys))
    assert_allclose(table.sizes, edges, rtol=1e-12)
    assert_allclose(table.values, values)


@pytest.mark.parametrize(
    ("content", "keys", "words"),
    [
        ("10,2\n25,5\n30,3\n", {"sizes": "lower"}, ["holds 3", "largest grain (max)"]),
        ("10,2\n25,5\n30,3\n", {"sizes": "upper"}, ["holds 2", "smallest grain (min)"]),
        ("10,2\n20,5\n30,3\n", {"sizes": "upper"}, ["begins at 0", "smallest grain"]),
        ("1,1\n4,1\n9,1\n", {"sizes": "middles", "scale": "log"}, ["one factor", "edges"]),
        ("10,1\n20,2\n30,3\n40,1\n", {"sizes": "middles", "scale": "log"}, ["by scale: linear"]),
        ("1,30\n2,70\n", {"sizes": "edges"}, ["needs both edges"]),
        ("1-2,30\n2-4,70\n", {"sizes": "lower"}, ["say sizes: edges"]),
        ("1-3,30\n2-4,70\n", {"sizes": "edges"}, ["line 2", "inside that of line 1"]),
        ("3,2,30\n", {"sizes": "edges"}, ["lower edge 3 must be below the upper 2"]),
        ("1-2,30\n2-4,70\nTotal,90\n", {"sizes": "edges"}, ["line 3: the total is 90"]),
        ("1,0\n2,0\n", {"sizes": "lower"}, ["no channel holds anything"]),
        ("1,-1\n2,3\n", {"sizes": "lower"}, ["line 1: value = -1", "negative"]),
        ("lower,%\n1,30\n2,70\n", {"sizes": "upper"}, ["say sizes: lower", "sizes: lower"]),
        ("µm,%\n1,30\n2,70\n", {"sizes": "lower"}, ["say unit: um, not unit: mm"]),
        ("d,counts\n1,30\n2,70\n", {"sizes": "lower", "basis": "mass"}, ["say basis: number"]),
        ("d,cum. %\n1,30\n2,70\n", {"sizes": "lower"}, ["cumulative curve", "form: sieve"]),
        ("1,5\n2,40\n4,70\n8,100\n", {"sizes": "upper"}, ["without turning", "form: sieve"]),
        ("d,dV/dlog d\n1,5\n2,40\n", {"sizes": "upper"}, ["form: density", "per: log_size"]),
        ("phi,%\n1,5\n2,40\n", {"sizes": "upper"}, ["sizes are phi"]),
    ],
)
def test_channels_that_are_something_else_are_refused(written, content, keys, words):
    message = message_of(read_histogram, written(content), **keys)
    for word in words:
        assert word in message


@pytest.mark.parametrize(
    ("content", "keys", "words"),
    [
        ("d,q3 lg\n1,1\n10,3\n100,0\n", {}, ["per: log_size, not per: size", "D50 = 8.21 mm"]),
        ("d,1/mm\n1,1\n10,3\n100,0\n", {"per": "log_size"}, ["per: size, not per: log_size"]),
        ("1,5\n2,40\n4,35\n8,20\n", {}, ["sum to 100", "form: histogram"]),
        ("d,volume %\n1,5\n3,40\n", {}, ["say percent", "form: histogram"]),
        ("1,5\n2,40\n4,70\n8,90\n16,100\n", {}, ["grow to 100", "form: sieve"]),
        ("d,undersize\n1,5\n3,40\n", {"per": "size"}, ["cumulative curve"]),
        ("d,number per mm\n1,5\n3,4\n", {"basis": "mass"}, ["say basis: number", "basis: number"]),
        ("".join(f"{2**n},{n}\n" for n in range(9)), {}, ["by a constant factor"]),
    ],
)
def test_density_that_is_something_else_is_refused(written, content, keys, words):
    message = message_of(read_density_table, written(content), **keys)
    for word in words:
        assert word in message


def test_density_that_is_declared_is_taken(written):
    path = written("d,volume %\n1,5\n2,40\n4,35\n8,20\n")
    for per in ("size", "log_size", "phi"):
        assert read_density_table(path, Declared(per=per)).values.tolist() == [5, 40, 35, 20]
