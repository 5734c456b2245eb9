"""One packing of 60 grains and 187 contacts in the layouts of five codes: one answer of all."""

import gzip

import numpy as np
import pyarrow as pa
import pytest

from branchcrush.errors import ReadingError
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.readers.layouts import Source
from branchcrush.readers.packing import read_frames
from branchcrush.readers.report import reading_report
from branchcrush.readers.states import packing_tables
from tests.unit.readers.conftest import CASES, DATA, source_of_case

# That of the run: 70 GPa and 0.17.
LAW = HertzContact.of_material(70.0e9, 0.17)
EDGE = 0.0057612051811251203
# What digits each has, and so how far from the answer it may be, of an overlap 30 times more.
FEW = {"lammps_scaled", "liggghts", "liggghts_places", "yade", "yade_vtk", "yade_text"}


def told(name):
    """Return the state of a case, and its contacts by the two ids of the answer."""
    moment = read_frames(source_of_case(name)).moments[-1]
    touching = moment.touching
    # The answer counts grains from 1, in the order of each file's ids.
    pairs = zip((touching.i + 1).tolist(), (touching.j + 1).tolist(), strict=True)
    return moment, {pair: row for row, pair in enumerate(pairs)}


@pytest.mark.parametrize("name", CASES)
def test_every_layout_gives_the_same_contacts_to_the_digits_that_it_has(name, expected):
    moment, rows = told(name)
    touching = moment.touching
    assert set(rows) == set(expected)
    assert len(touching.i) == len(expected) == 187
    near = 1e-5 if name in FEW else 1e-8
    # Forces have six digits in one of the files of LAMMPS as well.
    forces = near if name != "lammps" else 1e-5
    for pair, row in rows.items():
        answer = expected[pair]
        assert touching.normal_force[row] == pytest.approx(answer["force_N"], rel=forces)
        length = np.linalg.norm(touching.vector[row])
        assert length == pytest.approx(answer["branch_length_m"], rel=near)
        assert touching.overlap[row] == pytest.approx(answer["overlap_m"], abs=3e-8, rel=near)
        # The force on the first grain pushes it away from the second.
        on_first = np.array([answer[f"f{axis}_on_1"] for axis in "xyz"])
        along = touching.vector[row] if pair[0] == answer["id1"] else -touching.vector[row]
        assert -on_first @ along == pytest.approx(answer["force_N"] * length, rel=1e-4)


@pytest.mark.parametrize("name", CASES)
def test_the_tables_hold_energies_of_the_forces_and_a_packing_at_rest(name, expected):
    read = read_frames(source_of_case(name))
    tables = packing_tables(read, LAW)
    last = tables.contacts["state"] == tables.path["state"][-1]
    stiffness = LAW.stiffness
    reduced = [1.0 / (1.0 / a["radius1_m"] + 1.0 / a["radius2_m"]) for a in expected.values()]
    forces = np.array([answer["force_N"] for answer in expected.values()])
    # E = (2/5) F delta, and delta from F = k sqrt(R*) delta^(3/2).
    energy = 0.4 * forces * (forces / (stiffness * np.sqrt(reduced))) ** (2.0 / 3.0)
    assert tables.contacts["energy_J"][last].sum() == pytest.approx(energy.sum(), rel=1e-5)
    path = {column: values[-1] for column, values in tables.path.items()}
    assert path["volume_m3"] == pytest.approx(EDGE**3, rel=1e-9)
    assert path["mean_stress_Pa"] == pytest.approx(
        sum(a["force_N"] * a["branch_length_m"] for a in expected.values()) / (3 * EDGE**3),
        rel=1e-3,
    )
    assert path["carries_load"] and path["coordination_number"] == pytest.approx(2 * 187 / 60)
    # MercuryDPM's case has a wall that pushes one grain, against nothing.
    assert path["unbalanced_force_ratio"] < (1e-3 if name == "mercurydpm" else 1e-4)
    assert np.isnan(path["work_J"]) and np.isnan(path["boundary_stress_Pa"])


def test_few_digits_are_told_with_what_they_do_to_overlaps():
    few = reading_report(read_frames(source_of_case("yade_vtk")), LAW, [])
    many = reading_report(read_frames(source_of_case("lammps_named")), LAW, [])
    assert few["digits"] == 6 and few["overlap_error"] == pytest.approx(4e-3, rel=0.5)
    assert any("6 significant digits" in note for note in few["notes"])
    assert many["digits"] == 17 and many["notes"] == []
    assert many["force_by_law"] == pytest.approx(1.0, rel=1e-6)


