"""The workflow in a folder of its own: with a config.yaml alone, or a copy of all that it is."""

import contextlib
import io
import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from branchcrush.command.main import main

ROOT = Path(__file__).parents[2]

TINY = """\
samples:
  tiny:
    grading: {form: uniform, basis: number, size: radius, unit: m, min: 5.0e-5, max: 1.0e-3}
    grains: 60
    allow_unrepresentative: true
    boundary: walls
    loading: {edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 12, quality: draft}
    seeds: [3, 5]
    refined_seeds: 1
figures: {dpi: 100}
"""


class Study:
    """A folder that holds a config.yaml, and what a user types in it."""

    tiny = TINY
    snakefile = ROOT / "Snakefile"
    source = ROOT / "src"

    def __init__(self, folder):
        self.folder = folder
        self.configure(TINY)

    def configure(self, text):
        (self.folder / "config.yaml").write_text(text)

    def snakemake(self, *arguments, cores=2, wrapped_in=()):
        # The copy's own package comes first, so that a test may edit its modules.
        environment = {
            **os.environ,
            "PYTHONPATH": str(self.source),
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        }
        command = [sys.executable, "-m", "snakemake"]
        command += [] if cores is None else ["--cores", str(cores)]
        return subprocess.run(
            [*wrapped_in, *command, "--snakefile", str(self.snakefile), *arguments],
            cwd=self.folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=400,
        )

    def refused(self, *arguments, wrapped_in=()):
        """Return the problems that a run names, having checked that it leaves nothing behind."""
        before = self.contents()
        spent = processor_time()
        run = self.snakemake(*arguments, cores=1, wrapped_in=wrapped_in)
        spent = processor_time() - spent
        text = run.stdout + run.stderr
        assert run.returncode == 1, text
        assert "Traceback" not in text, text
        assert "site-packages" not in text and "src/branchcrush" not in text, text
        assert self.contents() == before
        # Of the processor: a busy machine must not fail this.
        assert spent < 10, text
        return [line for line in text.splitlines() if line.startswith("config: ")]

    def checked(self):
        """Return the problems that `branchcrush check` names, in a thousandth of a run's time.

        It makes the checks that a run begins with; a test holds that both name the same.
        """
        before, said = self.contents(), io.StringIO()
        with (
            contextlib.chdir(self.folder),
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(said),
        ):
            code = main(["check"])
        assert code == 1, said.getvalue()
        assert self.contents() == before
        return [line for line in said.getvalue().splitlines() if line.startswith("config: ")]

    def contents(self):
        """Return the files and folders but for the workflow engine's own."""
        found = (path.relative_to(self.folder) for path in self.folder.rglob("*"))
        return sorted(path for path in found if path.parts[0] != ".snakemake")


class Project(Study):
    """A copy of the project, whose files a test may edit."""

    def __init__(self, folder):
        for name in ("Snakefile", "workflow", "profiles", "lammps_inputs", "src"):
            source = ROOT / name
            copy = shutil.copytree if source.is_dir() else shutil.copy
            copy(source, folder / name)
        self.snakefile = folder / "Snakefile"
        self.source = folder / "src"
        super().__init__(folder)

    def planned_rules(self):
        """Return the rules that a run would execute now."""
        shown = self.snakemake("--dry-run", "--quiet", "host")
        assert shown.returncode == 0, shown.stdout + shown.stderr
        return {
            line.split()[1].rstrip(":")
            for line in (shown.stdout + shown.stderr).splitlines()
            if line.startswith(("rule ", "localrule "))
        } - {"all"}


def processor_time():
    """Return what the commands run so far have used of the processor [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@pytest.fixture(scope="session", autouse=True)
def compiled_modules(tmp_path_factory):
    """Keep compiled modules where none may be written beside the sources: starts take a third."""
    with pytest.MonkeyPatch.context() as patch:
        if os.environ.get("PYTHONDONTWRITEBYTECODE"):
            patch.delenv("PYTHONDONTWRITEBYTECODE")
            patch.setenv("PYTHONPYCACHEPREFIX", str(tmp_path_factory.mktemp("compiled")))
            modules = "import snakemake.cli, branchcrush.config.checks"
            subprocess.run([sys.executable, "-c", modules], check=True)
        yield


@pytest.fixture
def study(tmp_path):
    return Study(tmp_path)


@pytest.fixture
def project(tmp_path):
    return Project(tmp_path)


@pytest.fixture(scope="session")
def new_project():
    """Return what makes a copy of the project in a folder."""
    return Project


@pytest.fixture(scope="session")
def finished(tmp_path_factory):
    """The tiny study, run to its end."""
    project = Project(tmp_path_factory.mktemp("study"))
    run = project.snakemake()
    assert run.returncode == 0, run.stdout + run.stderr
    project.output = run.stdout + run.stderr
    return project


@pytest.fixture(scope="session")
def sample(finished):
    """The results of its sample."""
    return finished.folder / "results" / "tiny"
