"""Two runs in one folder: the second says who is there; what only looks is let through."""

import os

import pytest

from branchcrush.runs import one_run


@pytest.fixture
def taken(study, monkeypatch):
    """The folder of a study while this process has a run in it."""
    monkeypatch.chdir(study.folder)
    with one_run():
        # What is typed in the folder is no job of that run.
        # Not by monkeypatch, which would put it back when the run has ended.
        del os.environ["BRANCHCRUSH_RUN"]
        yield study


def test_second_run_is_refused_in_one_sentence(taken):
    run = taken.snakemake()
    text = run.stdout + run.stderr
    assert run.returncode == 1
    (line,) = [line for line in text.splitlines() if "another run" in line]
    assert f"process {os.getpid()} on {os.uname().nodename}, `" in line
    assert "Traceback" not in text
    assert not (taken.folder / "results").exists()


def test_what_only_looks_needs_no_lock(taken):
    for arguments in (["--dry-run"], ["--unlock"], ["--list"]):
        run = taken.snakemake(*arguments, cores=None)
        assert run.returncode == 0, run.stdout + run.stderr


def test_a_lock_that_snakemake_left_keeps_no_run_out(finished):
    locks = finished.folder / ".snakemake" / "locks"
    locks.mkdir(exist_ok=True)
    (locks / "0.output.lock").write_text("results/tiny/seed_3/path.csv\n")
    for arguments in ([], ["--workflow-profile", "none"]):
        run = finished.snakemake(*arguments)
        assert run.returncode == 0, run.stdout + run.stderr
        assert "Nothing to be done" in run.stdout + run.stderr
    (locks / "0.output.lock").unlink()
