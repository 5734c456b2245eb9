"""LAMMPS files: what is written holds every digit, what is read is what the file says."""

import gzip

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from branchcrush.lammps_files import read_dump, write_data_file

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


@pytest.mark.parametrize("compressed", [False, True], ids=["plain", "gz"])
def test_dump_is_read_frame_by_frame_with_its_columns(tmp_path, compressed):
    first, second = read_dump(dump(tmp_path, ATOMS, compressed))
    assert list(first.columns) == list(second.columns) == ["id", "type", "radius", "x"]
    assert first["id"].tolist() == [1.0, 2.0]
    assert first["radius"].tolist() == [1 / 3, 0.5]
    assert first["x"].tolist() == [-1.0, 1e-300]
    assert second.to_numpy().tolist() == [[2.0, 1.0, 0.5, -0.1]]


@pytest.mark.parametrize("compressed", [False, True], ids=["plain", "gz"])
def test_frame_without_contacts_keeps_its_columns(tmp_path, compressed):
    first, second = read_dump(dump(tmp_path, CONTACTS, compressed))
    assert list(first.columns) == ["id1", "id2", "branch"]
    assert len(first) == 0
    assert second.to_numpy().tolist() == [[7.0, 3.0, 0.75]]


def test_path_may_be_text(tmp_path):
    assert len(read_dump(str(dump(tmp_path, ATOMS, compressed=True)))) == 2


def test_dump_that_breaks_off_within_a_line_is_refused(tmp_path):
    with pytest.raises(ValueError, match="reshape"):
        read_dump(dump(tmp_path, ATOMS.rsplit(" ", 1)[0], compressed=False))
