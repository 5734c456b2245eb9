"""The energy split along the crushing, who carries load by size, and strengths at breaking."""

import itertools
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from branchcrush.energy.designs import prepared
from branchcrush.energy.predictors import PREDICTORS, branch_columns
from branchcrush.errors import FitError
from branchcrush.packings.network import Network, state_network
from branchcrush.statistics.gamma_regression import gamma_fit, parameter_intervals
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import Resampling, pooled_interval

_UNKNOWN = Interval(np.nan, np.nan, np.nan)
# Fewer branches than this in a state of all seeds bear no exponent.
_FEWEST = 100
# States of both have the same strain steps: their solid fractions differ by rounding alone.
_EQUAL = 1e-6


def exponent_of(networks: Sequence[Network], *, confidence: float, resamples: int) -> Interval:
    """Return n of the energy split E ~ l^n of some networks, all branches alike.

    Parameters
    ----------
    networks : list of Network
        One a seed.
    confidence : float
    resamples : int

    Returns
    -------
    Interval
        [-]; nan where the branches are too few, or all of one length.
    """
    if sum(network.i.size for network in networks) < _FEWEST:
        return _UNKNOWN
    largest = max(network.radius.max() for network in networks)
    columns = [branch_columns(n.radius_i, n.radius_j, n.energy, largest) for n in networks]
    design, made = prepared(PREDICTORS["branch_length"].design, columns)
    try:
        fit = gamma_fit(made, design)
        limits = parameter_intervals(
            fit, rng=Resampling.EXPONENTS.rng(), confidence=confidence, resamples=resamples
        )
    except FitError:
        return _UNKNOWN
    return limits.part(1)


def networks_of(
    grains: pd.DataFrame, contacts: pd.DataFrame, walls: pd.DataFrame, states: Sequence[int]
) -> dict[int, Network]:
    """Return the network of each of some states, with the radii of its own grains.

    Parameters
    ----------
    grains, contacts, walls : DataFrame
        `grains.parquet`, `contacts.parquet` and `wall_contacts.parquet` of a seed's crushing.
    states : list of int

    Returns
    -------
    dict of int to Network
    """
    radii = dict(tuple(grains.groupby("state")["radius_m"]))
    return {
        state: state_network(radii[state].to_numpy(), contacts, walls, state) for state in states
    }


def exponents_beside_control(
    crushed: Sequence[Mapping[int, Network]],
    controls: Sequence[Mapping[int, Network]],
    paths: Sequence[pd.DataFrame],
    control_paths: Sequence[pd.DataFrame],
    *,
    confidence: float,
    resamples: int,
) -> pd.DataFrame:
    """Return n in every loaded state of the crushing that all seeds have, beside the control's.

    Parameters
    ----------
    crushed, controls : list of mapping of int to Network
        Of each seed, by state.
    paths, control_paths : list of DataFrame
        The `path.csv` of each seed; the control's grains do not break.
    confidence : float
    resamples : int

    Returns
    -------
    DataFrame
        state, solid_fraction, broken_mass_fraction, branches, and of both (``control_...`` of the
        control): exponent with its limits, coordination_number, mechanical_coordination_number,
        rattler_fraction. The control's are nan where it has no state of equal solid fraction.
    """
    options = {"confidence": confidence, "resamples": resamples}
    shared = set.intersection(*(_loaded(path) for path in paths)) & set.intersection(
        *(set(seed) for seed in crushed)
    )
    rows = []
    for state in sorted(shared):
        at = pd.DataFrame([path[path["state"] == state].iloc[0] for path in paths])
        networks = [seed[state] for seed in crushed]
        row = {
            "state": state,
            "solid_fraction": at["solid_fraction"].astype(float).mean(),
            "broken_mass_fraction": at["broken_mass_fraction"].astype(float).mean(),
            "branches": sum(network.i.size for network in networks),
            **exponent_of(networks, **options).named("exponent"),
            **_coordination(at, ""),
        }
        beside = [
            _equal(path, phi)
            for path, phi in zip(control_paths, at["solid_fraction"].astype(float), strict=True)
        ]
        if all(one is not None for one in beside):
            kept = [seed[int(one["state"])] for seed, one in zip(controls, beside, strict=True)]
            row |= exponent_of(kept, **options).named("control_exponent")
            row |= _coordination(pd.DataFrame(beside), "control_")
        rows.append(row)
    return pd.DataFrame(rows)


def _loaded(path: pd.DataFrame) -> set[int]:
    carries = path["carries_load"].astype(str) == "True"
    return set(path.loc[carries & (path["leg"] == "loading"), "state"].astype(int))


def _equal(path: pd.DataFrame, phi: float) -> pd.Series | None:
    loading = path[path["leg"] == "loading"] if "leg" in path else path
    off = np.abs(loading["solid_fraction"].astype(float) - phi)
    return loading.loc[off.idxmin()] if off.min() < _EQUAL else None


def _coordination(at: pd.DataFrame, prefix: str) -> dict[str, float]:
    names = ("coordination_number", "mechanical_coordination_number", "rattler_fraction")
    return {prefix + name: float(at[name].astype(float).mean()) for name in names}


