"""What breakage will make of a sample, before it runs: how many grains, and at what cost."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.nodes import grading_nodes
from branchcrush.breakage.cascade import broken_down
from branchcrush.breakage.rules import Breakage
from branchcrush.gradings.rods import rod_map
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import planned_steps
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.packings.geometry import UNIT_SPHERE

# Elastic strain of a packing whose grains break, over the overlap of two grains at their strength,
# as a share of the diameter: 1.2 to 1.4 % where these overlap by 2 %, and what the rod map jams
# too densely, in six runs of 200 to 500 grains.
_STRAIN_OVER_OVERLAP = 0.75
# Shares of all grains above the limit that have broken, at which jamming points are found.
_SHARES = np.linspace(0.0, 1.0, 51)
_RODS = 2000
# Of the Sauter diameter, the layer that a wall takes from the packing: 0.11 by the path of 200
# grains that broke, 0.14 by the jamming point of 1000 that did not.
_LAYER = 0.12
# Rounds of breakage in a strain step at most, and force evaluations of each, from fragments that
# touch to rest, by the same runs. A run may need half or twice as many.
_ROUNDS, _ROUND = 2.5, 2600.0
# Beyond the grading by so much, the strength at the reference diameter tells little of the grains'.
_FAR = 10.0


class Breaking(NamedTuple):
    """What breakage will make of a sample."""

    rules: Breakage
    # Diameter [m] and strength [Pa] of the smallest, the median by mass and the largest grain.
    strengths: tuple[tuple[float, float], ...]
    overlap: float  # of two grains of the deepest of these sizes at their strength, over R [-]
    elastic_strain: float  # of a packing whose grains break [-]
    grains: int  # in the end, of one packing
    solid_fraction: float  # in the end; below the target where there may be no more grains [-]
    # Up to which such a grading jams at all, for the target is denser; else None [-].
    densest: float | None
    force_evaluations: float  # of one packing
    seconds: float  # of one core, all seeds and refined ones together; nan if not known
    warnings: list[str]


def breaking(
    sample: Sample,
    rules: Breakage,
    force_evaluations: float,
    seconds_per_grain: float,
    unit: tuple[str, float],
) -> Breaking:
    r"""Return what breakage will make of a sample: an estimate from its grading alone.

    .. math:: \phi_J(q) = \phi\,(1 - \epsilon_e), \qquad \epsilon_e = 0.75\, \delta/d

    q is the share of the grains above the comminution limit that have broken, their fragments
    among them (`breakage.cascade`), phi_J its jamming point by the rod map (each of six walls
    takes a layer of it), and delta the overlap of two grains of the median diameter under the force
    that 37 % of them survive. So as many break as it takes for the packing to have the elastic
    strain that its grains can bear.

    Parameters
    ----------
    sample : Sample
    rules : Breakage
    force_evaluations : float
        Of a packing whose grains do not break.
    seconds_per_grain : float
        As for `study.preview.sample_plan`.
    unit : tuple of str and float
        That the user gives sizes in: its name, and what it is [m].

    Returns
    -------
    Breaking

    Examples
    --------
    >>> from branchcrush.breakage.strength import Strength
    >>> from branchcrush.gradings.forms import uniform
    >>> from branchcrush.loading.targets import Loading
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> sand = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                 size_exponent=1.0)
    >>> sample = Sample(grading=uniform(4e-4, 6e-4), sampling="random", grains=500,
    ...                 boundary="periodic", initial_solid_fraction=0.16, law=LinearContact(1e6),
    ...                 loading=Loading("solid_fraction", 0.745), strain_step=1.7e-3, seeds=(1,))
    >>> found = breaking(sample, Breakage(strength=sand, smallest_diameter=2.5e-4), 4e4, 1e-7,
    ...                  ("mm", 1e-3))
    >>> round(found.grains, -3), round(found.elastic_strain, 3), found.densest
    (11000, 0.015, None)
    """
    ends = sample.grading.support()
    sizes = [2.0 * float(radius) for radius in (ends[0], sample.grading.mass_ppf(0.5), ends[1])]
    strengths = tuple((size, float(rules.strength.of(size, 1.0))) for size in sizes)
    overlaps = [_overlap(sample, size, strength) for size, strength in strengths]
    strain = _STRAIN_OVER_OVERLAP * overlaps[1] / 2.0
    fraction, number = _family(sample, rules, strain)
    number = number * sample.grains
    path, there = _path(sample)
    grains = np.interp(path, fraction, number)
    # As `lammps.crushing`: a round that would make more than there may be is not begun.
    most = float(rules.largest_grains)
    reached = bool(grains[-1] > most)
    last = float(np.interp(most, number, fraction)) if reached else float(path[-1])
    if reached:
        grains = np.append(grains[grains <= most], most)
    densest = float(fraction[-1]) if path[-1] > fraction[-1] and not reached else None
    rounds = np.minimum(np.diff(grains) / (rules.fragments - 1), _ROUNDS)
    # As many evaluations of the loading without breakage in each step as in any other; on the way
    # back nothing breaks.
    cost = force_evaluations * there / (path.size - 1) + _ROUND * rounds
    back = 0.0 if reached else force_evaluations * (1.0 - there)
    of_grains = float(cost @ grains[1:]) + back * float(grains[-1])
    packings = len(sample.seeds) + 2.0 * sample.refined_seeds
    return Breaking(
        rules=rules,
        strengths=strengths,
        overlap=max(overlaps),
        elastic_strain=strain,
        grains=round(float(grains[-1])),
        solid_fraction=last,
        densest=densest,
        force_evaluations=float(cost.sum()) + back,
        seconds=packings * of_grains * seconds_per_grain,
        warnings=[
            *_far(strengths, rules, unit),
            *_deep(max(overlaps)),
            *_unbroken(float(grains[-1]), sample.grains),
            *_ends(rules, reached, last, path[-1], densest),
            *_no_way_back(sample, rules, reached),
        ],
    )


def three_digits(number: float) -> str:
    """Return a number to three digits, without a power of ten where it is none of many zeros.

    Parameters
    ----------
    number : float

    Returns
    -------
    str

    Examples
    --------
    >>> three_digits(1234.5), three_digits(0.06651)
    ('1230', '0.0665')
    """
    return f"{float(f'{number:.3g}'):g}"


def _overlap(sample: Sample, diameter: float, strength: float) -> float:
    """Return how deep two grains of a diameter overlap at their strength, over the radius [-]."""
    radius, law = diameter / 2.0, sample.law
    at_one_radius = law.force(radius, radius / 2.0)
    return float((strength * diameter**2 / at_one_radius) ** (1.0 / law.exponent))


def _family(sample: Sample, rules: Breakage, strain: float) -> tuple[NDArray, NDArray]:
    """Return the solid fractions that gradings lead to, rising, and their grains over the first."""
    radius, share = grading_nodes(sample.grading)
    solid = UNIT_SPHERE * sample.grading.moment(3) * sample.grains
    fraction, number = [], []
    for broken in _SHARES:
        diameter, count = broken_down(
            2.0 * radius, share, broken, rules.smallest_diameter, rules.fragments
        )
        jammed = rod_map(diameter, count, rods=_RODS).solid_fraction
        if not sample.periodic:
            sauter = (count @ diameter**3) / (count @ diameter**2)
            jammed *= 1.0 - 6.0 * _LAYER * sauter / np.cbrt(solid / jammed)
        # Half of the packing pressed away is far beyond any target.
        fraction.append(jammed / (1.0 - min(strain, 0.5)))
        number.append(count.sum())
        # Beyond the densest more breakage makes them looser, and no packing goes there.
        if len(fraction) > 1 and fraction[-1] < fraction[-2]:
            return np.array(fraction[:-1]), np.array(number[:-1])
    return np.array(fraction), np.array(number)


def _path(sample: Sample) -> tuple[NDArray, float]:
    """Return the solid fractions of strain steps to the target, and their share of all steps."""
    first, step = sample.initial_solid_fraction, sample.strain_step
    steps, _ = planned_steps(replace(sample.loading, unloading=False), first, step)
    both, _ = planned_steps(sample.loading, first, step)
    return np.geomspace(sample.loading.approach_solid_fraction, sample.end, steps + 1), steps / both


def _far(strengths, rules, unit):
    """Return whether the strength is given of grains that are far from all there are."""
    name, metres = unit
    reference = rules.strength.reference_diameter
    (smallest, _), _, (largest, _) = strengths
    if smallest / _FAR <= reference <= largest * _FAR:
        return []
    told, first, last = (three_digits(size / metres) for size in (reference, smallest, largest))
    return [
        f"breakage.reference_diameter {told} {name} is far from all grains, {first} to {last} "
        f"{name}: check it and its unit -> their strengths rest on size_exponent "
        f"{rules.strength.size_exponent:g} alone"
    ]


def _deep(overlap):
    if overlap <= OVERLAP_FLAG:
        return []
    return [
        f"grains that reach their strength overlap by up to {overlap:.0%} of the radius, more than "
        f"{OVERLAP_FLAG:.0%}: raise the stiffness of contact or lower breakage.strength -> forces "
        "beyond what a contact law of small overlaps means"
    ]


def _unbroken(grains, first):
    if grains > first + 0.5:
        return []
    return [
        "hardly a grain will break: the loading ends before grains reach their strength -> load "
        "further or lower breakage.strength"
    ]


def _ends(rules, reached, last, end, densest):
    """Return whether the run will have all the grains that it may before its target."""
    if reached:
        return [
            f"largest_grains {rules.largest_grains} are reached at a solid fraction of about "
            f"{last:.3f}, before the target {end:.3f} -> the run ends there, validly; raise it, or "
            "smallest_diameter, or load less"
        ]
    if densest is not None:
        return [
            f"the target {end:.3f} is denser than any grading that this estimate knows, "
            f"{densest:.3f} at most -> there may be many more grains, up to largest_grains "
            f"{rules.largest_grains}, where the run ends validly"
        ]
    return []


def _no_way_back(sample, rules, reached):
    if not sample.loading.unloading or not (reached or rules.largest_mean_stress):
        return []
    key = "largest_grains" if reached else "largest_mean_stress"
    return [f"a run that breakage.{key} ends does not go back -> no unloading of it"]
