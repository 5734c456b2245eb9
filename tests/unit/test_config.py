"""The configuration: what is valid, what is filled in, and what a user reads when it is wrong."""

from copy import deepcopy
from pathlib import Path

import pytest
import yaml

from branchcrush.config import checked_config, refined
from branchcrush.errors import ConfigError

SHIPPED = Path(__file__).parents[2] / "config.yaml"
UNIFORM = {"form": "uniform", "radius_min": 1e-5, "radius_max": 1e-3}
FRACTAL = {**UNIFORM, "form": "fractal", "alpha": 2.6}
SAMPLE = {"grading": UNIFORM, "grains": 100, "seeds": 2}
# What a user never typed: the library's own words and addresses, and names of Python's classes.
INTERNALS = ["pydantic", "http", "grading.uniform", "grading.fractal", "[key]", "type=", "tag"]
INTERNALS += ["instance of", "extract fields", "Value error", "function-", "Config", "  "]

infinity, nan = float("inf"), float("nan")


def sample_of(**keys):
    return checked_config({"samples": {"mine": {**deepcopy(SAMPLE), **keys}}}).samples["mine"]


def config_with(path, value):
    """Return a valid configuration but for one key."""
    raw = {"samples": {"mine": deepcopy(SAMPLE)}}
    *sections, last = path.split(".")
    here = raw
    for section in sections:
        here = here.setdefault(section, {})
    here[last] = value
    return raw


def message_of(raw):
    with pytest.raises(ConfigError) as refused:
        checked_config(raw)
    message = str(refused.value)
    for words in INTERNALS:
        assert words not in message, message
    return message


# --- valid ---------------------------------------------------------------------------------------


def test_shipped_configuration_is_the_case_of_the_paper():
    sample = checked_config(yaml.safe_load(SHIPPED.read_text())).samples["paper"]
    assert sample.grading.form == "uniform"
    assert sample.grading.radius_max / sample.grading.radius_min == pytest.approx(200)
    assert (sample.grains, sample.boundary) == (1000, "walls")
    assert sample.loading.edge_reduction == 0.4
    assert sample.seeds == list(range(1, 17))


def test_every_key_of_the_shipped_configuration_agrees_with_its_default():
    # Keys are given there to be read: leaving one out must not change the study.
    raw = yaml.safe_load(SHIPPED.read_text())
    shipped = checked_config(raw)
    required = {key: raw["samples"]["paper"][key] for key in ("grading", "grains", "seeds")}
    assert checked_config({"samples": {"paper": required}}) == shipped


def test_three_keys_of_a_sample_are_enough():
    config = checked_config({"samples": {"mine": SAMPLE}})
    sample = config.samples["mine"]
    assert (sample.boundary, sample.initial_solid_fraction) == ("walls", 0.16)
    assert sample.contact.normal_stiffness == 1e6
    assert sample.loading.model_dump() == {
        "edge_reduction": 0.4,
        "approach_solid_fraction": 0.55,
        "steps": 60,
        "states": 15,
        "unbalanced_force_ratio": 1e-7,
    }
    assert config.energy_split.model_dump() == {"bins": 20, "confidence": 0.95, "resamples": 2000}
    assert config.thermodynamics.ultimate_alpha == 2.6
    assert config.thermodynamics.hardening_exponent == 2.0


def test_a_number_of_seeds_counts_from_1():
    assert sample_of(seeds=3).seeds == [1, 2, 3]
    assert sample_of(seeds=1).seeds == [1]


def test_a_list_of_seeds_is_kept_in_its_order():
    assert sample_of(seeds=[7, 0, 3]).seeds == [7, 0, 3]


def test_number_that_yaml_reads_as_text_is_converted():
    contact = yaml.safe_load("normal_stiffness: 1e6")
    assert contact == {"normal_stiffness": "1e6"}
    assert sample_of(contact=contact).contact.normal_stiffness == 1e6


def test_form_of_the_grading_decides_its_keys():
    assert sample_of(grading=FRACTAL).grading.model_dump() == FRACTAL
    assert sample_of(grading=UNIFORM).grading.model_dump() == UNIFORM


def test_settings_are_plain_values_that_are_valid_again():
    config = checked_config({"samples": {"mine": SAMPLE}})
    assert checked_config(config.model_dump()) == config


def test_raw_configuration_is_left_as_it_was():
    raw = {"samples": {"mine": deepcopy(SAMPLE)}}
    checked_config(raw)
    assert raw == {"samples": {"mine": SAMPLE}}


def test_refined_sample_differs_in_its_steps_only():
    sample = sample_of(loading={"steps": 30, "states": 10, "edge_reduction": 0.5})
    expected = sample.model_dump()
    expected["loading"]["steps"] = 60
    assert refined(sample).model_dump() == expected
    assert sample.loading.steps == 30


