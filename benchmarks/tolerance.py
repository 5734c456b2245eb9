"""What a looser state tolerance changes: every state of the paper's case, saved on its way to rest.

Each state is saved as soon as its unbalanced force ratio is below the loosest tolerance, and then
again below each finer one, in one relaxation: the states differ by nothing else.
"""

import shutil
import tempfile
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.dense import INPUTS
from benchmarks.paths import EDGE_REDUCTION, ENDS, LAW, LOOSE, paper_packing
from branchcrush.lammps.compression import compress, compression_variables
from branchcrush.loading.targets import Loading, strain_step
from branchcrush.statistics.bins import bin_edges, binned_sums
from branchcrush.statistics.power_law import binned_exponent

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
QUANTITIES = ("mean_stress_Pa", "elastic_energy_J", "mechanical_coordination_number")
_TOLERANCE = "ternary(v_is_state,v_state_tolerance,v_step_tolerance)"


def run(seeds=48, states=15, cores=2):
    """Return how states at each tolerance differ from those at the finest one.

    Parameters
    ----------
    seeds : int
        Packings of the paper's case: 1 to so many.
    states : int
        Of a path, without the approach.
    cores : int
        Packings compressed at a time.

    Returns
    -------
    dict
        For each tolerance: `evaluations`, the share of those to the finest one that it takes;
        `largest_difference`, over all loaded states and packings, of each of `QUANTITIES`
        (relative) and of `contacts`, how many more contacts there are; `stress_identity_error`
        and `energy_excess`, the largest, as the certificate has them; `exponent`, of the last
        states of all packings.
    """
    with ProcessPoolExecutor(cores, max_tasks_per_child=1) as pool:
        packings = list(pool.map(partial(_packing, states=states), range(1, seeds + 1)))
    rows = {}
    for n, tolerance in enumerate(TOLERANCES):
        row = {
            name: max(packing[n][name] for packing in packings)
            for name in packings[0][n]
            if name not in ("evaluations", "sums")
        }
        shares = [packing[n]["evaluations"] / packing[-1]["evaluations"] for packing in packings]
        sums = np.array([packing[n]["sums"] for packing in packings])
        _, exponent = binned_exponent(sums, confidence=0.68, rng=np.random.default_rng(0))
        row |= {"evaluations": float(np.mean(shares)), "exponent": [float(x) for x in exponent]}
        rows[f"{tolerance:g}"] = row
    return {"seeds": seeds, "states": states, "cores": cores, "tolerances": rows}


def _packing(seed, states):
    """Return, for each tolerance, how the states of a packing differ from the finest ones."""
    positions, radii, edge = paper_packing(seed)
    loading = Loading("edge_reduction", EDGE_REDUCTION, states)
    variables = compression_variables(
        radii,
        LOOSE,
        boundary="walls",
        law=LAW,
        loading=loading,
        strain_step=strain_step("standard"),
    )
    finer = len(TOLERANCES)
    # A target where the cell is already only goes on with the relaxation.
    variables["targets"] = [edge for edge in variables["targets"] for _ in TOLERANCES]
    with tempfile.TemporaryDirectory() as scratch:
        inputs = Path(shutil.copytree(INPUTS, Path(scratch) / "inputs"))
        text = (inputs / "mod.edge").read_text(encoding="utf-8")
        saved = f"{TOLERANCES[0]!r}*0.1^((v_state-2)%{finer})"
        if _TOLERANCE not in text:
            raise RuntimeError("mod.edge chooses the tolerance of a state in another way")
        text = text.replace(_TOLERANCE, f"ternary(v_is_state,{saved},v_step_tolerance)")
        (inputs / "mod.edge").write_text(text, encoding="utf-8")
        log = Path(scratch) / "log"
        done = compress(positions, radii, edge, variables, inputs=inputs, folder=scratch, log=log)
    # Of the states that carry load; before them there are the packing and the approach.
    path = {name: column[2:].reshape(states, finer) for name, column in done.path.items()}
    loaded = path["carries_load"].all(axis=1)
    before = done.path["force_evaluations"][1 : 1 + states * finer]
    taken = (done.path["force_evaluations"][2:] - before).reshape(states, finer).cumsum(axis=1)
    return [_row(done, path, loaded, taken, n) for n in range(finer)]


def _row(done, path, loaded, taken, n):
    at = {name: column[loaded] for name, column in path.items()}
    last = done.contacts["state"] == path["state"][-1, n]
    length = (done.contacts["radius_i_m"] + done.contacts["radius_j_m"])[last]
    sums = binned_sums(length, done.contacts["energy_J"][last], bin_edges(*ENDS))
    contacts = np.bincount(done.contacts["state"], minlength=path["state"][-1, -1] + 1)
    contacts = contacts[path["state"]][loaded]
    row = {name: float(np.abs(at[name][:, n] / at[name][:, -1] - 1.0).max()) for name in QUANTITIES}
    return row | {
        "contacts": int(np.abs(contacts[:, n] - contacts[:, -1]).max()),
        "unbalanced_force_ratio": float(at["unbalanced_force_ratio"][:, n].max()),
        "inertial_number": float(at["inertial_number"][:, n].max()),
        "stress_identity_error": float(
            np.abs(at["mean_stress_Pa"][:, n] / at["boundary_stress_Pa"][:, n] - 1.0).max()
        ),
        "energy_excess": float((-at["dissipated_J"][:, n] / at["work_J"][:, n]).max()),
        "evaluations": int(taken[loaded][:, n].sum()),
        "sums": np.asarray(sums).tolist(),
    }
