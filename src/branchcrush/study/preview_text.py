"""The preview of a study as text for a person: a block of lines for each sample, and the time."""

import math
import textwrap
from collections.abc import Mapping, Sequence

from branchcrush.loading.memory import at_a_time, memory_words
from branchcrush.study.preview import PERCENTS, Plan
from branchcrush.study.preview_breakage_words import grains_words, strength_words
from branchcrush.study.preview_rods import carrying_words

# Of this machine, measured on two cores [s]: Snakemake's own start, the imports of each job, and
# the figures of a sample.
START, JOB, FIGURES = 3.0, 1.2, 7.0
# Jobs of a sample besides its packings: grading, certificate, branch_lengths, energy_split,
# sharing, thermodynamics, verdict, fit_figures, packing_figures; one more of refined packings.
_JOBS = 9
# Jobs of all samples together: comparison, findings and the two pages.
_JOBS_OF_ALL = 4
_WIDTH, _LABEL = 96, 15
_HEADS = ["min", *(f"D{percent}" for percent in PERCENTS[1:-1]), "max"]


def preview_text(
    plans: Mapping[str, Plan],
    cores: int,
    pictures: Mapping[str, str],
    notes: Mapping[str, str],
    memory: tuple[float, float] | None = None,
) -> str:
    """Return the plans of all samples as text for a person.

    Parameters
    ----------
    plans : dict of Plan
        By sample.
    cores : int
        That will be used.
    pictures : dict of str
        The file with the picture of each sample.
    notes : dict of str
        Why the time of a sample is not known, where it is not.
    memory : tuple of float, optional
        What the machine has, and what is free of it, where that is known [bytes].

    Returns
    -------
    str
    """
    lines, longest, total = [], 0.0, 0.0
    for name, plan in plans.items():
        crushing = 0.0 if plan.breaking is None else plan.breaking.seconds
        lines += [
            f"{name}: {plan.sample.grains} grains, {_packings(plan)}, "
            f"{'periodic cell' if plan.sample.periodic else 'six rigid walls'}",
            *_sizes(plan),
            *_line("coarse grains", _coarse(plan)),
            *(line for fit in _fits(plan) for line in _line("curve", fit)),
            *_line("load", carrying_words(plan.carrying, *plan.unit)),
            *_line("box", _box(plan)),
            *_line("loading", _loading(plan)),
            *_breakage(plan),
            *(line for text in _times(plan, cores, notes.get(name)) for line in _line(*text)),
            *_line("memory", f"about {plan.memory / 1e9:.1f} GB a job"),
            *_line("picture", pictures[name]),
            *(line for text in _warnings(plan, cores, memory) for line in _line("warning", text)),
            "",
        ]
        longest = max(longest, on_cores(plan, plan.seconds + crushing, cores))
        total += plan.seconds + crushing + fixed_seconds(plan)
    # A sample of few packings may leave cores idle, and be the last to end.
    whole = START + _JOBS_OF_ALL * JOB + max(longest, total / cores)
    about = "not known" if math.isnan(total) else f"about {duration(whole)}, half or twice as long"
    lines.append(f"all samples together: {about}, on {cores} core{'s' * (cores != 1)}")
    return "\n".join(lines) + "\n"


