"""A study on a cluster: the same bytes as on one machine, whatever is killed on the way."""

import os
import re
import shlex
import signal
import subprocess

RECORD = "results/{}/made.json"


def test_the_same_bytes_by_two_jobs_at_once_and_a_packing_on_two_ranks(study, expected):
    with study.begun() as main, study.watched():
        study.wait_for(lambda: len(study.at_work()) == 2, "two packings at once")
        study.wait_for(lambda: main.poll() is not None, "its end", 200)
    assert main.returncode == 0, study.output()
    assert study.results() == expected
    assert set(study.most_at_once.values()) == {1}
    asked = {name: cores for name, (cores, *_) in study.asked().items() if "compression" in name}
    assert sorted(asked.values()) == ["1", "1", "1", "2"], asked


def test_a_job_that_is_killed_on_its_node_is_tried_again(study, expected):
    with study.begun() as main:
        (job, *_) = study.wait_for(study.jobs, "a packing at work")
        os.kill(job, signal.SIGKILL)
        study.wait_for(lambda: main.poll() is not None, "its end", 200)
    assert main.returncode == 0, study.output()
    assert "Trying to restart" in study.output()
    assert study.results() == expected


def test_what_runs_when_the_submitter_is_killed_is_waited_for_and_used(study, expected):
    with study.watched():
        with study.begun() as main:
            study.wait_for(lambda: len(study.at_work()) == 2, "two packings at once")
            os.kill(main.pid, signal.SIGKILL)
        orphans = study.at_work()
        assert orphans
        with study.begun() as main:
            study.wait_for(lambda: "waiting for them" in study.output(), "a word of the jobs")
            record = study.folder / RECORD.format(orphans[0])
            study.wait_for(record.exists, "the end of an orphan")
            made = record.stat().st_ino
            study.wait_for(lambda: main.poll() is not None, "its end", 200)
    assert main.returncode == 0, study.output()
    assert re.search(rf"results/{orphans[0]}/made.json \(Slurm job \d+ on node1 ", study.output())
    # Not computed again: a file that is written anew is another one.
    assert record.stat().st_ino == made
    assert study.results() == expected
    assert set(study.most_at_once.values()) == {1}


def test_a_submitter_that_is_itself_a_job_and_cancelled_is_gone_on_with(study, expected):
    with study.watched():
        command = f"{shlex.join(study.command)} >> output.txt 2>&1"
        submit = ["sbatch", "--parsable", "--mem", "1000", "--wrap", command]
        main = subprocess.run(
            submit, cwd=study.folder, env=study.environment, capture_output=True, text=True
        ).stdout.strip()
        study.wait_for(study.at_work, "a packing at work")
        study.cluster.said("scancel", main)
        study.wait_for(lambda: main not in study.cluster.jobs(), "the end of the submitter")
        assert study.finish() == 0, study.output()
    assert study.results() == expected
    assert set(study.most_at_once.values()) == {1}


def test_ctrl_c_cancels_the_jobs(study, expected):
    with study.begun() as main:
        study.wait_for(study.at_work, "a packing at work")
        main.send_signal(signal.SIGINT)
        study.wait_for(lambda: main.poll() is not None, "its end")
        study.wait_for(lambda: not study.cluster.jobs(), "the end of the jobs")
    assert study.finish() == 0, study.output()
    assert study.results() == expected
