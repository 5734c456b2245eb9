"""How long the analysis of 10 million contacts takes, and how much memory, rule by rule.

Two invented samples in the layout and formats of `results/`: one of many seeds, and one packing of
a million grains. Their energies are drawn about a power law, so that the exponents that come out
are known. Every step is a process of its own, whose time and memory the system keeps account of.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# Parent of processes whose peak memory is measured: this module imports nothing large, because the
# account of a process begins at the size of its parent.
_STEPS = Path(__file__).with_name("analysis_steps.py")

SAMPLES = {
    "many_seeds": {"seeds": 16, "grains": 25_000, "states": 10, "contacts": 10_000_000},
    "large_packing": {"seeds": 1, "grains": 1_000_000, "states": 3, "contacts": 10_000_000},
}
LIMITS = {"cpu_seconds": 25.0, "peak_memory_MB": 2000.0}


def run(samples=SAMPLES, resamples=1000, folder=None):
    """Return what each step of the analysis takes, and the exponents it finds.

    Parameters
    ----------
    samples : dict of dict
        By name: seeds, grains of each, loaded states, and contacts of all seeds and states.
    resamples : int
        Draws of the seeds for the intervals.
    folder : path-like, optional
        Where the samples are written and then removed; a temporary one by default. They take
        about 80 bytes for each contact.

    Returns
    -------
    dict
        `limits`, and for each sample its `contacts`, the `steps` with cpu_seconds, wall_seconds
        and peak_memory_MB, the `rules` together (times added, the largest memory), and the
        exponents put in and found.
    """
    with tempfile.TemporaryDirectory(dir=folder, prefix="branchcrush-") as scratch:
        results = {
            name: _sample(Path(scratch) / name, name, sample, resamples)
            for name, sample in samples.items()
        }
    return {"limits": LIMITS, "resamples": resamples, **results}


def _sample(folder, name, sample, resamples):
    folder.mkdir()
    made, writing = _measured("make_sample", folder, name=name, resamples=resamples, **sample)
    rules = {label: _measured("run_rule", folder, **job)[1] for label, job in made["rules"].items()}
    table = made["largest_table"]
    steps = {"write the sample": writing, **rules}
    steps["read a seed's contacts, all columns"] = _measured("read_contacts", folder, path=table)[1]
    state, steps["a state: all its functions"] = _measured(
        "judge_state", folder, path=table, grains=sample["grains"]
    )
    fit = json.loads((folder / made["fit"]).read_text(encoding="utf-8"))
    return {
        **sample,
        "steps": steps,
        "state": state,
        "rules": {
            "cpu_seconds": round(sum(step["cpu_seconds"] for step in rules.values()), 2),
            "wall_seconds": round(sum(step["wall_seconds"] for step in rules.values()), 2),
            "peak_memory_MB": max(step["peak_memory_MB"] for step in rules.values()),
        },
        "exponent_put_in": made["exponent"],
        "exponent_of_bins": fit["exponent"],
        "exponent_of_all_branches": fit["predictors"][0]["exponent"],
        "standard_error_of_all_branches": made["standard_error"],
    }


def _measured(step, folder, **arguments):
    """Run a step in a process of its own; return what it prints, and what it took."""
    command = [sys.executable, str(_STEPS), step, json.dumps(arguments)]
    # Snakemake gives a job of one thread as many for its linear algebra.
    threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    start = time.perf_counter()
    with subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, env=os.environ | threads
    ) as process:
        printed = process.stdout.read()
        # Of this child alone; getrusage of all children knows only the largest so far.
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise subprocess.CalledProcessError(process.returncode, command)
    return json.loads(printed or "null"), {
        "cpu_seconds": round(usage.ru_utime + usage.ru_stime, 2),
        "wall_seconds": round(time.perf_counter() - start, 2),
        "peak_memory_MB": round(usage.ru_maxrss / 1024.0),
    }


if __name__ == "__main__":
    print(json.dumps(run(), indent=2))
