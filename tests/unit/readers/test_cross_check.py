"""One packing at rest in LAMMPS, YADE and LIGGGHTS, each by its own files: the same statistics."""

import numpy as np
import pytest

from branchcrush.packings.contact_laws import LinearContact
from branchcrush.readers.layouts import Source
from branchcrush.readers.packing import read_frames
from branchcrush.readers.report import reading_report
from branchcrush.readers.states import packing_tables
from tests.unit.readers.conftest import DATA

FOLDER = DATA / "cross_check"
LAW = LinearContact(1e6)


@pytest.fixture(scope="module")
def packings():
    """Return what was read of each code."""
    edge = float((FOLDER / "edge.txt").read_text())
    yade = {"format": "yade", "periodic": True, "low": [0, 0, 0], "high": [edge] * 3}
    columns = {"id1": "id1", "id2": "id2", "real": "isReal", "force": ["fx", "fy", "fz"]}
    sources = {
        "yade": Source(
            grains=[FOLDER / "yade_spheres.txt"],
            contacts=[FOLDER / "yade_interactions.csv"],
            columns=columns,
            **yade,
        ),
        "yade_vtk": Source(
            grains=[FOLDER / "yade-spheres-00000000.vtk"],
            contacts=[FOLDER / "yade-intrs-00000000.vtk"],
            **yade,
        ),
        "liggghts": Source(
            format="liggghts",
            grains=[FOLDER / "liggghts_grains.dump"],
            contacts=[FOLDER / "liggghts_contacts.dump"],
            periodic=True,
            keywords=("pos", "id", "force", "delta"),
        ),
    }
    return {name: read_frames(source) for name, source in sources.items()}


@pytest.mark.parametrize("name", ["yade", "yade_vtk", "liggghts"])
def test_contacts_and_forces_are_those_of_lammps(packings, name):
    i, j, force = np.loadtxt(FOLDER / "lammps.csv", delimiter=",", skiprows=1).T
    touching = packings[name].moments[-1].touching
    own = dict(zip(zip(touching.i, touching.j, strict=True), touching.normal_force, strict=True))
    ours = dict(zip(zip(i.astype(int), j.astype(int), strict=True), force, strict=True))
    assert set(own) == set(ours)
    far = [abs(own[pair] - ours[pair]) for pair in ours]
    # Digits of six, and what is left to come to rest.
    assert max(far) < 2e-3 * force.mean()


@pytest.mark.parametrize("name", ["yade", "yade_vtk", "liggghts"])
def test_states_agree_and_the_law_is_found_to_be_that_of_the_run(packings, name):
    path = packing_tables(packings[name], LAW).path
    _, _, force = np.loadtxt(FOLDER / "lammps.csv", delimiter=",", skiprows=1).T
    energy = (force**2).sum() / 2e6
    assert path["elastic_energy_J"][-1] == pytest.approx(energy, rel=1e-4)
    assert path["solid_fraction"][-1] == pytest.approx(0.7, rel=1e-5)
    assert path["unbalanced_force_ratio"][-1] < 1e-2
    report = reading_report(packings[name], LAW, [])
    assert report["force_by_law"] == pytest.approx(1.0, abs=0.01)
