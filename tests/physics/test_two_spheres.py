"""Two equal spheres pressed between two walls: three springs in a row.

On the x axis of a cube of edge 4R - d they touch each other and the x walls; the other walls are
2R - d/2 away. Two contacts with walls and one between the spheres share d. Linear: all three are
equal, and each overlap is d/3. Hertz: the reduced radius is R at a wall and R/2 between the
spheres, so that F = K sqrt(R) w^(3/2) = K sqrt(R/2) b^(3/2) makes b = 2^(1/3) w and 2w + b = d.
"""

from typing import NamedTuple

import numpy as np
import pytest

RADIUS = 1.0e-3
SHORTENING = 0.03 * RADIUS
TOUCHING, PRESSED = 4.0 * RADIUS, 4.0 * RADIUS - SHORTENING


class Springs(NamedTuple):
    """One law: force at a wall and between the spheres, and how they share a shortening."""

    stiffness: float
    exponent: float
    wall_share: float
    at_wall: float
    between: float

    def force(self, shortening=SHORTENING):
        return self.at_wall * (self.wall_share * shortening) ** self.exponent

    def energy(self, wall_overlap, overlap):
        walls = 2.0 * self.at_wall * wall_overlap ** (self.exponent + 1.0)
        between = self.between * overlap ** (self.exponent + 1.0)
        return (walls + between) / (self.exponent + 1.0)


SPRINGS = {
    "linear": Springs(1.0e6, 1.0, 1.0 / 3.0, 1.0e6, 1.0e6),
    "hertz": Springs(
        1.0e9,
        1.5,
        1.0 / (2.0 + 2.0 ** (1.0 / 3.0)),
        1.0e9 * np.sqrt(RADIUS),
        1.0e9 * np.sqrt(RADIUS / 2.0),
    ),
}


@pytest.fixture(scope="module")
def squeezed(compressed, even_edges, tmp_path_factory):
    def run(law, steps=200, states=4, **variables):
        positions = [[-1.1 * RADIUS, 0.0, 0.0], [1.1 * RADIUS, 0.0, 0.0]]
        packing = positions, [RADIUS, RADIUS], 4.4 * RADIUS
        loading = even_edges(TOUCHING, PRESSED, steps=steps, states=states)
        given = {"stiffness": SPRINGS[law].stiffness, "state_tolerance": 1e-9, **variables}
        # Where they just touch, what rounding leaves of a force moves them for ages: let it end.
        given["largest_relaxation"] = 5000
        folder = tmp_path_factory.mktemp("two") / "run"
        return compressed(packing, folder, law=law, **loading, **given)

    return run


@pytest.fixture(scope="module", params=SPRINGS)
def pair(request, squeezed):
    """Return the run of a law and its springs."""
    return squeezed(request.param), SPRINGS[request.param]


def test_three_springs_share_the_shortening(pair):
    run, springs = pair
    contact, walls = run.at("contacts", -1), run.at("walls", -1)
    assert (contact["i"].tolist(), contact["j"].tolist()) == ([0], [1])
    at_wall = springs.wall_share * SHORTENING
    overlap = SHORTENING - 2.0 * at_wall
    # At rest to 1e-9 of the force, in every contact.
    np.testing.assert_allclose(contact["overlap_m"], overlap, rtol=2e-9)
    np.testing.assert_allclose(contact["normal_force_N"], springs.force(), rtol=2e-9)
    np.testing.assert_allclose(contact["branch_length_m"], 2 * RADIUS - overlap, rtol=1e-10)
    np.testing.assert_allclose(walls["overlap_m"], at_wall, rtol=2e-9)
    np.testing.assert_allclose(walls["normal_force_N"], springs.force(), rtol=2e-9)


def test_the_left_sphere_presses_the_left_wall_and_none_the_others(pair):
    walls = pair[0].at("walls", -1)
    assert list(zip(walls["i"], walls["wall"], strict=True)) == [(0, "-x"), (1, "+x")]


def test_force_grows_with_the_power_of_the_law_in_the_shortening(pair):
    run, springs = pair
    states = run.path["state"].iloc[2:].to_numpy()
    force = [run.at("contacts", state)["normal_force_N"].item() for state in states]
    shares = (np.arange(1, 5) / 4) ** springs.exponent
    np.testing.assert_allclose(force, springs.force() * shares, rtol=1e-8)


