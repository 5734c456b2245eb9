"""One certified state of large packings, from random placement on, and what a million would take.

A fractal grading, periodic, as `benchmarks.fractal`, through the path that the workflow takes with
quality `standard`. Each packing is placed and compressed in processes of its own.
"""

import json
import tempfile
import time
from pathlib import Path

from benchmarks.codes import run_tables
from benchmarks.dense import apart, peak_bytes
from benchmarks.fractal import APPROACH, STIFFNESS, TOLERANCE, loose_case
from benchmarks.measure import MemoryOfChildren
from benchmarks.paths import UNLIMITED, quantities
from benchmarks.sizes import estimate, line_of_size, power_of_size, shares
from branchcrush.loading.targets import strain_step
from branchcrush.packings.geometry import cube_edge

# What is followed over the number of grains, by a power or a line.
_GROWTH = {
    "evaluations": power_of_size,
    "cpu_us_per_grain_and_evaluation": power_of_size,
    "peak_MB": line_of_size,
    "output_MB": line_of_size,
}
_STATE = (
    "solid_fraction",
    "mean_stress_Pa",
    "coordination_number",
    "mechanical_coordination_number",
    "unbalanced_force_ratio",
)


def run(
    grains=(1000, 5000, 20_000, 100_000),
    ratio=20.0,
    solid_fraction=0.833,
    seeds=(1, 2, 3),
    few=5000,
    ranks_from=20_000,
    jamming_grains=5000,
    million=1_000_000,
):
    """Return what a certified state takes against the number of grains.

    Parameters
    ----------
    grains : sequence of int
    ratio : float
        Largest over smallest radius [-].
    solid_fraction : float
        Of the state, about 0.05 above jamming [-].
    seeds : sequence of int
        Of packings up to `few` grains; of larger ones there is the first alone.
    few : int
    ranks_from : int
        From so many grains on, two ranks as well as one.
    jamming_grains : int
        Of the packing that tells where the grading jams, each of its strain steps relaxed as far as
        it takes; 0 leaves it out.
    million : int
        Grains for which the time and memory are estimated.

    Returns
    -------
    dict
        `rows`, for each packing and count of ranks: `placement_s`, `wall_s` and `cpu_s` of the
        whole process, `evaluations`, of the `approach`, of the `steps` and of the `final`
        relaxation, `peak_MB` of all processes together, `output_MB` and the `state`;
        `jamming_solid_fraction` of the grading, and `above_jamming`, how far above it the states
        are, None where it is not known; `growth`, of the evaluations and of the time of one as
        N^p, of memory and output along a line; `speed_up` by two ranks; `million`, the estimate
        and what it assumes.
    """
    rows, jammed = [], None
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
        if jamming_grains:
            placed = apart(_placed, (folder, jamming_grains, ratio, seeds[0]))[0]
            jammed = _jamming(Path(folder), placed, solid_fraction)
            print(f"  jams at {jammed:.4f}", flush=True)
        for number in grains:
            for seed in seeds if number <= few else seeds[:1]:
                placed = apart(_placed, (folder, number, ratio, seed))[0]
                for ranks in (1, 2) if number >= ranks_from else (1,):
                    row = _row(Path(folder), placed, solid_fraction, ranks)
                    rows.append({"grains": number, "seed": seed, "ranks": ranks, **row})
                    print(f"  {_line(rows[-1])}", flush=True)
    alone = [row for row in rows if row["ranks"] == 1]
    growth = {name: by(alone, name) for name, by in _GROWTH.items()} if len(grains) > 1 else {}
    speed_up = _speed_up(rows)
    result = {
        "ratio": ratio,
        "solid_fraction": solid_fraction,
        "jamming_solid_fraction": jammed,
        "above_jamming": None if jammed is None else solid_fraction - jammed,
        "rows": rows,
        "growth": growth,
        "speed_up": speed_up,
    }
    if growth:
        result["million"] = estimate(
            alone, growth, speed_up[-1]["wall"] if speed_up else None, million
        )
    return result


def _placed(folder, grains, ratio, seed):
    """Return the loose case of a packing, its radii [m], and what placing it took."""
    start = time.process_time()
    radii, case = loose_case(Path(folder), grains, ratio, seed)
    placement = {"placement_s": time.process_time() - start, "placement_MB": peak_bytes() / 1e6}
    return radii, case, placement


