"""A study as RO-Crate, by what the standard asks for, and held against the files."""

import json
import re
import shutil
from datetime import date

import pytest
from rocrate.rocrate import ROCrate

from branchcrush.command.main import main
from branchcrush.files.digests import file_digest
from branchcrush.results.crate import _ADDRESSES


@pytest.fixture(scope="module")
def crate(finished, tmp_path_factory):
    """The results of the tiny study, described."""
    folder = tmp_path_factory.mktemp("crate") / "results"
    shutil.copytree(finished.folder / "results", folder)
    licence = "https://spdx.org/licenses/CC-BY-4.0"
    assert main(["export", str(folder), "--crate", "--licence", licence]) == 0
    return folder


@pytest.fixture(scope="module")
def entities(crate):
    graph = json.loads((crate / "ro-crate-metadata.json").read_text())["@graph"]
    return {entity["@id"]: entity for entity in graph}


def test_every_file_is_in_it_with_its_digest_and_meaning(crate, entities):
    files = [path for path in crate.rglob("*") if path.is_file()]
    described = {name for name, entity in entities.items() if entity["@type"] == "File"}
    names = {path.relative_to(crate).as_posix() for path in files}
    assert described == names - {"ro-crate-metadata.json"}
    for name in described:
        assert entities[name]["sha256"] == file_digest(crate / name)
        assert entities[name]["contentSize"] == str((crate / name).stat().st_size)
        assert entities[name]["description"], name
    parts = {part["@id"] for part in entities["./"]["hasPart"]}
    assert parts == described


def test_jobs_tell_what_they_made_of_what_and_with_which_software(entities):
    jobs = {name: entity for name, entity in entities.items() if entity["@type"] == "CreateAction"}
    fit = jobs["#job/tiny/made/energy_split.json"]
    read = {one["@id"] for one in fit["object"]}
    assert {"tiny/seed_3/path.csv", "tiny/seed_5/contacts.parquet", "config.json"} <= read
    assert {"@id": "tiny/energy_split.json"} in fit["result"]
    for job in jobs.values():
        objects = job["object"] if isinstance(job["object"], list) else [job["object"]]
        for one in (*objects, *job["result"], job["instrument"]):
            assert one["@id"] in entities, one
    needed = entities["#branchcrush"]["softwareRequirements"]
    assert entities["#lammps"]["softwareVersion"][:2] == "20"
    assert {"@id": "#lammps"} in needed
    machine = {entities[one["@id"]]["name"] for one in entities["./"]["additionalProperty"]}
    assert machine == {"system", "architecture", "processor", "cores"}


def test_the_configuration_beside_the_results_has_every_key(crate):
    config = json.loads((crate / "config.json").read_text())
    assert config["samples"]["tiny"]["grains"] == 60
    # Left at their default in the study's config.yaml.
    assert config["samples"]["tiny"]["contact"]["law"] == "linear"
    assert config["energy_split"]["bins"] and config["keep_dumps"] == "all"


def test_a_study_that_is_damaged_or_unfinished_is_not_described(crate, tmp_path, capsys):
    folder = tmp_path / "results"
    shutil.copytree(crate, folder)
    (folder / "comparison.csv").write_text("no")
    assert main(["export", str(folder), "--crate"]) == 1
    assert "comparison.csv is not as its job left it" in capsys.readouterr().err
    for path in folder.iterdir():
        path.unlink() if path.is_file() else None
    shutil.rmtree(folder / "made")
    assert main(["export", str(folder), "--crate"]) == 1
    assert "has not been run to its end" in capsys.readouterr().err


def test_it_is_a_crate_by_the_standard(crate, entities):
    """Some of what version 1.1 and the profile Process Run Crate ask for."""
    descriptor, root = entities["ro-crate-metadata.json"], entities["./"]
    assert descriptor["about"] == {"@id": "./"}
    assert descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.1"}
    assert date.fromisoformat(root["datePublished"]) and root["name"] and root["description"]
    assert entities[root["license"]["@id"]]["@type"] == "CreativeWork"
    assert entities[root["conformsTo"]["@id"]]["@type"] == "CreativeWork"
    content = json.loads((crate / "ro-crate-metadata.json").read_text())
    assert len(content["@graph"]) == len(entities)
    links = re.findall(r'"@id": "([^"]+)"', (crate / "ro-crate-metadata.json").read_text())
    assert set(links) - set(entities) == {"https://w3id.org/ro/crate/1.1"}
    mentioned = {one["@id"] for one in root["mentions"]}
    assert mentioned == {name for name in entities if name.startswith("#job/")}
    assert entities["#branchcrush"]["@type"] == "SoftwareApplication"
    read_again = ROCrate(str(crate))
    assert len(list(read_again.get_entities())) == len(entities)


def test_no_licence_is_told_as_none(crate, tmp_path):
    shutil.copytree(crate, tmp_path / "results")
    assert main(["export", str(tmp_path), "--crate"]) == 0
    graph = json.loads((tmp_path / "results/ro-crate-metadata.json").read_text())["@graph"]
    root = next(entity for entity in graph if entity["@id"] == "./")
    assert root["license"].startswith("No licence is stated")


def test_software_whose_address_is_not_known_has_none(crate, tmp_path, monkeypatch):
    monkeypatch.delitem(_ADDRESSES, "numpy")
    shutil.copytree(crate, tmp_path / "results")
    assert main(["export", str(tmp_path), "--crate"]) == 0
    graph = json.loads((tmp_path / "results/ro-crate-metadata.json").read_text())["@graph"]
    (numpy,) = (entity for entity in graph if entity["@id"] == "#numpy")
    assert numpy["softwareVersion"] and "url" not in numpy
