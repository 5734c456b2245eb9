"""How a job ends: what stands in its log, on the screen, and in its exit code."""

import pytest

from branchcrush.errors import ConfigError, GradingError
from branchcrush.jobs import job


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
