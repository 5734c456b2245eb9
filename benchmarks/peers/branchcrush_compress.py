"""Compress a packing of frictionless spheres isotropically with branchcrush.

python branchcrush_compress.py case.json output.json

The same case and the same output as the other drivers, through
`branchcrush.lammps.compression.compress`, as the workflow does it. Writes output.json and, beside
it, output.npz with the last positions.
"""

import re
import sys
import tempfile
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np
from common import final_state, read_case, volumes, write_result

from branchcrush.lammps.compression import compress, compression_variables
from branchcrush.lammps.files import read_dump
from branchcrush.loading.targets import STEP_UNBALANCED_FORCE_RATIO, Loading
from branchcrush.packings.contact_laws import LinearContact

INPUTS = Path(__file__).resolve().parents[2] / "lammps_inputs"

DEFAULTS = {  # as the workflow takes them for quality `standard`
    "approach_solid_fraction": 0.55,
    "strain_step": 1.7e-3,
    "step_tolerance": STEP_UNBALANCED_FORCE_RATIO["edge"],
    "step_evaluations": 200,
    "states": 15,
    "neighbours": "chosen",  # by the grading; `bin` for one grid of cells with the same skin
}
# Of a part of the path, whose last state only has to be saved.
_ANY = 1e30


def variables_of(case, packing):
    """Return the variables of `in.compress` for a case."""
    path, final_edge = case["path"], float(case["final_edge"])
    solid = float(volumes(packing.radii).sum())
    loading = Loading(
        "solid_fraction", solid / final_edge**3, path["states"], path["approach_solid_fraction"]
    )
    variables = compression_variables(
        packing.radii,
        solid / packing.edge**3,
        boundary=case["boundary"],
        law=LinearContact(float(case["normal_stiffness"])),
        loading=loading,
        strain_step=path["strain_step"],
    )
    variables["step_tolerance"] = path["step_tolerance"]
    variables["step_evaluations"] = path["step_evaluations"]
    variables["state_tolerance"] = float(case["state_tolerance"])
    if path["neighbours"] == "bin":
        variables |= {"neighbour_style": "bin", "collections": "none"}
    start = variables["approach_edge"]
    if packing.edge <= start:
        # Dense already: there is nothing to approach.
        start = packing.edge
        variables |= {"approach_edge": start, "approach_steps": 1}
    edges = np.linspace(start, final_edge, path["states"] + 1)[1:]
    variables["targets"] = edges.tolist()
    if "largest_iterations" in case:
        # A step that is not saved is left after so many evaluations; the one after it, to the last
        # edge, is saved at the first peak of the kinetic energy.
        strain = abs(np.log(final_edge / start))
        variables |= {
            "targets": [final_edge],
            "strain_step": max(float(strain) / 2.0, 1e-15),
            "step_tolerance": 0.0,
            "step_evaluations": int(case["largest_iterations"]),
            "state_tolerance": _ANY,
        }
    return variables


def main(case_path, output_path):
    """Run a case and write what came of it."""
    case, packing = read_case(case_path, DEFAULTS)
    variables = variables_of(case, packing)
    grains = len(packing.radii)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        start, start_cpu = time.perf_counter(), time.process_time()
        result = compress(
            packing.positions,
            packing.radii,
            packing.edge,
            variables,
            inputs=INPUTS,
            folder=folder,
            log=folder / "log",
            ranks=int(case.get("ranks", 1)),
        )
        seconds, cpu_seconds = time.perf_counter() - start, time.process_time() - start_cpu
        log = (folder / "log").read_text(encoding="utf-8")
        *_, last_frame = read_dump(folder / "particles.dump.gz")
    positions = np.full((grains, 3), np.nan)
    found = last_frame["id"].astype(int) - 1
    positions[found] = np.stack([last_frame[axis] for axis in "xyz"], axis=1)
    edge = float(np.cbrt(result.path["volume_m3"][-1]))
    at_end = np.isclose(edge, case["final_edge"], rtol=1e-9, atol=0.0)
    last = packing._replace(positions=positions, edge=float(case["final_edge"]) if at_end else edge)
    state = final_state(last, case["boundary"] == "periodic", float(case["normal_stiffness"]))
    loops = re.findall(r"^Loop time of (\S+) on \d+ procs for (\d+) steps", log, re.MULTILINE)
    loop = sum(float(item) for item, _ in loops)
    inside = float(re.findall(r"branchcrush: (\S+) s inside LAMMPS", log)[-1])
    # LAMMPS runs in this process, unless there are ranks, and tells its seconds by the clock.
    share = min(cpu_seconds / seconds, 1.0) if case.get("ranks", 1) == 1 else 1.0
    write_result(
        output_path,
        {
            "code": "branchcrush",
            "version": f"LAMMPS {version('lammps')}",
            "seconds_total": seconds,
            "seconds_total_cpu": cpu_seconds,
            "seconds_lammps": inside,
            "seconds_lammps_cpu": inside * share,
            "seconds_loop": loop,
            "seconds_loop_cpu": loop * share,
            "iterations": int(result.path["force_evaluations"][-1]),
            "iterations_loop": sum(int(steps) for _, steps in loops),
            "strain_steps": int(result.steps["step"][-1]),
            "states": len(result.path["state"]),
            "edge": last.edge,
            "stopped": str(result.path["stopped"][-1]),
            "reached": bool(at_end and state["unbalanced_force_ratio"] <= case["state_tolerance"]),
            **state,
            "neighbours": {n: variables[n] for n in ("skin", "neighbour_style", "collections")},
            "path": case["path"],
        },
        last,
    )


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
