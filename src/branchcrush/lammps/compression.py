"""The compression of a packing in LAMMPS, from the radii and the loading to its tables."""

import time
from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from branchcrush.errors import SimulationError
from branchcrush.files.scratch import scratch_folder
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.lammps.checkpoint import Checkpoint, run_key
from branchcrush.lammps.compressing import compression_task
from branchcrush.lammps.files import write_data_file
from branchcrush.lammps.neighbours import neighbour_settings
from branchcrush.lammps.output import Compression, read_compression
from branchcrush.lammps.workplace import keep, run_led, workplace
from branchcrush.loading.sample import Sample
from branchcrush.loading.states import force_floor, stress_floor
from branchcrush.loading.targets import (
    INERTIAL_TOLERANCE,
    STATE_TOLERANCES,
    STEP_FORCE_EVALUATIONS,
    STEP_UNBALANCED_FORCE_RATIO,
    Loading,
    loading_targets,
)
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

# Solid fraction of a loaded packing, on which a trial is made; more grains would take longer than
# they tell.
_TRIAL, _MOST_GRAINS = 0.68, 1000


def compression_variables(
    radii: ArrayLike,
    initial_solid_fraction: float,
    *,
    boundary: Literal["walls", "periodic"],
    law: LinearContact | HertzContact,
    loading: Loading,
    strain_step: float,
    state_tolerance: float = STATE_TOLERANCES["fine"],
) -> dict[str, Any]:
    """Return the variables of `in.compress` for a packing and its loading.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    initial_solid_fraction : float
        Of the loose packing [-].
    boundary : {"walls", "periodic"}
    law : LinearContact or HertzContact
    loading : Loading
    strain_step : float
        Largest linear strain of a step [-].
    state_tolerance : float
        Largest unbalanced force ratio of a saved state [-].

    Returns
    -------
    dict
        A value is a list where the variable takes several.

    Raises
    ------
    SimulationError
        When the largest grain is larger than the final cell, or a target stress is one that a
        packing without load may have.

    Examples
    --------
    >>> from branchcrush.loading.targets import Loading
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> loading = Loading("edge_reduction", 0.4, states=2, approach_solid_fraction=0.3)
    >>> variables = compression_variables(
    ...     [1e-3] * 8, 0.16, boundary="walls", law=LinearContact(1e6), loading=loading,
    ...     strain_step=1e-3)
    >>> variables["control"], [round(edge, 6) for edge in variables["targets"]]
    ('edge', [0.00419, 0.003563])
    """
    control, targets = loading_targets(radii, initial_solid_fraction, loading)
    largest, floor = float(np.max(radii)), stress_floor(radii, law)
    if control == "edge" and min(targets) < 2.0 * largest:
        raise SimulationError(
            f"the cell ends at an edge of {min(targets):.4g} m, smaller than the largest grain of "
            f"{2.0 * largest:.4g} m: use more grains or load less"
        )
    if control == "stress" and min(targets) < floor:
        raise SimulationError(
            f"a mean stress of {min(targets):.4g} Pa is below {floor:.4g} Pa, which grains of this "
            "stiffness may have without carrying load: ask for more, or for softer contacts"
        )
    approach_edge = cube_edge(radii, loading.approach_solid_fraction)
    return {
        "boundary": boundary,
        "law": law.name,
        "stiffness": float(law.stiffness),
        "approach_edge": approach_edge,
        "control": control,
        "targets": targets,
        "strain_step": float(strain_step),
        "step_tolerance": STEP_UNBALANCED_FORCE_RATIO[control],
        "step_evaluations": STEP_FORCE_EVALUATIONS,
        "state_tolerance": float(state_tolerance),
        "inertial_tolerance": INERTIAL_TOLERANCE,
        "force_floor": force_floor(radii, law),
        "largest_radius": largest,
        **neighbour_settings(radii, approach_edge),
    }


