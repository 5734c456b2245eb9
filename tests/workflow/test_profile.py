"""The profile beside the Snakefile is read however the workflow is run, and each setting acts."""

import base64
import re
import shlex
from pathlib import Path

import pytest
import yte
from snakemake.cli import parse_args

ROOT = Path(__file__).parents[2]
READ = "Using workflow specific profile {} for setting default command line arguments."
MADE = re.findall(r"\bsnakemake (--cores .*)", (ROOT / "Makefile").read_text(encoding="utf-8"))


def read(arguments, capsys):
    _, settings = parse_args(arguments)
    sentence = READ.format(".*profiles/default")
    assert re.fullmatch(sentence, capsys.readouterr().err.strip())
    assert settings.rerun_incomplete
    assert settings.scheduler == "greedy"


@pytest.mark.parametrize("more", [[], ["--directory", "examples"], ["preview"], ["-n"]])
def test_in_the_folder_of_the_snakefile(more, capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    read(["--cores", "1", *more], capsys)


def test_from_any_other_folder(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    read(["--cores", "1", "--snakefile", str(ROOT / "Snakefile")], capsys)


def test_by_every_command_of_make(capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    assert len(MADE) >= 5
    for line in MADE:
        read(shlex.split(line.replace("$(CORES)", "2")), capsys)


def profile(name):
    with open(ROOT / "profiles" / name / "config.yaml", encoding="utf-8") as file:
        return yte.process_yaml(file, require_use_yte=True)


def test_the_profile_of_slurm_holds_what_the_default_one_does():
    # It takes its place.
    assert profile("default").items() <= profile("slurm").items()
    assert profile("slurm")["executor"] == "slurm"


def test_the_profile_of_slurm_takes_account_and_partition_from_slurms_own_variables(monkeypatch):
    names = {"slurm_account": "SBATCH_ACCOUNT", "slurm_partition": "SBATCH_PARTITION"}
    for variable in names.values():
        monkeypatch.delenv(variable, raising=False)
    assert not names.keys() & profile("slurm")["default-resources"].keys()
    for resource, variable in names.items():
        monkeypatch.setenv(variable, "ab12")
        assert profile("slurm")["default-resources"][resource] == "ab12"


def test_what_a_job_left_unfinished_is_made_anew_with_the_profile_and_without(finished):
    name = base64.urlsafe_b64encode(b"results/tiny/seed_5/path.csv").decode()
    mark = finished.folder / ".snakemake" / "incomplete" / name
    mark.parent.mkdir(exist_ok=True)
    mark.write_text("{}")
    try:
        for arguments in ([], ["--workflow-profile", "none"]):
            run = finished.snakemake("--dry-run", "--quiet", "host", *arguments)
            text = run.stdout + run.stderr
            assert run.returncode == 0, text
            assert ("Using workflow specific profile" in text) == (not arguments)
            # The screen of the profile names the job in a line, Snakemake's own its files.
            again, finished_seed = (
                ("seed 5", "seed 3") if not arguments else ("seed_5/path.csv", "seed_3/path.csv")
            )
            assert again in text and finished_seed not in text.split("input:")[0]
    finally:
        mark.unlink()


def test_what_reads_all_packings_asks_for_more_memory_where_they_are_large(study):
    sample = "\n".join(
        [
            "samples:",
            "  large:",
            "    grading: {form: single, size: radius, unit: mm, value: 1.0}",
            "    loading: {edge_reduction: 0.4, states: 15}",
            "    grains: 100000",
            "    seeds: 40",
            "    refined_seeds: 0",
        ]
    )
    study.configure(sample + "\n")
    arguments = ("--dry-run", "--workflow-profile", "none")
    run = study.snakemake(*arguments, "results/large/sharing.json")
    text = run.stdout + run.stderr
    assert run.returncode == 0, text
    # 150 MB, and 150 bytes of 3 contacts a grain in 17 states of one and two of all; half more.
    (job,) = (part for part in text.split("\n\n") if "rule sharing:" in part)
    assert "mem_mb=6800," in job