def load_by_radius(
    networks: Sequence[Network],
    first: Sequence[np.ndarray],
    limit: float,
    *,
    confidence: float,
    resamples: int,
) -> pd.DataFrame:
    """Return how grains carry load by their diameter over the limit, classes of a doubling each.

    Parameters
    ----------
    networks : list of Network
        One a seed, of one state.
    first : list of ndarray of bool
        Which grains of each are first grains.
    limit : float
        Comminution limit [m].
    confidence : float
    resamples : int

    Returns
    -------
    DataFrame
        low, high (diameter over the limit), kind ("first grains" or "fragments"), grains, and each
        with its limits: rattlers (share), contacts (mean per grain), largest_force_N (mean of the
        grains that bear load).
    """
    largest = max(2.0 * network.radius.max() for network in networks) / limit
    least = min(2.0 * network.radius.min() for network in networks) / limit
    edges = 2.0 ** np.arange(np.floor(np.log2(least)), np.floor(np.log2(largest)) + 2.0)
    rows = []
    for kind in ("first grains", "fragments"):
        sums = np.stack(
            [
                _load_sums(network, old if kind == "first grains" else ~old, edges, limit)
                for network, old in zip(networks, first, strict=True)
            ]
        )
        with np.errstate(invalid="ignore", divide="ignore"):
            # Rattlers, contacts, and the largest force of those that bear, each over its number.
            of_all = pooled_interval(
                sums,
                lambda x: x[:, [1, 2, 4]] / x[:, [0, 0, 3]],
                confidence=confidence,
                resamples=resamples,
                rng=Resampling.CRUSHED_GRAINS.rng(),
            )
        number = sums.sum(axis=0)[0].astype(int)
        rows += [
            {
                "low": edges[k],
                "high": edges[k + 1],
                "kind": kind,
                "grains": number[k],
                **of_all.part((0, k)).named("rattlers"),
                **of_all.part((1, k)).named("contacts"),
                "largest_force_N": of_all.estimate[2, k],
                "largest_force_low_N": of_all.low[2, k],
                "largest_force_high_N": of_all.high[2, k],
            }
            for k in np.flatnonzero(number)
        ]
    return pd.DataFrame(rows)


def _load_sums(network, kept, edges, limit):
    place = np.digitize(2.0 * network.radius / limit, edges) - 1
    largest = np.zeros(network.radius.size)
    for ends in (network.i, network.j):
        np.maximum.at(largest, ends, network.force)
    np.maximum.at(largest, network.wall_grain, network.wall_force)
    contacts = network.contacts + network.wall_contacts
    bearing = network.bearing
    weights = (np.ones_like(largest), ~bearing, contacts, bearing, largest * bearing)
    return np.array(
        [np.bincount(place[kept], np.asarray(one, float)[kept], len(edges) - 1) for one in weights]
    )


def overshoots(
    seeds: Sequence[pd.DataFrame],
    grown_from: float,
    limit: float,
    *,
    confidence: float,
    resamples: int,
) -> pd.DataFrame:
    r"""Return how far the stress at breaking is above the strength, by diameter over the limit.

    .. math:: \mathrm{overshoot} = \sigma/\sigma_c - 1

    Parameters
    ----------
    seeds : list of DataFrame
        `breakages.parquet` of each seed.
    grown_from : float
        Size exponent b of the strength asked for [-].
    limit : float
        Comminution limit [m].
    confidence : float
    resamples : int

    Returns
    -------
    DataFrame
        low, high, breakages, mean_overshoot with its limits, median_overshoot, overshoot_90,
        below (grains that broke below their strength), size_exponent_asked.
    """
    together = pd.concat(seeds, ignore_index=True)
    if not len(together):
        return pd.DataFrame(columns=["low", "high", "breakages"])
    top = np.log2(2.0 * together["radius_m"].max() / limit)
    edges = np.append(2.0 ** np.arange(np.floor(top) + 2.0), np.inf)
    edges = np.concatenate([[1.0], edges[edges > 1.0]])
    rows = []
    for low, high in [(1.0, np.inf), *itertools.pairwise(edges)]:
        of = []
        for seed in seeds:
            inside = (2.0 * seed["radius_m"] / limit).between(low, high, "left")
            of.append((seed["stress_Pa"] / seed["strength_Pa"] - 1.0)[inside].to_numpy())
        every = np.concatenate(of)
        if not every.size:
            continue
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = pooled_interval(
                [[one.sum(), one.size] for one in of],
                lambda x: x[:, 0] / x[:, 1],
                confidence=confidence,
                resamples=resamples,
                rng=Resampling.CRUSHED_GRAINS.rng(),
            )
        rows.append(
            {
                "low": low,
                "high": high,
                "breakages": every.size,
                **mean.named("mean_overshoot"),
                "median_overshoot": np.median(every),
                "overshoot_90": np.quantile(every, 0.9),
                "below": int((every < 0.0).sum()),
                "size_exponent_asked": grown_from,
            }
        )
    return pd.DataFrame(rows)