# --- refused -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("path", "value", "shown", "allowed"),
    [
        ("samples.mine.grading.form", "normal", "'normal'", "'fractal'"),
        ("samples.mine.grading.radius_min", -1.0, "-1", "greater than 0"),
        ("samples.mine.grading.radius_min", 0, "0", "greater than 0"),
        ("samples.mine.grading.radius_max", nan, "nan", "finite number"),
        ("samples.mine.grading.radius_max", infinity, "inf", "finite number"),
        ("samples.mine.grading.radius_max", "inf", "'inf'", "finite number"),
        ("samples.mine.grading.radius_max", "large", "'large'", "valid number"),
        ("samples.mine.grading.radius_max", None, "None", "valid number"),
        ("samples.mine.grading", "uniform", "'uniform'", ""),
        ("samples.mine.grading", None, "None", ""),
        ("samples.mine.grains", 1, "1", "greater than or equal to 2"),
        ("samples.mine.grains", 2.5, "2.5", "valid integer"),
        ("samples.mine.grains", nan, "nan", ""),
        ("samples.mine.boundary", "wall", "'wall'", "'walls' or 'periodic'"),
        ("samples.mine.initial_solid_fraction", 0.5, "0.5", "less than or equal to 0.4"),
        ("samples.mine.initial_solid_fraction", nan, "nan", "less than or equal to 0.4"),
        ("samples.mine.contact.normal_stiffness", 0.0, "0", "greater than 0"),
        ("samples.mine.contact.normal_stiffness", nan, "nan", "finite number"),
        ("samples.mine.contact.normal_stiffness", infinity, "inf", "finite number"),
        ("samples.mine.contact", 1e6, "1e+06", ""),
        ("samples.mine.loading.edge_reduction", 1, "1", "less than 1"),
        ("samples.mine.loading.edge_reduction", nan, "nan", "less than 1"),
        ("samples.mine.loading.steps", 0, "0", "greater than or equal to 1"),
        ("samples.mine.loading.unbalanced_force_ratio", 1e-3, "0.001", "less than or equal to"),
        ("samples.mine.loading.unbalanced_force_ratio", nan, "nan", "less than or equal to"),
        ("samples.mine.loading", None, "None", ""),
        ("samples.mine.loading", [1], "[1]", ""),
        ("samples.mine.seeds", 0, "0", "at least 1"),
        ("samples.mine.seeds", True, "True", "list"),
        ("samples.mine.seeds", "all", "'all'", "list"),
        ("samples.mine.seeds", [], "[]", "at least 1"),
        ("samples.mine.seeds", [1, 1], "[1, 1]", "once"),
        ("samples.mine", None, "None", ""),
        ("samples", None, "None", ""),
        ("samples", [1], "[1]", ""),
        ("energy_split.bins", 2, "2", "greater than or equal to 3"),
        ("energy_split.confidence", 95, "95", "less than 1"),
        ("energy_split.resamples", "many", "'many'", "valid integer"),
        ("energy_split", None, "None", ""),
        ("thermodynamics.ultimate_alpha", 3, "3", "less than 3"),
        ("thermodynamics.critical_energy", infinity, "inf", "finite number"),
        ("figures.dpi", 5, "5", "greater than or equal to 50"),
    ],
)
def test_message_names_the_key_its_value_and_what_is_allowed(path, value, shown, allowed):
    message = message_of(config_with(path, value))
    assert message.startswith(f"config: {path} = {shown}: ")
    reason = message.removeprefix(f"config: {path} = {shown}: ")
    assert reason
    assert allowed in reason
    assert "\n" not in message


def test_seed_of_a_list_is_named_by_its_place():
    message = message_of(config_with("samples.mine.seeds", [1, -2]))
    assert message.startswith("config: samples.mine.seeds.1 = -2: ")
    assert "greater than or equal to 0" in message


@pytest.mark.parametrize(
    ("path", "missing"),
    [
        ("samples.mine.grading", "radius_max"),
        ("samples.mine.grading", "form"),
        ("samples.mine", "grains"),
        ("samples.mine", "grading"),
        ("samples.mine", "seeds"),
    ],
)
def test_missing_key_is_named(path, missing):
    raw = {"samples": {"mine": deepcopy(SAMPLE)}}
    here = raw
    for section in path.split("."):
        here = here[section]
    del here[missing]
    assert message_of(raw).startswith(f"config: {path}.{missing}: missing")


def test_fractal_grading_without_its_dimension_is_refused():
    raw = config_with("samples.mine.grading.form", "fractal")
    assert message_of(raw) == "config: samples.mine.grading.alpha: missing; give it a value"


def test_configuration_without_samples_is_refused():
    assert message_of({}) == "config: samples: missing; give it a value"
    assert message_of({"samples": {}}).startswith("config: samples")


