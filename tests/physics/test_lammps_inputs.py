"""lammps_inputs/README.md says what the script does, and the dumps open where it says they open."""

import itertools
import re
import shlex
import shutil
import subprocess

import pandas as pd
import pytest

from branchcrush.files.tables import write_packing
from branchcrush.lammps.run import declared_variables


@pytest.fixture(scope="module")
def readme(lammps_inputs):
    return (lammps_inputs / "README.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def output(lammps_inputs, lmp, tmp_path_factory):
    """Return the folder of the shortest possible run of the default packing."""
    folder = shutil.copytree(lammps_inputs, tmp_path_factory.mktemp("output") / "inputs")
    command = [lmp, "-in", "in.compress", "-var", "targets", "5.6e-3"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=120)
    return folder


def columns_told(readme, file):
    """Return the names in the first column of the table that follows the name of a file."""
    table = readme.split(f"\n`{file}`, a ")[1].split("\n\n")[1]
    return [
        name for row in table.splitlines() for name in re.findall(r"`(\w+)`", row.split("|")[1])
    ]


def test_every_variable_is_in_the_table_with_its_default(readme, lammps_inputs):
    script = (lammps_inputs / "in.compress").read_text()
    defaults = dict(re.findall(r"^variable (\w+) +index (.+)$", script, re.MULTILINE))
    rows = re.findall(r"^\| `(\w+)` \| `([^`]+)` \| (\S*) ?\| (.+) \|$", readme, re.MULTILINE)
    assert [(name, default) for name, default, _, _ in rows] == list(defaults.items())
    assert set(defaults) == set(declared_variables(lammps_inputs / "in.compress"))


def test_every_variable_of_the_table_is_used(lammps_inputs):
    files = [path.read_text() for path in lammps_inputs.glob("*") if path.suffix != ".md"]
    script = re.sub(r"^variable \w+ +index .*$", "", "\n".join(files), flags=re.MULTILINE)
    for name in declared_variables(lammps_inputs / "in.compress"):
        assert re.search(rf"\$\{{{name}\}}|v_{name}\b", script), f"{name} is declared, never used"


def test_every_file_is_included_and_every_included_file_is_there(lammps_inputs):
    files = {path.name for path in lammps_inputs.glob("mod.*")}
    scripts = [lammps_inputs / name for name in (*files, "in.compress")]
    text = "\n".join(path.read_text() for path in scripts)
    included = set(re.findall(r"\$\{inputs\}/(mod\.\w+)", text))
    chosen = {"mod.walls", "mod.periodic", "mod.linear", "mod.hertz", "mod.edge", "mod.stress"}
    assert files == included | chosen
    for variable in ("boundary", "law", "control"):
        assert f"mod.${{{variable}}}" in text


@pytest.mark.parametrize("table", ["states.csv", "steps.csv"])
def test_every_column_of_a_table_is_told(readme, output, table):
    assert columns_told(readme, table) == list(pd.read_csv(output / table).columns)


def test_the_commands_of_the_readme_run(readme, lammps_inputs, lmp, tmp_path):
    folder = shutil.copytree(lammps_inputs, tmp_path / "inputs")
    commands = re.findall(r"^lmp (-in in\.compress.*?)(?: #.*)?$", readme, re.MULTILINE)
    assert len(commands) == 4
    for command in commands:
        finished = subprocess.run(
            [lmp, *command.split()], cwd=folder, capture_output=True, text=True, timeout=120
        )
        assert finished.returncode == 0, finished.stdout[-2000:]


def test_the_lines_for_a_packing_of_the_workflow_print_the_variables_of_its_run(
    readme, lammps_inputs, random_grains, tmp_path, monkeypatch, capsys
):
    positions, radii, edge = random_grains(10, 1, periodic=False)
    write_packing(tmp_path / "results/paper/seed_1/packing.npz", positions, radii, edge, {})
    monkeypatch.chdir(tmp_path)
    exec(re.search(r"^```python\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)[1], {})
    printed = shlex.split(capsys.readouterr().out.partition("-var ")[2])
    given = {}
    for _, words in itertools.groupby(printed, "-var".__eq__):
        name, *values = words
        given |= {name: values} if values else {}
    assert set(given) <= set(declared_variables(lammps_inputs / "in.compress"))
    assert given["control"] == ["edge"]
    assert len(given["targets"]) == 15
    assert float(given["targets"][-1]) == pytest.approx(0.6 * edge, rel=1e-14)


@pytest.mark.parametrize("dump", ["particles.dump", "pairs.dump"])
def test_every_column_of_a_dump_is_told(readme, output, frames, dump):
    assert columns_told(readme, dump) == list(frames(output / dump)[-1].columns)


def test_ovito_takes_the_pairs_for_bonds(output):
    # By the label: under any but these two it makes no bonds of them.
    text = (output / "pairs.dump").read_text()
    assert re.search(r"^ITEM: NUMBER OF (BONDS|ENTRIES)$", text, re.MULTILINE)
