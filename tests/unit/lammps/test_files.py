"""LAMMPS files: what is written holds every digit, what is read is what the file says."""

import gzip
import os
import weakref
import zlib

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from branchcrush.lammps.files import compress_file, read_dump, write_data_file

ATOMS = """\
ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS ff ff ff
-1.5 1.5
-1.5 1.5
-1.5 1.5
ITEM: ATOMS id type radius x
1 1 0.33333333333333331 -1
2 1 0.5 1e-300
ITEM: TIMESTEP
2500
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS ff ff ff
-1 1
-1 1
-1 1
ITEM: ATOMS id type radius x
2 1 0.5 -0.10000000000000001
"""
CONTACTS = """\
ITEM: TIMESTEP
0
ITEM: NUMBER OF CONTACTS
0
ITEM: BOX BOUNDS pp pp pp
-1.5 1.5
-1.5 1.5
-1.5 1.5
ITEM: CONTACTS id1 id2 branch
ITEM: TIMESTEP
2500
ITEM: NUMBER OF CONTACTS
1
ITEM: BOX BOUNDS pp pp pp
-1 1
-1 1
-1 1
ITEM: CONTACTS id1 id2 branch
7 3 0.75
"""


def parsed(text):
    """Return the atom count, the bounds and the rows of a data file, read word by word."""
    header, _, body = text.partition("Atoms # sphere")
    words = [line.split() for line in header.splitlines()[1:] if line]
    bounds = {line[2]: (float(line[0]), float(line[1])) for line in words if len(line) == 4}
    counts = {" ".join(line[1:]): int(line[0]) for line in words if len(line) < 4}
    rows = [line.split() for line in body.splitlines()[1:] if line]
    return counts, bounds, rows


@settings(deadline=None, max_examples=30)
@given(st.integers(1, 30), st.integers(0, 2**32), st.floats(1e-9, 1e3))
def test_data_file_holds_every_digit_of_the_packing(tmp_path_factory, grains, seed, edge):
    rng = np.random.default_rng(seed)
    radii = rng.uniform(0.005, 0.1, grains) * edge
    positions = rng.uniform(-0.5, 0.5, (grains, 3)) * edge
    path = tmp_path_factory.mktemp("data") / "packing.data"
    # The edge as NumPy gives it: its own text would not be a number to LAMMPS.
    write_data_file(path, positions, radii, np.float64(edge))
    counts, bounds, rows = parsed(path.read_text())
    assert counts == {"atoms": grains, "atom types": 1}
    half = edge / 2
    assert bounds == {"xlo": (-half, half), "ylo": (-half, half), "zlo": (-half, half)}
    assert [row[:2] for row in rows] == [[str(n), "1"] for n in range(1, grains + 1)]
    values = np.array([[float(word) for word in row[2:]] for row in rows])
    # diameter, density, x, y, z: doubling a radius is exact.
    assert_array_equal(values[:, 0], 2 * radii)
    assert_array_equal(values[:, 1], 1.0)
    assert_array_equal(values[:, 2:], positions)


def test_first_line_of_a_data_file_is_a_title(tmp_path):
    # LAMMPS skips it, whatever it holds.
    write_data_file(tmp_path / "packing.data", [[0.0, 0.0, 0.0]], [0.5], 2.0)
    assert (tmp_path / "packing.data").read_text().startswith("branchcrush packing, SI units\n\n")


def test_lines_of_a_packing_of_many_portions_are_those_written_one_by_one(tmp_path):
    rng = np.random.default_rng(2)
    radii, positions = 10.0 ** rng.uniform(-8, 2, 20_001), rng.normal(size=(20_001, 3))
    # Where Python's notation changes, and a zero with a sign.
    positions[:3] = [[1e-5, 1e-4, -0.0], [1e16, 1e15, 5e-324], [0.1 + 0.2, 1.0, -1e300]]
    write_data_file(tmp_path / "packing.data", positions, radii, 2.0)
    text = (tmp_path / "packing.data").read_text()
    assert text.endswith("\n")
    lines = text.splitlines()[-20_001:]
    assert lines[0] == f"1 1 {2 * float(radii[0])!r} 1.0 1e-05 0.0001 -0.0"
    assert lines[1:] == [
        " ".join([str(n), "1", repr(2.0 * float(radius)), "1.0", *(repr(float(x)) for x in place)])
        for n, radius, place in zip(range(2, 20_002), radii[1:], positions[1:], strict=True)
    ]


