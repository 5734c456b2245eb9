"""A study on a cluster: the same bytes as on one machine, whatever is killed on the way."""

import os
import re
import shlex
import signal
import subprocess
import threading

from tests.cluster.study import CERTIFICATES, PACKINGS, Asked


def test_the_same_bytes_by_two_jobs_at_once_and_a_packing_on_two_ranks(study, expected):
    study.command[-len(PACKINGS) :] = CERTIFICATES
    with study.begun() as main, study.watched():
        resume(study.frozen(2))
        study.wait_for(lambda: main.poll() is not None, "its end")
    assert main.returncode == 0, study.output()
    assert study.results() == expected
    assert set(study.most_at_once.values()) == {1}
    # By the estimates of the preview: half as much memory again, and minutes for seconds.
    asked = {name.removeprefix("rule_"): jobs for name, jobs in study.asked().items()}
    assert asked == {
        **{f"compression_wildcards_lone_{seed}": [Asked(1, 600, 3)] for seed in (1, 2, 3)},
        "compression_wildcards_paired_1": [Asked(2, 1100, 3)],
        **{f"certificate_wildcards_{name}": [Asked(1, 4000, 60)] for name in ("lone", "paired")},
    }


def test_a_job_that_is_killed_on_its_node_is_tried_again(study, expected_packings):
    with study.begun() as main:
        ((name, job),) = study.frozen(1).items()
        os.kill(job, signal.SIGKILL)
        study.wait_for(lambda: main.poll() is not None, "its end")
    assert main.returncode == 0, study.output()
    sample, _, seed = name.partition("/seed_")
    first, second = study.asked()[f"rule_compression_wildcards_{sample}_{seed}"]
    # Twice as much, the second time.
    assert [second.megabytes, second.minutes] == [2 * first.megabytes, 2 * first.minutes]
    assert study.results() == expected_packings


def test_of_a_group_in_which_one_fails_those_that_are_finished_are_kept(study, expected_packings):
    one_job = ["--groups", "compression=packings", "--group-components", "packings=3"]
    study.command[-len(PACKINGS) : -len(PACKINGS)] = [*one_job, "--cores", "1", "--retries", "0"]
    with study.begun() as main:
        record = study.wait_for(lambda: next(study.records(), None), "the end of a packing")
        made = record.stat().st_ino
        for job in study.frozen(1).values():
            os.kill(job, signal.SIGKILL)
        study.wait_for(lambda: main.poll() is not None, "its end")
    assert main.returncode == 1, study.output()
    assert len(study.asked()) == 1
    assert study.finish() == 0, study.output()
    assert record.stat().st_ino == made
    assert study.results() == expected_packings


def test_what_is_at_work_when_the_submitter_is_killed_is_waited_for_and_used(
    study, expected_packings
):
    with study.watched():
        with study.begun() as main:
            orphans = study.frozen(2)
            main.kill()
        # It would begin the third packing, and these two again.
        with study.begun() as main:
            study.wait_for(lambda: "waiting for them" in study.output(), "a word of the jobs")
            for name in orphans:
                job = rf"results/{name}/made.json \(Slurm job \d+ on node1 since "
                assert re.search(job, study.output())
            resume(orphans)
            study.wait_for(lambda: len(list(study.records())) == 2, "the end of the orphans")
            made = {record: record.stat().st_ino for record in study.records()}
            study.wait_for(lambda: main.poll() is not None, "its end")
    assert main.returncode == 0, study.output()
    # Not computed again: a file that is written anew is another one.
    assert {record: record.stat().st_ino for record in made} == made
    assert [len(jobs) for jobs in study.asked().values()] == [1, 1, 1]
    assert study.results() == expected_packings
    assert set(study.most_at_once.values()) == {1}


def test_a_submitter_that_is_itself_a_job_and_cancelled_is_gone_on_with(study, expected_packings):
    with study.watched():
        # In place of the shell, without which processes are lost where there are no cgroups.
        command = f"exec {shlex.join(study.command)} >> output.txt 2>&1"
        submit = ["sbatch", "--parsable", "--mem", "1000", "--wrap", command]
        main = subprocess.run(
            submit, cwd=study.folder, env=study.environment, capture_output=True, text=True
        ).stdout.strip()
        orphans = study.frozen(1)
        study.cluster.said("scancel", main)
        study.wait_for(lambda: main not in study.cluster.jobs(), "the end of the submitter")
        threading.Timer(2.0, resume, [orphans]).start()
        assert study.finish() == 0, study.output()
    assert study.results() == expected_packings
    assert set(study.most_at_once.values()) == {1}


def test_ctrl_c_cancels_the_jobs(study, expected_packings):
    with study.begun() as main:
        study.frozen(1)
        main.send_signal(signal.SIGINT)
        study.wait_for(lambda: main.poll() is not None, "its end")
        study.wait_for(lambda: not study.cluster.jobs(), "the end of the jobs")
    assert study.finish() == 0, study.output()
    assert study.results() == expected_packings


def resume(jobs):
    """Let jobs that were stopped go on."""
    for process in jobs.values():
        os.kill(process, signal.SIGCONT)
