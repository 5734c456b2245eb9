"""The workflow as others of the ecosystem use it: a module of theirs, by the catalogue's layout."""

import re
from pathlib import Path

import pytest
import yaml

from branchcrush.command.main import main
from branchcrush.files.tables import read_table

ROOT = Path(__file__).parents[2]
PARENT = """\
module branchcrush:
    snakefile: "{root}/Snakefile"
    config: config["crushing"]{more}


use rule * from branchcrush{names}


rule exponents:
    default_target: True
    input:
        "{folder}results/comparison.csv",
    output:
        "exponents.txt",
    shell:
        "cp {{input}} {{output}}"
"""
CONFIG = """\
crushing:
  samples:
    tiny:
      grading: {form: sieve, basis: mass, size: diameter, unit: mm, file: sand.csv}
      grains: 60
      allow_unrepresentative: true
      loading: {edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 4, quality: draft}
      seeds: [3, 5]
      refined_seeds: 0
"""
SAND = "0.3,0\n0.6,50\n1,100\n"
RENAMED_IN_A_FOLDER = (" as crushing_*", '\n    prefix: "crushing"', "crushing/")


@pytest.fixture
def parent(study):
    """Return what makes the folder one with a workflow that uses this one."""

    def made(names="", more="", folder=""):
        study.snakefile = study.folder / "Snakefile"
        study.snakefile.write_text(PARENT.format(root=ROOT, names=names, more=more, folder=folder))
        (study.folder / "config.yaml").unlink()
        (study.folder / "parent.yaml").write_text(CONFIG)
        (study.folder / "sand.csv").write_text(SAND)
        return study

    return made


def output_of(run):
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout + run.stderr


@pytest.mark.parametrize("prefix", ["", "crushing_"])
def test_a_module_plans_all_that_another_workflow_asks_of_it(parent, prefix):
    study = parent(f" as {prefix}*" if prefix else "")
    planned = output_of(study.snakemake("-n", "--configfile", "parent.yaml"))
    assert len(re.findall(f"^rule {prefix}compression:", planned, re.MULTILINE)) == 2
    assert "rule exponents:" in planned
    # What the other workflow asks for, and not all that this one would make.
    assert f"rule {prefix}report:" not in planned
    assert re.search(r"^ +input: .*\bsand\.csv$", planned, re.MULTILINE), planned


def test_a_module_runs_and_another_workflow_goes_on_from_its_results(parent, capsys):
    study = parent(*RENAMED_IN_A_FOLDER)
    output_of(study.snakemake("--configfile", "parent.yaml"))
    table = read_table(study.folder / "exponents.txt")
    assert list(table["sample"]) == ["tiny"]
    assert main(["verify", str(study.folder / "crushing")]) == 0
    (study.folder / "sand.csv").write_text("0.3,0\n0.6,51\n1,100\n")
    assert main(["verify", str(study.folder / "crushing")]) == 1
    assert "were made from another sand.csv than the one that is there" in capsys.readouterr().err
    (study.folder / "sand.csv").write_text(SAND)
    again = output_of(study.snakemake("--configfile", "parent.yaml", "--dry-run"))
    assert "Nothing to be done" in again
    files = {str(path.parent) for path in study.contents()}
    assert not [folder for folder in files if folder.startswith(("results", "logs"))]


def test_a_module_refuses_a_wrong_configuration_in_the_same_words(parent):
    study = parent()
    wrong = CONFIG.replace("grains: 60", "grains: 1")
    (study.folder / "parent.yaml").write_text(wrong)
    problems = study.refused("--configfile", "parent.yaml")
    assert problems == [
        "config: samples.tiny.grains = 1: must be a whole number from 2 to 10000000"
    ]


def test_the_catalogue_finds_a_snakefile_that_plans_the_whole_study(study):
    study.snakefile = ROOT / "workflow" / "Snakefile"
    planned = output_of(study.snakemake("--dry-run"))
    for rule in ("compression", "comparison", "report", "fit_figures"):
        assert f"rule {rule}:" in planned
    assert (ROOT / "config" / "README.md").is_file()
    catalogue = (ROOT / ".snakemake-workflow-catalog.yml").read_text(encoding="utf-8")
    assert yaml.safe_load(catalogue)["usage"]["report"] is True
