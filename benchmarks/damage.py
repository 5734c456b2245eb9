"""What becomes of files of a study that are damaged: none may pass in silence; and what it costs.

Damage is done to a finished study, one file at a time, and put right again. It is told by the job
that reads the file, as the workflow starts it; by the results API, where it opens such a file; and
by `branchcrush verify`, which reads all. Which bits are flipped is drawn by a seeded generator.
"""

import contextlib
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from benchmarks.damaged_study import Damaged, flipped, kind_of
from branchcrush.files.digests import Digests, digests_of
from branchcrush.files.intact import check_inputs
from branchcrush.files.made import is_record, record_bytes

ROOT = Path(__file__).resolve().parents[1]
CONFIG = """\
samples:
  sand:
    grading: {form: uniform, basis: number, size: radius, unit: m, min: 5.0e-4, max: 1.0e-3}
    grains: 30
    allow_unrepresentative: true
    loading: {edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 4, quality: draft}
    seeds: 2
    refined_seeds: 1
  breaking:
    grading: {form: uniform, basis: number, size: diameter, unit: mm, min: 0.8, max: 1.2}
    grains: 24
    allow_unrepresentative: true
    loading: {solid_fraction: 0.6, approach_solid_fraction: 0.42, states: 5, quality: draft}
    breakage:
      strength: 1.0e7
      weibull_modulus: 3
      unit: mm
      reference_diameter: 1.0
      smallest_diameter: 0.7
      fragments: 6
      growth_stages: 2
    seeds: 1
    refined_seeds: 0
energy_split: {resamples: 100}
figures: {dpi: 60}
"""


def run(flips=2000, seed=1, packings=1000):
    """Return who tells of flipped bits, and what the checks cost.

    Parameters
    ----------
    flips : int
        Bits that are flipped, each in a file of its own turn.
    seed : int
        Of the generator that draws files and bits.
    packings : int
        Of the study of which the cost is measured too.

    Returns
    -------
    dict
        `files` and `flips` by kind of file, `told` by whom, and those that are `silent`; what the
        checks of all jobs take, beside the study (`share`); the same of many packings.
    """
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as scratch:
        scratch = Path(scratch)
        (scratch / "config.yaml").write_text(CONFIG, encoding="utf-8")
        cpu, wall = _studied(scratch)
        damaged = Damaged(scratch)
        return {
            **_flips(damaged, flips, random.Random(seed)),
            "study_wall_seconds": wall,
            "study_cpu_seconds": cpu,
            **_share(damaged, cpu),
            "many": _many(damaged, packings),
        }


def summary(result):
    """Return what is shown of a result."""
    told, many = result["told"], result["many"]
    whom = ", ".join(f"{who} {number}" for who, number in told.items())
    return [
        f"{sum(result['flips'].values())} bits flipped in {sum(result['files'].values())} files, "
        f"told by {whom}",
        f"silent: {len(result['silent'])}; without the name of the file: {len(result['unnamed'])}",
        f"checks of all {result['jobs']} jobs: {result['share']:.2%} of the study's processor time",
        f"a job that reads {many['packings']} packings ({many['megabytes']:.0f} MB): "
        f"{many['check_seconds']:.1f} s",
    ]


def _studied(folder):
    """Run a study, and return the seconds of the processor and on the clock that it took."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "src")}
    environment["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    before, start = os.times(), time.perf_counter()
    command = [sys.executable, "-m", "snakemake", "--cores", "2"]
    done = subprocess.run(
        [*command, "--snakefile", str(ROOT / "Snakefile")],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
    )
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    after, wall = os.times(), time.perf_counter() - start
    used = after.children_user + after.children_system
    return used - before.children_user - before.children_system, wall


def _flips(damaged, flips, rng):
    """Flip a bit of each file in turn, for jobs and API; then of all at once, for `verify`."""
    counts, told, silent, unnamed = Counter(), Counter(), [], []
    while sum(counts.values()) < flips:
        files = rng.sample(damaged.files, min(len(damaged.files), flips - sum(counts.values())))
        contents = {path: flipped((damaged.folder / path).read_bytes(), rng) for path in files}
        counts.update(map(kind_of, files))
        for path, content in contents.items():
            with damaged.changed(path, content):
                for who, said in damaged.told_by(path).items():
                    told[who] += 1
                    silent += [] if said else [(who, path)]
                    unnamed += [] if f"/{Path(path).name} " in said else [(who, path)]
        # A damaged record proves nothing of its files: not in the same turn.
        for records in (False, True):
            with contextlib.ExitStack() as all_at_once:
                turn = [path for path in files if is_record(path) == records]
                for path in turn:
                    all_at_once.enter_context(damaged.changed(path, contents[path]))
                _, lines = damaged.verify_says()
            named = {line.split(" ")[0] for line in lines}
            told["verify"] += len(turn)
            silent += [("verify", path) for path in turn if str(damaged.folder / path) not in named]
    return {
        "files": dict(Counter(map(kind_of, damaged.files))),
        "flips": dict(counts),
        "told": dict(told),
        "silent": silent,
        "unnamed": unnamed,
    }


def _share(damaged, cpu):
    """Return what the checks of all jobs take of the processor, read from the disk's cache."""
    start = time.process_time()
    for path, record in damaged.jobs.items():
        with contextlib.chdir(damaged.folder):
            digests = digests_of(record["inputs"], Digests("cost", trust=False))
            check_inputs({**record, "inputs": digests}, path)
    seconds = time.process_time() - start
    start = time.process_time()
    damaged.verify_says()
    return {
        "jobs": len(damaged.jobs),
        "check_seconds": seconds,
        "share": seconds / cpu,
        "verify_seconds": time.process_time() - start,
    }


def _many(damaged, packings):
    """Return what the check of one job takes that reads many packings, each of the paper's size."""
    seed = next(path for path in damaged.jobs if re.search(r"sand/seed_1/made\.json$", path))
    record = damaged.jobs[seed]
    names = ("packing.npz", "path.csv", "contacts.parquet", "wall_contacts.parquet")
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as scratch, contextlib.chdir(scratch):
        # Contacts of 1000 grains in 13 states, which none compresses further.
        source = damaged.folder / "results/sand/seed_1"
        big = random.Random(0).randbytes(2_000_000)
        for k in range(1, packings + 1):
            folder = Path("results", "sand", f"seed_{k}")
            folder.mkdir(parents=True)
            for name in names:
                shutil.copy(source / name, folder / name)
            (folder / "contacts.parquet").write_bytes(big)
            paths = [str(folder / name) for name in names]
            told = {**record, "wildcards": {"sample": "sand", "seed": str(k)}}
            told.pop("sha256")
            told |= {"outputs": digests_of(paths, Digests("many")), "inputs": {}, "beside": {}}
            (folder / "made.json").write_bytes(record_bytes(told))
        paths = [f"results/sand/seed_{k}/{name}" for k in range(1, packings + 1) for name in names]
        start = time.process_time()
        digests = digests_of(paths, Digests("cost", trust=False))
        read = time.process_time() - start
        job = {"wildcards": {"sample": "sand"}, "params": {}, "inputs": digests}
        check_inputs(job, "results/sand/made/fit.json")
        seconds = time.process_time() - start
    return {
        "packings": packings,
        "files": len(paths),
        "megabytes": packings * len(big) / 1e6,
        "digest_seconds": read,
        "check_seconds": seconds,
    }
