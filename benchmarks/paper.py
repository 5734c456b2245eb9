"""The paper's packing in branchcrush, YADE and LIGGGHTS, and as a new user of LAMMPS would do it.

Seed by seed, the codes in turn, each as a process of its own. What a code reached is judged from
the positions it leaves.
"""

import statistics
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.codes import absent, branches, judged, loose_packing, run_case
from benchmarks.measure import difference, mean_and_error, ratios
from branchcrush.config.build import grading_of
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.loading.targets import STATE_TOLERANCES, final_solid_fraction, strain_step
from branchcrush.packings.geometry import cube_edge
from branchcrush.statistics.bins import bin_edges, binned_sums
from branchcrush.statistics.power_law import binned_exponent

GRADING = {"form": "uniform", "basis": "number", "size": "radius", "unit": "m"}
GRADING |= {"min": 5e-6, "max": 1e-3}
FRACTION, REDUCTION, APPROACH = 0.16, 0.4, 0.55
STIFFNESS, TOLERANCE, BINS = 1e6, 1e-7, 20

_STEP, _EVALUATIONS = strain_step("standard"), 200
_END = final_solid_fraction(FRACTION, "edge_reduction", REDUCTION)
_STEPS = int(np.ceil(np.log(_END / APPROACH) / 3.0 / _STEP))
_SAME_PATH = {
    "branchcrush": {"strain_step": _STEP, "step_evaluations": _EVALUATIONS, "states": 1},
    "yade": {
        "strain_step": _STEP,
        "step_tolerance": 3e-2,
        "largest_step_iterations": _EVALUATIONS,
    },
    # It relaxes each step, in the approach as well, for a fixed number of iterations: there in
    # steps of 4e-2, as YADE takes them.
    "liggghts": {"steps": _STEPS, "relax": _EVALUATIONS, "approach_steps": 10},
}
# What else of branchcrush, or of their own, the others can be taught: peers/README.md.
_TRICKS = {
    "branchcrush": {},
    "yade": {"walls": "plane", "turning": False},
    "liggghts": {
        "tricks": True,
        "newton": "on",
        "sort": 1000,
        "look": 20,
        "skin": 0.3,
        "time_step": 0.5,
        "drag": 0.0,
        "check_every": 500,
    },
}
COMPARISONS = {
    # The fastest path of each whose state agrees with that of small steps: peers/README.md.
    "fastest_path_of_each": {
        "branchcrush": {"strain_step": 1e-2, "step_evaluations": 50, "states": 1},
        "yade": {},
        "liggghts": {},
    },
    "same_path_for_all": _SAME_PATH,
    "same_path_with_every_trick": {
        code: {**path, **_TRICKS[code]} for code, path in _SAME_PATH.items()
    },
    "what_the_workflow_does": {
        "branchcrush": {"strain_step": _STEP, "step_evaluations": _EVALUATIONS, "states": 15}
    },
}
# What is compared of the states.
_JUDGED = (
    "mean_stress_Pa",
    "coordination_number",
    "mechanical_coordination_number",
    "elastic_energy_J",
    "unbalanced_force_ratio",
    "escaped",
)
# Where along the path the new user's speed is measured, beside its beginning.
_STAGES = (0.40, 0.62, 0.74)


def run(seeds=(9, 10, 11, 12, 13), grains=1000, comparisons=COMPARISONS, new_user_steps=40_000):
    """Return what each code takes for the paper's packing, and which state it reaches.

    Parameters
    ----------
    seeds : list of int
        The settings of the peers were chosen on seeds 1 to 8.
    grains : int
    comparisons : dict
        By name, the path settings of each code.
    new_user_steps : int
        Time steps of the new user's script at each stage; 0 leaves it out.

    Returns
    -------
    dict
        `missing`, how to install what is not there; for each comparison and code its `runs`
        (`cpu_s` of the whole process, `inside_cpu_s` without its start),
        `ratio_to_branchcrush` of the CPU seconds, and the `state` over the seeds, with the
        `difference` to branchcrush, its standard error, and whether it `agrees`; `new_user`.
    """
    lacking = absent({code for codes in comparisons.values() for code in codes})
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
        folder = Path(folder)
        cases = {int(seed): paper_case(folder, int(seed), grains) for seed in seeds}
        first = next(iter(cases))
        runs = {
            name: {code: [] for code in codes if code not in lacking}
            for name, codes in comparisons.items()
        }
        # Once for nothing: later runs find programs and modules in the cache of the system.
        for code, path in next(iter(comparisons.values())).items():
            if code not in lacking:
                run_case(code, {**cases[first], "path": path}, folder, f"warm_{code}")
        for seed, case in cases.items():
            for name, codes in runs.items():
                for code, done in codes.items():
                    asked = {**case, "path": comparisons[name][code]}
                    if name == "what_the_workflow_does":
                        asked["state_tolerance"] = STATE_TOLERANCES["standard"]
                    result = run_case(code, asked, folder, f"{name}_{code}_{seed}")
                    done.append({"seed": seed, "case": case, **result})
        result = {
            "seeds": list(cases),
            "grains": grains,
            "missing": lacking,
            **{name: _compared(codes, comparisons[name]) for name, codes in runs.items()},
        }
        if new_user_steps:
            result["new_user"] = _new_user(folder, cases[first], new_user_steps, result)
    return result


