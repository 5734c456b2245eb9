"""Data files that no compression can begin with: one line by the script itself, and exit code 1."""

import re
import shutil
import subprocess

import numpy as np
import pytest

from branchcrush.errors import SimulationError
from branchcrush.lammps.compression import Packing
from branchcrush.lammps.files import write_data_file
from tests.physics.crushings import rules, variables

EDGE = 8e-3
PLACES = np.array([[-2e-3, 0, 0], [0, 0, 0], [2e-3, 0, 0], [0, 2e-3, 1e-3]])
SIZES = [1e-3, 0.8e-3, 0.7e-3, 0.5e-3]
TOGETHER = "grains 2 and 4 of my.data have their centres at one place: move or remove one of them"


def packing(*, together=False, radius=None):
    """Return grains of which the last is at the place of the second, or has another radius."""
    places, radii = PLACES.copy(), np.array(SIZES)
    if together:
        places[3] = places[1]
    if radius is not None:
        radii[3] = radius
    return places, radii, EDGE


@pytest.fixture
def by_hand(lammps_inputs, lmp, tmp_path):
    """Return a function that compresses a packing by hand, and gives exit code and output."""

    def run(places, radii, edge, *words):
        folder = tmp_path / "inputs"
        shutil.copytree(lammps_inputs, folder, dirs_exist_ok=True)
        write_data_file(folder / "my.data", places, radii, edge)
        command = [lmp, "-in", "in.compress", "-var", "data", "my.data", *words]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout + done.stderr

    return run


@pytest.mark.parametrize("boundary", ["walls", "periodic"])
@pytest.mark.parametrize("law", ["linear", "hertz"])
def test_two_grains_at_one_place_are_named(by_hand, boundary, law):
    words = ("-var", "boundary", boundary, "-var", "law", law, "-var", "stiffness", "1e6")
    code, text = by_hand(*packing(together=True), *words)
    assert code == 1
    (line,) = {line for line in text.splitlines() if line.startswith("FAILED")}
    assert re.fullmatch(rf"FAILED at edge 0\.008\S* m: {TOGETHER}", line)


def test_two_grains_at_one_place_through_a_periodic_face_are_named(by_hand):
    places, radii, edge = packing()
    places[1], places[3] = [-edge / 2, 1e-3, 0], [edge / 2, 1e-3, 0]
    code, text = by_hand(places, radii, edge, "-var", "boundary", "periodic")
    assert code == 1
    assert TOGETHER in text


@pytest.mark.parametrize("radius", [0.0, -0.5e-3])
def test_a_diameter_that_is_none_is_named_by_its_grain(by_hand, radius):
    code, text = by_hand(*packing(radius=radius))
    assert code == 1
    (line,) = {line for line in text.splitlines() if line.startswith("FAILED")}
    told = re.fullmatch(
        r"FAILED at edge 0\.008\S* m: grain 4 of my\.data has a diameter of (\S+) m: it must be "
        "above 0, correct or remove the grain",
        line,
    )
    assert float(told[1]) == 2 * radius


def test_grains_that_are_deep_in_each_other_are_still_taken(by_hand):
    places, radii, edge = packing()
    places[3] = places[1] + [1e-7, 0, 0]
    code, text = by_hand(places, radii, edge, "-var", "targets", "5.7e-3")
    assert code == 0, text[-2000:]


def test_the_package_tells_the_same_and_leaves_nothing(compressed, crushed, tmp_path):
    loading = {"approach_edge": 5e-3, "targets": [4.9e-3], "strain_step": 5e-3}
    with pytest.raises(SimulationError, match=r"grains 2 and 4 of .* at one place") as caught:
        compressed(packing(together=True), tmp_path / "run", **loading)
    assert "\n" not in str(caught.value)
    assert list((tmp_path / "run").iterdir()) == []


def test_grains_that_break_are_refused_in_the_same_words(crushed):
    places = np.vstack([PLACES, PLACES[:1] + np.array([0, 3e-3, 0])])
    places[3] = places[1]
    grains = Packing(places, np.full(5, 5e-4), EDGE)
    with pytest.raises(SimulationError, match=r"grains 2 and 4 of .* at one place"):
        crushed(grains, variables(grains, states=1), rules())
