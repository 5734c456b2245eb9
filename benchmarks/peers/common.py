"""What the drivers of peers share: reading a case, running a code, judging and saving its state."""

import json
import os
import resource
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

# Drivers are run as scripts, so their own folder is on the path but not that of the judge.
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from judge import state_of


class Packing(NamedTuple):
    """A packing in a cube."""

    positions: np.ndarray  # (N, 3), origin at the centre of the cube [m]
    radii: np.ndarray  # (N,) [m]
    edge: float  # of the cube [m]


class Finished(NamedTuple):
    """What a run of an external code took and wrote."""

    seconds: float  # wall
    cpu_seconds: float  # user time of the code alone
    output: str


def read_case(path, defaults):
    """Return a case, the peer's default path settings filled in, and its packing.

    Parameters
    ----------
    path : path-like
        The case as JSON; a relative `packing` in it is relative to its folder.
    defaults : dict
        Every path setting of the peer; the case may set no others.

    Returns
    -------
    case : dict
    packing : Packing
    """
    path = Path(path)
    case = json.loads(path.read_text(encoding="utf-8"))
    unknown = sorted(set(case.get("path", {})) - set(defaults))
    if unknown:
        raise SystemExit(f"{path}: no such settings of the path: {', '.join(unknown)}")
    case["path"] = {**defaults, **case.get("path", {})}
    return case, read_packing(path.parent / case["packing"], float(case["edge"]))


def read_packing(path, edge=None):
    """Return a packing from .npz; without an edge, that of the `box` in the file is taken."""
    with np.load(path) as arrays:
        edge = float(arrays["box"][0]) if edge is None else edge
        return Packing(arrays["positions"], arrays["radii"], edge)


def write_data_file(path, packing, densities):
    """Write a packing as data of atom style sphere, which LAMMPS and LIGGGHTS both read.

    Parameters
    ----------
    path : path-like
    packing : Packing
    densities : array_like, shape (N,)
        [kg/m3]
    """
    half = packing.edge / 2.0
    lines = ["packing, SI units", "", f"{len(packing.radii)} atoms", "1 atom types", ""]
    lines += [f"{-half!r} {half!r} {axis}lo {axis}hi" for axis in "xyz"]
    lines += ["", "Atoms", ""]
    rows = zip(packing.positions.tolist(), packing.radii.tolist(), densities, strict=True)
    for n, ((x, y, z), radius, density) in enumerate(rows, start=1):
        lines.append(f"{n} 1 {2.0 * radius!r} {float(density)!r} {x!r} {y!r} {z!r}")
    Path(path).write_text("\n".join(lines) + "\n", encoding="ascii")


def volumes(radii):
    """Return the volumes of spheres [m3]."""
    return 4.0 / 3.0 * np.pi * np.asarray(radii) ** 3


def run_code(command, folder, settings):
    """Run a code in a folder on one thread; its failure ends the driver.

    Parameters
    ----------
    command : list of str
    folder : path-like
    settings : dict
        Given to the code as `-var name value ...`; a list becomes several values.

    Returns
    -------
    Finished
    """
    command = [*command]
    for name, value in settings.items():
        values = value if isinstance(value, list) else [value]
        command += ["-var", name, *(str(item) for item in values)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    start = time.perf_counter()
    done = subprocess.run(
        command,
        cwd=folder,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        errors="replace",
    )
    seconds = time.perf_counter() - start
    cpu_seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if done.returncode:
        last = (done.stdout + done.stderr)[-2000:]
        raise SystemExit(f"{command[0]} stopped with exit code {done.returncode}:\n{last}")
    return Finished(seconds, cpu_seconds, done.stdout)


def read_positions(path, grains):
    """Return the positions of a dump of one frame with columns id x y z; nan for a lost grain."""
    body = Path(path).read_text(encoding="ascii").partition("ITEM: ATOMS")[2].partition("\n")[2]
    rows = np.array(body.split(), dtype=float).reshape(-1, 4)
    positions = np.full((grains, 3), np.nan)
    positions[rows[:, 0].astype(int) - 1] = rows[:, 1:]
    return positions


def final_state(packing, periodic, stiffness):
    """Return what the judge says of a packing, the grains that were lost left out but counted."""
    held = ~np.isnan(packing.positions).any(axis=1)
    positions, radii = packing.positions[held], packing.radii[held]
    state = state_of(positions, radii, packing.edge, periodic, stiffness)
    lost = int(np.count_nonzero(~held))
    return {
        "escaped": state["outside"] + lost,
        "unbalanced_force_ratio": float(state["unbalanced_force_ratio"]),
    }


def write_result(path, result, packing=None):
    """Write the result as JSON and, beside it as .npz, the packing in the order of the input."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    if packing is not None:
        positions, radii, edge = packing
        np.savez(path.with_suffix(".npz"), positions=positions, radii=radii, box=np.full(3, edge))
    path.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
