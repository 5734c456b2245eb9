"""The certificate: is a saved state at rest and its account closed, and may a fit use it?"""

import contextlib

import numpy as np
import pandas as pd

from branchcrush.errors import FitError
from branchcrush.loading.jamming import jamming_point
from branchcrush.loading.targets import STEP_UNBALANCED_FORCE_RATIO
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.samples.ensemble import end_of_loading

# Largest value of each measure in a certified state.
LIMITS = {
    "unbalanced_force_ratio": 1e-6,
    "inertial_number": 1e-4,
    "stress_identity_error": 1e-6,
    "contact_law_error": 1e-9,
    "energy_excess": 1e-4,
    "escaped": 0,
    "lost": 0,
}
_MEANING = {
    "unbalanced_force_ratio": "not at rest: unbalanced force ratio",
    "inertial_number": "moving: inertial number",
    "stress_identity_error": "stress of the branches differs from that of the boundary by",
    "contact_law_error": "forces differ from the contact law by",
    "energy_excess": "more energy stored than work done, by",
    "escaped": "grains outside the cell:",
    "lost": "grains lost:",
}
# A path may end so when its loading is complete: words of lammps_inputs/mod.stress.
_AFTER_LOADING = "comes loose on the way back"
# What twice the strain steps may change before a sample counts as not converged.
_LARGEST_CHANGE = 0.02
_LARGEST_EXPONENT_CHANGE = 0.1


def state_certificates(seeds, paths):
    """Return the measures and the verdict of every saved state of every seed.

    A state is certified when all its measures are within `LIMITS` and it carries load. Flags do
    not take a certificate away.

    Parameters
    ----------
    seeds : list of int
    paths : list of DataFrame
        The `path.csv` of each seed.

    Returns
    -------
    DataFrame
        A row for each seed and state: its measures, `certified`, `verdict` and `reasons`.
    """
    tables = []
    for seed, path in zip(seeds, paths, strict=True):
        loaded = path["carries_load"].to_numpy(dtype=bool)
        boundary = path["boundary_stress_Pa"].where(loaded)
        work = path["work_J"].where(path["work_J"] > 0)
        measures = pd.DataFrame(
            {
                "unbalanced_force_ratio": path["unbalanced_force_ratio"].where(loaded),
                "inertial_number": path["inertial_number"],
                "stress_identity_error": (path["mean_stress_Pa"] / boundary - 1.0).abs(),
                "contact_law_error": path["contact_law_error"],
                "energy_excess": (-path["dissipated_J"] / work).where(loaded).clip(lower=0.0),
                "escaped": path["escaped"],
                "lost": path["lost"],
            }
        )
        verdicts = [
            _verdict(row, carries, overlap)
            for (_, row), carries, overlap in zip(
                measures.iterrows(), loaded, path["overlap_ratio_95"], strict=True
            )
        ]
        described = path[
            ["state", "leg", "solid_fraction", "mean_stress_Pa", "carries_load", "rattler_fraction"]
        ]
        overlaps = path[["median_overlap_ratio", "overlap_ratio_95", "max_overlap_ratio"]]
        share = pd.DataFrame({"dissipated_share": path["dissipated_J"] / work})
        table = pd.concat([described, measures, share, overlaps], axis=1)
        table.insert(0, "seed", seed)
        table[["certified", "verdict", "reasons"]] = verdicts
        tables.append(table)
    return pd.concat(tables, ignore_index=True)


def _verdict(measures, carries_load, overlap):
    reasons = [
        f"{_MEANING[name]} {measures[name]:.3g}, at most {limit:g}"
        for name, limit in LIMITS.items()
        # Without load some measures have no meaning and are not a number; with it all have.
        if measures[name] > limit or (carries_load and np.isnan(measures[name]))
    ]
    if reasons:
        return False, "not certified", "; ".join(reasons)
    if not carries_load:
        return False, "no load", ""
    if overlap > OVERLAP_FLAG:
        return True, "flagged", f"overlap at 95 % of the contacts is {overlap:.0%} of the radius"
    return True, "certified", ""


