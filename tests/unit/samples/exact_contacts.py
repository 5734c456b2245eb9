"""Contacts whose energies follow a known law exactly, for the tests of the energy split."""

import numpy as np
import pandas as pd

from branchcrush.samples.seed_branches import seed_branches
from branchcrush.statistics.bins import bin_edges

RADIUS_MAX, STIFFNESS, AMPLITUDE = 1e-3, 1e6, 50.0
EDGES = bin_edges(5e-6, RADIUS_MAX, 20)
CENTRES = (EDGES[1:] + EDGES[:-1]) / 2


def contacts_of(seed, exponents):
    """Return a contacts table: a state for each exponent, with energies A l^n exactly.

    The lengths of a bin are equal, so that bin means follow the law as the branches do.
    """
    rng = np.random.default_rng(seed)
    states = []
    for state, exponent in enumerate(exponents):
        length = np.sort(rng.choice(CENTRES, 300 + 10 * seed + 100 * state))
        share = rng.uniform(0.2, 0.8, length.size)
        energy = AMPLITUDE * length**exponent
        force = np.sqrt(2 * STIFFNESS * energy)
        table = {
            "state": state,
            "i": 0,
            "j": 1,
            "radius_i_m": share * length,
            "radius_j_m": length - share * length,
            "branch_length_m": length - force / STIFFNESS,
            "overlap_m": force / STIFFNESS,
            "normal_force_N": force,
            "energy_J": energy,
        }
        states.append(pd.DataFrame(table))
    return pd.concat(states, ignore_index=True)


def branches_of(contacts, *states):
    return [seed_branches(table, states, EDGES) for table in contacts]
