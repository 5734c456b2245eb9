"""A script of LAMMPS is run with its variables, and tells how it ended."""

import errno
import json
import os
import re
import signal
import subprocess
import sys
import traceback

import numpy as np
import pytest

from branchcrush.errors import SimulationError
from branchcrush.jobs import message_of
from branchcrush.lammps.processes import start_of
from branchcrush.lammps.run import declared_variables, main, run_script, run_task

SCRIPT = """\
# variable commented index 1
variable number   index 0.5
variable several  index 1 2 3
variable word     index none
variable failed   equal 0
variable failure  string "nothing"
variable edge     equal 0.25
print "number ${number}, word ${word}"
label again
print "value ${several}"
next several
jump SELF again
"""
STOPPED = SCRIPT.replace("equal 0\n", "equal 1\n").replace("nothing", "2 grains escaped")
WRONG = SCRIPT.replace("label again", "pair_style nowhere")


@pytest.fixture
def run(tmp_path):
    """Return a function that runs a script, and returns why it stopped and its log."""

    def run(text, variables, ranks=1):
        script, log = tmp_path / "in.example", tmp_path / "log"
        script.write_text(text)
        return run_script(script, variables, log, ranks), log.read_text()

    return run


def printed(log):
    """Return the lines that the script itself printed, each once."""
    return list(dict.fromkeys(re.findall(r"^(?:number|value) [^$\n]*$", log, re.MULTILINE)))


def test_variables_with_a_default_are_those_of_style_index(tmp_path):
    (tmp_path / "in.example").write_text(SCRIPT)
    declared = declared_variables(tmp_path / "in.example")
    assert declared == {"number": "0.5", "several": "1 2 3", "word": "none"}


def test_defaults_hold_for_what_is_not_given(run):
    stopped, log = run(SCRIPT, {})
    assert stopped == ""
    assert printed(log) == ["number 0.5, word none", "value 1", "value 2", "value 3"]


def test_values_arrive_with_all_their_digits(run):
    # NumPy's own text of a number is none to LAMMPS.
    given = {"number": np.float64(0.1) + 0.2, "several": [1 / 3, np.float64(1e-5)], "word": "walls"}
    _, log = run(SCRIPT, given)
    assert printed(log) == [
        "number 0.30000000000000004, word walls",
        "value 0.3333333333333333",
        "value 1e-05",
    ]


def test_last_line_of_the_log_is_the_time_inside_lammps(run):
    _, log = run(SCRIPT, {"word": "late"})
    match = re.fullmatch(r"branchcrush: (\d+\.\d{3}) s inside LAMMPS", log.splitlines()[-1])
    assert 0 < float(match[1]) < 60


def test_script_that_stops_says_where_and_why(run):
    stopped, _ = run(STOPPED, {})
    assert stopped == "stopped at an edge of 0.25 m: 2 grains escaped"


def test_error_of_lammps_is_one_line_that_names_the_log(run, tmp_path):
    with pytest.raises(SimulationError) as refused:
        run(WRONG, {})
    message = str(refused.value)
    assert message.startswith("LAMMPS stopped: ")
    assert "nowhere" in message and "\n" not in message
    assert message.endswith(f" (log: {tmp_path / 'log'})")
    assert (tmp_path / "log").read_text().endswith(" s inside LAMMPS\n")


def test_misspelt_variables_are_named_and_nothing_runs(run, tmp_path):
    with pytest.raises(SimulationError, match=r"^in\.example declares no variable edge, nmber$"):
        run(SCRIPT, {"nmber": 1.0, "word": "a", "edge": 2.0})
    assert not (tmp_path / "log").exists()


def test_ranks_without_a_launcher_are_refused(run, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SimulationError, match="3 ranks were asked for, and there is no mpiexec"):
        run(SCRIPT, {}, ranks=3)


def full_disk(lammps, payload):
    raise OSError(errno.ENOSPC, "No space left on device", payload["file"])


def mistaken(lammps, payload):
    return payload["no such key"]


def refusing(lammps, payload):
    raise SimulationError("3 grains are overloaded: lower it")


@pytest.mark.parametrize("ranks", [1, 2])
def test_what_a_task_raises_is_no_error_of_lammps(tmp_path, monkeypatch, ranks):
    (tmp_path / "in.example").write_text(SCRIPT)
    # Where ranks find this module.
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, sys.path)))

    def run(task):
        run_task(task, {"file": "state"}, tmp_path / "in.example", {}, tmp_path / "log", ranks)

    with pytest.raises(OSError) as full:
        run(full_disk)
    words = "No space left on device, state: free some space, then repeat the command"
    assert message_of(full.value) == words
    with pytest.raises(SimulationError) as refused:
        run(refusing)
    assert message_of(refused.value) == "3 grains are overloaded: lower it"
    with pytest.raises(KeyError) as mistake:
        run(mistaken)
    told = "".join(traceback.format_exception(mistake.value))
    assert 'return payload["no such key"]' in told


def job_in(folder, text, ranks=1):
    (folder / "in.example").write_text(text)
    arguments = ["-screen", "none", "-log", "none"]
    payload = {"script": str(folder / "in.example")}
    task = "branchcrush.lammps.run:script_task"
    (folder / "job.json").write_text(json.dumps([task, payload, arguments, ranks]))


def test_rank_leaves_its_result_in_the_folder_of_its_job(tmp_path):
    job_in(tmp_path, STOPPED)
    main(tmp_path)
    result = json.loads((tmp_path / "result.json").read_text())
    assert result.pop("seconds") > 0
    stopped = "stopped at an edge of 0.25 m: 2 grains escaped"
    assert result == {"rank": 0, "stopped": stopped, "error": ""}


def test_rank_that_fails_leaves_its_error_and_ends(tmp_path):
    job_in(tmp_path, WRONG)
    with pytest.raises(SimulationError, match="nowhere"):
        main(str(tmp_path))
    assert "nowhere" in json.loads((tmp_path / "result.json").read_text())["error"]


def test_job_for_more_ranks_than_there_are_is_refused(tmp_path):
    job_in(tmp_path, SCRIPT, ranks=2)
    with pytest.raises(SimulationError, match=r"2 ranks were asked for, and .* a world of 1"):
        main(tmp_path)


def test_rank_whose_job_died_before_it_began_runs_nothing(tmp_path):
    job_in(tmp_path, SCRIPT)
    command = [sys.executable, "-m", "branchcrush.lammps.rank", "branchcrush.lammps.run", tmp_path]
    # The same number, given to a process that began later.
    ended = subprocess.run([*map(str, command), str(os.getpid()), "1"])
    assert ended.returncode == -signal.SIGTERM
    assert not (tmp_path / "result.json").exists()
    subprocess.run([*map(str, command), str(os.getpid()), start_of(os.getpid())], check=True)
    assert (tmp_path / "result.json").exists()


@pytest.mark.parametrize("place", ["full", "folder"])
def test_a_log_that_cannot_be_written_hides_no_message_of_lammps(tmp_path, place):
    script, log = tmp_path / "in.example", tmp_path / "log"
    script.write_text(WRONG)
    log.symlink_to("/dev/full") if place == "full" else log.mkdir()
    with pytest.raises(SimulationError) as refused:
        run_script(script, {}, log)
    message = str(refused.value)
    assert message.startswith("LAMMPS stopped: ") and "\n" not in message
    assert ("nowhere" if place == "full" else str(log)) in message
