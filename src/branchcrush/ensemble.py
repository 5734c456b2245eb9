"""The seeds of a sample together: their certified states, exponents and energies."""

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


def end_of_loading(path):
    """Return the row of the last state before any unloading.

    Parameters
    ----------
    path : DataFrame
        `path.csv`.

    Returns
    -------
    Series

    Examples
    --------
    >>> path = pd.DataFrame({"state": [0, 1, 2], "leg": ["loading", "loading", "unloading"]})
    >>> int(end_of_loading(path)["state"])
    1
    """
    return path[path["leg"] == "loading"].iloc[-1]


def certified_loading(certificate, paths, contacts):
    """Return the certified states on the way in, of the seeds that are certified to its end.

    Parameters
    ----------
    certificate : DataFrame
        `certificate.csv`; its first seeds are those of the lists.
    paths, contacts : list of DataFrame
        The tables of each seed.

    Returns
    -------
    used : list of int
        Which of the seeds, counted from 0.
    paths, contacts : list of DataFrame
        Of these seeds, with the states that are certified in every one of them.

    Raises
    ------
    FitError
        When there is no such seed: the sample gives no data for a fit.
    """
    usable = certificate["certified"] & (certificate["leg"] == "loading")
    certified = [
        set(states.loc[usable[states.index], "state"])
        for _, states in certificate.groupby("seed", sort=False)
    ][: len(paths)]
    last = max(int(end_of_loading(path)["state"]) for path in paths)
    used = [number for number, states in enumerate(certified) if last in states]
    if not used:
        reached = [end_of_loading(path)["solid_fraction"] for path in paths]
        loaded = sum(bool(end_of_loading(path)["carries_load"]) for path in paths)
        raise FitError(
            f"no packing is certified at the end of its loading: {loaded} of {len(paths)} carry "
            f"load there, at a solid fraction of {np.mean(reached):.4f}"
        )
    common = set.intersection(*(certified[number] for number in used))

    def kept(tables):
        chosen = (tables[number] for number in used)
        return [t[t["state"].isin(common)].reset_index(drop=True) for t in chosen]

    return used, kept(paths), kept(contacts)


def on_the_way_in(paths, used):
    """Return the loading states of some seeds, with those before any load.

    Parameters
    ----------
    paths : list of DataFrame
    used : list of int
        Which seeds, counted from 0.

    Returns
    -------
    list of DataFrame
    """
    loading = (paths[number] for number in used)
    return [path[path["leg"] == "loading"].reset_index(drop=True) for path in loading]


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


def final_energy_split(contacts, paths, edges, jamming, *, confidence, resamples):
    """Return the bins and the fit of the energy split at the end of the path.

    Parameters
    ----------
    contacts, paths : list of DataFrame
        The tables of each seed, from `certified_loading`.
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
    state = int(paths[0]["state"].iloc[-1])
    sums = split_sums(contacts, state, edges)
    law, exponent = binned_exponent(
        sums, confidence=confidence, resamples=resamples, rng=np.random.default_rng(_RESAMPLING)
    )
    table, reference = energy_split(sums.sum(axis=0), law, edges[-1] / 2.0)
    slope, r_squared = cubic_r_squared(table["branch_length_m"] / reference, table["f"])
    branches = pd.concat([_final(contact) for contact in contacts])
    whole = power_law_fit(_length(branches), branches["energy_J"].to_numpy())
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
        **end_state(contacts, paths, jamming),
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


def end_state(contacts, paths, jamming):
    """Return what the packings are like at the end of their loading, means over the seeds.

    Parameters
    ----------
    contacts, paths : list of DataFrame
        The tables of each seed, from `certified_loading`.
    jamming : float
        Mean phi_J of the packings [-].

    Returns
    -------
    dict
    """
    ends = pd.DataFrame([path.iloc[-1] for path in paths])
    branches = pd.concat([_final(contact) for contact in contacts])
    overlap = branches["overlap_m"] / branches["branch_length_m"]
    return {
        "seeds": len(paths),
        "branches": len(branches),
        "solid_fraction": float(ends["solid_fraction"].mean()),
        "jamming_solid_fraction": float(jamming),
        "mean_stress_Pa": float(ends["mean_stress_Pa"].mean()),
        "elastic_energy_J_per_m3": float((ends["elastic_energy_J"] / ends["volume_m3"]).mean()),
        "median_overlap_ratio": float(overlap.median()),
        "coordination_number": float(ends["coordination_number"].mean()),
        "mechanical_coordination_number": float(ends["mechanical_coordination_number"].mean()),
        "rattler_fraction": float(ends["rattler_fraction"].mean()),
    }


def exponents_along_path(contacts, paths, edges, jamming, *, confidence, resamples):
    """Return the exponent of the energy split in every loaded state.

    Parameters
    ----------
    contacts, paths : list of DataFrame
        The tables of each seed, from `certified_loading`.
    edges : array_like, shape (n+1,)
        Bin edges [m].
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
    for state in paths[0]["state"]:
        branches = pd.concat([table[table["state"] == state] for table in contacts])
        sums = split_sums(contacts, state, edges)
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
