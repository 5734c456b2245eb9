"""How a job ends: what stands in its log, on the screen, and in its exit code."""

import errno
import os
import tempfile

import pytest

from branchcrush.claims import CLAIMS, claimed
from branchcrush.errors import ConfigError, GradingError
from branchcrush.files.scratch import scratch_folder
from branchcrush.jobs import job
from branchcrush.lammps import links


def test_job_that_ends_well_leaves_its_log_alone(tmp_path, capsys):
    log = tmp_path / "logs" / "mine" / "fit.log"
    with job(str(log)):
        pass
    assert log.read_bytes() == b""
    log.write_text("LAMMPS\n")
    with job(log):
        pass
    assert log.read_text() == "LAMMPS\n"
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize("kind", [ConfigError, GradingError])
def test_error_of_the_package_is_one_message_behind_what_the_log_holds(tmp_path, capsys, kind):
    log = tmp_path / "fit.log"
    log.write_text("LAMMPS\n")
    with pytest.raises(SystemExit) as ended, job(log):
        raise kind("κ is wrong:\ncorrect it")
    assert ended.value.code == 1
    message = "branchcrush: κ is wrong:\ncorrect it\n"
    assert log.read_text(encoding="utf-8") == "LAMMPS\n" + message
    assert capsys.readouterr() == ("", message)


def test_any_other_error_is_logged_whole_and_raised(tmp_path):
    with pytest.raises(ZeroDivisionError), job(tmp_path / "fit.log"):
        1 / 0  # noqa: B018
    first, *_, last = (tmp_path / "fit.log").read_text().splitlines()
    assert first == "Traceback (most recent call last):"
    assert last.startswith("ZeroDivisionError: ")


def test_interruption_is_no_error(tmp_path):
    with pytest.raises(KeyboardInterrupt), job(tmp_path / "fit.log"):
        raise KeyboardInterrupt
    assert (tmp_path / "fit.log").read_text() == ""


def ended(log, error):
    """Return what a job that an error ends says on the screen."""
    with pytest.raises(SystemExit) as caught, job(log):
        raise error
    assert caught.value.code == 1


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (
            OSError(errno.ENOSPC, "No space left on device"),
            "No space left on device: free some space, then repeat the command",
        ),
        (
            PermissionError(errno.EACCES, "Permission denied", "results/a.csv"),
            "Permission denied, results/a.csv: change its permissions, then repeat the command",
        ),
        (
            MemoryError("Unable to allocate 7.6 GiB"),
            "not enough memory: Unable to allocate 7.6 GiB; run fewer jobs at a time (--cores), or "
            "ask for fewer grains or states",
        ),
    ],
)
def test_what_the_machine_refuses_is_one_line(tmp_path, capsys, error, words):
    ended(tmp_path / "fit.log", error)
    assert (tmp_path / "fit.log").read_text() == f"branchcrush: {words}\n"
    assert capsys.readouterr().err == f"branchcrush: {words}\n"


def test_a_file_that_is_missing_is_a_fault_and_logged_whole(tmp_path):
    with pytest.raises(FileNotFoundError), job(tmp_path / "fit.log"):
        (tmp_path / "no.csv").read_text()
    assert "Traceback" in (tmp_path / "fit.log").read_text()


def test_a_full_disk_under_the_log_hides_no_message(tmp_path, capsys):
    # Opens, and takes nothing.
    (tmp_path / "fit.log").symlink_to("/dev/full")
    ended(tmp_path / "fit.log", GradingError("κ is wrong"))
    told = capsys.readouterr().err
    assert told == (
        f"{tmp_path / 'fit.log'} cannot be written (No space left on device), so it is told here: "
        "branchcrush: κ is wrong\n"
    )


def test_a_file_in_the_place_of_the_folder_of_logs_hides_no_message(tmp_path, capsys):
    (tmp_path / "logs").touch()
    ended(tmp_path / "logs" / "fit.log", GradingError("κ is wrong"))
    assert "so it is told here: branchcrush: κ is wrong" in capsys.readouterr().err


def a_file(claims):
    claims.parent.mkdir()
    claims.touch()


def links_in_a_ring(claims):
    claims.parent.symlink_to(claims.parent.name)


@pytest.mark.parametrize(
    ("place", "result", "words"),
    [
        (a_file, "made.json", "claims: move the file that lies in the place of a folder"),
        (links_in_a_ring, "made.json", "Too many levels of symbolic links, .branchcrush/claims"),
        (None, "long" * 100, "File name too long, .branchcrush/claims/longlong"),
    ],
)
def test_a_claim_that_cannot_be_had_is_one_line(
    tmp_path, monkeypatch, capsys, place, result, words
):
    monkeypatch.chdir(tmp_path)
    if place:
        place(CLAIMS)
    with pytest.raises(SystemExit) as ended, job("fit.log"), claimed(result):
        pass
    assert ended.value.code == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line and line.endswith(", then repeat the command")


def test_a_run_that_cannot_be_joined_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BRANCHCRUSH_RUN", "1 here 1 1 cluster")
    (tmp_path / ".branchcrush").symlink_to(".branchcrush")
    with pytest.raises(SystemExit) as ended, job("fit.log"):
        pass
    assert ended.value.code == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("branchcrush: Too many levels of symbolic links, ")
    assert line.endswith(
        ": remove the symbolic links that lead to each other, then repeat the command"
    )
    assert (tmp_path / "fit.log").read_text() == f"{line}\n"


def test_scratch_of_dead_jobs_of_this_machine_goes_wherever_it_lies(tmp_path, monkeypatch):
    given, other = tmp_path / "a b", tmp_path / "plain"
    monkeypatch.setattr(tempfile, "tempdir", str(given))
    monkeypatch.setattr(links, "_PLACES", (str(other),))
    dead = [folder / f"branchcrush-{os.uname().nodename}-dead" for folder in (given, other)]
    others = [other / "branchcrush-another-machine-1", other / "theirs"]
    for folder in (*dead, *others):
        folder.mkdir(parents=True)
        (folder / "inputs").touch()
    with scratch_folder("branchcrush-", other) as alive, job(tmp_path / "fit.log"):
        assert [path for path in dead if path.exists()] == []
        assert sorted(other.iterdir()) == sorted([alive, *others])
