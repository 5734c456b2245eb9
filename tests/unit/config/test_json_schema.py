"""The JSON schema of the configuration: what it accepts and refuses, and what is made from it."""

import re
from copy import deepcopy
from pathlib import Path

import jsonschema
import pytest
import yaml

from branchcrush.config.json_schema import json_schema, schema_text
from branchcrush.config.reference import with_tables
from branchcrush.config.schema import checked_config
from branchcrush.errors import ConfigError

REPOSITORY = Path(__file__).parents[3]
SHIPPED = sorted(
    path
    for pattern in ("config.yaml", "examples/*/config.yaml", "studies/*/config.yaml")
    for path in REPOSITORY.glob(pattern)
)
EDITOR_LINE = "# yaml-language-server: $schema="
CONFIG = {
    "samples": {
        "mine": {
            "grading": {
                "form": "fractal",
                "basis": "number",
                "size": "radius",
                "unit": "mm",
                "min": 0.1,
                "max": 1.0,
                "alpha": 2.6,
            },
            "grains": 100,
            "loading": {"edge_reduction": 0.4},
            "seeds": 2,
        }
    }
}
SINGLE = {"form": "single", "size": "radius", "unit": "mm", "value": 1}
PART = {"weight": 1, "grading": SINGLE}


@pytest.fixture(scope="module")
def schema():
    made = json_schema()
    jsonschema.Draft202012Validator.check_schema(made)
    return made


@pytest.fixture(scope="module")
def accepts(schema):
    return jsonschema.Draft202012Validator(schema).is_valid


def config_with(path, value):
    """Return a valid configuration but for one key, or without it where the value is None."""
    raw = deepcopy(CONFIG)
    *sections, last = path.split(".")
    here = raw
    for section in sections:
        here = here.setdefault(section, {})
    here[last] = value
    return raw


def sections(schema):
    """Return each section of the schema by name, that of the whole file among them."""
    return {"the file": schema, **schema["$defs"]}


# --- its words -----------------------------------------------------------------------------------


def described(schema, key):
    """Return the description of a key, or that of its section."""
    referred = schema["$defs"].get(key.get("$ref", "").rpartition("/")[2], {})
    return key.get("description") or referred.get("description", "")


def test_every_key_and_section_is_described_by_a_sentence(schema):
    bare = [name for name, section in sections(schema).items() if not section.get("description")]
    bare += [
        f"{name}.{key}"
        for name, section in sections(schema).items()
        for key, value in section["properties"].items()
        if not re.fullmatch(r"[A-Z].*\.", described(schema, value), re.DOTALL)
    ]
    assert not bare


def test_no_description_is_the_text_of_an_error(schema):
    texts = [
        described(schema, value)
        for section in sections(schema).values()
        for value in section["properties"].values()
    ]
    assert len(texts) > 50
    assert not [text for text in texts if re.match("must|give|missing", text, re.IGNORECASE)]


def test_every_number_with_a_point_has_its_unit_in_brackets(schema):
    numbers = {
        f"{name}.{key}": value["description"]
        for name, section in sections(schema).items()
        for key, value in section["properties"].items()
        if "'type': 'number'" in str(value)
    }
    assert len(numbers) > 20
    assert not [key for key, text in numbers.items() if not re.search(r"\[\S[^\]]*\]\.$", text)]


def test_defaults_and_units_are_those_of_a_study(schema):
    contact = schema["$defs"]["LinearContact"]["properties"]["normal_stiffness"]
    assert contact["default"] == 1e6
    assert contact["description"].endswith("[N/m].")
    assert schema["$defs"]["Sample"]["properties"]["initial_solid_fraction"]["default"] == 0.16
    assert schema["$defs"]["EnergySplit"]["properties"]["bins"]["default"] == 20


def test_its_example_is_a_study(schema, accepts):
    (example,) = schema["examples"]
    assert accepts(example)
    checked_config(example)


def test_it_says_of_which_kind_it_is(schema):
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert "branchcrush" in schema["title"]


# --- what it accepts -----------------------------------------------------------------------------


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.parent.name)
def test_a_shipped_configuration_is_valid_and_names_the_schema_in_its_first_line(path, accepts):
    first, text = path.read_text(encoding="utf-8").split("\n", 1)
    assert accepts(yaml.safe_load(text))
    assert first.startswith(EDITOR_LINE)
    named = path.parent / first.removeprefix(EDITOR_LINE)
    assert named.resolve() == REPOSITORY / "config.schema.json"


def test_all_shipped_configurations_are_looked_at():
    assert len(SHIPPED) >= 7


SIEVES = {"form": "sieve", "basis": "mass", "size": "diameter", "file": "a.csv"}
LIST = {"form": "radii", "basis": "number", "size": "radius", "unit": "mm", "file": "a.txt"}
ACCEPTED = [
    ("grains", "1e3"),
    ("grains", 1000.0),
    ("grains", " 2_000 "),
    ("initial_solid_fraction", "1.6e-1"),
    ("seeds", 16),
    ("seeds", "4"),
    ("seeds", [0, 5, "7"]),
    ("contact", {"law": "linear"}),
    ("contact", {"law": "linear", "normal_stiffness": "1e6"}),
    ("contact", {"law": "hertz", "young_modulus": "70e9", "poisson_ratio": 0}),
    ("loading", {"mean_stress": 1e6}),
    ("loading", {"mean_stress": "1e6"}),
    ("loading", {"mean_stress": [1e5, "1e6"], "states": None}),
    ("loading", {"mean_stress": {"from": "1e5", "to": 1e7, "states": 9}}),
    ("loading", {"edge_reduction": 0.4, "mean_stress": None, "states": 3, "unloading": True}),
    ("grading", SINGLE),
    ("grading", {"form": "mixture", "basis": "mass", "components": [PART, PART]}),
    ("grading.min", ".1"),
    ("grading", {**SIEVES, "unit": "um", "min": None}),
    ("grading", {**SIEVES, "openings": "phi", "columns": ["phi", 3], "sheet": 1}),
    ("grading", {**SIEVES, "unit": "inch", "columns": {"opening": 2, "value": "retained"}}),
    ("grading", LIST),
]


