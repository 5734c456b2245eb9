"""The branches of the seeds: what is kept of their contacts, and the exponents of all together.

Contacts are many, so each seed's are read, reduced to what the results need, and let go.
"""

from typing import NamedTuple

import numpy as np
import pandas as pd

from branchcrush.energy_split import (
    Interval,
    binned_exponent,
    binned_sums,
    cubic_r_squared,
    energy_split,
    power_law_fit,
)
from branchcrush.ensemble import stacked
from branchcrush.errors import FitError

# The columns of a contacts table that a length needs, and those that an energy split needs.
LENGTH_COLUMNS = ("state", "radius_i_m", "radius_j_m")
ENERGY_COLUMNS = (*LENGTH_COLUMNS, "energy_J")
COLUMNS = (*ENERGY_COLUMNS, "branch_length_m", "overlap_m")

# The random state of the resampling: one and the same, so that a result can be made again.
_RESAMPLING = 20


class Branches(NamedTuple):
    """The branches of one seed in some of its states, in their order."""

    sums: np.ndarray  # `energy_split.binned_sums` of each state, shape (states, 3, n)
    overlap_ratio: list[np.ndarray]  # overlap over distance of the centres, in each state [-]
    length: np.ndarray  # R_i + R_j of every branch of the last state [m]
    energy: np.ndarray  # and its energy [J]


def seed_branches(contacts, states, edges):
    """Return what the results of a sample need of the contacts of one seed.

    Parameters
    ----------
    contacts : DataFrame
        `contacts.parquet`, of it at least `COLUMNS`.
    states : array_like of int
        In increasing order.
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    Branches
        It holds no part of the table.
    """
    tables = _of_states(contacts, states)
    ratios = [
        table["overlap_m"].to_numpy() / table["branch_length_m"].to_numpy() for table in tables
    ]
    sums = np.stack([_sums(table, edges) for table in tables])
    # A copy: a part of the table would keep all of it.
    return Branches(sums, ratios, _length(tables[-1]), tables[-1]["energy_J"].to_numpy(copy=True))


def state_sums(contacts, state, edges):
    """Return the binned energies of one state of a seed, as `energy_split.binned_sums`.

    Parameters
    ----------
    contacts : DataFrame
        `contacts.parquet`, of it at least `ENERGY_COLUMNS`.
    state : int
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    ndarray, shape (3, n)
    """
    return _sums(*_of_states(contacts, [state]), edges)


def state_lengths(contacts, state):
    """Return the branch lengths R_i + R_j of one state of a seed [m].

    Parameters
    ----------
    contacts : DataFrame
        `contacts.parquet`, of it at least `LENGTH_COLUMNS`.
    state : int

    Returns
    -------
    ndarray, shape (M,)

    Examples
    --------
    >>> contacts = {"state": [0, 1], "radius_i_m": [1.0, 2.0], "radius_j_m": [1.0, 3.0]}
    >>> state_lengths(pd.DataFrame(contacts), 1).tolist()
    [5.0]
    """
    return _length(*_of_states(contacts, [state]))


def final_energy_split(branches, paths, edges, jamming, *, confidence, resamples):
    """Return the bins and the fit of the energy split at the end of the path.

    Parameters
    ----------
    branches : list of Branches
        Of each seed, in the states of the paths.
    paths : list of DataFrame
        From `ensemble.certified_loading`.
    edges : array_like, shape (n+1,)
        Bin edges [m].
    jamming : float
        Mean phi_J of the packings [-].
    confidence : float
    resamples : int
        Draws of the seeds, always from the same random state.

    Returns
    -------
    table : dict of ndarray
        As `energy_split.energy_split`, with the edges of the bins.
    fit : dict
        exponent with its interval, the exponent of each seed alone, the paper's cubic, and the
        fit to all branches at once under `predictors`.

    Raises
    ------
    FitError
        When the energies bear no power law: too few branches, or all of one length.
    """
    sums = np.stack([seed.sums[-1] for seed in branches])
    law, exponent = binned_exponent(
        sums, confidence=confidence, resamples=resamples, rng=np.random.default_rng(_RESAMPLING)
    )
    table, reference = energy_split(sums.sum(axis=0), law, edges[-1] / 2.0)
    slope, r_squared = cubic_r_squared(table["branch_length_m"] / reference, table["f"])
    whole = power_law_fit(
        np.concatenate([seed.length for seed in branches]),
        np.concatenate([seed.energy for seed in branches]),
    )
    alone = [float(binned_exponent(seed[None], rng=None)[1].estimate) for seed in sums]
    fit = {
        "exponent": exponent.estimate,
        "exponent_low": exponent.low,
        "exponent_high": exponent.high,
        "confidence": confidence,
        "amplitude_J_per_m_n": float(law.amplitude),
        "reference_length_m": reference,
        "exponent_of_each_seed": alone,
        "mean_of_seed_exponents": float(np.mean(alone)),
        **end_state(branches, paths, jamming),
        "cubic_slope": slope,
        "cubic_r_squared": r_squared,
        "predictors": [
            {
                "name": "branch_length",
                "method": "gamma regression of all branches, logarithmic link",
                "exponent": float(whole.exponent),
            }
        ],
    }
    return {"length_low_m": edges[:-1], "length_high_m": edges[1:], **table}, fit


