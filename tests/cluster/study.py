"""A study that is run on the cluster, and what is seen of it from outside."""

import contextlib
import fcntl
import json
import os
import re
import signal
import subprocess
import threading
import time
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from benchmarks.kills import Study

# Packings of a second, which tests stop while something happens; one is on two ranks.
SAMPLE = """\
  {name}:
    grading: {{form: uniform, basis: number, size: radius, unit: m, min: 5.0e-4, max: 1.0e-3}}
    grains: 50
    allow_unrepresentative: true
    loading: {{edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 3, quality: draft}}
    seeds: {seeds}
    refined_seeds: 0
    ranks: {ranks}
"""
CONFIG = "".join(
    [
        "samples:\n",
        SAMPLE.format(name="lone", seeds=3, ranks=1),
        SAMPLE.format(name="paired", seeds=1, ranks=2),
        "figures: {dpi: 60}\n",
    ]
)
CERTIFICATES = ("results/lone/jamming.csv", "results/paired/jamming.csv")
# Without that on two ranks, which wait for each other where the machine has other work.
PACKINGS = tuple(f"results/lone/seed_{seed}/path.csv" for seed in (1, 2, 3))
_CLAIM = re.compile(r"results\+(\w+)\+(seed_\d+)\+made\.json")
_ASKED = ("-o", "%Z|%k|%C|%m|%l")


class Asked(NamedTuple):
    """What a job asked the cluster for."""

    cores: int
    megabytes: int
    minutes: int


def one_machine(folder):
    """Return the digest of each result, made without a cluster."""
    study = Study(folder, CERTIFICATES)
    (study.folder / "config.yaml").write_text(CONFIG, encoding="utf-8")
    assert study.finish() == 0, (study.folder / "output.txt").read_text(encoding="utf-8")
    return study.results()


class ClusterStudy(Study):
    """A folder in which a user types the command for the cluster."""

    def __init__(self, folder, cluster, targets=PACKINGS):
        super().__init__(folder, targets)
        (self.folder / "config.yaml").write_text(CONFIG, encoding="utf-8")
        self.cluster = cluster
        at = self.command.index("--cores")
        self.command[at : at + 2] = [
            *("--workflow-profile", "slurm", "--jobs", "2"),
            # No accounting here; and jobs of seconds are asked for more often than such of minutes.
            *("--slurm-status-command", "squeue"),
            *("--slurm-init-seconds-before-status-checks", "2"),
            *("--latency-wait", "5"),
        ]
        self.environment |= cluster.environment
        self.claims = self.folder / ".branchcrush" / "claims"
        self.most_at_once = {}

    def output(self):
        """Return all that was said so far."""
        return (self.folder / "output.txt").read_text(encoding="utf-8")

    def end_all(self):
        """End the jobs that may be left after a test that failed."""
        self.cluster.said("scancel", "--user", "root")
        for process in self.processes():
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)

    @contextlib.contextmanager
    def begun(self):
        """Begin the command in a process of its own, which the test may kill, alone."""
        with open(self.folder / "output.txt", "a", encoding="utf-8") as output:
            main = subprocess.Popen(
                self.command,
                cwd=self.folder,
                env=self.environment,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                # As a terminal does: what began these tests in the background ignores Ctrl-C.
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            )
        try:
            yield main
        finally:
            main.kill()
            main.wait()

    def asked(self):
        """Return what jobs asked for, in turn, by rule and wildcards."""
        table = self.cluster.said("squeue", "-h", "--states", "all", "--sort", "i", *_ASKED)
        jobs = {}
        for line in table.splitlines():
            place, comment, cores, memory, time_limit = line.split("|")
            if place == str(self.folder):
                megabytes = int(memory.removesuffix("M"))
                # Days, hours, minutes and seconds, as many of them as it takes.
                parts = zip((1 / 60, 1, 60, 1440), re.split("[-:]", time_limit)[::-1], strict=False)
                minutes = round(sum(weight * int(part) for weight, part in parts))
                jobs.setdefault(comment, []).append(Asked(int(cores), megabytes, minutes))
        return jobs

    def records(self):
        """Yield the records of packings that are finished, as paths."""
        yield from self.folder.glob("results/*/seed_*/made.json")

    def at_work(self):
        """Return the packings that jobs claim just now, as sample/seed_1."""
        names = {claim: _CLAIM.fullmatch(claim.name) for claim in self.claims.glob("*")}
        return sorted(
            "/".join(name.groups()) for claim, name in names.items() if name and _held(claim)
        )

    def working(self):
        """Return the packing of each process that has what LAMMPS writes of one open."""
        kept = f"{self.folder}/.branchcrush/checkpoints/results/"
        names = []
        for process in self.processes():
            # It may end meanwhile.
            with contextlib.suppress(OSError):
                opened = {os.readlink(file) for file in Path(f"/proc/{process}/fd").iterdir()}
                parts = (
                    file.removeprefix(kept).split("/") for file in opened if file.startswith(kept)
                )
                names += {"/".join(part[:2]) for part in parts}
        return names

    def frozen(self, number):
        """Wait until so many packings are at work, and stop the process of each as it is seen.

        Returns their processes by their names, as `at_work`: no more than asked for, however
        many begin at once.
        """
        stopped = {}

        def all_seen():
            for name in self.at_work():
                if len(stopped) == number:
                    break
                if name not in stopped and (process := self._process_of(name)):
                    os.kill(process, signal.SIGSTOP)
                    stopped[name] = process
            return len(stopped) == number

        self.wait_for(all_seen, f"{number} packings at work")
        return stopped

    def _process_of(self, name):
        """Return the process that claims a packing, by its number on this side of the node."""
        claim = self.claims / f"results/{name}/made.json".replace("/", "+")
        with contextlib.suppress(OSError, ValueError):
            number = json.loads(claim.read_text(encoding="utf-8"))["process"]
            for process in self.jobs():
                status = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
                if re.search(rf"^NSpid:.*\s{number}$", status, re.MULTILINE):
                    return process
        return None

    def wait_for(self, happens, what, seconds=600.0):
        """Wait until something is true, and return it."""
        end = time.monotonic() + seconds
        while not (found := happens()):
            assert time.monotonic() < end, f"{what} does not happen: {self.output()}"
            time.sleep(0.02)
        return found

    @contextlib.contextmanager
    def watched(self):
        """Look meanwhile how many processes at a time compress each packing."""
        ended = threading.Event()

        def look():
            while not ended.wait(0.02):
                for name, number in Counter(self.working()).items():
                    self.most_at_once[name] = max(number, self.most_at_once.get(name, 0))

        watch = threading.Thread(target=look)
        watch.start()
        try:
            yield
        finally:
            ended.set()
            watch.join()


def _held(claim):
    """Return whether the process that made a claim lives: it holds a lock on it."""
    try:
        file = os.open(claim, os.O_RDONLY)
    except OSError:
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    finally:
        os.close(file)
    return False
