"""The codes that are compared: how each is started on a case, and what it and the judge report."""

import json
import sys
from pathlib import Path

import numpy as np

from benchmarks.judge import near_pairs, state_of
from benchmarks.measure import missing, run_timed
from branchcrush.lammps.output import Compression
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

CHECKOUT = Path(__file__).resolve().parents[1]
_PEERS = Path(__file__).with_name("peers")
_PYTHON = [sys.executable]
# BLAS and OpenMP would otherwise take what they find.
_ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
# The command of each, and the program that has to be installed for it.
_CODES = {
    "branchcrush": ([*_PYTHON, _PEERS / "branchcrush_compress.py"], None),
    "yade": (["yade", "-n", "-x", "-j1", _PEERS / "yade_compress.py"], "yade"),
    "liggghts": ([*_PYTHON, _PEERS / "liggghts_compress.py"], "liggghts"),
    "new_user": ([*_PYTHON, _PEERS / "new_user_compress.py"], None),
}


def absent(names):
    """Return, by name, how to install the codes that this machine does not have."""
    needed = {name: missing(_CODES[name][1]) for name in names if _CODES[name][1]}
    return {name: advice for name, advice in needed.items() if advice}


def loose_packing(folder, name, radii, solid_fraction, periodic, rng):
    """Place grains at random, save them, and return the part of a case that tells of them.

    Parameters
    ----------
    folder : pathlib.Path
    name : str
        Of the file, without its ending.
    radii : ndarray, shape (N,)
        [m]
    solid_fraction : float
        [-]
    periodic : bool
    rng : numpy.random.Generator

    Returns
    -------
    dict
        `packing`, `edge` [m] and `boundary`.
    """
    edge = cube_edge(radii, solid_fraction)
    positions = random_packing(radii, edge, periodic=periodic, rng=rng)
    path = (folder / f"{name}.npz").resolve()
    np.savez(path, positions=positions, radii=radii, box=np.full(3, edge))
    return {
        "packing": str(path),
        "edge": float(edge),
        "boundary": "periodic" if periodic else "walls",
    }


def run_case(code, case, folder, name, timeout=None):
    """Run a code on a case as a process of its own; return what it took and where it ended.

    Parameters
    ----------
    code : str
    case : dict
        As `peers/README.md` tells.
    folder : pathlib.Path
        For the case and its output.
    name : str
        Of their files.
    timeout : float, optional
        [s]

    Returns
    -------
    dict
        `cpu_s` [s], `wall_s` [s] and `peak_MB` [MB] of the whole process, start included;
        `report`, what the driver wrote; where it tells, `evaluations`, `inside_cpu_s` [s] of the
        code without the start of Python or YADE, `loop_cpu_s` [s] of the iterations alone, and the
        path of the `packing` that it left.
    """
    command, _ = _CODES[code]
    given, output = folder / f"{name}.case.json", folder / f"{name}.json"
    given.write_text(json.dumps(case, indent=2), encoding="utf-8")
    taken = run_timed([*command, given, output], _ONE_THREAD, timeout)
    report = json.loads(output.read_text(encoding="utf-8"))
    result = {**taken, "report": report}
    if "iterations" in report:
        result["evaluations"] = report["iterations"]
        result |= _inside(report)
    if output.with_suffix(".npz").exists():
        result["packing"] = str(output.with_suffix(".npz").resolve())
    return result


def run_tables(case, folder, name, checkout=CHECKOUT):
    """Run branchcrush from a checkout as a process of its own; return what it took, and its tables.

    Parameters
    ----------
    case : dict
        As `peers/README.md` tells; `ranks`, of MPI, may be in it.
    folder : pathlib.Path
        For the case and its output.
    name : str
        Of their files.
    checkout : path-like
        Holds src, lammps_inputs and benchmarks/peers.

    Returns
    -------
    dict
        `cpu_s`, `wall_s` and `peak_MB` as `run_case`; `evaluations`; `inside_s` and
        `inside_cpu_s` of the compression without the start of Python, the latter without ranks;
        `output_MB` of the dumps; `tables`, a `Compression` without contacts.
    """
    given, output = folder / f"{name}.case.json", folder / f"{name}.json"
    given.write_text(json.dumps(case, indent=2), encoding="utf-8")
    checkout = Path(checkout).resolve()
    environment = {**_ONE_THREAD, "PYTHONPATH": str(checkout / "src")}
    script = _PEERS / "branchcrush_tables.py"
    taken = run_timed([*_PYTHON, script, checkout, given, output], environment)
    report = json.loads(output.read_text(encoding="utf-8"))
    path, steps = (
        {column: np.array(values) for column, values in report.pop(table).items()}
        for table in ("path", "steps")
    )
    evaluations = int(path["force_evaluations"][-1])
    tables = Compression(path=path, contacts={}, walls={}, steps=steps, compressed={})
    return {**taken, **report, "evaluations": evaluations, "tables": tables}


def _inside(report):
    """Return the seconds inside a code, and those of its iterations alone."""
    # LIGGGHTS tells those of its iterations on the clock, the same on a machine with nothing else
    # to do. It and LAMMPS do not count the set-up of a run among them, so YADE's first one, in
    # which it sorts all grains, is not counted either.
    inside = report.get("seconds_lammps_cpu", report["seconds_total_cpu"])
    loop = report.get("seconds_loop_cpu", report["seconds_loop"])
    return {
        "inside_cpu_s": inside,
        "loop_cpu_s": loop - report.get("seconds_first_iteration", 0.0),
    }


def judged(packing, case):
    """Return the state of a packing that a code left, as the judge sees it.

    Returns
    -------
    dict
        As `judge.state_of`, and `escaped`, the grains that are outside or lost.
    """
    positions, radii, edge = _read(packing)
    held = np.isfinite(positions).all(axis=1)
    periodic = case["boundary"] == "periodic"
    state = state_of(positions[held], radii[held], edge, periodic, float(case["normal_stiffness"]))
    return {**state, "escaped": state["outside"] + int(np.count_nonzero(~held))}


def branches(packing, case):
    """Return the branch length R_i + R_j [m] and the energy [J] of all contacts between grains."""
    _, _, length, overlap = _contacts(packing, case)
    return length, 0.5 * float(case["normal_stiffness"]) * overlap**2


def largest_coordination(packing, case):
    """Return the contacts of the grain that has most, walls left out."""
    i, j, _, _ = _contacts(packing, case)
    return int(np.bincount(np.concatenate([i, j])).max())


def _contacts(packing, case):
    """Return the grains i, j, the branch length and the overlap of each contact [m]."""
    positions, radii, edge = _read(packing)
    held = np.isfinite(positions).all(axis=1)
    positions, radii = positions[held], radii[held]
    periodic = case["boundary"] == "periodic"
    i, j = near_pairs(positions, radii, edge if periodic else None)
    vector = positions[j] - positions[i]
    if periodic:
        vector -= edge * np.round(vector / edge)
    length = radii[i] + radii[j]
    overlap = length - np.linalg.norm(vector, axis=1)
    touching = overlap > 0.0
    return i[touching], j[touching], length[touching], overlap[touching]


def _read(path):
    with np.load(path) as arrays:
        return arrays["positions"], arrays["radii"], float(arrays["box"][0])
