"""Rule energy_split: the energy split of the branches of all seeds, and its exponent."""

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.energy.curvature import curvature
from branchcrush.energy.estimators import ESTIMATORS, binned_estimators
from branchcrush.energy.fit import EndState, EnergySplitFit
from branchcrush.energy.local_exponents import local_exponents
from branchcrush.energy.predictors import compared_predictors
from branchcrush.energy.radius_ratio import radius_ratio_table
from branchcrush.energy.split import cubic_r_squared, energy_split
from branchcrush.energy.state_fit import UNKNOWN, Curvature, StateFit
from branchcrush.errors import FitError
from branchcrush.files.tables import no_data
from branchcrush.gradings.distribution import Grading
from branchcrush.samples.ensemble import certified_loading, mean_path, named_states
from branchcrush.samples.seed_branches import Branches, seed_branches
from branchcrush.statistics.bins import bin_edges
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.power_law import binned_exponent
from branchcrush.statistics.resampling import Resampling


def energy_split_results(
    grading: Grading,
    certificate: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    jamming: pd.DataFrame,
    read_seed: Callable[[int], pd.DataFrame],
    *,
    bins: int,
    confidence: float,
    resamples: int,
) -> tuple[dict, EnergySplitFit]:
    """Return the energy split at the end of the loading, and its exponent along it.

    Parameters
    ----------
    grading : Grading
        Target.
    certificate : DataFrame
        `certificate.csv`.
    paths : list of DataFrame
        The `path.csv` of each seed.
    jamming : DataFrame
        `jamming.csv`.
    read_seed : callable
        Takes the number of a seed, from 0; returns its `contacts.parquet`, at least
        `samples.seed_branches.COLUMNS`. Called for one seed after the other.
    bins : int
        Of branch length.
    confidence, resamples
        As for `final_energy_split`.

    Returns
    -------
    tables : dict
        table, of `final_energy_split`, path, of `exponents_along_path`, and ratio, of
        `energy.radius_ratio.radius_ratio_table`; or why there are none.
    fit : EnergySplitFit
        With the reason, and what is known of the packings, where there is no energy split.
    """
    options = {"confidence": confidence, "resamples": resamples}
    edges = bin_edges(*grading.support(), bins)
    packings = None
    try:
        used, paths = certified_loading(certificate, paths)
        states = paths[0]["state"]
        branches = [seed_branches(read_seed(number), states, edges) for number in used]
        mean_jamming = jamming["jamming_solid_fraction_loading"].iloc[used].mean()
        packings = end_state(branches, paths, mean_jamming)
        table, fit = final_energy_split(branches, paths, edges, packings, **options)
        along = exponents_along_path(branches, paths, mean_jamming, **options)
    except FitError as error:
        table, _ = no_data(error)
        nothing = dict.fromkeys(("table", "path", "ratio"), table)
        return nothing, EnergySplitFit.without(str(error), packings)
    ratio = _ratio_table([seed.last for seed in branches], fit.end, options)
    return {"table": table, "path": along, "ratio": ratio}, fit


def _ratio_table(seeds, end, options):
    fitted = end.predictor("length_and_ratio")
    if fitted is None:
        return no_data("the branches do not tell length and ratio of the radii apart")[0]
    exponents = (value.estimate for value in fitted.parameters.values())
    return radius_ratio_table(seeds, *exponents, **options)


