"""Compress a packing of frictionless spheres isotropically with LIGGGHTS.

python liggghts_compress.py case.json output.json

Writes output.json and, beside it, output.npz with the last positions. README.md tells what is in a
case, what the settings are good for and what was tried. Mass and time are fictitious, in units of a
time scale of 1 s: every grain, whatever its size, has the mass k (1 s)^2, k being the stiffness.
"""

import re
import sys
import tempfile
from pathlib import Path

import numpy as np
from common import (
    final_state,
    read_case,
    read_positions,
    run_code,
    volumes,
    write_data_file,
    write_result,
)

SCRIPT = Path(__file__).resolve().with_name("in.liggghts")
TRICKS = SCRIPT.with_name("in.liggghts_tricks")
# The box over the space between the walls: LIGGGHTS must not drop a grain that is pressed through
# a wall, so that it can be put back.
MARGIN = 1.5

DEFAULTS = {
    "approach_solid_fraction": 0.55,  # until there strain steps are longer: no grain carries load
    "approach_steps": 23,
    "steps": 40,  # from there to the last edge
    "relax": 50,  # iterations in each step
    "check_every": 250,  # iterations between looks at the net forces at the last edge
    "time_step": 0.4,  # over the time scale
    "dashpot": 0.3,  # of a contact, over stiffness times time scale
    "drag": 0.02,  # of a grain, over stiffness times time scale
    "skin": 0.2,  # of the neighbour lists, over the largest radius
    # Whether it knows the tricks of in.liggghts_tricks, which is between walls alone; with what
    # follows.
    "tricks": False,
    "newton": "off",
    "neighbour_every": 1,
    "sort": 0,
    "masses": 1,
    "kinetic": 1,
    "look": 10,
    "step_tolerance": 3e-2,
}
_OF_TRICKS = ("newton", "neighbour_every", "sort", "masses", "kinetic", "look", "step_tolerance")


def half_edges(packing, final_edge, path):
    """Return half the edge in each strain step: equal steps to a loose cube, then to the last."""
    loose = np.cbrt(volumes(packing.radii).sum() / path["approach_solid_fraction"])
    if final_edge == packing.edge:
        edges = np.array([final_edge])
    elif final_edge < loose < packing.edge:
        approach = np.linspace(packing.edge, loose, path["approach_steps"] + 1)[1:]
        loading = np.linspace(loose, final_edge, path["steps"] + 1)[1:]
        edges = np.concatenate([approach, loading])
    else:
        edges = np.linspace(packing.edge, final_edge, path["steps"] + 1)[1:]
    return edges / 2.0


def main(case_path, output_path):
    """Run a case and write what came of it."""
    case, packing = read_case(case_path, DEFAULTS)
    path, periodic = case["path"], case["boundary"] == "periodic"
    stiffness, final_edge = float(case["normal_stiffness"]), float(case["final_edge"])
    halves = half_edges(packing, final_edge, path)
    # A part of the path keeps the length of its steps, so that its cost is that of the whole.
    largest = case.get("largest_iterations", 10**5)
    halves = halves[: max(1, largest // path["relax"])]
    left = largest - len(halves) * path["relax"]
    settings = {
        "walls": int(not periodic),
        "stiffness": stiffness,
        "time_step": path["time_step"],
        "dashpot": path["dashpot"] * stiffness,
        "drag": path["drag"] * stiffness,
        "skin": path["skin"] * packing.radii.max(),
        "tolerance": case["state_tolerance"],
        "steps": len(halves),
        "relax": path["relax"],
        "check_every": path["check_every"],
        "largest_checks": max(1, left // path["check_every"]),
        "half": [repr(float(half)) for half in halves],
        "box": [repr(float(half) * (1.0 if periodic else MARGIN)) for half in halves],
    }
    if path["tricks"]:
        settings |= {name: path[name] for name in _OF_TRICKS} | {"bin": 2.0 * settings["skin"]}
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        box = packing._replace(edge=packing.edge * (1.0 if periodic else MARGIN))
        write_data_file(folder / "packing.data", box, stiffness / volumes(packing.radii))
        script = TRICKS if path["tricks"] else SCRIPT
        done = run_code(["liggghts", "-in", str(script), "-log", "none"], folder, settings)
        positions = read_positions(folder / "last.dump", len(packing.radii))
    last = packing._replace(positions=positions, edge=2.0 * float(halves[-1]))
    loops = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps", done.output)
    state = final_state(last, periodic, stiffness)
    at_end = np.isclose(last.edge, final_edge, rtol=1e-9, atol=0.0)
    result = {
        "code": "LIGGGHTS",
        "version": re.search(r"Version (\S+ \S+?),", done.output)[1],
        "seconds_total": done.seconds,
        "seconds_total_cpu": done.cpu_seconds,
        "seconds_loop": sum(float(seconds) for seconds, _ in loops),
        # A run evaluates the forces once more when it sets up.
        "iterations": sum(int(steps) for _, steps in loops) + done.output.count("Setting up run"),
        "strain_steps": len(halves),
        "edge": last.edge,
        "reached": bool(at_end and state["unbalanced_force_ratio"] <= case["state_tolerance"]),
        **state,
        "path": path,
    }
    write_result(output_path, result, last)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
