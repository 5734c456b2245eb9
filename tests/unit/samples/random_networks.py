"""Networks of grains that touch at random, for the tests of what they share."""

import numpy as np

from branchcrush.branches.contact_numbers import radius_classes
from branchcrush.packings.network import Network
from branchcrush.samples.sharing import shared_in_state
from branchcrush.statistics.bins import bin_edges

OPTIONS = {"confidence": 0.95, "resamples": 100}
# Few sizes: the mean of l^n over a bin is not the mean of l to the n.
RADII = [0.02, 0.11, 0.5, 1.0]
EDGES = bin_edges(0.02, 1.0)


def sample(seed=1, seeds=4, radii=RADII, exponent=3.0, noise=True):
    """Return networks of grains that touch at random, E = l^n times noise."""
    rng, networks = np.random.default_rng(seed), []
    for _ in range(seeds):
        radius = rng.choice(radii, 120)
        i = rng.integers(0, 120, 700)
        j = (i + rng.integers(1, 120, 700)) % 120
        length = radius[i] + radius[j]
        energy = length**exponent * (rng.standard_exponential(700) if noise else 1.0)
        overlap, wall = 0.01 * np.minimum(radius[i], radius[j]), rng.integers(0, 120, 30)
        along = rng.standard_normal((700, 3))
        networks.append(
            Network(
                radius,
                i,
                j,
                overlap,
                2.0 * energy / overlap,
                energy,
                wall,
                0.01 * radius[wall],
                radius[wall] ** 2,
                along * (length / np.linalg.norm(along, axis=1))[:, None],
            )
        )
    return networks


def classes_of(networks):
    radii, contacts = (
        np.concatenate([getattr(one, name) for one in networks]) for name in ("radius", "contacts")
    )
    return radius_classes(radii, contacts)


def shared(networks, edges=EDGES, exponent=1.0):
    classes = classes_of(networks)
    return shared_in_state(networks, edges, classes, exponent, **OPTIONS)