def test_a_law_other_than_that_of_the_run_is_told_by_its_factor():
    softer = HertzContact.of_material(35.0e9, 0.17)
    report = reading_report(read_frames(source_of_case("pfc")), softer, [])
    assert report["force_by_law"] == pytest.approx(0.5, rel=1e-3)
    assert "makes 0.5 times the forces" in report["notes"][0]


def test_virtual_contacts_and_first_frames_without_contacts_are_left_out_and_counted():
    yade = reading_report(read_frames(source_of_case("yade")), LAW, [])
    assert "1 virtual contacts were left out" in yade["notes"]
    scaled = read_frames(source_of_case("lammps_scaled"))
    assert len(scaled.moments) == 1
    assert "a first frame without contacts" in scaled.notes[0]


def test_walls_are_in_the_stress_and_no_branches():
    read = read_frames(source_of_case("mercurydpm"))
    tables = packing_tables(read, LAW)
    assert tables.walls["normal_force_N"].tolist() == [0.5]
    assert tables.walls["wall"].tolist() == ["-1"]
    assert tables.walls["direction_x"].tolist() == [-1.0]
    without = packing_tables(read_frames(source_of_case("pfc")), LAW).path["mean_stress_Pa"][0]
    radius = read.moments[0].grains.radii[tables.walls["i"][0]]
    more = 0.5 * (radius - 1e-7) / (3 * EDGE**3)
    assert tables.path["mean_stress_Pa"][0] - without == pytest.approx(more, rel=1e-3)


def test_grains_touch_through_the_face_of_a_tilted_cell(tmp_path):
    contact = tmp_path / "contacts.local"
    contact.write_text(
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: ENTRIES i j f\n1 2 2\n"
    )
    grains = DATA / "30-lammps-custom-and-local" / "three_grains_triclinic.dump"
    columns = {"id1": "i", "id2": "j", "normal_force": "f"}
    source = Source(
        format="lammps", grains=[grains], contacts=[contact], periodic=True, columns=columns
    )
    read = read_frames(source)
    moment = read.moments[0]
    assert moment.touching.overlap.tolist() == pytest.approx([0.1])
    assert moment.cell.volume == pytest.approx(1000.0)
    report = reading_report(read, LAW, [])
    assert report["cells_m"] == [[[10, 0, 0], [4, 10, 0], [0, 0, 10]]]
    assert report["periodic"] == [True, True, True]
    # Without its tilt they are far from each other.
    straight = tmp_path / "straight.dump"
    straight.write_text(
        grains.read_text()
        .replace("xy xz yz ", "")
        .replace("0 14 4", "0 10")
        .replace("0 10 0", "0 10")
    )
    with pytest.raises(ReadingError, match="push each other and do not touch"):
        read_frames(Source(format="lammps", grains=[straight], contacts=[contact], periodic=True,
                           columns=columns))  # fmt: skip


def test_packed_files_and_files_of_single_frames_are_read(tmp_path):
    folder, plain = DATA / "31-liggghts-pair-gran-local", "grains.dump"
    data = (folder / plain).read_bytes()
    (tmp_path / "a.gz").write_bytes(gzip.compress(data))
    (tmp_path / "a.zst").write_bytes(pa.compress(data, "zstd", asbytes=True))
    for name in ("a.gz", "a.zst"):
        read = read_frames(source_of_case("liggghts", grains=[tmp_path / name]))
        assert read.moments[0].grains.ids.size == 60
    # A second frame, in a file of its own: 1 % larger in every direction and in force.
    later = tmp_path / "later.dump"
    later.write_bytes(data.replace(b"\n1000\n", b"\n2000\n", 1))
    contacts = (folder / "fc_default_and_delta.dump").read_bytes()
    (tmp_path / "later_fc.dump").write_bytes(contacts.replace(b"\n1000\n", b"\n2000\n", 1))
    read = read_frames(
        source_of_case(
            "liggghts",
            grains=[later, folder / plain],
            contacts=[folder / "fc_default_and_delta.dump", _last_frame(tmp_path)],
        )
    )
    assert [moment.step for moment in read.moments] == [1000.0, 2000.0]
    tables = packing_tables(read, LinearContact(1e6))
    assert tables.path["state"].tolist() == [0, 1]
    assert np.bincount(tables.contacts["state"]).tolist() == [187, 187]


def _last_frame(folder):
    text = (folder / "later_fc.dump").read_text()
    (folder / "last_fc.dump").write_text(text[text.rindex("ITEM: TIMESTEP") :])
    return folder / "last_fc.dump"
