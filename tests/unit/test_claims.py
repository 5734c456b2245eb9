"""Who makes which result: claims that go with the process that holds them."""

import contextlib
import errno
import fcntl
import os
import signal
import subprocess
import sys
import time

import pytest

from branchcrush import claims
from branchcrush.claims import CLAIMS, claimed, standing_claims
from branchcrush.files import locks

RESULT = "results/sand/seed_1/made.json"
HOLD = f"""\
import time
from branchcrush.claims import claimed
with claimed({RESULT!r}):
    print(1, flush=True)
    time.sleep(60)
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("SLURM_JOB_ID", raising=False)
    return tmp_path


@contextlib.contextmanager
def holder(**environment):
    """Another process that has the claim."""
    command = [sys.executable, "-c", HOLD]
    process = subprocess.Popen(
        command, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    with process:
        process.stdout.readline()
        try:
            yield process
        finally:
            process.kill()


def test_a_claim_tells_who_has_it():
    with holder(SLURM_JOB_ID="17") as process:
        (claim,) = standing_claims()
        assert claim[:4] == (RESULT, os.uname().nodename, process.pid, "Slurm job 17")
        assert str(claim).startswith(f"{RESULT} (Slurm job 17 on {os.uname().nodename} since 20")
    with holder():
        (claim,) = standing_claims()
        assert claim.job == ""


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_a_dead_job_gives_its_claim_up(number, capfd):
    with holder() as process:
        process.send_signal(number)
        process.wait()
        assert standing_claims() == []
        with claimed(RESULT):
            assert [claim.process for claim in standing_claims()] == [os.getpid()]
    assert standing_claims() == []
    assert not any(CLAIMS.iterdir())
    assert capfd.readouterr().err == ""


def test_who_comes_second_waits_until_the_first_has_ended():
    another = [sys.executable, "-c", HOLD]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with (
        holder(SLURM_JOB_ID="17") as first,
        subprocess.Popen(another, text=True, **pipes) as second,
    ):
        waits = second.stderr.readline()
        assert waits.startswith(f"branchcrush: waits for {RESULT} (Slurm job 17 on ")
        time.sleep(0.3)
        assert [claim.process for claim in standing_claims()] == [first.pid]
        first.kill()
        assert second.stdout.readline() == "1\n"
        assert [claim.process for claim in standing_claims()] == [second.pid]
        second.kill()


def test_other_results_are_free():
    with holder(), claimed("results/sand/seed_2/made.json"):
        assert len(standing_claims()) == 2


def test_to_ask_for_claims_makes_no_file_and_keeps_nobody_from_a_claim_that_is_begun(monkeypatch):
    CLAIMS.mkdir(parents=True)
    begun = CLAIMS / "begun"
    begun.touch()
    taken = []
    flock = fcntl.flock
    monkeypatch.setattr(fcntl, "flock", lambda *how: (taken.append(how), flock(*how)))
    assert standing_claims() == [] and taken == []
    # One that ends between the listing of the folder and the look at it.
    monkeypatch.setattr(type(CLAIMS), "glob", lambda *_: [CLAIMS / "ended"])
    monkeypatch.setattr(claims, "_read", lambda path: claims.Claim("a", "b", 1, "", "now"))
    assert standing_claims() == []
    assert list(CLAIMS.iterdir()) == [begun]


def test_a_file_system_without_locks_is_told_of_once_in_a_process(monkeypatch, capfd):
    def refused(*_):
        raise OSError(errno.ENOLCK, "no locks")

    monkeypatch.setattr(fcntl, "flock", refused)
    locks._tell_of_no_locks.cache_clear()
    for name in ("first", "second"):
        with claimed(f"results/{name}.json"):
            assert standing_claims() == []
    said = capfd.readouterr().err
    assert said.count("without locks") == 1 and said.count("\n") == 1
