"""Walls look only at the grains near them, and miss no contact: at any time, not only at rest."""

import shutil
import subprocess

import numpy as np
import pytest

from branchcrush.lammps.files import write_data_file

LAWS = {
    "linear": (1e6, lambda depth, radius: 1e6 * depth),
    "hertz": (1e9, lambda depth, radius: 1e9 * np.sqrt(radius) * depth**1.5),
}
# Grains that overlap by their radius throw each other further than the walls see at first.
BURST = [[0.0, 0.0, 0.0], [1e-3, 0.0, 0.0], [0.5e-3, 0.8e-3, 0.1e-3], [0.5e-3, 0.1e-3, 0.9e-3]]


@pytest.fixture
def every_step(lammps_inputs, lmp, tmp_path, frames):
    """Return a function that gives a frame of each force evaluation, dashpots too weak to tell."""

    def run(packing, **variables):
        folder = shutil.copytree(lammps_inputs, tmp_path / "inputs")
        write_data_file(folder / "packing.data", *packing)
        with (folder / "mod.output").open("a", encoding="utf-8") as file:
            file.write("dump every all custom 1 every.dump id radius x y z fx fy fz\n")
            file.write("dump_modify every sort id format float %.17g\n")
        command = [lmp, "-in", "in.compress", "-var", "normal_damping", "1e-14"]
        for name, value in variables.items():
            command += ["-var", name, str(value)]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout[-2000:]
        return frames(folder / "every.dump")

    return run


def force_of_walls(frame, law):
    """Return the sum of the forces of the walls, by the contact law from the places alone."""
    half, radius = np.ptp(frame.bounds[0]) / 2.0, frame.columns["radius"]
    total = np.zeros(3)
    for axis, name in enumerate("xyz"):
        place = frame.columns[name]
        depth = np.clip(radius - (half - np.abs(place)), 0.0, None)
        total[axis] = -np.sum(np.sign(place) * law(depth, radius))
    return total


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("grains", ["burst", "random"])
def test_no_wall_contact_is_missed_while_grains_move(every_step, random_grains, law, grains):
    stiffness, wall_law = LAWS[law]
    packing = np.array(BURST) - np.mean(BURST, axis=0), np.full(4, 1e-3), 6e-3
    if grains == "random":
        packing = random_grains(60, 3, periodic=False)
    edge = packing[2]
    seen = every_step(
        packing,
        law=law,
        stiffness=stiffness,
        force_floor={"linear": 6e-2, "hertz": 3e-4}[law],
        approach_edge=0.75 * edge,
        approach_steps=4,
        targets=0.7 * edge,
        strain_step=0.02,
        step_evaluations=400,
        skin=5e-5,
        state_tolerance=1e-3,
    )
    assert len(seen) > 100
    # Forces between grains cancel: what is left of the sum is that of the walls.
    walls = np.array([force_of_walls(frame, wall_law) for frame in seen])
    felt = np.array([frame.vectors("fx", "fy", "fz").sum(axis=0) for frame in seen])
    size = max(np.abs(frame.vectors("fx", "fy", "fz")).max() for frame in seen)
    assert np.count_nonzero(np.abs(walls).max(axis=1)) > 20
    np.testing.assert_allclose(felt, walls, rtol=0.0, atol=1e-12 * size)
