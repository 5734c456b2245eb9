"""The files of other codes, and how each is to be read."""

import csv
from pathlib import Path

import pytest

from branchcrush.readers.layouts import Source

DATA = Path(__file__).parents[2] / "data" / "readers"
LOCAL = {"id1": "c_id[1]", "id2": "c_id[2]", "force": ["c_f[3]", "c_f[4]", "c_f[5]"]}
NAMED = {"id1": "id_i", "id2": "id_j", "normal_force": "fn", "branch": ["dx", "dy", "dz"]}
YADE = {
    "id1": "id1",
    "id2": "id2",
    "real": "isReal",
    "normal_force": "fn",
    "overlap": "penetration",
}
PFC = {"id1": "end1", "id2": "end2", "force": ["fx", "fy", "fz"], "gap": "gap"}
ENDS = {
    "start": ["start_x", "start_y", "start_z"],
    "end": ["end_x", "end_y", "end_z"],
    "normal_force": "force_scalar",
}
DEFAULT_AND_DELTA = ("pos", "vel", "id", "force", "torque", "history", "contactArea", "delta")
WITHOUT_IDS = ("contactPoint", "force_tangential", "pos", "force_normal", "force")
with open(DATA / "expected" / "box.csv") as file:
    _LOW = float(next(csv.DictReader(file))["lo_m"])
CELL = {"low": [_LOW] * 3, "high": [-_LOW] * 3}
# By name: folder, format, file of grains, file of contacts, and what else a user declares.
CASES = {
    "lammps": ("30-lammps-custom-and-local", "lammps", "grains_17_digits.dump.gz",
               "contacts.local", {"columns": LOCAL}),
    "lammps_named": ("30-lammps-custom-and-local", "lammps", "grains_17_digits.dump.gz",
                     "contacts_named_columns.local", {"columns": NAMED}),
    "lammps_scaled": ("30-lammps-custom-and-local", "lammps", "grains_scaled_unsorted.dump",
                      "contacts.local", {"columns": LOCAL}),
    "liggghts": ("31-liggghts-pair-gran-local", "liggghts", "grains.dump",
                 "fc_default_and_delta.dump", {"keywords": DEFAULT_AND_DELTA}),
    "liggghts_places": ("31-liggghts-pair-gran-local", "liggghts", "grains.dump",
                        "fc_without_ids_relabelled.dump", {"keywords": WITHOUT_IDS}),
    "yade": ("32-yade-text-and-vtk", "yade", "spheres_id.txt", "interactions.csv",
             {"columns": YADE, **CELL}),
    "yade_vtk": ("32-yade-text-and-vtk", "yade", "packing-spheres-0000.vtk",
                 "packing-intrs-0000.vtk", CELL),
    "yade_text": ("32-yade-text-and-vtk", "yade", "spheres.txt", "packing-intrs-0000.vtk", CELL),
    "mercurydpm": ("33-mercurydpm-data-fstat", "mercurydpm", "packing.data", "packing.fstat", {}),
    "pfc": ("34-pfc-csv", "columns", "balls.csv", "contacts_with_ids.csv",
            {"columns": PFC, **CELL}),
    "pfc_ends": ("34-pfc-csv", "columns", "balls.csv", "contacts_start_end.csv",
                 {"columns": ENDS, **CELL}),
}  # fmt: skip


def source_of_case(name, **changed):
    """Return how a case is read, some of it changed."""
    folder, kind, grains, contacts, options = CASES[name]
    given = {
        "format": kind,
        "grains": [DATA / folder / grains],
        "contacts": [DATA / folder / contacts],
        "periodic": True,
        **options,
    }
    return Source(**{**given, **changed})


@pytest.fixture(scope="session")
def expected():
    """Return the contacts that every reader must give, by the two ids, the smaller first."""
    with open(DATA / "expected" / "contacts.csv") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    return {tuple(sorted((int(row["id1"]), int(row["id2"])))): row for row in rows}
