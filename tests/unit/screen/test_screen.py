"""What is shown of records that Snakemake makes, in the plain form."""

import logging
import subprocess
import sys

import pytest
from snakemake.profiles import ProfileConfigFileParser
from snakemake.settings.enums import Quietness
from snakemake_interface_logger_plugins.common import LogEvent

from branchcrush.files.tables import provenance, write_table
from snakemake_logger_plugin_branchcrush.lines import Lines

ROW = {
    "sample": "paper",
    "verdict": "certified",
    "exponent": 3.111,
    "exponent_low": 2.99,
    "exponent_high": 3.24,
    "confidence": 0.95,
    "seeds_certified": 16,
    "solid_fraction": 0.7407,
    "reason": None,
}


def write_results(folder):
    (folder / "results").mkdir()
    write_table(folder / "results/comparison.csv", [ROW], provenance())


CLOSING = [
    "paper: certified, n = 3.11, with 95 % confidence between 2.99 and 3.24 (16 packings), "
    "at solid fraction 0.741",
    "report:   results/report.html",
    "figures:  results/figures",
]


def test_each_job_that_ends_is_one_line(told, packing_log):
    screen = told()
    screen.plan(compression=2, energy_split=1, all=1)
    screen.begin(1, "compression", "compression.log", sample="paper", seed="3")
    packing_log()
    screen.finish(1)
    screen.begin(3, "energy_split", sample="paper")
    screen.finish(3)
    assert screen.lines() == [
        "to do: 2 packings and 1 other steps",
        "paper seed 3: state 7 of 16, phi 0.652, 12.3 MPa, done in 0 s (1 of 2 packings, "
        "less than a minute left)",
        "energy split of paper done (1 of 1 steps)",
    ]
    assert all(line[2] == line[5] == ":" for line in screen.stream.getvalue().splitlines())


def test_after_a_silence_it_is_told_where_the_packings_are(told, packing_log):
    screen = told()
    screen.plan(compression=6)
    packing_log("stale.log")
    for number in range(1, 7):
        screen.begin(number, "compression", f"{number}.log", sample="a", seed=str(number))
    screen.begin(7, "compression", "stale.log", sample="a", seed="7")
    packing_log("1.log")
    form = Lines(screen.stream)
    assert not form.wants(form._spoken + 29.0)
    assert form.wants(form._spoken + 31.0)
    screen.screen._form.wants = lambda now: True
    screen.screen._show(0.0)
    assert screen.lines()[1:] == [
        "a seed 1: state 7 of 16, phi 0.652, 12.3 MPa",
        "a seed 2: begins",
        "a seed 3: begins",
        "a seed 4: begins",
        "and 3 packings more",
    ]


def test_what_a_run_came_to_is_told_at_its_end(told, tmp_path):
    write_results(tmp_path)
    screen = told()
    screen.plan(report=1, all=1)
    for number, rule in enumerate(["report", "all"]):
        screen.begin(number, rule)
        screen.finish(number)
    assert screen.close() == ["Finished in 0 s: 1 of 1 steps.", *CLOSING]
    assert screen.close() == []


def test_paths_are_told_as_seen_from_where_the_run_was_started(told, tmp_path, monkeypatch):
    screen = told()
    (tmp_path / "sand").mkdir()
    write_results(tmp_path / "sand")
    monkeypatch.chdir(tmp_path / "sand")
    screen.record("Nothing to be done (all requested files are present and up to date).")
    assert screen.close()[1] == "report:   sand/results/report.html"


def test_what_a_study_came_to_is_told_when_nothing_is_to_be_done(told, tmp_path):
    write_results(tmp_path)
    screen = told()
    screen.record("Nothing to be done (all requested files are present and up to date).")
    assert screen.lines()[0].startswith("Nothing to be done")
    assert screen.close() == CLOSING


def test_part_of_a_study_has_no_verdict(told, tmp_path):
    write_results(tmp_path)
    screen = told()
    screen.plan(grading=1)
    screen.begin(1, "grading", sample="paper")
    screen.finish(1)
    assert screen.close() == ["Finished in 0 s: 1 of 1 steps."]


