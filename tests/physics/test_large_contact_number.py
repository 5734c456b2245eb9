"""One large grain among many small ones: a hundred contacts on a single grain."""

import numpy as np
import pytest

from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

STIFFNESS = {"linear": 1.0e6, "hertz": 1.0e9}
RATIO, SMALL = 6.0, 450
# Steps and states. A state that hardly jams is very soft under Hertz's law, and takes long.
PATH = {"linear": (10, 2), "hertz": (5, 1)}


@pytest.fixture(scope="module", params=STIFFNESS)
def crowd(request, compressed, even_edges, tmp_path_factory):
    # Too small a mass for its contacts makes a grain vibrate faster than the time step resolves:
    # at equal masses this packing explodes.
    radii = 1.0e-4 * np.r_[RATIO, np.ones(SMALL)]
    edge = cube_edge(radii, 0.2)
    positions = random_packing(radii, edge, periodic=False, rng=np.random.default_rng(1))
    steps, states = PATH[request.param]
    return compressed(
        (positions, radii, edge),
        tmp_path_factory.mktemp("crowd") / "run",
        law=request.param,
        stiffness=STIFFNESS[request.param],
        **even_edges(cube_edge(radii, 0.5), cube_edge(radii, 0.7), steps=steps, states=states),
        # Far more than it takes: an unstable run that explodes within bounds ends soon.
        largest_relaxation=40_000,
    )


def test_a_grain_with_a_hundred_contacts_comes_to_rest(crowd):
    contacts = crowd.at("contacts", -1)
    number = np.bincount(np.r_[contacts["i"], contacts["j"]])
    assert number[0] > 80
    loaded = crowd.path[crowd.path["carries_load"]]
    assert len(loaded) > 0
    assert loaded["unbalanced_force_ratio"].max() <= 1e-6


def test_its_work_is_conserved(crowd):
    path = crowd.path
    # Contacts close within the steps: Simpson's rule knows the work of those to some parts in 1e4.
    assert (path["dissipated_J"].diff().iloc[1:] >= -1e-3 * path["work_J"].max()).all()
    contacts, walls = crowd.at("contacts", -1), crowd.at("walls", -1)
    if crowd.variables["law"] == "linear":
        stored = sum(np.sum(table["overlap_m"] ** 2) for table in (contacts, walls)) / 2
    else:
        # K sqrt(R*) overlap^(5/2) 2/5; R* of a wall contact is the radius.
        curvature = 1 / contacts["radius_i_m"] + 1 / contacts["radius_j_m"]
        pairs = np.sum(contacts["overlap_m"] ** 2.5 / np.sqrt(curvature))
        radius = 1.0e-4 * np.where(walls["i"] == 0, RATIO, 1.0)
        stored = 0.4 * (pairs + np.sum(np.sqrt(radius) * walls["overlap_m"] ** 2.5))
    stored *= crowd.variables["stiffness"]
    np.testing.assert_allclose(path["elastic_energy_J"].iloc[-1], stored, rtol=1e-9)
    # A blow-up would show as energy that no strain step put in.
    assert path["elastic_energy_J"].iloc[-1] < path["work_J"].iloc[-1]


def test_its_stress_is_that_on_the_walls(crowd):
    last = crowd.path.iloc[-1]
    np.testing.assert_allclose(last["mean_stress_Pa"], last["boundary_stress_Pa"], rtol=1e-6)
