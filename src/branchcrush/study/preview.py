"""What a sample will be, cost and take, before it runs."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from branchcrush.branches.crushing_forms import TESTED_RATIO
from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.breakage.rules import Breakage
from branchcrush.crushing.elastic_fits import FEWEST_STATES
from branchcrush.crushing.paper_form import DEGENERATE, admissibility_problem
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.mixtures import from_radii
from branchcrush.gradings.narrower import narrower_words
from branchcrush.gradings.representativity import realised_gap, representativity
from branchcrush.gradings.size_fits import SizeFit
from branchcrush.loading.memory import expected_memory
from branchcrush.loading.sample import Sample
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.packings.geometry import UNIT_SPHERE
from branchcrush.study.cost import compression_cost
from branchcrush.study.preview_breakage import Breaking, breaking
from branchcrush.study.preview_rods import Carrying, carrying

# The columns of the sizes: smallest, D10 to D90, largest [%].
PERCENTS = (0, 10, 30, 50, 60, 90, 100)
_LARGEST_GRAINS = 10


class Sizes(NamedTuple):
    """Diameters of a grading at `PERCENTS` [m], by mass and by number."""

    by_mass: tuple[float, ...]
    by_number: tuple[float, ...]

    @property
    def coefficients(self) -> tuple[float, float]:
        """Coefficients of uniformity and of curvature, by mass [-]."""
        _, d10, d30, _, d60, *_ = self.by_mass
        return d60 / d10, d30**2 / (d10 * d60)


class Plan(NamedTuple):
    """What a sample will be and cost; all seeds where it says so."""

    sample: Sample
    unit: tuple[str, float]  # that the user gave sizes in: its name, and what it is [m]
    asked: Sizes
    drawn: Sizes  # by the first seed
    ultimate: Sizes | None  # of a single size there is none
    coarse_grains: tuple[float, int]  # in the coarsest 10 % of the mass: expected, and drawn
    largest_grains: tuple[int, float]  # some of the drawn ones, and their share of the mass [-]
    gap: float  # between the drawn and the asked sieve curve, the largest [%]
    first_edge: float  # [m]
    last_edge: float  # [m]
    edge_over_diameter: float  # last edge over D99.9, as warned of [-]
    states: int
    overlap: float  # at the largest stress, over the radius; 0 of strains [-]
    # Of a packing whose grains do not break; what crushing it takes besides is in `breaking`.
    force_evaluations: float
    seconds: float  # of one core, all seeds and refined ones together; nan if no trial was possible
    memory: float  # of one job [bytes]
    fits: Mapping[str, SizeFit]  # curves through a few sizes, by key
    carrying: Carrying | None  # which grains will carry load
    breaking: Breaking | None  # what breakage will make of it; None of grains that do not break
    warnings: list[str]

    @property
    def packings(self) -> int:
        """All packings that are compressed, the refined ones too."""
        return len(self.sample.seeds) + self.sample.refined_seeds


def sample_plan(
    sample: Sample,
    radii: ArrayLike,
    seconds_per_grain: float,
    ultimate: Grading | None,
    *,
    unit: tuple[str, float] = ("m", 1.0),
    size: str = "diameter",
    fits: Mapping[str, SizeFit] | None = None,
    refused: bool = False,
    breakage: Breakage | None = None,
) -> Plan:
    """Return what a sample will be and cost, and what is to be warned of.

    Parameters
    ----------
    sample : Sample
    radii : array_like, shape (N,)
        Of the first seed's grains [m].
    seconds_per_grain : float
        That a force evaluation takes on this machine, nan where it is not known [s].
    ultimate : Grading or None
        From `gradings.curves.ultimate_grading`: what the crushing model crushes the grains to.
    unit : tuple of str and float
        That the user gives sizes in: its name, and what it is [m].
    size : {"diameter", "radius"}
        What the user's sizes are.
    fits : mapping of SizeFit, optional
        Curves through a few sizes [m] that the grading is made of, by key.
    refused : bool
        Whether a run will refuse grains that are too few.
    breakage : Breakage, optional
        How grains break, of a sample that is crushed as well.

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
    >>> plan = sample_plan(sample, [1e-3] * 1000, 1e-7, None)
    >>> plan.force_evaluations, round(plan.seconds, 9), plan.asked.by_mass[3]
    (34200.0, 6.84, 0.002)
    """
    grading, grains = sample.grading, sample.grains
    radii = np.sort(np.asarray(radii, dtype=float))[::-1]
    drawn = from_radii(radii)
    solid = UNIT_SPHERE * grading.moment(3) * grains
    states, overlap, evaluations = compression_cost(sample)
    # A refined seed takes twice the strain steps.
    packings = len(sample.seeds) + 2.0 * sample.refined_seeds
    mass = np.cumsum(radii**3) / np.sum(radii**3)
    standing = representativity(grading, grains, sample.end)
    crushed = None
    if breakage is not None:
        crushed = breaking(sample, breakage, evaluations, seconds_per_grain, unit)
    most = grains if crushed is None else crushed.grains
    return Plan(
        sample=sample,
        unit=unit,
        asked=sizes_of(grading),
        drawn=sizes_of(drawn),
        ultimate=None if ultimate is None else sizes_of(ultimate),
        coarse_grains=(standing.coarse_grains, int(np.searchsorted(mass, 0.1 * (1 - 1e-12))) + 1),
        largest_grains=(
            min(_LARGEST_GRAINS, radii.size),
            float(mass[min(_LARGEST_GRAINS, radii.size) - 1]),
        ),
        gap=realised_gap(grading, radii),
        first_edge=(solid / sample.initial_solid_fraction) ** (1.0 / 3.0),
        last_edge=(solid / sample.end) ** (1.0 / 3.0),
        edge_over_diameter=standing.edge_over_diameter,
        states=states,
        overlap=overlap,
        force_evaluations=evaluations,
        seconds=packings * evaluations * grains * seconds_per_grain,
        memory=expected_memory(most, states, sample.ranks),
        fits=fits or {},
        carrying=carrying(sample),
        breaking=crushed,
        warnings=[
            *_few_grains(sample, standing, (*unit, size), refused),
            *_overlaps(overlap),
            *_no_crushing(sample, ultimate),
            *_few_seeds(sample),
            *(crushed.warnings if crushed else []),
        ],
    )


def sizes_of(grading: Grading) -> Sizes:
    """Return the diameters of a grading at `PERCENTS`, by mass and by number.

    Parameters
    ----------
    grading : Grading

    Returns
    -------
    Sizes
        [m]

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> sizes_of(uniform(1.0, 2.0)).by_number[:2]
    (2.0, 2.2)
    """
    shares = np.array(PERCENTS) / 100.0
    return Sizes(
        *(
            tuple((2.0 * quantile(shares)).round(15).tolist())
            for quantile in (grading.mass_ppf, grading.number_ppf)
        )
    )


def _few_grains(sample, standing, unit, refused):
    """Return whether grains are few for the grading, and what that leads to."""
    if standing.verdict == "accept":
        return []
    narrower = narrower_words(sample.grading, sample.grains, sample.end, *unit)
    if standing.verdict == "refuse" and refused:
        leads = "the run refuses this unless allow_unrepresentative: true"
    else:
        leads = "few coarse grains carry most of the load, so seeds differ and n is less certain"
    return [f"{standing.message}{narrower} -> {leads}"]


def _overlaps(overlap):
    if overlap <= OVERLAP_FLAG:
        return []
    return [
        f"overlaps of about {overlap:.0%} of the radius: the certificate notes them from "
        f"{OVERLAP_FLAG:.0%}, ask for less stress or raise the stiffness -> forces and energies "
        "beyond what a contact law of small overlaps means"
    ]


def _no_crushing(sample, ultimate):
    """Return what keeps the crushing model from having curves, as far as it is known before."""
    warnings, states = [], len(sample.loading.stresses) or sample.loading.states
    # The law is fitted to the states of all packings together.
    states *= len(sample.seeds)
    if states < FEWEST_STATES:
        saved = "one saved state" if states == 1 else f"{states} saved states"
        warnings.append(
            f"{saved} of all packings: an elastic law needs {FEWEST_STATES} that carry load -> no "
            "theta and no curves of the crushing model"
        )
    if ultimate is None:
        return [*warnings, "one size: no ultimate grading -> no crushing model, and n says little"]
    # n is not known yet: the paper's is near enough to tell.
    initial, crushed = (
        random_contact_moment(grading, PAPER_EXPONENT) for grading in (sample.grading, ultimate)
    )
    problem = admissibility_problem(initial, crushed)
    if problem is not None:
        warnings.append(
            f"the paper's form of the crushing model will have no curves at n = "
            f"{PAPER_EXPONENT:g}, since {problem}"
        )
    elif (theta := 1.0 - crushed / initial) > DEGENERATE:
        warnings.append(
            f"theta of the paper's form is {theta:.6g} at n = {PAPER_EXPONENT:g} -> it says only "
            "that complete crushing would release nearly all elastic energy; other forms stand "
            "beside it"
        )
    smallest, largest = sample.grading.support()
    if largest > TESTED_RATIO * (1.0 + 1e-9) * smallest:
        warnings.append(
            f"the largest grains are {largest / smallest:.4g} times the smallest -> beyond "
            f"{TESTED_RATIO:g} no form of the crushing model is tested against simulation"
        )
    return warnings


def _few_seeds(sample):
    warnings = []
    if len(sample.seeds) == 1:
        warnings.append("one seed -> no interval of n")
    if sample.refined_seeds == 0:
        warnings.append("no refined seeds -> the certificate cannot tell whether steps are small")
    return warnings
