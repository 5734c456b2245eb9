"""How a grading goes while its grains break, from strengths and contacts alone: no simulation."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.load_bearing import rod_coordination
from branchcrush.branches.coordination_laws import jamming_law
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.uniform_stress import ForceNetwork, force_network
from branchcrush.breakage.fragments import packed_spheres
from branchcrush.breakage.rules import Breakage
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.rods import rod_map, gap_at
from branchcrush.packings.contact_laws import HertzContact, LinearContact

# Classes of size to a factor e, of Weibull's w, and step of ln(phi).
CLASSES, FACTORS, STEP = 20, 50, 2e-3
TURN = 1.0


@dataclass(frozen=True)
class CrushingPath:
    """A grading along its crushing; arrays of a row for each state, S of them."""

    diameter: NDArray  # of the classes, shape (K,) [m]
    mass: NDArray  # share of each class, shape (S, K) [-]
    solid_fraction: NDArray
    jamming: NDArray  # phi_J of the grading there is [-]
    elastic_strain: NDArray  # eps_e [-]
    mean_stress: NDArray  # p [Pa]
    broken_mass: NDArray  # share of the mass that is fragments [-]
    dissipated: NDArray  # of the volume at jamming before crushing [J/m3]

    @property
    def void_ratio(self) -> NDArray:
        return 1.0 / self.solid_fraction - 1.0

    @property
    def grains(self) -> NDArray:
        """Grains over those before [-]."""
        number = (self.mass / self.diameter**3).sum(axis=1)
        return number / number[0]


def crushing_path(
    grading: Grading,
    law: LinearContact | HertzContact,
    rules: Breakage,
    solid_fraction: float,
    *,
    classes: int = CLASSES,
    factors: int = FACTORS,
    step: float = STEP,
) -> CrushingPath:
    radius, share = grading_nodes(grading)
    diameter = _classes(2.0 * radius, rules, classes)
    initial = _split(np.log(2.0 * radius), share * radius**3, np.log(diameter))
    initial /= initial.sum()
    table = _fragments(diameter, rules)
    levels = (np.arange(factors) + 0.5) / factors
    strength = rules.strength
    weibull = (-np.log1p(-levels)) ** (1.0 / strength.weibull_modulus)
    largest = strength.of(diameter[:, None], weibull) * diameter[:, None] ** 2
    largest[diameter <= rules.smallest_diameter] = np.inf

    first = np.repeat(initial[:, None] / factors, factors, axis=1)
    later = np.zeros_like(first)
    rows = []
    dissipated, jamming_before, eps = 0.0, None, 0.0
    phi = None
    while True:
        mass = (first + later).sum(axis=1)
        there = mass > 0.0
        number = mass[there] / diameter[there] ** 3
        number /= number.sum()
        jamming = rod_map(diameter[there] / 2.0, number).solid_fraction
        if phi is None:
            phi = jamming
            start = jamming
        eps = max(1.0 - jamming / phi, 0.0)
        R = diameter[there] / 2.0
        rods = rod_map(R, number, gap_at(R, number, phi, 1000), 2000) if eps > 0 else rod_map(R, number)
        coordination = rod_coordination(R, number, rods, float(jamming_law(max(phi - jamming, 0.0))))
        network = force_network(diameter[there] / 2.0, number, coordination, phi, law)
        p = float(network.stress(eps))
        if jamming_before is not None:
            dissipated += 0.5 * (p + rows[-1][4]) * start / jamming * np.log(jamming / jamming_before)
        jamming_before = jamming
        rows.append((mass, phi, jamming, eps, p, float(later.sum()), dissipated))
        if phi >= solid_fraction * (1 - 1e-12):
            break
        after = min(phi * np.exp(step), solid_fraction)
        trial = 0.5 * (eps + 1.0 - jamming / after)
        over = network.overloaded(largest[there], float(network.stress(trial)))
        renewals = TURN * np.log(after / phi) / trial if trial > 0 else 0.0
        breaks = np.zeros_like(first)
        breaks[there] = -np.expm1(renewals * np.log1p(-np.minimum(over, 1 - 1e-15)))
        gone = breaks * (first + later)
        born = gone.sum(axis=1) @ table
        first = first - breaks * first
        later = later - breaks * later + born[:, None] / factors
        phi = after
    m, f, j, e, p, b, d = (np.array(part) for part in zip(*rows, strict=True))
    return CrushingPath(diameter, m, f, j, e, p, b, d)


def _classes(diameter, rules, classes):
    least = min(rules.finest_diameter, diameter.min())
    count = int(np.ceil(np.log(diameter.max() / least) * classes)) + 1
    return np.geomspace(least, diameter.max(), count)


def _split(log, weight, nodes):
    """Give each weight to the two classes beside it; its mass and mean logarithm are kept."""
    place = np.interp(log, nodes, np.arange(nodes.size))
    low = np.minimum(place.astype(int), nodes.size - 2)
    part = place - low
    return np.bincount(low, weight * (1 - part), nodes.size) + np.bincount(
        low + 1, weight * part, nodes.size
    )


def _fragments(diameter, rules):
    ratio = packed_spheres(rules.fragments)[:, 3] * rules.growth[-1]
    table = np.zeros((diameter.size, diameter.size))
    for row, parent in enumerate(diameter):
        if parent > rules.smallest_diameter:
            table[row] = _split(np.log(ratio * parent), ratio**3, np.log(diameter))
    return table