def jamming_points(seeds, steps, paths, contact_exponent, stress_floor):
    """Return the jamming point of every packing, on the way in and on the way back.

    Steps that went on before they came to rest are left out: their stress is that of motion.

    Parameters
    ----------
    seeds : list of int
    steps, paths : list of DataFrame
        `steps.csv` and `path.csv` of each seed.
    contact_exponent : float
        Of the contact law [-].
    stress_floor : list of float
        The mean stress of each packing that stands for no load [Pa].

    Returns
    -------
    DataFrame
        A row for each seed; nan where too few steps carry load.
    """
    rows = []
    for seed, table, path, floor in zip(seeds, steps, paths, stress_floor, strict=True):
        beyond = (table["solid_fraction"] - end_of_loading(path)["solid_fraction"]).abs()
        # A run that stopped on the approach has no strain step.
        turn = int(np.argmin(beyond)) + 1 if len(table) else 0
        row = {"seed": seed}
        for leg, part in (("loading", table[:turn]), ("unloading", table[turn:])):
            phi, error, states = np.nan, np.nan, 0
            part = part[part["unbalanced_force_ratio"] <= max(STEP_UNBALANCED_FORCE_RATIO.values())]
            loaded = part["mean_stress_Pa"] > floor
            with contextlib.suppress(FitError):
                phi, error, states = jamming_point(
                    part["solid_fraction"], part["mean_stress_Pa"], contact_exponent, loaded
                )
            row |= {
                f"jamming_solid_fraction_{leg}": phi,
                f"uncertainty_{leg}": error,
                f"steps_{leg}": states,
            }
        first = (table["mean_stress_Pa"].iloc[:1] > floor).any()
        rows.append({**row, "loaded_from_the_start": bool(first)})
    return pd.DataFrame(rows)


def sample_certificate(states, paths, jamming, convergence, grading):
    """Return the verdict of a sample, with its reasons and the worst of every measure.

    Parameters
    ----------
    states : DataFrame
        From `state_certificates`.
    paths : list of DataFrame
    jamming : DataFrame
        From `jamming_points`.
    convergence : DataFrame
        A row for each quantity at the strain steps asked for and at twice as many; empty when
        not asked for.
    grading : dict
        `grading.json`, for its representativity.

    Returns
    -------
    dict
        verdict: "certified", "flagged" or "not certified"; reasons; flags; limits; worst.
    """
    ends = pd.DataFrame([end_of_loading(path) for path in paths])
    ends["seed"] = states["seed"].unique()
    last = states.merge(ends[["seed", "state"]], on=["seed", "state"])
    stopped = [path["stopped"].iloc[-1] for path in paths]
    stops = [
        f"seed {seed}: {reason}"
        for seed, reason in zip(ends["seed"], stopped, strict=True)
        # An empty cell of a CSV file is read as nan.
        if isinstance(reason, str) and reason
    ]
    reasons = [stop for stop in stops if _AFTER_LOADING not in stop]
    unloaded = last[~last["carries_load"]]
    if len(unloaded):
        reached = unloaded["solid_fraction"]
        reasons.append(
            f"{len(unloaded)} of {len(last)} packings carry no load at the end of their loading, "
            f"solid fraction {reached.min():.4f} to {reached.max():.4f}: load further"
        )
    failed = states[states["verdict"] == "not certified"]
    reasons += [
        f"seed {row.seed}, state {row.state}: {row.reasons}" for row in failed.head(5).itertuples()
    ]
    if len(failed) > 5:
        reasons.append(f"and {len(failed) - 5} more states")
    changed, flags = _convergence(convergence)
    reasons += changed
    flags += [stop for stop in stops if _AFTER_LOADING in stop]
    flags += grading["representativity"]["warnings"]
    deep = last[last["verdict"] == "flagged"]
    if len(deep):
        flags.append(
            f"overlaps at the end: {last['median_overlap_ratio'].median():.1%} of the smaller "
            f"radius in the median, {last['overlap_ratio_95'].median():.1%} at 95 % of the "
            f"contacts; the contact law is one of small overlaps (flagged from {OVERLAP_FLAG:.0%})"
        )
    if jamming["loaded_from_the_start"].any():
        flags.append(
            "the first strain step already carries load: lower loading.approach_solid_fraction"
        )
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


def _mean(values):
    return float(values.mean()) if values.notna().any() else None


def _scatter(values):
    return float(values.std(ddof=1)) if values.notna().sum() > 1 else None


def _largest(values):
    return float(values.max()) if values.notna().any() else None
