"""20 000 grains of a fractal grading: what a force evaluation takes in each code.

No code but branchcrush is taken all the way: one dense packing is made, and each code goes on from
it for a part. In doubt the peers have the advantage: of branchcrush all that LAMMPS does in strain
steps is counted, lists that are made anew with the cell included, and of the others only their
iterations, with the lists that these ask for.
"""

import statistics
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.codes import absent, judged, largest_coordination, loose_packing, run_case
from benchmarks.dense import apart, evaluations_cost
from benchmarks.measure import ratios
from branchcrush.config.build import grading_of
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.packings.geometry import cube_edge

GRADING = {"form": "fractal", "basis": "number", "size": "radius", "unit": "m", "alpha": 2.5}
LARGEST = 1e-3
FRACTION, APPROACH, DENSE = 0.3, 0.6, 0.82
STIFFNESS, TOLERANCE = 1e6, 1e-7
STRAIN = 1e-3
_COARSE = {
    "approach_solid_fraction": APPROACH,
    "strain_step": 1e-2,
    "step_evaluations": 100,
    "states": 1,
}
PARTS = {
    "branchcrush": ("branchcrush", {"states": 1}),
    "branchcrush_bin": ("branchcrush", {"states": 1, "neighbours": "bin"}),
    # A shorter verlet distance than its driver takes for the paper's packing: peers/README.md.
    "yade": ("yade", {"strain_step": 1e-2, "verlet": 0.1}),
    # Its time step and skin follow from the packing.
    "liggghts": ("liggghts", {"steps": 1, "relax": 50, "check_every": 50}),
}
# Of LIGGGHTS over the mean radius: as branchcrush's own.
_SKIN = 0.6
# Time steps of LIGGGHTS: at most, and over the largest one that is stable for equal masses.
_TIME_STEP, _STABLE = 0.4, 0.8
_JUDGED = (
    "solid_fraction",
    "mean_stress_Pa",
    "coordination_number",
    "unbalanced_force_ratio",
    "contacts",
    "escaped",
)


def run(grains=20_000, ratio=20.0, pairs=5, evaluations=300, peer_evaluations=100, certified=True):
    """Return what a force evaluation of a dense fractal packing takes in each code.

    Parameters
    ----------
    grains : int
    ratio : float
        Largest over smallest radius [-].
    pairs : int
        Runs of each code, in turn.
    evaluations, peer_evaluations : int
        Of one run.
    certified : bool
        Whether branchcrush goes on to a state at rest.

    Returns
    -------
    dict
        `missing`; `dense`, how the packing was made and its state; for each of `PARTS` the
        `cpu_s_per_evaluation` (start excluded), `ratio_to_branchcrush`, and the `state` at the
        end; `certified`, what branchcrush took to come to rest, and what the others would for as
        many evaluations, an estimate.
    """
    lacking = absent([code for code, _ in PARTS.values()])
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
        folder = Path(folder)
        dense, made = dense_case(folder, grains, ratio)
        part = {**dense, "final_edge": dense["edge"] * (1.0 - STRAIN)}
        runs = {name: [] for name, (code, _) in PARTS.items() if code not in lacking}
        for pair in range(pairs):
            for name, done in runs.items():
                done.append(_part(folder, part, name, pair, evaluations, peer_evaluations))
        parts = {name: _summed(done, runs["branchcrush"], part) for name, done in runs.items()}
        result = {"grains": grains, "ratio": ratio, "strain": STRAIN, "missing": lacking}
        result |= {"dense": made, "parts": parts}
        if certified:
            start = runs["branchcrush"][0]["packing"]
            result["certified"] = _certified(folder, {**part, "packing": start}, parts)
    return result


def loose_case(folder, grains, ratio, seed=1):
    """Return the radii [m] of a packing of the grading, and the case that begins from it, loose."""
    rng = np.random.default_rng(seed)
    section = {**GRADING, "min": LARGEST / ratio, "max": LARGEST}
    radii = sampled_radii(grading_of(section), grains, "random", rng)
    return radii, loose_packing(folder, f"loose_{grains}_{seed}", radii, FRACTION, True, rng)


def dense_case(folder, grains, ratio):
    """Make the dense packing; return the case that begins from it, and what it took."""
    radii, loose = loose_case(folder, grains, ratio)
    case = {
        **loose,
        "final_edge": float(cube_edge(radii, DENSE)),
        "normal_stiffness": STIFFNESS,
        "state_tolerance": 1e-3,
        "path": _COARSE,
    }
    done = run_case("branchcrush", case, folder, "dense")
    if done["report"]["stopped"]:
        raise RuntimeError(f"no dense packing: {done['report']['stopped']}")
    made = {name: done[name] for name in ("cpu_s", "evaluations")}
    made["state"] = _state(done["packing"], case)
    made["neighbours"] = done["report"]["neighbours"]
    made["largest_coordination"] = largest_coordination(done["packing"], case)
    # Beyond what the part can reach, so that each does all its iterations.
    case |= {"packing": done["packing"], "edge": case["final_edge"], "state_tolerance": TOLERANCE}
    case["largest_coordination"] = made["largest_coordination"]
    return case, made