@pytest.mark.parametrize(
    ("path", "near"),
    [
        ("samples.mine.grians", "grains"),
        ("samples.mine.laoding", "loading"),
        ("samples.mine.grading.radius_mx", "radius_max"),
        ("samples.mine.loading.stpes", "steps"),
        ("samples.mine.contact.normal_stifness", "normal_stiffness"),
        ("enrgy_split", "energy_split"),
        ("energy_split.bin", "bins"),
        ("thermodynamics.ultimate_alfa", "ultimate_alpha"),
        ("figures.dpis", "dpi"),
    ],
)
def test_misspelt_key_is_answered_with_the_nearest_one(path, near):
    assert message_of(config_with(path, 1)) == f"config: {path}: unknown key; did you mean {near}?"


def test_misspelt_key_of_a_fractal_grading_may_be_one_that_only_it_has():
    raw = config_with("samples.mine.grading", {**FRACTAL, "alhpa": 2.5})
    expected = "config: samples.mine.grading.alhpa: unknown key; did you mean alpha?"
    assert message_of(raw) == expected
    # A uniform grading has no such key, so there is nothing near.
    message = message_of(config_with("samples.mine.grading", {**UNIFORM, "alhpa": 2.5}))
    assert message.endswith("unknown key; allowed: form, radius_min, radius_max")


def test_unknown_key_with_no_near_one_is_answered_with_all_that_are_allowed():
    message = message_of(config_with("samples.mine.contact.viscosity", 1))
    assert message.endswith(
        "samples.mine.contact.viscosity: unknown key; allowed: normal_stiffness"
    )
    message = message_of({"samples": {"mine": SAMPLE}, "plots": {}})
    assert message.endswith("allowed: samples, energy_split, thermodynamics, figures")


@pytest.mark.parametrize(
    "name", ["uniform", "fractal", "loading", "grading", "contact", "grains", "samples", "a.b"]
)
def test_sample_may_have_any_name_and_is_named_in_full(name):
    raw = {"samples": {name: {**deepcopy(SAMPLE), "loading": {"stpes": 1}}}}
    expected = f"config: samples.{name}.loading.stpes: unknown key; did you mean steps?"
    assert message_of(raw) == expected
    raw = {"samples": {name: {**deepcopy(SAMPLE), "grains": 1}}}
    assert message_of(raw).startswith(f"config: samples.{name}.grains = 1: ")
    raw = {"samples": {name: {**deepcopy(SAMPLE), "grading": {**FRACTAL, "alpha": -1}}}}
    assert message_of(raw).startswith(f"config: samples.{name}.grading.alpha = -1: ")
    assert list(checked_config({"samples": {name: SAMPLE}}).samples) == [name]


@pytest.mark.parametrize("name", ["two words", "../up", "-first", "", "a/b", "a{b}", "line\n"])
def test_sample_name_that_cannot_name_a_folder_is_refused(name):
    assert repr(name) in message_of({"samples": {name: SAMPLE}})


def test_name_kept_for_the_convergence_study_is_refused():
    message = message_of({"samples": {"mine-refined": SAMPLE}})
    assert message.startswith("config: samples.mine-refined = 'mine-refined': ")
    assert "must not end in -refined" in message


def test_radii_out_of_order_are_refused_with_both():
    grading = {**UNIFORM, "radius_min": 2e-3}
    message = message_of(config_with("samples.mine.grading", grading))
    expected = "radius_min 0.002 m must be below radius_max 0.001 m"
    assert message == f"config: samples.mine.grading: {expected}"
    grading = {**FRACTAL, "radius_min": 1e-3}
    assert "must be below" in message_of(config_with("samples.mine.grading", grading))


def test_steps_that_are_no_multiple_of_the_states_are_refused_with_both():
    message = message_of(config_with("samples.mine.loading", {"steps": 30, "states": 20}))
    assert message.startswith("config: samples.mine.loading: steps 30")
    assert "multiple of states 20" in message


def test_path_that_ends_looser_than_where_its_steps_begin_is_refused():
    message = message_of(config_with("samples.mine.initial_solid_fraction", 0.1))
    assert message.startswith("config: samples.mine: loading.approach_solid_fraction 0.55 must")
    # 0.1 / 0.6^3
    assert "initial_solid_fraction 0.1 and the final 0.463" in message
    raw = config_with("samples.mine.loading", {"approach_solid_fraction": 0.16})
    assert "must lie between initial_solid_fraction 0.16" in message_of(raw)


def test_every_problem_has_a_line_of_its_own():
    raw = config_with("samples.mine.grains", 1)
    raw["figures"] = {"dpi": 1}
    raw["samples"]["other"] = {**deepcopy(SAMPLE), "grians": 100}
    lines = message_of(raw).splitlines()
    assert [line.split(":")[1].split("=")[0].strip() for line in lines] == [
        "samples.mine.grains",
        "samples.other.grians",
        "figures.dpi",
    ]


@pytest.mark.parametrize("raw", [None, [], [1], "samples", 3])
def test_file_that_holds_no_keys_is_refused(raw):
    assert message_of(raw).startswith("config: ")
