"""Rule verdict: convergence, the way back, and the verdict of a sample with its reasons."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading
from branchcrush.samples.certificate import LIMITS, NOTED
from branchcrush.samples.convergence import (
    compared_packings,
    convergence_table,
    convergence_words,
)
from branchcrush.samples.ensemble import end_of_loading
from branchcrush.samples.notes import (
    convergence_notes,
    grains_notes,
    late_stop_notes,
    loaded_early_notes,
    overlap_notes,
    reading_notes,
)
from branchcrush.samples.seed_branches import state_sums
from branchcrush.samples.unloading import unloading_summary
from branchcrush.statistics.bins import bin_edges
from branchcrush.statistics.power_law import binned_exponent

# A path may end so when its loading is complete: words of lammps_inputs/mod.stress.
_AFTER_LOADING = "comes loose on the way back"
# So many states that fail are named, the others counted.
_MOST_NAMED = 5


class Refined(NamedTuple):
    """The first seeds of a sample, run again with twice the strain steps."""

    states: pd.DataFrame  # `certificate.csv`
    jamming: pd.DataFrame  # `jamming.csv`
    paths: Sequence[pd.DataFrame]  # the `path.csv` of each seed
    # Takes the number of one and a state and returns its `contacts.parquet` in that state, of it at
    # least `samples.seed_branches.ENERGY_COLUMNS`.
    contacts: Callable[[int, int], pd.DataFrame]


def verdict_results(
    grading: Grading,
    states: pd.DataFrame,
    jamming: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    *,
    refined: Refined | None,
    report: dict,
    fit: EnergySplitFit,
    bins: int,
    limits: Mapping[str, float] = LIMITS,
    readings: Sequence[Mapping] = (),
) -> tuple[pd.DataFrame, dict]:
    """Return what twice the strain steps change, and the certificate of the sample.

    Parameters
    ----------
    grading : Grading
        Target.
    states, jamming : DataFrame
        `certificate.csv` and `jamming.csv`.
    paths : list of DataFrame
        The `path.csv` of each seed.
    refined : Refined or None
        None when no seed was run again.
    report : dict
        `grading.json`, for its representativity.
    fit : EnergySplitFit
    bins : int
        Of branch length.
    limits : mapping
        The largest value of each measure that is judged.
    readings : list of mapping
        `reading.json` of each packing that another code made.

    Returns
    -------
    convergence : DataFrame
        From `samples.convergence.convergence_table`.
    certificate : dict
        From `sample_certificate`, with the `unloading` of `samples.unloading.unloading_summary`.
    """
    once = compared_packings(states, paths, jamming)
    twice, exponents = once[:0], []
    if refined is not None:
        twice = compared_packings(refined.states, refined.paths, refined.jamming)
        exponents = _exponents(refined, twice.index, bin_edges(*grading.support(), bins))
    convergence = convergence_table(once, twice, fit.exponent_of_each_seed, exponents)
    certificate = sample_certificate(
        states, paths, jamming, convergence, report, fit, limits=limits, readings=readings
    )
    return convergence, {**certificate, "unloading": unloading_summary(paths, jamming)}


def _exponents(refined, used, edges):
    """Return n of each packing alone, of those that are certified at their end."""
    exponents = []
    for number, seed in enumerate(refined.states["seed"].unique()):
        if seed not in used:
            continue
        end = int(end_of_loading(refined.paths[number])["state"])
        sums = state_sums(refined.contacts(number, end), end, edges)
        try:
            fit, _ = binned_exponent(sums[None], rng=np.random.default_rng(0))
            exponents.append(float(fit.exponent))
        except FitError:
            exponents.append(np.nan)
    return exponents


def sample_certificate(
    states: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    jamming: pd.DataFrame,
    convergence: pd.DataFrame,
    report: dict,
    fit: EnergySplitFit,
    *,
    limits: Mapping[str, float] = LIMITS,
    readings: Sequence[Mapping] = (),
) -> dict:
    """Return the verdict of a sample, with its reasons and the worst of every measure.

    A reason takes the certificate away; a note says what a number is to be read with, and what
    that is likely to change.

    Parameters
    ----------
    states : DataFrame
        From `samples.certificate.state_certificates`.
    paths : list of DataFrame
    jamming : DataFrame
        From `samples.certificate.jamming_points`.
    convergence : DataFrame
        A row for each quantity at the strain steps asked for and at twice as many; empty when
        not asked for.
    report : dict
        `grading.json`, for its representativity.
    fit : EnergySplitFit
    limits, readings
        As for `verdict_results`.

    Returns
    -------
    dict
        verdict: "certified", "certified with notes" or "not certified"; reasons, texts; notes, as
        `samples.notes.Note.result`; limits; worst; `convergence`, and the same in words.
    """
    ends = pd.DataFrame([end_of_loading(path) for path in paths])
    ends["seed"] = states["seed"].unique()
    last = states.merge(ends[["seed", "state"]], on=["seed", "state"])
    stops, late_stops = _stops(ends["seed"], paths)
    changed = _not_converged(convergence)
    reasons = [*stops, *_without_load(last), *_failed(states), *changed, *_wide_interval(fit)]
    notes = [
        *convergence_notes(convergence),
        *late_stop_notes(late_stops),
        *grains_notes(report["representativity"]),
        *overlap_notes(last),
        *loaded_early_notes(jamming),
        *reading_notes(readings),
    ]
    loaded = states[states["carries_load"]]
    return {
        "verdict": _grade(reasons, notes),
        "reasons": reasons,
        "notes": [note.result() for note in notes],
        "seeds": len(paths),
        "seeds_certified": int(last["certified"].sum()),
        "states": len(states),
        "states_loaded": len(loaded),
        "states_certified": int(states["certified"].sum()),
        "limits": {name: limits.get(name) for name in LIMITS},
        "worst": {name: _largest(loaded[name]) for name in LIMITS},
        "dissipated_share_at_end": _mean(last["dissipated_share"]),
        "median_overlap_ratio_at_end": _mean(last["median_overlap_ratio"]),
        "overlap_ratio_95_at_end": _mean(last["overlap_ratio_95"]),
        "rattler_fraction_at_end": _mean(last["rattler_fraction"]),
        "jamming_solid_fraction": _mean(jamming["jamming_solid_fraction_loading"]),
        "jamming_solid_fraction_scatter": _scatter(jamming["jamming_solid_fraction_loading"]),
        "jamming_uncertainty": _mean(jamming["uncertainty_loading"]),
        "jamming_solid_fraction_unloading": _mean(jamming["jamming_solid_fraction_unloading"]),
        "force_evaluations": _mean(pd.Series([p["force_evaluations"].iloc[-1] for p in paths])),
        "convergence": convergence.to_dict("records"),
        "convergence_in_words": convergence_words(convergence),
    }


def _grade(reasons, notes):
    if reasons:
        return "not certified"
    return NOTED if notes else "certified"


def _stops(seeds, paths):
    """Return which seeds stopped on the way, and why: before the end of the loading, and after."""
    stopped = [path["stopped"].iloc[-1] for path in paths]
    stops = [
        f"seed {seed}: {reason}"
        for seed, reason in zip(seeds, stopped, strict=True)
        # An empty cell of a CSV file is read as nan.
        if isinstance(reason, str) and reason
    ]
    late = [stop for stop in stops if _AFTER_LOADING in stop]
    return [stop for stop in stops if _AFTER_LOADING not in stop], late


def _without_load(last):
    unloaded = last[~last["carries_load"]]
    if not len(unloaded):
        return []
    reached = unloaded["solid_fraction"]
    return [
        f"{len(unloaded)} of {len(last)} packings carry no load at the end of their loading, "
        f"solid fraction {reached.min():.4f} to {reached.max():.4f}: load further"
    ]


def _failed(states):
    failed = states[states["verdict"] == "not certified"]
    reasons = [
        f"seed {row.seed}, state {row.state}: {row.reasons}"
        for row in failed.head(_MOST_NAMED).itertuples()
    ]
    more = len(failed) - _MOST_NAMED
    return [*reasons, f"and {more} more states"] if more > 0 else reasons


def _not_converged(table):
    changed = table[table["verdict"] == "not converged"]
    return [f"{words}: raise loading.quality" for words in convergence_words(changed)]


def _wide_interval(fit):
    """Return a reason where the exponent is not told; one seed, or no fit, has no interval."""
    exponent = fit.exponent
    if not exponent.is_wide:
        return []
    # No certificate: the verdict stands beside n, and such an n says nothing.
    return [
        f"too few seeds or branches to tell n: its interval, {exponent.low:.2f} to "
        f"{exponent.high:.2f}, is wider than n itself"
    ]


def _mean(values):
    return float(values.mean()) if values.notna().any() else None


def _scatter(values):
    return float(values.std(ddof=1)) if values.notna().sum() > 1 else None


def _largest(values):
    return float(values.max()) if values.notna().any() else None
