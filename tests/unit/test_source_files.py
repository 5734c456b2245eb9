"""What imports what: the science knows no files and no LAMMPS, the workflow misses nothing."""

import ast
import json
import re
import subprocess
import sys
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import branchcrush
from branchcrush.source_files import imported_modules, source_files

PACKAGE = Path(branchcrush.__file__).parent
REPOSITORY = Path(__file__).parents[2]
# What a check imports when it is made: few jobs need it, and SciPy takes seconds.
LATE = {"config.schema": "gradings.truncation", "config.gradings": "gradings.truncation"}


def name_of(file):
    return ".".join(Path(file).relative_to(PACKAGE).with_suffix("").parts)


MODULES = sorted(name_of(file) for file in PACKAGE.rglob("*.py") if file.name != "__init__.py")
ROOMS = ("gradings", "packings", "loading", "branches", "energy", "forces", "crushing")
ROOMS += ("statistics", "samples")
PURE = {module for module in MODULES if module.partition(".")[0] in ROOMS}
every_module = pytest.mark.parametrize("module", MODULES)


def file_of(module):
    return PACKAGE.joinpath(*module.split(".")).with_suffix(".py")


def closure(*modules):
    followed = {name_of(file) for module in modules for file in source_files(file_of(module))}
    return followed | set(modules)


def packages_imported_by(file):
    """Return the top-level packages a source file imports, wherever in it and however."""
    found = set()
    for node in ast.walk(ast.parse(Path(file).read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found.add(node.module if node.level == 0 else "branchcrush")
        elif (
            isinstance(node, ast.Call)
            and getattr(node.func, "id", getattr(node.func, "attr", None))
            in ("import_module", "__import__")
            and isinstance(node.args[0], ast.Constant)
        ):
            found.add(node.args[0].value)
    return {name.partition(".")[0] for name in found}


def importers_of(*packages):
    files = PACKAGE.rglob("*.py")
    return {name_of(file) for file in files if packages_imported_by(file) & set(packages)}


@pytest.fixture(scope="module")
def loaded():
    """What Python really loads with each module, in an interpreter of its own."""
    program = """
import importlib, json, sys

def ours():
    return [name for name in sys.modules if name.split(".")[0] == "branchcrush"]

found = {}
for module in json.loads(sys.argv[1]):
    for name in ours():
        del sys.modules[name]
    importlib.import_module("branchcrush." + module)
    found[module] = [
        name.partition(".")[2] for name in ours() if not hasattr(sys.modules[name], "__path__")
    ], [name for name in json.loads(sys.argv[2]) if name in sys.modules]
print(json.dumps(found))
"""
    # The pure ones first: what a module loads from outside stays loaded.
    modules = json.dumps(sorted(MODULES, key=lambda module: module not in PURE))
    outside = json.dumps(["lammps", "mpi4py", "snakemake", "matplotlib", "pyarrow", "pydantic"])
    arguments = [sys.executable, "-c", program, modules, outside]
    result = subprocess.run(arguments, capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


# --- direction -----------------------------------------------------------------------------------


@pytest.mark.parametrize("module", sorted(PURE))
def test_pure_module_imports_only_pure_modules(module):
    assert closure(module) <= PURE | {"errors"}


@pytest.mark.parametrize("module", sorted(PURE))
def test_pure_module_is_made_of_numbers_alone(module):
    outside = packages_imported_by(file_of(module)) - {"branchcrush"}
    assert outside - sys.stdlib_module_names <= {"numpy", "scipy", "pandas"}
    # Nor of files and processes.
    assert not outside & {"os", "pathlib", "io", "json", "subprocess", "shutil", "tempfile"}


@pytest.mark.parametrize("module", sorted(PURE))
def test_pure_module_loads_no_simulator_workflow_or_plots(module, loaded):
    _, outside = loaded[module]
    # pandas looks for pyarrow itself.
    assert set(outside) <= {"pyarrow"}


def test_only_one_module_loads_lammps():
    assert importers_of("lammps", "mpi4py") == {"lammps.library"}


def test_only_plotting_draws():
    drawing = importers_of("matplotlib")
    assert drawing
    assert {module.partition(".")[0] for module in drawing} == {"plotting"}


def test_package_does_not_know_the_workflow():
    assert importers_of("workflow", "snakemake") == set()


def test_no_two_modules_import_each_other():
    graph = {module: imported_modules(file_of(module)) for module in MODULES}
    assert set(TopologicalSorter(graph).static_order()) >= set(MODULES)


# --- what a job depends on -----------------------------------------------------------------------


def test_files_of_a_module_are_those_of_all_it_imports_in_turn():
    assert closure("samples.convergence") == {
        "samples.convergence",
        "samples.ensemble",
        "statistics.power_law",
        "statistics.intervals",
        "errors",
    }
    assert closure("packings.placement") == {
        "packings.placement",
        "packings.cell_grid",
        "packings.geometry",
        "errors",
    }
    assert source_files(file_of("errors")) == []


def test_files_are_named_once_in_order_and_exist():
    files = source_files(file_of("lammps.compression"))
    assert files == sorted(set(files))
    assert all(Path(file).is_file() for file in files)


def test_direct_imports_leave_out_what_those_import():
    assert imported_modules(file_of("branches.lengths")) == {
        "gradings.distribution",
        "packings.geometry",
    }
    assert imported_modules(file_of("loading.path")) == {
        "loading.measures",
        "loading.states",
        "packings.contact_laws",
        "packings.geometry",
    }


@every_module
def test_files_of_a_module_are_all_that_python_loads_for_it(module, loaded):
    modules, _ = loaded[module]
    late = closure(LATE[module]) if module in LATE else set()
    assert closure(module) == set(modules) | late


SCRIPTS = sorted(REPOSITORY.glob("workflow/scripts/*.py"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_watches_all_it_runs_but_the_way_a_job_reports(script):
    assert "jobs" in imported_modules(script)
    watched = {name_of(file) for file in source_files(script)}
    assert watched == closure(*imported_modules(script) - {"jobs"})


def test_every_module_is_used_by_the_workflow_or_a_command():
    sources = [REPOSITORY / "Snakefile", *REPOSITORY.glob("workflow/**/*.smk"), *SCRIPTS]
    makefile = (REPOSITORY / "Makefile").read_text(encoding="utf-8")
    used = set(re.findall(r"-m branchcrush\.([a-z_.]+)", makefile))
    for source in sources:
        text = source.read_text(encoding="utf-8")
        if source.suffix == ".py":
            used |= imported_modules(source)
        else:
            used |= set(re.findall(r"from branchcrush\.([a-z_.]+) import", text))
    assert closure(*used) == set(MODULES)
