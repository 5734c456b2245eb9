"""Ways to the certified state that were tried, on the paper's case, against the shipped one."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from benchmarks.dense import INPUTS, STIFFNESS
from branchcrush.errors import BranchcrushError, FitError
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.lammps.compression import compress, compression_variables
from branchcrush.loading.jamming import jamming_point
from branchcrush.loading.states import stress_floor
from branchcrush.loading.targets import (
    STATE_TOLERANCES,
    STEP_UNBALANCED_FORCE_RATIO,
    Loading,
    strain_step,
)
from branchcrush.packings.contact_laws import contact_law
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing
from branchcrush.statistics.bins import bin_edges, binned_sums
from branchcrush.statistics.power_law import binned_exponent

CORES = 2
GRAINS, ENDS, LOOSE, EDGE_REDUCTION = 1000, (5e-6, 1e-3), 0.16, 0.4
# A mod.* file of one of these folders takes the place of the shipped one.
LAYERS = Path(__file__).with_name("variants")
LAW = contact_law("linear", normal_stiffness=STIFFNESS)
UNLIMITED = 400_000
QUANTITIES = (
    "mean_stress_Pa",
    "coordination_number",
    "mechanical_coordination_number",
    "energy_density_J_m3",
    "dissipated_share",
    "jamming_solid_fraction",
)
TAKEN = ("lammps_seconds", "cpu_seconds", "force_evaluations")
_INSIDE = re.compile(r"^branchcrush: ([\d.]+) s inside LAMMPS$", re.MULTILINE)

# What is not named is as shipped. `boundary`, `states`, `strain_step` and `layers` are not
# variables of in.compress.
VARIANTS = (
    {
        f"{quality}, {evaluations or 'no'} evaluations at most": {
            "strain_step": strain_step(quality),
            "step_evaluations": evaluations or UNLIMITED,
        }
        for quality in ("draft", "standard", "fine")
        for evaluations in (50, 200, 0)
    }
    | {
        # With every state of the shipped study saved, each relaxed to rest, for those that matter.
        f"{quality}, {evaluations or 'no'} evaluations at most, 15 states": {
            "strain_step": strain_step(quality),
            "step_evaluations": evaluations or UNLIMITED,
            "states": 15,
        }
        for quality, evaluations in (
            ("draft", 200),
            ("standard", 50),
            ("standard", 200),
            ("standard", 0),
            ("fine", 200),
        )
    }
    | {
        "step_tolerance 1e-2": {"step_tolerance": 1e-2},
        "time_step 0.4": {"time_step": 0.4},
        "time_step 0.55": {"time_step": 0.55},
        "normal_damping 0.1": {"normal_damping": 0.1},
        "normal_damping 0.6": {"normal_damping": 0.6},
        "check_every 20": {"check_every": 20},
        "skin 0.15 of the mean diameter": {"skin": 0.15 * sum(ENDS)},
        "skin 0.6 of the mean diameter": {"skin": 0.6 * sum(ENDS)},
        "drag 0.1": {"layers": ["drag"]},
        "drag 0.02": {"layers": ["drag", "weak_drag"]},
        "nearly constant rate": {"strain_step": 1e-4, "step_evaluations": 10, "states": 1},
        "fire": {"layers": ["fire"], "boundary": "periodic", "states": 1},
    }
)


def run(variants=VARIANTS, seeds=(1, 2, 3, 4, 5, 6, 7, 8), states=(1,), cores=CORES):
    """Return what each way takes and where it leads, and the difference to the shipped one.

    Parameters
    ----------
    variants : dict
        Settings by a name; variables of `in.compress`, or `states`, `boundary`, `strain_step` [-]
        and `layers` (folders of benchmarks/variants).
    seeds : sequence of int
        Of the packings, the same for all.
    states : sequence of int
        How many a path saves; a variant that sets this itself is run with that alone.
    cores : int
        Packings compressed at a time.

    Returns
    -------
    dict
        `rows`: for each variant means over the seeds that came to an end, of what it takes
        (`lammps_seconds` on the clock, `cpu_seconds` of `compress`, `force_evaluations`) and of the
        last state (SI units in the names), `difference` to the shipped way with the same boundary,
        states and seeds, as mean and standard error, the `exponent` with its 68 % interval, and
        `stopped`: why which seeds did not end.
    """
    plan = {}
    for name, settings in {"shipped": {}, **variants}.items():
        for number in [settings["states"]] if "states" in settings else states:
            plan[name, number] = {**settings, "states": number}
    # The ways to compare with: the shipped one in each boundary and with each number of states.
    for settings in list(plan.values()):
        boundary, number = settings.get("boundary", "walls"), settings["states"]
        name = "shipped" if boundary == "walls" else f"shipped, {boundary}"
        plan.setdefault((name, number), {"boundary": boundary, "states": number})
    calls = [(settings, seed) for settings in plan.values() for seed in seeds]
    with ThreadPoolExecutor(cores) as threads:
        results = threads.map(_apart, calls)
    found = {key: {seed: next(results) for seed in seeds} for key in plan}
    rows = []
    for (name, number), settings in plan.items():
        boundary = settings.get("boundary", "walls")
        shipped = "shipped" if boundary == "walls" else f"shipped, {boundary}"
        row = {"variant": name, "states": number, "boundary": boundary}
        rows.append(row | _row(found[name, number], found[shipped, number]))
    return {"seeds": list(seeds), "cores": cores, "rows": rows}


def paper_packing(seed, boundary="walls"):
    """Return the positions, radii and edge [m] of a packing of the paper, as the workflow's."""
    rng = np.random.default_rng(seed)
    radii = sampled_radii(uniform(*ENDS), GRAINS, "random", rng)
    edge = cube_edge(radii, LOOSE)
    return random_packing(radii, edge, periodic=boundary == "periodic", rng=rng), radii, edge


