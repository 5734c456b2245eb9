"""The environment: what a run installs, what is added for tests, and whose folder it is in."""

import os
import re
import shutil
import subprocess
import tempfile
import tomllib
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
RUN, DEV, SLURM = "requirements.lock", "requirements-dev.lock", "requirements-slurm.lock"


def lines(lock):
    return (REPOSITORY / lock).read_text(encoding="utf-8").splitlines()


def pins(lock):
    """Return the version of each package of a lock."""
    named = [re.match(r"([a-z0-9.-]+)==([^ ]+)", line) for line in lines(lock)]
    return {match[1]: match[2] for match in named if match}


def names(requirements):
    return {re.match(r"[a-z0-9.-]+", requirement)[0] for requirement in requirements}


@pytest.fixture(scope="module")
def project():
    return tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture
def make(tmp_path):
    """Return a function that runs make on a copy of what decides about the environment."""
    for name in ("Makefile", "pyproject.toml", RUN, DEV, SLURM):
        shutil.copy(REPOSITORY / name, tmp_path)
    # The tests themselves may be run by make, which hands its flags on.
    environment = {name: value for name, value in os.environ.items() if "MAKE" not in name}

    def run(*arguments):
        command = ["make", *arguments]
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60
        )

    return run


def test_a_run_installs_what_it_needs_and_no_more(project):
    assert names(project["dependencies"]) <= pins(RUN).keys()
    assert names(project["optional-dependencies"]["build"]) <= pins(RUN).keys()
    for extra in ("docs", "lint", "test"):
        named = names(project["optional-dependencies"][extra])
        assert named <= pins(DEV).keys()
        assert not named & pins(RUN).keys()


def test_what_slurm_needs_is_pinned_apart(project):
    # Snakemake imports it at each start, so no other target installs it.
    assert names(project["optional-dependencies"]["slurm"]) <= pins(SLURM).keys()
    assert not pins(SLURM).keys() & (pins(RUN).keys() | pins(DEV).keys())


def test_the_locks_agree():
    both = pins(RUN).keys() & pins(DEV).keys()
    assert {name: pins(RUN)[name] for name in both} == {name: pins(DEV)[name] for name in both}


@pytest.mark.parametrize(("lock", "fewest"), [(RUN, 20), (DEV, 20), (SLURM, 2)])
def test_a_lock_is_pinned_hashed_and_names_no_address(lock, fewest):
    entries = [line for line in lines(lock) if line and not line.startswith(("#", " "))]
    assert len(entries) >= fewest
    for entry in entries:
        assert re.fullmatch(r"[a-z0-9.-]+==\S+( ; .+)? \\", entry)
        assert lines(lock)[lines(lock).index(entry) + 1].startswith("    --hash=sha256:")
    assert not [line for line in lines(lock) if "://" in line or line.startswith("-")]


@pytest.mark.parametrize("target", ["run", "preview", "example", "bench"])
def test_a_run_does_not_touch_the_lock_of_the_tests(make, target):
    planned = make("--dry-run", target).stdout
    assert RUN in planned
    assert DEV not in planned


def test_slurm_is_added_where_it_is_asked_for(make):
    for target in ("run", "test", "lint"):
        assert SLURM not in make("--dry-run", target).stdout
    for target in ("slurm", "test-cluster"):
        planned = make("--dry-run", target).stdout
        assert planned.index(RUN) < planned.index(SLURM)


@pytest.mark.parametrize("target", ["test", "lint", "docs"])
def test_tests_and_linters_add_to_what_a_run_has(make, target):
    planned = make("--dry-run", target).stdout
    assert planned.index(RUN) < planned.index(DEV)
    assert planned.count("venv --clear") == 1


@pytest.mark.parametrize("target", ["run", "test"])
def test_a_linked_environment_is_refused_and_stays_as_it_is(make, tmp_path, target):
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    (theirs / "something").write_text("of somebody")
    (tmp_path / ".venv").symlink_to(theirs)
    refused = make(target)
    assert refused.returncode
    assert f".venv is a link to {theirs}" in refused.stderr
    assert "rm .venv" in refused.stderr
    assert [file.read_text() for file in theirs.iterdir()] == ["of somebody"]


def test_a_linked_environment_is_refused_even_if_nothing_is_to_be_installed(make, tmp_path):
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    for stamp in (".packages", ".ready", ".develop"):
        (theirs / stamp).touch()
    (tmp_path / ".venv").symlink_to(theirs)
    assert "is a link" in make("run").stderr


def test_cleaning_removes_a_link_and_not_what_it_leads_to(make, tmp_path):
    theirs = tmp_path / "theirs"
    theirs.mkdir()
    (theirs / "something").touch()
    (tmp_path / ".venv").symlink_to(theirs)
    make("clean")
    assert not (tmp_path / ".venv").is_symlink()
    assert (theirs / "something").exists()


FAKE = """#!/usr/bin/env bash
echo "{name} user=$EUID python=${{PYTHON-}} cores=${{CORES-}}" \
  "bytecode=${{PYTHONDONTWRITEBYTECODE-}} $*" >>"$CALLS"
"""
# It hands no environment on, as sudo does not.
SUDO = """#!/usr/bin/env bash
shift
exec env -i CALLS="$CALLS" PATH=/usr/bin:/bin "$@"
"""


def test_a_users_environment_is_made_by_the_user_and_root_only_runs_the_tests_of_the_cluster():
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for part in (".ci", ".venv/bin", "bin"):
            (folder / part).mkdir(parents=True)
        shutil.copy(REPOSITORY / ".ci/run", folder / ".ci")
        there = ("make", "python3.99", "chromium", "chromedriver", "slurmctld", "munged")
        fakes = {f"bin/{name}": FAKE.format(name=name) for name in there}
        fakes |= {"bin/sudo": SUDO, ".venv/bin/pytest": FAKE.format(name="pytest")}
        for path, text in fakes.items():
            (folder / path).write_text(text)
        for path in (folder, *folder.rglob("*")):
            path.chmod(0o777)
        calls = folder / "calls"
        environment = {"PATH": f"{folder}/bin:/usr/bin:/bin", "CALLS": str(calls)}
        subprocess.run(
            [folder / ".ci/run"],
            env=environment | {"PYTHON": "python3.99", "CORES": "3"},
            user=65534 if os.geteuid() == 0 else None,
            capture_output=True,
            timeout=60,
            check=True,
        )
        told = calls.read_text().splitlines()
    called = [line.split() for line in told if not line.startswith("python3.99")]
    first, second, last = called
    assert [first[0], first[2:4], first[-1]] == ["make", ["python=python3.99", "cores=3"], "test"]
    assert [second[0], second[2:4], second[-1]] == ["make", first[2:4], "slurm"]
    assert [last[0], last[4]] == ["pytest", "bytecode=1"]
    assert last[5:] == ["-p", "no:cacheprovider", "tests/cluster"]
