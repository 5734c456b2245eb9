"""What a job reads, held against the records of the jobs that made it."""

import os
from pathlib import Path

import pytest

from branchcrush.errors import ResultsError
from branchcrush.files.made import read_record, record_bytes
from branchcrush.records import kept_dump, recorded_job
from tests.unit.recorded_jobs import MADE, PATH, Named, as_script, do, fit, here, step, walk

__all__ = ["here"]


def stopped(made, capsys):
    """Return the one line that a job ends with before it reads anything."""
    with pytest.raises(SystemExit), recorded_job(as_script(made)):
        raise AssertionError("it began")
    said = capsys.readouterr().err
    assert said.startswith("branchcrush: ") and said.count("\n") == 1
    assert Path("logs/fit.log").read_text().endswith(said)
    return said


def other(path, **changes):
    """Change a record as another job would have left it."""
    record = read_record(path)
    record.pop("sha256")
    Path(path).write_bytes(record_bytes({**record, **changes}))


def test_a_job_stops_at_a_changed_a_foreign_and_an_unrecorded_input(capsys):
    path, record = Path(PATH), Path(MADE)
    kept = record.read_bytes()
    path.write_text("abe")
    again = "delete path.csv and run the study again"
    assert f"{PATH} is not as its job left it (changed, cut or damaged): {again}" in (
        stopped(fit(), capsys)
    )
    path.write_text("abd")
    record.write_bytes(kept.replace(b"c0de", b"c1de"))
    assert f"{record} is damaged, and nothing else tells what made path.csv: delete made.json" in (
        stopped(fit(), capsys)
    )
    record.unlink()
    assert f"{PATH} has no record of what made it: {again}" in stopped(fit(), capsys)
    record.write_bytes(kept)
    do(fit())


def test_a_job_stops_at_the_files_of_another_seed_with_their_record(capsys):
    step(walk(2), "another")
    for name in ("path.csv", "made.json"):
        Path("results/sand/seed_2", name).replace(Path("results/sand/seed_1", name))
    line = stopped(fit(), capsys)
    assert f"{PATH} does not belong here: the record beside it, of sample sand seed 2, " in line


def test_a_job_stops_at_a_packing_of_another_configuration(capsys):
    step(walk(grains=50))
    line = stopped(fit(), capsys)
    assert (
        "seed_1/made.json tells that its files were made with another configuration (grains)"
        in (line)
    )
    # Of another sample it may be another one.
    other(MADE, wildcards={"sample": "sand-refined", "seed": "1"})
    do(fit())


def test_a_job_stops_at_what_was_made_from_another_file_than_it_reads(capsys):
    made = fit()
    made.input = Named(fit="results/sand/fit.json", path=PATH)
    made.output = Named(
        table="results/sand/a.csv", result="results/sand/a.json", record="results/sand/made/a.json"
    )
    do(made)
    step(walk(), "abe")
    line = stopped(made, capsys)
    assert f"fit.json tells that its files were made from another {PATH} than the one" in line


def test_a_job_reads_what_the_disk_changed_without_a_trace(monkeypatch, capsys):
    """Notes of size and times are the same, as where a bit fell over."""
    status = os.stat(PATH)
    Path(PATH).write_text("abe")
    real = os.stat
    monkeypatch.setattr(
        "branchcrush.files.digests.os.stat",
        lambda path, **how: status if path == PATH else real(path, **how),
    )
    assert "path.csv is not as its job left it" in stopped(fit(), capsys)


def test_a_dump_that_a_job_reads_is_checked_and_may_have_been_deleted():
    dump, beside = Path("results/sand/particles.dump.gz"), "results/sand/fit.csv"
    assert kept_dump(beside, as_script(fit())) == [dump]
    dump.write_text("abe")
    with pytest.raises(ResultsError, match=r"particles.dump.gz is not as its job left it"):
        kept_dump(beside, as_script(fit()))
    dump.unlink()
    assert kept_dump(beside, as_script(fit())) == []


def test_many_wrong_inputs_are_one_line(capsys):
    paths = [walk(seed).output.path for seed in (1, 2, 3)]
    for seed in (2, 3):
        step(walk(seed))
    for path in paths:
        Path(path).write_text("")
    assert "(2 more like it)" in stopped(fit(inputs=paths), capsys)


def test_the_users_own_files_have_no_record_wherever_they_are(tmp_path):
    elsewhere = tmp_path / "other/results/sand.csv"
    elsewhere.parent.mkdir(parents=True)
    elsewhere.write_text("1 2")
    do(fit(inputs=["sieve.csv", str(elsewhere)]))
