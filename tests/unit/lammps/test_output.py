"""What a run leaves becomes tables: two grains whose forces are known, in four states."""

import subprocess
import sys
import weakref

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import SimulationError
from branchcrush.lammps import output as lammps_output
from branchcrush.lammps.output import DUMPS, Compression, read_compression

STIFFNESS = 10.0
VARIABLES = {
    "law": "linear",
    "stiffness": STIFFNESS,
    "boundary": "walls",
    "control": "edge",
    "targets": [3.5, 4.0],
}
# Grains of radius 1 on the x axis. Edge of the cell and their distance: placed, the end of the
# approach, pressed together between two walls, and let go again.
EDGES, DISTANCES = (8.0, 4.5, 3.5, 4.0), (4.0, 2.5, 1.75, 2.0)
WORK = (0.0, 0.0, 0.75, 0.25)
ATOMS = "id type radius x y z fx fy fz v_wall_fx v_wall_fy v_wall_fz mass"
BONDS = "id1 id2 branch branch_x branch_y branch_z force force_x force_y force_z"


def frame(label, columns, rows):
    bounds = "ITEM: BOX BOUNDS ff ff ff\n" + "-1 1\n" * 3
    head = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF {label}\n{len(rows)}\n{bounds}"
    return head + "\n".join([f"ITEM: {label} {columns}", *rows]) + "\n"


def particles(edge, distance):
    pushed = STIFFNESS * max(0.0, 1.0 + distance / 2 - edge / 2)
    rows = (
        f"{n} 1 1 {side * distance / 2:.17g} 0 0 0 0 0 {-side * pushed:.17g} 0 0 4"
        for n, side in ((1, -1), (2, 1))
    )
    return frame("ATOMS", ATOMS, list(rows))


def pairs(distance, times=1):
    force = f"{STIFFNESS * (2.0 - distance):.17g}"
    row = f"2 1 {distance} {distance} 0 0 {force} {force} 0 0 "
    return frame("BONDS", BONDS, [row] * times if distance < 2 else [])


@pytest.fixture
def folder(tmp_path):
    """The output of a run."""
    head = "state,step,evaluations,edge,work,mean_stress,unbalanced,kinetic_energy,pair_pressure"
    lines = [
        f"{state},{state},{10 * state},{edge},{work},0,0,0,7,0,0"
        for state, (edge, work) in enumerate(zip(EDGES, WORK, strict=True))
    ]
    (tmp_path / "states.csv").write_text("\n".join([f"{head},escaped,lost", *lines]) + "\n")
    (tmp_path / "steps.csv").write_text(
        "step,evaluations,edge,work,mean_stress,unbalanced,contacts\n0,10,4.5,0,0,0,0\n"
        "1,20,3.5,0.75,0.2,1e-6,1\n2,30,4,0.25,0,0,0\n"
    )
    write(tmp_path, [particles(*state) for state in zip(EDGES, DISTANCES, strict=True)], 0)
    write(tmp_path, [pairs(distance) for distance in DISTANCES], 1)
    return tmp_path


def write(folder, frames, dump):
    (folder / DUMPS[dump]).write_text("".join(frames), encoding="ascii")


def tables_of(*run):
    return Compression(*map(pd.DataFrame, read_compression(*run)))


def test_contacts_have_a_row_for_each_contact_and_state(folder):
    contacts = tables_of(folder, VARIABLES, "").contacts
    assert contacts.to_dict("list") == {
        "state": [2],
        "i": [0],
        "j": [1],
        "radius_i_m": [1.0],
        "radius_j_m": [1.0],
        "branch_length_m": [1.75],
        "branch_x": [1.75],
        "branch_y": [0.0],
        "branch_z": [0.0],
        "overlap_m": [0.25],
        "normal_force_N": [2.5],
        "energy_J": [2.5**2 / (2 * STIFFNESS)],
    }


