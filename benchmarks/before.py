"""This checkout beside another one of the project: what the same packings take, and where they end.

Pairs in turn, each as a process of its own. The other checkout, say that of the commit before, is
a folder with its src, lammps_inputs and benchmarks/peers:

    git worktree add ../before COMMIT
    python -m benchmarks before 'other="../before"' --results /tmp/before
"""

import json
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.codes import CHECKOUT, run_case, run_tables
from benchmarks.fractal import PARTS, STRAIN, dense_case
from benchmarks.measure import difference, ratios
from benchmarks.paper import COMPARISONS, paper_case
from benchmarks.paths import quantities

# Of the paper's case: how it is loaded in each of the comparisons.
PAPER = {
    name: COMPARISONS[name]["branchcrush"]
    for name in ("what_the_workflow_does", "same_path_for_all")
}
_COMPARED = (
    "mean_stress_Pa",
    "energy_density_J_m3",
    "mechanical_coordination_number",
    "jamming_solid_fraction",
)
_TAKEN = ("cpu_s", "evaluations", "cpu_s_per_evaluation", "inside_cpu_s_per_evaluation")


def run(
    other,
    seeds=(9, 10, 11, 12, 13, 14, 15, 16, 17, 18),
    grains=1000,
    fractal_grains=20_000,
    fractal_pairs=5,
    loosened=None,
):
    """Return what this checkout takes over what another one does, and the difference of states.

    Parameters
    ----------
    other : path-like
        The other checkout.
    seeds : sequence of int
        Of the paper's case.
    grains : int
    fractal_grains : int
        Of the fractal grading of `benchmarks.fractal`; 0 leaves it out.
    fractal_pairs : int
        Runs from the same dense packing to rest, in turn.
    loosened : dict, optional
        Settings of the case for this checkout alone, as `state_tolerance`.

    Returns
    -------
    dict
        `cases`, for each path of the paper's case and for the certified fractal packing: the
        `ratio` of this checkout to the other in CPU seconds of the whole process, in force
        evaluations, and in CPU seconds an evaluation, of the whole process and of the compression
        inside it; the `difference` of the last states, mean and standard error over the pairs; and
        every run of both.
    """
    other, loosened = Path(other).resolve(), loosened or {}
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
        folder = Path(folder)
        cases = {name: [] for name in PAPER}
        for seed in seeds:
            packing = paper_case(folder, int(seed), grains)
            for name, path in PAPER.items():
                case = {**packing, "path": path}
                pair = _pair(case, loosened, other, folder, f"{name}_{seed}", len(cases[name]) % 2)
                cases[name].append({"seed": int(seed), **pair})
        if fractal_grains:
            case = _fractal(folder, fractal_grains)
            cases["certified_fractal"] = [
                {"pair": n, **_pair(case, loosened, other, folder, f"fractal_{n}", n % 2)}
                for n in range(fractal_pairs)
            ]
    return {
        "other": str(other),
        "loosened": loosened,
        "cases": {name: compared(pairs) for name, pairs in cases.items() if pairs},
    }


def _fractal(folder, grains):
    """Return the case of a packing that `benchmarks.fractal` certifies, made by this checkout."""
    dense, _ = dense_case(folder, grains, 20.0)
    code, path = PARTS["branchcrush"]
    strained = {**dense, "final_edge": dense["edge"] * (1.0 - STRAIN), "path": path}
    start = run_case(code, {**strained, "largest_iterations": 300}, folder, "strained")
    return {**strained, "packing": start["packing"], "edge": strained["final_edge"]}


def _pair(case, loosened, other, folder, name, other_first):
    """Run a case with both checkouts; return what each took and the quantities of its state."""
    with np.load(case["packing"]) as arrays:
        radii = arrays["radii"]
    found = {}
    runs = {"this": (CHECKOUT, {**case, **loosened}), "other": (other, case)}
    # Whoever comes second finds a warmer machine, so they take turns.
    for which in sorted(runs, reverse=not other_first):
        checkout, given = runs[which]
        done = run_tables(given, folder, f"{name}_{which}", checkout)
        found[which] = {
            "cpu_s": done["cpu_s"],
            "inside_cpu_s": done["inside_cpu_s"],
            "evaluations": done["evaluations"],
            "cpu_s_per_evaluation": done["cpu_s"] / done["evaluations"],
            "inside_cpu_s_per_evaluation": done["inside_cpu_s"] / done["evaluations"],
            "unbalanced_force_ratio": float(done["tables"].path["unbalanced_force_ratio"][-1]),
            **{name: quantities(done["tables"], radii)[name] for name in (*_COMPARED, "stopped")},
        }
    return found


def compared(pairs):
    """Return ratios and differences of pairs of runs, this checkout against the other.

    Pairs of which a run stopped before its end are told, and left out.

    Parameters
    ----------
    pairs : list of dict
        `this` and `other`, each with what it took and its quantities.

    Returns
    -------
    dict
        `ended`, of how many `pairs`; `ratio` and `difference` by name; `runs`.

    Examples
    --------
    >>> taken = dict.fromkeys(_TAKEN, 1.0) | dict.fromkeys(_COMPARED, 2.0) | {"stopped": ""}
    >>> one = {"this": taken | {"cpu_s": 0.75, "mean_stress_Pa": 2.5}, "other": taken}
    >>> found = compared([one, one])
    >>> found["ratio"]["cpu_s"]["median"], found["difference"]["mean_stress_Pa"]["mean"]
    (0.75, 0.5)
    """
    ended = [p for p in pairs if not (p["this"]["stopped"] or p["other"]["stopped"])]
    result = {"pairs": len(pairs), "ended": len(ended), "runs": pairs}
    if not ended:
        return result
    columns = {
        name: [[pair[which][name] for pair in ended] for which in ("this", "other")]
        for name in (*_TAKEN, *_COMPARED)
    }
    result["ratio"] = {name: ratios(*columns[name]) for name in _TAKEN}
    result["difference"] = {}
    for name in _COMPARED:
        known = [pair for pair in zip(*columns[name], strict=True) if np.isfinite(pair).all()]
        if known:
            result["difference"][name] = difference(*zip(*known, strict=True))
    return result


def summary(result):
    """Return the lines that tell of a result in short."""
    lines = []
    for name, case in result["cases"].items():
        lines.append(f"{name}: {case['ended']} of {case['pairs']} pairs came to their end")
        for taken, by in case.get("ratio", {}).items():
            ratio = "{median:.3f} ({min:.3f} to {max:.3f})".format(**by)
            lines.append(f"  {taken}: {ratio} times the other's")
        for quantity, by in case.get("difference", {}).items():
            error = by["standard_error"]
            line = f"  {quantity}: {by['mean']:+.4g}"
            lines.append(line + ("" if error is None else f" ± {error:.2g}"))
    return lines


if __name__ == "__main__":
    import sys

    print(json.dumps(run(sys.argv[1]), indent=2))