def test_a_summary_of_another_version_is_no_error(told, tmp_path):
    (tmp_path / "results").mkdir()
    (tmp_path / "results/comparison.csv").write_text("# {}\nsample\npaper\n")
    screen = told()
    screen.record("Nothing to be done")
    assert screen.close() == ["results: no summary (KeyError: 'verdict')"]


def test_a_failure_is_told_with_its_message_and_again_at_the_end(told, packing_log):
    screen = told()
    screen.plan(compression=2, all=1)
    for number in (1, 2):
        job = {"sample": "paper", "seed": str(number)}
        screen.begin(number, "compression", f"{number}.log", **job)
    packing_log("1.log", "branchcrush: no place for grain 3\n")
    process = "RuleException:\nCalledProcessError in file x.smk, line 3:\nCommand 'python' "
    ended = process + "returned non-zero exit status 1."
    screen.record(ended, LogEvent.ERROR, logging.ERROR, exception="RuleException")
    for _ in range(2):  # some executors say it twice
        screen.fail(1, "compression", "1.log", sample="paper", seed="1")
    screen.record(
        process + "died with <Signals.SIGKILL: 9>.", LogEvent.ERROR, logging.ERROR, exception="x"
    )
    screen.fail(2, "compression", "2.log", sample="paper", seed="2")
    screen.record("Exiting because a job execution failed. Look above", level=logging.ERROR)
    screen.record(
        "WorkflowError:\nAt least one job did not complete successfully.",
        LogEvent.ERROR,
        logging.ERROR,
        exception="WorkflowError",
    )
    assert screen.lines()[1:] == [
        "FAILED paper seed 1: no place for grain 3 (log: 1.log)",
        "FAILED paper seed 2: its process was ended by SIGKILL (log: 2.log)",
    ]
    assert screen.close() == [
        "2 jobs failed:",
        "  paper seed 1: no place for grain 3 (1.log)",
        "  paper seed 2: its process was ended by SIGKILL (2.log)",
        "Before that: 0 of 2 packings. Once the cause is mended: the same command goes on from "
        "there; what is finished stays.",
    ]


def test_a_job_that_ends_well_when_it_is_tried_again_is_no_failure(told):
    screen = told()
    screen.plan(compression=1)
    for _ in range(2):
        screen.begin(1, "compression", sample="a", seed="1")
        screen.fail(1, "compression", sample="a", seed="1")
    screen.begin(1, "compression", sample="a", seed="1")
    screen.finish(1)
    assert screen.close() == ["Finished in 0 s: 1 of 1 packings."]


def test_a_job_that_fails_each_time_is_one_failure(told):
    screen = told()
    screen.plan(compression=1)
    for _ in range(2):
        screen.begin(1, "compression", sample="a", seed="1")
        screen.fail(1, "compression", sample="a", seed="1")
    assert screen.close()[:2] == ["One job failed:", "  a seed 1: it left no message"]


def test_a_message_that_an_earlier_run_left_is_not_this_ones(told, packing_log):
    packing_log("old.log", "branchcrush: long ago\n")
    screen = told()
    screen.plan(compression=1)
    screen.begin(1, "compression", "old.log", sample="a", seed="1")
    screen.fail(1, "compression", "old.log", sample="a", seed="1")
    assert screen.lines()[-1] == "FAILED a seed 1: it left no message (log: old.log)"


def test_a_job_that_a_cluster_ended_is_told_by_its_scheduler(told, packing_log):
    screen = told()
    screen.plan(compression=2)
    scheduler = ("SLURM-job '17' failed, SLURM status is: 'TIMEOUT'.", "17.log")
    screen.begin(1, "compression", "1.log", sample="a", seed="1")
    screen.fail(1, "compression", "1.log", scheduler, sample="a", seed="1")
    assert screen.lines()[-1] == f"FAILED a seed 1: {scheduler[0]} (log: 17.log)"
    # Where the job itself has said why, that is told.
    screen.begin(2, "compression", "2.log", sample="a", seed="2")
    packing_log("2.log", "branchcrush: no load\n")
    screen.fail(2, "compression", "2.log", scheduler, sample="a", seed="2")
    assert screen.lines()[-1] == "FAILED a seed 2: no load (log: 2.log)"


