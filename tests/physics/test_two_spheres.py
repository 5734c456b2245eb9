"""Two equal spheres pressed between two walls: three equal springs in a row.

On the x axis of a cube of edge 4R - d they touch each other and the x walls; the other walls are
2R - d/2 away. With one stiffness k for all three contacts, each overlap is d/3.
"""

import numpy as np
import pytest

STIFFNESS = 1.0e6
RADIUS = 1.0e-3
SHORTENING = 0.03 * RADIUS
FORCE = STIFFNESS * SHORTENING / 3.0
ENERGY = 3.0 * FORCE**2 / (2.0 * STIFFNESS)
TOUCHING, PRESSED = 4.0 * RADIUS, 4.0 * RADIUS - SHORTENING


@pytest.fixture(scope="module")
def squeezed(compressed, tmp_path_factory):
    def run(**variables):
        positions = [[-1.1 * RADIUS, 0.0, 0.0], [1.1 * RADIUS, 0.0, 0.0]]
        packing = positions, [RADIUS, RADIUS], 4.4 * RADIUS
        loading = {"approach_edge": TOUCHING, "final_edge": PRESSED, "state_tolerance": 1e-9}
        steps = {"steps": 200, "steps_per_state": 50}
        folder = tmp_path_factory.mktemp("two") / "run"
        return compressed(packing, folder, **{**loading, **steps, **variables})

    return run


@pytest.fixture(scope="module")
def pair(squeezed):
    return squeezed()


def test_three_equal_springs_share_the_shortening(pair):
    contact, walls = pair.at("contacts", -1), pair.at("walls", -1)
    assert (contact["i"].tolist(), contact["j"].tolist()) == ([0], [1])
    # At rest to 1e-9 of the force, in every contact.
    np.testing.assert_allclose(contact["overlap_m"], SHORTENING / 3.0, rtol=2e-9)
    np.testing.assert_allclose(contact["normal_force_N"], FORCE, rtol=2e-9)
    np.testing.assert_allclose(contact["branch_length_m"], 2 * RADIUS - SHORTENING / 3, rtol=1e-10)
    np.testing.assert_allclose(walls["overlap_m"], SHORTENING / 3.0, rtol=2e-9)
    np.testing.assert_allclose(walls["normal_force_N"], FORCE, rtol=2e-9)


def test_the_left_sphere_presses_the_left_wall_and_none_the_others(pair):
    walls = pair.at("walls", -1)
    assert list(zip(walls["i"], walls["wall"], strict=True)) == [(0, "-x"), (1, "+x")]


def test_force_grows_in_proportion_to_the_shortening(pair):
    states = pair.path["state"].iloc[2:].to_numpy()
    force = [pair.at("contacts", state)["normal_force_N"].item() for state in states]
    np.testing.assert_allclose(force, FORCE * np.arange(1, 5) / 4, rtol=1e-8)


def test_stress_of_branches_and_of_walls_is_that_of_one_force_on_two_of_six_walls(pair):
    last = pair.path.iloc[-1]
    stress = 2.0 * FORCE / (6.0 * PRESSED**2)
    np.testing.assert_allclose(last["mean_stress_Pa"], stress, rtol=2e-9)
    np.testing.assert_allclose(last["boundary_stress_Pa"], stress, rtol=2e-9)


def test_stored_energy_is_that_of_three_springs_and_the_work_within_a_thousandth(pair):
    last = pair.path.iloc[-1]
    np.testing.assert_allclose(last["elastic_energy_J"], ENERGY, rtol=1e-12)
    np.testing.assert_allclose(last["work_J"], ENERGY, rtol=1e-3)
    assert last["work_J"] > last["elastic_energy_J"]


def test_work_is_the_stress_times_the_decrease_of_the_volume(pair):
    stress, volume = (pair.path[name].to_numpy()[1:] for name in ("mean_stress_Pa", "volume_m3"))
    work = np.sum((stress[1:] + stress[:-1]) / 2.0 * (volume[:-1] - volume[1:]))
    np.testing.assert_allclose(pair.path["work_J"].iloc[-1], work, rtol=1e-3)


@pytest.mark.parametrize("steps", [5, 20])
def test_work_is_what_each_affine_step_adds_to_the_energy_of_the_springs(squeezed, steps):
    # A step takes a quarter of its shortening from each wall contact and half from the other:
    # not the thirds of rest, so that relaxation dissipates about 1/(8 steps) of the energy.
    added, step = 0.0, SHORTENING / steps
    for shortening in step * np.arange(steps):
        edge = TOUCHING - shortening
        wall_distance, branch = RADIUS - shortening / 3.0, 2.0 * RADIUS - shortening / 3.0
        before = STIFFNESS * shortening**2 / 6.0
        at_walls = shortening / 3.0 + wall_distance * step / edge
        between = shortening / 3.0 + branch * step / edge
        added += STIFFNESS * (at_walls**2 + between**2 / 2.0) - before
    run = squeezed(steps=steps, steps_per_state=steps, step_tolerance=1e-9)
    np.testing.assert_allclose(run.path["work_J"].iloc[-1], added, rtol=1e-8)
    np.testing.assert_allclose(added / ENERGY - 1.0, 1.0 / (8.0 * steps), rtol=0.02)


@pytest.mark.parametrize("variable", [{"time_step": 0.1}, {"normal_damping": 0.1}])
def test_the_state_at_rest_owes_nothing_to_time_step_or_damping(squeezed, variable):
    run = squeezed(steps=20, steps_per_state=20, **variable)
    np.testing.assert_allclose(run.at("contacts", -1)["normal_force_N"], FORCE, rtol=2e-9)
