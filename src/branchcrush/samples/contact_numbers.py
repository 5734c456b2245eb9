"""Contact numbers by radius of all seeds of a sample, beside what models say of them."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from branchcrush.branches.contact_numbers import (
    assortativity,
    contact_number_table,
    pair_table,
)
from branchcrush.branches.coordination_models import MODELS
from branchcrush.branches.predictions import Prediction
from branchcrush.samples.ensemble import named_states
from branchcrush.samples.seed_contacts import SeedContacts
from branchcrush.statistics.bins import bin_numbers
from branchcrush.statistics.resampling import Resampling


def coordination_table(
    seeds: Sequence[SeedContacts], paths: Sequence[pd.DataFrame], jamming: ArrayLike
) -> pd.DataFrame:
    """Return the coordination numbers of every seed in every state, for all of its kinds.

    Parameters
    ----------
    seeds : list of SeedContacts
    paths : list of DataFrame
        From `samples.ensemble.certified_loading`, of the same seeds and states.
    jamming : array_like
        phi_J of each of these seeds, nan where it is unknown [-].

    Returns
    -------
    DataFrame
        seed_number (of those used, from 0), state, solid_fraction, void_ratio,
        coordination_number, mechanical_coordination_number, rattler_fraction;
        solid_fraction_above_jamming, of its own phi_J; isostatic_number.
    """
    columns = [
        "state",
        "solid_fraction",
        "void_ratio",
        "coordination_number",
        "mechanical_coordination_number",
        "rattler_fraction",
    ]
    parts = [
        path[columns].assign(
            seed_number=number,
            solid_fraction_above_jamming=path["solid_fraction"] - point,
            isostatic_number=seed.isostatic,
        )
        for number, (seed, path, point) in enumerate(zip(seeds, paths, jamming, strict=True))
    ]
    return pd.concat(parts, ignore_index=True)


def contact_number_rows(
    seeds: Sequence[SeedContacts],
    models: Mapping[str, Prediction],
    classes: ArrayLike,
    path: pd.DataFrame,
    *,
    confidence: float,
    resamples: int,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return the contact numbers by radius, near jamming and at the end, beside the models'.

    Parameters
    ----------
    seeds, models, path, confidence, resamples
        As for `samples.branch_lengths.length_prediction_rows`.
    classes : array_like, shape (K+1,)
        From `samples.seed_contacts.sample_classes` [m].

    Returns
    -------
    numbers, pairs : DataFrame
        From `branches.contact_numbers.contact_number_table`, with contact_number_<model> of each
        class at the jamming point; and `branches.contact_numbers.pair_table`. Both with the state.
    """
    predicted = _model_classes(models, classes)
    numbers, pairs = [], []
    for number in named_states(path).values():
        state = int(path["state"].iloc[number])
        sums = [seed.sums[number] for seed in seeds]
        table = contact_number_table(
            sums,
            classes,
            confidence=confidence,
            resamples=resamples,
            rng=Resampling.CONTACTS.rng(),
        )
        numbers.append(pd.DataFrame({"state": state, **table, **predicted}))
        pairs.append(pd.DataFrame({"state": state, **pair_table(sums, classes)}))
    return pd.concat(numbers, ignore_index=True), pd.concat(pairs, ignore_index=True)


def _model_classes(models, classes):
    """Return the contact number of each class by each model, nan where a class has no node."""
    predicted = {}
    for name, model in models.items():
        if not model.radius.size:  # Eq. 4 has no contact numbers
            continue
        group = bin_numbers(model.radius, classes)
        grains, contacts = (
            np.bincount(group, weight, minlength=len(classes) - 1)
            for weight in (model.share, model.share * model.contacts)
        )
        with np.errstate(invalid="ignore"):
            predicted[f"contact_number_{name}"] = contacts / grains
    return predicted


def contact_number_summary(
    seeds: Sequence[SeedContacts],
    models: Mapping[str, Prediction],
    rows: Sequence[dict],
    path: pd.DataFrame,
    *,
    confidence: float,
    resamples: int,
) -> dict:
    """Return the numbers of who touches whom, near jamming and at the end.

    Parameters
    ----------
    seeds, models, path, confidence, resamples
        As for `samples.branch_lengths.length_prediction_rows`.
    rows : list of dict
        From there.

    Returns
    -------
    dict
        seeds; near_jamming (only where there is more than one state) and end, each with the state,
        its coordination number, assortativity of radii and of their logarithms with intervals, and
        distances of the predictions; and what the models say of coordination number and rattlers
        at the jamming point, with the name of the solution where a model may have more, and what
        the next one would say.
    """
    summary: dict = {"seeds": len(seeds)}
    for where, number in named_states(path).items():
        state = path.iloc[number]
        summary[where] = _of_state(
            state,
            [seed.sums[number] for seed in seeds],
            [row for row in rows if row["state"] == state["state"]],
            {"confidence": confidence, "resamples": resamples},
        )
    summary["models"] = [
        {"name": name, **_said(model.share, model), **_solutions(name, model)}
        for name, model in models.items()
        if model.radius.size
    ]
    return summary


def _said(share, coordination):
    return {
        "coordination_number": float(share @ coordination.contacts),
        "rattler_fraction": float(1.0 - share @ coordination.load_bearing),
    }


def _solutions(name, model):
    """Return which of its solutions a model gives, and what the next one would say."""
    solve = MODELS[name].solutions
    if solve is None:
        return {}
    first, *others = solve(model.radius, model.share)
    row = {"solution": first.name}
    for other in others[:1]:
        said = _said(model.share, other.coordination)
        row |= {f"other_{name}": value for name, value in said.items()}
    return row


def _of_state(state, sums, rows, options):
    alike = assortativity(sums, **options, rng=Resampling.CONTACTS.rng())
    grains = sum(seed.grains.sum() for seed in sums)
    return {
        "state": int(state["state"]),
        "solid_fraction": float(state["solid_fraction"]),
        "solid_fraction_above_jamming": float(state["solid_fraction_above_jamming"]),
        "coordination_number": float(sum(seed.contacts.sum() for seed in sums) / grains),
        "rattler_fraction": float(1.0 - sum(seed.bearing.sum() for seed in sums) / grains),
        "mean_length_m": rows[0]["measured_mean_length_m"],
        "mode_length_m": rows[0]["measured_mode_length_m"],
        **alike.part(0).named("assortativity_of_radii"),
        **alike.part(1).named("assortativity_of_log_radii"),
        "predictions": [
            {
                "name": row["prediction"],
                "kolmogorov_smirnov": row["kolmogorov_smirnov"],
                "mean_length_m": row["mean_length_m"],
                "mode_length_m": row["mode_length_m"],
            }
            for row in rows
        ],
    }
