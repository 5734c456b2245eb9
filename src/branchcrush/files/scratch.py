"""Scratch folders that tell whether somebody still works in them, and what the dead left behind."""

import contextlib
import fcntl
import os
import re
import shutil
import tempfile
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

# Of a folder that is removed with the run that it belongs to, and of one that anybody's process may
# be at work in.
_OF_RUNS, _OF_ANYBODY = ".compress-", ".trial-"
# What `files.replacing` writes beside the file that it will take the place of.
_BESIDE = re.compile(r"\.(.+)\.(\d+)")


@contextlib.contextmanager
def scratch_folder(prefix: str, parent: str | PathLike[str] | None = None) -> Iterator[Path]:
    """Make a folder that is removed at the end, and locked by this process until then.

    The kernel lets the lock go when the process dies, whichever way: `remove_dead` tells by it
    which folders nobody works in any more.

    Parameters
    ----------
    prefix : str
        Of its name; the machine's name follows.
    parent : path-like, optional
        Where it is made; the folder for temporary files if not given.

    Yields
    ------
    Path

    Examples
    --------
    >>> with scratch_folder("branchcrush-") as folder:
    ...     _ = (folder / "dump").write_text("1")
    ...     remove_dead(folder.parent, "branchcrush-")
    ...     folder.is_dir()
    True
    >>> folder.exists()
    False
    """
    while True:
        folder = tempfile.mkdtemp(prefix=_name(prefix), dir=parent)
        lock = os.open(folder, os.O_RDONLY)
        # File systems without locks are swept by nobody.
        with contextlib.suppress(OSError):
            fcntl.flock(lock, fcntl.LOCK_SH)
        if os.path.exists(folder):
            break
        # Taken for a dead one's before it was locked.
        os.close(lock)
    try:
        yield Path(folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


def remove_dead(parent: str | PathLike[str], prefix: str) -> None:
    """Remove scratch folders of this machine whose process has ended.

    Parameters
    ----------
    parent : path-like
    prefix : str
        As for `scratch_folder`.
    """
    with contextlib.suppress(OSError), os.scandir(parent) as entries:
        for entry in entries:
            if entry.name.startswith(_name(prefix)) and entry.is_dir(follow_symlinks=False):
                _remove_if_dead(entry.path)


def remove_leavings(results: str | PathLike[str]) -> None:
    """Remove what killed jobs left below a folder of results, where none is at work any more.

    Only a preview may be at work meanwhile: what is its own stays while its process lives.

    Parameters
    ----------
    results : path-like
    """
    for place, folders, files in os.walk(results):
        for name in folders:
            if name.startswith(_OF_RUNS):
                shutil.rmtree(os.path.join(place, name), ignore_errors=True)
        remove_dead(place, _OF_ANYBODY)
        folders[:] = [name for name in folders if not name.startswith(".")]
        for name in files:
            beside = _BESIDE.fullmatch(name)
            if beside and not (beside[1].startswith("preview.") and _runs(int(beside[2]))):
                with contextlib.suppress(OSError):
                    os.unlink(os.path.join(place, name))


def _name(prefix):
    # Another machine that shares the folder does not see who holds a lock here.
    return f"{prefix}{re.sub(r'[^A-Za-z0-9.-]', '-', os.uname().nodename)}-"


def _remove_if_dead(folder):
    with contextlib.suppress(OSError):
        lock = os.open(folder, os.O_RDONLY)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(folder, ignore_errors=True)
        finally:
            os.close(lock)


def _runs(process):
    """Return whether there is a process of this number."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
