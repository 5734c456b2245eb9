"""Rule sharing: how grains and branches share energy, force and stress in all seeds of a sample."""

from collections.abc import Callable, Mapping, Sequence

import pandas as pd
from numpy.typing import NDArray

from branchcrush.energy.grain_size import EINAV, grain_energy_exponents
from branchcrush.energy.shielding_branches import branch_shielding, network_branches
from branchcrush.energy.shielding_grains import grain_shielding
from branchcrush.errors import FitError
from branchcrush.files.tables import no_data
from branchcrush.forces.distribution import force_network_result
from branchcrush.forces.fabric import fabric_result
from branchcrush.forces.stress import stress_sharing_result
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.network import Network, state_networks
from branchcrush.samples.ensemble import certified_loading, named_states
from branchcrush.samples.seed_contacts import sample_classes
from branchcrush.statistics.bins import bin_edges
from branchcrush.statistics.resampling import Resampling

TABLES = (
    "shielding_branches",
    "shielding_grains",
    "force_distribution",
    "force_by_length",
    "fabric",
    "stress_by_radius",
    "stress_sharing",
)


def sharing_results(
    grading: Grading,
    contact_exponent: float,
    certificate: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    read_seed: Callable[[int, Sequence[int]], tuple],
    *,
    bins: int,
    confidence: float,
    resamples: int,
) -> tuple[dict, dict]:
    """Return how a sample shares energy, force and stress, near jamming and at the end.

    Parameters
    ----------
    grading : Grading
        Target.
    contact_exponent : float
        1 for linear contacts, 3/2 for Hertz.
    certificate : DataFrame
        `certificate.csv`.
    paths : list of DataFrame
        The `path.csv` of each seed.
    read_seed : callable
        Takes the number of a seed, from 0, and the states wanted; returns radii, contacts with
        branch vectors and wall contacts as for `packings.network.state_networks`. Called for one
        seed after the other.
    bins : int
        Of branch length.
    confidence, resamples
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    tables : dict
        Each of `TABLES`; without a certified seed each says why.
    summary : dict
        Of `states_together`, or why there is none.
    """
    try:
        used, paths = certified_loading(certificate, paths)
    except FitError as error:
        table, summary = no_data(error)
        return dict.fromkeys(TABLES, table), summary
    rows = named_states(paths[0])
    states = {where: int(paths[0]["state"].iloc[row]) for where, row in rows.items()}
    networks: dict[str, list[Network]] = {where: [] for where in states}
    classes = None
    for number in used:
        packing = read_seed(number, list(states.values()))
        if classes is None:
            classes = sample_classes(grading, *packing, states["end"])
        for where, network in zip(states, state_networks(*packing, states.values()), strict=True):
            networks[where].append(network)
    edges = bin_edges(*grading.support(), bins)
    options = {"confidence": confidence, "resamples": resamples}
    shared = {
        (where, state): shared_in_state(
            networks[where], edges, classes, contact_exponent, **options
        )
        for where, state in states.items()
    }
    return states_together(shared)


def shared_in_state(
    networks: Sequence[Network],
    edges: NDArray,
    classes: NDArray,
    contact_exponent: float,
    *,
    confidence: float,
    resamples: int,
) -> tuple[dict[str, pd.DataFrame], dict]:
    """Return how the seeds of a sample share energy, force and stress in one state.

    Parameters
    ----------
    networks : list of packings.network.Network
        One a seed, with branch vectors.
    edges : array_like, shape (n+1,)
        Bins of branch length, from the smallest diameter to the largest [m].
    classes : array_like, shape (K+1,)
        Classes of radius, from `samples.seed_contacts.sample_classes` [m].
    contact_exponent : float
        1 for linear contacts, 3/2 for Hertz.
    confidence, resamples
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    tables : dict of DataFrame
        `TABLES`; shielding_branches only where the energies bear a power law.
    summary : dict
        shielding, forces, fabric and stress.
    """

    def drawn():
        """Return the options of an interval, at the beginning of the draws."""
        rng = Resampling.SHARING.rng()
        return {"confidence": confidence, "resamples": resamples, "rng": rng}

    tables, shielding = _shared_energy(networks, edges[-1] / 2.0, contact_exponent, drawn)
    of_forces, forces = force_network_result(networks, edges, **drawn())
    rows, fabric = fabric_result(
        [network.vector for network in networks],
        [network.force for network in networks],
        confidence=confidence,
    )
    of_fabric = {"fabric": pd.DataFrame(rows).rename_axis("seed_number").reset_index()}
    of_stress, stress = stress_sharing_result(networks, classes, **drawn())
    tables |= of_fabric | of_forces | of_stress
    summary = {"shielding": shielding, "forces": forces, "fabric": fabric, "stress": stress}
    return {name: pd.DataFrame(table) for name, table in tables.items()}, summary


def _shared_energy(networks, radius_max, contact_exponent, drawn):
    """Return the tables and the summary of shielding, by grain and by branch."""
    tables, summary = {}, {}
    tables["shielding_grains"], summary["grains"] = grain_shielding(
        networks, contact_exponent, **drawn()
    )
    try:
        branches = [network_branches(network, radius_max) for network in networks]
        tables["shielding_branches"], summary["branches"] = branch_shielding(branches, **drawn())
    except FitError as error:
        summary["branches"] = {"reason": str(error)}
    try:
        exponents = grain_energy_exponents(networks, contact_exponent, **drawn())
        summary["grain_energy"] = {**exponents, "einav": EINAV}
    except FitError as error:
        summary["grain_energy"] = {"reason": str(error)}
    return tables, summary


def states_together(shared: Mapping[tuple[str, int], tuple[dict, dict]]) -> tuple[dict, dict]:
    """Return the tables and summaries of some states together.

    Parameters
    ----------
    shared : dict
        What `shared_in_state` returns, by (name of the state, its number).

    Returns
    -------
    tables : dict of DataFrame
        Each of `TABLES`, with columns where and state in front; one without data says why.
    summary : dict
        By the names of the states, with their numbers.
    """
    tables = {}
    for name in TABLES:
        parts = [
            pd.DataFrame({"where": where, "state": state} | dict(part[name].items()))
            for (where, state), (part, _) in shared.items()
            if name in part
        ]
        reason = pd.DataFrame({"reason": ["the energies bear no power law of branch length"]})
        tables[name] = pd.concat(parts, ignore_index=True) if parts else reason
    summary = {
        where: {"state": state, **summary} for (where, state), (_, summary) in shared.items()
    }
    return tables, summary