def test_walls_have_a_row_for_each_contact_and_state(folder):
    walls = tables_of(folder, VARIABLES, "").walls
    assert walls.to_dict("list") == {
        "state": [2, 2],
        "i": [0, 1],
        "wall": ["-x", "+x"],
        "direction_x": [-1.0, 1.0],
        "direction_y": [0.0, 0.0],
        "direction_z": [0.0, 0.0],
        "overlap_m": [0.125, 0.125],
        "normal_force_N": [1.25, 1.25],
    }


def test_grains_are_told_at_the_end_of_the_loading_and_not_of_the_way_back(folder):
    assert tables_of(folder, VARIABLES, "").compressed.to_dict("list") == {
        "x_m": [-0.875, 0.875],
        "y_m": [0.0, 0.0],
        "z_m": [0.0, 0.0],
        "radius_m": [1.0, 1.0],
    }


def test_kinds_of_columns_are_those_of_numbers_counts_and_words(folder):
    result = tables_of(folder, VARIABLES, "")
    kinds = {name: str(kind) for name, kind in result.contacts.dtypes.items()}
    assert {kinds.pop(name) for name in ("state", "i", "j")} == {"int64"}
    assert set(kinds.values()) == {"float64"}
    assert [str(kind) for kind in result.walls.dtypes] == [
        "int64",
        "int64",
        "str",
        *["float64"] * 5,
    ]


def test_tables_without_a_contact_have_the_same_columns(folder):
    some = tables_of(folder, VARIABLES, "")
    # Two grains apart in a cell that they do not touch.
    write(folder, [particles(8.0, 4.0)] * 4, 0)
    write(folder, [pairs(4.0)] * 4, 1)
    none = tables_of(folder, VARIABLES, "")
    assert len(none.contacts) == len(none.walls) == 0
    for table in ("contacts", "walls"):
        assert getattr(none, table).dtypes.equals(getattr(some, table).dtypes)


def test_path_has_a_row_for_each_state(folder):
    path = tables_of(folder, VARIABLES, "").path
    assert path["state"].tolist() == [0, 1, 2, 3]
    assert path["force_evaluations"].tolist() == [0, 10, 20, 30]
    assert_allclose(path["volume_m3"], np.array(EDGES) ** 3)
    assert_allclose(path["linear_strain"], 1 - np.array(EDGES) / 8.0)
    # A contact of the two, and each with a wall.
    assert_allclose(path["elastic_energy_J"], [0, 0, 2.5**2 / 20 + 2 * 1.25**2 / 20, 0])
    assert path["coordination_number"].tolist() == [0, 0, 1, 0]


def test_stress_at_the_boundary_is_that_on_the_walls_if_there_are_any(folder):
    # Two forces of 1.25 on six faces of 3.5 by 3.5.
    walls = tables_of(folder, VARIABLES, "").path
    assert_allclose(walls["boundary_stress_Pa"], [0, 0, 2.5 / (6 * 3.5**2), 0])
    # What LAMMPS says of all pairs.
    periodic = tables_of(folder, VARIABLES | {"boundary": "periodic"}, "").path
    assert periodic["boundary_stress_Pa"].tolist() == [7, 7, 7, 7]


@pytest.mark.parametrize("control, sign", [("edge", 1), ("stress", -1)])
def test_states_beyond_the_furthest_target_unload(folder, control, sign):
    variables = VARIABLES | {"control": control, "targets": [sign * 3.5, sign * 4.0]}
    path = tables_of(folder, variables, "").path
    assert path["leg"].tolist() == ["loading"] * 3 + ["unloading"]


def test_last_state_says_why_a_run_stopped(folder):
    path = tables_of(folder, VARIABLES, "a grain escaped").path
    assert path["stopped"].tolist() == ["", "", "", "a grain escaped"]