def compress(
    positions: np.ndarray,
    radii: np.ndarray,
    edge: float,
    variables: Mapping[str, Any],
    *,
    inputs: str | PathLike[str],
    folder: str | PathLike[str],
    log: str | PathLike[str],
    ranks: int = 1,
    keep_dumps: Literal["all", "last", "none"] = "all",
    checkpoint: str | PathLike[str] | None = None,
    code: str = "",
) -> Compression:
    """Compress a packing in LAMMPS and return its loading path and contacts.

    Takes the steps of `in.compress`; its dumps are gzipped into the folder when the run is
    complete. Where it has to stop on the way (a grain escapes, a state does not come to rest, a
    stress is not reached) the states saved so far are returned, and column `stopped` of the last
    says why.

    Parameters
    ----------
    positions : ndarray, shape (N, 3)
        Origin at the centre of the cube [m].
    radii : ndarray, shape (N,)
        [m]
    edge : float
        [m]
    variables : dict
        From `compression_variables`; any other variable of in.compress may be set as well.
    inputs : path-like
        The folder of in.compress.
    folder : path-like
        Where the dumps go.
    log : path-like
        Where LAMMPS logs, a progress line each strain step.
    ranks : int
        MPI processes that share the packing.
    keep_dumps : {"all", "last", "none"}
        Of which states; those of an earlier run in the folder are not kept beside the new tables.
    checkpoint : path-like, optional
        A folder of its own where each saved state is kept. A run that finds its own there goes on
        from the last one, to the same bytes; what another run left there goes. It is not removed:
        that is for whoever has the results safe.
    code : str
        Stands for the code that runs: what another one left in the checkpoint is not gone on with.

    Returns
    -------
    Compression

    Raises
    ------
    SimulationError
        When LAMMPS itself stops, or lists a contact twice.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    key = run_key(np.asarray(positions), np.asarray(radii), edge, variables, ranks, code)
    with workplace(folder, inputs, checkpoint) as (work, links):
        kept = Checkpoint(work, key)
        note = kept.opened()
        if kept.saved() is None:
            write_data_file(work / "packing.data", positions, radii, edge)
        stopped = run_led(compression_task, kept, note, links, variables, log, ranks)
        tables = read_compression(work, variables, stopped)
        keep(work, folder, keep_dumps)
    return tables


class Packing(NamedTuple):
    """Grains placed in a cube about the origin."""

    positions: np.ndarray  # shape (N, 3) [m]
    radii: np.ndarray  # shape (N,) [m]
    edge: float  # of the cube [m]


def placed_packing(sample: Sample, rng: np.random.Generator) -> Packing:
    """Return a loose packing of a sample: radii drawn from its grading, placed at random.

    Parameters
    ----------
    sample : Sample
    rng : numpy.random.Generator
        Draws the radii first, then the places.

    Returns
    -------
    Packing

    Raises
    ------
    PackingError
        As `packings.placement.random_packing`.
    """
    radii = sampled_radii(sample.grading, sample.grains, sample.sampling, rng)
    edge = cube_edge(radii, sample.initial_solid_fraction)
    return Packing(random_packing(radii, edge, periodic=sample.periodic, rng=rng), radii, edge)


def sample_variables(sample: Sample, radii: ArrayLike) -> dict[str, Any]:
    """Return the variables of `in.compress` for a packing of a sample: `compression_variables`.

    Parameters
    ----------
    sample : Sample
    radii : array_like, shape (N,)
        [m]

    Returns
    -------
    dict
    """
    return compression_variables(
        radii,
        sample.initial_solid_fraction,
        boundary=sample.boundary,
        law=sample.law,
        loading=sample.loading,
        strain_step=sample.strain_step,
        state_tolerance=sample.state_tolerance,
    )


def trial(
    sample: Sample,
    rng: np.random.Generator,
    *,
    inputs: str | PathLike[str],
    folder: str | PathLike[str],
    log: str | PathLike[str],
) -> float:
    """Return the time that a force evaluation of a grain takes on this machine, tried out.

    Runs the approach of a packing and one strain step in the range of a loaded packing, of at most
    1000 grains at the quantiles of the grading.

    Parameters
    ----------
    sample : Sample
    rng : numpy.random.Generator
    inputs, folder, log
        As for `compress`.

    Returns
    -------
    float
        [s]
    """
    few = replace(sample, grains=min(sample.grains, _MOST_GRAINS), sampling="number_quantiles")
    packing = placed_packing(few, rng)
    variables = sample_variables(few, packing.radii)
    variables |= {"control": "edge", "targets": [cube_edge(packing.radii, _TRIAL)]}
    variables |= {"strain_step": 1.0, "approach_steps": 20}
    with scratch_folder(".trial-", folder) as scratch:
        start = time.perf_counter()
        result = compress(*packing, variables, inputs=inputs, folder=scratch, log=log)
        seconds = time.perf_counter() - start
    return seconds / result.path["force_evaluations"][-1] / few.grains
