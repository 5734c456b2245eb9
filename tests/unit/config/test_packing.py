"""Samples that are packings of another code: what is asked of them, all problems at once."""

import os

import pytest

from branchcrush.config.checks import checked_study
from branchcrush.config.packing import KEYWORDS
from branchcrush.config.packing_files import frame_files
from branchcrush.errors import ConfigError
from branchcrush.readers import liggghts
from branchcrush.readers.layouts import FORMATS
from branchcrush.readers.sources import source_of

LINEAR = {"law": "linear", "normal_stiffness": 1e6}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with files of the names that the samples here give."""
    for name in ("grains.dump", "contacts.dump", "g.9", "g.10"):
        (tmp_path / name).touch()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def sample(**packing):
    given = {"format": "yade", "grains": "grains.dump", "contacts": "contacts.dump", **packing}
    return {"packing": given, "boundary": "periodic", "contact": LINEAR}


def problems(section):
    with pytest.raises(ConfigError) as caught:
        checked_study({"samples": {"mine": section}})
    return str(caught.value).splitlines()


def test_packings_are_numbered_and_their_settings_become_a_source(folder):
    packing = {
        "grains": ["grains.dump", "g.*"],
        "contacts": ["contacts.dump", "g.*"],
        "length_unit": "mm",
        "force_unit": "kN",
        "frames": "last",
        "wall_ids": [0, "1"],
        "cell": {"low": [0, 0, 0], "high": [1, 2, "3e0"]},
    }
    config = checked_study({"samples": {"mine": sample(**packing)}})
    settings = config.samples["mine"].settings()
    assert settings["seeds"] == [1, 2]
    source = source_of(settings["packing"], ["a"], ["b"], settings["boundary"])
    assert (source.length, source.force, source.last) == (1e-3, 1e3, True)
    assert source.wall_ids == (0, 1)
    assert (source.low, source.high) == ([0.0, 0.0, 0.0], [1.0, 2.0, 3.0])
    assert frame_files("g.*") == ["g.9", "g.10"]


def test_this_room_knows_the_formats_and_keywords_of_the_readers():
    from branchcrush.config.packing import Packing

    assert Packing.model_fields["format"].annotation.__args__ == FORMATS
    assert KEYWORDS == liggghts.KEYWORDS


def test_all_problems_are_named_at_once(folder):
    section = sample(
        format="liggghts", grains="no.dump", contacts=["contacts.dump", "post/*.dump"],
        keywords=["pos", "ids"], frames="first", colums={},
    )  # fmt: skip
    del section["boundary"]
    section["grains"] = 100
    lines = problems(section)
    for words in (
        "samples.mine.packing.grains = 'no.dump': there is no such file",
        "packing.contacts = 'post/*.dump': no file has such a name",
        "packing.contacts = ['contacts.dump', 'post/*.dump']: must name as many files as grains",
        "packing.keywords = ['pos', 'ids']: must be of pos, vel",
        "packing.frames = 'first': must be 'all' or 'last'",
        "packing.colums: unknown key; did you mean columns?",
        "samples.mine.boundary: missing; must be 'walls' or 'periodic'",
        "samples.mine.grains: unknown key",
    ):
        assert any(words in line for line in lines), (words, lines)


@pytest.mark.parametrize(
    ("packing", "words"),
    [
        ({"format": "lammps"}, "packing: must have columns, the names of the columns"),
        ({"format": "columns", "columns": {"id1": "a", "force": ["x", "y", "z"]}},
         "packing: columns must have id1 and id2, or start and end"),
        ({"columns": {"id1": "a", "id2": "b"}}, "packing: columns must have force or normal_force"),
        ({"columns": {"id1": "a", "id2": "b", "force": ["x", "y"]}},
         "packing.columns.force = ['x', 'y']: must be a list of three"),
        ({"grain_columns": {"radius": "r", "diameter": "d"}},
         "packing.grain_columns: must have either radius or diameter"),
        ({"cell": {"low": [0, 0, 0], "high": [1, 0, 1]}}, "must be above low in x, y and z"),
        ({"keywords": ["pos"]}, "belongs to format: liggghts"),
        ({"format": "yad"}, "packing.format = 'yad': must be"),
        ({"grains": 3}, "packing.grains = 3: must be the name of a file"),
    ],
)  # fmt: skip
def test_each_problem_names_key_value_and_what_is_allowed(folder, packing, words):
    assert any(words in line for line in problems(sample(**packing))), problems(sample(**packing))


def test_the_contact_law_has_no_default_here(folder):
    section = sample()
    section["contact"] = {"law": "linear"}
    assert "contact.normal_stiffness: missing; give that of the run" in problems(section)[0]
    del section["contact"]
    assert "samples.mine.contact: missing" in problems(section)[0]
    assert os.listdir(folder)
