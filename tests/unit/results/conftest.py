"""Results of a study that are written by hand: one sample, one packing of a few grains."""

import numpy as np
import pytest

import branchcrush
from branchcrush.files.dictionary import result_files
from branchcrush.files.digests import Digests, digests_of
from branchcrush.files.made import record_bytes
from branchcrush.files.tables import provenance, write_packing, write_table
from branchcrush.packings.network import VECTOR_COLUMNS

CONTACT = ("state", "i", "j", "radius_i_m", "radius_j_m", "branch_length_m")
CONTACT += (*VECTOR_COLUMNS, "overlap_m", "normal_force_N", "energy_J")
WALL = ("state", "i", "wall", "direction_x", "direction_y", "direction_z")
WALL += ("overlap_m", "normal_force_N")


def write_results(folder, positions, radii, contacts, walls=()):
    """Write a packing of three states: loose, without contacts, and with the given ones."""
    place = folder / "results" / "sand" / "seed_7"
    place.mkdir(parents=True)
    origin = provenance(sample="sand", seed=7, config={"boundary": "walls"})
    edge = 2.5 * (np.abs(positions).max() + max(radii))
    write_packing(place / "packing.npz", positions, radii, edge, origin)
    columns = dict(zip(("x_m", "y_m", "z_m"), np.transpose(positions), strict=True))
    write_table(place / "compressed.parquet", {**columns, "radius_m": radii}, origin)
    known = next(one for one in result_files() if one.path == "<sample>/seed_<seed>/path.csv")
    state = {column.name: 0.0 for column in known.columns()}
    state |= {"leg": "loading", "volume_m3": edge**3, "carries_load": True, "solid_fraction": 0.6}
    state |= {"mean_stress_Pa": 1e5, "coordination_number": 4.0, "rattler_fraction": 0.1}
    write_table(place / "path.csv", [{**state, "state": number} for number in range(3)], origin)
    for name, known, rows in (("contacts", CONTACT, contacts), ("wall_contacts", WALL, walls)):
        columns = {one: [row[one] for row in rows] for one in known}
        write_table(place / f"{name}.parquet", columns, origin)
    leave_record(folder / "results", "sand/seed_7", sample="sand", seed="7")
    return branchcrush.open_study(folder)


def leave_record(results, place, **wildcards):
    """Write the record of the files of a packing, as the job that made them."""
    files = sorted(path for path in (results / place).iterdir() if path.name != "made.json")
    paths = {f"results/{path.relative_to(results)}": path for path in files}
    record = {"branchcrush": branchcrush.__version__, "rule": "compression", "code": ""}
    record |= {"wildcards": wildcards, "params": {}, "inputs": {}}
    digests = digests_of(map(str, paths.values()), Digests("test"))
    record["outputs"] = dict(zip(paths, digests.values(), strict=True))
    (results / place / "made.json").write_bytes(record_bytes(record))


def touching(i, j, positions, radii, force, state=2):
    """Return the row of a contact between two grains."""
    branch = np.subtract(positions[j], positions[i])
    length = float(np.linalg.norm(branch))
    row = {"state": state, "i": i, "j": j, "radius_i_m": radii[i], "radius_j_m": radii[j]}
    row |= dict(zip(VECTOR_COLUMNS, map(float, branch), strict=True))
    overlap = radii[i] + radii[j] - length
    return row | {
        "branch_length_m": length,
        "overlap_m": overlap,
        "normal_force_N": force,
        "energy_J": force * overlap / 2.0,
    }


@pytest.fixture
def row_of_three(tmp_path):
    """Three grains in a row that walls press together along x, and hold along y."""
    positions = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    radii = [0.5, 0.5, 0.5]
    contacts = [touching(k, k + 1, positions, radii, 3.0) for k in range(2)]
    side = {"state": 2, "overlap_m": 0.05, "normal_force_N": 0.1, "wall": "+y"}
    side |= {"direction_x": 0.0, "direction_y": 1.0, "direction_z": 0.0}
    walls = [{**side, "i": grain} for grain in (0, 1, 2) for _ in range(4)]
    return write_results(tmp_path, positions, radii, contacts, walls)
