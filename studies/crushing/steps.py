"""Where the work of a crushing goes, by how the strain steps are taken.

    python studies/crushing/steps.py [processes]

crushes the same packings of 200 grains in strain steps of several sizes, nearer to rest, and with
steps that end where the next grain breaks, and writes docs/results/crushing_steps.csv: a row for
each packing and way. Ten minutes on 2 cores.
"""

import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd

from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.files.tables import provenance, write_table
from branchcrush.lammps.compression import compression_variables
from branchcrush.lammps.crush import crush
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing
from branchcrush.samples.crushed_path import TOLD, energies

REPOSITORY = Path(__file__).resolve().parents[2]
TABLE = REPOSITORY / "docs" / "results" / "crushing_steps.csv"
SEEDS = range(1, 7)
GRAINS, INITIAL, SOLID_FRACTION = 200, 0.2, 0.70
# Largest linear strain of a step, unbalanced force ratio at which grains are judged, and how steps
# end: one thing is changed at a time.
WAYS = (
    (2e-3, 1e-2, "strain_step"),
    (1e-3, 1e-2, "strain_step"),
    (5e-4, 1e-2, "strain_step"),
    (2.5e-4, 1e-2, "strain_step"),
    (1e-3, 1e-3, "strain_step"),
    (2e-3, 1e-2, "events"),
    (5e-4, 1e-2, "events"),
)


def crushed(case: tuple) -> dict:
    """Crush a packing in one way; return where the work since its first breakage went."""
    seed, (strain_step, tolerance, stepping) = case
    rng = np.random.default_rng(seed)
    radii = rng.uniform(0.4e-3, 0.6e-3, GRAINS)
    edge = cube_edge(radii, INITIAL)
    positions = random_packing(radii, edge, periodic=True, rng=rng)
    variables = compression_variables(
        radii,
        INITIAL,
        boundary="periodic",
        law=LinearContact(1e6),
        loading=Loading("solid_fraction", SOLID_FRACTION, states=10, approach_solid_fraction=0.6),
        strain_step=strain_step,
        state_tolerance=1e-6,
    )
    strength = Strength(
        strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3, size_exponent=1.0
    )
    rules = Breakage(
        strength=strength,
        smallest_diameter=2.5e-4,
        stepping=stepping,
        step_tolerance=tolerance,
    )
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
        path = crush(
            positions,
            radii,
            edge,
            variables,
            rules,
            seed=seed,
            inputs=REPOSITORY / "lammps_inputs",
            folder=folder,
            log=Path(folder, "log"),
            keep_dumps="none",
        ).path
    end = energies(pd.DataFrame(path)).iloc[-1]
    return {
        "strain_step": strain_step,
        "step_tolerance": tolerance,
        "stepping": stepping,
        "seed": seed,
        "grains": int(path["grains"][-1]),
        "breakages": int(path["breakages"][-1]),
        "mean_stress_Pa": float(np.mean(path["mean_stress_Pa"][-3:])),
        "work_since_breakage_J": end["work_since_breakage_J"],
        **{f"{name}_share": end[f"{name}_share"] for name in TOLD},
        "force_evaluations": int(path["force_evaluations"][-1]),
    }


def main(processes: int = 2) -> None:
    """Write the table."""
    with ProcessPoolExecutor(processes) as pool:
        rows = list(pool.map(crushed, product(SEEDS, WAYS)))
    order = {way: number for number, way in enumerate(WAYS)}
    rows.sort(key=lambda row: order[row["strain_step"], row["step_tolerance"], row["stepping"]])
    write_table(TABLE, pd.DataFrame(rows), provenance())


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
