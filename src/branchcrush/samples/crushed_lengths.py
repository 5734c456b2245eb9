"""Rule crushing_results: how long branches are while grains break, beside the grains."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.branches.load_bearing import rod_contacts
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.predictions import pair_shares
from branchcrush.branches.random_contacts import random_contact_shares
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.mixtures import from_radii
from branchcrush.samples.crushed_line import mean_interval, named_mean

# Edges in the branch length over the mean diameter, six to a factor of 2, with 1 in the middle of a
# bin; what is beyond counts in the last ones, below a tenth of a mean diameter or above a hundred.
_A_FACTOR_2 = 6
_EDGES = 2.0 ** ((np.arange(-20, 41) + 0.5) / _A_FACTOR_2)
_WIDTH = np.log(2.0) / _A_FACTOR_2


def length_counts(branches: pd.DataFrame, grains: pd.DataFrame) -> pd.DataFrame:
    r"""Return how many branches of each state are how long, in mean diameters of its grains.

    Parameters
    ----------
    branches : DataFrame
        Columns state and branch_length_m of `contacts.parquet`.
    grains : DataFrame
        Columns state and radius_m of `grains.parquet`.

    Returns
    -------
    DataFrame
        By state that has branches: mean_diameter_m, mean_ratio, of l/<d> [-], and counts, an
        array.

    Examples
    --------
    >>> grains = pd.DataFrame({"state": 3, "radius_m": [1.0, 1.0, 4.0]})
    >>> branches = pd.DataFrame({"state": 3, "branch_length_m": [2.0, 5.0, 5.0]})
    >>> float(length_counts(branches, grains)["mean_ratio"].loc[3])
    1.0
    """
    diameter = 2.0 * grains.groupby("state")["radius_m"].mean()
    rows = {}
    for state, length in branches.groupby("state")["branch_length_m"]:
        ratio = length.to_numpy() / diameter[state]
        inside = np.clip(ratio, _EDGES[0], _EDGES[-1])
        rows[state] = {
            "mean_diameter_m": diameter[state],
            "mean_ratio": ratio.mean(),
            "counts": np.histogram(inside, _EDGES)[0],
        }
    columns = ["mean_diameter_m", "mean_ratio", "counts"]
    return pd.DataFrame.from_dict(rows, orient="index", columns=columns)


def crushed_lengths(
    counted: Mapping[int, pd.DataFrame],
    grains: Mapping[int, pd.DataFrame],
    states: pd.DataFrame,
    stages: Sequence[int],
    intervals: Mapping[str, Any],
) -> tuple[pd.DataFrame, dict[str, Any]]:
    r"""Return the distribution of branch length at stages of crushing, beside two predictions.

    .. math:: \frac{dP}{d \ln l} = l\, B(l), \qquad \frac{\langle l \rangle}{\langle d \rangle}

    Drawn alike from the grains, as by Eq. 4, the two ends of a branch have a mean length of one
    mean diameter, whatever the grading; rods say which grains bear contacts at jamming.

    Parameters
    ----------
    counted : mapping of int to DataFrame
        From `length_counts`, by seed.
    grains : mapping of int to DataFrame
        Columns state and radius_m of `grains.parquet`, by seed.
    states : DataFrame
        `crushing_states.csv`.
    stages : sequence of int
        States that all seeds have; those in which no seed has branches are left out.
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    table : DataFrame
        `crushing_lengths.csv`.
    summary : dict
        Keys of `crushing.json`, at the last of these states.
    """
    parts, told = [], _told([], intervals, np.nan)
    for stage in stages:
        there = [rows.loc[stage] for rows in counted.values() if stage in rows.index]
        if not there:
            continue
        radii = np.concatenate(
            [rows.loc[rows["state"] == stage, "radius_m"] for rows in grains.values()]
        )
        grading = from_radii(radii)
        edges = _EDGES * 2.0 * radii.mean()
        rods, by_rods = _by_rods(grading, edges)
        told = _told([rows["mean_ratio"] for rows in there], intervals, by_rods / radii.mean())
        here = states[(states["state"] == stage) & ~states["halved_step"]]
        part = _densities([rows["counts"] for rows in there], intervals)
        columns = {
            "state": stage,
            "solid_fraction": here["solid_fraction"].mean(),
            "mean_diameter_m": 2.0 * radii.mean(),
            "length_over_diameter_low": _EDGES[:-1],
            "length_over_diameter_high": _EDGES[1:],
        }
        predicted = {
            "density_by_rods": rods / _WIDTH,
            "density_random_contact": random_contact_shares(grading, edges) / _WIDTH,
        }
        whole = pd.concat([pd.DataFrame(columns), part, pd.DataFrame(predicted)], axis=1)
        seen = np.flatnonzero((whole["density"] > 0.0) | (whole["density_random_contact"] > 0.0))
        parts.append(whole.iloc[seen[0] : seen[-1] + 1])
    return pd.concat(parts, ignore_index=True) if parts else no_lengths(), told


def no_lengths() -> pd.DataFrame:
    """Return the table where no stage has branches."""
    names = ["state", "solid_fraction", "mean_diameter_m", "length_over_diameter_low"]
    density = ["branches", "density", "density_low", "density_high"]
    last = ["density_by_rods", "density_random_contact"]
    return pd.DataFrame(columns=[*names, "length_over_diameter_high", *density, *last])


def _densities(counts: Sequence[NDArray], intervals: Mapping[str, Any]) -> pd.DataFrame:
    """Return branches in each bin and their density in ln(l), mean over seeds with its interval."""
    shares = [of_seed / of_seed.sum() / _WIDTH for of_seed in counts]
    rows = [mean_interval(at, intervals).named("density") for at in np.transpose(shares)]
    return pd.DataFrame({"branches": np.sum(counts, axis=0)}).join(pd.DataFrame(rows))


def _by_rods(grading: Grading, edges: NDArray) -> tuple[NDArray, float]:
    """Return shares of the branches by rods that push, and the mean radius at a branch's end."""
    radius, share = grading_nodes(grading)
    try:
        ends = share * rod_contacts(radius, share).contacts
    except (FitError, ValueError):
        return np.full(edges.size - 1, np.nan), np.nan
    return pair_shares(radius, ends, edges), float(ends @ radius / ends.sum())


def _told(ratios: Sequence[float], intervals: Mapping[str, Any], by_rods: float) -> dict[str, Any]:
    """Return what is told of the last stage."""
    values = list(ratios) or [np.nan]
    return {
        **named_mean("final_branch_over_diameter", values, intervals),
        "final_branch_over_diameter_by_rods": float(by_rods),
    }