def _case(placed, solid_fraction, **others):
    """Return the case of a placed packing, loaded as the workflow does it, to one state."""
    radii, loose, _ = placed
    path = {"approach_solid_fraction": APPROACH, "strain_step": strain_step("standard")}
    return {
        **loose,
        "final_edge": float(cube_edge(radii, solid_fraction)),
        "normal_stiffness": STIFFNESS,
        "state_tolerance": TOLERANCE,
        "path": {**path, "states": 1, **others},
    }


def _jamming(folder, placed, solid_fraction):
    """Return the solid fraction at which a placed packing jams."""
    case = _case(placed, solid_fraction, step_evaluations=UNLIMITED)
    done = run_tables(case, folder, "jamming")
    return quantities(done["tables"], placed[0])["jamming_solid_fraction"]


def _row(folder, placed, solid_fraction, ranks):
    """Compress a placed packing to its state; return what it took, and the state."""
    radii, loose, placement = placed
    case = {**_case(placed, solid_fraction), "ranks": ranks}
    with MemoryOfChildren() as memory:
        done = run_tables(case, folder, f"{Path(loose['packing']).stem}_{ranks}")
    state, steps = done["tables"].path, done["tables"].steps
    if state["stopped"][-1]:
        raise RuntimeError(f"{len(radii)} grains on {ranks} rank(s): {state['stopped'][-1]}")
    evaluations, cpu = done["evaluations"], done["cpu_s"]
    return {
        **placement,
        "wall_s": done["wall_s"],
        "cpu_s": cpu,
        "evaluations": evaluations,
        **shares(steps["force_evaluations"]),
        "strain_steps": int(steps["step"][-1]),
        "cpu_us_per_grain_and_evaluation": 1e6 * cpu / evaluations / len(radii),
        "peak_MB": memory.peak_MB,
        "output_MB": done["output_MB"],
        "state": {name: float(state[name][-1]) for name in _STATE},
    }


def _speed_up(rows):
    """Return by how much two ranks are faster on the clock, for each packing run on both."""
    seconds = {(row["grains"], row["seed"], row["ranks"]): row["wall_s"] for row in rows}
    return [
        {"grains": grains, "seed": seed, "wall": seconds[grains, seed, 1] / wall}
        for (grains, seed, ranks), wall in seconds.items()
        if ranks == 2
    ]


def _line(row):
    told = {**row, **row["state"]}
    parts = "{approach_evaluations} + {steps_evaluations} + {final_evaluations} evaluations"
    line = "{grains} grains, seed {seed}, {ranks} rank(s): {wall_s:.1f} s, {cpu_s:.1f} CPU s, "
    line += parts + ", {peak_MB:.0f} MB, {mean_stress_Pa:.2e} Pa, Z "
    line += "{coordination_number:.2f}, unbalanced {unbalanced_force_ratio:.0e}"
    return line.format(**told)


def summary(result):
    """Return the lines that tell of a result in short."""
    lines = []
    if result["above_jamming"] is not None:
        line = "{above_jamming:.4f} above jamming at {jamming_solid_fraction:.4f}"
        lines.append(line.format(**result))
    lines += [_line(row) for row in result["rows"]]
    for name in ("evaluations", "cpu_us_per_grain_and_evaluation"):
        if name in result["growth"]:
            by = result["growth"][name]
            error = by["standard_error"]
            line = f"{name} grows as N^{by['power']:.2f}"
            lines.append(line + ("" if error is None else f" ± {error:.2f}"))
    for by in result["speed_up"]:
        lines.append(f"{by['grains']} grains on two ranks: {by['wall']:.2f} times as fast")
    if "million" in result:
        told = result["million"]
        line = f"{told['grains']} grains: {told['hours_on_1_core']:.1f} h on a core"
        if told["hours_on_8_ranks"] is not None:
            line += f", {told['hours_on_8_ranks']:.1f} h on 8 ranks"
        lines.append(f"{line}, {told['peak_MB'] / 1000.0:.1f} GB, estimated")
    return lines


if __name__ == "__main__":
    print(json.dumps(run(), indent=2))
