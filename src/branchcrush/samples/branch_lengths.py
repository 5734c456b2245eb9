"""The contacts of all seeds of a sample: who touches whom, beside what models predict."""

from typing import NamedTuple

import numpy as np
import pandas as pd

from branchcrush.branches.contact_numbers import (
    ContactSums,
    assortativity,
    contact_number_table,
    contact_sums,
    pair_table,
    radius_classes,
)
from branchcrush.branches.coordination_laws import isostatic_number
from branchcrush.branches.predictions import (
    distances,
    fine_edges,
    lumped,
    mode_length,
    pair_shares,
)
from branchcrush.packings.network import state_network, state_networks
from branchcrush.samples.ensemble import named_states
from branchcrush.statistics.bins import bin_numbers
from branchcrush.statistics.intervals import Resampling, pooled_interval


class SeedContacts(NamedTuple):
    """What is kept of the contacts of one seed in some of its states."""

    radius: np.ndarray  # of the grains, shape (N,) [m]
    contacts: list[np.ndarray]  # of each grain, in each state
    lengths: np.ndarray  # branches in narrow bins, shape (states, n)
    sums: list[ContactSums]  # of each state
    length: np.ndarray  # R_i + R_j of every branch of the last state [m]
    isostatic: np.ndarray  # `branches.coordination_laws.isostatic_number` of each state


def sample_classes(grading, radii, contacts, walls, state):
    """Return the classes of radius of a sample, from one of its packings.

    Parameters
    ----------
    grading : Grading
    radii, contacts, walls, state
        As for `packings.network.state_network`.

    Returns
    -------
    ndarray, shape (K+1,)
        Edges, from the smallest to the largest radius of the grading [m].
    """
    network = state_network(radii, contacts, walls, state)
    classes = radius_classes(network.radius, network.contacts)
    smallest, largest = grading.support()
    inner = classes[1:-1]
    inner = inner[(inner > smallest) & (inner < largest)]
    return np.concatenate([[smallest], inner, [largest]])


def seed_contacts(grading, classes, radii, contacts, walls, states):
    """Return what the results of a sample need of the contacts of one seed.

    Parameters
    ----------
    grading : Grading
    classes : array_like, shape (K+1,)
        From `sample_classes` [m].
    radii, contacts, walls
        As for `packings.network.state_network`.
    states : array_like of int

    Returns
    -------
    SeedContacts
    """
    edges = fine_edges(*grading.support())
    numbers, lengths, sums, isostatic = [], [], [], []
    for network in state_networks(radii, contacts, walls, states):
        numbers.append(network.contacts)
        lengths.append(np.histogram(network.length, edges)[0])
        sums.append(contact_sums(network, classes))
        isostatic.append(isostatic_number(network))
    return SeedContacts(
        np.asarray(radii), numbers, np.array(lengths), sums, network.length, np.array(isostatic)
    )


def coordination_table(seeds, paths, jamming):
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


def length_prediction_rows(seeds, models, edges, path, *, confidence, resamples):
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
    rows = []
    for number, state in enumerate(path.to_dict("records")):
        counts = np.array([seed.lengths[number] for seed in seeds])
        mean = pooled_interval(
            np.stack([counts @ middle, counts.sum(axis=1)], axis=1),
            lambda x: x[:, 0] / x[:, 1],
            confidence=confidence,
            resamples=resamples,
            rng=Resampling.CONTACTS.rng(),
        )
        total = counts.sum(axis=0)
        contacts = np.concatenate([seed.contacts[number] for seed in seeds])
        measured = pair_shares(*lumped(radius, contacts), edges)
        for name, shares in ({"configuration": measured} | predicted).items():
            found = distances(total, shares, edges)
            rows.append(
                {
                    **state,
                    "branches": int(total.sum()),
                    "measured_mean_length_m": mean.estimate,
                    "measured_mean_length_low_m": mean.low,
                    "measured_mean_length_high_m": mean.high,
                    "measured_mode_length_m": mode_length(total, edges),
                    "prediction": name,
                    "kolmogorov_smirnov": found["kolmogorov_smirnov"],
                    "mean_length_m": found["mean_length_m"],
                    "mode_length_m": found["mode_length_m"],
                }
            )
    return rows


def contact_number_rows(seeds, models, classes, path, *, confidence, resamples):
    """Return the contact numbers by radius, near jamming and at the end, beside the models'.

    Parameters
    ----------
    seeds, models, path, confidence, resamples
        As for `length_prediction_rows`.
    classes : array_like, shape (K+1,)
        From `sample_classes` [m].

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
    found = {}
    for name, model in models.items():
        if not model.radius.size:  # Eq. 4 has no contact numbers
            continue
        group = bin_numbers(model.radius, classes)
        grains, contacts = (
            np.bincount(group, weight, minlength=len(classes) - 1)
            for weight in (model.share, model.share * model.contacts)
        )
        with np.errstate(invalid="ignore"):
            found[f"contact_number_{name}"] = contacts / grains
    return found


def touching_summary(seeds, models, rows, path, *, confidence, resamples):
    """Return the numbers of who touches whom, near jamming and at the end.

    Parameters
    ----------
    seeds, models, path, confidence, resamples
        As for `length_prediction_rows`.
    rows : list of dict
        From there.

    Returns
    -------
    dict
        near_jamming (only where there is more than one state) and end, each with the state, its
        coordination number, assortativity of radii and of their logarithms with intervals, and
        distances of the predictions; and what the models say of coordination number and rattlers
        at the jamming point.
    """
    summary = {"seeds": len(seeds)}
    for where, number in named_states(path).items():
        state = path.iloc[number]
        sums = [seed.sums[number] for seed in seeds]
        rng = Resampling.CONTACTS.rng()
        alike = assortativity(sums, confidence=confidence, resamples=resamples, rng=rng)
        grains = sum(seed.grains.sum() for seed in sums)
        here = [row for row in rows if row["state"] == state["state"]]
        summary[where] = {
            "state": int(state["state"]),
            "solid_fraction": float(state["solid_fraction"]),
            "solid_fraction_above_jamming": float(state["solid_fraction_above_jamming"]),
            "coordination_number": float(sum(s.contacts.sum() for s in sums) / grains),
            "rattler_fraction": float(1.0 - sum(s.bearing.sum() for s in sums) / grains),
            "mean_length_m": here[0]["measured_mean_length_m"],
            "mode_length_m": here[0]["measured_mode_length_m"],
            **alike.part(0).named("assortativity_of_radii"),
            **alike.part(1).named("assortativity_of_log_radii"),
            "predictions": [
                {
                    "name": row["prediction"],
                    "kolmogorov_smirnov": row["kolmogorov_smirnov"],
                    "mean_length_m": row["mean_length_m"],
                    "mode_length_m": row["mode_length_m"],
                }
                for row in here
            ],
        }
    summary["models"] = [
        {
            "name": name,
            "coordination_number": float(model.share @ model.contacts),
            "rattler_fraction": float(1.0 - model.share @ model.load_bearing),
        }
        for name, model in models.items()
        if model.radius.size
    ]
    return summary