def final_energy_split(
    branches: Sequence[Branches],
    paths: Sequence[pd.DataFrame],
    edges: NDArray,
    packings: EndState,
    *,
    confidence: float,
    resamples: int,
) -> tuple[dict, EnergySplitFit]:
    """Return the bins and the fit of the energy split at the end of the path.

    Parameters
    ----------
    branches : list of Branches
        Of each seed, in the states of the paths.
    paths : list of DataFrame
        From `samples.ensemble.certified_loading`.
    edges : array_like, shape (n+1,)
        Bin edges [m].
    packings : EndState
        From `end_state`.
    confidence : float
    resamples : int
        Draws of the seeds, always from the same random state.

    Returns
    -------
    table : dict of ndarray
        As `energy.split.energy_split`, with the edges of the bins.
    fit : EnergySplitFit

    Raises
    ------
    FitError
        When the energies bear no power law: too few branches, or all of one length.
    """
    options = {"confidence": confidence, "resamples": resamples}
    sums = np.stack([seed.sums[-1] for seed in branches])
    law, exponent = binned_exponent(sums, rng=Resampling.EXPONENTS.rng(), **options)
    table, reference = energy_split(sums.sum(axis=0), law, edges[-1] / 2.0)
    slope, r_squared = cubic_r_squared(table["branch_length_m"] / reference, table["f"])
    end = _state_fit([seed.last for seed in branches], options)
    alone = [float(binned_exponent(seed[None], rng=None)[1].estimate) for seed in sums]
    fit = EnergySplitFit(
        exponent=exponent,
        confidence=confidence,
        amplitude=float(law.amplitude),
        reference_length=reference,
        exponent_of_each_seed=tuple(alone),
        mean_of_seed_exponents=float(np.mean(alone)),
        packings=packings,
        cubic_slope=slope,
        cubic_r_squared=r_squared,
        end=end,
        near_jamming=_first_state_fit(branches, paths, options),
        estimators=_estimators(branches, end, edges, options),
    )
    return {"length_low_m": edges[:-1], "length_high_m": edges[1:], **table}, fit


def _estimators(branches, end, edges, options):
    by_length = end.predictor("branch_length")
    found = dict.fromkeys(ESTIMATORS, UNKNOWN)
    if by_length is not None:
        found["gamma_regression"] = by_length.parameters["exponent"]
    # Without what rattlers hold, whose logarithms would weigh heavily.
    seeds, relative = [seed.last for seed in branches], 2.0 * edges / edges[-1]
    try:
        return found | binned_estimators(seeds, relative, **options)
    except FitError:
        return found


def _first_state_fit(branches, paths, options):
    row = named_states(paths[0]).get("near_jamming")
    if row is None:
        return None
    return _state_fit(
        [seed.first for seed in branches],
        options,
        state=int(paths[0]["state"].iloc[row]),
        solid_fraction=float(np.mean([path["solid_fraction"].iloc[row] for path in paths])),
    )


def _state_fit(seeds, options, **place):
    predictors = compared_predictors(seeds, **options)
    try:
        bend = curvature(seeds, **options)
    except FitError as error:
        bend = Curvature.without(str(error))
    return StateFit(predictors, bend, local_exponents=local_exponents(seeds, **options), **place)


def end_state(
    branches: Sequence[Branches], paths: Sequence[pd.DataFrame], jamming: float
) -> EndState:
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
        median_overlap_over_length=_median_overlap_over_length(branches, -1),
        coordination_number=float(ends["coordination_number"].mean()),
        mechanical_coordination_number=float(ends["mechanical_coordination_number"].mean()),
        rattler_fraction=float(ends["rattler_fraction"].mean()),
    )


def exponents_along_path(
    branches: Sequence[Branches],
    paths: Sequence[pd.DataFrame],
    jamming: float,
    *,
    confidence: float,
    resamples: int,
) -> pd.DataFrame:
    """Return the exponent of the energy split in every loaded state.

    Parameters
    ----------
    branches, paths, confidence, resamples
        As for `final_energy_split`.
    jamming : float
        Mean phi_J of the packings [-].

    Returns
    -------
    DataFrame
        A row for each state: state, solid_fraction, the same less phi_J, mean_stress_Pa,
        median_overlap_over_length, branches, exponent, exponent_low, exponent_high; nan where a
        state has too few branches for an exponent.
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
                "median_overlap_over_length": _median_overlap_over_length(branches, number),
                "branches": int(sums[:, 0].sum()),
                **exponent.named("exponent"),
            }
        )
    return pd.DataFrame(rows)


def _median_overlap_over_length(branches, number):
    ratios = np.concatenate([seed.overlap_over_length[number] for seed in branches])
    return float(np.median(ratios, overwrite_input=True)) if ratios.size else np.nan
