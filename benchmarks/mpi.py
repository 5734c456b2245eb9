"""Two MPI ranks against one: how much faster, and whether they agree on what is certified."""

import json
import re
import tempfile
from pathlib import Path
from statistics import median

import numpy as np

from benchmarks.dense import (
    INPUTS,
    LOOP,
    apart,
    dense_packing,
    head_of_script,
    packing_variables,
    replicated,
)
from benchmarks.paths import QUANTITIES, paper_compression, paper_packing, quantities
from branchcrush.lammps.files import write_data_file
from branchcrush.lammps.run import run_script

LOADED = {"lognormal": 0.68}
# `run_script` asks for these. The clock starts when the packing is read and set up.
_BEFORE = """
variable failed equal 0
variable failure string none
variable edge string $(lx)
variable counted equal {evaluations}
variable lists equal 0
run 0 post no
include ${{inputs}}/mod.mass
variable start timer
"""
_AFTER = """
variable stop timer
print "evaluations took $(v_stop-v_start:%.6f) s for $(step)"
"""
_LOOP_SECONDS = re.compile(r"^evaluations took ([\d.]+) s for (\d+)$", re.MULTILINE)
_INSIDE = re.compile(r"^branchcrush: ([\d.]+) s inside LAMMPS$", re.MULTILINE)


def run(
    forms=("fractal 20", "lognormal"),
    base=2000,
    times=3,
    evaluations=300,
    pairs=5,
    seeds=(1, 2, 3, 4, 5, 6),
    states=15,
):
    """Return the speed-up by a second rank, and what both counts of ranks find for the paper.

    Parameters
    ----------
    forms : sequence of str
        Of `benchmarks.dense.form_of`.
    base, times : int
        A periodic packing of so many grains is repeated so often along each axis.
    evaluations : int
        Force evaluations of a measurement.
    pairs : int
        Measurements with one rank and with two, in turn.
    seeds : sequence of int
        Of the paper's case, each compressed with one and with two ranks from the same packing.
    states : int
        That a path saves.

    Returns
    -------
    dict
        `speed` for each form: `grains`, `seconds` on the clock of each pair, `speed_up` as least,
        median and largest; of the evaluations alone (`loop`) and of all inside LAMMPS (`inside`).
        `agreement` for each quantity: the mean with one rank, the mean difference of two ranks to
        it, its standard error, and the standard deviation over seeds with one rank.
    """
    return {
        "speed": {form: _speed(form, base, times, evaluations, pairs) for form in forms},
        "agreement": _agreement(seeds, states) if seeds else {},
    }


def _speed(form, base, times, evaluations, pairs):
    """Return the seconds of both counts of ranks on a packing, and their ratios."""
    (packing,) = apart(dense_packing, (form, base, LOADED.get(form, 0.72), None))
    positions, radii, edge = replicated(*packing, times)
    seconds = {"loop": [], "inside": []}
    for _ in range(pairs):
        one, two = (
            apart(_seconds, (positions, radii, edge, evaluations, ranks))[0] for ranks in (1, 2)
        )
        for name, both in seconds.items():
            both.append((one[name], two[name]))
    result = {"grains": len(radii), "evaluations": evaluations, "seconds": seconds}
    for name, both in seconds.items():
        ratios = [one / two for one, two in both]
        spread = {"least": min(ratios), "median": median(ratios), "largest": max(ratios)}
        result[f"speed_up_{name}"] = spread
    return result


def _seconds(positions, radii, edge, evaluations, ranks):
    """Return the seconds on the clock of the force evaluations, and of all inside LAMMPS."""
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as scratch:
        scratch = Path(scratch)
        (scratch / "inputs").symlink_to(INPUTS)
        before = _BEFORE.format(evaluations=evaluations // 3)
        text = head_of_script() + before + LOOP + _AFTER
        (scratch / "in.evaluations").write_text(text, encoding="utf-8")
        write_data_file(scratch / "packing.data", positions, radii, edge)
        variables = packing_variables(radii, edge, "periodic", data=scratch / "packing.data")
        variables |= {"inputs": scratch / "inputs", "output_folder": scratch}
        run_script(scratch / "in.evaluations", variables, scratch / "log", ranks)
        log = (scratch / "log").read_text(encoding="utf-8")
    return {
        "loop": float(_LOOP_SECONDS.findall(log)[-1][0]),
        "inside": float(_INSIDE.findall(log)[-1]),
    }


def _agreement(seeds, states):
    """Return each quantity with one rank and the difference that a second makes."""
    found = {1: [], 2: []}
    for seed in seeds:
        packing = paper_packing(seed)
        for ranks, rows in found.items():
            (row,) = apart(_end_of_path, (packing, states, ranks))
            if row["stopped"]:
                raise RuntimeError(f"seed {seed} on {ranks} ranks: {row['stopped']}")
            rows.append([row[name] for name in QUANTITIES])
    one, two = np.array(found[1]), np.array(found[2])
    difference = two - one
    root = np.sqrt(len(seeds))
    return {
        name: {
            "one_rank": float(one[:, k].mean()),
            "difference": float(difference[:, k].mean()),
            "standard_error": float(difference[:, k].std(ddof=1) / root),
            "standard_deviation_of_seeds": float(one[:, k].std(ddof=1)),
        }
        for k, name in enumerate(QUANTITIES)
    }


def _end_of_path(packing, states, ranks):
    return quantities(paper_compression(packing, states=states, ranks=ranks)[0], packing[1])


if __name__ == "__main__":
    print(json.dumps(run(), indent=2))
