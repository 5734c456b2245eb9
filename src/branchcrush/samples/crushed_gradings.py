"""Rule crushing_results: gradings at stages of crushing, means over seeds, beside the limit."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from branchcrush.gradings.mixtures import from_radii
from branchcrush.samples.crushed_line import mean_interval
from branchcrush.samples.crushed_sizes import Crushable

_STAGES, _SIZES = 5, 120


def stages_of(states: pd.DataFrame) -> list[int]:
    """Return up to 5 states that all seeds have, from before the first breakage to the last one.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`.

    Returns
    -------
    list of int
        Even in solid fraction, as near as there are states.

    Examples
    --------
    >>> rows = {"seed": 1, "halved_step": False, "leg": "loading", "state": [1, 2, 3],
    ...         "breakages": [0, 1, 5], "solid_fraction": [0.64, 0.65, 0.70]}
    >>> stages_of(pd.DataFrame(rows))
    [1, 2, 3]
    """
    way_in = states[~states["halved_step"] & (states["leg"] == "loading")]
    everywhere = way_in.groupby("state")["seed"].nunique() == way_in["seed"].nunique()
    common = way_in[way_in["state"].isin(everywhere.index[everywhere])]
    density = common.groupby("state")["solid_fraction"].mean()
    broken = common.groupby("state")["breakages"].max()
    whole = broken.index[broken == 0]
    first = whole[-1] if len(whole) else density.index[0]
    density = density[density.index >= first]
    even = np.linspace(density.iloc[0], density.iloc[-1], _STAGES)
    return sorted({int((density - at).abs().idxmin()) for at in even})


def crushed_gradings(
    grains: Mapping[int, pd.DataFrame],
    states: pd.DataFrame,
    stages: Sequence[int],
    sample: Crushable,
    intervals: Mapping[str, Any],
) -> pd.DataFrame:
    """Return percent finer by mass at some stages, mean over seeds with its interval.

    Parameters
    ----------
    grains : mapping of int to DataFrame
        Columns state and radius_m of `grains.parquet`, by seed.
    states : DataFrame
        `crushing_states.csv`.
    stages : sequence of int
        States that all seeds have.
    sample : Crushable
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    DataFrame
        `crushing_gradings.csv`.
    """
    every = pd.concat([rows[rows["state"].isin(stages)] for rows in grains.values()])
    ends = every["radius_m"].min(), every["radius_m"].max()
    radius = np.geomspace(0.95 * ends[0], 1.02 * ends[1], _SIZES)
    firsts = [rows[rows["state"] == stages[0]]["radius_m"] for rows in grains.values()]
    ultimate = sample.ultimate(from_radii(np.concatenate(firsts)))
    limit = np.full(_SIZES, np.nan) if ultimate is None else 100.0 * ultimate.mass_cdf(radius)
    parts = []
    for stage in stages:
        finer = [
            100.0 * from_radii(rows.loc[rows["state"] == stage, "radius_m"]).mass_cdf(radius)
            for rows in grains.values()
        ]
        of_sizes = [
            mean_interval(at, intervals).named("percent_finer_by_mass")
            for at in np.transpose(finer)
        ]
        here = states[(states["state"] == stage) & ~states["halved_step"]]
        told = {
            "state": stage,
            "solid_fraction": here["solid_fraction"].mean(),
            "broken_mass_fraction": here["broken_mass_fraction"].mean(),
            "diameter_m": 2.0 * radius,
        }
        part = pd.concat([pd.DataFrame(told), pd.DataFrame(of_sizes)], axis=1)
        parts.append(part.assign(percent_finer_by_mass_ultimate=limit))
    return pd.concat(parts, ignore_index=True)
