"""The way back: how much of the work a packing returns, and what it keeps."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from branchcrush.samples.ensemble import end_of_loading


def unloading_summary(paths: Sequence[pd.DataFrame], jamming: pd.DataFrame) -> dict | None:
    """Return how elastic the way back was, means over the packings.

    Parameters
    ----------
    paths : list of DataFrame
        The `path.csv` of each seed.
    jamming : DataFrame
        `jamming.csv`.

    Returns
    -------
    dict or None
        work_returned_share: work given back over work done; energy_returned_share: over the energy
        that was stored, below 1 by what rearrangements on the way back dissipate;
        stress_lost_share: by how much the stress is lower, over that of the same solid fraction on
        the way in, mean over the states that carry load; residual_solid_fraction: by how much
        phi_J has grown. None without unloading, or when no packing carried load before it.
    """
    rows = []
    for path in paths:
        back = path[path["leg"] == "unloading"]
        if not len(back):
            return None
        end, last = end_of_loading(path), back.iloc[-1]
        if not end["carries_load"]:  # it has nothing to give back
            continue
        loading = path[(path["leg"] == "loading") & path["carries_load"]]
        loaded = back[back["carries_load"]]
        within = loaded[loaded["solid_fraction"] >= loading["solid_fraction"].min()]
        there = np.interp(
            within["solid_fraction"], loading["solid_fraction"], loading["mean_stress_Pa"]
        )
        returned = end["work_J"] - last["work_J"]
        rows.append(
            (
                returned / end["work_J"],
                returned / (end["elastic_energy_J"] - last["elastic_energy_J"]),
                float(np.mean(1.0 - within["mean_stress_Pa"] / there)) if len(within) else np.nan,
            )
        )
    if not rows:
        return None
    work, energy, stress = (float(np.nanmean(column)) for column in zip(*rows, strict=True))
    grown = (
        jamming["jamming_solid_fraction_unloading"] - jamming["jamming_solid_fraction_loading"]
    ).mean()
    return {
        "work_returned_share": work,
        "energy_returned_share": energy,
        "stress_lost_share": stress,
        "residual_solid_fraction": float(grown),
    }
