"""Locks on files that the kernel lets go when their holder dies, whichever way."""

import contextlib
import errno
import fcntl
import functools
import os
import sys
from os import PathLike

# A file system that has no locks.
_NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP}


def locked(
    path: str | PathLike[str], *, shared: bool = False, wait: bool = False
) -> tuple[int, bool]:
    """Open a file, made if it is not there, and lock it until its descriptor is closed.

    Between machines it holds on a network drive as well, as long as its server keeps locks. No
    child process inherits it.

    Parameters
    ----------
    path : path-like
    shared : bool
        Whether others may have it as well, if they too share it.
    wait : bool
        Whether to wait until it is free.

    Returns
    -------
    descriptor : int
    had : bool
        Whether the lock is had; on a file system without locks it is, with a warning, once in a
        process.

    Raises
    ------
    OSError
        When the file cannot be opened.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.NamedTemporaryFile() as file:
    ...     first, second = locked(file.name), locked(file.name)
    ...     os.close(first[0])
    ...     os.close(second[0])
    >>> first[1], second[1]
    (True, False)
    """
    kind = fcntl.LOCK_SH if shared else fcntl.LOCK_EX
    while True:
        file = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.flock(file, kind | (0 if wait else fcntl.LOCK_NB))
        except OSError as error:
            if error.errno in _NO_LOCKS:
                _tell_of_no_locks()
                return file, True
            if error.errno not in (errno.EWOULDBLOCK, errno.EACCES):
                raise
            return file, False
        # Somebody may have removed it meanwhile, and another locked its successor.
        with contextlib.suppress(FileNotFoundError):
            if os.path.samestat(os.fstat(file), os.stat(path)):
                return file, True
        os.close(file)


def is_locked(path: str | PathLike[str]) -> bool:
    """Return whether somebody has a file locked for himself; one that is not there is not made.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    bool
        False on a file system without locks.

    Raises
    ------
    OSError
        When the file cannot be opened.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.NamedTemporaryFile() as file:
    ...     lock, _ = locked(file.name)
    ...     had = is_locked(file.name)
    ...     os.close(lock)
    ...     had, is_locked(file.name)
    (True, False)
    """
    try:
        file = os.open(path, os.O_RDONLY)
    except FileNotFoundError:
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in (errno.EWOULDBLOCK, errno.EACCES):
            return True
        if error.errno not in _NO_LOCKS:
            raise
    finally:
        os.close(file)
    return False


@functools.cache
def _tell_of_no_locks():
    sys.stderr.write(
        f"branchcrush: {os.getcwd()} is on a file system without locks, so nothing keeps two runs "
        "in this folder apart\n"
    )
