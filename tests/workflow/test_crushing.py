"""A tiny sample whose grains break, between walls and with Hertz contacts, from end to end."""

import contextlib
import hashlib
import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from matplotlib import image

from branchcrush.config.sample import sample_of
from branchcrush.files.tables import read_json, read_packing, read_table
from branchcrush.lammps.compression import compress, sample_variables
from tests.pages import lost_links, said
from tests.physics.crushings import killed_after
from tests.pictures import is_whole

SEED = 3
# Of the whole sample, and of the crushing of its seed; what they hold the dictionary's tests hold.
OF_SAMPLE = (
    "crushing_states.csv",
    "crushing_means.csv",
    "crushing_gradings.csv",
    "crushing_lengths.csv",
    "crushing_line.csv",
    "crushing_beside_forms.csv",
    "crushing.json",
    "crushing_predicted.csv",
    "crushing_beside_predicted.csv",
    "crushing_predicted.json",
    "crushed_predictors.csv",
    "crushed_roc.csv",
    "crushed_hazards.csv",
    "crushed_survivors.csv",
    "crushed_survival.csv",
    "crushed_exponents.csv",
    "crushed_loads.csv",
    "crushed_overshoots.csv",
    "crushed_grains.json",
)
OF_SEED = (
    "path.csv",
    "steps.csv",
    "contacts.parquet",
    "wall_contacts.parquet",
    "grains.parquet",
    "breakages.parquet",
    "particles.dump.gz",
    "pairs.dump.gz",
    "made.json",
)
FIGURES = (
    "crushed_line",
    "crushed_gradings",
    "crushed_lengths",
    "crushed_energy",
    "crushed_measures",
    "crushed_forms",
    "crushed_predicted",
    "crushed_packing",
    "who_breaks",
    "split_of_crushed",
)
TARGET = f"results/breaking/crushing/seed_{SEED}/path.csv"


@pytest.fixture(scope="module")
def crushed(breaking):
    return breaking.folder / "results/breaking"


def test_every_result_file_is_there(crushed):
    asked = {*OF_SAMPLE, *(f"crushing/seed_{SEED}/{name}" for name in OF_SEED)}
    assert {name for name in asked if not (crushed / name).stat().st_size} == set()
    assert not list(crushed.parents[1].glob(".branchcrush/checkpoints/**/*.*"))


def test_tables_of_a_seed_tell_the_same_breakages_energy_and_mass(crushed):
    folder = crushed / f"crushing/seed_{SEED}"
    path = read_table(folder / "path.csv").set_index("state")
    grains, broken, contacts, walls = (
        read_table(folder / f"{kind}.parquet")
        for kind in ("grains", "breakages", "contacts", "wall_contacts")
    )
    assert len(broken) == path["breakages"].iloc[-1] > 0
    assert (grains.groupby("state").size() == path["grains"]).all()
    assert path["grains"].iloc[-1] == 24 + 5 * len(broken)
    mass = (grains["radius_m"] ** 3).groupby(grains["state"]).sum()
    assert np.allclose(mass, mass[0], rtol=1e-12)
    last = path.index[-1]
    here, at_wall = (table[table["state"] == last] for table in (contacts, walls))
    assert len(at_wall)
    # Hertz: 2/5 of the force times the overlap, with a wall as with a grain.
    held = 0.4 * (here["normal_force_N"] * here["overlap_m"]).sum()
    assert here["energy_J"].sum() == pytest.approx(held, rel=1e-9)
    stored = path["elastic_energy_J"][last]
    assert 0.0 < here["energy_J"].sum() < stored
    taken = path["dissipated_breakage_J"] + path["dissipated_rearrangement_J"]
    assert path["work_J"][last] == pytest.approx(stored + taken[last], rel=1e-9)


def test_results_of_the_sample_are_of_its_seed(crushed):
    summary = read_json(crushed / "crushing.json")
    broken = len(read_table(crushed / f"crushing/seed_{SEED}/breakages.parquet"))
    assert (summary["seeds"], summary["halved_seeds"]) == ([SEED], [])
    assert summary["contact_law"] == "hertz"
    assert summary["breakages"] == broken
    assert read_json(crushed / "crushed_grains.json")["breakages"] == broken
    assert set(read_table(crushed / "crushing_states.csv")["seed"]) == {SEED}


