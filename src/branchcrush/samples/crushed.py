"""Rule crushing_results: the results of a sample's crushing, all seeds together."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from branchcrush.errors import FitError
from branchcrush.gradings.mixtures import from_radii
from branchcrush.samples.crushed_forms import beside_forms, no_forms, pooled_law
from branchcrush.samples.crushed_gradings import crushed_gradings, stages_of
from branchcrush.samples.crushed_lengths import crushed_lengths, length_counts
from branchcrush.samples.crushed_line import compression_line
from branchcrush.samples.crushed_means import crushed_means, per_volume
from branchcrush.samples.crushed_path import control_law, crushed_path
from branchcrush.samples.crushed_sizes import Crushable
from branchcrush.samples.crushed_words import crushing_sentences, end_of, energy_summary
from branchcrush.samples.measured import EXPONENT

# Before the tables of seeds go together: path, grains, and branch lengths of a crushing.
Crushing = Callable[[], tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]]


class CrushedResults(NamedTuple):
    """The result files of a crushing."""

    states: pd.DataFrame  # crushing_states.csv
    means: pd.DataFrame  # crushing_means.csv
    gradings: pd.DataFrame  # crushing_gradings.csv
    lengths: pd.DataFrame  # crushing_lengths.csv
    line: pd.DataFrame  # crushing_line.csv
    beside: pd.DataFrame  # crushing_beside_forms.csv
    summary: dict  # crushing.json


def crushed_results(
    runs: Mapping[int, Crushing],
    halved: Mapping[int, Crushing],
    controls: Mapping[int, pd.DataFrame],
    sample: Crushable,
    settings: Mapping[str, Any],
    intervals: Mapping[str, Any],
) -> CrushedResults:
    """Return what the crushing of a sample shows, beside its laws and the forms of the model.

    Parameters
    ----------
    runs, halved : mapping of int to callable
        By seed what reads `path.csv`, `grains.parquet` and `contacts.parquet` of its crushing, in
        turn with whole and half strain steps; the contacts of two are never held together.
    controls : mapping of int to DataFrame
        `path.csv` of the same packings whose grains do not break.
    sample : Crushable
    settings : mapping
        hardening_exponent and rod_gap of the section thermodynamics, and exponent, n of the energy
        split.
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    CrushedResults
    """
    parts, grains, counted = [], {}, {}
    for half, group in ((False, runs), (True, halved)):
        for seed, read in group.items():
            path, of_state, branches = read()
            rows = crushed_path(path, of_state, branches, controls[seed], sample)
            parts.append(rows.assign(seed=seed, halved_step=half))
            if not half:
                grains[seed], counted[seed] = of_state, length_counts(branches, of_state)
    states = per_volume(pd.concat(parts, ignore_index=True))
    states = states[["seed", "halved_step", *states.columns.drop(["seed", "halved_step"])]]
    means = crushed_means(states, intervals)
    stages = stages_of(states)
    line, summary = compression_line(states, controls, sample, intervals)
    firsts = [rows.loc[rows["state"] == 0, "radius_m"] for rows in grains.values()]
    lengths, of_branches = crushed_lengths(counted, grains, states, stages, intervals)
    beside, said = _beside(means, firsts, controls, summary, sample, settings)
    summary = {
        "comminution_limit_m": sample.limit,
        "size_exponent": sample.size_exponent,
        "ultimate_alpha": sample.ultimate_alpha,
        "contact_law": "linear" if sample.law.exponent == 1.0 else "hertz",
        "seeds": sorted(runs),
        "halved_seeds": sorted(halved),
        "stages": stages,
        **end_of(states, intervals),
        **of_branches,
        **energy_summary(states, intervals),
        **summary,
    }
    sentences = crushing_sentences(summary, states)
    summary = {**summary, "sentences": sentences, "form_sentences": said}
    gradings = crushed_gradings(grains, states, stages, sample, intervals)
    return CrushedResults(states, means, gradings, lengths, line, beside, summary)


def read_crushing(
    read: Callable[..., pd.DataFrame], path: str, grains: str, contacts: str
) -> tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame]:
    """Return the tables of one crushing that its results need, and of them what they need.

    Parameters
    ----------
    read : callable
        `files.tables.read_table`.
    path, grains, contacts : str
        Files.

    Returns
    -------
    tuple of DataFrame
    """
    return (
        read(path),
        read(grains, columns=["state", "radius_m"]),
        read(contacts, columns=["state", "branch_length_m"]),
    )


def _beside(
    means: pd.DataFrame,
    firsts: Sequence[pd.Series],
    controls: Mapping[int, pd.DataFrame],
    line: Mapping[str, Any],
    sample: Crushable,
    settings: Mapping[str, Any],
) -> tuple[pd.DataFrame, list[str]]:
    """Return the table of the forms, or an empty one with why."""
    onset = line["elastic_strain_scale"]
    try:
        if not np.isfinite(onset):
            raise FitError("no packing yields, so none is given its critical energy")
        law = pooled_law([control_law(path, sample.law) for path in controls.values()])
    except FitError as error:
        return no_forms(), [f"No form of the model is drawn: {error}."]
    here, first = means[~means["halved_step"]], from_radii(np.concatenate(firsts))
    if np.isfinite(settings["exponent"]):
        return beside_forms(here, first, law, onset, sample, settings)
    table, said = beside_forms(here, first, law, onset, sample, {**settings, "exponent": EXPONENT})
    return table, [f"n of the energy split is not known; the forms take {EXPONENT:g}.", *said]