def paper_compression(
    packing, boundary="walls", states=15, strains=None, ranks=1, layers=(), **others
):
    """Return the `Compression` of a packing, the seconds of LAMMPS on the clock and of the CPU."""
    loading = Loading("edge_reduction", EDGE_REDUCTION, states)
    strains = strains or strain_step("standard")
    variables = compression_variables(
        packing[1],
        LOOSE,
        boundary=boundary,
        law=LAW,
        loading=loading,
        strain_step=strains,
        state_tolerance=STATE_TOLERANCES["standard"],
    )
    with tempfile.TemporaryDirectory() as scratch:
        log, inputs = Path(scratch) / "log", Path(scratch) / "inputs"
        shutil.copytree(INPUTS, inputs)
        for layer in layers:
            shutil.copytree(LAYERS / layer, inputs, dirs_exist_ok=True)
        start = time.process_time()
        done = compress(
            *packing, variables | others, inputs=inputs, folder=scratch, log=log, ranks=ranks
        )
        used = time.process_time() - start
        inside = float(_INSIDE.findall(log.read_text(encoding="utf-8"))[-1])
    return done, inside, used


def quantities(done, radii):
    """Return what the last state of a `Compression` is, and why it stopped before if it did."""
    end = {name: column[-1] for name, column in done.path.items()}
    # A step left on its way to balance is not on the curve that is extrapolated.
    rest = done.steps["unbalanced_force_ratio"] <= STEP_UNBALANCED_FORCE_RATIO["edge"]
    phi, stress = (done.steps[name][rest] for name in ("solid_fraction", "mean_stress_Pa"))
    try:
        jammed = jamming_point(phi, stress, 1.0, stress > stress_floor(radii, LAW)).solid_fraction
    except FitError:
        jammed = float("nan")
    row = {name: float(end[name]) for name in QUANTITIES[:3]}
    return row | {
        "energy_density_J_m3": float(end["elastic_energy_J"] / end["volume_m3"]),
        "dissipated_share": float(end["dissipated_J"] / (end["work_J"] or np.nan)),
        "jamming_solid_fraction": float(jammed),
        "force_evaluations": int(end["force_evaluations"]),
        "stopped": str(end["stopped"]),
    }


def _apart(call):
    """Return `_one` from a process of its own: LAMMPS keeps memory until its process ends."""
    command = [sys.executable, "-m", "benchmarks.paths", "--one", json.dumps(call)]
    root = Path(__file__).resolve().parents[1]
    done = subprocess.run(command, cwd=root, check=True, capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def _one(settings, seed):
    """Return the quantities of one seed on one way, with the sums for the exponent."""
    settings = dict(settings)
    packing = paper_packing(seed, settings.get("boundary", "walls"))
    settings["strains"] = settings.pop("strain_step", None)
    try:
        done, inside, used = paper_compression(packing, **settings)
    except BranchcrushError as error:
        return {"stopped": str(error).partition(" (log")[0]}
    row = quantities(done, packing[1]) | {"lammps_seconds": inside, "cpu_seconds": used}
    last = done.contacts["state"] == done.path["state"][-1]
    length = (done.contacts["radius_i_m"] + done.contacts["radius_j_m"])[last]
    sums = binned_sums(length, done.contacts["energy_J"][last], bin_edges(*ENDS))
    return row | {"sums": np.asarray(sums).tolist()}


def _row(found, shipped):
    """Return the means of a way over seeds, and its differences to the shipped one."""
    ended = [seed for seed, row in found.items() if not row["stopped"]]
    row = {
        "ended": len(ended),
        "stopped": {s: found[s]["stopped"] for s in found if s not in ended},
    }
    if not ended:
        return row
    both = [seed for seed in ended if not shipped[seed]["stopped"]]
    row["difference"] = {}
    for name in (*TAKEN, *QUANTITIES):
        row[name] = _mean([found[seed][name] for seed in ended])[0]
        differences = [found[seed][name] - shipped[seed][name] for seed in both]
        row["difference"][name] = _mean(differences)
    rng = np.random.default_rng(0)
    sums = np.array([found[seed]["sums"] for seed in ended])
    try:
        row["exponent"] = [float(x) for x in binned_exponent(sums, confidence=0.68, rng=rng)[1]]
    except FitError as error:
        row["exponent"] = str(error)
    return row


def _mean(values):
    """Return the mean and its standard error; None where there are too few."""
    values = np.array([value for value in values if np.isfinite(value)])
    if not values.size:
        return None, None
    error = float(values.std(ddof=1) / np.sqrt(values.size)) if values.size > 1 else None
    return float(values.mean()), error


if __name__ == "__main__" and sys.argv[1:2] == ["--one"]:
    print(json.dumps(_one(*json.loads(sys.argv[2]))))
elif __name__ == "__main__":
    chosen = {name: VARIANTS[name] for name in sys.argv[1:]} or VARIANTS
    print(json.dumps(run(chosen), indent=2))
