"""One run in a folder at a time, and jobs that live no longer than their run."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from branchcrush import runs
from branchcrush.checkpoints import checkpoint_of
from branchcrush.errors import RunError
from branchcrush.runs import one_run

JOB = "from branchcrush.runs import join_run; import time; join_run(); print(1, flush=True); "
# Begins a run and a job in it, tells the job, and waits.
RUN = f"""\
import signal, subprocess, sys, time
from branchcrush.runs import one_run
# A shell lets what it runs in the background ignore Ctrl-C, and so would this.
signal.signal(signal.SIGINT, signal.default_int_handler)
job = [sys.executable, "-c", {JOB + "time.sleep(60)"!r}]
with one_run():
    process = subprocess.Popen(job, stdout=subprocess.PIPE)
    process.stdout.readline()
    print(process.pid, flush=True)
    try:
        process.wait()
    except KeyboardInterrupt:  # as Snakemake, which waits for what runs
        sys.exit(process.wait() < 0)
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def run():
    """A run in this folder, and its job, as processes of their own."""
    main = subprocess.Popen([sys.executable, "-c", RUN], stdout=subprocess.PIPE, text=True)
    main.job = int(main.stdout.readline())
    yield main
    main.kill()
    main.wait()
    main.stdout.close()


def ends(process):
    """Return whether a process ends within some seconds."""
    end = time.monotonic() + 10
    while time.monotonic() < end:
        try:
            state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            return True
        if state == "Z":
            return True
        time.sleep(0.02)
    return False


def test_second_run_is_told_of_the_first_in_one_sentence(run):
    with pytest.raises(RunError) as refused, one_run():
        pass
    told = re.fullmatch(
        r"another run has this folder since (.+): process (\d+) on (.+), `-c`; "
        "wait until it has ended, or end it",
        str(refused.value),
    )
    assert int(told[2]) == run.pid
    assert told[3] == os.uname().nodename
    assert told[1].startswith(time.strftime("%Y-%m-"))


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGHUP, signal.SIGTERM, signal.SIGINT])
def test_folder_is_free_and_the_job_dead_after_any_end(run, number):
    run.send_signal(number)
    # Before anybody has looked after the dead run.
    assert ends(run.job)
    assert run.wait(10) != 0
    with one_run():
        pass


def test_folder_is_free_after_a_run_and_after_an_error(folder):
    for _ in range(2):
        with pytest.raises(ZeroDivisionError), one_run():
            1 / 0  # noqa: B018
    with one_run():
        pass
    assert sorted(path.name for path in folder.iterdir()) == [".branchcrush"]


def test_what_a_job_kept_goes_with_the_next_run_only_if_its_record_is_there():
    records = [Path(f"results/sand/{part}/made.json") for part in ("seed_1", "crushing/seed_1")]
    for record in records:
        checkpoint_of(record).mkdir(parents=True)
        (checkpoint_of(record) / "state.kept").write_text("12")
    records[0].parent.mkdir(parents=True)
    records[0].write_text("{}")
    with one_run():
        assert [checkpoint_of(record).exists() for record in records] == [False, True]


def test_a_lock_that_was_removed_by_hand_ends_no_job(run, folder):
    (folder / ".branchcrush" / "run.lock").unlink()
    time.sleep(0.6)
    assert run.poll() is None


def of_run(run):
    return {**os.environ, "BRANCHCRUSH_RUN": run}


def test_job_whose_run_died_before_it_began_ends_at_once(folder):
    with one_run():
        run = os.environ["BRANCHCRUSH_RUN"]
        job = [sys.executable, "-c", JOB]
        assert subprocess.run(job, capture_output=True).stdout == b"1\n"
        # The same number, given to a process that began later.
        *rest, start = run.split(" ")
        other = " ".join([*rest, str(int(start) - 1)])
        (folder / ".branchcrush" / "run.lock").write_text(other)
        ended = subprocess.run(job, env=of_run(other), capture_output=True)
        assert (ended.returncode, ended.stdout) == (-signal.SIGKILL, b"")
    # Another run has the folder by now.
    with one_run():
        ended = subprocess.run(job, env=of_run(run), capture_output=True)
        assert (ended.returncode, ended.stdout) == (-signal.SIGKILL, b"")


