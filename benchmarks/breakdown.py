"""Where the time of one packing of the default study goes: in LAMMPS, and beside it.

LAMMPS tells by its own timers; a job is sampled by py-spy, which tells the same from outside, and
what comes before and after LAMMPS. py-spy is no part of the environment: pip install py-spy.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np

from branchcrush.config.build import grading_of
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.lammps.compression import compress, compression_variables
from branchcrush.loading.targets import STATE_TOLERANCES, Loading, strain_step
from branchcrush.packings.contact_laws import contact_law
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

ROOT = Path(__file__).resolve().parents[1]
LOADING = Loading("edge_reduction", 0.4)
GRADING = {"form": "uniform", "basis": "number", "size": "radius", "unit": "m"}
_TIMER = re.compile(r"^(\w+) +\| +[\d.e+-]* *\| +([\d.e+-]+) +\|", re.MULTILINE)
_LOOP = re.compile(r"^Loop time of (\S+) on \d+ procs for (\d+) steps", re.MULTILINE)


def run(seed=1):
    """Return where the time of a packing of the paper's case goes.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
        `lammps`: its seconds by its own timers, the part outside of its loops (setting up, the
        script, dumps) and force evaluations; `job`: seconds of a whole process by what it does,
        and by py-spy the share of each Python function under which samples fell, or `missing`.
    """
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
        folder = Path(folder)
        return {"seed": seed, "lammps": _timers(seed, folder), "job": _job(seed, folder)}


def _timers(seed, folder):
    """Run the script with the timers of each relaxation printed, and add them up."""
    inputs = shutil.copytree(ROOT / "lammps_inputs", folder / "inputs")
    relax = inputs / "mod.relax"
    text = relax.read_text(encoding="utf-8")
    # Only the runs that relax: a timer line of each is 60 microseconds.
    relax.write_text(text.replace("pre no post no", "pre no post yes"), encoding="utf-8")
    log = folder / "timers.log"
    packing(seed, folder / "run", log, inputs)
    text = log.read_text(encoding="utf-8")
    seconds = Counter()
    for name, value in _TIMER.findall(text):
        seconds[name] += float(value)
    loops = [(float(time), int(steps)) for time, steps in _LOOP.findall(text)]
    inside = float(re.findall(r"([\d.]+) s inside LAMMPS", text)[-1])
    looped = sum(time for time, _ in loops)
    return {
        "seconds": inside,
        "of_which": {**seconds, "outside of loops": inside - looped},
        "force_evaluations": sum(steps for _, steps in loops),
        "runs": len(loops),
        "microseconds_per_evaluation": 1e6 * looped / sum(steps for _, steps in loops),
    }


def _job(seed, folder):
    command = [sys.executable, "-m", "benchmarks.breakdown", str(seed), str(folder)]
    start = time.perf_counter()
    done = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
    whole = time.perf_counter() - start
    phases = json.loads(done.stdout.splitlines()[-1])
    result = {"seconds": whole, "of_which": {**phases, "start": whole - sum(phases.values())}}
    if not shutil.which("py-spy"):
        return {**result, "missing": "py-spy: pip install py-spy"}
    raw = folder / "py-spy.txt"
    spy = ["py-spy", "record", "--rate", "200", "--format", "raw", "--output", str(raw), "--"]
    subprocess.run([*spy, *command], cwd=ROOT, check=True, capture_output=True)
    samples = Counter()
    for line in raw.read_text(encoding="utf-8").splitlines():
        stack, _, count = line.rpartition(" ")
        samples[_place(stack)] += int(count)
    total = sum(samples.values())
    return {**result, "py_spy": {k: n / total for k, n in samples.most_common(12)}}


def _place(stack):
    """Return the innermost function of this package under which a sample fell, or `imports`."""
    frames = stack.split(";")
    if any("importlib" in frame for frame in frames):
        return "imports"
    own = [frame for frame in frames if "branchcrush" in frame or "benchmarks" in frame]
    return re.sub(r":\d+\)$", ")", own[-1]) if own else "other"


def packing(seed, folder, log, inputs=ROOT / "lammps_inputs"):
    """Place and compress a packing of the paper's case; return seconds of placing, and of all else.

    Parameters
    ----------
    seed : int
    folder, log, inputs : path-like
        As for `simulation.compress`.

    Returns
    -------
    dict
        [s]
    """
    start = time.perf_counter()
    rng = np.random.default_rng(seed)
    radii = sampled_radii(grading_of({**GRADING, "min": 5e-6, "max": 1e-3}), 1000, "random", rng)
    edge = cube_edge(radii, 0.16)
    positions = random_packing(radii, edge, periodic=False, rng=rng)
    placed = time.perf_counter()
    variables = compression_variables(
        radii,
        0.16,
        boundary="walls",
        law=contact_law("linear", normal_stiffness=1e6),
        loading=LOADING,
        strain_step=strain_step("standard"),
        state_tolerance=STATE_TOLERANCES["standard"],
    )
    compress(positions, radii, edge, variables, inputs=inputs, folder=folder, log=log)
    done = time.perf_counter()
    text = Path(log).read_text(encoding="utf-8")
    inside = float(re.findall(r"([\d.]+) s inside LAMMPS", text)[-1])
    return {
        "placing": placed - start,
        "LAMMPS": inside,
        "loading LAMMPS, reading its dumps": done - placed - inside,
    }


if __name__ == "__main__":
    if len(sys.argv) > 2:
        place = Path(sys.argv[2]) / "job"
        print(json.dumps(packing(int(sys.argv[1]), place, place.with_suffix(".log"))))
    else:
        print(json.dumps(run(), indent=2))
