"""The workflow in a folder of its own: with a config.yaml alone, or a copy of all that it is."""

import contextlib
import fcntl
import io
import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from branchcrush.command.main import main
from tests.workflow import loaded

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
# Walls and Hertz contacts; a limit so high that fragments do not break, and few are made.
BREAKING = """\
samples:
  breaking:
    grading: {form: uniform, basis: number, size: diameter, unit: mm, min: 0.8, max: 1.2}
    grains: 24
    allow_unrepresentative: true
    boundary: walls
    contact: {law: hertz, young_modulus: 2.06e10, poisson_ratio: 0.17}
    loading: {solid_fraction: 0.6, approach_solid_fraction: 0.42, states: 5, quality: draft}
    breakage:
      strength: 1.0e7
      weibull_modulus: 3
      unit: mm
      reference_diameter: 1.0
      smallest_diameter: 0.7
      fragments: 6
      growth_stages: 2
    seeds: [3]
    refined_seeds: 0
energy_split: {resamples: 100}
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

    def snakemake(self, *arguments, cores=2, wrapped_in=(), new=False):
        """Run what is typed: in a process that has Snakemake loaded, or in a new one."""
        # The copy's own package comes first, so that a test may edit its modules.
        environment = {
            **os.environ,
            "PYTHONPATH": str(self.source),
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        }
        command = [] if cores is None else ["--cores", str(cores)]
        command += ["--snakefile", str(self.snakefile), *arguments]
        if not (wrapped_in or new):
            return loaded.snakemake(command, self.folder, environment, timeout=400)
        before = processor_time()
        run = subprocess.run(
            [*wrapped_in, sys.executable, "-m", "snakemake", *command],
            cwd=self.folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=400,
        )
        run.processor_time = processor_time() - before
        return run

    def refused(self, *arguments, wrapped_in=()):
        """Return the problems that a run names, having checked that it leaves nothing behind."""
        before = self.contents()
        run = self.snakemake(*arguments, cores=1, wrapped_in=wrapped_in)
        text = run.stdout + run.stderr
        assert run.returncode == 1, text
        assert "Traceback" not in text, text
        assert "site-packages" not in text and "src/branchcrush" not in text, text
        assert self.contents() == before
        # Of the processor: a busy machine must not fail this.
        assert run.processor_time < 10, text
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
        # The terms that pages explain.
        (folder / "docs").mkdir()
        shutil.copy(ROOT / "docs/glossary.md", folder / "docs")
        self._move_to(folder)
        self.configure(TINY)

    @classmethod
    def copied(cls, source, folder, ignore=None):
        """Return a copy of a project and of all that was made in its folder."""
        shutil.copytree(source, folder, ignore=ignore)
        project = cls.__new__(cls)
        project._move_to(folder)
        return project

    def _move_to(self, folder):
        self.folder = folder
        self.snakefile = folder / "Snakefile"
        self.source = folder / "src"

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
    """The tiny study, run to its end by the first process of the tests that asks for it.

    Each process has a copy, which its tests may change as long as they put it back.
    """
    return run_once(tmp_path_factory, "finished", TINY)


@pytest.fixture(scope="session")
def breaking(tmp_path_factory):
    """The page of a tiny study whose grains break, made once as `finished` is."""
    return run_once(tmp_path_factory, "breaking", BREAKING, "results/crushing.html")


def run_once(tmp_path_factory, name, config, *targets):
    """Return a copy of a study that the first process of the tests has run."""
    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent
    original, output = shared / name, shared / f"{name}.txt"
    with open(shared / f"{name}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not output.exists():
            shutil.rmtree(original, ignore_errors=True)
            original.mkdir()
            project = Project(original)
            project.configure(config)
            run = project.snakemake(*targets, new=True)
            assert run.returncode == 0, run.stdout + run.stderr
            output.write_text(run.stdout + run.stderr)
    project = Project.copied(original, tmp_path_factory.mktemp("study") / "copy")
    project.output = output.read_text()
    return project


@pytest.fixture(scope="session")
def sample(finished):
    """The results of its sample."""
    return finished.folder / "results" / "tiny"
