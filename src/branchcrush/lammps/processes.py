"""Processes that end when the one that began them does."""

import ctypes
import os
import signal
import sys
from pathlib import Path


def end_with_parent(parent: int | None = None) -> None:
    """End this process by SIGTERM when its parent ends, whichever way that happens.

    Parameters
    ----------
    parent : int, optional
        Number of the process that is to be the parent. Where another one is by now, the parent died
        before it could be told, and this process ends at once.
    """
    if sys.platform != "linux":
        return
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGTERM)
    # Not before, or it could die in between.
    if parent is not None and os.getppid() != parent:
        os.kill(os.getpid(), signal.SIGTERM)


def start_of(process: int | str) -> str:
    """Return when a process was started, in the kernel's ticks; "none" where none runs.

    Parameters
    ----------
    process : int or str
        Its number, which another one may get when it has ended.

    Returns
    -------
    str

    Examples
    --------
    >>> start_of(os.getpid()) == start_of("self"), start_of(2**22 + 1)
    (True, 'none')
    """
    try:
        text = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return "none"
    # Behind the name, which may hold anything; one that is dead and was not looked after is Z.
    state, *fields = text.rpartition(")")[2].split()
    return "none" if state in "ZX" else fields[18]