def test_job_whose_shell_died_before_it_began_ends_at_once():
    waits = "import os, sys, time\nwhile os.getppid() == int(sys.argv[1]): time.sleep(0.01)\n"
    shell = ["sh", "-c", '"$0" -c "$1" $$ & exit', sys.executable]
    with one_run():
        # Until the output ends: nobody is left who could write to it. The run lives on.
        assert subprocess.run([*shell, waits + JOB], capture_output=True).stdout == b""
        # One that lives, between them.
        shell[2] = '"$0" -c "$1"; exit'
        assert subprocess.run([*shell, JOB], capture_output=True).stdout == b"1\n"


def test_no_run_begins_beside_a_job_of_an_earlier_one(folder, monkeypatch):
    monkeypatch.setattr(runs, "_PATIENCE", 0.5)
    lock = folder / ".branchcrush" / "jobs.lock"
    lock.parent.mkdir()
    holds = "import fcntl, sys, time; file = open(sys.argv[1], 'w'); "
    holds += "fcntl.flock(file, fcntl.LOCK_SH); print(1, flush=True); time.sleep(60)"
    job = subprocess.Popen([sys.executable, "-c", holds, str(lock)], stdout=subprocess.PIPE)
    with job.stdout:
        job.stdout.readline()
        with pytest.raises(RunError, match="jobs of an earlier run are still at work"), one_run():
            pass
    job.kill()
    job.wait()
    with one_run():
        pass


def test_folder_that_cannot_be_written_to_is_told(folder):
    (folder / ".branchcrush").touch()
    with pytest.raises(RunError, match=r"cannot be locked for a run: .*branchcrush"), one_run():
        pass


# Begins a run whose jobs are a cluster's, tells which it is, and waits.
CLUSTER_RUN = """\
import os, time
from branchcrush.runs import one_run
with one_run(cluster=True):
    print(os.environ["BRANCHCRUSH_RUN"], flush=True)
    time.sleep(60)
"""
CLUSTER_JOB = """\
import time
from branchcrush.claims import claimed
from branchcrush.runs import join_run
join_run()
with claimed("results/sand/seed_1/made.json"):
    print(1, flush=True)
    time.sleep(60)
"""


@pytest.fixture
def submitter():
    """A run of a cluster as a process of its own, and what begins a job of it."""
    main = subprocess.Popen([sys.executable, "-c", CLUSTER_RUN], stdout=subprocess.PIPE, text=True)
    environment = {**of_run(main.stdout.readline().strip()), "SLURM_JOB_ID": "17"}
    jobs = []

    def job():
        jobs.append(
            subprocess.Popen(
                [sys.executable, "-c", CLUSTER_JOB],
                env=environment,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
            )
        )
        return jobs[-1]

    main.job = job
    yield main
    for process in (main, *jobs):
        process.kill()
        process.communicate()


def test_a_clusters_job_outlives_its_run_and_the_next_run_waits_for_it(submitter, capfd):
    job = submitter.job()
    assert job.stdout.readline() == "1\n"
    submitter.kill()
    submitter.wait()
    time.sleep(1.0)
    assert job.poll() is None
    # By nothing else than this.
    threading.Timer(2.0, job.terminate).start()
    with one_run():
        assert job.wait(0) == -signal.SIGTERM
    (line,) = capfd.readouterr().err.splitlines()
    assert "will be used; waiting for them" in line
    assert "results/sand/seed_1/made.json (Slurm job 17 on " in line


def test_a_clusters_job_that_begins_when_another_run_has_the_folder_ends_at_once(submitter):
    submitter.kill()
    submitter.wait()
    # Nobody has the folder: what it makes will be used.
    job = submitter.job()
    assert job.stdout.readline() == "1\n"
    job.kill()
    job.wait()
    with one_run(cluster=True):
        job = submitter.job()
        assert job.wait(10) == -signal.SIGKILL
        assert job.stdout.read() == ""
        assert "the run that began this job has ended" in job.stderr.read()


def test_a_clusters_job_that_begins_after_ctrl_c_ends_at_once(submitter):
    submitter.send_signal(signal.SIGINT)
    submitter.wait()
    assert submitter.job().wait(10) == -signal.SIGKILL