def test_an_interrupted_run_says_that_the_same_command_goes_on(told):
    screen = told()
    screen.plan(compression=2)
    screen.begin(1, "compression", "1.log", sample="a", seed="1")
    screen.record("Terminating processes on user request, this might take some time.")
    screen.record("CalledProcessError: died with <Signals.SIGINT: 2>", LogEvent.ERROR)
    screen.fail(1, "compression", "1.log", sample="a", seed="1")
    assert screen.lines()[2:] == []
    assert screen.close() == [
        "Stopped: 0 of 2 packings. The same command goes on from there; what is finished stays."
    ]


def test_errors_of_the_workflow_are_shown_whole_and_once(told):
    screen = told()
    text = 'WorkflowError in file "Snakefile", line 25:\nconfig: first\nconfig: second'
    screen.record(text, LogEvent.ERROR, logging.ERROR, exception="WorkflowError")
    assert screen.lines() == text.splitlines()
    assert screen.close() == []


def test_a_dry_run_names_each_job_with_a_short_reason_and_counts_them_last(told):
    screen = told(dryrun=True)
    screen.plan(compression=1, all=1)
    long = "Missing output files: results/a.csv, results/b.csv; Code has changed since last"
    screen.begin(1, "compression", reason=long, sample="paper", seed="3")
    screen.begin(2, "report", reason="Params have changed since last execution: Before: 3; Now: 4")
    screen.begin(0, "all", reason="Input files updated by another job: results/report.html")
    screen.plan(compression=1, all=1)
    screen.record("This was a dry-run (flag -n).")
    assert screen.lines() == [
        "rule compression: paper seed 3; missing output files, code has changed",
        "rule report: params have changed",
        "This was a dry-run (flag -n).",
    ]
    assert screen.close() == ["Job stats:", "table"]


def test_snakemakes_chatter_is_left_out_and_all_else_is_shown(told):
    screen = told()
    for text in ("Building DAG of jobs...", "Select jobs to execute...", "None"):
        screen.record(text)
    screen.record("Provided cores: 2", LogEvent.RESOURCES_INFO)
    screen.record("Unlocked working directory.")
    assert screen.lines() == ["Unlocked working directory."]


@pytest.mark.parametrize(
    ("quiet", "kept"),
    [
        ([Quietness.PROGRESS], ["An error"]),
        ([Quietness.ALL], ["An error"]),
        ([Quietness.HOST], ["to do: 1 steps", "grading of a done (1 of 1 steps)", "An error"]),
    ],
)
def test_where_quiet_was_asked_for_only_messages_are_shown(told, quiet, kept):
    # Snakemake's own filter comes before, and leaves out more.
    screen = told(quiet=quiet)
    screen.plan(grading=1)
    screen.begin(1, "grading", sample="a")
    screen.finish(1)
    screen.record("An error", level=logging.ERROR)
    assert screen.lines() == kept
    assert bool(screen.close()) == (Quietness.ALL not in quiet)


def test_verbose_is_snakemakes_own_screen(told):
    screen = told(verbose=True, nocolor=True)
    screen.plan(grading=1)
    screen.begin(1, "grading", sample="a")
    assert "whole: Job stats:\ntable\n" in screen.stream.getvalue()
    assert "to do" not in screen.stream.getvalue()


def test_a_job_loads_nothing_of_the_screen_and_the_package_itself_no_table():
    jobs = "import branchcrush.jobs, branchcrush.lammps.compression, sys; "
    nothing = "assert not {'rich', 'snakemake_logger_plugin_branchcrush'} & set(sys.modules); "
    package = "import snakemake_logger_plugin_branchcrush; "
    light = "assert not {'rich', 'numpy.random', 'branchcrush.study'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", jobs + nothing], check=True)
    subprocess.run([sys.executable, "-c", "import sys; " + package + light], check=True)


def test_where_the_package_is_not_installed_snakemake_keeps_its_own_screen(
    monkeypatch, pytestconfig
):
    profile = pytestconfig.rootpath / "profiles/default/config.yaml"
    with profile.open() as file:
        assert ProfileConfigFileParser().parse(file)["logger"] == "branchcrush"
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with profile.open() as file:
        settings = ProfileConfigFileParser().parse(file)
    assert "logger" not in settings
    assert settings["rerun-incomplete"] == "True"
