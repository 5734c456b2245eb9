"""Names that LAMMPS can read, for folders that lie anywhere."""

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from os import PathLike
from pathlib import Path

from branchcrush.errors import SimulationError
from branchcrush.files.scratch import remove_dead, scratch_folder

# Where TMPDIR is none that LAMMPS can read.
_PLACES = ("/tmp", "/var/tmp", "/dev/shm")
_PREFIX = "branchcrush-"
# LAMMPS parts words at blanks, and reads $, quotes, & and # as its own.
_PLAIN = re.compile(r"[\w./+@%=:,~-]+", re.ASCII)


@contextmanager
def linked(inputs: str | PathLike[str], output: str | PathLike[str]) -> Iterator[Path]:
    """Give two folders names that LAMMPS can read, while it runs.

    Parameters
    ----------
    inputs, output : path-like
        Folders with any name.

    Yields
    ------
    Path
        A folder in which they are `inputs` and `output`.

    Raises
    ------
    SimulationError
        Where no folder for temporary files has a name that LAMMPS can read.

    Examples
    --------
    >>> with tempfile.TemporaryDirectory(prefix="a ${b}") as folder, linked("/", folder) as links:
    ...     sorted(os.listdir(links)), " " in str(links)
    (['inputs', 'output'], False)
    """
    with scratch_folder(_PREFIX, _place()) as links:
        (links / "inputs").symlink_to(Path(inputs).resolve())
        (links / "output").symlink_to(Path(output).resolve())
        yield links


def remove_dead_links() -> None:
    """Remove from the folders for temporary files what dead processes of this machine left there.

    Those of other machines are for their own jobs to clear.
    """
    places = set(_PLACES)
    # It writes to a folder to find one, which a full disk refuses.
    with suppress(OSError):
        places.add(tempfile.gettempdir())
    for folder in places:
        remove_dead(folder, _PREFIX)


def _place():
    """Return a folder for temporary files whose name LAMMPS can read: TMPDIR, where it is one."""
    given = tempfile.gettempdir()
    for folder in (given, *_PLACES):
        if _PLAIN.fullmatch(folder) and os.path.isdir(folder) and os.access(folder, os.W_OK):
            return folder
    raise SimulationError(
        f"LAMMPS can read no file in {given}, nor are /tmp, /var/tmp and /dev/shm there to be "
        "written to: set TMPDIR to a folder whose name has no blanks and none of $ & # and quotes"
    )
