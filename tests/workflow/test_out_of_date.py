"""What is out of date: every kind of change that counts is seen, and none that does not."""

import gzip
import json
import os
import re
import shutil
import subprocess
import sys

import pytest

from branchcrush import __version__

# The study's own jobs, as Snakemake knows them, held against what is there after each change.
PROGRAM = """
import json, os, sys
from pathlib import Path

from snakemake.api import SnakemakeApi
from snakemake.settings.types import DAGSettings, OutputSettings, Quietness, ResourceSettings
from branchcrush.files.made import record_bytes
from branchcrush.records import out_of_date

with SnakemakeApi(OutputSettings(quiet={Quietness.ALL})) as api:
    flow = api.workflow(resource_settings=ResourceSettings(cores=1), snakefile=Path("Snakefile"))
    flow.dag(DAGSettings()).execute_workflow(executor="dryrun")
    jobs = [job for job in flow._workflow_store.dag.jobs if "record" in job.output.keys()]


def cases():
    return [[job.rule.name, reason] for job, reason in out_of_date(jobs)]


def flipped(content):
    return bytes([content[0] ^ 1]) + content[1:]


seen = {"settled": cases(), "removed": {}, "changed": {}}
for path in map(Path, sorted({str(path) for job in jobs for path in job.output})):
    content, times = path.read_bytes(), os.stat(path)
    path.unlink()
    seen["removed"][str(path)] = cases()
    path.write_bytes(flipped(content))
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    seen["changed"][str(path)] = cases()
    path.write_bytes(content)

# A run that was interrupted after the fit was done anew: its record tells of the new file.
import hashlib
fit, record = Path("results/tiny/energy_split.json"), Path("results/tiny/made/energy_split.json")
before = fit.read_bytes(), record.read_bytes()
fit.write_bytes(flipped(before[0]))
old, new = (hashlib.sha256(content).hexdigest() for content in (before[0], fit.read_bytes()))
told = json.loads(before[1].decode().replace(old, new))
record.write_bytes(record_bytes({key: told[key] for key in told if key != "sha256"}))
seen["interrupted"] = cases()
fit.write_bytes(before[0])
record.write_bytes(before[1])
Path("seen.json").write_text(json.dumps(seen))
"""


@pytest.fixture(scope="module")
def seen(finished):
    environment = {**os.environ, "PYTHONPATH": str(finished.source)}
    subprocess.run(
        [sys.executable, "-c", PROGRAM],
        cwd=finished.folder,
        env=environment,
        check=True,
        capture_output=True,
        timeout=200,
    )
    file = finished.folder / "seen.json"
    cases = json.loads(file.read_text())
    file.unlink()
    return cases


def test_a_finished_study_fits(seen):
    assert seen["settled"] == []
    # Of each rule some.
    assert len(seen["removed"]) > 60


@pytest.mark.parametrize("change", ["removed", "changed"])
def test_whatever_result_is_removed_or_changed_is_made_anew(seen, finished, change):
    made = [finished.folder / path for path in seen[change] if "made" in path]
    records = [json.loads(path.read_text()) for path in made]
    maker = {path: record["rule"] for record in records for path in record["outputs"]}
    for path, cases in seen[change].items():
        name = path.rpartition("/")[2]
        if path not in maker:
            words = "no record tells what made its files" if change == "removed" else "damaged"
            assert len(cases) == 1 and words in cases[0][1], path
            continue
        words = "is missing" if change == "removed" else "is not as it was left"
        assert [maker[path], f"its file {name} {words}"] in cases, path
        # All others read it.
        kind = "is missing" if change == "removed" else "changed"
        others = [reason for rule, reason in cases if rule != maker[path]]
        assert set(others) <= {f"its input {name} {kind}"}, path


def test_what_read_a_file_before_it_was_done_anew_is_done_anew(seen):
    reason = "its input energy_split.json changed"
    rules = ("verdict", "thermodynamics", "fit_figures", "comparison", "report", "findings")
    assert sorted(seen["interrupted"]) == sorted([rule, reason] for rule in rules)


