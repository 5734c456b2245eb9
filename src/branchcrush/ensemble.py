"""The seeds of a sample together: states that carry load, their exponents, their energies."""

import numpy as np
import pandas as pd

from branchcrush.energy_split import (
    binned_exponent,
    binned_sums,
    cubic_r_squared,
    energy_split,
    power_law_fit,
)
from branchcrush.errors import FitError

# The random state of the resampling: one and the same, so that a result can be made again.
_RESAMPLING = 20


def stacked(paths):
    """Return the loading paths of all seeds as one table.

    Parameters
    ----------
    paths : list of DataFrame
        A `path.csv` for each seed; all save the same states.

    Returns
    -------
    DataFrame
        With a column `seed_number`, from 0.
    """
    return pd.concat(
        [path.assign(seed_number=number) for number, path in enumerate(paths)], ignore_index=True
    )


def loaded_states(paths):
    """Return the states in which the packing of every seed carries load.

    Parameters
    ----------
    paths : list of DataFrame

    Returns
    -------
    list of int

    Raises
    ------
    FitError
        When the last state is not among them: the sample gives no data for a fit.

    Examples
    --------
    >>> path = pd.DataFrame({"state": [0, 1], "carries_load": [False, True]})
    >>> loaded_states([path, path])
    [1]
    """
    together = stacked(paths).groupby("state")["carries_load"].all()
    states = together.index[together].tolist()
    last = together.index.max()
    if last not in states:
        reached = [path["solid_fraction"].iloc[-1] for path in paths]
        unloaded = sum(not path["carries_load"].iloc[-1] for path in paths)
        raise FitError(
            f"{unloaded} of {len(paths)} packings carry no load at the end of the path, solid "
            f"fraction {np.mean(reached):.4f}: raise loading.edge_reduction"
        )
    return states


def split_sums(contacts, state, edges):
    """Return the binned energies of one state, seed by seed.

    Parameters
    ----------
    contacts : list of DataFrame
        The contacts table of each seed.
    state : int
    edges : array_like, shape (n+1,)
        Bin edges [m].

    Returns
    -------
    ndarray, shape (S, 3, n)
        `energy_split.binned_sums` of each seed.
    """
    return np.stack([_binned(table[table["state"] == state], edges) for table in contacts])


def final_branches(contacts):
    """Return the branch lengths R_i + R_j of each seed at the end of its path [m].

    Parameters
    ----------
    contacts : list of DataFrame

    Returns
    -------
    list of ndarray
    """
    return [_length(_final(table)) for table in contacts]


def final_energy_split(contacts, paths, edges, *, confidence, resamples):
    """Return the bins and the fit of the energy split at the end of the path.

    Parameters
    ----------
    contacts, paths : list of DataFrame
        The tables of each seed.
    edges : array_like, shape (n+1,)
        Bin edges [m].
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
        When a packing carries no load.
    """
    state = loaded_states(paths)[-1]
    sums = split_sums(contacts, state, edges)
    law, exponent = binned_exponent(
        sums, confidence=confidence, resamples=resamples, rng=np.random.default_rng(_RESAMPLING)
    )
    table, reference = energy_split(sums.sum(axis=0), law, edges[-1] / 2.0)
    slope, r_squared = cubic_r_squared(table["branch_length_m"] / reference, table["f"])
    ends = stacked([path[path["state"] == state] for path in paths])
    branches = pd.concat([_final(contact) for contact in contacts])
    whole = power_law_fit(_length(branches), branches["energy_J"].to_numpy())
    alone = [float(binned_exponent(seed[None], rng=None)[1].estimate) for seed in sums]
    fit = {
        "exponent": exponent.estimate,
        "exponent_low": exponent.low,
        "exponent_high": exponent.high,
        "confidence": confidence,
        "seeds": len(contacts),
        "branches": len(branches),
        "amplitude_J_per_m_n": float(law.amplitude),
        "reference_length_m": reference,
        "exponent_of_each_seed": alone,
        "mean_of_seed_exponents": float(np.mean(alone)),
        "solid_fraction": float(ends["solid_fraction"].mean()),
        "median_overlap_ratio": float(
            (branches["overlap_m"] / branches["branch_length_m"]).median()
        ),
        "coordination_number": float(ends["coordination_number"].mean()),
        "mechanical_coordination_number": float(ends["mechanical_coordination_number"].mean()),
        "rattler_fraction": float(ends["rattler_fraction"].mean()),
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


def exponents_along_path(contacts, paths, edges, *, confidence, resamples):
    """Return the exponent of the energy split in every loaded state.

    Parameters
    ----------
    contacts, paths : list of DataFrame
        The tables of each seed.
    edges : array_like, shape (n+1,)
        Bin edges [m].
    confidence, resamples
        As for `final_energy_split`.

    Returns
    -------
    DataFrame
        A row for each state: state, solid_fraction, mean_stress_Pa, median_overlap_ratio (overlap
        over branch length), branches, exponent, exponent_low, exponent_high.
    """
    mean = stacked(paths).groupby("state")[["solid_fraction", "mean_stress_Pa"]].mean()
    rows = []
    for state in loaded_states(paths):
        branches = pd.concat([table[table["state"] == state] for table in contacts])
        _, exponent = binned_exponent(
            split_sums(contacts, state, edges),
            confidence=confidence,
            resamples=resamples,
            rng=np.random.default_rng(_RESAMPLING),
        )
        rows.append(
            {
                "state": state,
                "solid_fraction": mean["solid_fraction"][state],
                "mean_stress_Pa": mean["mean_stress_Pa"][state],
                "median_overlap_ratio": (
                    branches["overlap_m"] / branches["branch_length_m"]
                ).median(),
                "branches": len(branches),
                "exponent": exponent.estimate,
                "exponent_low": exponent.low,
                "exponent_high": exponent.high,
            }
        )
    return pd.DataFrame(rows)


def _final(table):
    return table[table["state"] == table["state"].max()]


def _length(table):
    # The paper's branch length, that of two spheres that just touch.
    return (table["radius_i_m"] + table["radius_j_m"]).to_numpy()


def _binned(table, edges):
    return binned_sums(_length(table), table["energy_J"], edges)