def _part(folder, case, name, pair, evaluations, peer_evaluations):
    """Run the part of one code, with a strain step for each 100 evaluations or so."""
    code, path = PARTS[name]
    with np.load(case["packing"]) as arrays:
        positions, radii = arrays["positions"], arrays["radii"]
    if code == "branchcrush":
        cost = _our_cost(positions, radii, case, path, evaluations)
        # For the state at the end alone, which is the same each time.
        if pair:
            return cost
        case = {**case, "path": path, "largest_iterations": evaluations}
        return {**run_case(code, case, folder, f"{name}_{pair}"), **cost}
    if code == "liggghts":
        # No frequency is above sqrt(2 Z k/m), with Z of the grain that has most contacts: hundreds.
        stable = 2.0 / np.sqrt(2.0 * case["largest_coordination"])
        path = {**path, "skin": _SKIN * float(radii.mean() / radii.max())}
        path["time_step"] = min(_TIME_STEP, _STABLE * float(stable))
    case = {**case, "path": path, "largest_iterations": peer_evaluations}
    run = run_case(code, case, folder, f"{name}_{pair}")
    return {**run, "seconds_each": run["loop_cpu_s"] / run["evaluations"]}


def _our_cost(positions, radii, case, path, evaluations):
    """Return `seconds_each` of an evaluation of branchcrush, over three strain steps."""
    plain = {"neighbour_style": "bin", "collections": "none"}
    settings = plain if path.get("neighbours") == "bin" else {}
    call = (positions, radii, case["edge"], settings, evaluations, case["boundary"])
    (cost,) = apart(evaluations_cost, call)
    if "error" in cost:
        raise RuntimeError(cost["error"])
    return {"seconds_each": cost["ns_per_grain_and_evaluation"] * 1e-9 * len(radii)}


def _summed(runs, ours, case):
    """Return the cost of an evaluation over the runs of a code, and the state of the first one."""
    each, our_each = ([run["seconds_each"] for run in group] for group in (runs, ours))
    first = runs[0]
    return {
        "path": first["report"]["path"],
        "evaluations": first["evaluations"],
        # Of the whole process, and of the code in it without its start but with all set-ups.
        "cpu_s": first["cpu_s"],
        "inside_cpu_s": first["inside_cpu_s"],
        "peak_MB": first["peak_MB"],
        "cpu_s_per_evaluation": {"median": statistics.median(each), "runs": each},
        "ratio_to_branchcrush": ratios(each, our_each),
        "state": _state(first["packing"], case),
    }


def _state(packing, case):
    state = judged(packing, case)
    return {name: state[name] for name in _JUDGED}


def _certified(folder, case, parts):
    """Let branchcrush come to rest; return what it took, and an estimate of what others would."""
    case = {**case, "edge": case["final_edge"], "path": {"states": 1}}
    done = run_case("branchcrush", case, folder, "certified")
    evaluations = done["evaluations"]
    return {
        "reached": done["report"]["reached"],
        "stopped": done["report"]["stopped"],
        "evaluations": evaluations,
        "cpu_s": done["cpu_s"],
        "loop_cpu_s": done["loop_cpu_s"],
        "state": _state(done["packing"], case),
        # No other code was taken there: had it needed as many evaluations as branchcrush did. With
        # equal masses and so small a time step LIGGGHTS will need several times as many.
        "estimated_cpu_s": {
            name: evaluations * part["cpu_s_per_evaluation"]["median"]
            for name, part in parts.items()
            if name != "branchcrush"
        },
    }


def summary(result):
    """Return the lines that tell of a result in short."""
    lines = [f"missing: {advice}" for advice in result["missing"].values()]
    for name, part in result["parts"].items():
        line = f"{name}: {1e3 * part['cpu_s_per_evaluation']['median']:.2f} ms an evaluation, "
        ratio = "{median:.2f} ({min:.2f} to {max:.2f}) times branchcrush"
        lines.append(line + ratio.format(**part["ratio_to_branchcrush"]))
    if "certified" in result:
        found = result["certified"]
        line = "at rest after {evaluations} evaluations, {cpu_s:.0f} CPU s".format(**found)
        lines.append(line if found["reached"] else f"not at rest: {found['stopped']}")
    return lines
