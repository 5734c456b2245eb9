"""What a job depends on: the workflow watches what Python loads, and loads no more than it needs.

Which room may import which, and which packages from outside, is held by the contracts in
pyproject.toml. Here is what those cannot see.
"""

import ast
import hashlib
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import branchcrush
from branchcrush.source_files import imported_modules, source_digest, source_files

PACKAGE = Path(branchcrush.__file__).parent
REPOSITORY = Path(__file__).parents[2]
SCRIPTS = sorted(REPOSITORY.glob("workflow/scripts/*.py"))
ROOMS = sorted(file.parent.name for file in PACKAGE.glob("*/__init__.py"))
# Rooms that no drawing, no workflow and no check of a configuration may slow down.
PURE = ("branches", "crushing", "energy", "forces", "gradings", "loading", "packings", "samples")
PURE += ("statistics",)
# How a job reports, and what it notes of itself.
REPORTS = {"jobs", "records", "records_words", "claims", "checkpoints"}
REPORTS |= {"files.digests", "files.intact", "files.locks", "files.made"}
# Besides the pure ones, of what the jobs of the seeds load: many are started.
LEAN = ("config.build", "files.seeds", "lammps.compression")


def name_of(file):
    return ".".join(Path(file).relative_to(PACKAGE).with_suffix("").parts)


MODULES = sorted(name_of(file) for file in PACKAGE.rglob("*.py") if file.name != "__init__.py")


def file_of(module):
    return PACKAGE.joinpath(*module.split(".")).with_suffix(".py")


def watched(path):
    return {name_of(file) for file in source_files(path)}


def closure(modules):
    return set(modules).union(*(watched(file_of(module)) for module in modules))


# --- which files a module is made of -------------------------------------------------------------


@pytest.mark.parametrize(
    ("source", "modules"),
    [
        ("from branchcrush.errors import FitError, GradingError", {"errors"}),
        ("from branchcrush.files import tables, rows", {"files.tables", "files.rows"}),
        ("from branchcrush.files.tables import read_json as read", {"files.tables"}),
        ("from branchcrush import jobs", {"jobs"}),
        (
            "from branchcrush.files import (  # of results\n    tables as a,\n    rows,  # each\n)",
            {"files.tables", "files.rows"},
        ),
        ("from branchcrush.errors import FitError  # , jobs", {"errors"}),
        ("import branchcrush.files.tables, json", {"files.tables"}),
        ("def late():\n    from branchcrush.errors import FitError", {"errors"}),
        ("try:\n    pass\nexcept OSError:\n    import branchcrush.jobs", {"jobs"}),
        ("match 1:\n    case 1:\n        if True:\n            import branchcrush.jobs", {"jobs"}),
        # Modules of Python and others, some of the same names.
        ("import statistics\nfrom files import tables\nimport errors", set()),
        ("import branchcrush", set()),
        ("from branchcrush import __version__\n# from branchcrush import jobs", set()),
    ],
)
def test_direct_imports_are_the_modules_of_the_package(tmp_path, source, modules):
    # Each in a folder of its own: what a file imports is read once.
    (tmp_path / "script.py").write_text(source + "\n")
    assert imported_modules(tmp_path / "script.py") == modules


def test_files_are_those_of_all_imports_in_turn_but_the_way_a_job_reports(tmp_path):
    source = "from branchcrush.packings import placement\nfrom branchcrush import jobs, records\n"
    (tmp_path / "script.py").write_text(source)
    files = source_files(tmp_path / "script.py")
    assert [str(Path(file).relative_to(PACKAGE)) for file in files] == [
        "errors.py",
        "packings/cell_grid.py",
        "packings/geometry.py",
        "packings/placement.py",
    ]
    assert source_files(file_of("errors")) == []


def test_a_digest_is_that_of_the_names_and_contents_of_the_files(tmp_path):
    (tmp_path / "script.py").write_text("from branchcrush.errors import FitError\n")
    (tmp_path / "page.jinja").write_text("page")
    contents = {
        "script.py": tmp_path / "script.py",
        "errors.py": file_of("errors"),
        "page.jinja": tmp_path / "page.jinja",
    }
    lines = [
        f"{name} {hashlib.sha256(file.read_bytes()).hexdigest()}\n"
        for name, file in contents.items()
    ]
    expected = hashlib.sha256("".join(lines).encode()).hexdigest()
    assert source_digest(tmp_path / "script.py", [tmp_path / "page.jinja"]) == expected


