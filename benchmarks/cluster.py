"""What a study on a cluster takes beside its packings, and what a large one would take.

Slurm runs on this machine (`benchmarks.slurm`): hundreds of tiny packings, many in a job, some of
them one in a job, and some without a cluster. A packing of 1000 grains, made without a cluster,
tells what larger ones take. Needs root, and Debian's packages slurm-wlm and munge.
"""

import contextlib
import math
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.slurm import Cluster

ROOT = Path(__file__).resolve().parents[1]
TINY = """\
samples:
  tiny:
    grading: {{form: uniform, basis: number, size: radius, unit: m, min: 5.0e-4, max: 1.0e-3}}
    grains: 30
    allow_unrepresentative: true
    loading: {{edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 4, quality: draft}}
    seeds: {seeds}
    refined_seeds: 0
keep_dumps: none
"""
# The paper's grading and loading, as in config.yaml.
THOUSAND = """\
samples:
  thousand:
    grading: {form: uniform, basis: number, size: radius, unit: m, min: 5.0e-6, max: 1.0e-3}
    grains: 1000
    loading: {edge_reduction: 0.4, quality: standard}
    seeds: 2
    refined_seeds: 0
keep_dumps: none
"""
# Evaluations grow as the cube root of the grains (study/cost.py), and what each takes as they do.
_GROWTH = 4.0 / 3.0
_REQUEST = re.compile(r"^\s+(REQUEST_\w+)\s+\(.*count:(\d+)", re.MULTILINE)
# Seconds between looks at the queue, as in the profile; for jobs of seconds.
_LOOK = 5


def run(packings=300, group=50, single=10, study=1000, times=10):
    """Return what each way takes, and what a large study would.

    Parameters
    ----------
    packings, group : int
        Tiny packings, and how many of them share a job.
    single : int
        That have a job each, and that are made without a cluster.
    study, times : int
        Packings of the large study, and how many times 1000 grains each has.

    Returns
    -------
    dict
        Of each way `wall_seconds`, `processor_seconds`, `files` and `inodes` left, `megabytes`, and
        on the cluster `jobs` and `requests` of its controller; `job_seconds`, what a job costs a
        processor beside what it is for, and `grouped_seconds`, its share where packings share a
        job; `study`, from `expected`.
    """
    with tempfile.TemporaryDirectory(prefix="cluster-") as folder, _accounted() as used:
        folder = Path(folder)
        alone = _study(folder / "alone", TINY.format(seeds=single), ["--cores", "2"], used)
        thousand = _study(folder / "thousand", THOUSAND, ["--cores", "1"], used)
        (folder / "slurm").mkdir()
        cluster = Cluster(folder / "slurm")
        cluster.start()
        try:
            tiny = TINY.format(seeds=single)
            singly = _study(folder / "single", tiny, _on_cluster(1), used, cluster)
            tiny = TINY.format(seeds=packings)
            grouped = _study(folder / "grouped", tiny, _on_cluster(group), used, cluster)
        finally:
            cluster.stop()
    return derived(alone, thousand, singly, grouped, study, times)


def derived(alone, thousand, single, grouped, study, times):
    """Return what was measured, and what follows from it: what `run` returns.

    Parameters
    ----------
    alone, thousand, single, grouped : dict
        Of `run`.
    study, times : int
        As for `run`.

    Returns
    -------
    dict
    """
    of_alone, of_single, of_grouped = map(_of_packing, (alone, single, grouped))
    return {
        "alone": alone,
        "thousand": thousand,
        "single": single,
        "grouped": grouped,
        "job_seconds": of_single - of_alone,
        "grouped_seconds": of_grouped - of_alone,
        "study": expected(
            packings=study,
            seconds=_of_packing(thousand) * times**_GROWTH + of_grouped - of_alone,
            megabytes=thousand["megabytes"] / thousand["packings"] * times,
            files=grouped["files"] / grouped["packings"],
            inodes=grouped["inodes"] / grouped["packings"],
            requests=sum(grouped["requests"].values()) / grouped["packings"],
            requests_of_job=sum(single["requests"].values()) / single["jobs"],
        ),
    }


