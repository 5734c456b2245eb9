"""The tutorial: its configuration is taken, its commands exist, its numbers are those of a run."""

import csv
import re
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import pytest

from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study
from branchcrush.config.file import config_file_problem
from branchcrush.config.sample import sample_of
from branchcrush.gradings.representativity import representativity
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.study.preview import sample_plan
from branchcrush.study.preview_text import preview_text
from branchcrush.study.summary import summary

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tutorial():
    spec = spec_from_file_location("tutorial", ROOT / "docs" / "tutorial.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def study(tutorial, tmp_path, monkeypatch):
    """The study of the tutorial, checked as a run checks it, in its folder."""
    import yaml

    tutorial.write(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert config_file_problem("config.yaml") is None
    config = yaml.safe_load((tmp_path / "config.yaml").read_text(encoding="utf-8"))
    return checked_study(config).samples["my_sand"].settings()


def test_the_files_of_the_tutorial_are_a_study_without_a_warning(study):
    grading = grading_of(study["grading"])
    smallest, largest = grading.support()
    assert (2e3 * smallest, 2e3 * largest) == pytest.approx((0.25, 0.6))
    # As the page says of 800 grains and of 400.
    end = sample_of(study).end
    assert representativity(grading, study["grains"], end).verdict == "accept"
    assert representativity(grading, 400, end).verdict == "warn"


def test_the_page_has_the_size_of_the_cell_that_the_preview_prints(study):
    sample = sample_of(study)
    radii = sampled_radii(sample.grading, sample.grains, sample.sampling, np.random.default_rng(1))
    plan = sample_plan(sample, radii, 1e-7, None)
    text = " ".join(preview_text({"my_sand": plan}, 2, {"my_sand": "a.png"}, {}).split())
    printed = re.search(r"([\d.]+) largest diameters \(D99\.9\)", text)[1]
    assert f"about {float(printed):.1f} largest diameters (D99.9)" in PAGE


def test_a_file_is_found_by_the_line_above_its_block(tutorial):
    page = "Save as `my_sand/a.csv`:\n\n```text\n1, 2\n```\n\nor `my_sand/b`\n\n```sh\nls\n```\n"
    assert tutorial.files(page) == {"a.csv": "1, 2\n"}


def test_every_command_is_there():
    commands = [
        line
        for block in re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL)
        for line in block.splitlines()
    ]
    targets = re.findall(r"^([a-z]+):.*## ", (ROOT / "Makefile").read_text(), re.MULTILINE)
    rules = {
        name
        for file in (ROOT / "workflow" / "rules").glob("*.smk")
        for name in re.findall(r"^rule (\w+):", file.read_text(), re.MULTILINE)
    }
    for command in commands:
        program, *words = command.split()
        if program == "make":
            assert set(words) <= set(targets), command
        elif program == "snakemake":
            assert words[:4] == ["--cores", "2", "--directory", "my_sand"], command
            assert set(words[4:]) <= rules, command
        else:
            assert program in ("mkdir", "source"), command
    named = re.findall(r"`make (\w+)", PAGE)
    assert set(named) <= set(targets)


def test_the_numbers_of_the_page_are_those_of_the_run_beside_it(tmp_path):
    table = (ROOT / "docs" / "results" / "tutorial.csv").read_text(encoding="utf-8")
    row = next(csv.DictReader(table.splitlines()[1:]))
    (tmp_path / "comparison.csv").write_text(table, encoding="utf-8")
    n, low, high = (
        f"{float(row[name]):.2f}" for name in ("exponent", "exponent_low", "exponent_high")
    )
    closing = summary(tmp_path).splitlines()[0]
    assert f"> {closing}\n" in PAGE
    assert f"n = {n} (95 % interval {low} to {high}" in PAGE
    assert f"*{row['verdict']}*" in PAGE
    assert f"θ = {float(row['theta']):.2f}" in PAGE
    assert f"φ_J = {float(row['jamming_solid_fraction']):.3f}" in PAGE
    assert f"φ = {float(row['solid_fraction']):.3f}" in PAGE
