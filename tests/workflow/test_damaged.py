"""Damaged files of a finished study: whoever reads one says so, in a line that names it."""

import contextlib
import random
import re
import shutil
from pathlib import Path

import pytest

import branchcrush
from benchmarks.damaged_study import Damaged, flipped
from branchcrush.command.main import main
from branchcrush.errors import ResultsError, ResultsWarning
from branchcrush.files.dictionary import result_files
from branchcrush.files.digests import file_digest
from branchcrush.files.made import is_record, read_record, record_bytes


def cut(content, rng):
    return content[: rng.randrange(len(content))]


def as_spreadsheets_save_it(content, rng):
    return content.replace(b"\n", b"\r\n") if b"\n" in content else content + b"\r\n"


def with_an_error_of_a_spreadsheet(content, rng):
    numbers = list(re.finditer(rb"\d+", content))
    if not numbers:
        return b"#REF!" + content
    place = rng.choice(numbers)
    return content[: place.start()] + b"#REF!" + content[place.end() :]


def with_a_block_of_zeros(content, rng):
    start = rng.randrange(len(content))
    changed = content[:start] + bytes(len(content[start : start + 512])) + content[start + 512 :]
    return changed if changed != content else content[:-1]


DAMAGES = {
    "a flipped bit": flipped,
    "cut": cut,
    "empty": lambda content, rng: b"",
    "a line more": lambda content, rng: content + b"\n",
    "#REF!": with_an_error_of_a_spreadsheet,
    "saved by a spreadsheet": as_spreadsheets_save_it,
    "zeros": with_a_block_of_zeros,
    "all zeros": lambda content, rng: bytes(len(content)),
}


@pytest.fixture(scope="module")
def damaged(finished):
    return Damaged(finished.folder)


@pytest.fixture(scope="module")
def of_each_kind(damaged):
    """One file of each that the dictionary names, of those that a job or the API reads."""
    kinds = {}
    for path in damaged.files:
        if not is_record(path) and (damaged.readers.get(path) or path in damaged.opened):
            below = path.removeprefix("results/")
            kind = next(kind.path for kind in result_files() if kind.matches(below))
            kinds.setdefault(kind, path)
    return list(kinds.values())


def swapped(path, files):
    """Return the same file of another seed, of the run with twice the steps, or of another rule."""
    others = [path.replace("seed_3", "seed_5"), path.replace("seed_5", "seed_3")]
    others += [path.replace("tiny/", "tiny-refined/"), path.replace("tiny-refined/", "tiny/")]
    end = Path(path).suffix
    others += [one for one in files if one.endswith(end) and not is_record(one)] + files
    return next(one for one in others if one != path and one in files)


def test_a_sound_study_is_sound_for_all(damaged, capsys):
    assert damaged.verify_says() == (0, [])
    for path in damaged.files:
        assert not any(damaged.told_by(path).values()), path
    # Of each kind some, and each job.
    assert len(damaged.opened) > 40
    assert len({path for path in damaged.files if damaged.readers.get(path)}) > 40


@pytest.mark.parametrize("damage", [*DAMAGES, "another's", "removed"])
def test_every_damaged_result_is_told_by_all_that_read_it(damaged, of_each_kind, damage):
    rng = random.Random(damage)
    results = [path for path in damaged.files if not is_record(path)]
    contents = {}
    for path in results:
        before = (damaged.folder / path).read_bytes()
        if damage == "another's":
            contents[path] = (damaged.folder / swapped(path, damaged.files)).read_bytes()
            if contents[path] == before:  # as the empty table of walls of two seeds
                contents[path] += b" "
        else:
            contents[path] = None if damage == "removed" else DAMAGES[damage](before, rng)
    told, wrong = 0, []
    # What is not there, Snakemake finds for the jobs, and the API says in its own words.
    for path in of_each_kind if damage != "removed" else ():
        with damaged.changed(path, contents[path]):
            for who, said in damaged.told_by(path).items():
                told += 1
                if said.count("\n") != 1 or f"/{Path(path).name} " not in said:
                    wrong.append((who, path, said))
    with contextlib.ExitStack() as all_at_once:
        for path in results:
            all_at_once.enter_context(damaged.changed(path, contents[path]))
        code, lines = damaged.verify_says()
    assert wrong == []
    assert told > 60 or damage == "removed"
    assert code == 1
    named = {line.split(" ")[0] for line in lines}
    optional = {path for path in results if path.endswith(".dump.gz") and damage == "removed"}
    assert named == {str(damaged.folder / path) for path in results if path not in optional}
    assert len(lines) == len(named)


