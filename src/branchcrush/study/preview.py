"""What a study will be, cost and take, before it runs."""

from collections.abc import Mapping
from typing import NamedTuple

from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.model import admissibility_problem
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.gradings.curves import grading_summary
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.representativity import representativity
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import expected_overlap_ratio, planned_steps
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.packings.geometry import UNIT_SPHERE

# Force evaluations of a packing of 1000 grains, for each strain step and more for each saved state,
# to strains and to stresses: a stress is sought among packings at rest. A packing may need half or
# twice as many.
_TO_STRAIN, _TO_STRESS = (70.0, 2000.0), (1000.0, 6500.0)
# Grains between which a strain has to travel: evaluations grow about so with their number.
_GROWTH = 1.0 / 3.0
# Interpreter, libraries and LAMMPS [bytes], and a contact in all tables of all states.
_BASE, _CONTACT, _CONTACTS_PER_GRAIN = 350e6, 300.0, 3.0


class Plan(NamedTuple):
    """What a sample will be and cost; all seeds where it says so."""

    grains: int
    seeds: int
    ranks: int
    first_edge: float  # [m]
    last_edge: float  # [m]
    smallest_diameter: float  # [m]
    largest_diameter: float  # [m]
    force_evaluations: float  # of one packing
    seconds: float  # of one core, all seeds and refined ones together
    memory: float  # of one job [bytes]
    warnings: list[str]


def sample_plan(sample: Sample, seconds_per_grain: float, ultimate: Grading | None) -> Plan:
    """Return what a sample will be and cost, and what is to be warned of.

    Parameters
    ----------
    sample : Sample
    seconds_per_grain : float
        That a force evaluation takes on this machine [s].
    ultimate : Grading or None
        From `gradings.curves.ultimate_grading`: what the crushing model crushes the grains to.

    Returns
    -------
    Plan

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> from branchcrush.loading.targets import Loading
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> sample = Sample(grading=single(1e-3), sampling="random", grains=1000, boundary="walls",
    ...                 initial_solid_fraction=0.16, law=LinearContact(1e6), seeds=(1, 2),
    ...                 loading=Loading("edge_reduction", 0.4), strain_step=1.7e-3)
    >>> plan = sample_plan(sample, 1e-7, None)
    >>> plan.force_evaluations, round(plan.seconds, 9), plan.warnings
    (34200.0, 6.84, [])
    """
    grading, loading, grains = sample.grading, sample.loading, sample.grains
    solid = UNIT_SPHERE * grading.moment(3) * grains
    overlap = _overlap_ratio(sample)
    steps, states = planned_steps(
        loading, sample.initial_solid_fraction, sample.strain_step, overlap
    )
    step, state = _TO_STRESS if loading.stresses else _TO_STRAIN
    evaluations = (step * steps + state * states) * (grains / 1000.0) ** _GROWTH
    # A refined seed takes twice the strain steps.
    refined = min(sample.refined_seeds, len(sample.seeds))
    packings = len(sample.seeds) + 2.0 * refined
    summary = grading_summary(grading)
    return Plan(
        grains=grains,
        seeds=len(sample.seeds),
        ranks=sample.ranks,
        first_edge=(solid / sample.initial_solid_fraction) ** (1.0 / 3.0),
        last_edge=(solid / sample.end) ** (1.0 / 3.0),
        smallest_diameter=summary["D_min_m"],
        largest_diameter=summary["D_max_m"],
        force_evaluations=evaluations,
        seconds=packings * evaluations * grains * seconds_per_grain,
        memory=_BASE * sample.ranks + _CONTACT * _CONTACTS_PER_GRAIN * grains * (states + 2),
        warnings=_warnings(sample, overlap, ultimate),
    )


def _overlap_ratio(sample: Sample) -> float:
    """Return about how deep grains are pressed together at the end; 0 of strains [-]."""
    stresses = sample.loading.stresses
    if not stresses:
        return 0.0
    radius = float(sample.grading.mass_ppf(0.5))
    return expected_overlap_ratio(stresses[-1], radius, sample.law)


def _warnings(sample: Sample, overlap: float, ultimate: Grading | None) -> list[str]:
    warnings = []
    standing = representativity(sample.grading, sample.grains, sample.end)
    if standing.verdict != "accept":
        warnings.append(standing.message)
    if overlap > OVERLAP_FLAG:
        warnings.append(
            f"overlaps of about {overlap:.0%} of the radius: the certificate flags them from "
            f"{OVERLAP_FLAG:.0%}; ask for less stress or raise the stiffness"
        )
    if ultimate is not None:
        initial, crushed = (
            random_contact_moment(grading, PAPER_EXPONENT) for grading in (sample.grading, ultimate)
        )
        problem = admissibility_problem(initial, crushed)
        if problem is not None:
            # n is not known yet: the paper's is near enough to tell.
            warnings.append(
                f"the crushing model will have no curves at the paper's n = {PAPER_EXPONENT:g}, "
                f"since {problem}"
            )
    return warnings


def preview_text(plans: Mapping[str, Plan], cores: int, time_step: str) -> str:
    """Return the plans of all samples as text for a person.

    Parameters
    ----------
    plans : dict of Plan
        By sample.
    cores : int
        That will be used.
    time_step : str
        Of in.compress, over its time scale.

    Returns
    -------
    str
    """
    lines, longest = [], 0.0
    for name, plan in plans.items():
        # Ranks of a packing keep as many cores busy, as many packings at a time as fit.
        ranks = min(plan.ranks, cores)
        minutes = plan.seconds / 60.0 / min(cores // ranks * ranks, plan.seeds * ranks)
        if plan.ranks > cores:
            warning = f"ranks {plan.ranks}, and {cores} core(s): {cores} are started"
            plan = plan._replace(warnings=[*plan.warnings, warning])
        longest = max(longest, minutes)
        lines += [
            f"{name}",
            f"  grains              {plan.grains}, seeds {plan.seeds}",
            f"  diameters           {plan.smallest_diameter:.4g} to {plan.largest_diameter:.4g} m",
            f"  edge of the box     {plan.first_edge:.4g} m, at the end about "
            f"{plan.last_edge:.4g} m ({plan.last_edge / plan.largest_diameter:.3g} diameters)",
            f"  time step           {time_step} sqrt(m/k), of fictitious masses: not set by the "
            "smallest grain",
            f"  force evaluations   about {plan.force_evaluations:,.0f} a packing".replace(
                ",", " "
            ),
            f"  time                about {minutes:.1f} minutes on {cores} core(s) of this "
            "machine, half or twice as long",
            f"  memory              about {plan.memory / 1e9:.1f} GB a job",
            *(f"  warning             {warning}" for warning in plan.warnings),
            "",
        ]
    total = max(longest, sum(plan.seconds for plan in plans.values()) / 60.0 / cores)
    lines.append(f"all samples: about {total:.1f} minutes on {cores} core(s)")
    return "\n".join(lines) + "\n"