def paper_case(folder, seed, grains):
    """Return the case of a seed: the packing that the workflow makes of it."""
    rng = np.random.default_rng(seed)
    radii = sampled_radii(grading_of(GRADING), grains, "random", rng)
    case = loose_packing(folder, f"seed_{seed}", radii, FRACTION, False, rng)
    return {
        **case,
        "final_edge": float(cube_edge(radii, _END)),
        "normal_stiffness": STIFFNESS,
        "state_tolerance": TOLERANCE,
    }


def _compared(codes, paths):
    """Return the costs and states of the codes of one comparison."""
    result = {}
    ours = codes["branchcrush"]
    our_states = [judged(run["packing"], run["case"]) for run in ours]
    for code, runs in codes.items():
        is_ours = code == "branchcrush"
        states = our_states if is_ours else [judged(run["packing"], run["case"]) for run in runs]
        result[code] = {
            "path": paths[code],
            "reached": sum(run["report"]["reached"] for run in runs),
            "cpu_s": statistics.median(run["cpu_s"] for run in runs),
            "inside_cpu_s": statistics.median(run["inside_cpu_s"] for run in runs),
            "evaluations": statistics.median(run["evaluations"] for run in runs),
            "cpu_s_per_evaluation": statistics.median(_each(run) for run in runs),
            "peak_MB": max(run["peak_MB"] for run in runs),
            "state": {name: mean_and_error([state[name] for state in states]) for name in _JUDGED},
            "exponent": _exponent(runs),
            "runs": [_run(run, state) for run, state in zip(runs, states, strict=True)],
        }
        if not is_ours:
            result[code]["ratio_to_branchcrush"] = {
                "cpu_s": _ratios(runs, ours, lambda run: run["cpu_s"]),
                "inside_cpu_s": _ratios(runs, ours, lambda run: run["inside_cpu_s"]),
                "evaluations": _ratios(runs, ours, lambda run: run["evaluations"]),
                "cpu_s_per_evaluation": _ratios(runs, ours, _each),
            }
            result[code]["difference_to_branchcrush"] = {
                name: difference(*_columns(name, states, our_states)) for name in _JUDGED[:4]
            }
    return result


def _each(run):
    return run["inside_cpu_s"] / run["evaluations"]


def _ratios(runs, ours, value):
    return ratios([value(run) for run in runs], [value(run) for run in ours])


def _columns(name, *tables):
    return ([state[name] for state in states] for states in tables)


def _run(run, state):
    """Return what is kept of a run."""
    kept = ("seed", "cpu_s", "inside_cpu_s", "wall_s", "peak_MB", "evaluations")
    return {name: run[name] for name in kept} | {name: state[name] for name in _JUDGED}


def _exponent(runs, confidence=0.95):
    """Return the exponent n of the energy of the branches of all seeds, with its interval."""
    edges = bin_edges(GRADING["min"], GRADING["max"], BINS)
    sums = [binned_sums(*branches(run["packing"], run["case"]), edges) for run in runs]
    rng = np.random.default_rng(0)
    _, exponent = binned_exponent(sums, confidence=confidence, rng=rng)
    limits = [None if np.isnan(limit) else limit for limit in (exponent.low, exponent.high)]
    return {"estimate": exponent.estimate, "confidence": confidence, "interval": limits}


def _new_user(folder, case, steps, result):
    """Return the time that the new user's whole run would take, from its speed at some stages."""
    with np.load(case["packing"]) as arrays:
        radii = arrays["radii"]
    stages = []
    for phi in _STAGES:
        path = {"strain_step": 1e-2, "step_evaluations": 50, "states": 1}
        path["approach_solid_fraction"] = min(APPROACH, 0.75 * phi)
        stage = {**case, "final_edge": float(cube_edge(radii, phi)), "path": path}
        stages.append(run_case("branchcrush", stage, folder, f"stage_{phi:.2f}")["packing"])
    case = {**case, "stages": stages, "largest_iterations": steps}
    done = run_case("new_user", case, folder, "new_user")
    report = done["report"]
    whole = report.get("seconds_estimated_cpu", done["cpu_s"])
    found = {
        "extrapolated": not report["reached"],
        "measured_cpu_s": done["cpu_s"],
        "measured_steps": steps * (1 + len(stages)),
        "whole_cpu_s": whole,
        "whole_steps": report["path_steps"] + report["rest_steps"],
        "stages": report.get("stages"),
    }
    for name in ("what_the_workflow_does", "fastest_path_of_each"):
        if name in result:
            found[f"ratio_to_{name}"] = whole / result[name]["branchcrush"]["runs"][0]["cpu_s"]
    return found


def summary(result):
    """Return the lines that tell of a result in short."""
    lines = [f"missing: {advice}" for advice in result["missing"].values()]
    for name in COMPARISONS:
        for code, found in result.get(name, {}).items():
            line = "{cpu_s:.2f} CPU s, {evaluations:.0f} evaluations".format(**found)
            line = f"{name}: {code} {line}, n {found['exponent']['estimate']:.2f}"
            if "ratio_to_branchcrush" in found:
                ratio = found["ratio_to_branchcrush"]["cpu_s"]
                line += ", {median:.2f} ({min:.2f} to {max:.2f}) times branchcrush".format(**ratio)
                items = found["difference_to_branchcrush"].items()
                odd = [quantity for quantity, by in items if by["agrees"] is False]
                line += f", differs in {', '.join(odd)}" if odd else ""
            lines.append(line)
    if "new_user" in result:
        lines.append(f"new user: {result['new_user']['whole_cpu_s']:.0f} CPU s, extrapolated")
    return lines
