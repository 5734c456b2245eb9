"""Rule crushed_grains: who breaks, who survives, and how energy is split while grains break."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from branchcrush.packings.network import Network, state_network
from branchcrush.samples.crushed_exponents import (
    exponents_beside_control,
    load_by_radius,
    networks_of,
    overshoots,
)
from branchcrush.samples.crushed_grains_words import grains_sentences
from branchcrush.samples.crushed_roc import foretellers, grains_at_risk
from branchcrush.samples.crushed_survival import (
    first_grains,
    from_first_breakage,
    hazards,
    survival_curves,
    survivals,
)

# Of the crushing of a seed: path, grains, contacts, contacts with walls, breakages.
Run = tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame, pd.DataFrame, pd.DataFrame]
# Of its control: path, and what `packings.network.state_networks` takes.
Control = tuple[pd.DataFrame, Any, pd.DataFrame, pd.DataFrame]


class CrushedGrains(NamedTuple):
    """The result files of the grains of a crushing."""

    areas: pd.DataFrame  # crushed_predictors.csv
    curves: pd.DataFrame  # crushed_roc.csv
    hazards: pd.DataFrame  # crushed_hazards.csv
    survivors: pd.DataFrame  # crushed_survivors.csv
    survival: pd.DataFrame  # crushed_survival.csv
    exponents: pd.DataFrame  # crushed_exponents.csv
    loads: pd.DataFrame  # crushed_loads.csv
    overshoots: pd.DataFrame  # crushed_overshoots.csv
    summary: dict  # crushed_grains.json


def crushed_grains(
    seeds: Sequence[int],
    read_run: Callable[[int], Run],
    read_control: Callable[[int], Control],
    breakage: Mapping[str, Any],
    *,
    confidence: float,
    resamples: int,
) -> CrushedGrains:
    """Return who breaks and who survives in all seeds of a sample, and the energy split meanwhile.

    Parameters
    ----------
    seeds : list of int
    read_run, read_control : callable
        Take the number of a seed, from 0; called for one seed after the other.
    breakage : mapping
        The section `breakage` of the sample, in SI.
    confidence : float
    resamples : int
        Draws of the seeds.

    Returns
    -------
    CrushedGrains
        Tables of a crushing where no grain broke are empty, and the summary's sentences say so.
    """
    limit = breakage["smallest_diameter"]
    options = {"confidence": confidence, "resamples": resamples}
    at_risk, first, old, broken, networks, paths = [], [], [], [], [], []
    controls: list[dict[int, Network]] = []
    control_paths = []
    for number in range(len(seeds)):
        path, grains, contacts, walls, breakages = read_run(number)
        seed = grains_at_risk(grains, contacts, walls, limit)
        at_risk.append(seed)
        first.append(_first_of(seed, grains, path))
        states = [int(state) for state in path["state"] if state > 0]
        networks.append(networks_of(grains, contacts, walls, states))
        last = grains[grains["state"] == grains["state"].max()]
        old.append((last["generation"] == 0).to_numpy())
        broken.append(breakages)
        paths.append(path)
        control_path, radii, *tables = read_control(number)
        control_paths.append(control_path)
        controls.append(
            {
                int(state): state_network(radii, *tables, int(state))
                for state in control_path["state"]
                if state > 0
            }
        )
    areas, curves = foretellers(at_risk, **options)
    results = {
        "areas": areas,
        "curves": curves,
        "hazards": hazards(at_risk, limit, **options),
        "survivors": survivals(first, **options),
        "survival": survival_curves(first),
        "exponents": exponents_beside_control(networks, controls, paths, control_paths, **options),
        "loads": load_by_radius([of[max(of)] for of in networks], old, limit, **options),
        "overshoots": overshoots(broken, breakage["size_exponent"], limit, **options),
    }
    seen = int(sum(seed["broke"].sum() for seed in at_risk))
    summary = {
        "seeds": list(seeds),
        "comminution_limit_m": limit,
        "breakages": sum(map(len, broken)),
        "breakages_seen_in_a_state": seen,
    }
    summary["sentences"] = grains_sentences(summary, results)
    return CrushedGrains(**results, summary=summary)


def _first_of(seed: pd.DataFrame, grains: pd.DataFrame, path: pd.DataFrame) -> pd.DataFrame:
    """Return the first grains, with the contacts they had in the first loaded state of breaking."""
    begun = from_first_breakage(seed)
    loaded = path.loc[path["carries_load"].astype(str) == "True", "state"]
    states = np.intersect1d(begun["state"], loaded)
    state = states.min() if states.size else -1
    at = seed[seed["state"] == state].set_index("grain")["contacts"]
    return first_grains(grains, at, path.set_index("state")["solid_fraction"])
