"""Rule verdict: convergence, the way back, and the verdict of a sample with its reasons."""

from collections.abc import Callable, Sequence

import pandas as pd

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.samples.certificate import LIMITS
from branchcrush.samples.convergence import convergence_table
from branchcrush.samples.ensemble import end_of_loading
from branchcrush.samples.seed_branches import state_sums
from branchcrush.samples.unloading import unloading_summary
from branchcrush.statistics.bins import bin_edges

# A path may end so when its loading is complete: words of lammps_inputs/mod.stress.
_AFTER_LOADING = "comes loose on the way back"
# What twice the strain steps may change before a sample counts as not converged.
_LARGEST_CHANGE = 0.02
_LARGEST_EXPONENT_CHANGE = 0.1
# So many states that fail are named, the others counted.
_MOST_NAMED = 5


Run = tuple[Sequence[pd.DataFrame], Callable[[int, int], pd.DataFrame]]


def verdict_results(
    grading: Grading,
    states: pd.DataFrame,
    jamming: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    *,
    refined_states: Sequence[pd.DataFrame],
    once: Run,
    twice: Run,
    report: dict,
    fit: EnergySplitFit,
    bins: int,
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
    refined_states : list of DataFrame
        The `certificate.csv` of the seeds run again with twice the strain steps, if there are any.
    once, twice : tuple
        Of these seeds in both runs: the list of their `path.csv`, and what takes the number of one
        and a state and returns its `contacts.parquet` in that state, of it at least
        `samples.seed_branches.ENERGY_COLUMNS`.
    report : dict
        `grading.json`, for its representativity.
    fit : EnergySplitFit
    bins : int
        Of branch length.

    Returns
    -------
    convergence : DataFrame
        From `samples.convergence.convergence_table`.
    certificate : dict
        From `sample_certificate`, with the `unloading` of `samples.unloading.unloading_summary`.
    """
    edges = bin_edges(*grading.support(), bins)
    runs = []
    for run_paths, read_seed in (once, twice):
        ends = [int(end_of_loading(path)["state"]) for path in run_paths]
        sums = [state_sums(read_seed(number, end), end, edges) for number, end in enumerate(ends)]
        runs.append((run_paths, sums))
    certificates = [states, *refined_states] if refined_states else []
    convergence = convergence_table(certificates, *runs)
    certificate = sample_certificate(states, paths, jamming, convergence, report, fit)
    return convergence, {**certificate, "unloading": unloading_summary(paths, jamming)}


def sample_certificate(
    states: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    jamming: pd.DataFrame,
    convergence: pd.DataFrame,
    report: dict,
    fit: EnergySplitFit,
) -> dict:
    """Return the verdict of a sample, with its reasons and the worst of every measure.

    A reason takes the certificate away, a flag does not.

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

    Returns
    -------
    dict
        verdict: "certified", "flagged" or "not certified"; reasons; flags; limits; worst.
    """
    ends = pd.DataFrame([end_of_loading(path) for path in paths])
    ends["seed"] = states["seed"].unique()
    last = states.merge(ends[["seed", "state"]], on=["seed", "state"])
    stops, late_stops = _stops(ends["seed"], paths)
    changed, undecided = _convergence(convergence)
    reasons = [*stops, *_without_load(last), *_failed(states), *changed, *_wide_interval(fit)]
    flags = [
        *undecided,
        *late_stops,
        *report["representativity"]["warnings"],
        *_deep_overlaps(last),
        *_loaded_early(jamming),
    ]
    loaded = states[states["carries_load"]]
    return {
        "verdict": "not certified" if reasons else "flagged" if flags else "certified",
        "reasons": reasons,
        "flags": flags,
        "seeds": len(paths),
        "seeds_certified": int(last["certified"].sum()),
        "states": len(states),
        "states_loaded": len(loaded),
        "states_certified": int(states["certified"].sum()),
        "limits": LIMITS,
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
    }


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


def _convergence(table):
    """Return what changes too much with twice the strain steps, and what is to be said of it."""
    if not len(table):
        return [], [
            "convergence not checked: no seed was run again with twice the strain steps and "
            "certified in both runs"
        ]
    from scipy.special import stdtrit  # slow to import, and few jobs need it

    reasons, flags = [], []
    for row in table[table["quantity"] != "force_evaluations"].itertuples():
        allowed = (
            _LARGEST_EXPONENT_CHANGE
            if row.quantity == "exponent"
            else _LARGEST_CHANGE * abs(row.value)
        )
        if not abs(row.difference) > allowed:  # nor where there is no number to compare
            continue
        changes = (
            f"{row.quantity} changes from {row.value:.4g} to {row.value_at_twice_the_steps:.4g} "
            "with twice the strain steps"
        )
        # Within the 95 % interval of the pairs, a difference may be chance: too few to tell.
        noise = stdtrit(row.seeds - 1, 0.975) * row.standard_error_of_difference
        if abs(row.difference) <= noise:
            flags.append(
                f"convergence not decided: {changes}, within ±{noise:.2g} of {row.seeds} pairs "
                "of one seed: raise refined_seeds"
            )
        else:
            reasons.append(f"not converged: {changes}: raise loading.quality")
    return reasons, flags


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


def _deep_overlaps(last):
    if not (last["verdict"] == "flagged").any():
        return []
    return [
        f"overlaps at the end: {last['median_overlap_ratio'].median():.1%} of the smaller "
        f"radius in the median, {last['overlap_ratio_95'].median():.1%} at 95 % of the "
        f"contacts; the contact law is one of small overlaps (flagged from {OVERLAP_FLAG:.0%})"
    ]


def _loaded_early(jamming):
    if not jamming["loaded_from_the_start"].any():
        return []
    return ["the first strain step already carries load: lower loading.approach_solid_fraction"]


def _mean(values):
    return float(values.mean()) if values.notna().any() else None


def _scatter(values):
    return float(values.std(ddof=1)) if values.notna().sum() > 1 else None


def _largest(values):
    return float(values.max()) if values.notna().any() else None
