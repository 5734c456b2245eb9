"""The choice of `branchcrush.lammps.neighbours` against a scan of styles, collections and skins."""

import json
import sys
import tempfile
from itertools import product

import numpy as np

from benchmarks.dense import INPUTS, apart, costs_apart, dense_packing, packing_variables
from branchcrush.errors import BranchcrushError
from branchcrush.lammps.compression import compress
from branchcrush.lammps.neighbours import neighbour_settings
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

LIMIT = 1.15
LOADED = 0.72
# Of a packing with one size of grains, or nearly so, which jams without finer ones in between.
LOADED_ALIKE = {"single": 0.66, "normal": 0.68, "lognormal": 0.68}
FORMS = (
    "single",
    "uniform",
    "normal",
    "lognormal",
    "loguniform 10",
    "loguniform 40",
    "fractal 5",
    "fractal 20",
    "bidisperse",
)
LARGE = ("fractal 20", "uniform", "lognormal")
SKINS, COLLECTIONS = (0.15, 0.3, 0.6), (2, 3, 4, 6)
# Of a measurement: a hundred for each of its strain steps, about as many as in a loading.
EVALUATIONS = 300
# Radii in micrometres of small boxes with giant grains.
ODD = {
    "30 and 1 ten times larger": [1000.0] + [100.0] * 30,
    "200 and 2 fifty times larger": [1000.0] * 2 + [20.0] * 200,
    "8 alike": [1000.0] * 8,
    "2 alike": [1000.0] * 2,
}


def run(
    forms=FORMS,
    sizes=(1000, 5000),
    large=LARGE,
    large_sizes=(20000,),
    repeats=3,
    evaluations=EVALUATIONS,
):
    """Return what force evaluations cost with the chosen settings, and with those of a scan.

    The best of the `repeats` counts, taken in turn, because other work disturbs a machine; settings
    that took more than twice the best of the first turn are not tried again.

    Parameters
    ----------
    forms : sequence of str
        Of `benchmarks.dense.form_of`, each with all `sizes`.
    sizes : sequence of int
        Grains.
    large, large_sizes
        The same, of the larger packings.
    repeats : int
    evaluations : int
        Force evaluations of a measurement.

    Returns
    -------
    dict
        `rows`, one for each packing: `chosen` and `best` settings and their costs [ns of the
        processor for a grain and a force evaluation], `ratio` of these, for information that of
        `plain` (one grid, a skin of a tenth of the largest radius), and all of the `scan`;
        `largest_ratio` and its `limit`; `odd`, what became of small boxes with giant grains.
    """
    cases = [*product(forms, sizes), *product(large, large_sizes)]
    rows = [_row(form, grains, repeats, evaluations) for form, grains in cases]
    return {
        "rows": rows,
        "largest_ratio": max((row["ratio"] for row in rows), default=None),
        "limit": LIMIT,
        "odd": robustness(),
    }


def _row(form, grains, repeats, evaluations):
    """Return the costs of all settings on one packing."""
    fraction = LOADED_ALIKE.get(form, LOADED)
    ((positions, radii, edge),) = apart(dense_packing, (form, grains, fraction, None))
    settings = scan(radii) | {"chosen": neighbour_settings(radii, edge)}
    tried, costs, chosen = list(settings), {name: [] for name in settings}, {}
    for _ in range(repeats):
        found = {}
        # A few in one process: LAMMPS keeps memory of each until it ends.
        for some in (tried[k : k + 6] for k in range(0, len(tried), 6)):
            packings = [(positions, radii, edge, settings[name]) for name in some]
            found |= dict(zip(some, costs_apart(packings, evaluations), strict=True))
        for name, cost in found.items():
            costs[name].append(cost.get("ns_per_grain_and_evaluation", np.inf))
        chosen = found["chosen"]
        least = min(min(cost, default=np.inf) for cost in costs.values())
        keep = {"chosen", "plain"}
        tried = [name for name in tried if name in keep or min(costs[name]) <= 2.0 * least]
    ns = {name: min(cost) for name, cost in costs.items()}
    best = min((name for name in ns if name != "plain"), key=ns.get)
    return {
        "form": form,
        "grains": grains,
        "size_ratio": float(radii.max() / radii.min()),
        "chosen": settings["chosen"],
        "chosen_ns": ns["chosen"],
        "best": best,
        "best_ns": ns[best],
        "ratio": ns["chosen"] / ns[best],
        "plain_ns": ns["plain"],
        "list_entries": chosen.get("list_entries"),
        "evaluations_per_list": chosen.get("evaluations_per_list"),
        # None where LAMMPS refused, as it may with a list too long.
        "scan_ns": {name: cost if np.isfinite(cost) else None for name, cost in ns.items()},
    }


def scan(radii):
    """Return the settings that are tried, by a name; collections widen by one factor each."""
    diameters = 2.0 * np.asarray(radii)
    mean, most = float(diameters.mean()), len(diameters) + 2000
    plain = {"neighbour_style": "bin", "collections": "none", "neighbours": most}
    settings = {"plain": plain | {"skin": 0.05 * float(diameters.max())}}
    alike = diameters.min() > 0.999 * diameters.max()
    for skin in SKINS:
        settings[f"bin, skin {skin}"] = plain | {"skin": skin * mean}
        for number in () if alike else COLLECTIONS:
            bounds = np.geomspace(diameters.min(), 1.0001 * diameters.max(), number + 1)[1:]
            words = " ".join(map(repr, [number, *bounds.tolist()]))
            settings[f"multi {number}, skin {skin}"] = plain | {
                "neighbour_style": "multi",
                "collections": words,
                "skin": skin * mean,
            }
    return settings


def robustness(boundaries=("periodic", "walls")):
    """Return for each small box with giant grains "ok", or why its compression ended."""
    return {
        f"{name}, {boundary}": apart(_compress, (radii, boundary))[0]
        for name, radii in ODD.items()
        for boundary in boundaries
    }


def _compress(radii, boundary):
    radii, rng = 1e-6 * np.array(radii), np.random.default_rng(1)
    edge = cube_edge(radii, 0.1)
    # A few grains jam late, and must not be larger than the cell they end in.
    approach, final = cube_edge(radii, 0.3), max(cube_edge(radii, 0.6), 2.05 * radii.max())
    approach = max(approach, 1.05 * final)
    variables = packing_variables(
        radii, approach, boundary, targets=[final], strain_step=1e-2, state_tolerance=1e-6
    )
    try:
        positions = random_packing(radii, edge, periodic=boundary == "periodic", rng=rng)
        with tempfile.TemporaryDirectory() as scratch:
            log = f"{scratch}/log"
            done = compress(
                positions, radii, edge, variables, inputs=INPUTS, folder=scratch, log=log
            )
            return str(done.path["stopped"][-1]) or "ok"
    except BranchcrushError as error:
        return str(error).partition(" (log")[0]


if __name__ == "__main__":
    print(json.dumps(run(sys.argv[1:] or FORMS), indent=2))
