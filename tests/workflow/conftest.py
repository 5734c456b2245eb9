"""A copy of the workflow in a folder of its own, run once on a tiny sample."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

TINY = """\
samples:
  tiny:
    grading: {form: uniform, radius_min: 5.0e-5, radius_max: 1.0e-3}
    grains: 60
    boundary: walls
    loading: {approach_solid_fraction: 0.45, steps: 24, states: 12}
    seeds: [3, 5]
figures: {dpi: 100}
"""


class Project:
    """The project's folder, and what a user types in it."""

    tiny = TINY

    def __init__(self, folder):
        self.folder = folder
        for name in ("Snakefile", "workflow", "lammps_inputs", "src"):
            source = ROOT / name
            copy = shutil.copytree if source.is_dir() else shutil.copy
            copy(source, folder / name)
        self.configure(TINY)

    def configure(self, text):
        (self.folder / "config.yaml").write_text(text)

    def snakemake(self, *arguments, cores=2):
        # The copy's own package comes first, so that a test may edit its modules.
        environment = {
            **os.environ,
            "PYTHONPATH": str(self.folder / "src"),
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        }
        return subprocess.run(
            [sys.executable, "-m", "snakemake", "--cores", str(cores), *arguments],
            cwd=self.folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=400,
        )

    def planned_rules(self):
        """Return the rules that a run would execute now."""
        shown = self.snakemake("--dry-run", "--quiet", "host")
        assert shown.returncode == 0, shown.stdout + shown.stderr
        return {
            line.split()[-1].rstrip(":")
            for line in (shown.stdout + shown.stderr).splitlines()
            if line.startswith(("rule ", "localrule "))
        } - {"all"}


@pytest.fixture
def project(tmp_path):
    return Project(tmp_path)


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """The tiny study, run to its end."""
    project = Project(tmp_path_factory.mktemp("study"))
    run = project.snakemake()
    assert run.returncode == 0, run.stdout + run.stderr
    project.output = run.stdout + run.stderr
    return project
