"""Files that are damaged, or not what they are said to be: every one is named, none guessed."""

import gzip
import re
import tracemalloc

import pyarrow as pa
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from branchcrush.errors import ReadingError
from branchcrush.readers.packing import read_frames
from branchcrush.readers.texts import text_of
from tests.unit.readers.conftest import CASES, DATA, source_of_case


def refused(source):
    """Return the problems of files, one a line."""
    with pytest.raises(ReadingError) as caught:
        read_frames(source)
    lines = str(caught.value).splitlines()
    assert all(lines)
    return lines


def edited(tmp_path, name, which, edit):
    """Return a case one of whose files is edited, line by line."""
    place = 2 if which == "grains" else 3
    path = DATA / CASES[name][0] / CASES[name][place]
    lines = path.read_text().splitlines()
    copy = tmp_path / path.name
    copy.write_text("\n".join(edit(lines)) + "\n")
    return source_of_case(name, **{which: [copy]})


PLAIN = [name for name in CASES if not name.startswith("lammps")] + ["lammps_scaled"]


@pytest.mark.parametrize("which", ["grains", "contacts"])
@pytest.mark.parametrize("name", PLAIN)
@settings(
    max_examples=6, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_a_file_that_breaks_off_anywhere_is_refused(name, which, data, tmp_path):
    place = 2 if which == "grains" else 3
    path = DATA / CASES[name][0] / CASES[name][place]
    text = path.read_text()
    # Within the last frame, and not in its last number, of which no one can tell that it is cut.
    end = text.rstrip().rindex("\n")
    start = text.rindex("ITEM: TIMESTEP") + 20 if text.startswith("ITEM") else len(text) // 4
    cut = data.draw(st.integers(start, end - 1))
    copy = tmp_path / path.name
    copy.write_text(text[:cut])
    source = source_of_case(name, **{which: [copy]})
    if copy.suffix == ".csv" and which == "contacts" and end - cut < 100:
        # One contact may have been a light one; but that the last line has no end is told.
        try:
            notes = read_frames(source).notes
        except ReadingError as error:
            notes = [str(error)]
        assert any(copy.name in note for note in notes)
        return
    lines = refused(source)
    assert any(copy.name in line or "contacts" in line for line in lines)


@pytest.mark.parametrize("name", ["liggghts", "yade", "pfc"])
def test_a_contact_given_twice_is_named_by_its_grains(name, tmp_path):
    source = edited(tmp_path, name, "contacts", lambda lines: _counted([*lines, lines[-3]], 1))
    (line,) = refused(source)
    assert re.search(r"1 of 187 contacts stand more than once, such as \d+ and \d+", line)


def _counted(lines, more):
    """Return the lines of a dump with the number of its last frame's rows as they are."""
    return [str(int(line) + more) if line == "187" else line for line in lines]


def test_pairs_in_both_directions_have_to_be_declared(tmp_path):
    def both(lines):
        rows = [line.split(",") for line in lines[1:]]
        swapped = [
            ",".join([a, c, b, *rest[:3], *(str(-float(f)) for f in rest[3:6]), rest[6]])
            for a, b, c, *rest in rows
        ]
        return [*lines, *swapped]

    source = edited(tmp_path, "pfc", "contacts", both)
    assert "all of them: say packing.each_pair: twice" in refused(source)[0]
    again = edited(tmp_path, "pfc", "contacts", both)
    again = source_of_case("pfc", contacts=again.contacts, each_pair="twice")
    assert len(read_frames(again).moments[0].touching.i) == 187
    once = refused(source_of_case("pfc", each_pair="twice"))
    assert "no contact of 187 stands twice: say packing.each_pair: once" in once[0]


def test_a_pair_of_mercurydpm_that_stands_once_is_named(tmp_path):
    source = edited(tmp_path, "mercurydpm", "contacts", lambda lines: lines[:-2])
    assert "1 of 187 contacts do not stand exactly twice" in refused(source)[0]


def test_a_grain_that_is_missing_is_named_by_its_id():
    lost = DATA / "30-lammps-custom-and-local" / "grains_one_lost.dump"
    (line,) = refused(source_of_case("lammps", grains=[lost]))
    assert "9 contacts join grains that are not in the file of grains, ids 7" in line


def test_other_ids_than_those_of_the_grains_are_not_taken_for_them(tmp_path):
    # Counted from 0 where the grains count from 1: 101 becomes 100, and all are others.
    def shifted(lines):
        rows = [line.split(",") for line in lines[1:]]
        return [lines[0], *(",".join([a, str(int(b) - 1), str(int(c) - 1), *r])
                            for a, b, c, *r in rows)]  # fmt: skip

    lines = refused(edited(tmp_path, "pfc", "contacts", shifted))
    assert "ids 100" in lines[0]
    # Exchanged: every id has a grain.
    exchanged = edited(
        tmp_path, "pfc", "contacts",
        lambda lines: [lines[0], *(re.sub(r"^(\d+),107,", r"\1,108,", each) for each in lines[1:])],
    )  # fmt: skip
    assert "push each other and do not touch" in refused(exchanged)[0]


def test_contacts_that_are_left_out_are_missed(tmp_path):
    lines = refused(edited(tmp_path, "pfc", "contacts", lambda lines: lines[:-9]))
    assert re.search(r"\d pairs of grains overlap and have no contact \(178 have one\)", lines[0])


def test_diameters_for_radii_and_a_wrong_cell_are_noticed():
    halves = source_of_case(
        "pfc", grain_columns={"id": "id", "position": ["x", "y", "z"], "diameter": "radius"}
    )
    assert "sizes radii (not diameters)" in refused(halves)[0]
    assert "correct boundary" in refused(source_of_case("liggghts", periodic=False))[0]
    assert "give packing.cell" in refused(source_of_case("pfc", low=None, high=None))[0]


def test_attraction_is_refused(tmp_path):
    pulled = edited(
        tmp_path, "pfc_ends", "contacts",
        lambda lines: [*lines[:-1], lines[-1].rpartition(",")[0] + ",-1.5"],
    )  # fmt: skip
    assert "1 of 187 contacts pull" in refused(pulled)[0]


def test_columns_and_keywords_that_do_not_fit_name_what_there_is():
    wrong = source_of_case("pfc", columns={"id1": "ball1", "id2": "end2", "normal_force": "fx"})
    assert "no column ball1; its header has id, end1, end2" in refused(wrong)[0]
    keywords = source_of_case("liggghts_places", keywords=("pos", "id", "force"))
    assert "it has 18 columns, and the keywords pos, id, force" in refused(keywords)[0]
    assert "packing.columns is needed" in refused(source_of_case("lammps", columns=None))[0]


def test_what_is_no_such_file_at_all_is_told(tmp_path):
    other = DATA / "34-pfc-csv" / "balls.csv"
    assert "is no LAMMPS text dump" in refused(source_of_case("liggghts", grains=[other]))[0]
    assert (
        "is no .fstat of MercuryDPM" in refused(source_of_case("mercurydpm", contacts=[other]))[0]
    )
    binary, empty = tmp_path / "a.dump", tmp_path / "b.dump"
    binary.write_bytes(b"\xff\x00\xfe" * 10)
    empty.write_text("\n")
    assert "is no text" in refused(source_of_case("liggghts", grains=[binary]))[0]
    assert "is empty" in refused(source_of_case("liggghts", grains=[empty]))[0]
    packed = tmp_path / "c.dump.gz"
    packed.write_bytes((DATA / CASES["lammps"][0] / CASES["lammps"][2]).read_bytes()[:-200])
    assert "c.dump.gz" in refused(source_of_case("lammps", grains=[packed]))[0]


@pytest.mark.parametrize(("end", "kind"), [("gz", "gzip"), ("zst", "zstd"), ("bz2", "bz2")])
def test_a_small_file_that_would_fill_the_memory_is_refused_before_it_does(end, kind, tmp_path):
    packed = tmp_path / f"grains.{end}"
    with pa.CompressedOutputStream(str(packed), kind) as file:
        for _ in range(40):
            file.write(b"0" * 1_000_000)
    assert packed.stat().st_size < 50_000
    tracemalloc.start()
    try:
        with pytest.raises(ReadingError, match=rf"grains.{end}: unpacks to more than 200 times"):
            text_of(packed)
        assert tracemalloc.get_traced_memory()[1] < 25e6
    finally:
        tracemalloc.stop()


def test_a_packed_text_is_held_no_more_than_twice_while_it_is_read(tmp_path):
    packed = tmp_path / "grains.gz"
    text = "".join(f"{number} 0.5 0.25\n" for number in range(200_000))
    packed.write_bytes(gzip.compress(text.encode()))
    tracemalloc.start()
    try:
        assert text_of(packed) == text
        assert tracemalloc.get_traced_memory()[1] < 2.3 * len(text) + 2e6
    finally:
        tracemalloc.stop()


def test_frames_without_a_partner_or_with_other_grains_are_told(tmp_path):
    later = edited(
        tmp_path, "liggghts", "grains",
        lambda lines: ["9" if line == "1000" else line for line in lines],
    )  # fmt: skip
    assert "have no step in common, grains 9, contacts 500, 1000" in refused(later)[0]
