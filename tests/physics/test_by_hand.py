"""`lmp -in in.compress` by hand is the compression that the package runs, to the last digit."""

import gzip
import re
import shutil
import subprocess
from ast import literal_eval

import numpy as np
import pandas as pd
import pytest

from branchcrush.lammps.compression import compression_variables
from branchcrush.lammps.files import write_data_file
from branchcrush.lammps.run import declared_variables
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.geometry import cube
from branchcrush.packings.placement import random_packing

DUMPS = ("particles.dump", "pairs.dump")


def default_packing():
    """Place the grains of lammps_inputs/packing.data, as its first line says."""
    rng = np.random.default_rng(1)
    radii = np.sort(rng.uniform(0.2e-3, 1.0e-3, 60))[::-1]
    return random_packing(radii, 8.0e-3, periodic=False, rng=rng), radii, 8.0e-3


def defaults(inputs):
    """Return what in.compress declares, as `compress` takes it."""
    text = (inputs / "in.compress").read_text()
    found = dict(re.findall(r"^variable (\w+) +index (.+)$", text, re.MULTILINE))
    assert set(found) == set(declared_variables(inputs / "in.compress"))
    for name in ("data", "inputs", "output_folder", "quit_on_failure"):
        del found[name]
    words = {"boundary", "law", "control", "neighbour_style", "collections", "last_state", "append"}
    variables = {
        n: text if n in words else literal_eval(text) for n, text in found.items() if n != "targets"
    }
    return {**variables, "targets": [float(word) for word in found["targets"].split()]}


@pytest.fixture
def by_hand(lmp):
    """Return a function that runs `lmp -in in.compress` in a folder, as a person would."""

    def run(folder, **variables):
        command = [lmp, "-in", "in.compress"]
        for name, value in variables.items():
            values = value if isinstance(value, list) else [value]
            command += ["-var", name, *map(str, values)]
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)

    return run


@pytest.fixture
def workplace(lammps_inputs, tmp_path):
    """Return a folder that holds a copy of the scripts and the default packing."""
    return shutil.copytree(lammps_inputs, tmp_path / "inputs")


def assert_same_states(folder, run):
    """Compare states.csv and steps.csv with what the package made of its own run."""
    states, steps = (pd.read_csv(folder / f"{name}.csv") for name in ("states", "steps"))
    path, edge = run.path, states["edge"]
    assert states["state"].tolist() == path["state"].tolist() == list(range(len(path)))
    for lammps, ours in (("evaluations", "force_evaluations"), ("escaped",) * 2, ("lost",) * 2):
        assert states[lammps].tolist() == path[ours].tolist()
    np.testing.assert_array_equal(cube(edge), path["volume_m3"])
    # The package adds what the end of the approach holds, by energies that LAMMPS does not tell.
    held = path["elastic_energy_J"].iloc[1]
    np.testing.assert_array_equal(states["work"].iloc[1:] + held, path["work_J"].iloc[1:])
    assert states["work"].iloc[0] == path["work_J"].iloc[0] == 0.0
    if run.variables["boundary"] == "periodic":
        np.testing.assert_array_equal(states["pair_pressure"], path["boundary_stress_Pa"])
    # Sums over contacts, in LAMMPS with 15 digits and here; without load, of rounding.
    for lammps, ours in (
        ("mean_stress", "mean_stress_Pa"),
        ("unbalanced", "unbalanced_force_ratio"),
    ):
        largest = path[ours].max()
        np.testing.assert_allclose(states[lammps], path[ours], rtol=1e-12, atol=1e-12 * largest)
    for lammps, ours in (
        ("step", "step"),
        ("evaluations", "force_evaluations"),
        ("mean_stress", "mean_stress_Pa"),
        ("unbalanced", "unbalanced_force_ratio"),
        ("contacts", "contacts"),
    ):
        assert steps[lammps].tolist() == run.steps[ours].tolist()
    np.testing.assert_array_equal(steps["work"] + held, run.steps["work_J"])
    np.testing.assert_array_equal(cube(steps["edge"]), run.steps["volume_m3"])


