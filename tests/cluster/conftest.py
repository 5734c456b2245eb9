"""A cluster for all tests here, and a study that is run on it, and once on this machine alone.

`make test-cluster` runs them; plain `make test` does not collect them.
"""

import pytest

from benchmarks.slurm import Cluster
from tests.cluster.study import ClusterStudy, one_machine


@pytest.fixture(scope="session")
def cluster(tmp_path_factory):
    """Slurm on this machine, for as long as the tests last."""
    cluster = Cluster(tmp_path_factory.mktemp("slurm"))
    cluster.start()
    yield cluster
    cluster.stop()


@pytest.fixture(scope="session")
def expected(tmp_path_factory):
    """The digest of each result of the study, made by one command on this machine."""
    return one_machine(tmp_path_factory.mktemp("alone") / "study")


@pytest.fixture(scope="session")
def expected_packings(expected):
    """The same of the packings alone."""
    return {name: digest for name, digest in expected.items() if "/lone/seed_" in name}


@pytest.fixture
def study(cluster, tmp_path):
    """The study in a folder of its own, to be run on the cluster."""
    study = ClusterStudy(tmp_path / "study", cluster)
    yield study
    study.end_all()
