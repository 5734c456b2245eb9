"""Jobs whose parents are killed at random moments: no process may live on.

A run begins a job through a shell, as Snakemake may, and the job starts LAMMPS, in its own process
or on ranks. One of the three, by turns, is killed at a moment between its start and when LAMMPS
runs; then all that it began has to end, although LAMMPS never would.
"""

import contextlib
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from concurrent.futures import ThreadPoolExecutor
from itertools import cycle, islice, product
from pathlib import Path

from benchmarks.kills import MARK, ROOT, processes_of, words_of

VICTIMS = ("run", "shell", "job")
ENDLESS = """\
units lj
region cell block 0 1 0 1 0 1
create_box 1 cell
create_atoms 1 single 0.5 0.5 0.5
mass 1 1.0
pair_style zero 0.1
pair_coeff * *
fix motion all nve
thermo_modify flush yes
run 2000000000
"""
# Goes on when its job has ended, as a run does that has others.
RUN = """\
import subprocess, sys, time
from branchcrush.runs import one_run
with one_run():
    subprocess.Popen(["sh", "-c", '"$0" job.py; exit', sys.executable]).wait()
    time.sleep(600)
"""
JOB = """\
from branchcrush.jobs import job
from branchcrush.lammps.run import run_script
with job("job.log"):
    run_script("in.endless", {}, "lammps.log", RANKS)
"""
# How long a process may outlive the one that began it, and how long all may take to begin [s].
_AFTERLIFE, _LONGEST = 10.0, 120.0
# Tries between two measurements of how long it takes to begin.
_AT_ONCE = 24


class Chain:
    """A run, its shell and its job, in a folder of their own."""

    def __init__(self, ranks):
        self.ranks, self.mark = ranks, uuid.uuid4().hex

    def __enter__(self):
        self._place = tempfile.TemporaryDirectory(prefix="orphans-")
        self.folder = Path(self._place.name)
        for name, text in {
            "run.py": RUN,
            "job.py": JOB.replace("RANKS", str(self.ranks)),
            "in.endless": ENDLESS,
        }.items():
            (self.folder / name).write_text(text, encoding="utf-8")
        environment = {
            **os.environ,
            "PYTHONPATH": str(ROOT / "src"),
            "TMPDIR": str(self.folder),
            MARK: self.mark,
        }
        self.run = subprocess.Popen(
            [sys.executable, "run.py"],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        return self

    def __exit__(self, *error):
        for process in self.processes():
            _kill(process)
        self.run.wait()
        self._place.cleanup()

    def processes(self):
        """Return all of it that lives."""
        return processes_of(self.mark)

    def begun(self, name):
        """Return the number of the run, the shell or the job, as soon as that is there.

        Of the run, as soon as it has begun anything.
        """
        end = time.monotonic() + _LONGEST
        while time.monotonic() < end:
            line, processes = [self.run.pid], self.processes()
            while child := next((each for each in processes if _parent(each) == line[-1]), None):
                line.append(child)
            if len(line) > max(1, VICTIMS.index(name)):
                return line[VICTIMS.index(name)]
            time.sleep(0.005)
        raise RuntimeError(f"the {name} does not begin")

    def runs(self):
        """Return whether LAMMPS has come to where it never ends."""
        log = self.folder / "lammps.log"
        return log.exists() and "Step" in log.read_text(encoding="utf-8", errors="replace")


def begins_within(ranks):
    """Return how long it takes from the first that a run begins until LAMMPS runs [s]."""
    with Chain(ranks) as chain:
        chain.begun("shell")
        start = time.monotonic()
        while not chain.runs():
            if time.monotonic() - start > _LONGEST:
                raise RuntimeError("LAMMPS does not begin")
            time.sleep(0.01)
        return time.monotonic() - start


def tried(ranks, victim, moment):
    """Kill one of a chain some time [s] after it began, and tell which of the others live on."""
    with Chain(ranks) as chain:
        chosen = chain.begun(victim)
        time.sleep(moment)
        began = chain.runs()
        _kill(chosen)
        killed = time.monotonic()
        while left := [each for each in chain.processes() if each != chain.run.pid]:
            if time.monotonic() - killed > _AFTERLIFE:
                break
            time.sleep(0.02)
        return {
            "ranks": ranks,
            "victim": victim,
            "moment_s": round(moment, 3),
            "lammps_ran": began,
            "gone_after_s": round(time.monotonic() - killed, 3),
            "live_on": [words_of(process).decode() for process in left],
        }


def tries(number, seed=1, ranks=(1, 2), workers=2):
    """Return what came of each try; victims and numbers of ranks in turn, moments drawn.

    Up to twice the time that it takes until LAMMPS runs, which is measured again and again: half of
    the moments lie before, whatever else the machine does.
    """
    rng, turns, records = random.Random(seed), cycle(product(ranks, VICTIMS)), []
    with ThreadPoolExecutor(workers) as pool:
        while len(records) < number:
            longest = dict(zip(ranks, pool.map(begins_within, ranks), strict=True))
            some = islice(turns, min(_AT_ONCE, number - len(records)))
            asked = [(*turn, rng.uniform(0.0, 2.0 * longest[turn[0]])) for turn in some]
            records += pool.map(lambda each: tried(*each), asked)
    return records


def run(number=1000, seed=1, workers=2):
    """Kill one of a chain as often as asked for."""
    records = tries(number, seed, workers=workers)
    return {
        "tries": len(records),
        "live_on": sum(bool(record["live_on"]) for record in records),
        "before_lammps_ran": sum(not record["lammps_ran"] for record in records),
        "longest_until_gone_s": max(record["gone_after_s"] for record in records),
        "seed": seed,
        "each_that_lives_on": [record for record in records if record["live_on"]],
    }


def _parent(process):
    """Return the number of the parent of a process; None of one that has ended."""
    with contextlib.suppress(OSError):
        return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])


def _kill(process):
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, signal.SIGKILL)