def test_columns_of_a_table_are_written_whatever_their_layout(tmp_path):
    positions = np.asfortranarray(np.arange(6.0).reshape(2, 3))
    write_data_file(tmp_path / "arrays", positions, np.array([0.5, 1.0, 2.0])[::2], 2.0)
    write_data_file(tmp_path / "lists", [[0, 1, 2], [3, 4, 5]], [0.5, 2], 2)
    assert (tmp_path / "arrays").read_text() == (tmp_path / "lists").read_text()


def test_radii_and_positions_must_be_of_one_number(tmp_path):
    with pytest.raises(ValueError, match="shorter"):
        write_data_file(tmp_path / "packing.data", [[0.0, 0.0, 0.0]], [0.5, 0.5], 2.0)
    assert not (tmp_path / "packing.data").exists()


def dump(folder, text, compressed):
    path = folder / ("particles.dump.gz" if compressed else "particles.dump")
    path.write_bytes(gzip.compress(text.encode()) if compressed else text.encode())
    return path


def frames_of(path):
    return map(pd.DataFrame, read_dump(path))


def frame_text(columns, rows, label="ATOMS"):
    """Return a frame as LAMMPS prints it: 17 digits, and local data with a space at the end."""
    end = "" if label == "ATOMS" else " "
    head = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF {label}\n{len(rows)}\nITEM: BOX BOUNDS ff ff ff\n"
    lines = [" ".join(f"{value:.17g}" for value in row) + end for row in rows]
    names = f"ITEM: {label} {' '.join(columns)}"
    return head + "-1 1\n" * 3 + "\n".join([names, *lines]) + "\n"


either = pytest.mark.parametrize("compressed", [False, True], ids=["plain", "gz"])


@either
def test_dump_is_read_frame_by_frame_with_its_columns(tmp_path, compressed):
    first, second = frames_of(dump(tmp_path, ATOMS, compressed))
    assert list(first) == list(second) == ["id", "type", "radius", "x"]
    assert first["id"].tolist() == [1.0, 2.0]
    assert first["radius"].tolist() == [1 / 3, 0.5]
    assert first["x"].tolist() == [-1.0, 1e-300]
    assert second.to_numpy().tolist() == [[2.0, 1.0, 0.5, -0.1]]


@either
def test_frame_without_contacts_keeps_its_columns(tmp_path, compressed):
    first, second = frames_of(dump(tmp_path, CONTACTS, compressed))
    assert list(first) == ["id1", "id2", "branch"]
    assert len(first) == 0
    assert first["branch"].dtype == float
    assert second.to_numpy().tolist() == [[7.0, 3.0, 0.75]]


@pytest.mark.parametrize("empty", [0, 1, 2], ids=["first", "middle", "last"])
def test_frames_follow_one_without_rows_wherever_it_is(tmp_path, empty):
    parts = [frame_text(["id1", "force"], [[k, k / 3]] * k, "BONDS") for k in (1, 2)]
    parts.insert(empty, frame_text(["id1", "force"], [], "BONDS"))
    read = [frame.to_numpy().tolist() for frame in frames_of(dump(tmp_path, "".join(parts), True))]
    expected = [[[1, 1 / 3]], [[2, 2 / 3]] * 2]
    expected.insert(empty, [])
    assert read == expected


def test_path_may_be_text(tmp_path):
    assert len(list(frames_of(str(dump(tmp_path, ATOMS, compressed=True))))) == 2


def test_dump_without_frames_has_none(tmp_path):
    assert list(frames_of(dump(tmp_path, "", compressed=True))) == []


