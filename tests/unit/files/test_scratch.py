"""Scratch folders: whose process lives stay, and the others are removed."""

import os
import signal
import subprocess
import sys

import pytest

from branchcrush.files.scratch import remove_dead, remove_leavings, scratch_folder

WAITS = """\
import sys, time
from branchcrush.files.scratch import scratch_folder
with scratch_folder(sys.argv[1], sys.argv[2]) as folder:
    (folder / "dump").touch()
    print(folder, flush=True)
    time.sleep(60)
"""


@pytest.fixture
def killed(tmp_path):
    """Return what makes a scratch folder whose process was killed, by prefix and place."""

    def make(prefix, place):
        process = subprocess.Popen(
            [sys.executable, "-c", WAITS, prefix, str(place)], stdout=subprocess.PIPE, text=True
        )
        folder = process.stdout.readline().strip()
        remove_dead(place, prefix)
        assert os.listdir(folder) == ["dump"]
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
        assert os.path.isdir(folder)
        return folder

    return make


def test_folder_goes_with_its_block_also_after_an_error(tmp_path):
    with pytest.raises(ValueError, match="full"), scratch_folder("mine-", tmp_path) as folder:
        (folder / "dump").touch()
        raise ValueError("full")
    assert list(tmp_path.iterdir()) == []


def test_folder_of_a_killed_process_is_removed_and_no_other(tmp_path, killed):
    folder = killed("mine-", tmp_path)
    (tmp_path / "mine-of-another-machine-x").mkdir()
    with scratch_folder("mine-", tmp_path) as own:
        remove_dead(tmp_path, "mine-")
        assert not os.path.exists(folder)
        assert own.is_dir()
        assert (tmp_path / "mine-of-another-machine-x").is_dir()


def test_leavings_of_killed_jobs_are_removed_and_results_stay(tmp_path, killed):
    seed, figures = tmp_path / "sand" / "seed_3", tmp_path / "figures" / "sand"
    for folder in (seed, figures):
        folder.mkdir(parents=True)
    # Jobs are known to be dead by then, on whatever machine.
    (seed / ".compress-of-another-machine").mkdir()
    trial = killed(".trial-", figures)
    dead, alive = 2**22 + 1, os.getpid()  # the first is above what Linux gives
    gone = [seed / f".path.csv.{alive}", figures / f".preview.png.{dead}"]
    stay = [seed / "path.csv", seed / ".path.csv", figures / f".preview.png.{alive}"]
    for file in gone + stay:
        file.touch()
    with scratch_folder(".trial-", figures) as own:
        remove_leavings(tmp_path)
        assert sorted(seed.iterdir()) == sorted(stay[:2])
        assert sorted(figures.iterdir()) == sorted([own, stay[2]])
    assert not os.path.exists(trial)
