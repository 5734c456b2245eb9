"""Dense packings under load, and what a force evaluation of one costs."""

import multiprocessing
import resource
import tempfile
import time
from pathlib import Path

import numpy as np

from branchcrush.errors import SimulationError
from branchcrush.gradings import forms, mixtures
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.lammps.compression import compress
from branchcrush.lammps.files import read_dump, write_data_file
from branchcrush.lammps.library import load_lammps
from branchcrush.lammps.neighbours import neighbour_settings
from branchcrush.loading.states import force_floor
from branchcrush.packings.contact_laws import contact_law
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

ROOT = Path(__file__).resolve().parents[1]
INPUTS = ROOT / "lammps_inputs"
STIFFNESS = 1.0e6
LARGEST = 1.0e-3
# Loose packings begin here and carry load from somewhere above the approach.
LOOSE, APPROACH = 0.3, 0.55
FORMS = {
    "single": lambda: mixtures.single(LARGEST),
    "uniform": lambda: forms.uniform(LARGEST / 200, LARGEST),
    "normal": lambda: forms.normal(5e-4, 1.5e-4, 1e-4, LARGEST),
    "lognormal": lambda: forms.lognormal(5e-4, 1.4, 2e-4, 1.2e-3),
    "bidisperse": lambda: mixtures.mixture(
        [mixtures.single(LARGEST / 10), mixtures.single(LARGEST)], [1.0, 1.0], "mass"
    ),
}
# Three strain steps as `in.compress` takes them, with as many force evaluations whatever the
# packing does: nothing of it is saved.
LOOP = """
variable strains loop 3
label strain
variable half string $(lx*0.9995/2:%.17g)
include ${inputs}/mod.cell
include ${inputs}/mod.mass
variable end equal $(step+v_counted)
label relax
if "${boundary} == walls" then "include ${inputs}/mod.near"
run $(ternary(v_end-step<v_longest_run,v_end-step,v_longest_run)) pre no post no
velocity all set 0 0 0
if "$(step) < ${end}" then "jump SELF relax"
variable lists equal $(v_lists+nbuild)
next strains
jump SELF strain
"""


def form_of(name):
    """Return a grading by its name: one of `FORMS`, or "fractal 20", "loguniform 10" with R_M/R_m.

    The fractal one has the dimension 2.5; the largest radius is 1 mm, or 1.2 of the log-normal.
    """
    kind, *ratio = name.split()
    if not ratio:
        return FORMS[kind]()
    smallest = LARGEST / float(ratio[0])
    if kind == "fractal":
        return forms.fractal(smallest, LARGEST, 2.5)
    return forms.loguniform(smallest, LARGEST)


def packing_variables(radii, edge, boundary, **others):
    """Return the variables of `in.compress` for linear contacts, with the chosen neighbours."""
    return {
        "boundary": boundary,
        "law": "linear",
        "stiffness": STIFFNESS,
        "approach_edge": edge,
        "control": "edge",
        "force_floor": force_floor(radii, contact_law("linear", normal_stiffness=STIFFNESS)),
        "largest_radius": float(np.max(radii)),
        **neighbour_settings(radii, edge),
        **others,
    }


def dense_packing(form, grains, solid_fraction, folder, boundary="periodic"):
    """Return the positions, radii and edge of a loaded packing [m], made quickly and coarsely.

    Parameters
    ----------
    form : str or array_like
        Name of a grading, of which the packing gets the quantiles by number, or the radii [m].
    grains : int
    solid_fraction : float
        Of the loaded packing [-].
    folder : path-like
        Where the dumps of the compression may lie.
    boundary : {"periodic", "walls"}
    """
    rng = np.random.default_rng(1)
    if isinstance(form, str):
        radii = sampled_radii(form_of(form), grains, "number_quantiles", rng)
    else:
        radii = np.sort(np.asarray(form, dtype=float))[::-1]
    edge, final = cube_edge(radii, LOOSE), cube_edge(radii, solid_fraction)
    positions = random_packing(radii, edge, periodic=boundary == "periodic", rng=rng)
    variables = packing_variables(
        radii,
        cube_edge(radii, APPROACH),
        boundary,
        approach_steps=30,
        targets=[final],
        strain_step=1e-2,
        step_evaluations=100,
        step_tolerance=0.1,
        state_tolerance=1e-3,
    )
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        log = Path(scratch) / "log"
        done = compress(positions, radii, edge, variables, inputs=INPUTS, folder=scratch, log=log)
        if done.path["stopped"][-1]:
            raise SimulationError(str(done.path["stopped"][-1]))
        *_, last = read_dump(Path(scratch) / "particles.dump.gz")
    return np.column_stack([last[axis] for axis in "xyz"]), radii, final


def replicated(positions, radii, edge, times):
    """Return a periodic packing repeated along each axis: same grading and state, more grains."""
    shifts = np.indices((times,) * 3).reshape(3, -1).T - (times - 1) / 2.0
    return (
        (positions[None] + edge * shifts[:, None]).reshape(-1, 3),
        np.tile(radii, times**3),
        edge * times,
    )


