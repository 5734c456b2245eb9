"""`lmp -in in.compress` by hand is the compression that the package runs, to the last digit."""

import gzip
import re
import shutil
import subprocess
from ast import literal_eval

import numpy as np
import pandas as pd
import pytest

from branchcrush import gradings
from branchcrush.lammps_files import write_data_file
from branchcrush.packing import random_packing
from branchcrush.simulation import compression_variables, declared_variables

DUMPS = ("particles.dump.gz", "pairs.dump.gz")


def default_packing():
    """Place the grains of lammps_inputs/packing.data, as its first line says."""
    rng = np.random.default_rng(1)
    radii = np.sort(gradings.uniform(0.2e-3, 1.0e-3).rvs(size=60, random_state=rng))[::-1]
    return random_packing(radii, 8.0e-3, periodic=False, rng=rng), radii, 8.0e-3


def defaults(inputs):
    """Return the numbers and the boundary that in.compress declares."""
    text = (inputs / "in.compress").read_text()
    found = dict(re.findall(r"^variable (\w+) +index (\S+)$", text, re.MULTILINE))
    assert found.keys() == declared_variables(inputs / "in.compress")
    for name in ("data", "inputs", "output_folder", "quit_on_failure"):
        del found[name]
    return {n: text if n == "boundary" else literal_eval(text) for n, text in found.items()}


@pytest.fixture
def by_hand(lmp):
    """Return a function that runs `lmp -in in.compress` in a folder, as a person would."""

    def run(folder, **variables):
        command = [lmp, "-in", "in.compress"]
        for name, value in variables.items():
            command += ["-var", name, str(value)]
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)

    return run


@pytest.fixture
def workplace(lammps_inputs, tmp_path):
    """Return a folder that holds a copy of the scripts and the default packing."""
    return shutil.copytree(lammps_inputs, tmp_path / "inputs")


def assert_same_states(states, run):
    """Compare a states.csv with the path that the package made of its own run."""
    path, edge = run.path, states["edge"]
    assert states["state"].tolist() == path["state"].tolist() == list(range(len(path)))
    assert states["evaluations"].tolist() == path["force_evaluations"].tolist()
    assert states["escaped"].tolist() == path["escaped"].tolist()
    np.testing.assert_array_equal(edge**3, path["volume_m3"])
    np.testing.assert_array_equal(states["work"], path["work_J"])
    if run.variables["boundary"] == "periodic":
        np.testing.assert_array_equal(states["pair_pressure"], path["boundary_stress_Pa"])
    # Sums over contacts, in LAMMPS with 15 digits and here.
    for lammps, ours in (
        ("elastic_energy", "elastic_energy_J"),
        ("unbalanced", "unbalanced_force_ratio"),
    ):
        np.testing.assert_allclose(states[lammps], path[ours], rtol=1e-12)


def assert_same_dumps(folder, run):
    for name in DUMPS:
        one, other = ((place / name).read_bytes() for place in (folder, run.folder))
        assert gzip.decompress(one) == gzip.decompress(other)


@pytest.mark.parametrize("boundary", ["walls", "periodic"])
def test_the_default_packing_ends_loaded_and_as_the_package_loads_it(
    by_hand, workplace, compressed, boundary
):
    chosen = {} if boundary == "walls" else {"boundary": boundary}
    finished = by_hand(workplace, **chosen)
    assert finished.returncode == 0, finished.stdout[-2000:]
    states = pd.read_csv(workplace / "states.csv")
    variables = {**defaults(workplace), "boundary": boundary}
    run = compressed(default_packing(), workplace.parent / "run", **variables)
    assert_same_states(states, run)
    assert_same_dumps(workplace, run)
    last = run.path.iloc[-1]
    assert last["carries_load"]
    assert last["coordination_number"] > 4.0
    assert len(states) == 2 + variables["steps"] / variables["steps_per_state"]


def test_a_packing_of_the_workflow_is_loaded_as_the_package_loads_it(
    by_hand, workplace, compressed, random_grains, tmp_path
):
    positions, radii, edge = random_grains(40, 2, periodic=True)
    variables = compression_variables(
        radii,
        edge,
        boundary="periodic",
        normal_stiffness=3.0e5,
        edge_reduction=0.4,
        approach_solid_fraction=0.5,
        steps=8,
        states=4,
        unbalanced_force_ratio=1e-6,
    )
    data = tmp_path / "packing.data"
    write_data_file(data, positions, radii, edge)
    out = tmp_path / "out"
    out.mkdir()
    finished = by_hand(workplace, data=data, output_folder=out, **variables)
    assert finished.returncode == 0, finished.stdout[-2000:]
    run = compressed((positions, radii, edge), tmp_path / "run", **variables)
    assert_same_states(pd.read_csv(out / "states.csv"), run)
    assert_same_dumps(out, run)


def test_the_default_packing_is_made_as_its_first_line_says(lammps_inputs, tmp_path):
    write_data_file(tmp_path / "packing.data", *default_packing())
    first, rest = (lammps_inputs / "packing.data").read_text().split("\n", 1)
    assert rest == (tmp_path / "packing.data").read_text().split("\n", 1)[1]
    for word in ("60 grains", "0.2 to 1 mm", "8 mm", "random_packing", "default_rng(1)"):
        assert word in first


def test_failure_ends_with_code_1_and_the_reason(by_hand, workplace):
    finished = by_hand(workplace, largest_relaxation=20)
    assert finished.returncode == 1
    reason = r"FAILED at edge 0\.00\d+ m: not at rest after 20 force evaluations"
    assert re.search(reason, finished.stdout)


def test_failure_can_be_left_to_the_caller(by_hand, workplace):
    finished = by_hand(workplace, largest_relaxation=20, quit_on_failure="no")
    assert finished.returncode == 0
    assert "FAILED at edge" in finished.stdout


def test_an_error_of_lammps_ends_with_another_code_than_0(by_hand, workplace):
    finished = by_hand(workplace, data="nowhere.data")
    assert finished.returncode != 0
    assert "nowhere.data" in finished.stdout + finished.stderr
