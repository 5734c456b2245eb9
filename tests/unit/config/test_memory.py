"""Jobs that take more memory than there is: told before they start, refused where it is clear."""

import pytest

from branchcrush.config.memory import memory_warnings
from branchcrush.config.schema import checked_config
from branchcrush.errors import ConfigError
from branchcrush.files.memory import Memory
from tests.unit.config.studies import SAMPLE

# 5 states there and 4 back, and two before: 350 MB + 300 * 3 * 11 B a grain, 10.25 GB a job.
LARGE = {**SAMPLE, "grains": 1_000_000}


def study_of(**samples):
    return checked_config({"samples": samples})


def test_nothing_is_said_of_jobs_that_fit(tmp_path):
    study = study_of(sand=LARGE)
    assert memory_warnings(study, 1, Memory(64e9, 10.3e9), tmp_path) == []
    assert memory_warnings(study, 2, Memory(64e9, 20.6e9), tmp_path) == []
    assert memory_warnings(study, 64, None, tmp_path) == []


def test_jobs_at_a_time_that_do_not_fit_are_told_with_the_cores_that_do(tmp_path):
    # Two seeds, whatever cores there are.
    (line,) = memory_warnings(study_of(sand=LARGE), 8, Memory(64e9, 20.4e9), tmp_path)
    assert line == (
        "sand: 2 jobs at a time take about 20.5 GB of memory, and 20.4 GB are free: take --cores 1"
    )
    (line,) = memory_warnings(study_of(sand=LARGE), 8, Memory(64e9, 10.2e9), tmp_path)
    assert line.endswith("10.2 GB are free: ask for fewer grains or loading.states")


def test_a_job_that_the_machine_clearly_has_no_memory_for_is_refused(tmp_path):
    study = study_of(sand=LARGE, fine=SAMPLE)
    assert len(memory_warnings(study, 1, Memory(7e9, 1e9), tmp_path)) == 1
    with pytest.raises(ConfigError) as refused:
        memory_warnings(study, 1, Memory(6.8e9, 6e9), tmp_path)
    assert str(refused.value) == (
        "config: samples.sand.grains = 1000000: a job takes about 10.2 GB of memory, and the "
        "machine has 6.8 GB: ask for fewer grains or loading.states, or take a larger machine"
    )


def test_packings_that_are_there_take_none(tmp_path):
    for seed in LARGE["seeds"]:
        path = tmp_path / f"results/sand/seed_{seed}/path.csv"
        path.parent.mkdir(parents=True)
        path.touch()
    study = study_of(sand=LARGE)
    assert memory_warnings(study, 2, Memory(1e9, 1e9), tmp_path) == []
    path.unlink()
    with pytest.raises(ConfigError):
        memory_warnings(study, 2, Memory(1e9, 1e9), tmp_path)
