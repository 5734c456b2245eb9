"""How far a packing is, and why a job failed, read from the ends of logs."""

import pytest

from snakemake_logger_plugin_branchcrush.progress import (
    failure_message,
    log_mark,
    packing_progress,
)


def test_the_latest_strain_step_of_the_log_counts(packing_log):
    assert str(packing_progress(packing_log())) == "state 7 of 16, phi 0.652, 12.3 MPa"


def test_a_step_that_is_not_wholly_written_does_not_count(packing_log):
    log = packing_log(text="step 3: state 2 of 5, edge 1 m, solid fraction 0.5, mean stress 7e")
    assert packing_progress(log) is None


@pytest.mark.parametrize("text", ["", "LAMMPS\n", "step 3: edge 0.1 m, mean stress 3 Pa\n"])
def test_before_the_first_step_nothing_is_known(packing_log, text):
    assert packing_progress(packing_log(text=text)) is None
    assert packing_progress("no such file") is None


def test_only_the_end_of_a_long_log_is_read(packing_log):
    text = "step 1: state 1 of 5, edge 1 m, solid fraction 0.5, mean stress 7 Pa\n"
    assert packing_progress(packing_log(text=text + "x" * 60_000)).state == 1
    assert packing_progress(packing_log(text=text + "x" * 70_000)) is None


@pytest.mark.parametrize(
    ("end", "message"),
    [
        ("branchcrush: no place for grain 3\n", "no place for grain 3"),
        ("branchcrush: two lines\nof one message\n", "two lines\nof one message"),
        ("branchcrush: 2.125 s inside LAMMPS\n", ""),
        ("branchcrush: 2 s inside LAMMPS\nbranchcrush: disk full\n", "disk full"),
        (
            "branchcrush: 2 s inside LAMMPS\nTraceback (most recent call last):\n  ...\n"
            "ZeroDivisionError: division by zero\n",
            "ZeroDivisionError: division by zero",
        ),
        ("   Step\n   7460\n", ""),
    ],
)
def test_a_failed_job_is_told_by_the_end_of_its_log(packing_log, end, message):
    assert failure_message(packing_log(text="LAMMPS\n" + end)) == message


def test_a_log_that_is_written_anew_has_another_mark(packing_log, tmp_path):
    log = packing_log()
    before = log_mark(log)
    assert log_mark(log) == before
    (tmp_path / log).rename(tmp_path / "old.log")
    assert log_mark(log) == ()
    packing_log()
    assert log_mark(log) not in (before, ())
