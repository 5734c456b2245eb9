"""A disk that is full before a packing is compressed: one line that says so, and no half result."""

import resource
import subprocess
import sys

import pytest

# What a job does that compresses a packing; no file may grow beyond the limit.
JOB = """\
import resource, sys
import numpy as np
from branchcrush.files.tables import write_packing, write_table
from branchcrush.jobs import job
from branchcrush.lammps import checkpoint
from branchcrush.lammps.compression import compress
from branchcrush.lammps.library import load_lammps
inputs, folder, limit, kept = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4]
def full(write=checkpoint.write_kept):
    def write_full(*state):
        resource.setrlimit(resource.RLIMIT_FSIZE, (600, limit))
        write(*state)
    return write_full
if kept == "full":
    checkpoint.write_kept = full()
rng = np.random.default_rng(1)
n = 5
places = (np.indices((n, n, n)).reshape(3, -1).T - (n - 1) / 2) * 1.2e-3
radii = rng.uniform(0.4e-3, 0.55e-3, n**3)
edge = n * 1.2e-3
law = {"law": "linear", "stiffness": 1e6, "force_floor": 0.05, "boundary": "walls"}
path = {"control": "edge", "approach_edge": 0.93 * edge}
path |= {"targets": [0.9 * edge, 0.87 * edge], "strain_step": 0.02}
# MPI has files of its own.
load_lammps()(cmdargs=["-screen", "none", "-log", "none"]).close()
# Every state is kept, whatever time it took.
checkpoint.LEAST_SECONDS = 0.0
resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
with job(f"{folder}/logs/compression.log"):
    variables = {**law, **path, "largest_radius": 0.55e-3, "state_tolerance": 1e-4}
    write_packing(f"{folder}/seed_1/packing.npz", places, radii, edge, {})
    tables = compress(places, radii, edge, variables, inputs=inputs, folder=f"{folder}/seed_1",
                      log=f"{folder}/logs/compression.log", checkpoint=f"{folder}/kept")
    for name, table in tables._asdict().items():
        write_table(f"{folder}/seed_1/{name}.parquet", table, {})
"""
FILES = {"packing.npz", "particles.dump.gz", "pairs.dump.gz"}
FILES |= {f"{name}.parquet" for name in ("path", "contacts", "walls", "steps", "compressed")}


def run(lammps_inputs, folder, limit, kept="free"):
    return subprocess.run(
        [sys.executable, "-c", JOB, str(lammps_inputs), str(folder), str(limit), kept],
        capture_output=True,
        text=True,
        timeout=120,
    )


@pytest.fixture(scope="module")
def whole(lammps_inputs, tmp_path_factory):
    """The bytes of each result of a job that has room, and how large its largest file is."""
    folder = tmp_path_factory.mktemp("whole")
    done = run(lammps_inputs, folder, resource.RLIM_INFINITY)
    assert (done.returncode, done.stderr) == (0, "")
    results = {path.name: path.read_bytes() for path in (folder / "seed_1").iterdir()}
    assert set(results) == FILES
    return results


# At the packing, its data file, the table of states or the log, and the dumps.
# And as the first state is kept: a run writes as much as that before.
@pytest.mark.parametrize(
    ("limit", "kept"),
    [*((limit, "free") for limit in (0, 600, 4500, 16_000, 40_000)), (10**9, "full")],
)
def test_one_line_and_no_half_file(whole, lammps_inputs, tmp_path, limit, kept):
    done = run(lammps_inputs, tmp_path, limit, kept)
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert "branchcrush: " in line
    # In the words of this package or, of its dumps, of LAMMPS.
    assert "File too large" in line
    assert ("free some space, then repeat" in line) != ("Error writing dump" in line)
    written = {path.name: path.read_bytes() for path in (tmp_path / "seed_1").iterdir()}
    assert {name: whole[name] for name in written} == written
