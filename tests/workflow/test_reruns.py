"""What a change reruns: its own stage and what follows, nothing before it."""

import os

import pytest

PAGE = {"report"}
FIGURES = {"packing_figures", "fit_figures"} | PAGE
# Beside whichever key: it writes the whole configuration.
CONFIG = {"comparison"}
MODEL = {"thermodynamics", "comparison", "fit_figures", "report"}
NETWORKS = {"branch_lengths", "sharing", "packing_figures", "findings"} | PAGE
SPLIT = {"energy_split", "verdict"} | MODEL | NETWORKS
PACKING = {"compression", "grading", "certificate"} | SPLIT


@pytest.fixture
def study(finished):
    yield finished
    finished.configure(finished.tiny)


def test_a_second_run_does_nothing(study):
    assert study.planned_rules() == set()
    run = study.snakemake()
    assert "Nothing to be done" in run.stdout + run.stderr


@pytest.mark.parametrize(
    ("old", "new", "rules"),
    [
        ("dpi: 100", "dpi: 120", FIGURES | CONFIG),
        ("figures:", "thermodynamics: {critical_energy: 3.0e5}\nfigures:", MODEL),
        ("figures:", "energy_split: {confidence: 0.9}\nfigures:", SPLIT),
        ("figures:", "energy_split: {bins: 15}\nfigures:", SPLIT),
        # The job that compresses a packing makes it.
        ("states: 12", "states: 8", PACKING),
        ("    grains", "    contact: {law: linear, normal_stiffness: 2.0e6}\n    grains", PACKING),
        ("grains: 60", "grains: 50", PACKING),
    ],
)
def test_a_changed_key_reruns_its_stage_and_what_follows(study, old, new, rules):
    assert old in study.tiny
    study.configure(study.tiny.replace(old, new))
    assert study.planned_rules() == rules


@pytest.mark.parametrize(
    ("file", "rules"),
    [
        ("src/branchcrush/plotting/energy.py", {"fit_figures", "report"}),
        ("src/branchcrush/plotting/shielding.py", {"packing_figures", "report"}),
        ("src/branchcrush/study/findings.py", {"findings"} | PAGE),
        (
            "src/branchcrush/energy/shielding_grains.py",
            {"sharing", "packing_figures", "report", "findings"} | PAGE,
        ),
        ("src/branchcrush/plotting/loading.py", {"fit_figures", "report"}),
        ("src/branchcrush/crushing/forms.py", MODEL | {"report"}),
        ("src/branchcrush/loading/measures.py", PACKING),
        ("src/branchcrush/packings/placement.py", PACKING),
        ("lammps_inputs/mod.near", PACKING),
        ("workflow/report/report.html.jinja", {"report"}),
    ],
)
def test_an_edited_file_reruns_the_stages_that_use_it(study, file, rules):
    edited = study.folder / file
    before, times = edited.read_text(), edited.stat()
    edited.write_text(before + "\n# edited\n")
    try:
        assert study.planned_rules() == rules
    finally:
        edited.write_text(before)
        os.utime(edited, ns=(times.st_atime_ns, times.st_mtime_ns))


def test_a_new_seed_runs_only_that_seed(study):
    study.configure(study.tiny.replace("seeds: [3, 5]", "seeds: [3, 5, 7]"))
    shown = study.snakemake("--dry-run").stdout
    assert "seed 7" in shown
    assert "seed 3" not in shown
