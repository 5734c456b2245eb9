"""Rule crushing_results: the numbers at the end of a crushing, and what they do not say."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from branchcrush.samples.crushed_line import YIELDED, named_mean
from branchcrush.samples.crushed_path import PARTS, TOLD

_AT_END = (
    "solid_fraction",
    "void_ratio",
    "mean_stress_Pa",
    "grains",
    "breakages",
    "broken_mass_fraction",
    "einav_breakage",
    "einav_breakage_down_to_0",
    "crushing_by_contacts",
    "crushing_by_random_contacts",
    "hardin_breakage",
    "energy_over_control",
    "stress_over_control",
)
_WORDS = {
    "stored": "stored",
    "released_by_parents": "released by the grains that broke",
    "avalanches": "lost in the avalanches after them",
    "rearrangement": "lost in rearrangement while straining",
}
_PERCENT = 100.0


def end_of(states: pd.DataFrame, intervals: Mapping[str, Any]) -> dict[str, Any]:
    """Return the means over seeds at the last common state, and differences to two ways of phi_J.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`.
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    dict
        Keys of `crushing.json`.
    """
    whole = states[~states["halved_step"]]
    end = _last_common(whole)
    told: dict[str, Any] = {
        "last_state": int(end["state"].iloc[0]),
        "breakages": int(end["breakages"].sum()),
    }
    for name in _AT_END:
        told |= named_mean(f"final_{name}", end[name].to_list(), intervals)
    loaded = whole[whole["carries_load"].astype(bool)]
    gap = loaded["jamming_by_rods"] - loaded["jamming_by_elastic_strain"]
    yielded = loaded[loaded["broken_mass_fraction"] >= YIELDED]
    return told | {
        "jamming_by_rods_difference": float(gap.mean()),
        "jamming_by_rods_scatter": float(gap.std()),
        "elastic_strain_least": float(yielded["elastic_strain"].min()),
        "elastic_strain_largest": float(yielded["elastic_strain"].max()),
    }


def energy_summary(states: pd.DataFrame, intervals: Mapping[str, Any]) -> dict[str, Any]:
    """Return the shares of the work since the first breakage, with whole and with half steps.

    The steps are compared over the seeds that were crushed with both, at the last state that all
    of these have.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`.
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    dict
        Keys of `crushing.json`.
    """
    whole, half = states[~states["halved_step"]], states[states["halved_step"]]
    end = _last_common(whole)
    told: dict[str, Any] = {}
    for part in TOLD:
        told |= named_mean(f"{part}_share", end[f"{part}_share"].to_list(), intervals)
    driven = end["compaction_work_J_per_m3"] / end["dissipated_J_per_m3"]
    told |= named_mean("compaction_over_dissipated", driven.to_list(), intervals)
    same = {"_same_seeds": whole[whole["seed"].isin(half["seed"])], "_halved": half}
    if len(half):
        shared = set.intersection(*(set(rows["state"]) for rows in same.values()))
    for ending, rows in same.items():
        at = rows[rows["state"] == max(shared)] if len(half) else rows.iloc[:0]
        for part in TOLD:
            told[f"{part}_share{ending}"] = float(at[f"{part}_share"].mean()) if len(at) else None
    return told


def crushing_sentences(summary: Mapping[str, Any], states: pd.DataFrame) -> list[str]:
    """Return what is undefined, not checked, or ended early.

    Parameters
    ----------
    summary : mapping
        `crushing.json` without its sentences.
    states : DataFrame
        `crushing_states.csv`.

    Returns
    -------
    list of str
    """
    said = []
    if summary["breakages"] == 0:
        said.append(
            "No grain broke: there is no breakage, no split of the work, no line; the strength is "
            "above every force of this loading."
        )
    seeds = summary["seeds"]
    if len(seeds) < 2:
        said.append("One seed: no number has an interval.")
    said += _ends(states)
    said.append(split_sentence(summary))
    if summary["states_on_line"] == 0 and summary["breakages"]:
        said.append(
            f"Nowhere {YIELDED:.0%} of the mass is broken: the packings do not yield yet, and "
            "there is no compression line."
        )
    if summary["breakages"] and not np.isfinite(summary["number_exponent"]):
        said.append(
            "The smallest first grain is less than twice the comminution limit: α of the fragments "
            "has no range, and is not told."
        )
    return said


def split_sentence(summary: Mapping[str, Any]) -> str:
    """Return by how much the split of the work changes with half the strain step.

    Parameters
    ----------
    summary : mapping
        `crushing.json`.

    Returns
    -------
    str

    Examples
    --------
    >>> split_sentence({"halved_seeds": []})[:53]
    'The split of the work is not checked: no seed was cru'
    """
    seeds = summary["halved_seeds"]
    if not seeds:
        return (
            "The split of the work is not checked: no seed was crushed again with half the strain "
            "step (refined_seeds). What is lost by the size of the strain step is told beside it; "
            "the sum of all that is lost is the safe number."
        )
    if summary["rearrangement_share_halved"] is None or np.isnan(
        summary["rearrangement_share_halved"]
    ):
        return "The split of the work is not checked: with half the strain step no grain broke."
    changes = [
        f"{_WORDS[part]} {_PERCENT * summary[f'{part}_share_same_seeds']:.0f} and "
        f"{_PERCENT * summary[f'{part}_share_halved']:.0f} %"
        for part in PARTS
    ]
    excess = " and ".join(
        f"{_PERCENT * summary[f'step_excess_share_{which}']:.0f}"
        for which in ("same_seeds", "halved")
    )
    return (
        f"With the strain step and with half of it, {len(seeds)} "
        f"seed{'s' if len(seeds) > 1 else ''} crushed with both: {'; '.join(changes)}; by the "
        f"size of the strain step alone {excess} %."
    )


def _ends(states: pd.DataFrame) -> list[str]:
    """Return which runs ended early, and why."""
    said = []
    for (halved, seed), rows in states.groupby(["halved_step", "seed"]):
        why = rows["stopped"].iloc[-1]
        if isinstance(why, str) and why:
            step = " with half the step" if halved else ""
            said.append(f"Seed {seed}{step} ended early: {why}.")
    return said


def _last_common(whole: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of the last state of the way in that all seeds have."""
    way_in = whole[whole["leg"] == "loading"]
    common: Sequence[set] = [set(rows["state"]) for _, rows in way_in.groupby("seed")]
    return way_in[way_in["state"] == max(set.intersection(*common))]
