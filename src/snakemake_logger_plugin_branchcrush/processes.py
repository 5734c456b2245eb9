"""What jobs write to the run's own output, taken line by line so that it cannot garble a table."""

import contextlib
import os
import threading
from collections.abc import Callable, Sequence
from typing import Any, TextIO


class ProcessOutput:
    r"""Lines that processes write to standard streams, handed to a function until it is closed.

    Jobs inherit the streams as the operating system knows them, so those are what is replaced.

    Examples
    --------
    >>> read, write = os.pipe()
    >>> lines = []
    >>> output = ProcessOutput([write], lines.append)
    >>> os.write(write, b"one line\nand ano"), os.write(write, b"ther")
    (16, 4)
    >>> output.close()
    >>> lines
    ['one line', 'and another']
    """

    def __init__(self, descriptors: Sequence[int], take: Callable[[str], None]) -> None:
        self._take = take
        self._before = [(descriptor, os.dup(descriptor)) for descriptor in descriptors]
        self._read, write = os.pipe()
        for descriptor in descriptors:
            os.dup2(write, descriptor)
        os.close(write)
        self._thread = threading.Thread(target=self._hand_on, name="output of jobs", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Give the streams back, once all that was written is handed on."""
        for descriptor, before in self._before:
            os.dup2(before, descriptor)
            os.close(before)
        self._before = []
        # A process that outlives its job would hold the other end open.
        self._thread.join(timeout=1.0)

    def _hand_on(self) -> None:
        rest = b""
        while block := os.read(self._read, 65536):
            *lines, rest = (rest + block).replace(b"\r\n", b"\n").split(b"\n")
            for line in lines:
                self._hand_on_line(line)
        if rest:
            self._hand_on_line(rest)
        os.close(self._read)

    def _hand_on_line(self, line: bytes) -> None:
        # Where nobody reads on (`snakemake 2>&1 | head`), jobs would wait at a pipe that is full.
        with contextlib.suppress(OSError, ValueError):
            self._take(line.decode("utf-8", "replace"))


def descriptor_of(stream: Any) -> int | None:
    """Return the number by which the operating system knows a stream; None where it has none.

    Parameters
    ----------
    stream : file-like

    Returns
    -------
    int or None
    """
    try:
        number: int = stream.fileno()
        return number
    except (OSError, ValueError, AttributeError):
        return None


def copy_of(stream: TextIO, descriptor: int | None) -> TextIO:
    """Return a stream to the same place, which stays when what jobs write is taken.

    Parameters
    ----------
    stream : TextIO
    descriptor : int or None
        Its number; without one the stream itself is returned.

    Returns
    -------
    TextIO
    """
    if descriptor is None:
        return stream
    return open(os.dup(descriptor), "w", encoding=stream.encoding, errors="replace")


def is_terminal(descriptor: int) -> bool:
    """Return whether a number is that of a terminal.

    Parameters
    ----------
    descriptor : int

    Returns
    -------
    bool
    """
    try:
        return os.isatty(descriptor)
    except OSError:
        return False
