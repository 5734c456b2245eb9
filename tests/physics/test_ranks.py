"""One packing on two MPI ranks, and packings that neighbour searches find hard."""

import re

import numpy as np
import pytest

from branchcrush.errors import SimulationError
from branchcrush.lammps.compression import compress
from branchcrush.lammps.neighbours import neighbour_settings
from branchcrush.loading.states import force_floor
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

LOADING = {"strain_step": 8e-3, "approach_steps": 10}


def loaded(radii, folder, inputs, *, boundary, start=0.25, end=0.75, ranks=1, **variables):
    rng = np.random.default_rng(1)
    edge = cube_edge(radii, start)
    positions = random_packing(radii, edge, periodic=boundary == "periodic", rng=rng)
    approach = cube_edge(radii, 0.5)
    variables = {
        "boundary": boundary,
        "control": "edge",
        "law": "linear",
        "stiffness": 1e6,
        "approach_edge": approach,
        "targets": [cube_edge(radii, end)],
        "force_floor": force_floor(radii, LinearContact(1e6)),
        "largest_radius": float(np.max(radii)),
        **neighbour_settings(radii, approach),
        **LOADING,
        **variables,
    }
    log = folder.with_suffix(".log")
    return compress(
        positions, radii, edge, variables, inputs=inputs, folder=folder, log=log, ranks=ranks
    )


@pytest.fixture(scope="module", params=["walls", "periodic"])
def on_ranks(request, tmp_path_factory, lammps_inputs):
    """Return runs of one packing on one rank and on two, and the log of the latter."""
    folder = tmp_path_factory.mktemp("ranks")
    radii = np.sort(np.random.default_rng(3).uniform(0.2e-3, 1e-3, 300))[::-1]
    runs = [
        loaded(radii, folder / f"run{n}", lammps_inputs, boundary=request.param, ranks=n)
        for n in (1, 2)
    ]
    return *runs, (folder / "run2.log").read_text()


def test_two_ranks_share_the_packing(on_ranks):
    log = on_ranks[2]
    assert re.search(r"Loop time of \S+ on 2 procs", log)
    assert re.search(r"^branchcrush: [\d.]+ s inside LAMMPS$", log, re.MULTILINE)


def test_the_first_state_is_the_same_on_two_ranks(on_ranks):
    one, two, _ = on_ranks
    for name in ("volume_m3", "coordination_number", "mean_stress_Pa", "elastic_energy_J"):
        np.testing.assert_allclose(two.path[name][0], one.path[name][0], rtol=1e-12)


def test_the_state_on_two_ranks_is_at_rest_and_as_good(on_ranks):
    one, two, _ = on_ranks
    assert two.path["stopped"][-1] == one.path["stopped"][-1] == ""
    assert two.path["carries_load"][-1]
    assert two.path["unbalanced_force_ratio"][-1] <= 1e-6
    assert two.path["contact_law_error"][-1] < 1e-9
    stress = two.path["mean_stress_Pa"][-1]
    if two.path["boundary_stress_Pa"][-1] == pytest.approx(stress, rel=1e-6):
        # Ways to jamming differ by rounding, and so a little the packings.
        np.testing.assert_allclose(stress, one.path["mean_stress_Pa"][-1], rtol=0.1)
    else:
        pytest.fail("stress of the branches is not that of the boundary")


def test_the_dumps_of_two_ranks_hold_every_grain_and_each_contact_once(on_ranks):
    _, two, _ = on_ranks
    last = two.contacts["state"] == two.contacts["state"][-1]
    pairs = np.column_stack([two.contacts["i"], two.contacts["j"]])[last]
    assert len(np.unique(pairs, axis=0)) == len(pairs) > 300
    assert (pairs[:, 0] < pairs[:, 1]).all()


def test_ranks_are_those_of_this_machine_in_a_slurm_allocation(
    tmp_path, lammps_inputs, monkeypatch
):
    for name, value in (
        ("SLURM_JOB_ID", "1"),
        ("SLURM_JOBID", "1"),
        ("SLURM_NODELIST", "elsewhere[1-2]"),
        ("SLURM_NNODES", "2"),
        ("SLURM_TASKS_PER_NODE", "1(x2)"),
    ):
        monkeypatch.setenv(name, value)
    run = loaded(np.full(30, 1e-3), tmp_path / "run", lammps_inputs, boundary="walls", ranks=2)
    assert run.path["stopped"][-1] == ""
    assert "on 2 procs" in (tmp_path / "run.log").read_text()


def test_an_mpiexec_of_another_mpi_is_told(tmp_path, lammps_inputs, monkeypatch):
    # One that starts its processes, and joins them in no world.
    other = tmp_path / "mpiexec"
    other.write_text('#!/bin/sh\nshift 2\n"$@"\n')
    other.chmod(0o755)
    monkeypatch.setattr("branchcrush.lammps.run._launcher", lambda: str(other))
    with pytest.raises(SimulationError, match="this mpiexec gives LAMMPS a world of 1"):
        loaded(np.full(30, 1e-3), tmp_path / "run", lammps_inputs, boundary="walls", ranks=2)


def test_an_error_on_two_ranks_is_one_message(tmp_path, lammps_inputs):
    with pytest.raises(SimulationError, match=r"LAMMPS stopped: .*stiffness"):
        loaded(
            np.full(30, 1e-3),
            tmp_path / "run",
            lammps_inputs,
            boundary="walls",
            ranks=2,
            stiffness="stiffness",
        )


HARD = {
    "one giant among fines": [1e-3] + [1e-4] * 60,
    "two giants among fines of ratio 50": [1e-3] * 2 + [2e-5] * 200,
    "few equal grains": [1e-3] * 8,
    "a giant that fills its cell": [1e-3] + [5e-5] * 20,
}


@pytest.mark.parametrize("style", ["chosen", "multi"])
@pytest.mark.parametrize("boundary", ["walls", "periodic"])
@pytest.mark.parametrize("grains", HARD)
def test_small_boxes_with_giant_grains_run(tmp_path, lammps_inputs, grains, boundary, style):
    radii = np.array(HARD[grains])
    collections = {}
    if style == "multi":
        spread = [float(np.sqrt(4 * radii.min() * radii.max())), 2.001 * float(radii.max())]
        collections = {"neighbour_style": "multi", "collections": f"2 {spread[0]} {spread[1]}"}
    run = loaded(
        radii,
        tmp_path / "run",
        lammps_inputs,
        boundary=boundary,
        start=0.12,
        end=min(0.54, 0.9 * 4.19 * np.sum(radii**3) / (2.05 * radii.max()) ** 3),
        approach_edge=cube_edge(radii, 0.3),
        largest_relaxation=5000,
        **collections,
    )
    assert run.path["lost"][-1] == 0
    assert run.path["escaped"][-1] == 0
