"""The files of a seed: of the right number, and no columns but those that are wanted."""

from types import SimpleNamespace

import pytest

from branchcrush.files.seeds import read_contacts
from branchcrush.files.tables import write_packing, write_table

CONTACT = ["state", "i", "j", "overlap_m", "normal_force_N", "energy_J"]
VECTOR = ["branch_x", "branch_y", "branch_z"]
WALL = ["state", "i", "overlap_m", "normal_force_N"]


@pytest.fixture
def files(tmp_path):
    """The files of two seeds; every number of a seed is 1 in the first, 2 in the second."""
    paths = SimpleNamespace(packings=[], contacts=[], walls=[])
    for number in (1, 2):
        folder = tmp_path / str(number)
        paths.packings.append(folder / "packing.npz")
        write_packing(paths.packings[-1], [[0.0, 0.0, 0.0]], [float(number)], 4.0, {})
        paths.contacts.append(folder / "contacts.parquet")
        columns = {name: [number] for name in [*VECTOR, "branch_length_m", *CONTACT]}
        write_table(paths.contacts[-1], columns, {})
        paths.walls.append(folder / "wall_contacts.parquet")
        write_table(paths.walls[-1], {name: [number] for name in ["direction_x", *WALL]}, {})
    return paths


@pytest.mark.parametrize("seed", [0, 1])
def test_contacts_and_walls_are_those_of_the_seed(files, seed):
    radii, contacts, walls = read_contacts(files, seed)
    assert radii.tolist() == [seed + 1.0]
    assert contacts.to_dict("list") == {name: [seed + 1] for name in CONTACT}
    assert walls.to_dict("list") == {name: [seed + 1] for name in WALL}


def test_branch_vectors_are_read_if_they_are_wanted(files):
    _, contacts, _ = read_contacts(files, 0, vectors=True)
    assert sorted(contacts) == sorted(CONTACT + VECTOR)


def test_contacts_of_the_states_that_are_wanted_are_read_alone(files):
    _, contacts, walls = read_contacts(files, 1, states=[2])
    assert contacts["state"].tolist() == [2]
    _, contacts, walls = read_contacts(files, 1, states=[1, 3])
    assert contacts["state"].tolist() == []
    # Contacts with walls are few: all are there.
    assert walls["state"].tolist() == [2]
