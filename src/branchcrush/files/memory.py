"""How much memory this machine has, as its kernel tells."""

import re
from os import PathLike
from pathlib import Path
from typing import NamedTuple

# Limit and use of a control group, and what of its use are copies of files that the kernel lets go
# when memory is asked for, by the version of these.
_FILES_1 = ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file")
_FILES_2 = ("memory.max", "memory.current", "inactive_file")


class Memory(NamedTuple):
    """What processes of this one's kind may have, and what is free of it [bytes]."""

    total: float
    available: float


def machine_memory(root: str | PathLike[str] = "/") -> Memory | None:
    r"""Return the memory that there is, by the kernel and by the limits of the control groups.

    Parameters
    ----------
    root : path-like
        Where the kernel's files are.

    Returns
    -------
    Memory or None
        None where the kernel does not tell.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     Path(folder, "proc").mkdir()
    ...     told = "MemTotal: 8000 kB\nMemAvailable: 6000 kB\n"
    ...     _ = Path(folder, "proc/meminfo").write_text(told)
    ...     machine_memory(folder)
    Memory(total=8192000.0, available=6144000.0)
    """
    root = Path(root)
    told = _text(root / "proc/meminfo")
    found = [
        re.search(rf"^{name}:\s*(\d+) kB", told, re.M) for name in ("MemTotal", "MemAvailable")
    ]
    if None in found:
        return None
    memory = Memory(*(1024.0 * float(match[1]) for match in found if match))
    for limit, used in _limits(root):
        memory = Memory(min(memory.total, limit), min(memory.available, max(limit - used, 0.0)))
    return memory


def _limits(root):
    """Yield the limit of each control group that this process is in, and what is used of it."""
    for line in _text(root / "proc/self/cgroup").splitlines():
        _, controllers, name = line.split(":", 2)
        if controllers and "memory" not in controllers.split(","):
            continue
        # Version 2 has one tree for all controllers, 1 one for each.
        tree = root / "sys/fs/cgroup" / ("memory" if controllers else "")
        *files, copies = _FILES_1 if controllers else _FILES_2
        group = tree / name.lstrip("/")
        # A limit holds for all groups below it; inside a container the tree begins at its own.
        for place in (group, *group.parents):
            limit, used = (_text(place / file) for file in files)
            if limit.strip().isdecimal() and used.strip().isdecimal():
                found = re.search(rf"^{copies} (\d+)$", _text(place / "memory.stat"), re.M)
                yield float(limit), max(float(used) - float(found[1] if found else 0), 0.0)
            if place == tree:
                break


def _text(path):
    try:
        return path.read_text(encoding="utf-8")
    except OSError:
        return ""
