"""Damaged files for every reader: what each makes of them, in how long, and in how much memory.

What must hold: an error of this package, which says in words what is wrong, or a sound result; no
other exception, no warning of NumPy, none of 10 s of a processor, none of 1 GB. What does not hold
is named in `faults`: the reader, and the number of the input, of which `damaged` makes the file.
"""

import random
import resource
import signal
import tempfile
import time
import traceback
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from pathlib import Path

from benchmarks.fuzz_readers import readers
from benchmarks.mutations import mutated
from branchcrush.errors import BranchcrushError

# Of one input: what it may take of a processor [s], and the process may grow by meanwhile [bytes].
_LONGEST, _MOST_MEMORY = 10.0, 1_000_000_000
# Of one message, in characters: what one reads.
_LONGEST_MESSAGE = 60_000
_CHUNK = 50


class TooSlow(BaseException):
    """An input took too long; no handler of the package takes it for an error of a file."""


def run(inputs=100_000, seed=1, names=None, processes=2, minutes=None):
    """Return what came of damaged files, as many for each reader.

    Parameters
    ----------
    inputs : int
        Of all readers together.
    seed : int
    names : list of str, optional
        Of readers; all of them without. A name's beginning is enough.
    processes : int
    minutes : float, optional
        After which no more inputs are begun.

    Returns
    -------
    dict
    """
    start = time.monotonic()
    chosen = [name for name in readers() if not names or name.startswith(tuple(names))]
    each = -(-inputs // len(chosen))
    chunks = [
        (name, seed, first, min(first + _CHUNK, each))
        for first in range(0, each, _CHUNK)
        for name in chosen
    ]
    kinds, faults, slowest, largest = {}, [], (0.0, ""), 0
    # What is imported late is no part of the time of the first input.
    import openpyxl  # noqa: F401
    import scipy.stats  # noqa: F401

    context = get_context("fork")
    with ProcessPoolExecutor(processes, context, _limited) as pool:
        waiting = {pool.submit(_read_chunk, *chunk): chunk for chunk in chunks}
        for done in as_completed(waiting):
            name, *_ = chunk = waiting[done]
            try:
                counted, found, slow, memory = done.result()
            except BrokenProcessPool:
                faults.append({"reader": name, "inputs": chunk[2:], "fault": "the process died"})
                continue
            kinds.setdefault(name, Counter()).update(counted)
            faults += found
            for each in found:
                print(f"  {each}", flush=True)
            slowest, largest = max(slowest, slow), max(largest, memory)
            if minutes is not None and time.monotonic() - start > 60.0 * minutes:
                pool.shutdown(wait=False, cancel_futures=True)
                break
    return {
        "inputs": sum(counted.total() for counted in kinds.values()),
        "seed": seed,
        "kinds": {name: dict(sorted(kinds[name].items())) for name in sorted(kinds)},
        "faults": faults[:1000],
        "number_of_faults": len(faults),
        "slowest_s": round(slowest[0], 2),
        "slowest": slowest[1],
        "largest_process_MB": round(largest / 1e6),
    }


def summary(result):
    """Return how the inputs ended, in lines."""
    total = Counter()
    for counted in result["kinds"].values():
        total.update(counted)
    lines = [f"{number} {kind}" for kind, number in total.most_common()]
    lines.append(f"slowest {result['slowest_s']} s ({result['slowest']})")
    places = Counter(fault["fault"].partition(": ")[0] for fault in result["faults"])
    return lines + [f"FAULT {number}: {fault}" for fault, number in places.most_common(40)]


def damaged(name, seed, number):
    """Return a damaged file of a reader, the same for the same numbers."""
    rng = random.Random(f"{name} {seed} {number}")
    kind = name.partition(".")[0]
    known = readers()
    others = [reader.data for other, reader in known.items() if other.partition(".")[0] == kind]
    return mutated(rng, known[name].data, others)


def outcome(name, data, folder):
    """Return how reading a file ended: its kind, and the fault if it is one.

    Parameters
    ----------
    name : str
        Of the reader.
    data : bytes
    folder : path-like
        The file is written into it.

    Returns
    -------
    kind, fault : str
    """
    reader = readers()[name]
    path = Path(folder) / reader.name
    path.write_bytes(data)
    try:
        with warnings.catch_warnings():
            # A user would read them between the lines.
            warnings.simplefilter("error", RuntimeWarning)
            reader.read(path)
    except BranchcrushError as error:
        return type(error).__name__, _wrong_message(str(error))
    except (Exception, TooSlow) as error:
        return "fault", _place_of(error)
    return "sound", ""


def _wrong_message(text):
    """Return what makes a message none that a user can read, or nothing."""
    if not all(line.strip() for line in text.split("\n")) or len(text) > _LONGEST_MESSAGE:
        return f"a message of {len(text)} characters: {text[:80]!r}"
    return ""


def _place_of(error):
    """Return an exception with the lines of the package that it passed last."""
    passed = [
        f"{Path(frame.filename).parent.name}/{Path(frame.filename).name}:{frame.lineno}"
        for frame in traceback.extract_tb(error.__traceback__)
        if "/branchcrush/" in frame.filename
    ]
    return f"{type(error).__name__} at {' '.join(passed[-2:])}: {str(error)[:200]}"


def _limited():
    """Limit what a process may grow by, so that no input takes the machine's memory."""
    # Arrow reserves addresses by the gigabyte and never uses them.
    size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    most = size + 6 * _MOST_MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    signal.signal(signal.SIGPROF, _too_slow)


def _too_slow(*_):
    raise TooSlow(f"more than {_LONGEST:g} s")


def _read_chunk(name, seed, first, last):
    """Return how some inputs ended: counts by kind, faults, the slowest, and the most memory."""
    counted, faults, slowest = Counter(), [], (0.0, "")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with tempfile.TemporaryDirectory() as folder:
        for number in range(first, last):
            data = damaged(name, seed, number)
            start = time.process_time()
            signal.setitimer(signal.ITIMER_PROF, _LONGEST)
            try:
                kind, fault = outcome(name, data, folder)
            except TooSlow:  # between the reading and the end of it
                kind, fault = "fault", "TooSlow"
            finally:
                signal.setitimer(signal.ITIMER_PROF, 0.0)
            slowest = max(slowest, (time.process_time() - start, f"{name} {number}"))
            after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
            if (after - before) * 1024 > _MOST_MEMORY:
                fault = fault or f"{(after - before) / 1024:.0f} MB more memory"
            before = after
            counted[kind] += 1
            if fault:
                faults.append({"reader": name, "number": number, "fault": fault})
    return counted, faults, slowest, before * 1024
