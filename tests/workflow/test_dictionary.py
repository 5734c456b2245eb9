"""The dictionary of result files against the files of real runs."""

import gzip
import json
import re

import numpy as np
import pyarrow.parquet as parquet
import pytest

from branchcrush.command.main import main
from branchcrush.files.dictionary import result_files
from branchcrush.files.made import is_record
from branchcrush.files.tables import read_json
from tests.pages import lost_links

WHERE = "src/branchcrush/files/meanings"


def keys(value, name=""):
    """Yield the keys of JSON as the dictionary writes them: `a.b`, and `a[].b` in a list."""
    if isinstance(value, dict) and value:
        for key, inner in value.items():
            yield from keys(inner, f"{name}.{key}" if name else key)
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for inner in value:
            yield from keys(inner, f"{name}[]")
    else:
        yield name


def columns(path):
    """Return the columns or keys of a file, in its order; None where it has none of its own."""
    if path.suffix == ".csv":
        return path.read_text(encoding="utf-8").splitlines()[1].split(",")
    if path.suffix == ".parquet":
        return parquet.read_schema(path).names
    if path.suffix == ".json":
        content = read_json(path)
        if content.pop("provenance", None) is None:  # a record, which is all provenance
            return list(content)
        return list(dict.fromkeys(keys(content)))
    if path.suffix == ".npz":
        with np.load(path) as arrays:
            return list(arrays)
    if path.name.endswith(".dump.gz"):
        with gzip.open(path, "rt") as lines:
            head = next(line for line in lines if line.startswith(("ITEM: ATOMS", "ITEM: BONDS")))
        return head.split()[2:]
    return None


def files_of(results):
    return sorted(path for path in results.rglob("*") if path.is_file())


@pytest.fixture(scope="session")
def results(finished):
    return finished.folder / "results"


# Few sizes, so that it is quick: what a laboratory measured needs no packing.
MEASURED = """
measured:
  quick:
    before: {form: single, size: diameter, unit: mm, value: 1}
    after:
      form: mixture
      basis: mass
      components:
        - {weight: 3, grading: {form: single, size: diameter, unit: mm, value: 1}}
        - {weight: 1, grading: {form: single, size: diameter, unit: mm, value: 0.4}}
    ultimate_smallest: {size: diameter, unit: mm, value: 0.2}
    compression:
      file: curve.csv
      stress_unit: MPa
      values: void_ratio
      initial_void_ratio: 0.6
      lateral_stress_ratio: 0.5
      contact: {law: linear, normal_stiffness: 1.0e7}
"""
CURVE = "stress [MPa];e\n1;0,59\n2;0,58\n4;0,57\n8;0,48\n16;0,40\n12;0,41\n32;0,36\n"


@pytest.fixture(scope="session")
def measured_results(new_project, tmp_path_factory):
    study = new_project(tmp_path_factory.mktemp("measured"))
    study.configure(study.tiny + MEASURED)
    (study.folder / "curve.csv").write_text(CURVE)
    run = study.snakemake("results/measured.html")
    assert run.returncode == 0, run.stdout + run.stderr
    assert not (study.folder / "results/tiny").exists()
    return study.folder / "results"


@pytest.fixture(scope="session")
def breaking_results(breaking):
    return breaking.folder / "results"


@pytest.fixture(params=["results", "measured_results", "breaking_results"])
def any_results(request):
    return request.getfixturevalue(request.param)


def test_a_page_of_measured_materials_needs_no_packing_and_shows_them(measured_results):
    page = (measured_results / "measured.html").read_text(encoding="utf-8")
    assert "quick" in page and page.count("data:image/png") == 2
    assert "1 row of unloading or reloading left out of the fit (line 7)" in page
    # Of this study the page of materials alone was asked for.
    assert set(lost_links(measured_results / "measured.html")) <= {"report.html"}


def test_every_file_is_in_the_dictionary(any_results):
    """What is new needs an entry of its own in the stage that it is of."""
    results = any_results
    for path in files_of(results):
        name = path.relative_to(results).as_posix()
        known = [file.path for file in result_files() if file.matches(name)]
        assert len(known) == 1, (
            f"{name}: give it an entry [[files]] in {WHERE}, with path, rule, what it holds and "
            "its columns, then run make schema"
        )


def test_verify_finds_every_file_as_its_job_left_it(any_results, capsys):
    assert main(["verify", str(any_results)]) == 0
    told = re.search(r": (\d+) files are what \d+ jobs left", capsys.readouterr().out)
    files = [path for path in files_of(any_results) if not is_record(path.as_posix())]
    assert int(told[1]) == len(files)


def test_every_column_is_in_the_dictionary_and_none_too_many(any_results):
    results = any_results
    for path in files_of(results):
        name = path.relative_to(results).as_posix()
        file = next(file for file in result_files() if file.matches(name))
        there = columns(path)
        if there is None or name == "datapackage.json":
            continue
        told = [column.name for column in file.columns()]
        new = [column for column in there if column not in told]
        assert not new, (
            f"{name} has {new}: add a line for each in {WHERE} under {file.path}, "
            'name = ["type", "unit", "meaning"], then run make schema'
        )
        # A key that holds others is there when one of them is.
        holders = {one[: at.start()] for one in there for at in re.finditer(r"\.|\[", one)}
        missing = set(told) - set(there) - holders - file.rare
        assert not missing, (
            f"{name} lacks {sorted(missing)}: take them out of {WHERE} under {file.path}, or name "
            "them there as rare, if only some runs have them"
        )
        is_exact = path.suffix in (".csv", ".parquet") and not (file.rare or file.partial)
        assert not is_exact or there == told, f"{name}: the dictionary has another order"


def test_numbers_are_of_the_type_that_the_dictionary_tells(any_results):
    results = any_results
    kinds = {"number": (int, float), "integer": int, "string": str, "boolean": bool}
    for path in results.rglob("*.json"):
        name = path.relative_to(results).as_posix()
        if name == "datapackage.json":
            continue
        file = next(file for file in result_files() if file.matches(name))
        top = read_json(path)
        for column in file.columns():
            value = top.get(column.name)
            if column.type in kinds and value is not None:
                assert isinstance(value, kinds[column.type]), (name, column.name, value)


def test_the_data_package_names_every_file_but_itself_and_what_may_be_deleted(results):
    package = json.loads((results / "datapackage.json").read_text(encoding="utf-8"))
    named = {resource["path"] for resource in package["resources"]}
    there = {path.relative_to(results).as_posix() for path in files_of(results)}
    made_when_asked = {"datapackage.json", "preview.txt", "figures/tiny/preview.png"}
    made_when_asked.add("figures/tiny/preview.svg")
    records = {name for name in there if re.search(r"(^|/)made(/\w+)?\.json$", name)}
    assert len(records) > 10
    dumps = {name for name in there if name.endswith(".dump.gz")}
    assert named == there - made_when_asked - records - dumps
    assert package["provenance"]["samples"]["tiny"]["grains"] == 60
