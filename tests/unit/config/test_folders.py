"""Folders that results and logs cannot go to are found before any job."""

import shutil
from collections import namedtuple

import pytest

from branchcrush.config.folders import folder_problems

SAMPLES = {"sand": [1, 2], "mica": [3]}
Usage = namedtuple("Usage", "total used free")


@pytest.mark.parametrize(
    "place",
    [
        "results",
        "logs",
        ".snakemake",
        ".branchcrush",
        ".branchcrush/claims",
        ".branchcrush/checkpoints",
        "results/made",
        "results/figures/findings",
        "results/sand",
        "results/sand-refined/seed_2",
        "results/mica/made",
        "results/mica/crushing/seed_3",
        "results/figures/mica",
        "results/measured/clay",
        "logs/sand/seed_1",
        "logs/measured",
    ],
)
def test_a_file_in_the_place_of_a_folder_is_named(tmp_path, place):
    assert folder_problems(tmp_path, SAMPLES, ["clay"]) == []
    (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / place).touch()
    (line,) = folder_problems(tmp_path, SAMPLES, ["clay"])
    assert line == f"{place} is a file, and results need a folder there: move it"


def test_of_many_folders_the_first_are_named(tmp_path):
    for seed in range(40):
        (tmp_path / "logs/sand").mkdir(parents=True, exist_ok=True)
        (tmp_path / f"logs/sand/seed_{seed}").touch()
    lines = folder_problems(tmp_path, {"sand": range(40)})
    assert len(lines) == 6
    assert lines[-1] == "and 35 more folders like these"


def test_a_disk_without_room_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda path: Usage(1e9, 1e9, 9_950_000))
    (line,) = folder_problems(tmp_path, SAMPLES)
    assert line.startswith(f"the disk of {tmp_path} has 9.9 MB left")
    monkeypatch.setattr(shutil, "disk_usage", lambda path: Usage(1e9, 1e9, 10_000_000))
    assert folder_problems(tmp_path, SAMPLES) == []
