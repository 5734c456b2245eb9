"""The crushing of a packing in LAMMPS, from the radii, the loading and the strengths to tables."""

import shutil
from collections.abc import Mapping
from contextlib import ExitStack
from os import PathLike
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from branchcrush.breakage.rules import Breakage
from branchcrush.errors import SimulationError
from branchcrush.files.scratch import remove_leavings, scratch_folder
from branchcrush.lammps.compression import keep
from branchcrush.lammps.crushing import crushing_task
from branchcrush.lammps.files import write_data_file
from branchcrush.lammps.links import linked
from branchcrush.lammps.output import read_compression
from branchcrush.lammps.progress import Job, Progress
from branchcrush.lammps.run import declared_variables, run_task

# Force evaluations that a relaxation may take.
LARGEST_RELAXATION = 400_000
# Columns of the table of breakages, beside what they are called on the way.
_BREAKAGES = {
    "state": "state",
    "step": "step",
    "round": "round",
    "solid_fraction": "solid_fraction",
    "grain": "number",
    "parent": "parent",
    "generation": "generation",
    "radius_m": "radius",
    "contacts": "contacts",
    "largest_force_N": "largest_force",
    "stress_Pa": "stress",
    "strength_Pa": "strength",
    "released_J": "energy",
}
_GRAINS = {
    "grain": "number",
    "parent": "parent",
    "generation": "generation",
    "radius_m": "radius",
    "strength_Pa": "strength",
    "stress_Pa": "stress",
}


class Crushed(NamedTuple):
    """What a crushing leaves: a table for each kind of thing, as a dict of columns."""

    path: dict  # a row for each state
    contacts: dict  # a row for each contact and state; i and j are rows among the state's grains
    walls: dict  # the same with walls
    steps: dict  # a row for each strain step
    grains: dict  # a row for each grain and state
    breakages: dict  # a row for each grain that broke


def crush(
    positions: np.ndarray,
    radii: np.ndarray,
    edge: float,
    variables: Mapping[str, Any],
    rules: Breakage,
    *,
    seed: int,
    inputs: str | PathLike[str],
    folder: str | PathLike[str],
    log: str | PathLike[str],
    ranks: int = 1,
    keep_dumps: Literal["all", "last", "none"] = "all",
    progress: str | PathLike[str] | None = None,
    code: str = "",
) -> Crushed:
    """Compress a packing in LAMMPS whose grains break, and return its path and what broke.

    The same strain steps as `compression.compress` takes to its target edges, each relaxed until
    grains can be judged. While some are overloaded, fragments take their places, grow until no mass
    is lost and come to rest, in a cell that keeps still.

    Parameters
    ----------
    positions, radii, edge, variables, inputs, folder, log, ranks, keep_dumps
        As for `compression.compress`; variables of a loading to edges.
    rules : Breakage
    seed : int
        Of the packing; strengths and rotations are drawn by it and each grain's descent.
    progress : path-like, optional
        A folder of its own where each saved state is kept. A run that finds its own there goes on
        from the last one, to the same bytes; one that comes to its end removes it.
    code : str
        Stands for the code that runs: what another one left in the folder is not gone on with.

    Returns
    -------
    Crushed
        Where it ended before its last target, column `stopped` of the last state says why.

    Raises
    ------
    SimulationError
        When LAMMPS itself stops, no state was saved, or the loading is one to stresses.
    """
    if variables["control"] != "edge":
        raise SimulationError("grains break on the way to a strain; the loading asks for a stress")
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    # Of a job that was killed: this one makes the same, and nobody else does.
    remove_leavings(folder)
    variables = {
        **variables,
        "step_tolerance": rules.step_tolerance,
        # Every step comes to rest: grains are judged there.
        "step_evaluations": LARGEST_RELAXATION,
        "largest_relaxation": LARGEST_RELAXATION,
    }
    job = Job(
        radii=np.asarray(radii, float),
        targets=[float(target) for target in variables["targets"]],
        seed=int(seed),
        rules=rules,
        law_name=variables["law"],
        stiffness=float(variables["stiffness"]),
        periodic=variables["boundary"] == "periodic",
        variables=dict(variables),
        code=code,
    )
    with ExitStack() as stack:
        work = (
            stack.enter_context(scratch_folder(".compress-", folder))
            if progress is None
            else Path(progress)
        ).resolve()
        links = stack.enter_context(linked(inputs, work))
        kept = Progress(work)
        started = _started(kept, job, positions, edge)
        stopped = run_task(
            crushing_task,
            {"folder": str(work), "inputs": str(links / "inputs")},
            links / "inputs" / "in.compress",
            # No script declares them here.
            {
                **declared_variables(Path(inputs) / "in.compress"),
                **started,
                "data": links / "output" / "packing.data",
                "inputs": links / "inputs",
                "output_folder": links / "output",
                "last_state": len(job.targets) + 1,
            },
            log,
            ranks,
        )
        tables = _tables(work, kept, job, stopped)
        keep(work, folder, keep_dumps)
        if progress is not None:
            shutil.rmtree(work)
    return tables


