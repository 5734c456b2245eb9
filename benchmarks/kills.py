"""A study that is killed at random, over and over, and always gone on with by the same command.

Signals and victims come in turns of all twelve pairs, shuffled, and the moments are drawn, both by
a seeded generator. What must hold is told for each kill: its list `broken` is to be empty.
"""

import base64
import contextlib
import hashlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from itertools import count, product
from pathlib import Path

ROOT = Path(__file__).parents[1]
SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGKILL")
VICTIMS = ("main", "job", "group")
CONFIG = """\
samples:
  tiny:
    grading: {form: uniform, basis: number, size: radius, unit: m, min: 5.0e-4, max: 1.0e-3}
    grains: 30
    allow_unrepresentative: true
    loading: {edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 4, quality: draft}
    seeds: 3
    refined_seeds: 1
figures: {dpi: 60}
"""
# In the environment of each process of a study, by which it is known also when its parent is dead.
MARK = "BRANCHCRUSH_KILLS"
# How long a command may take, and how long a process may outlive the run that it belongs to [s].
_LONGEST, _AFTERLIFE = 900.0, 10.0


class Study:
    """A folder with a config.yaml, the one command typed in it, and what it is held against."""

    def __init__(self, folder, targets=(), snakefile=ROOT / "Snakefile", cores=2):
        self.folder = Path(folder)
        self.temporary = self.folder / "tmp"
        self.mark = uuid.uuid4().hex
        self.temporary.mkdir(parents=True)
        (self.folder / "config.yaml").write_text(CONFIG, encoding="utf-8")
        self.command = [sys.executable, "-m", "snakemake", "--cores", str(cores)]
        self.command += ["--snakefile", str(snakefile), *targets]
        self.environment = {
            **os.environ,
            "PYTHONPATH": str(ROOT / "src"),
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
            "TMPDIR": str(self.temporary),
            MARK: self.mark,
        }

    @contextlib.contextmanager
    def started(self):
        """Begin the command in a process group of its own; it is killed if this block fails."""
        with open(self.folder / "output.txt", "a", encoding="utf-8") as output:
            main = subprocess.Popen(
                self.command,
                cwd=self.folder,
                env=self.environment,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        try:
            yield main
        finally:
            for process in self.processes():
                with contextlib.suppress(ProcessLookupError):
                    os.kill(process, signal.SIGKILL)
            main.wait()

    def finish(self):
        """Run the command to its end, and return its exit code."""
        with self.started() as main:
            return main.wait(_LONGEST)

    def processes(self):
        """Return the processes of this study that live, whoever their parents are."""
        return processes_of(self.mark)

    def jobs(self):
        """Return those among them that run a script of the workflow."""
        return [process for process in self.processes() if b"/scripts/tmp" in words_of(process)]

    def results(self):
        """Return the digest of each file of results, by name."""
        files = (path for path in self.folder.glob("results/**/*") if path.is_file())
        return {
            str(path.relative_to(self.folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in files
        }

    def finished_seeds(self):
        """Return when each file of a seed that Snakemake counts as finished was written [ns]."""
        marks = {path.name for path in self.folder.glob(".snakemake/incomplete/**/*")}
        times = {}
        for folder in self.folder.glob("results/*/seed_*"):
            files = [path for path in folder.iterdir() if not path.name.startswith(".")]
            names = {_mark_of(path.relative_to(self.folder)) for path in files}
            if (folder / "path.csv").exists() and not names & marks:
                times |= {str(path): path.stat().st_mtime_ns for path in files}
        return times

    def scratch(self):
        """Return what is to be gone at the end: scratch of LAMMPS, files not yet in their place."""
        inside = self.folder.glob("results/**/.*")
        links = self.temporary.glob("branchcrush-*")
        kept = self.folder.glob(".branchcrush/checkpoints/**/*.*")
        return sorted(str(path.relative_to(self.folder)) for path in (*inside, *links, *kept))


def killed(study, name, victim, moment):
    """Begin the command, send a signal at a moment [s], wait for its end; tell what came of it."""
    number = getattr(signal, name)
    with study.started() as main:
        start = time.monotonic()
        with contextlib.suppress(subprocess.TimeoutExpired):
            main.wait(moment)
        while not (jobs := study.jobs()) and victim == "job" and main.poll() is None:
            time.sleep(0.1)
        told = {"signal": name, "victim": victim, "moment_s": round(moment, 2), "jobs": len(jobs)}
        if main.poll() is not None:
            told["lasted_s"] = time.monotonic() - start
            return {**told, "in_time": False, "broken": _broken_end(study, main.returncode)}
        with contextlib.suppress(ProcessLookupError):
            if victim == "group":
                os.killpg(main.pid, number)
            else:
                os.kill(jobs[0] if victim == "job" else main.pid, number)
        main.wait(_LONGEST)
        end = time.monotonic() + _AFTERLIFE
        while (alive := study.processes()) and time.monotonic() < end:
            time.sleep(0.05)
        broken = [f"process {words_of(process).decode()} lives on" for process in alive]
    return {**told, "in_time": True, "exit_code": main.returncode, "broken": broken}


def kill_over_and_over(folder, kills, seed, in_a_row=6, **options):
    """Kill a study and go on with it, and return what came of each kill.

    A study is begun anew after a command that came to its end, which is one after at most
    `in_a_row` kills. A command that ends before it is killed does not count.
    """
    rng = random.Random(seed)
    undisturbed = Study(Path(folder) / "undisturbed", **options)
    start = time.perf_counter()
    if code := undisturbed.finish():
        raise RuntimeError(f"exit code {code}: {undisturbed.folder}/output.txt")
    seconds = time.perf_counter() - start
    expected = undisturbed.results()
    records, turns, row = [], [], 0
    study, finished, studies = Study(Path(folder) / "study-0", **options), {}, count(1)
    while len(records) < kills:
        if not turns:
            pairs = list(product(SIGNALS, VICTIMS))
            turns = rng.sample(pairs, len(pairs))
        # A share of the time that the whole takes, of which the first of a row can see the most.
        record = killed(study, *turns[-1], rng.uniform(0.1, 0.9) * seconds)
        record["broken"] += _recomputed(study, finished)
        if not record["in_time"] and row == 0:
            # The machine was busier when the whole was timed.
            seconds = min(seconds, record["lasted_s"])
        finished, row = study.finished_seeds(), row + 1
        if record["in_time"]:
            print(
                f"  kill {len(records) + 1}: {record['signal']} to {record['victim']}", flush=True
            )
        if record["in_time"]:
            turns.pop()
        if record["in_time"] or record["broken"]:
            records.append(record)
        if record["in_time"] and row < in_a_row and len(records) < kills:
            continue
        broken = _broken_end(study, study.finish()) + _recomputed(study, finished)
        if (results := study.results()) != expected:
            broken.append(f"other bytes: {sorted(dict(results.items() ^ expected.items()))}")
        record["broken"] += broken
        if broken and not record["in_time"]:
            records.append(record)
        if not record["broken"]:
            shutil.rmtree(study.folder)
        study, finished, row = Study(Path(folder) / f"study-{next(studies)}", **options), {}, 0
    return records


def run(kills=100, seed=1, cores=2, targets=()):
    """Kill the whole of a tiny study, or what makes some of its results, as often as asked for."""
    with tempfile.TemporaryDirectory(prefix="kills-") as folder:
        records = kill_over_and_over(folder, kills, seed, cores=cores, targets=targets)
    return {
        "kills": len(records),
        "while_jobs_ran": sum(record["jobs"] > 0 for record in records),
        "broken": sum(bool(record["broken"]) for record in records),
        "seed": seed,
        "each": records,
    }


def _broken_end(study, code):
    """Return what is wrong after a command that was not disturbed."""
    broken = [f"exit code {code}"] if code else []
    broken += [f"{path} was left" for path in study.scratch()]
    return broken + [
        f"process {words_of(process).decode()} lives on" for process in study.processes()
    ]


def _recomputed(study, finished):
    """Return which files of finished seeds were written once more."""
    now = {path: os.stat(path).st_mtime_ns for path in finished if os.path.exists(path)}
    return [f"{path} was computed anew" for path in finished if now.get(path) != finished[path]]


def _mark_of(path):
    """Return the name of Snakemake's mark for a file that is not finished."""
    return base64.urlsafe_b64encode(str(path).encode()).decode()


def processes_of(mark):
    """Return the processes that live and have a mark, whoever their parents are."""
    found = []
    for process in filter(str.isdigit, os.listdir("/proc")):
        # One that has ended, or belongs to somebody else, tells nothing.
        with contextlib.suppress(OSError):
            environment = Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
            if f"{MARK}={mark}".encode() in environment:
                found.append(int(process))
    return found


def words_of(process):
    """Return the command line of a process; nothing of one that has ended."""
    with contextlib.suppress(OSError):
        return Path(f"/proc/{process}/cmdline").read_bytes().replace(b"\0", b" ").strip()
    return b""