def head_of_script(inputs=INPUTS):
    """Return `in.compress` up to its setup: variables, packing, contacts, what is measured.

    Raises
    ------
    ValueError
        When the script has no such line, after which it loads the packing.
    """
    script = (Path(inputs) / "in.compress").read_text(encoding="utf-8")
    head, setup, _ = script.partition("${inputs}/mod.setup\n")
    if not setup:
        raise ValueError(f"in.compress of {inputs} has no line that includes mod.setup")
    return head + setup


def evaluations_cost(positions, radii, edge, settings, evaluations, boundary, inputs=INPUTS):
    """Return what a force evaluation costs, over three strain steps of 5e-4 in this process.

    Parameters
    ----------
    positions, radii, edge
        Of a loaded packing [m].
    settings : dict
        Variables of `in.compress`, as `branchcrush.lammps.neighbours.neighbour_settings`.
    evaluations : int
        Of the three steps together.
    boundary : {"periodic", "walls"}
    inputs : path-like
        The folder of in.compress.

    Returns
    -------
    dict
        `ns_per_grain_and_evaluation` of the processor, `list_entries` of a grain, force
        `evaluations_per_list`, `bytes_before` and `peak_bytes` of the process; or `error`.
    """
    lammps = load_lammps()
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as scratch:
        scratch = Path(scratch)
        # LAMMPS reads no path with a space in it, and the project may lie in such a one.
        (scratch / "inputs").symlink_to(Path(inputs).resolve())
        (scratch / "head").write_text(head_of_script(inputs), encoding="utf-8")
        (scratch / "loop").write_text(LOOP, encoding="utf-8")
        write_data_file(scratch / "packing.data", positions, radii, edge)
        variables = packing_variables(radii, edge, boundary, **settings)
        variables |= {"inputs": scratch / "inputs", "output_folder": scratch}
        variables |= {"data": scratch / "packing.data"}
        arguments = ["-nocite", "-screen", "none", "-log", str(scratch / "log")]
        for name, value in variables.items():
            arguments += ["-var", name, str(value)]
        before, run = peak_bytes(), lammps(cmdargs=arguments)
        try:
            run.file(str(scratch / "head"))
            run.commands_list(["run 0 post no", f"include {scratch}/inputs/mod.mass"])
            run.commands_list([f"variable counted equal {evaluations // 3}"])
            run.commands_list(["variable lists equal 0"])
            first, start = run.extract_global("ntimestep"), time.process_time()
            run.file(str(scratch / "loop"))
            seconds = time.process_time() - start
            done = run.extract_global("ntimestep") - first
            # Beside those of the relaxation, the cell and, if periodic, the masses ask for one.
            lists = run.extract_variable("lists") + (6 if boundary == "periodic" else 3)
            peak = peak_bytes()
            run.command("run 0")
            said = (scratch / "log").read_text(encoding="utf-8")
        except Exception as error:  # LAMMPS raises plain exceptions
            return {"error": str(error).strip().splitlines()[0]}
        finally:
            run.close()
    entries = [line for line in said.splitlines() if line.startswith("Total # of neighbors")]
    return {
        "ns_per_grain_and_evaluation": seconds / done / len(radii) * 1e9,
        "list_entries": float(entries[-1].split()[-1]) / len(radii),
        "evaluations_per_list": done / lists,
        "bytes_before": before,
        "peak_bytes": peak,
    }


def costs_apart(packings, evaluations, boundary="periodic"):
    """Return `evaluations_cost` of some packings with their settings, from one new process.

    Of small packings, which take few milliseconds, the least of several runs counts; the first run
    of a process loads what LAMMPS needs, and does not.

    A packing is a tuple of positions, radii, edge and settings.
    """
    (positions, radii, edge, _), tries = packings[0], [_tries(p[1]) for p in packings]
    calls = [(positions[:1], radii[:1], edge, {}, 3, boundary)]
    for packing, number in zip(packings, tries, strict=True):
        calls += [(*packing, evaluations, boundary)] * number
    results, costs = iter(apart(evaluations_cost, *calls)[1:]), []
    for number in tries:
        some = [next(results) for _ in range(number)]
        best = min(some, key=lambda cost: cost.get("ns_per_grain_and_evaluation", np.inf))
        # Later runs find memory that the first has left.
        costs.append(best | {name: some[0].get(name) for name in ("bytes_before", "peak_bytes")})
    return costs


def _tries(radii):
    return max(1, min(4, 8000 // len(radii)))


def peak_bytes():
    """Return the most memory that this process has held [bytes]."""
    try:
        # What `getrusage` tells on Linux may be that of the process that started this one.
        status = Path("/proc/self/status").read_text(encoding="utf-8")
        return 1024 * int(status.partition("VmHWM:")[2].split()[0])
    except (OSError, IndexError):
        return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def apart(function, *calls):
    """Return the results of some calls, made in turn in a new process, which then ends.

    LAMMPS keeps some 100 MB of each run until its process ends.
    """
    with multiprocessing.get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        return pool.starmap(function, calls, chunksize=len(calls))
