"""One MPI rank of a job: python -m branchcrush.lammps.rank MODULE FOLDER JOB START.

It runs `python -m MODULE FOLDER` under mpi4py, which ends all ranks when one of them fails, once it
is certain that the rank ends with the job: with process JOB, begun at START.
"""

import os
import signal
import sys
from runpy import run_module

from branchcrush.lammps.processes import end_with_parent, start_of


def main(module: str, folder: str, job: str, start: str) -> None:
    """Run a module on this rank, unless the job has ended.

    Parameters
    ----------
    module, folder : str
    job, start : str
        As `processes.start_of` tells them.
    """
    # First, and before MPI: from here on the end of the launcher, which follows that of the job,
    # ends this rank. Before, it may have been missed.
    end_with_parent()
    if start_of(job) != start:
        os.kill(os.getpid(), signal.SIGTERM)
    sys.argv = ["mpi4py", "-m", module, folder]
    run_module("mpi4py", run_name="__main__")


if __name__ == "__main__":
    main(*sys.argv[1:])
