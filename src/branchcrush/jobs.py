"""How a job of the workflow ends: quietly, or with one message on the screen and in its log."""

import contextlib
import errno
import sys
import traceback
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

from branchcrush.errors import BranchcrushError
from branchcrush.lammps.links import remove_dead_links
from branchcrush.runs import join_run

# What the machine refuses, and what a person can do about it.
_SPACE, _PLACE = "free some space", "mend that"
_FILE = "move the file that lies in the place of a folder"
_OF_THE_MACHINE = {
    errno.ENOSPC: _SPACE,
    errno.EDQUOT: _SPACE,
    errno.EFBIG: _SPACE,
    errno.EACCES: "change its permissions",
    errno.EPERM: "change its permissions",
    errno.EROFS: "run in a folder that can be written to",
    errno.ENOTDIR: _FILE,
    errno.EEXIST: _FILE,
    errno.EISDIR: "move the folder that lies in the place of a file",
    errno.ENAMETOOLONG: "give a shorter name, or run in a folder whose path is shorter",
    errno.ELOOP: "remove the symbolic links that lead to each other",
    errno.EIO: _PLACE,
    errno.ESTALE: _PLACE,
    errno.EMFILE: "raise what `ulimit -n` allows",
    errno.ENFILE: "raise what `ulimit -n` allows",
}


@contextlib.contextmanager
def job(log: str | PathLike[str]) -> Iterator[None]:
    """Turn an error of the package into one message and a failed job; log anything else whole.

    A full disk, a folder without permission and too little memory are such errors too. A log that
    cannot be written hides no message. A job of a run ends when the run does, whichever way: see
    `runs.join_run`.

    Parameters
    ----------
    log : path-like
        The log of the rule. LAMMPS may have written to it: messages are appended.

    Raises
    ------
    SystemExit
        For an error that `message_of` has words for.

    Examples
    --------
    >>> import tempfile
    >>> from branchcrush.errors import FitError
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     try:
    ...         with job(f"{folder}/fit.log"):
    ...             raise FitError("no packing carries load")
    ...     except SystemExit:
    ...         print(Path(folder, "fit.log").read_text(), end="")
    branchcrush: no packing carries load
    """
    log = Path(log)
    try:
        join_run()
        _note(log, "")
        # On a node of a cluster no run does it.
        remove_dead_links()
        yield
    except Exception as error:
        words = message_of(error)
        if words is None:
            _note(log, traceback.format_exc())
            raise
        message = f"branchcrush: {words}\n"
        if problem := _note(log, message):
            # The screen of a run shows what jobs say but for what their logs tell.
            message = f"{log} cannot be written ({problem}), so it is told here: {message}"
        with contextlib.suppress(OSError):
            sys.stderr.write(message)
        sys.exit(1)


def message_of(error: Exception) -> str | None:
    """Return what an error says to a user, or None of one that is a fault of this package.

    Parameters
    ----------
    error : Exception

    Returns
    -------
    str or None

    Examples
    --------
    >>> message_of(OSError(errno.ENOSPC, "No space left on device"))
    'No space left on device: free some space, then repeat the command'
    """
    if isinstance(error, BranchcrushError):
        return str(error)
    if isinstance(error, MemoryError):
        told = str(error).partition("\n")[0]
        return (
            f"not enough memory{f': {told}' if told else ''}; run fewer jobs at a time (--cores), "
            "or ask for fewer grains or states"
        )
    if isinstance(error, OSError) and error.errno in _OF_THE_MACHINE:
        name = f", {error.filename}" if error.filename else ""
        advice = _OF_THE_MACHINE[error.errno]
        return f"{error.strerror}{name}: {advice}, then repeat the command"
    return None


def _note(log, text):
    """Write at the end of a log, and return what kept it from being written, or nothing."""
    try:
        log.parent.mkdir(parents=True, exist_ok=True)
        with log.open("a", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        return error.strerror or str(error)
    return ""
