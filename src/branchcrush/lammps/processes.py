"""Processes that end when the one that began them does."""

import ctypes
import os
import signal
import sys


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
