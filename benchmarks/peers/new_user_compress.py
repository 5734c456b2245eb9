"""Compress a packing of frictionless spheres in LAMMPS the way its manual's examples lead to it.

python new_user_compress.py case.json output.json

Grains have their own masses, so the smallest sets the time step and the mean one the slow rate: a
run takes hours or days. With `largest_iterations` in the case only so many time steps are run, from
the packing and from each one in `stages` (.npz as the drivers write them, from further along the
path), and the time of the whole run is worked out from the speeds. README.md tells the rest.
"""

import re
import sys
import tempfile
from pathlib import Path

import numpy as np
from common import (
    final_state,
    read_case,
    read_packing,
    read_positions,
    run_code,
    volumes,
    write_data_file,
    write_result,
)

SCRIPT = Path(__file__).resolve().with_name("in.new_user")

DEFAULTS = {
    "density": 2650.0,  # [kg/m3]
    "time_step": 0.15,  # over sqrt(m/k) of the smallest grain
    "damping_ratio": 0.2,  # of a contact of two mean grains
    # The strain rate keeps the inertial number, rate * diameter * sqrt(density/stress), this small
    # from the stress on at which the packing has just jammed.
    "inertial_number": 1e-3,
    "stress": 1e6,  # [Pa]
    "skin": 1e-3,  # of the neighbour lists, what LAMMPS itself takes in SI units [m]
    "relaxation": 1000.0,  # estimated time to come to rest, over sqrt(m/k) of the mean grain
    "check_every": 100_000,  # time steps between looks at the net forces at the end
}


def plan(case, packing):
    """Return the time step [s], the speed of a side [m/s] and the time steps of the whole path.

    The rate is the strain rate at the end, where it is largest, for the sides move steadily.
    """
    path, stiffness = case["path"], float(case["normal_stiffness"])
    masses = path["density"] * volumes(packing.radii)
    time_step = path["time_step"] * np.sqrt(masses.min() / stiffness)
    diameter = 2.0 * packing.radii.mean()
    rate = path["inertial_number"] * np.sqrt(path["stress"] / path["density"]) / diameter
    way = (packing.edge - case["final_edge"]) / 2.0
    steps = int(np.ceil(way / (rate * case["final_edge"] / 2.0) / time_step))
    time_scale = np.sqrt(masses.mean() / stiffness)
    return {
        "strain_rate": float(rate),
        # Of each side, to be where it should after a whole number of time steps.
        "speed": float(way / (steps * time_step)),
        "time_step": float(time_step),
        # gran/hooke takes a rate; two mean grains of the reduced mass m/2 have the frequency
        # sqrt(2k/m) to compare it with.
        "damping": float(2.0 * path["damping_ratio"] * np.sqrt(2.0) / time_scale),
        "path_steps": steps,
        "rest_steps": int(np.ceil(path["relaxation"] * time_scale / time_step)),
    }


def run(case, packing, planned, steps, checks):
    """Run so many time steps of the path from a packing, and what it takes to rest.

    Returns
    -------
    done : Finished
    positions : ndarray, shape (N, 3)
    """
    path, stiffness = case["path"], float(case["normal_stiffness"])
    settings = {
        "boundary": case["boundary"],
        "stiffness": stiffness,
        "damping": planned["damping"],
        "time_step": planned["time_step"],
        "speed": planned["speed"],
        "half": packing.edge / 2.0,
        "skin": path["skin"],
        "steps": planned["path_steps"],
        "run_steps": steps,
        "thermo": max(steps // 10, 1),
        "check_every": path["check_every"],
        "largest_checks": checks,
        "tolerance": case["state_tolerance"],
    }
    lmp = str(Path(sys.executable).with_name("lmp"))
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        densities = np.full(len(packing.radii), path["density"])
        write_data_file(folder / "packing.data", packing, densities)
        done = run_code([lmp, "-in", str(SCRIPT), "-log", "none"], folder, settings)
        return done, read_positions(folder / "last.dump", len(packing.radii))


def loop(done):
    """Return the wall seconds and time steps of all runs, and of the path CPU seconds and steps."""
    loops = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps", done.output)
    use = float(re.search(r"([\d.]+)% CPU use", done.output)[1]) / 100.0
    (path_seconds, path_steps), *_ = loops
    seconds, steps = sum(float(item) for item, _ in loops), sum(int(item) for _, item in loops)
    return seconds, steps, float(path_seconds) * use, int(path_steps)


def estimate(edges, seconds_per_step, final_edge, planned):
    """Return the CPU seconds of the whole run; between stages a step costs what lies between."""
    order = np.argsort(edges)
    edges, seconds_per_step = np.array(edges)[order], np.array(seconds_per_step)[order]
    # The sides move steadily, so that the mean over the edge is the mean over the time steps.
    grid = np.linspace(final_edge, edges.max(), 1001)
    path = np.interp(grid, edges, seconds_per_step).mean() * planned["path_steps"]
    return float(path + seconds_per_step[0] * planned["rest_steps"])


def main(case_path, output_path):
    """Run a case, or parts of it, and write what came of it."""
    case, packing = read_case(case_path, DEFAULTS)
    planned = plan(case, packing)
    largest = case.get("largest_iterations")
    partial = largest is not None and largest < planned["path_steps"]
    stages = [packing]
    if partial:
        folder = Path(case_path).parent
        stages += [read_packing(folder / stage) for stage in case.get("stages", [])]
    measured = []
    for stage in stages:
        steps = largest if partial else planned["path_steps"]
        checks = 0 if partial else 1000
        done, positions = run(case, stage, planned, steps, checks)
        seconds, iterations, path_cpu_seconds, path_iterations = loop(done)
        measured.append(
            {
                "edge": stage.edge,
                "solid_fraction": float(volumes(stage.radii).sum() / stage.edge**3),
                "seconds_total": done.seconds,
                "seconds_total_cpu": done.cpu_seconds,
                "seconds_loop": seconds,
                "iterations": iterations,
                "iterations_per_cpu_second": path_iterations / path_cpu_seconds,
            }
        )
    result = {
        "code": "LAMMPS, new user",
        "version": re.search(r"LAMMPS \((.+?)\)", done.output)[1],
        **planned,
        "reached": not partial,
        "path": case["path"],
    }
    if partial:
        edges = [stage["edge"] for stage in measured]
        costs = [1.0 / stage["iterations_per_cpu_second"] for stage in measured]
        result["stages"] = measured
        result["seconds_estimated_cpu"] = estimate(edges, costs, case["final_edge"], planned)
        write_result(output_path, result)
        return
    last = packing._replace(positions=positions, edge=float(case["final_edge"]))
    stiffness, periodic = float(case["normal_stiffness"]), case["boundary"] == "periodic"
    result |= {**measured[0], "edge": last.edge, **final_state(last, periodic, stiffness)}
    write_result(output_path, result, last)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
