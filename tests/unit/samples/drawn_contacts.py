"""Contacts drawn by known contact numbers, for the tests of who touches whom."""

import numpy as np
import pandas as pd

from branchcrush.branches.predictions import fine_edges
from branchcrush.gradings.forms import uniform
from branchcrush.packings.network import COLUMNS, WALL_COLUMNS
from branchcrush.samples.seed_contacts import sample_contacts

GRADING = uniform(1.0, 20.0)
EDGES = fine_edges(1.0, 20.0)
STATES = (2, 5)
MEASURED = dict(confidence=0.95, resamples=200)
NO_WALLS = pd.DataFrame({name: [] for name in WALL_COLUMNS})


def contact_table(state, i, j):
    return pd.DataFrame(dict(zip(COLUMNS, (state, i, j, 0.01, 1.0, 0.1), strict=True)))


def packing(rng, grading, laws, grains=1000):
    """Return radii and contacts whose ends are drawn by a contact number in each state.

    Each law gives a contact number of any scale; a grain has six on average.
    """
    radii = grading.rvs(grains, rng)
    tables = []
    for state, law in laws.items():
        weight = law(radii)
        ends = rng.choice(grains, (2, 3 * grains), p=weight / weight.sum())
        tables.append(contact_table(state, *ends))
    return radii, pd.concat(tables, ignore_index=True)


def path_of(states=STATES):
    number = np.arange(len(states))
    return pd.DataFrame(
        {
            "state": states,
            "solid_fraction": 0.65 + 0.04 * number,
            "solid_fraction_above_jamming": 0.01 + 0.04 * number,
            "mean_stress_Pa": 1e4 * (number + 1.0),
        }
    )


def sample(grading, laws, seeds=4, state=1, grains=1000):
    """Return the packings, what is kept of their contacts, and the classes of a sample."""
    rng = np.random.default_rng(state)
    packings = [packing(rng, grading, laws, grains) for _ in range(seeds)]
    kept, classes = sample_contacts(
        grading, lambda number: (*packings[number], NO_WALLS), range(seeds), list(laws)
    )
    return packings, kept, classes


def growing_sample():
    """Return a sample whose contact numbers grow as R near jamming, and as R^2 at the end."""
    return sample(GRADING, {STATES[0]: lambda r: r, STATES[1]: lambda r: r**2})