def test_stress_of_branches_and_of_walls_is_that_of_one_force_on_two_of_six_walls(pair):
    run, springs = pair
    last = run.path.iloc[-1]
    stress = 2.0 * springs.force() / (6.0 * PRESSED**2)
    np.testing.assert_allclose(last["mean_stress_Pa"], stress, rtol=2e-9)
    np.testing.assert_allclose(last["boundary_stress_Pa"], stress, rtol=2e-9)


def test_stored_energy_is_that_of_three_springs_and_the_work_within_a_thousandth(pair):
    run, springs = pair
    last = run.path.iloc[-1]
    # One force over one shortening: F d/2 of linear springs, 2/5 F d of Hertz's.
    energy = springs.force() * SHORTENING / (springs.exponent + 1.0)
    at_wall = springs.wall_share * SHORTENING
    np.testing.assert_allclose(springs.energy(at_wall, SHORTENING - 2 * at_wall), energy)
    np.testing.assert_allclose(last["elastic_energy_J"], energy, rtol=1e-12)
    np.testing.assert_allclose(last["work_J"], energy, rtol=1e-3)
    assert last["work_J"] > last["elastic_energy_J"]


def test_work_is_the_stress_times_the_decrease_of_the_volume(pair):
    steps = pair[0].steps
    stress, volume = steps["mean_stress_Pa"].to_numpy(), steps["volume_m3"].to_numpy()
    assert len(steps) == 201
    work = np.sum((stress[1:] + stress[:-1]) / 2.0 * (volume[:-1] - volume[1:]))
    np.testing.assert_allclose(steps["work_J"].iloc[-1], work, rtol=1e-3)


@pytest.mark.parametrize("steps", [5, 20])
@pytest.mark.parametrize("law", SPRINGS)
def test_work_is_what_each_affine_step_adds_to_the_energy_of_the_springs(squeezed, law, steps):
    # A step takes a quarter of its shortening from each wall contact and half from the other:
    # not the shares of rest, so that relaxation dissipates.
    springs = SPRINGS[law]
    added, step = 0.0, SHORTENING / steps
    for shortening in step * np.arange(steps):
        edge = TOUCHING - shortening
        at_wall = springs.wall_share * shortening
        between = shortening - 2.0 * at_wall
        before = springs.energy(at_wall, between)
        at_wall += (RADIUS - at_wall) * step / edge
        between += (2.0 * RADIUS - between) * step / edge
        added += springs.energy(at_wall, between) - before
    energy = springs.force() * SHORTENING / (springs.exponent + 1.0)
    # Simpson's rule is exact for linear springs. For Hertz's the first step, from zero overlap, is
    # the worst: 0.4024 instead of 2/5, in the part steps^(-5/2) of the energy.
    error = {"linear": 1e-8, "hertz": 0.01 * steps**-2.5}[law]
    run = squeezed(law, steps=steps, states=1, step_tolerance=1e-9, step_evaluations=400_000)
    np.testing.assert_allclose(run.path["work_J"].iloc[-1], added, rtol=error)
    # Stiffness of the affine step over that of the springs in a row.
    wall, other = springs.wall_share, 1.0 - 2.0 * springs.wall_share
    affine = (2.0 / 16.0 / wall + 1.0 / 4.0 / other) * (2.0 * wall + other)
    excess = (affine - 1.0) * (springs.exponent + 1.0) / (2.0 * steps)
    if law == "linear":
        np.testing.assert_allclose(excess, 1.0 / (8.0 * steps), rtol=1e-12)
    np.testing.assert_allclose(added / energy - 1.0, excess, rtol=0.02 if law == "linear" else 0.2)


@pytest.mark.parametrize("law", SPRINGS)
@pytest.mark.parametrize("variable", [{"time_step": 0.1}, {"normal_damping": 0.1}])
def test_the_state_at_rest_owes_nothing_to_time_step_or_damping(squeezed, law, variable):
    run = squeezed(law, steps=20, states=1, **variable)
    force = run.at("contacts", -1)["normal_force_N"]
    np.testing.assert_allclose(force, SPRINGS[law].force(), rtol=2e-9)