def _started(kept, job, positions, edge):
    """Write what LAMMPS starts from, the first packing or the last state that was kept."""
    saved = kept.saved() if kept.is_of(job) else None
    if saved is None:
        shutil.rmtree(kept.folder, ignore_errors=True)
        kept.folder.mkdir(parents=True)
        write_data_file(kept.folder / "packing.data", positions, job.radii, edge)
        kept.write_job(job)
        return job.variables
    kept.cut(saved)
    write_data_file(
        kept.folder / "packing.data", saved.position, saved.radius, saved.edge, saved.number
    )
    going_on = {"append": "yes", "evaluations": saved.evaluations}
    return {**job.variables, **saved.settings, **going_on}


def _tables(work, kept, job, stopped):
    """Return the tables of a run from what LAMMPS wrote and what was kept of each state."""
    tables = read_compression(work, job.variables, stopped)
    states = len(tables.path["state"])
    _, grains = kept.table("grains", states)
    accounts, _ = kept.table("account", states)
    _, broken = kept.table("breakages", states)
    if states < 2:
        raise SimulationError(f"no state was reached: {stopped or 'nothing is known of why'}")
    # State 0, the loose packing, has the grains of state 1.
    grains[0], accounts[0] = grains[1], {}
    path = {**tables.path, **_path_columns(accounts, grains, tables.path)}
    counts = [len(part["number"]) for part in grains]
    of_grains = {
        "state": np.repeat(tables.path["state"], counts),
        **{name: np.concatenate([part[key] for part in grains]) for name, key in _GRAINS.items()},
    }
    # Of the loose packing it is not kept; packing.npz has it.
    position = np.concatenate([part["position"] for part in grains])
    position[: counts[0]] = np.nan
    of_grains |= dict(zip(("x_m", "y_m", "z_m"), position.T, strict=True))
    present = [part for part in broken if part]
    of_broken = {
        name: np.concatenate([part[key] for part in present]) if present else np.zeros(0)
        for name, key in _BREAKAGES.items()
    }
    return Crushed(path, tables.contacts, tables.walls, tables.steps, of_grains, of_broken)


def _path_columns(accounts, grains, path):
    """Return what a path has beside that of grains that do not break."""
    names = {
        "breakages": "breakages",
        "rounds": "rounds",
        "rounds_upwards": "rounds_upwards",
        "largest_rise": "largest_rise",
        "dissipated_breakage_J": "breakage",
        "released_by_parents_J": "parents",
        "dissipated_rearrangement_J": "rearrangement",
        "step_excess_J": "step_excess",
        "exchanged_energy_J": "exchanged",
        "growth_work_J": "growth",
        "stopped_kinetic_energy_J": "stopped",
    }
    columns = {
        name: np.array([account.get(key, 0) for account in accounts]) for name, key in names.items()
    }
    columns["dissipated_avalanches_J"] = (
        columns["dissipated_breakage_J"] - columns["released_by_parents_J"]
    )
    mass = [part["radius"] ** 3 for part in grains]
    return {
        "grains": np.array([len(part) for part in mass]),
        "broken_mass_fraction": np.array(
            [each[part["generation"] > 0].sum() / each.sum()
             for each, part in zip(mass, grains, strict=True)]
        ),
        "smallest_radius_m": np.array([part["radius"].min() for part in grains]),
        "largest_radius_m": np.array([part["radius"].max() for part in grains]),
        **columns,
    }  # fmt: skip