@pytest.mark.parametrize("damage", ["a flipped bit", "cut", "empty", "#REF!", "zeros", "removed"])
def test_every_damaged_record_is_told_by_jobs_and_verify(damaged, damage):
    rng = random.Random(damage)
    wrong = []
    for path in damaged.jobs:
        before = (damaged.folder / path).read_bytes()
        content = None if damage == "removed" else DAMAGES[damage](before, rng)
        with damaged.changed(path, content):
            said = damaged.told_by(path)
            code, lines = damaged.verify_says()
        near = [Path(path).name, *map(str, damaged.jobs[path]["outputs"])]
        for one in said.values():
            if one.count("\n") != 1 or not any(name in one for name in near):
                wrong.append((path, one))
        if code != 1 or not any(name in line for line in lines for name in near):
            wrong.append((path, lines))
    assert wrong == []


def test_hundreds_of_flipped_bits_are_all_told(damaged):
    """Those of results by verify at once; each bit of a record is one that it is sealed by."""
    rng = random.Random(1)
    results = [path for path in damaged.files if not is_record(path)]
    for _ in range(2):
        with contextlib.ExitStack() as all_at_once:
            for path in results:
                content = flipped((damaged.folder / path).read_bytes(), rng)
                all_at_once.enter_context(damaged.changed(path, content))
            _, lines = damaged.verify_says()
        assert len(lines) == len(results)
    record = damaged.folder / "results/tiny/seed_3/made.json"
    content = record.read_bytes()
    try:
        for _ in range(500):
            record.write_bytes(flipped(content, rng))
            assert read_record(record) == {}
    finally:
        record.write_bytes(content)


@pytest.mark.parametrize(
    ("rule", "path"),
    [
        ("energy_split", "results/tiny/jamming.csv"),
        # No input of the job, which reads it where it is kept.
        ("packing_figures", "results/tiny/seed_3/particles.dump.gz"),
    ],
)
def test_a_job_that_snakemake_starts_ends_with_one_line(finished, tmp_path, rule, path):
    """As on a cluster, after the run began; a run that begins would make the file anew."""
    study = finished.copied(finished.folder, tmp_path / "study")
    content = flipped((study.folder / path).read_bytes(), random.Random(1))
    (study.folder / path).write_bytes(content)
    only = ["--target-jobs", f"{rule}:sample=tiny", "--allowed-rules", rule]
    run = study.snakemake(
        "--mode", "subprocess", *only, "--force", f"results/tiny/made/{rule}.json"
    )
    line = (
        f"branchcrush: {path} is not as its job left it (changed, cut or damaged): delete "
        f"{Path(path).name} and run the study again\n"
    )
    said = run.stdout + run.stderr
    assert run.returncode == 1 and said.count(line) == 1 and "Traceback" not in said
    assert (study.folder / f"logs/tiny/{rule}.log").read_text().endswith(line)


# --- what is whole, and not its own ---------------------------------------------------------------


@pytest.fixture
def copy(damaged, tmp_path):
    """A copy of the results alone, in a folder of another name."""
    shutil.copytree(damaged.folder / "results", tmp_path / "kept")
    return tmp_path / "kept"


def verified(folder, capsys):
    """Return exit code, what is printed, and each fault without the folder."""
    capsys.readouterr()
    code = main(["verify", str(folder)])
    printed = capsys.readouterr()
    return code, printed.out, [line.replace(f"{folder}/", "") for line in printed.err.splitlines()]


def resealed(path, **changes):
    record = read_record(path)
    record.pop("sha256")
    path.write_bytes(record_bytes({**record, **changes}))


def test_results_alone_are_verified_wherever_they_lie(copy, capsys):
    code, printed, faults = verified(copy, capsys)
    assert (code, faults) == (0, [])
    assert re.fullmatch(rf"sound: {copy}: \d+ files are what \d+ jobs left\n", printed)


def test_dumps_may_go_and_files_of_the_users_stay(copy, capsys):
    for dump in copy.rglob("*.dump.gz"):
        dump.unlink()
    (copy / "tiny" / "notes.txt").write_text("mine")
    (copy / "preview.txt").write_text("made when asked for")
    code, printed, faults = verified(copy, capsys)
    assert (code, faults) == (0, [])
    assert "no results of this study: tiny/notes.txt\n" in printed and "preview" not in printed