def on_cores(plan: Plan, seconds: float, cores: int) -> float:
    """Return how long the packings of a sample take, if they have the machine to themselves.

    Parameters
    ----------
    plan : Plan
    seconds : float
        That all of them take on one core [s].
    cores : int

    Returns
    -------
    float
        [s]
    """
    # Ranks of a packing keep as many cores busy, as many packings at a time as fit.
    ranks = min(plan.sample.ranks, cores)
    return seconds / min(cores // ranks * ranks, len(plan.sample.seeds) * ranks)


def fixed_seconds(plan: Plan) -> float:
    """Return what a sample takes besides LAMMPS: the imports of its jobs, and its figures.

    Parameters
    ----------
    plan : Plan

    Returns
    -------
    float
        On one core [s].
    """
    # Each packing is compressed, and crushed where its grains break.
    runs = plan.packings * (1 if plan.breaking is None else 2)
    return JOB * (runs + _JOBS + (plan.sample.refined_seeds > 0)) + FIGURES


def duration(seconds: float) -> str:
    """Return a time in the unit that a person would take.

    Parameters
    ----------
    seconds : float

    Returns
    -------
    str

    Examples
    --------
    >>> duration(31.4), duration(250.0), duration(20_000.0)
    ('31 s', '4 min', '5.6 h')
    """
    if seconds < 99.5:
        return f"{seconds:.0f} s" if seconds >= 1.0 else "less than 1 s"
    if seconds < 99.5 * 60.0:
        return f"{seconds / 60.0:.0f} min"
    return f"{seconds / 3600.0:.1f} h"


def _line(label: str, text: str) -> list[str]:
    """Return a text behind its label, over as many lines as it takes."""
    indent = " " * (_LABEL + 2)
    return textwrap.wrap(
        text,
        _WIDTH,
        initial_indent=f"  {label:{_LABEL}}",
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _packings(plan: Plan) -> str:
    seeds = len(plan.sample.seeds)
    refined = plan.sample.refined_seeds
    again = f", {refined} of them again with twice the strain steps" if refined else ""
    return f"{seeds} packing{'s' * (seeds != 1)}{again}"


def _sizes(plan: Plan) -> list[str]:
    """Return the table of diameters, in the unit that the user gave."""
    unit, metres = plan.unit
    rows = [("by mass", plan.asked.by_mass), ("  drawn", plan.drawn.by_mass)]
    rows += [("  ultimate", plan.ultimate.by_mass)] if plan.ultimate else []
    rows += [("by number", plan.asked.by_number), ("  drawn", plan.drawn.by_number)]
    rows += [("  ultimate", plan.ultimate.by_number)] if plan.ultimate else []
    head = f"  {f'diameters [{unit}]':{_LABEL}}" + "".join(f"{name:>9}" for name in _HEADS)
    lines = [head]
    for label, sizes in rows:
        cells = "".join(f"{_number(size / metres):>9}" for size in sizes)
        lines.append(f"  {label:{_LABEL}}{cells}")
    coefficients = {"": plan.asked, "drawn ": plan.drawn, "ultimate ": plan.ultimate}
    words = "; ".join(
        f"{label}{', '.join(_number(value) for value in sizes.coefficients)}"
        for label, sizes in coefficients.items()
        if sizes is not None
    )
    return [*lines, *_line("C_u, C_c", words)]


def _number(value: float) -> str:
    """Return a number to three digits, without a power of ten where it is none of many zeros."""
    shown = f"{value:.3g}"
    return f"{float(shown):.0f}" if "e+" in shown and value < 1e6 else shown


def _coarse(plan: Plan) -> str:
    expected, drawn = plan.coarse_grains
    number, share = plan.largest_grains
    apart = (
        f"are at most {plan.gap:.2g} % apart"
        if plan.gap > 0.01
        else "coincide to a hundredth of a %"
    )
    return (
        f"{expected:.3g} expected in the coarsest 10 % of the mass, {drawn} drawn; the {number} "
        f"largest drawn have {100.0 * share:.3g} % of the mass; drawn and asked sieve curve {apart}"
    )


def _fits(plan: Plan) -> list[str]:
    """Return each curve through a few sizes, with what it misses."""
    parts = {key: "" if key == "grading" else f"{key}: " for key in plan.fits}
    return [f"{parts[key]}{fit.words(*plan.unit)}" for key, fit in plan.fits.items()]


def _box(plan: Plan) -> str:
    unit, metres = plan.unit
    return (
        f"edge {_number(plan.first_edge / metres)} {unit}, at the end about "
        f"{_number(plan.last_edge / metres)} {unit}, "
        f"{plan.edge_over_diameter:.3g} largest diameters (D99.9)"
    )


def _loading(plan: Plan) -> str:
    sample, loading = plan.sample, plan.sample.loading
    stresses = loading.stresses
    back = ", and back through the same" if loading.unloading else ""
    if not stresses:
        return (
            f"{loading.target} {loading.value:g}, solid fraction "
            f"{sample.initial_solid_fraction:g} to {sample.end:.3f}; {_states(loading.states)} "
            f"from {loading.approach_solid_fraction:g} on{back}"
        )
    return (
        f"{_states(len(stresses))} at mean stress {_stresses(stresses)}{back}; overlaps at the "
        f"last about {100.0 * plan.overlap:.2g} % of the radius"
    )


def _states(number: int) -> str:
    return f"{number} saved state{'s' * (number != 1)}"


def _stresses(stresses: Sequence[float]) -> str:
    """Return stresses in a unit that suits the largest."""
    scale, unit = next(
        (scale, unit)
        for scale, unit in ((1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa"))
        if stresses[-1] >= scale or scale == 1.0
    )
    shown = [_number(stress / scale) for stress in stresses]
    if len(shown) > 4:
        shown = [f"{shown[0]} to {shown[-1]}"]
    return f"{', '.join(shown)} {unit}"


def _breakage(plan: Plan) -> list[str]:
    """Return how strong grains are and how many there will be, of a sample whose grains break."""
    if plan.breaking is None:
        return []
    return [
        *_line("breakage", strength_words(plan.breaking, *plan.unit)),
        *_line("grains", grains_words(plan.breaking, periodic=plan.sample.periodic)),
    ]


def _times(plan: Plan, cores: int, note: str | None) -> list[tuple[str, str]]:
    """Return how long the loading takes, and crushing besides, each behind its label."""
    if note is not None:
        return [("time", f"not known, since no trial could be made: {note}")]
    fixed = fixed_seconds(plan) - FIGURES
    times = [
        (
            "time",
            f"compression {_lasting(plan, plan.seconds, cores, plan.force_evaluations)}; to start "
            f"jobs {duration(fixed / cores)}, figures {duration(FIGURES)}",
        )
    ]
    if (found := plan.breaking) is not None:
        lasting = _lasting(plan, found.seconds, cores, found.force_evaluations)
        basis = "by the number of grains above, and what a round of breakage took in a few runs"
        times.append(("", f"crushing {lasting}: an estimate {basis}"))
    return times


def _lasting(plan: Plan, seconds: float, cores: int, evaluations: float) -> str:
    """Return how long all packings of a sample take in one kind of run."""
    told = f"{evaluations:,.0f}".replace(",", " ")
    return (
        f"about {duration(on_cores(plan, seconds, cores))} on {cores} core{'s' * (cores != 1)}, "
        f"half or twice as long ({told} force evaluations a packing)"
    )


def _warnings(plan: Plan, cores: int, memory: tuple[float, float] | None) -> list[str]:
    ranks, warnings = plan.sample.ranks, list(plan.warnings)
    if ranks > cores:
        warnings.append(f"ranks {ranks}, and {cores} core(s) -> {cores} are started")
    if memory is not None:
        jobs, used = at_a_time(len(plan.sample.seeds), ranks, cores)
        words = memory_words(plan.memory, jobs, used, *memory)
        warnings += [f"{words} -> jobs may be killed for want of memory"] if words else []
    return warnings