# --- what a user types ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def elsewhere(finished, tmp_path_factory):
    """Study and sources in another place, all of another time, without Snakemake's notes."""
    unwanted = shutil.ignore_patterns(".snakemake", "*.dump.gz")
    folder = tmp_path_factory.mktemp("else") / "where"
    project = finished.copied(finished.folder, folder, ignore=unwanted)
    for number, file in enumerate(sorted(project.folder.rglob("*"), reverse=True)):
        os.utime(file, (1.7e9 + number, 1.7e9 + number))
    return project


def test_a_copy_of_another_time_and_place_without_dumps_and_notes_is_up_to_date(elsewhere):
    assert elsewhere.planned_rules() == set()


def test_another_version_keeps_what_has_the_same_sources_and_says_so(elsewhere):
    module = elsewhere.source / "branchcrush/__init__.py"
    before = module.read_text()
    module.write_text(before.replace(f'"{__version__}"', '"99.0.0"'))
    shown = elsewhere.snakemake("--dry-run")
    module.write_text(before)
    text = shown.stdout + shown.stderr
    assert "rule " not in text and "made anew" not in text
    told = rf"kept: what \d+ jobs of branchcrush {__version__} made, whose sources are the same in"
    assert re.search(rf"{told} 99\.0\.0\n", text)


def test_changed_grains_are_seen_without_what_snakemake_noted(elsewhere):
    shutil.rmtree(elsewhere.folder / ".snakemake", ignore_errors=True)
    elsewhere.configure(elsewhere.tiny.replace("grains: 60", "grains: 50"))
    shown = elsewhere.snakemake("--dry-run", "results/tiny/seed_3/path.csv")
    elsewhere.configure(elsewhere.tiny)
    text = shown.stdout + shown.stderr
    line = "made anew: compression of tiny (1 packing), because grains changed"
    assert "rule compression:" in text and line in text


def test_a_removed_result_is_planned_with_all_that_follows_and_told_in_one_line(elsewhere):
    (elsewhere.folder / "results/tiny/energy_split.json").unlink()
    run = elsewhere.snakemake("--dry-run")
    shown = (run.stdout + run.stderr).splitlines()
    lines = [line for line in shown if "made anew" in line]
    assert lines == [
        "made anew: energy_split of tiny, because its file energy_split.json is missing"
    ]
    rules = {line.split()[1].rstrip(":") for line in shown if line.startswith("rule ")}
    assert {"energy_split", "verdict", "fit_figures", "report"} <= rules
    assert not {"compression", "certificate", "sharing"} & rules


TABLE = """\
samples:
  sand:
    grading: {form: sieve, basis: mass, size: diameter, unit: mm, file: sieve.csv}
    grains: 30
    allow_unrepresentative: true
    boundary: periodic
    loading: {solid_fraction: 0.6, approach_solid_fraction: 0.45, states: 2, quality: draft}
    seeds: 1
    refined_seeds: 0
keep_dumps: last
"""


def test_a_data_file_counts_by_its_content_and_dumps_not_at_all(study):
    data, packing = study.folder / "sieve.csv", study.folder / "results/sand/seed_1"
    data.write_text("diameter,percent_finer\n0.5,0\n1,100\n")
    study.configure(TABLE)
    run = study.snakemake("results/sand/seed_1/path.csv")
    assert run.returncode == 0, run.stdout + run.stderr
    for name in ("particles", "pairs"):
        with gzip.open(packing / f"{name}.dump.gz", "rt") as file:
            assert file.read().count("ITEM: TIMESTEP") == 1
    record = json.loads((packing / "made.json").read_text())
    assert sorted(record["beside"]) == [
        f"results/sand/seed_1/{name}.dump.gz" for name in ("pairs", "particles")
    ]

    os.utime(data)
    (packing / "pairs.dump.gz").unlink()
    study.configure(TABLE.replace("last", "all"))
    shown = study.snakemake("--dry-run", "results/sand/seed_1/path.csv")
    text = shown.stdout + shown.stderr
    assert "Nothing to be done" in text
    assert "1 packing kept less. To have their dumps: --forcerun compression" in text

    data.write_text("diameter,percent_finer\n0.5,0\n1.1,100\n")
    shown = study.snakemake("--dry-run", "results/sand/seed_1/path.csv")
    line = "made anew: compression of sand (1 packing), because its input sieve.csv changed"
    assert line in shown.stdout + shown.stderr
    assert "rule compression:" in shown.stdout + shown.stderr