def test_a_seed_in_the_place_of_another_is_told(copy, capsys):
    shutil.rmtree(copy / "tiny/seed_3")
    shutil.copytree(copy / "tiny/seed_5", copy / "tiny/seed_3")
    code, printed, faults = verified(copy, capsys)
    assert code == 1 and "not sound: " in printed
    assert faults[0] == (
        "tiny/seed_3/made.json is the record of other files (rule compression of sample tiny "
        "seed 5): delete made.json and run the study again"
    )
    assert all("tiny/seed_3/" in fault for fault in faults)
    with pytest.raises(ResultsError, match=r"path.csv does not belong here: .* sample tiny seed 5"):
        _ = branchcrush.open_study(copy)["tiny"].seed(3).path.data


def test_a_seed_of_another_configuration_is_told(copy, capsys):
    record = copy / "tiny/seed_5/made.json"
    params = read_record(record)["params"]
    resealed(record, params={**params, "sample": {**params["sample"], "grains": 61}})
    _, _, faults = verified(copy, capsys)
    assert faults == [
        "tiny/seed_5/made.json tells that its files were made with another configuration "
        "(grains): delete made.json and run the study again"
    ]


def test_what_was_made_from_other_files_is_told(copy, capsys):
    """As where a fit was done anew, and what follows was not."""
    fit, record = copy / "tiny/energy_split.json", copy / "tiny/made/energy_split.json"
    fit.write_bytes(fit.read_bytes() + b"\n")
    outputs = read_record(record)["outputs"]
    path = "results/tiny/energy_split.json"
    resealed(record, outputs={**outputs, path: file_digest(fit)})
    _, _, faults = verified(copy, capsys)
    assert len(faults) > 4
    assert all(f"made from another {path} than the one that is there" in one for one in faults)


def test_what_is_missing_with_its_record_is_told(copy, capsys):
    shutil.rmtree(copy / "tiny/seed_5")
    _, _, faults = verified(copy, capsys)
    line = "tiny/seed_5/path.csv is missing: run the study again (rule compression writes it)"
    assert line in faults
    (copy / "datapackage.json").unlink()
    assert "tiny/seed_5/path.csv is missing: run the study again" in verified(copy, capsys)[2]


def test_what_a_run_was_not_asked_for_is_no_fault(copy, capsys):
    (copy / "report.html").unlink()
    (copy / "made/report.json").unlink()
    code, printed, faults = verified(copy, capsys)
    assert (code, faults) == (0, [])
    assert "not made, or deleted with what told of them: 1 of rule report\n" in printed


def test_files_without_a_record_are_told(copy, capsys):
    (copy / "tiny/seed_5/made.json").unlink()
    _, _, faults = verified(copy, capsys)
    told = "has no record of what made it: delete path.csv and run the study again"
    assert f"tiny/seed_5/path.csv {told}" in faults
    with pytest.warns(ResultsWarning, match=r"path.csv has no record"):
        _ = branchcrush.open_study(copy)["tiny"].seed(5).path.data


def test_other_versions_and_seeds_that_are_left_are_no_faults(copy, capsys):
    record = copy / "tiny/seed_5/made.json"
    resealed(record, branchcrush="0.0.9")
    shutil.copytree(copy / "tiny/seed_5", copy / "tiny/seed_7")
    record = copy / "tiny/seed_7/made.json"
    moved = {
        part: {path.replace("seed_5", "seed_7"): digest for path, digest in told.items()}
        for part, told in read_record(record).items()
        if part in ("outputs", "beside")
    }
    resealed(record, wildcards={"sample": "tiny", "seed": "7"}, **moved)
    code, printed, faults = verified(copy, capsys)
    assert (code, faults) == (0, [])
    assert f"made by branchcrush 0.0.9, 0.1.0; this is {branchcrush.__version__}\n" in printed
    assert (
        "samples or seeds that the study no longer has: tiny/seed_7/compressed.parquet" in printed
    )


@pytest.mark.parametrize(("place", "code"), [("nothing", 1), ("empty", 1)])
def test_a_folder_without_results_is_refused(tmp_path, capsys, place, code):
    (tmp_path / "empty").mkdir()
    assert main(["verify", str(tmp_path / place)]) == code
    assert "name the folder results" in capsys.readouterr().err