# --- what Python loads ---------------------------------------------------------------------------

PROGRAM = """
import importlib, json, sys

def ours():
    return [name for name in sys.modules if name.split(".")[0] == "branchcrush"]

slow, groups = json.loads(sys.argv[1])
loaded = []
for modules in groups:
    for name in ours():
        del sys.modules[name]
    for module in modules:
        importlib.import_module("branchcrush." + module)
    own = [name.partition(".")[2] for name in ours() if not hasattr(sys.modules[name], "__path__")]
    loaded.append((own, [name for name in slow if name in sys.modules]))
print(json.dumps(loaded))
"""


@pytest.fixture(scope="module")
def loaded():
    """What Python loads: of the pure modules, of the lean ones, and of each script in turn."""
    pure = [module for module in MODULES if module.startswith(tuple(f"{room}." for room in PURE))]
    # What is loaded from outside stays loaded: the scripts, which draw, come last.
    scripts = [sorted(imported_modules(script) - REPORTS) for script in SCRIPTS]
    groups = [pure, pure + list(LEAN), *scripts]
    slow = ["lammps", "mpi4py", "snakemake", "matplotlib", "pydantic", "yaml"]
    arguments = [sys.executable, "-c", PROGRAM, json.dumps([slow, groups])]
    result = subprocess.run(arguments, capture_output=True, text=True, timeout=120)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def test_neither_the_science_nor_the_jobs_of_seeds_load_what_is_slow(loaded):
    assert [outside for _, outside in loaded[:2]] == [[], []]


def test_a_script_watches_all_that_python_loads_for_it_but_the_way_a_job_reports(loaded):
    for script, (modules, _) in zip(SCRIPTS, loaded[2:], strict=True):
        assert watched(script) == set(modules) - REPORTS - {"runs"}, script


# --- the house -----------------------------------------------------------------------------------


def test_every_script_is_a_job():
    assert [script for script in SCRIPTS if not REPORTS & imported_modules(script)] == []


def test_every_module_is_used_by_the_workflow_a_command_or_a_study():
    makefile = (REPOSITORY / "Makefile").read_text(encoding="utf-8")
    used = set(re.findall(r"-m branchcrush\.([a-z_.]+)", makefile))
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for place in project["scripts"].values():
        used.add(place.partition(":")[0].removeprefix("branchcrush."))
    used = used.union(*map(imported_modules, SCRIPTS))
    plugin = REPOSITORY.glob("src/snakemake_logger_plugin_branchcrush/*.py")
    used = used.union(*map(imported_modules, plugin))
    for source in [REPOSITORY / "Snakefile", *REPOSITORY.glob("workflow/**/*.smk")]:
        used |= set(re.findall(r"from branchcrush\.([a-z_.]+) import", source.read_text("utf-8")))
    # What a study makes of its results, by a target of the Makefile.
    used = used.union(*map(imported_modules, REPOSITORY.glob("studies/*/*.py")))
    # Loaded by their names: what reads results for users, and what draws them.
    for source in PACKAGE.rglob("*.py"):
        by_name = r'import_module\("branchcrush\.([a-z_.]+)"\)'
        used |= set(re.findall(by_name, source.read_text(encoding="utf-8")))
    assert closure(used) | REPORTS == set(MODULES)


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_begins_with_its_manual_and_imports_nothing(room):
    source = (PACKAGE / room / "__init__.py").read_text(encoding="utf-8")
    statements = ast.parse(source).body
    assert len(statements) == 1
    manual = ast.literal_eval(statements[0].value)
    assert isinstance(manual, str) and len(manual.splitlines()) > 3


def packages_named_in(file):
    """Return the packages that a file imports, also by `import_module` and `__import__`."""
    packages = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            packages |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            packages.add(node.module)
        elif isinstance(node, ast.Call) and node.args:
            called = getattr(node.func, "id", getattr(node.func, "attr", None))
            if called in ("import_module", "__import__") and isinstance(node.args[0], ast.Constant):
                packages.add(node.args[0].value)
    return {name.partition(".")[0] for name in packages}


def test_only_one_module_loads_lammps_and_its_mpi_by_whatever_way():
    loading = {
        module for module in MODULES if packages_named_in(file_of(module)) & {"lammps", "mpi4py"}
    }
    assert loading == {"lammps.library"}