@pytest.mark.parametrize(("key", "value"), ACCEPTED)
def test_what_a_study_accepts_is_valid(key, value, accepts):
    raw = config_with(f"samples.mine.{key}", value)
    checked_config(raw)
    assert accepts(raw)


def test_a_list_of_grains_has_a_number_of_them(accepts):
    raw = config_with("samples.mine.grading", LIST)
    del raw["samples"]["mine"]["grains"]
    checked_config(raw)
    assert accepts(raw)


@pytest.mark.parametrize("name", ["a", "A-1_b.c", "a" * 100, "figures2", "refined"])
def test_names_of_samples_are_valid(name, accepts):
    raw = {"samples": {name: CONFIG["samples"]["mine"]}}
    checked_config(raw)
    assert accepts(raw)


# --- what it refuses -----------------------------------------------------------------------------

REFUSED = [
    ("samples", {}),
    ("samples", None),
    ("sample", {}),
    ("figures", None),
    ("figures.dpi", 20),
    ("figures.colour", "red"),
    ("energy_split.confidence", 1),
    ("samples.mine.grains", 1),
    ("samples.mine.grains", 2.5),
    ("samples.mine.grains", True),
    ("samples.mine.grains", "many"),
    ("samples.mine.grains", "1,000"),
    ("samples.mine.unloading", True),
    ("samples.mine.boundary", "wall"),
    ("samples.mine.allow_unrepresentative", 1),
    ("samples.mine.seeds", 0),
    ("samples.mine.seeds", []),
    ("samples.mine.seeds", [1, 1]),
    ("samples.mine.seeds", [-1]),
    ("samples.mine.contact", {}),
    ("samples.mine.contact", {"law": "hertz"}),
    ("samples.mine.contact", {"law": "linear", "poisson_ratio": 0.2}),
    ("samples.mine.loading", {}),
    ("samples.mine.loading", {"edge_reduction": 0.4, "solid_fraction": 0.7}),
    ("samples.mine.loading", {"mean_stress": 1e6, "states": 3}),
    ("samples.mine.loading", {"mean_stress": -1}),
    ("samples.mine.loading", {"mean_stress": []}),
    ("samples.mine.loading", {"mean_stress": {"from": 1, "to": 2}}),
    ("samples.mine.grading.form", "gaussian"),
    ("samples.mine.grading.unit", "km"),
    ("samples.mine.grading.basis", "mass"),
    ("samples.mine.grading.alpha", 7),
    ("samples.mine.grading.min", 0),
    ("samples.mine.grading.median", 1),
    ("samples.mine.grading", {"form": "mixture", "basis": "mass", "components": [PART]}),
    ("samples.mine.grading", {**LIST, "file": ""}),
    ("samples.mine.grading", SIEVES),
    ("samples.mine.grading", {**SIEVES, "unit": "mm", "columns": ["a"]}),
    ("samples.mine.grading", {**SIEVES, "unit": "mm", "columns": {"from": 1, "to": 2}}),
    ("samples.mine.grading", {**SIEVES, "unit": "mm", "sheet": 0}),
]


@pytest.mark.parametrize(("path", "value"), REFUSED)
def test_what_is_wrong_in_itself_is_refused_as_a_study_refuses_it(path, value, accepts):
    raw = config_with(path, value)
    with pytest.raises(ConfigError):
        checked_config(raw)
    assert not accepts(raw)


@pytest.mark.parametrize("key", ["grading", "grains", "loading", "seeds"])
def test_a_sample_without_a_key_that_has_no_default_is_refused(key, accepts):
    raw = deepcopy(CONFIG)
    del raw["samples"]["mine"][key]
    assert not accepts(raw)


@pytest.mark.parametrize("name", ["", "-a", "a b", "a/b", "a" * 101, "mine-refined", "figures"])
def test_names_that_results_cannot_have_are_refused(name, accepts):
    assert not accepts({"samples": {name: CONFIG["samples"]["mine"]}})


# --- what is made from it ------------------------------------------------------------------------

COMMAND = "run: make schema"


def test_the_file_is_in_step():
    written = (REPOSITORY / "config.schema.json").read_text(encoding="utf-8")
    assert written == schema_text(), COMMAND


def test_the_tables_of_the_documentation_are_in_step(schema):
    page = (REPOSITORY / "docs" / "configuration.md").read_text(encoding="utf-8")
    assert page == with_tables(page, schema), COMMAND


def test_a_table_says_what_a_key_is_its_unit_its_default_and_what_is_allowed():
    page = (REPOSITORY / "docs" / "configuration.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in page.splitlines()]
    table = {row[0]: row[1:] for row in rows if len(row) == 5}
    assert table["`figures.dpi`"][1:] == ["dots per inch", "300", "50 to 1200"]
    assert table["`samples.<name>.grains`"][1:] == ["", "", "2 to 10000000"]
    assert table["`samples.<name>.loading.edge_reduction`"][1:] == ["-", "", "between 0 and 1"]
    forms = {row[0]: row[1:] for row in rows if len(row) == 6}
    assert forms["`normal_stiffness`"][0] == "linear"
    assert forms["`normal_stiffness`"][2:] == ["N/m", "1e6", "1e-9 to 1e15"]


def test_a_page_without_a_place_for_a_table_is_refused(schema):
    with pytest.raises(ConfigError, match="no place for"):
        with_tables("# A page", schema)
