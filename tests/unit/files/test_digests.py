"""Digests of files: right whatever happened to the file, and found without reading it again."""

import os
from pathlib import Path

import pytest

from branchcrush.files import digests
from branchcrush.files.digests import Digests, file_digest

# As sha256sum prints them.
ABC = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
ABD = "a52d159f262b2c6ddb724a61840befc36eb30c88877a4030b65cbe86298449c9"


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").mkdir()
    Path("results/a.csv").write_text("abc")
    return tmp_path


@pytest.fixture
def read(monkeypatch):
    """Holds the files that were read."""
    files = []

    def counted(path):
        files.append(path)
        return file_digest(path)

    monkeypatch.setattr(digests, "file_digest", counted)
    return files


def noted():
    first = Digests("fit")
    assert first.of("results/a.csv") == ABC
    first.note()


def test_a_file_is_read_once_and_by_no_later_job(read):
    noted()
    assert Digests("checked").of("results/a.csv") == ABC
    assert read == ["results/a.csv"]


def test_a_touched_file_is_read_again_and_then_known(read):
    noted()
    os.utime("results/a.csv", ns=(1, 1))
    for _ in range(2):
        check = Digests("checked")
        assert check.of("results/a.csv") == ABC
        check.note()
    assert len(read) == 2


def test_other_content_of_the_same_size_and_time_is_seen():
    noted()
    times = os.stat("results/a.csv")
    Path("results/a.csv").write_text("abd")
    os.utime("results/a.csv", ns=(times.st_atime_ns, times.st_mtime_ns))
    assert Digests("fit").of("results/a.csv") == ABD


def test_what_a_disk_changed_by_itself_is_read_by_whoever_does_not_trust_notes(monkeypatch):
    noted()
    status, real = os.stat("results/a.csv"), os.stat
    Path("results/a.csv").write_text("abd")
    monkeypatch.setattr(
        "branchcrush.files.digests.os.stat",
        lambda path, **how: status if path == "results/a.csv" else real(path, **how),
    )
    assert Digests("job").of("results/a.csv") == ABC
    doubtful = Digests("job", trust=False)
    assert doubtful.of("results/a.csv") == ABD
    doubtful.note()
    # Now there are two of one state, and everybody reads it.
    assert Digests("checked").of("results/a.csv") == ABD


@pytest.mark.parametrize("damage", ["", "{", "[1]", '{"a.csv": 3}', '{"a.csv": [1, 2, 3, []]}'])
def test_damaged_notes_cost_time_alone(damage):
    noted()
    Path(".snakemake/branchcrush/results/fit.json").write_text(damage)
    assert Digests("fit").of("results/a.csv") == ABC


def test_a_file_that_is_not_there_has_no_digest(here):
    assert Digests("fit").of("results/b.csv") == ""
    assert Digests("fit").of("results") == ""


def test_nothing_is_noted_outside_of_the_folder(here, tmp_path_factory):
    data = tmp_path_factory.mktemp("data") / "sieve.csv"
    data.write_text("abc")
    check = Digests("fit")
    assert check.of(str(data)) == ABC
    assert check.of(os.path.relpath(data)) == ABC
    check.note()
    assert not Path(".snakemake").exists()


def test_notes_of_files_that_are_gone_are_dropped():
    noted()
    Path("results/a.csv").rename("results/b.csv")
    check = Digests("fit")
    assert check.of("results/b.csv") == ABC
    check.note()
    assert "a.csv" not in Path(".snakemake/branchcrush/results/fit.json").read_text()
