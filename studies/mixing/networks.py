"""Who touches whom in the mixtures, measured and by the models of contact numbers."""

from collections.abc import Iterator, Sequence
from functools import cache

import numpy as np
from along import SeedPath
from numpy.typing import NDArray
from pairs import Pair, Sample

from branchcrush.branches.contact_numbers import contact_number_table, contact_sums
from branchcrush.branches.coordination import Coordination
from branchcrush.branches.load_bearing import compressed_coordination, rod_contacts
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.parking import parking_contacts
from branchcrush.branches.predictions import distances, fine_edges, pair_shares
from branchcrush.branches.random_contacts import random_contact_shares
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading

# Elastic strains at which networks are compared: near jamming, and well beyond.
LEVELS = (0.02, 0.07)
CLASSES = 8
# Names of the models in tables.
EQ_4, PARKING, RODS, RODS_LOADED = "random_contact", "parking", "rods", "rods_compressed"


def network_rows(pair: Pair, sample: Sample, paths: Sequence[SeedPath]) -> Iterator[dict]:
    """Yield a row for each level and model: kappa, who carries load, and branch lengths."""
    edges = fine_edges(*sample.grading.support())
    _, share = grading_nodes(sample.grading)
    for level in LEVELS:
        networks = [path.nearest(level) for path in paths]
        counts = sum(np.histogram(network.length, edges)[0] for network in networks)
        bearing = np.mean([network.bearing.mean() for network in networks])
        kappa = np.mean([network.contacts.mean() for network in networks])
        for model, shares, coordination in _models(sample.grading, _strain(paths, level), edges):
            row = {
                "sample": sample.name,
                "pair": pair.name,
                "law": pair.law,
                "crushing": sample.crushing,
                "elastic_strain": level,
                "model": model,
                "coordination_number": kappa,
                "load_bearing_fraction": bearing,
            }
            if shares is not None:
                row["kolmogorov_smirnov"] = distances(counts, shares, edges)["kolmogorov_smirnov"]
            if coordination is not None:
                row["predicted_coordination_number"] = share @ coordination.contacts
                row["predicted_load_bearing_fraction"] = share @ coordination.load_bearing
            yield row


def size_rows(pair: Pair, sample: Sample, paths: Sequence[SeedPath]) -> Iterator[dict]:
    """Yield a row for each level and class of radius: c(R) and rattlers, measured and predicted."""
    low, high = sample.grading.support()
    edges = np.geomspace(low, high, CLASSES + 1)
    edges[[0, -1]] = low, high
    radius, share = grading_nodes(sample.grading)
    group = np.clip(np.searchsorted(edges, radius, side="right") - 1, 0, CLASSES - 1)
    number = np.bincount(group, share, CLASSES)
    for level in LEVELS:
        sums = [contact_sums(path.nearest(level), edges) for path in paths]
        table = contact_number_table(sums, edges, rng=np.random.default_rng(21))
        predicted = {}
        for model, _, coordination in _models(sample.grading, _strain(paths, level), None):
            if coordination is None:
                continue
            with np.errstate(invalid="ignore", divide="ignore"):
                for name, values in zip(
                    ("contact_number", "rattler_fraction"),
                    (coordination.contacts, 1.0 - coordination.load_bearing),
                    strict=True,
                ):
                    mean = np.bincount(group, share * values, CLASSES) / number
                    predicted[f"{name}_{model}"] = mean
        columns = table | predicted
        for place in np.flatnonzero(table["grains"]):
            yield {
                "sample": sample.name,
                "pair": pair.name,
                "law": pair.law,
                "crushing": sample.crushing,
                "elastic_strain": level,
                **{name: values[place] for name, values in columns.items()},
            }


def _strain(paths, level):
    """Return the mean strain from jamming of the states nearest to a level; nan if none tells."""
    strains = np.array([path.strain_near(level) for path in paths])
    known = strains[np.isfinite(strains)]
    return max(float(known.mean()), 0.0) if known.size else float("nan")


def _models(
    grading: Grading, strain: float, edges: NDArray | None
) -> Iterator[tuple[str, NDArray | None, Coordination | None]]:
    """Yield each model's name, its branch lengths and its contact numbers, None without."""
    if edges is not None:
        yield EQ_4, random_contact_shares(grading, edges), None
    radius, share = grading_nodes(grading)
    for model, coordination in (
        (PARKING, _parking(radius.tobytes(), share.tobytes())),
        (RODS, rod_contacts(radius, share)),
        (RODS_LOADED, _compressed(radius, share, strain)),
    ):
        if coordination is None or edges is None:
            yield model, None, coordination
        else:
            yield model, pair_shares(radius, share * coordination.contacts, edges), coordination


def _compressed(radius, share, strain):
    """Return the rods' contact numbers, None where the strain leaves no voids to rods."""
    try:
        return compressed_coordination(radius, share, strain)[0]
    except ValueError:
        return None


@cache
def _parking(radius: bytes, share: bytes) -> Coordination | None:
    """Return random parking's contact numbers, None without a solution; they take a second."""
    try:
        return parking_contacts(np.frombuffer(radius), np.frombuffer(share))
    except FitError:
        return None
