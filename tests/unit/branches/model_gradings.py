"""Gradings that models of contact numbers are asked about, and what follows from an answer."""

import pytest

from branchcrush.branches.coordination import solid_angle
from branchcrush.branches.nodes import grading_nodes
from branchcrush.gradings.forms import fractal, lognormal, loguniform, normal, uniform
from branchcrush.gradings.mixtures import from_radii

GRADINGS = {
    "narrow": normal(1.0, 0.05, 0.8, 1.2),
    "uniform": uniform(0.005, 1.0),
    "loguniform": loguniform(1.0, 20.0),
    "lognormal": lognormal(1.0, 1.8, 0.1, 10.0),
    "fractal": fractal(1.0, 200.0, 2.6),
    "two sizes": from_radii([1.0] * 9 + [1.5] * 4),
}
NODES = {name: grading_nodes(grading) for name, grading in GRADINGS.items()}
any_nodes = pytest.mark.parametrize("nodes", NODES.values(), ids=NODES)


def ends(share, found):
    """Return the shares of the ends of all contacts."""
    return share * found.contacts / (share @ found.contacts)


def mean_angle(radius, share, found):
    """Return the mean solid angle of a neighbour, seen from each grain."""
    return solid_angle(radius[:, None], radius) @ ends(share, found)
