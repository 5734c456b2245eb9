"""What the contact networks of a sample share: energy by grain and branch, forces, and stress."""

import pandas as pd

from branchcrush.energy.grain_size import EINAV, grain_energy_exponents
from branchcrush.energy.shielding_branches import branch_shielding, network_branches
from branchcrush.energy.shielding_grains import grain_shielding
from branchcrush.errors import FitError
from branchcrush.forces.distribution import force_network_result
from branchcrush.forces.fabric import fabric_result
from branchcrush.forces.stress import stress_sharing_result
from branchcrush.statistics.intervals import Resampling

TABLES = (
    "shielding_branches",
    "shielding_grains",
    "force_distribution",
    "force_by_length",
    "fabric",
    "stress_by_radius",
    "stress_sharing",
)


def shared_in_state(networks, edges, classes, contact_exponent, *, confidence, resamples):
    """Return how the seeds of a sample share energy, force and stress in one state.

    Parameters
    ----------
    networks : list of networks.Network
        One a seed, with branch vectors.
    edges : array_like, shape (n+1,)
        Bins of branch length, from the smallest diameter to the largest [m].
    classes : array_like, shape (K+1,)
        Classes of radius, from `samples.branch_lengths.sample_classes` [m].
    contact_exponent : float
        1 for linear contacts, 3/2 for Hertz.
    confidence, resamples
        As for `statistics.intervals.pooled_interval`.

    Returns
    -------
    tables : dict of DataFrame
        `TABLES`; shielding_branches only where the energies bear a power law.
    summary : dict
        shielding, forces, fabric and stress.
    """
    options = {"confidence": confidence, "resamples": resamples}

    def drawn():
        return {**options, "rng": Resampling.SHARING.rng()}

    tables, shielding = {}, {}
    tables["shielding_grains"], shielding["grains"] = grain_shielding(
        networks, contact_exponent, **drawn()
    )
    try:
        branches = [network_branches(network, edges[-1] / 2.0) for network in networks]
        tables["shielding_branches"], shielding["branches"] = branch_shielding(branches, **drawn())
    except FitError as error:
        shielding["branches"] = {"reason": str(error)}
    try:
        shielding["grain_energy"] = {
            **grain_energy_exponents(networks, contact_exponent, **drawn()),
            "einav": EINAV,
        }
    except FitError as error:
        shielding["grain_energy"] = {"reason": str(error)}

    of_forces, forces = force_network_result(networks, edges, **drawn())
    rows, fabric = fabric_result(
        [network.vector for network in networks],
        [network.force for network in networks],
        confidence=confidence,
    )
    tables["fabric"] = pd.DataFrame(rows).rename_axis("seed_number").reset_index()

    of_stress, stress = stress_sharing_result(networks, classes, **drawn())
    summary = {
        "shielding": shielding,
        "forces": forces,
        "fabric": fabric,
        "stress": stress,
    }
    tables |= of_forces | of_stress
    return {name: pd.DataFrame(table) for name, table in tables.items()}, summary


def both_states(found):
    """Return the tables and summaries of some states together.

    Parameters
    ----------
    found : dict
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
            for (where, state), (part, _) in found.items()
            if name in part
        ]
        reason = pd.DataFrame({"reason": ["the energies bear no power law of branch length"]})
        tables[name] = pd.concat(parts, ignore_index=True) if parts else reason
    summary = {where: {"state": state, **summary} for (where, state), (_, summary) in found.items()}
    return tables, summary
