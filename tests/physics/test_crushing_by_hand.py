"""Two grains whose breaking is told by hand."""

import numpy as np
import pytest

from branchcrush.breakage.fragments import packed_spheres
from branchcrush.breakage.strength import weibull_factor
from branchcrush.lammps.compression import Packing
from tests.physics.crushings import rules, variables


def body_centred(scale=1.0):
    """Return two grains of 1 mm, each in the middle of eight images of the other."""
    edge = scale * 1.5e-3
    return Packing(np.array([[-edge / 4] * 3, [edge / 4] * 3]), np.full(2, scale * 5e-4), edge)


def of_two(target, *, scale=1.0):
    """Return the variables of their compression to an edge; they touch at 1.1547 mm."""
    packing = body_centred(scale)
    return variables(packing, targets=[target], approach_edge=scale * 1.16e-3)


@pytest.mark.parametrize(("stepping", "above"), [("strain_step", None), ("events", 1e-9)])
def test_one_grain_breaks_at_its_strength(crushed, stepping, above):
    factors = [weibull_factor(1, (number,), 3.0) for number in (0, 1)]
    weak = int(np.argmin(factors))
    strength = 2e7 * factors[weak]
    diameter, stiffness = 1e-3, 1e6
    overlap = strength * diameter**2 / stiffness
    breaks_at = (diameter - overlap) * 2.0 / np.sqrt(3.0)
    # What they break into is too fine to break.
    how = rules(2e7, stepping=stepping, event_tolerance=above or 1e-2, smallest_diameter=6e-4)
    out = crushed(body_centred(), of_two(0.998 * breaks_at), how)
    broken = {name: column[0] for name, column in out.breakages.items()}
    assert broken["grain"] == weak
    edge = np.cbrt(2.0 * np.pi / 6.0 * diameter**3 / broken["solid_fraction"])
    if stepping == "events":
        assert broken["stress_Pa"] / strength == pytest.approx(1.0, abs=2e-9)
        assert edge == pytest.approx(breaks_at, rel=1e-9)
    else:
        edges = np.cbrt(out.steps["volume_m3"])
        assert edge == pytest.approx(edges[edges < breaks_at][0], rel=1e-12)
        assert edges[edges >= breaks_at][-1] / edge < 1.0 + 2.1e-3
    force = stiffness * (diameter - np.sqrt(3.0) / 2.0 * edge)
    assert broken["largest_force_N"] == pytest.approx(force, rel=1e-9)
    assert broken["contacts"] == 8
    assert broken["released_J"] == pytest.approx(8 * force**2 / (2 * stiffness), rel=1e-9)
    state = int(broken["state"])
    fragments = out.grains["parent"] == weak
    fragments &= out.grains["state"] == state
    spheres = packed_spheres(14)[:, 3]
    radii = 5e-4 * spheres / np.cbrt((spheres**3).sum())
    assert np.sort(out.grains["radius_m"][fragments])[::-1] == pytest.approx(radii, rel=1e-12)


def test_lengths_scale_out(crushed):
    # Of twice the size all forces are twice as large, and so is what breaks a grain with b = 1.
    how = {"stepping": "events", "event_tolerance": 1e-9}
    one, twice = (
        crushed(
            body_centred(scale),
            of_two(scale * 1.13e-3, scale=scale),
            rules(2e7, smallest_diameter=scale * 6e-4, **how),
        ).breakages
        for scale in (1.0, 2.0)
    )
    factors = {"solid_fraction": 1.0, "largest_force_N": 2.0, "stress_Pa": 0.5, "released_J": 4.0}
    for name, factor in factors.items():
        assert twice[name][0] == pytest.approx(factor * one[name][0], rel=1e-8)