def assert_energy_is_that_of_the_dumps(folder, run, frames):
    """Compare the energies with those of the forces and overlaps in the dumps of another run."""
    exponent = {"linear": 1.0, "hertz": 1.5}[run.variables["law"]]
    particles, pairs = (frames(folder / name) for name in DUMPS)
    for row, grains, contacts in zip(run.path.itertuples(), particles, pairs, strict=True):
        radius, half = grains.columns["radius"], np.ptp(grains.bounds[0]) / 2.0
        first, second = (contacts.columns[name].astype(int) - 1 for name in ("id1", "id2"))
        overlap = radius[first] + radius[second] - contacts.columns["branch"]
        energy = np.sum(contacts.columns["force"] * overlap)
        for axis in "xyz":
            reach = np.abs(grains.columns[axis]) + radius - half
            energy += np.sum(np.abs(grains.columns[f"v_wall_f{axis}"]) * reach)
        np.testing.assert_allclose(
            row.elastic_energy_J, energy / (exponent + 1.0), rtol=1e-9, atol=1e-20
        )


def assert_same_dumps(folder, run):
    for name in DUMPS:
        kept = gzip.decompress((run.folder / f"{name}.gz").read_bytes())
        assert (folder / name).read_bytes() == kept


@pytest.mark.parametrize("boundary", ["walls", "periodic"])
def test_the_default_packing_ends_loaded_and_as_the_package_loads_it(
    by_hand, workplace, compressed, frames, boundary
):
    chosen = {} if boundary == "walls" else {"boundary": boundary}
    finished = by_hand(workplace, **chosen)
    assert finished.returncode == 0, finished.stdout[-2000:]
    variables = {**defaults(workplace), "boundary": boundary}
    run = compressed(default_packing(), workplace.parent / "run", **variables)
    assert_same_states(workplace, run)
    assert_same_dumps(workplace, run)
    assert_energy_is_that_of_the_dumps(workplace, run, frames)
    assert len(run.path) == 2 + len(variables["targets"]) == 5
    densest = run.path.iloc[3]
    assert densest["carries_load"]
    assert densest["coordination_number"] > 4.0
    assert run.path["leg"].iloc[-1] == "unloading"


STRAIN = Loading("edge_reduction", 0.4, 2, approach_solid_fraction=0.5, unloading=True)
STRESS = Loading("mean_stress", [1e5, 1e6], approach_solid_fraction=0.5, unloading=True)


# Every two of the choices meet.
@pytest.mark.parametrize(
    ("boundary", "law", "loading"),
    [
        ("walls", LinearContact(3.0e5), STRAIN),
        ("walls", HertzContact(1.0e9), STRESS),
        ("periodic", LinearContact(3.0e5), STRESS),
        ("periodic", HertzContact(1.0e9), STRAIN),
    ],
)
def test_a_packing_of_the_workflow_is_loaded_as_the_package_loads_it(
    by_hand, workplace, compressed, random_grains, frames, tmp_path, boundary, law, loading
):
    positions, radii, edge = random_grains(40, 4, periodic=boundary == "periodic")
    variables = compression_variables(
        radii,
        0.16,
        boundary=boundary,
        law=law,
        loading=loading,
        strain_step=1.5e-2,
    )
    data = tmp_path / "packing.data"
    write_data_file(data, positions, radii, edge)
    out = tmp_path / "out"
    out.mkdir()
    finished = by_hand(workplace, data=data, output_folder=out, **variables)
    assert finished.returncode == 0, finished.stdout[-2000:]
    run = compressed((positions, radii, edge), tmp_path / "run", **variables)
    assert run.path["stopped"].iloc[-1] == ""
    assert run.path["leg"].tolist() == ["loading"] * 4 + ["unloading"]
    assert_same_states(out, run)
    assert_same_dumps(out, run)
    assert_energy_is_that_of_the_dumps(out, run, frames)


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
