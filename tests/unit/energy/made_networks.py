"""Networks whose energies are known: given ones, and those drawn by a law."""

import numpy as np

from branchcrush.packings.network import Network


def network(radius, pairs, energy, walls=(), wall_energy=()):
    """Contacts with given energies; a wall's of exponent 1 holds F d/2."""
    i, j = np.array(pairs, dtype=int).reshape(-1, 2).T
    radius, energy = np.asarray(radius, float), np.asarray(energy, float)
    ones = np.ones(len(walls))
    held = 2.0 * np.asarray(wall_energy, float) * ones
    return Network(
        radius, i, j, 0.0 * energy, 0.0 * energy, energy, np.array(walls, int), ones, held
    )


def packings(rng, s, n=3.0, seeds=8, contacts=4000, smallest=0.05):
    """Pairs of grains at random, E = l^n q^s times gamma noise and a factor of each packing."""
    found = []
    for _ in range(seeds):
        radius = rng.uniform(smallest, 1.0, 800)
        i = rng.integers(0, 800, contacts)
        j = (i + rng.integers(1, 800, contacts)) % 800
        first, second = radius[i], radius[j]
        mean = (first + second) ** n * (np.minimum(first, second) / np.maximum(first, second)) ** s
        energy = mean * rng.gamma(1.0, 1.0, contacts) * rng.uniform(0.8, 1.2)
        found.append(network(radius, np.stack([i, j], axis=1), energy))
    return found