@settings(deadline=None, max_examples=50)
@given(
    st.lists(st.lists(st.tuples(st.floats(), st.floats(), st.integers(0, 2**53)), max_size=5)),
    st.sampled_from(["ATOMS", "BONDS"]),
)
def test_numbers_are_those_that_python_reads(tmp_path_factory, frames, label):
    text = "".join(frame_text(["x", "fx", "id"], rows, label) for rows in frames)
    path = dump(tmp_path_factory.mktemp("dump"), text, compressed=True)
    read = list(frames_of(path))
    assert len(read) == len(frames)
    for frame, rows in zip(read, frames, strict=True):
        printed = [float(f"{value:.17g}") for row in rows for value in row]
        expected, values = np.reshape(printed, (-1, 3)), frame.to_numpy()
        assert_array_equal(values, expected)
        # Zeros of either sign are equal, but not the same.
        zeros = values == 0
        assert_array_equal(np.signbit(values[zeros]), np.signbit(expected[zeros]))


def test_frame_of_many_portions_is_read_whole_and_in_order(tmp_path):
    rng = np.random.default_rng(4)
    values = np.column_stack([np.arange(20_001), rng.normal(size=20_001) * 1e-3])
    text = frame_text(["id1", "force"], values.tolist(), "BONDS")
    first, second = frames_of(dump(tmp_path, text * 2, compressed=True))
    assert_array_equal(first.to_numpy(), values)
    assert_array_equal(second.to_numpy(), values)


def test_frame_is_there_before_the_next_one_is_read(tmp_path):
    frames = frames_of(dump(tmp_path, ATOMS + "what follows is no frame\n", compressed=True))
    assert [len(next(frames)), len(next(frames))] == [2, 1]
    with pytest.raises(ValueError):
        next(frames)


def test_frame_that_nobody_holds_is_let_go(tmp_path):
    frames = frames_of(dump(tmp_path, ATOMS, compressed=True))
    held = weakref.ref(next(frames))
    assert held() is None


@pytest.mark.parametrize(
    "text, message",
    [
        (ATOMS.rsplit(" ", 1)[0], "breaks off"),  # within a line
        (ATOMS[:-1], "breaks off"),  # perhaps within a number
        (ATOMS.rsplit("\n", 2)[0] + "\n", "breaks off"),  # a line short
        (ATOMS.rsplit("ITEM: ATOMS", 1)[0], "breaks off"),  # within the header
        (ATOMS.rsplit(" ", 1)[0] + "\n", "4 columns, got 3"),
        (ATOMS.replace("0.33333333333333331 ", ""), "4 columns, got 3"),
        (ATOMS.replace("2 1 0.5 1e-300", ""), "invalid value ''"),
        (ATOMS.replace("1e-300", "1e-300 2"), "4 columns, got 5"),
        (ATOMS.replace("1e-300", "1e-3oo"), "1e-3oo"),
        (ATOMS.replace("1e-300", "ERROR"), "ERROR"),
    ],
)
def test_dump_that_is_not_whole_is_refused(tmp_path, text, message):
    with pytest.raises(ValueError, match=message):
        list(frames_of(dump(tmp_path, text, compressed=False)))


def test_gzip_that_breaks_off_is_refused(tmp_path):
    path = dump(tmp_path, ATOMS, compressed=True)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(OSError, match="Truncated"):
        list(frames_of(path))


def test_compressed_dump_is_one_stream_whose_bytes_do_not_tell_when(tmp_path):
    # OVITO reads the first stream of a file and believes that there is no other frame. More than
    # one portion of it, so that portions are no streams.
    text = ATOMS.encode() * 5000
    (tmp_path / "pairs.dump").write_bytes(text)
    for name, time in (("one", 1e9), ("other", 1.5e9)):
        os.utime(tmp_path / "pairs.dump", (time, time))
        compress_file(tmp_path / "pairs.dump", tmp_path / name)
    stream = zlib.decompressobj(wbits=31)
    assert stream.decompress((tmp_path / "one").read_bytes()) == text
    assert stream.eof
    assert stream.unused_data == b""
    assert (tmp_path / "one").read_bytes() == (tmp_path / "other").read_bytes()
    # The header holds no time and no name.
    assert (tmp_path / "one").read_bytes()[3:8] == bytes(5)
