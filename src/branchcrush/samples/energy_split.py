"""The branches of the seeds: what is kept of their contacts, and the exponents of all together.

Contacts are many, so each seed's are read, reduced to what the results need, and let go.
"""

from typing import NamedTuple

import numpy as np
import pandas as pd

from branchcrush.energy.fit import Curvature, EndState, EnergySplitFit, StateFit
from branchcrush.energy.predictors import branch_columns, compared_predictors, curvature
from branchcrush.energy.split import cubic_r_squared, energy_split
from branchcrush.errors import FitError
from branchcrush.packings.network import state_rows
from branchcrush.samples.ensemble import mean_path, named_states
from branchcrush.statistics.bins import binned_sums
from branchcrush.statistics.intervals import Interval, Resampling
from branchcrush.statistics.power_law import binned_exponent

# The columns of a contacts table that energies by length need, and those that all of it needs.
ENERGY_COLUMNS = ("state", "radius_i_m", "radius_j_m", "energy_J")
COLUMNS = (*ENERGY_COLUMNS, "branch_length_m", "overlap_m")


class Branches(NamedTuple):
    """The branches of one seed in some of its states, in their order."""

    sums: np.ndarray  # `statistics.bins.binned_sums` of each state, shape (states, 3, n)
    overlap_ratio: list[np.ndarray]  # overlap over distance of the centres, in each state [-]
    # Every branch of the first state and of the last, as `energy.predictors.branch_columns`: those
    # between are many, and what they say of the exponent is in the sums.
    first: tuple
    last: tuple


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
    return Branches(sums, ratios, *(_columns(tables[number], edges) for number in (0, -1)))


def state_sums(contacts, state, edges):
    """Return the binned energies of one state of a seed, as `statistics.bins.binned_sums`.

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


def final_energy_split(branches, paths, edges, jamming, *, confidence, resamples):
    """Return the bins and the fit of the energy split at the end of the path.

    Parameters
    ----------
    branches : list of Branches
        Of each seed, in the states of the paths.
    paths : list of DataFrame
        From `samples.ensemble.certified_loading`.
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
        As `energy.split.energy_split`, with the edges of the bins.
    fit : dict
        From `energy.fit.EnergySplitFit`.

    Raises
    ------
    FitError
        When the energies bear no power law: too few branches, or all of one length.
    """
    sums = np.stack([seed.sums[-1] for seed in branches])
    law, exponent = binned_exponent(
        sums, confidence=confidence, resamples=resamples, rng=Resampling.EXPONENTS.rng()
    )
    table, reference = energy_split(sums.sum(axis=0), law, edges[-1] / 2.0)
    slope, r_squared = cubic_r_squared(table["branch_length_m"] / reference, table["f"])
    alone = [float(binned_exponent(seed[None], rng=None)[1].estimate) for seed in sums]
    fit = EnergySplitFit(
        exponent=exponent,
        confidence=confidence,
        amplitude=float(law.amplitude),
        reference_length=reference,
        exponent_of_each_seed=tuple(alone),
        mean_of_seed_exponents=float(np.mean(alone)),
        packings=end_state(branches, paths, jamming),
        cubic_slope=slope,
        cubic_r_squared=r_squared,
        end=_state_fit([seed.last for seed in branches], confidence, resamples),
        near_jamming=_first_state_fit(branches, paths, confidence, resamples),
    )
    return {"length_low_m": edges[:-1], "length_high_m": edges[1:], **table}, fit.result()


def end_state(branches, paths, jamming):
    """Return what the packings are like at the end of their loading, means over the seeds.

    Parameters
    ----------
    branches : list of Branches
        Of each seed, in the states of the paths.
    paths : list of DataFrame
        From `samples.ensemble.certified_loading`.
    jamming : float
        Mean phi_J of the packings [-].

    Returns
    -------
    EndState
    """
    ends = pd.DataFrame([path.iloc[-1] for path in paths])
    return EndState(
        seeds=len(paths),
        branches=int(sum(seed.sums[-1, 0].sum() for seed in branches)),
        solid_fraction=float(ends["solid_fraction"].mean()),
        jamming_solid_fraction=float(jamming),
        mean_stress=float(ends["mean_stress_Pa"].mean()),
        elastic_energy_density=float((ends["elastic_energy_J"] / ends["volume_m3"]).mean()),
        median_overlap_ratio=_median_overlap_ratio(branches, -1),
        coordination_number=float(ends["coordination_number"].mean()),
        mechanical_coordination_number=float(ends["mechanical_coordination_number"].mean()),
        rattler_fraction=float(ends["rattler_fraction"].mean()),
    )


def exponents_along_path(branches, paths, jamming, *, confidence, resamples):
    """Return the exponent of the energy split in every loaded state.

    Parameters
    ----------
    branches : list of Branches
        Of each seed, in the states of the paths.
    paths : list of DataFrame
        From `samples.ensemble.certified_loading`.
    jamming, confidence, resamples
        As for `final_energy_split`.

    Returns
    -------
    DataFrame
        A row for each state: state, solid_fraction, the same less phi_J, mean_stress_Pa,
        median_overlap_ratio (overlap over branch length), branches, exponent, exponent_low,
        exponent_high; nan where a state has too few branches for an exponent.
    """
    rows = []
    for number, state in enumerate(mean_path(paths, jamming).to_dict("records")):
        sums = np.stack([seed.sums[number] for seed in branches])
        try:
            _, exponent = binned_exponent(
                sums,
                confidence=confidence,
                resamples=resamples,
                rng=Resampling.EXPONENTS.rng(),
            )
        except FitError:  # hardly any contact, close to jamming
            exponent = Interval(np.nan, np.nan, np.nan)
        rows.append(
            {
                **state,
                "median_overlap_ratio": _median_overlap_ratio(branches, number),
                "branches": int(sums[:, 0].sum()),
                **exponent.named("exponent"),
            }
        )
    return pd.DataFrame(rows)


def _first_state_fit(branches, paths, confidence, resamples):
    if "near_jamming" not in named_states(paths[0]):
        return None
    return _state_fit(
        [seed.first for seed in branches],
        confidence,
        resamples,
        state=int(paths[0]["state"].iloc[0]),
        solid_fraction=_mean(path["solid_fraction"].iloc[0] for path in paths),
    )


def _state_fit(seeds, confidence, resamples, **place):
    options = {"confidence": confidence, "resamples": resamples}
    predictors = compared_predictors(seeds, **options)
    try:
        bend = curvature(seeds, **options)
    except FitError as error:
        bend = Curvature.without(str(error))
    return StateFit(predictors, bend, **place)


def _mean(values):
    return float(np.mean(list(values)))


def _of_states(contacts, states):
    """Return the rows of each state as a table of its own."""
    return [contacts.iloc[rows] for rows in state_rows(contacts["state"], states)]


def _length(table):
    # The paper's branch length, that of two spheres that just touch.
    return table["radius_i_m"].to_numpy() + table["radius_j_m"].to_numpy()


def _columns(table, edges):
    radii = (table["radius_i_m"].to_numpy(), table["radius_j_m"].to_numpy())
    return branch_columns(*radii, table["energy_J"].to_numpy(), edges[-1] / 2.0)


def _sums(table, edges):
    return binned_sums(_length(table), table["energy_J"].to_numpy(), edges)


def _median_overlap_ratio(branches, number):
    ratios = np.concatenate([seed.overlap_ratio[number] for seed in branches])
    return float(np.median(ratios, overwrite_input=True)) if ratios.size else np.nan