def test_work_counts_from_what_the_approach_put_in(folder):
    free = tables_of(folder, VARIABLES, "")
    assert free.path["work_J"].tolist() == list(WORK)
    # The same, but for an end of the approach at which the two touch.
    write(folder, [pairs(distance) for distance in (4.0, 1.75, 1.75, 2.0)], 1)
    held = tables_of(folder, VARIABLES, "")
    energy = held.path["elastic_energy_J"][1]
    assert energy == 2.5**2 / 20
    assert_allclose(held.path["work_J"] - free.path["work_J"], [0, energy, energy, energy])
    assert_allclose(held.path["dissipated_J"], held.path["work_J"] - held.path["elastic_energy_J"])
    assert_allclose(held.steps["work_J"], free.steps["work_J"] + energy)


def test_steps_have_units_and_the_solid_fraction(folder):
    steps = tables_of(folder, VARIABLES, "").steps
    assert_allclose(steps["volume_m3"], np.array(EDGES[1:]) ** 3)
    assert_allclose(steps["solid_fraction"] * steps["volume_m3"], 2 * 4 / 3 * np.pi)
    assert steps["mean_stress_Pa"].tolist() == [0, 0.2, 0]
    assert steps["work_J"].tolist() == [0, 0.75, 0.25]
    assert steps["unbalanced_force_ratio"].tolist() == [0, 1e-6, 0]
    assert steps["step"].tolist() == [0, 1, 2] and steps["contacts"].tolist() == [0, 1, 0]
    assert steps["force_evaluations"].tolist() == [10, 20, 30]


@pytest.mark.parametrize("dump", [0, 1], ids=DUMPS)
@pytest.mark.parametrize("frames", [3, 5])
def test_dump_must_hold_a_frame_for_each_state(folder, dump, frames):
    one = (particles(8.0, 4.0), pairs(4.0))[dump]
    write(folder, [one] * frames, dump)
    with pytest.raises(SimulationError, match="4 states"):
        tables_of(folder, VARIABLES, "")


def test_contact_listed_twice_is_refused(folder):
    write(folder, [pairs(distance, times=2) for distance in DISTANCES], 1)
    with pytest.raises(SimulationError, match="twice"):
        tables_of(folder, VARIABLES, "")


def test_one_frame_of_a_dump_is_in_memory_at_a_time(folder, monkeypatch):
    read_dump, seen = lammps_output.read_dump, []

    def watched(path):
        before = []

        def watch(frame):
            assert all(earlier() is None for earlier in before)
            before.append(weakref.ref(next(iter(frame.values()))))
            seen.append(path)
            return frame

        return map(watch, read_dump(path))

    monkeypatch.setattr(lammps_output, "read_dump", watched)
    tables_of(folder, VARIABLES, "")
    assert len(seen) == 2 * len(EDGES)


def test_a_run_is_read_and_written_without_pandas(folder):
    program = f"""
import sys
from pathlib import Path
import branchcrush.config.build
import branchcrush.lammps.compression
from branchcrush.files.tables import write_table
from branchcrush.lammps.output import read_compression

for name, table in read_compression(Path("."), {VARIABLES}, "")._asdict().items():
    kind = "parquet" if name in ("contacts", "walls", "compressed") else "csv"
    write_table(f"{{name}}.{{kind}}", table, {{}})
# It takes half a second to import, as much as all else that a job does beside LAMMPS.
assert "pandas" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", program], cwd=folder, check=True)
    assert len(pd.read_parquet(folder / "contacts.parquet")) == 1


@pytest.mark.parametrize("name", ["states.csv", "steps.csv", *DUMPS])
@pytest.mark.parametrize("share", [0.0, 0.3, 0.75, 0.97])
def test_a_file_that_breaks_off_is_refused_in_one_line(folder, name, share):
    whole = (folder / name).read_bytes()
    (folder / name).write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(SimulationError, match="is the disk full") as caught:
        read_compression(folder, VARIABLES, "")
    assert "\n" not in str(caught.value)


def test_a_run_that_saved_no_state_says_why(folder):
    head, *_ = (folder / "states.csv").read_text().splitlines()
    (folder / "states.csv").write_text(head + "\n")
    with pytest.raises(SimulationError, match="two grains at one place"):
        read_compression(folder, VARIABLES, "two grains at one place")
