"""What packings cost, by estimates that need no trial, and what their jobs ask a cluster for."""

import math
from dataclasses import replace
from typing import NamedTuple

from branchcrush.breakage.rules import Breakage
from branchcrush.loading.memory import expected_memory, expected_reading_memory
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import expected_overlap_ratio, planned_steps
from branchcrush.study.preview_breakage import breaking

# Force evaluations of a packing of 1000 grains, for each strain step and more for each saved state,
# to strains and to stresses: a stress is sought among packings at rest. A packing may need half or
# twice as many.
_TO_STRAIN, _TO_STRESS = (70.0, 2000.0), (1000.0, 6500.0)
# Grains between which a strain has to travel: evaluations grow about so with their number.
_GROWTH = 1.0 / 3.0
# That a force evaluation of a grain takes at most, neighbour lists and all else included
# (docs/performance.md: 0.26 to 0.47 us), and what two ranks gain at least, where they share a core.
_SECONDS, _GAIN = 0.5e-6, 1.2
# Asked of a cluster over what is expected: packings and nodes differ by twice each. And at least.
_TIMES_SECONDS, _TIMES_MEMORY, _MINUTES, _MEGABYTES = 4.0, 1.5, 2, 100
# Of a job that reads packings: what profiles/slurm gives to all else.
_READING_MINUTES, _READING_MEGABYTES = 60, 4000


class Cost(NamedTuple):
    """What the compression of a packing costs."""

    states: int
    overlap: float  # at the largest stress, over the radius; 0 of strains [-]
    force_evaluations: float


class Request(NamedTuple):
    """What a job asks a cluster for."""

    mem_mb: int  # [MB]
    runtime: int  # [min]


def compression_cost(sample: Sample) -> Cost:
    """Return what it costs to compress a packing of a sample.

    Parameters
    ----------
    sample : Sample

    Returns
    -------
    Cost

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> from branchcrush.loading.targets import Loading
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> sample = Sample(grading=single(1e-3), sampling="random", grains=1000, boundary="walls",
    ...                 initial_solid_fraction=0.16, law=LinearContact(1e6),
    ...                 loading=Loading("edge_reduction", 0.4), strain_step=1.7e-3)
    >>> compression_cost(sample)
    Cost(states=15, overlap=0.0, force_evaluations=34200.0)
    """
    loading, overlap = sample.loading, 0.0
    if loading.stresses:
        radius = float(sample.grading.mass_ppf(0.5))
        overlap = expected_overlap_ratio(loading.stresses[-1], radius, sample.law)
    steps, states = planned_steps(
        loading, sample.initial_solid_fraction, sample.strain_step, overlap
    )
    step, state = _TO_STRESS if loading.stresses else _TO_STRAIN
    evaluations = (step * steps + state * states) * (sample.grains / 1000.0) ** _GROWTH
    return Cost(states, overlap, evaluations)


def packing_request(sample: Sample, breakage: Breakage | None = None, attempt: int = 1) -> Request:
    """Return what the job of one packing asks a cluster for: its compression, or its crushing.

    Parameters
    ----------
    sample : Sample
    breakage : Breakage, optional
        How its grains break, of a packing that is crushed.
    attempt : int
        Of the same job; each asks for as much more as the first.

    Returns
    -------
    Request
        With room: a packing may take twice as long as expected, and a node another twice.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> from branchcrush.loading.targets import Loading
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> sample = Sample(grading=single(1e-3), sampling="random", grains=10_000, boundary="walls",
    ...                 initial_solid_fraction=0.16, law=LinearContact(1e6),
    ...                 loading=Loading("edge_reduction", 0.4), strain_step=1.7e-3)
    >>> packing_request(sample)
    Request(mem_mb=800, runtime=27)
    >>> packing_request(sample, attempt=2)
    Request(mem_mb=1600, runtime=54)
    """
    cost = compression_cost(sample)
    grains, seconds = _at_the_end(sample, breakage, cost)
    seconds *= _TIMES_SECONDS / _GAIN ** math.log2(sample.ranks)
    return Request(
        mem_mb=attempt * _megabytes(expected_memory(grains, cost.states, sample.ranks)),
        runtime=attempt * (_MINUTES + math.ceil(seconds / 60.0)),
    )


def reading_request(
    sample: Sample | None, breakage: Breakage | None = None, attempt: int = 1
) -> Request:
    """Return what a job asks a cluster for that reads the contacts of all packings of a sample.

    Parameters
    ----------
    sample : Sample or None
        None of packings that another code made, whose grains nobody has counted before.
    breakage, attempt
        As for `packing_request`; of crushed packings.

    Returns
    -------
    Request
        At least what the profile of a cluster gives to all else.

    Examples
    --------
    >>> reading_request(None, attempt=2)
    Request(mem_mb=8000, runtime=120)
    """
    megabytes = _READING_MEGABYTES
    if sample is not None:
        cost = compression_cost(sample)
        grains, _ = _at_the_end(sample, breakage, cost)
        need = expected_reading_memory(grains, cost.states, len(sample.seeds))
        megabytes = max(megabytes, _megabytes(need))
    return Request(mem_mb=attempt * megabytes, runtime=attempt * _READING_MINUTES)


def _at_the_end(sample, breakage, cost):
    """Return how many grains a packing has at the end, and what its job takes [s]."""
    if breakage is None:
        return sample.grains, cost.force_evaluations * sample.grains * _SECONDS
    one = replace(sample, seeds=(1,), refined_seeds=0)
    unit = ("m", 1.0)  # of warnings, which nobody reads here
    crushed = breaking(one, breakage, cost.force_evaluations, _SECONDS, unit)
    return crushed.grains, crushed.seconds


def _megabytes(need):
    """Return what is asked for where so many bytes are expected [MB]."""
    return _MEGABYTES * math.ceil(_TIMES_MEMORY * need / (1e6 * _MEGABYTES))
