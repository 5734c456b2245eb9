"""The record of a job: whether it still fits what is there, and what is said where it does not."""

import json
import os
import shutil
import threading
import time
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import pytest

from branchcrush.checkpoints import checkpoint_of
from branchcrush.claims import claimed, standing_claims
from branchcrush.errors import FitError
from branchcrush.files.made import read_record
from branchcrush.records import (
    OutOfDate,
    out_of_date,
    recorded_job,
)
from branchcrush.records_words import dumps_not_kept, kept_of_other_versions, lines_of
from tests.unit.recorded_jobs import (
    PATH,
    RECORD,
    Named,
    as_script,
    do,
    fit,
    here,
    reasons,
    walk,
)

__all__ = ["here"]


def test_a_record_tells_what_made_the_files_and_what_they_hold():
    abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    abd = "a52d159f262b2c6ddb724a61840befc36eb30c88877a4030b65cbe86298449c9"
    record = json.loads(Path(RECORD).read_text())
    assert record.pop("branchcrush")
    assert len(record.pop("sha256")) == 64
    assert record == {
        "rule": "fit",
        "wildcards": {"sample": "sand"},
        "code": "c0de",
        "keep_dumps": "all",
        "params": {
            "sample": {"grains": 60, "contact": {"law": "linear", "stiffness": 1e6}},
            "bins": 20,
        },
        "inputs": {"sieve.csv": abc, PATH: abd},
        "outputs": {"results/sand/fit.csv": abc, "results/sand/fit.json": abc},
        "beside": {"results/sand/particles.dump.gz": abd},
    }


def test_the_same_job_leaves_the_same_record_whenever_it_is_done():
    before = Path(RECORD).read_bytes()
    do(fit())
    assert Path(RECORD).read_bytes() == before


def test_a_job_that_fails_leaves_no_record():
    Path(RECORD).unlink()
    with pytest.raises(SystemExit), recorded_job(as_script(fit())):
        raise FitError("no load")
    assert read_record(RECORD) is None


def nothing():
    pass


@pytest.mark.parametrize(
    ("meanwhile", "again"),
    [
        (nothing, False),
        # The first died without a record, another input is there by now, or a result went.
        (Path(RECORD).unlink, True),
        (partial(Path("sieve.csv").write_text, "abd"), True),
        (Path("results/sand/fit.csv").unlink, True),
        (partial(shutil.rmtree, "results/sand"), True),
    ],
)
def test_who_waited_for_results_that_are_there_by_then_makes_nothing(capsys, meanwhile, again):
    made = fit(inputs=["sieve.csv"])
    do(made)
    worked, ended = [], []

    def second():
        try:
            with recorded_job(as_script(made)):
                worked.append(True)
        except SystemExit as end:
            ended.append(end.code)

    another = threading.Thread(target=second)
    with claimed(RECORD):
        another.start()
        while "branchcrush: waits for results" not in capsys.readouterr().err:
            time.sleep(0.01)
        assert (worked, ended) == ([], [])
        meanwhile()
    another.join()
    assert bool(worked) == again
    # The job did nothing, and where a result is gone by its end there is no record.
    gone = not Path("results/sand/fit.csv").exists()
    assert ended == ([] if again and not gone else [int(gone)])


def test_a_record_is_never_of_a_result_that_is_gone(capsys):
    Path(RECORD).unlink()
    with pytest.raises(SystemExit) as ended, recorded_job(as_script(fit())):
        Path("results/sand/fit.json").unlink()
    assert ended.value.code == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert "results/sand/fit.json was removed" in line and "repeat the command" in line
    assert read_record(RECORD) is None


def kept(made):
    """Return a file among what a job keeps to go on from, as if it had been killed before."""
    file = checkpoint_of(made.output.record) / "state.kept"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("12")
    return file


def test_what_a_job_goes_on_from_is_gone_with_its_record_before_another_may_begin(monkeypatch):
    made = fit()
    state, other = kept(made), kept(walk())
    with pytest.raises(SystemExit), recorded_job(as_script(made)):
        raise FitError("no load")
    assert state.exists()
    seen = []

    def rmtree(path, remove=shutil.rmtree, **others):
        seen.append((Path(RECORD).exists(), [claim.result for claim in standing_claims()]))
        remove(path, **others)

    monkeypatch.setattr(shutil, "rmtree", rmtree)
    do(made)
    assert (state.parent.exists(), other.exists()) == (False, True)
    assert seen == [(True, [RECORD])]