def end_state(branches, paths, jamming):
    """Return what the packings are like at the end of their loading, means over the seeds.

    Parameters
    ----------
    branches : list of Branches
        Of each seed, in the states of the paths.
    paths : list of DataFrame
        From `ensemble.certified_loading`.
    jamming : float
        Mean phi_J of the packings [-].

    Returns
    -------
    dict
    """
    ends = pd.DataFrame([path.iloc[-1] for path in paths])
    return {
        "seeds": len(paths),
        "branches": sum(seed.length.size for seed in branches),
        "solid_fraction": float(ends["solid_fraction"].mean()),
        "jamming_solid_fraction": float(jamming),
        "mean_stress_Pa": float(ends["mean_stress_Pa"].mean()),
        "elastic_energy_J_per_m3": float((ends["elastic_energy_J"] / ends["volume_m3"]).mean()),
        "median_overlap_ratio": _median_overlap_ratio(branches, -1),
        "coordination_number": float(ends["coordination_number"].mean()),
        "mechanical_coordination_number": float(ends["mechanical_coordination_number"].mean()),
        "rattler_fraction": float(ends["rattler_fraction"].mean()),
    }


def exponents_along_path(branches, paths, jamming, *, confidence, resamples):
    """Return the exponent of the energy split in every loaded state.

    Parameters
    ----------
    branches : list of Branches
        Of each seed, in the states of the paths.
    paths : list of DataFrame
        From `ensemble.certified_loading`.
    jamming, confidence, resamples
        As for `final_energy_split`.

    Returns
    -------
    DataFrame
        A row for each state: state, solid_fraction, the same less phi_J, mean_stress_Pa,
        median_overlap_ratio (overlap over branch length), branches, exponent, exponent_low,
        exponent_high; nan where a state has too few branches for an exponent.
    """
    mean = stacked(paths).groupby("state")[["solid_fraction", "mean_stress_Pa"]].mean()
    rows = []
    for number, state in enumerate(paths[0]["state"]):
        sums = np.stack([seed.sums[number] for seed in branches])
        try:
            _, exponent = binned_exponent(
                sums,
                confidence=confidence,
                resamples=resamples,
                rng=np.random.default_rng(_RESAMPLING),
            )
        except FitError:  # hardly any contact, close to jamming
            exponent = Interval(np.nan, np.nan, np.nan)
        rows.append(
            {
                "state": state,
                "solid_fraction": mean["solid_fraction"][state],
                "solid_fraction_above_jamming": mean["solid_fraction"][state] - jamming,
                "mean_stress_Pa": mean["mean_stress_Pa"][state],
                "median_overlap_ratio": _median_overlap_ratio(branches, number),
                "branches": int(sums[:, 0].sum()),
                "exponent": exponent.estimate,
                "exponent_low": exponent.low,
                "exponent_high": exponent.high,
            }
        )
    return pd.DataFrame(rows)


def _of_states(contacts, states):
    """Return the rows of each state as a table of its own."""
    column = contacts["state"].to_numpy()
    if np.any(column[1:] < column[:-1]):  # not as `simulation` leaves them, state after state
        contacts = contacts.sort_values("state", kind="stable")
        column = contacts["state"].to_numpy()
    begin, end = (np.searchsorted(column, states, side) for side in ("left", "right"))
    return [contacts.iloc[rows] for rows in map(slice, begin, end)]


def _length(table):
    # The paper's branch length, that of two spheres that just touch.
    return table["radius_i_m"].to_numpy() + table["radius_j_m"].to_numpy()


def _sums(table, edges):
    return binned_sums(_length(table), table["energy_J"].to_numpy(), edges)


def _median_overlap_ratio(branches, number):
    ratios = np.concatenate([seed.overlap_ratio[number] for seed in branches])
    return float(np.median(ratios, overwrite_input=True)) if ratios.size else np.nan