def expected(
    packings,
    seconds,
    megabytes,
    files,
    inodes,
    requests,
    requests_of_job,
    nodes=4,
    cores=32,
    minutes=20,
):
    """Return what a study takes of a cluster, from what one packing takes.

    Parameters
    ----------
    packings : int
    seconds, megabytes, files, inodes, requests : float
        Of a core, of the disk, how many files, and with their folders, and of the controller, for
        each packing.
    requests_of_job : float
        Of the controller, for each job besides.
    nodes, cores : int
        At hand, and those of a node.
    minutes : float
        That a job is to take at least.

    Returns
    -------
    dict
        `group`, packings of a job; `jobs`; `core_hours`; `hours`, on all nodes; `gigabytes`;
        `files`; `inodes`; `requests`, of the controller, and `requests_a_minute`.

    Examples
    --------
    >>> expected(1000, 300.0, 40.0, 20.0, 23.0, 5.0, 10.0, nodes=2, cores=10)["group"]
    4
    """
    group = math.ceil(60.0 * minutes / seconds)
    jobs = math.ceil(packings / group)
    # As many at a time as there are cores, each as long as all its packings.
    hours = math.ceil(jobs / (nodes * cores)) * group * seconds / 3600.0
    looks = 3600.0 * hours / 180.0  # at the queue, at most so far apart
    requests = packings * requests + jobs * requests_of_job + looks
    return {
        "group": group,
        "jobs": jobs,
        "core_hours": packings * seconds / 3600.0,
        "hours": hours,
        "gigabytes": packings * megabytes / 1000.0,
        "files": round(packings * files),
        "inodes": round(packings * inodes),
        "requests": round(requests),
        "requests_a_minute": requests / (60.0 * hours),
    }


def _on_cluster(group):
    """Return the arguments of a study on the cluster."""
    return [
        *("--workflow-profile", "slurm", "--jobs", "2", "--slurm-status-command", "squeue"),
        *("--slurm-init-seconds-before-status-checks", str(_LOOK), "--latency-wait", "5"),
        *(["--groups", "compression=packings"] if group > 1 else []),
        *(["--group-components", f"packings={group}", "--cores", "1"] if group > 1 else []),
    ]


def _study(folder, config, arguments, used, cluster=None):
    """Run a study up to its certificates, and return what it took."""
    folder.mkdir()
    (folder / "config.yaml").write_text(config, encoding="utf-8")
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    environment["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment["PYTHONPATH"] = os.pathsep.join(
        [str(ROOT / "src"), *filter(None, [os.environ.get("PYTHONPATH")])]
    )
    name = re.search(r"^  (\w+):$", config, re.MULTILINE)[1]
    before = {}
    if cluster is not None:
        environment |= cluster.environment
        before = _requests(cluster)
    command = [sys.executable, "-m", "snakemake", *arguments]
    command += ["--snakefile", str(ROOT / "Snakefile"), f"results/{name}/jamming.csv"]
    start, before_it = time.perf_counter(), used()
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    wall, processor = time.perf_counter() - start, used() - before_it
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    files = [path for path in folder.rglob("*") if path.is_file()]
    told = {
        "packings": len(list(folder.glob("results/*/seed_*/made.json"))),
        "wall_seconds": wall,
        "processor_seconds": processor,
        "files": len(files),
        "inodes": len(list(folder.rglob("*"))),
        "megabytes": sum(path.stat().st_size for path in files) / 1e6,
    }
    if cluster is not None:
        after = _requests(cluster)
        asked = {kind: after[kind] - before.get(kind, 0) for kind in after}
        told |= {
            "jobs": asked["REQUEST_SUBMIT_BATCH_JOB"],
            "requests": {kind: number for kind, number in asked.items() if number},
        }
    return told


def _requests(cluster):
    """Return how many requests of each kind the controller has answered."""
    return {kind: int(count) for kind, count in _REQUEST.findall(cluster.said("sdiag"))}


@contextlib.contextmanager
def _accounted():
    """Yield what tells the processor's time of all that is started meanwhile, daemons too [s]."""
    first, second = Path("/sys/fs/cgroup/cpuacct"), Path("/sys/fs/cgroup")  # versions of the kernel
    root = first if first.is_dir() else second
    group = root / f"branchcrush-{os.getpid()}"
    group.mkdir()
    (group / "cgroup.procs").write_text("0")

    def seconds():
        if root == first:
            return int((group / "cpuacct.usage").read_text()) / 1e9
        return int(re.search(r"usage_usec (\d+)", (group / "cpu.stat").read_text())[1]) / 1e6

    try:
        yield seconds
    finally:
        (root / "cgroup.procs").write_text("0")
        # Daemons may end later; an empty group is nothing.
        with contextlib.suppress(OSError):
            group.rmdir()


def _of_packing(told):
    """Return what a packing took of a processor, with its share of all else [s]."""
    return told["processor_seconds"] / told["packings"]