@pytest.mark.parametrize("notes", [True, False])
def test_times_and_places_are_no_reason(here, tmp_path_factory, monkeypatch, notes):
    elsewhere = tmp_path_factory.mktemp("elsewhere") / "study"
    here.rename(elsewhere)
    monkeypatch.chdir(elsewhere)
    for number, file in enumerate(sorted(elsewhere.rglob("*"))):
        os.utime(file, ns=(number, 10**18 - number))
    if not notes:
        for file in Path(".snakemake").rglob("*.json"):
            file.unlink()
    moved = fit()
    moved.params.inputs = "/another/clone"
    assert reasons(moved) == []


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"code": "new"}, "its code changed"),
        ({"grains": 50}, "grains changed"),
        ({"contact": {"law": "linear", "stiffness": 2e6}}, "contact.stiffness changed"),
        ({"contact": {"law": "hertz"}}, "contact.law, contact.stiffness changed"),
        ({"a": 1, "b": 1, "c": 1, "grains": 2}, "grains, a, b and 1 more changed"),
        # Samples are listed in their order.
        ({"contact": {"stiffness": 1e6, "law": "linear"}}, "the order of its keys changed"),
        ({"inputs": ["sieve.csv"]}, "its input path.csv is no longer one"),
        ({"inputs": [PATH, "sieve.csv"]}, "its inputs changed places"),
        (
            {"inputs": ["sieve.csv", PATH, "results/sand/seed_1/made.json"]},
            "its input made.json is new",
        ),
    ],
)
def test_other_code_configuration_or_inputs_are_a_reason(change, reason):
    assert reasons(fit(**change)) == [reason]


@pytest.mark.parametrize(
    ("file", "changed", "missing"),
    [
        ("sieve.csv", "its input sieve.csv changed", "its input sieve.csv is missing"),
        (
            "results/sand/fit.json",
            "its file fit.json is not as it was left",
            "its file fit.json is missing",
        ),
        (
            RECORD,
            "its record is damaged",
            "no record tells what made its files: interrupted, or of an earlier version",
        ),
    ],
)
def test_other_content_and_a_missing_file_are_reasons(file, changed, missing):
    Path(file).write_text("abd")
    assert reasons(fit()) == [changed]
    Path(file).unlink()
    assert reasons(fit()) == [missing]


def test_an_input_that_is_edited_while_a_job_is_at_work_is_another_one():
    with recorded_job(as_script(fit())):
        Path("sieve.csv").write_text("abe")
    assert reasons(fit()) == ["its input sieve.csv changed"]


@pytest.mark.parametrize("whole", ["[]", "{}", '{"code": 3, "params": {}}', "\xff"])
def test_a_record_that_holds_something_else_is_damaged(whole):
    Path(RECORD).write_text(whole, encoding="latin-1")
    assert reasons(fit()) == ["its record is damaged"]


def test_a_record_without_the_digest_of_itself_is_damaged():
    record = json.loads(Path(RECORD).read_text())
    del record["sha256"]
    Path(RECORD).write_text(json.dumps(record, indent=1) + "\n")
    assert reasons(fit()) == ["its record is damaged"]


def test_another_version_keeps_what_has_the_same_sources_and_says_what_has_not(monkeypatch):
    assert kept_of_other_versions([fit(), walk()]) == ""
    for module in ("records", "records_words"):
        monkeypatch.setattr(f"branchcrush.{module}.__version__", "9.9.9")
    assert reasons(fit()) == []
    assert kept_of_other_versions([fit(), walk()]) == (
        "kept: what 2 jobs of branchcrush 0.1.0 made, whose sources are the same in 9.9.9"
    )
    assert reasons(fit(code="new")) == ["its code changed from branchcrush 0.1.0 to 9.9.9"]


def test_what_was_never_done_and_what_has_no_record_is_no_case(here):
    for path in fit().output:
        Path(path).unlink()
    other = fit(code="new")
    del other.output.record
    assert out_of_date([fit(), other]) == []


def test_half_of_what_an_interrupted_job_leaves_is_made_anew():
    for path in fit().output[1:]:
        Path(path).unlink()
    assert reasons(fit()) == [
        "no record tells what made its files: interrupted, or of an earlier version"
    ]


def test_a_dump_may_go():
    Path("results/sand/particles.dump.gz").unlink()
    assert reasons(fit()) == []


@pytest.mark.parametrize(
    ("before", "now", "told"),
    [
        ("all", "none", False),
        ("last", "last", False),
        ("none", "last", True),
        ("last", "all", True),
    ],
)
def test_fewer_dumps_are_no_reason_and_more_are_told(before, now, told):
    do(fit(dumps=before))
    assert reasons(fit(dumps=now)) == []
    line = dumps_not_kept([fit(dumps=now)])
    assert ("--forcerun fit" in line and f"keep_dumps: {now}" in line) if told else line == ""


def test_jobs_that_write_no_dumps_do_not_hide_what_others_kept():
    do(fit(dumps="none"))
    line = dumps_not_kept([fit(dumps="last"), fit(dumps=None)])
    assert line.startswith("keep_dumps: last holds ") and "; 1 packing kept less" in line


def test_a_line_for_each_reason_names_jobs_and_counts_packings():
    def case(rule, reason, **wildcards):
        made = SimpleNamespace(rule=SimpleNamespace(name=rule), wildcards=Named(**wildcards))
        return OutOfDate(made, reason)

    seeds = [case("compression", "grains changed", sample="sand", seed=str(k)) for k in range(3)]
    others = [case("fit", "its code changed", sample=name) for name in "abcde"]
    page = [case("report", "its file report.html is missing")]
    assert lines_of(seeds + others + page) == [
        "made anew: compression of sand (3 packings), because grains changed",
        "made anew: fit of a, fit of b, fit of c and 2 more, because its code changed",
        "made anew: report, because its file report.html is missing",
    ]
