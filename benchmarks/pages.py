"""What the figures and pages of a study of many samples take, when all before them is there.

Samples of small packings, made anew in a temporary folder: a figure of few grains takes about as
long as one of many. Their results are made first, and not measured.
"""

import os
import sys
import tempfile
from pathlib import Path

from benchmarks.measure import run_timed

ROOT = Path(__file__).resolve().parents[1]
GOAL = 40.0
PAGES = ("packing_figures", "fit_figures", "comparison", "report", "findings", "findings_figures")
_SAMPLE = """\
  sample-{number}:
    grading: {{form: uniform, basis: number, size: radius, unit: m, min: 5.0e-5, max: 1.0e-3}}
    grains: {grains}
    allow_unrepresentative: true
    boundary: periodic
    loading: {{edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 8, quality: draft}}
    seeds: [{first}, {second}]
    refined_seeds: 0
"""


def run(samples=20, cores=2, grains=100, folder=None):
    """Return what figures and pages take; the machine should have nothing else to do.

    Parameters
    ----------
    samples : int
        Of two seeds each.
    cores : int
        That `snakemake` may use.
    grains : int
        Of each packing.
    folder : path-like, optional
        Where the study is run and then removed; a temporary one by default.

    Returns
    -------
    dict
        `wall_s` of the command and its `goal_s`; `cpu_s`, of all processes; `files`, how many were
        made.
    """
    with tempfile.TemporaryDirectory(dir=folder, prefix="branchcrush-") as scratch:
        study = "".join(
            _SAMPLE.format(number=n, grains=grains, first=2 * n + 1, second=2 * n + 2)
            for n in range(samples)
        )
        Path(scratch, "config.yaml").write_text(f"samples:\n{study}", encoding="utf-8")
        _snakemake(scratch, cores, "--omit-from", *PAGES)
        before = _files(scratch)
        took = _snakemake(scratch, cores)
        made = _files(scratch) - before
    return {
        "samples": samples,
        "cores": cores,
        "grains": grains,
        "wall_s": took["wall_s"],
        "goal_s": GOAL,
        "cpu_s": took["cpu_s"],
        "files": len(made),
    }


def summary(result):
    """Return what came of it in lines for a person."""
    return [
        f"{result['files']} figures, tables and pages of {result['samples']} samples on "
        f"{result['cores']} cores: {result['wall_s']:.0f} s (goal {result['goal_s']:.0f} s), "
        f"{result['cpu_s']:.0f} s of processor time"
    ]


def _snakemake(folder, cores, *arguments):
    """Run the workflow in a folder and return what it took."""
    beside = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    # Modules are compiled once and kept, as in any environment of a user.
    environment = {"PATH": beside, "PYTHONPATH": str(ROOT / "src"), "PYTHONDONTWRITEBYTECODE": ""}
    command = [sys.executable, "-m", "snakemake", "--snakefile", ROOT / "Snakefile"]
    where = ["--cores", cores, "--directory", folder]
    return run_timed([*command, *where, *arguments], environment)


def _files(folder):
    return set(Path(folder, "results").rglob("*.*"))