def test_the_page_shows_every_figure_and_no_figure_is_blank(breaking):
    page = (breaking.folder / "results/crushing.html").read_text(encoding="utf-8")
    # And the still picture of the view in three dimensions.
    assert page.count("data:image/png;base64,") == len(FIGURES) + 1
    assert not re.search(r"nan\b|None", said(page))
    # Of this sample the page of crushing alone was asked for.
    assert set(lost_links(breaking.folder / "results/crushing.html")) <= {"report.html"}
    for figure in FIGURES:
        path = breaking.folder / f"results/figures/breaking/{figure}.png"
        assert is_whole(path), figure
        pixels = image.imread(path)[..., :3].reshape(-1, 3)
        assert 0.01 < (pixels.min(axis=-1) < 0.9).mean() < 0.9, figure
        assert len(np.unique(pixels, axis=0)) > 20, figure


def test_a_crushing_killed_in_the_middle_goes_on_to_the_same_bytes(breaking):
    folder = breaking.folder / f"results/breaking/crushing/seed_{SEED}"
    before = digests(folder)
    (folder / "path.csv").unlink()
    kept = (
        breaking.folder
        / f".branchcrush/checkpoints/results/breaking/crushing/seed_{SEED}/made.json"
    )
    with started(breaking, TARGET):
        wait_until((kept / "account_3.kept").exists)
    assert not (folder / "path.csv").exists()
    run = breaking.snakemake(TARGET, cores=1)
    assert run.returncode == 0, run.stdout + run.stderr
    assert not kept.exists()
    assert digests(folder) == before
    # A row of LAMMPS for each state: none is computed again but for the one it was killed at.
    log = (breaking.folder / f"logs/breaking/seed_{SEED}/crushing.log").read_text()
    states = [int(state) for state in re.findall(r"^(\d+),\d+,\d+,", log, re.MULTILINE)]
    # A state that took no time is not kept.
    assert states == list(range(states[0], 7))
    assert states[0] in (0, 2, 3, 4, 5)
    said = f"\nbranchcrush: continues from state {states[0] - 1} of 6\n"
    assert (said in log) == (states[0] > 0)


def test_a_compression_killed_in_the_middle_goes_on_to_the_same_bytes(breaking, tmp_path):
    results = f"results/breaking/seed_{SEED}"
    folder = breaking.folder / results
    kept = breaking.folder / ".branchcrush/checkpoints" / results / "made.json"
    before, record = digests(folder), read_json(folder / "made.json")
    packing = read_packing(folder / "packing.npz")
    variables = sample_variables(sample_of(record["params"]["sample"]), packing[1])
    # So few grains are done before anybody can kill them: here, as the job would have done it.
    with killed_after(2):
        compress(
            *packing,
            variables,
            inputs=breaking.folder / "lammps_inputs",
            folder=tmp_path,
            log=tmp_path / "log",
            checkpoint=kept,
            code=record["code"],
        )
    # As Snakemake does before the job.
    for name in ("path.csv", "made.json"):
        (folder / name).unlink()
    run = breaking.snakemake(f"{results}/path.csv", cores=1)
    assert run.returncode == 0, run.stdout + run.stderr
    log = (breaking.folder / f"logs/breaking/seed_{SEED}/compression.log").read_text()
    assert "\nbranchcrush: continues from state 3 of 6\n" in log
    assert not kept.exists()
    assert digests(folder) == before


@contextlib.contextmanager
def started(project, *targets):
    """Begin a run in a process group of its own, which is killed when this block ends."""
    command = [sys.executable, "-m", "snakemake", "--cores", "1"]
    run = subprocess.Popen(
        [*command, "--snakefile", str(project.snakefile), *targets],
        cwd=project.folder,
        env={**os.environ, "PYTHONPATH": str(project.source)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield run
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(run.pid, signal.SIGKILL)
        run.wait()


def wait_until(true):
    end = time.monotonic() + 200
    while not true():
        assert time.monotonic() < end
        time.sleep(0.005)


def digests(folder):
    """Return the checksum of each file but for the record, which tells when it was made."""
    return {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.iterdir()
        if path.name != "made.json"
    }
