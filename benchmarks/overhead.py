"""What a study takes beyond LAMMPS: the workflow engine, starts of jobs, tables, fits, figures.

The study of `config.yaml` with some number of seeds, in a temporary folder, by `snakemake`. Two
cores could do no better than half the seconds inside LAMMPS: the floor.
"""

import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIMIT = 1.2
_INSIDE = re.compile(r"^branchcrush: ([\d.]+) s inside LAMMPS$", re.MULTILINE)


def run(seeds=32, cores=2, config=ROOT / "config.yaml", folder=None):
    """Return what a study takes, beside what it spends inside LAMMPS.

    Parameters
    ----------
    seeds : int
        Of every sample.
    cores : int
        That the study may use; the machine should have nothing else to do.
    config : path-like
        The study, of which only the seeds are changed.
    folder : path-like, optional
        Where the study is run and then removed; a temporary one by default.

    Returns
    -------
    dict
        `wall_seconds` of the command, `lammps_seconds` of all seeds and refined ones together,
        `floor_seconds`, the `ratio` of the wall to it and its `limit`; `cpu_seconds` of all
        processes; for each rule its `jobs`, their `mean_seconds` from start to end, and
        `last_end_seconds` after the first job began.
    """
    with tempfile.TemporaryDirectory(dir=folder, prefix="branchcrush-") as scratch:
        scratch = Path(scratch)
        text = Path(config).read_text(encoding="utf-8")
        text = re.sub(r"^( +seeds:).*$", rf"\1 {seeds}", text, flags=re.MULTILINE)
        (scratch / "config.yaml").write_text(text, encoding="utf-8")
        wall, cpu = _timed(scratch, cores)
        rules = _rules(scratch)
        inside = [
            float(_INSIDE.findall(log.read_text(encoding="utf-8"))[-1])
            for log in sorted(scratch.glob("logs/*/seed_*/compression.log"))
        ]
    floor = sum(inside) / cores
    return {
        "seeds": seeds,
        "runs": len(inside),
        "cores": cores,
        "wall_seconds": wall,
        "lammps_seconds": sum(inside),
        "floor_seconds": floor,
        "ratio": wall / floor,
        "limit": LIMIT,
        "cpu_seconds": cpu,
        "rules": rules,
    }


def _timed(folder, cores):
    """Run the study and return its seconds on the clock and of the processor."""
    beside = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    # Modules are compiled once and kept, as in any environment of a user.
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    environment |= {"PATH": beside, "PYTHONPATH": str(ROOT / "src")}
    command = [sys.executable, "-m", "snakemake", "--cores", str(cores), "--directory", str(folder)]
    before, start = _processor_time(), time.perf_counter()
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    wall, cpu = time.perf_counter() - start, _processor_time() - before
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    return wall, cpu


def _processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _rules(folder):
    """Return how many jobs each rule had and what they took, as Snakemake recorded it."""
    jobs = defaultdict(dict)
    for path in folder.glob(".snakemake/metadata/**/*"):
        if path.is_file():
            record = json.loads(path.read_text(encoding="utf-8"))
            # There is a record for each file that a job made; each job has a log of its own.
            log, span = record["log"][0], (record["starttime"], record["endtime"])
            start, end = jobs[record["rule"]].get(log, span)
            jobs[record["rule"]][log] = min(start, span[0]), max(end, span[1])
    spans = {rule: list(found.values()) for rule, found in jobs.items()}
    first = min(start for found in spans.values() for start, _ in found)
    return {
        rule: {
            "jobs": len(found),
            "mean_seconds": sum(end - start for start, end in found) / len(found),
            "last_end_seconds": max(end for _, end in found) - first,
        }
        for rule, found in sorted(spans.items(), key=lambda item: max(end for _, end in item[1]))
    }


if __name__ == "__main__":
    print(json.dumps(run(*map(int, sys.argv[1:2])), indent=2))
