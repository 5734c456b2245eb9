"""One large grain among many small ones: a hundred contacts on a single grain."""

import numpy as np
import pytest

from branchcrush.packing import cube_edge, random_packing

STIFFNESS = 1.0e6
RATIO, SMALL = 6.0, 450


@pytest.fixture(scope="module")
def crowd(compressed, tmp_path_factory):
    # Too small a mass for its contacts makes a grain vibrate faster than the time step resolves:
    # at equal masses this packing explodes.
    radii = 1.0e-4 * np.r_[RATIO, np.ones(SMALL)]
    edge = cube_edge(radii, 0.2)
    positions = random_packing(radii, edge, periodic=False, rng=np.random.default_rng(1))
    return compressed(
        (positions, radii, edge),
        tmp_path_factory.mktemp("crowd") / "run",
        approach_edge=cube_edge(radii, 0.5),
        final_edge=cube_edge(radii, 0.7),
        steps=10,
        steps_per_state=5,
        # Far more than it takes: an unstable run that explodes within bounds ends soon.
        largest_relaxation=40_000,
    )


def test_a_grain_with_a_hundred_contacts_comes_to_rest(crowd):
    contacts = crowd.at("contacts", -1)
    number = np.bincount(np.r_[contacts["i"], contacts["j"]])
    assert number[0] > 80
    assert crowd.path["unbalanced_force_ratio"].max() <= 1e-6


def test_its_work_is_conserved(crowd):
    path = crowd.path
    assert (path["dissipated_J"].diff().iloc[1:] >= -1e-12 * path["work_J"].max()).all()
    stored = sum(
        np.sum(crowd.at(table, -1)["overlap_m"] ** 2) * STIFFNESS / 2
        for table in ("contacts", "walls")
    )
    np.testing.assert_allclose(path["elastic_energy_J"].iloc[-1], stored, rtol=1e-9)
    # A blow-up would show as energy that no strain step put in.
    assert path["elastic_energy_J"].iloc[-1] < path["work_J"].iloc[-1]


def test_its_stress_is_that_on_the_walls(crowd):
    last = crowd.path.iloc[-1]
    np.testing.assert_allclose(last["mean_stress_Pa"], last["boundary_stress_Pa"], rtol=1e-6)
