"""What `docs/pages.py` gathers for the site, on a small repository made for it."""

import importlib.util
from pathlib import Path

import pytest

FILE = Path(__file__).parents[2] / "docs" / "pages.py"
FILES = {
    "README.md": "[examples](examples) [one](examples/one) [model](docs/model.md#top) [web](a://b)",
    "docs/index.md": "[walls](api/walls.rst)",
    "docs/model.md": "[a choice](decisions)",
    "docs/conf.py": "",
    "docs/decisions/0001-first.md": "# First",
    "examples/one/README.md": "# One",
    "examples/one/config.yaml": "",
    "examples/one/results/report.html": "",
    "benchmarks/results/paper.json": "{}",
    "pyproject.toml": '[tool.importlinter]\n[[tool.importlinter.contracts]]\ntype = "layers"\n'
    'layers = ["walls | roof", "errors"]',
    "src/branchcrush/__init__.py": '"""The house."""',
    "src/branchcrush/errors.py": "",
    "src/branchcrush/walls/__init__.py": '"""What walls are.\n\nMore of it."""',
    "src/branchcrush/walls/bricks.py": "class Brick: pass\ndef laid(): pass\ndef _mixed(): pass",
    "src/branchcrush/walls/_mortar.py": "def wet(): pass",
}


@pytest.fixture
def pages(tmp_path, monkeypatch):
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    spec = importlib.util.spec_from_file_location("pages", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "REPOSITORY", tmp_path)
    monkeypatch.setattr(module, "PACKAGE", tmp_path / "src" / "branchcrush")
    return module


def test_the_site_has_the_tree_of_the_repository_without_what_a_run_left(pages):
    site = pages.site()
    assert {"README.md", "index.md", "examples/one/config.yaml"} <= site.keys()
    assert not {"docs/conf.py", "docs/index.md", "examples/one/results/report.html"} & site.keys()


def test_links_to_folders_lead_to_their_pages_and_others_stay(pages):
    site = pages.site()
    assert site["README.md"].decode() == (
        "[examples](examples/index.md) [one](examples/one/README.md)"
        " [model](docs/model.md#top) [web](a://b)"
    )
    assert site["docs/model.md"] == b"[a choice](decisions/index.md)"
    assert b"0001-first.md" in site["docs/decisions/index.md"]
    assert b"[paper.json](paper.json)" in site["benchmarks/results/index.md"]


def test_a_room_is_shown_with_all_that_is_public_in_it(pages):
    room = pages.site()["api/walls.rst"].decode()
    assert ".. automodule:: branchcrush.walls\n" in room
    assert ".. automodule:: branchcrush.walls.bricks\n   :members:" in room
    assert "`Brick <branchcrush.walls.bricks.Brick>`" in room
    assert "`laid <branchcrush.walls.bricks.laid>`" in room
    assert "mixed" not in room
    assert "mortar" not in room


def test_rooms_stand_on_their_floors_with_their_first_sentence(pages):
    rooms = pages.site()["api/index.rst"].decode()
    assert "* :doc:`walls` :doc:`roof <branchcrush>`\n* :doc:`errors <branchcrush>`" in rooms
    assert ":doc:`walls`\n   What walls are.\n" in rooms
    assert "More of it" not in rooms


def test_a_room_without_a_stage_is_refused(pages, tmp_path):
    (tmp_path / "docs/index.md").write_text("nothing")
    with pytest.raises(SystemExit, match="no stage that walls has a part in"):
        pages.site()


def test_what_is_gone_is_removed_and_what_stays_is_not_written_again(pages, tmp_path):
    folder = tmp_path / "build"
    pages.write(folder)
    before = (folder / "README.md").stat().st_mtime_ns
    (tmp_path / "docs/decisions/0001-first.md").unlink()
    (tmp_path / "docs/model.md").write_text("changed")
    pages.write(folder)
    assert not (folder / "docs/decisions/0001-first.md").exists()
    assert (folder / "docs/model.md").read_text() == "changed"
    assert (folder / "README.md").stat().st_mtime_ns == before
