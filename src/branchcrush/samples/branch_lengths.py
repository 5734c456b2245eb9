"""Rule branch_lengths: the branch lengths of all seeds of a sample, beside what predicts them."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.branches.lengths import branch_length_table, branch_statistics
from branchcrush.branches.predictions import (
    Prediction,
    binned_predictions,
    distances,
    fine_edges,
    lumped,
    mode_length,
    pair_shares,
    predictions,
)
from branchcrush.errors import FitError
from branchcrush.files.tables import no_data
from branchcrush.gradings.distribution import Grading
from branchcrush.samples.contact_numbers import (
    contact_number_rows,
    contact_number_summary,
    coordination_table,
)
from branchcrush.samples.ensemble import certified_loading, mean_path, named_states
from branchcrush.samples.rods import rods_along_path
from branchcrush.samples.seed_contacts import SeedContacts, SeedReader, sample_contacts
from branchcrush.statistics.bins import bin_edges
from branchcrush.statistics.resampling import Resampling, pooled_interval

_TABLES = ("table", "predictions", "numbers", "pairs", "coordination")
_RESULTS = ("statistics", "contact_numbers")


def branch_length_results(
    grading: Grading,
    certificate: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    jamming: pd.DataFrame,
    read_seed: SeedReader,
    *,
    bins: int,
    confidence: float,
    resamples: int,
) -> tuple[dict, dict]:
    """Return who touches whom along the loading, and the branch lengths, beside predictions.

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
        As for `samples.seed_contacts.sample_contacts`; called for one seed after the other.
    bins : int
        Of branch length.
    confidence, resamples
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    tables : dict
        table (`branches.lengths.branch_length_table`), predictions (`length_prediction_rows`),
        numbers and pairs (`samples.contact_numbers.contact_number_rows`) and coordination. Without
        a certified seed each says why.
    results : dict
        statistics (`branches.lengths.branch_statistics`) and contact_numbers
        (`samples.contact_numbers.contact_number_summary`), or why there are none.
    """
    options = {"confidence": confidence, "resamples": resamples}
    try:
        used, paths = certified_loading(certificate, paths)
    except FitError as error:
        table, result = no_data(error)
        return dict.fromkeys(_TABLES, table), dict.fromkeys(_RESULTS, result)
    seeds, classes = sample_contacts(grading, read_seed, used, paths[0]["state"].to_list())
    own_jamming = jamming["jamming_solid_fraction_loading"].iloc[used]
    path = mean_path(paths, own_jamming.mean())
    fine = fine_edges(*grading.support())
    models = predictions(grading, fine)
    rods = rods_along_path(grading, path)
    rows = length_prediction_rows(seeds, models, fine, path, **options)
    numbers, pairs = contact_number_rows(seeds, models, classes, path, **options)
    lengths, edges = [seed.length for seed in seeds], bin_edges(*grading.support(), bins)
    tables = (
        branch_length_table(lengths, grading, edges, binned_predictions(models, edges)),
        rows,
        numbers,
        pairs,
        coordination_table(seeds, paths, own_jamming).merge(rods, on="state"),
    )
    statistics = branch_statistics(
        [seed.radius for seed in seeds],
        lengths,
        [path["volume_m3"].iloc[-1] for path in paths],
        [path["coordination_number"].iloc[-1] for path in paths],
        grading,
    )
    summary = contact_number_summary(seeds, models, rows, path, **options)
    for where, number in named_states(path).items():
        summary[where] |= rods.drop(columns="state").iloc[number].to_dict()
    return (
        dict(zip(_TABLES, tables, strict=True)),
        dict(zip(_RESULTS, (statistics, summary), strict=True)),
    )


def length_prediction_rows(
    seeds: Sequence[SeedContacts],
    models: Mapping[str, Prediction],
    edges: NDArray,
    path: pd.DataFrame,
    *,
    confidence: float,
    resamples: int,
) -> list[dict]:
    """Return how far every prediction of the branch lengths is off, in each state.

    Parameters
    ----------
    seeds : list of SeedContacts
    models : dict of Prediction
        From `branches.predictions.predictions`, in the narrow bins.
    edges : array_like, shape (n+1,)
        These bins, from `branches.predictions.fine_edges` [m].
    path : DataFrame
        From `samples.ensemble.mean_path`, of the same states.
    confidence, resamples
        Of the interval of the measured mean.

    Returns
    -------
    list of dict
        A row for each state and prediction. `configuration` draws both ends by the contact numbers
        measured in that state; the others know the grading alone.
    """
    predicted = {name: model.shares for name, model in models.items()}
    middle = (edges[:-1] + edges[1:]) / 2.0
    radius = np.concatenate([seed.radius for seed in seeds])
    order = np.argsort(radius, kind="stable")
    rows = []
    for number, state in enumerate(path.to_dict("records")):
        counts = np.array([seed.lengths[number] for seed in seeds])
        mean = pooled_interval(
            np.stack([counts @ middle, counts.sum(axis=1)], axis=1),
            lambda totals: totals[:, 0] / totals[:, 1],
            confidence=confidence,
            resamples=resamples,
            rng=Resampling.CONTACTS.rng(),
        )
        total = counts.sum(axis=0)
        measured = {
            **state,
            "branches": int(total.sum()),
            "measured_mean_length_m": mean.estimate,
            "measured_mean_length_low_m": mean.low,
            "measured_mean_length_high_m": mean.high,
            "measured_mode_length_m": mode_length(total, edges),
        }
        contacts = np.concatenate([seed.contacts[number] for seed in seeds])
        by_number = pair_shares(*lumped(radius, contacts, order=order), edges)
        rows += [
            {**measured, "prediction": name, **distances(total, shares, edges)}
            for name, shares in ({"configuration": by_number} | predicted).items()
        ]
    return rows
