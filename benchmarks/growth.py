"""How time and memory grow with the number of grains, and with the ratio of their sizes."""

import json
import tempfile
import time
from itertools import product

import numpy as np

from benchmarks.dense import (
    INPUTS,
    LOOSE,
    apart,
    costs_apart,
    dense_packing,
    form_of,
    packing_variables,
    peak_bytes,
    replicated,
)
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.lammps.compression import compress
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

LIMIT = 1.5
LOADED = {"lognormal": 0.68}
SIZE_RATIOS = (2, 5, 10, 20, 50, 100, 200)
# A fractal packing of some thousand grains has none near R_M where R_M/R_m is above about 20.
FRACTAL_UP_TO = 20


def run(
    forms=("fractal 20", "uniform"),
    base=1000,
    times=(1, 2, 3, 4, 5),
    ratios=SIZE_RATIOS,
    ratio_grains=5000,
    placed=(1000, 10_000, 100_000, 1_000_000),
    evaluations=300,
    repeats=3,
):
    """Return costs against the number of grains, against the size ratio, and those of placing.

    Larger packings repeat a periodic one of `base` grains, so that all are of one grading and in
    one state; a measurement is the best of `repeats`, taken in turn.

    Parameters
    ----------
    forms : sequence of str
        Of `benchmarks.dense.form_of`.
    base : int
        Grains.
    times : sequence of int
        How often the packing is repeated along each axis, the first and fewest once.
    ratios : sequence of float
        R_M/R_m of log-uniform gradings, and, up to 20, of fractal ones.
    ratio_grains : int
    placed : sequence of int
        Grains that are placed at random, fractal by 20, at a solid fraction of 0.3.
    evaluations : int
        Of a measurement.
    repeats : int

    Returns
    -------
    dict
        `grains`: for each form and number the cost [ns of the processor for a grain and a force
        evaluation] and the memory [bytes for a grain] of LAMMPS and of all that `compress` does,
        above what the process holds without a packing; `growth`: for each form the cost at the
        largest number over that at the smallest, and its `limit`. `size_ratios`: the cost and the
        realised ratio. `placement`: seconds of the processor and bytes.
    """
    by_grains = [
        row for form in forms for row in _by_grains(form, base, times, evaluations, repeats)
    ]
    growth = {}
    for form in forms:
        costs = [r["ns_per_grain_and_evaluation"] for r in by_grains if r["form"] == form]
        growth[form] = costs[-1] / costs[0]
    return {
        "grains": by_grains,
        "growth": growth,
        "limit": LIMIT,
        "size_ratios": _by_ratio(ratios, ratio_grains, evaluations, repeats),
        "placement": [
            {"grains": grains, "boundary": boundary}
            | apart(_place, ("fractal 20", grains, boundary))[0]
            for grains, boundary in product(placed, ("walls", "periodic"))
        ],
    }


def _by_grains(form, base, times, evaluations, repeats):
    """Return the costs of a packing and of its repetitions."""
    ((*packing, edge),) = apart(dense_packing, (form, base, LOADED.get(form, 0.72), None))
    packings = [replicated(*packing, edge, number) for number in times]
    costs = _costs(packings, evaluations, repeats)
    rows = []
    for (positions, radii, cell), cost in zip(packings, costs, strict=True):
        (memory,) = apart(_memory_of_compression, (positions, radii, cell))
        rows.append({"form": form, "grains": len(radii), **cost, "compression_bytes": memory})
    return rows


def _by_ratio(ratios, grains, evaluations, repeats):
    """Return the costs of gradings with several ratios of the largest to the smallest radius."""
    forms = [f"loguniform {ratio}" for ratio in ratios]
    forms += [f"fractal {ratio}" for ratio in ratios if ratio <= FRACTAL_UP_TO]
    packings = [apart(dense_packing, (form, grains, 0.72, None))[0] for form in forms]
    return [
        {"form": form, "grains": grains, "realised_ratio": float(radii.max() / radii.min()), **cost}
        for form, (_, radii, _), cost in zip(
            forms, packings, _costs(packings, evaluations, repeats), strict=True
        )
    ]


def _costs(packings, evaluations, repeats):
    """Return the least cost of each packing, tried in turn, and the memory for a grain."""
    found = [[] for _ in packings]
    for _ in range(repeats):
        for costs, (positions, radii, edge) in zip(found, packings, strict=True):
            # As many for all: so each makes as many neighbour lists for them.
            costs += costs_apart([(positions, radii, edge, {})], evaluations)
    rows = []
    for costs, (_, radii, _) in zip(found, packings, strict=True):
        for cost in costs:
            if "error" in cost:
                raise RuntimeError(cost["error"])
        row = min(costs, key=lambda cost: cost["ns_per_grain_and_evaluation"])
        memory = (row.pop("peak_bytes") - row.pop("bytes_before")) / len(radii)
        rows.append(row | {"lammps_bytes_per_grain": memory})
    return rows


def _memory_of_compression(positions, radii, edge):
    """Return what `compress` takes for a grain: files, LAMMPS, two saved states, tables [bytes]."""
    before = peak_bytes()
    variables = packing_variables(
        radii,
        edge * 0.9995,
        "periodic",
        approach_steps=1,
        targets=[edge * 0.999],
        strain_step=1e-3,
        # Whatever state it is in, it is saved.
        step_tolerance=1e9,
        state_tolerance=1e9,
    )
    with tempfile.TemporaryDirectory() as scratch:
        log = f"{scratch}/log"
        compress(positions, radii, edge, variables, inputs=INPUTS, folder=scratch, log=log)
    return (peak_bytes() - before) / len(radii)


def _place(form, grains, boundary):
    """Return what it takes to place grains at random."""
    rng = np.random.default_rng(1)
    radii = sampled_radii(form_of(form), grains, "number_quantiles", rng)
    before, start = peak_bytes(), time.process_time()
    random_packing(radii, cube_edge(radii, LOOSE), periodic=boundary == "periodic", rng=rng)
    return {
        "seconds": time.process_time() - start,
        "bytes": peak_bytes() - before,
        "peak_bytes": peak_bytes(),
    }


if __name__ == "__main__":
    print(json.dumps(run(), indent=2))
