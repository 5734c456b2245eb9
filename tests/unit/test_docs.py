"""What the documents name in the code is there."""

import re
from importlib import import_module
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
PACKAGE = REPOSITORY / "src" / "branchcrush"
ROOMS = sorted(path.parent.name for path in PACKAGE.glob("*/__init__.py"))
DOCUMENTS = [REPOSITORY / "CONTRIBUTING.md", *sorted((REPOSITORY / "docs").rglob("*.md"))]
# `room.module.name`, perhaps with a member.
NAMES = re.compile(rf"`(?:branchcrush\.)?((?:{'|'.join(ROOMS)})(?:\.[A-Za-z_]\w*)+)`")
NAMED = [
    pytest.param(name, id=f"{document.name}-{name}")
    for document in DOCUMENTS
    for name in dict.fromkeys(NAMES.findall(document.read_text(encoding="utf-8")))
    # Keys of the configuration are written the same way.
    if (PACKAGE / name.split(".")[0] / f"{name.split('.')[1]}.py").exists()
]


@pytest.mark.parametrize("name", NAMED)
def test_a_name_of_the_code_in_the_documents_is_there(name):
    room, module, *members = name.split(".")
    thing = import_module(f"branchcrush.{room}.{module}")
    for member in members:
        thing = getattr(thing, member)


def test_the_equations_name_a_function_of_every_room_of_the_science():
    table = (REPOSITORY / "docs" / "model.md").read_text(encoding="utf-8")
    rooms = {name.split(".")[0] for name in NAMES.findall(table)}
    assert {"gradings", "packings", "branches", "energy", "forces", "crushing"} <= rooms


def test_the_map_of_rooms_names_every_room_there_is():
    contributing = (REPOSITORY / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert set(re.findall(r"^\| `(\w+)/` \|", contributing, re.MULTILINE)) == set(ROOMS)
