"""The configuration: what is valid, what is filled in, and where it is documented."""

import re
from copy import deepcopy
from pathlib import Path

import pytest
import yaml

from branchcrush.config.schema import Config, checked_config

SHIPPED = Path(__file__).parents[3] / "config.yaml"
UNIFORM = {"form": "uniform", "basis": "number", "size": "radius", "unit": "m"}
UNIFORM |= {"min": 1e-5, "max": 1e-3}
FRACTAL = {**UNIFORM, "form": "fractal", "alpha": 2.6}
LOADING = {"edge_reduction": 0.4}
HERTZ = {"law": "hertz", "young_modulus": 7e10, "poisson_ratio": 0.2}
SAMPLE = {"grading": UNIFORM, "grains": 100, "loading": LOADING, "seeds": 2}


def sample_of(**keys):
    return checked_config({"samples": {"mine": {**deepcopy(SAMPLE), **keys}}}).samples["mine"]


# --- valid ---------------------------------------------------------------------------------------


def test_shipped_configuration_is_the_case_of_the_paper():
    sample = checked_config(yaml.safe_load(SHIPPED.read_text())).samples["paper"]
    assert (sample.grading.form, sample.grading.basis) == ("uniform", "number")
    assert sample.grading.max / sample.grading.min == pytest.approx(200)
    assert (sample.grains, sample.boundary) == (1000, "walls")
    assert sample.loading.target == ("edge_reduction", 0.4)
    assert sample.seeds == list(range(1, 17))


def test_every_key_of_the_shipped_configuration_agrees_with_its_default():
    # Keys are given there to be read: leaving one out must not change the study.
    raw = yaml.safe_load(SHIPPED.read_text())
    shipped = checked_config(raw)
    required = {key: raw["samples"]["paper"][key] for key in ("grading", "grains", "seeds")}
    required["loading"] = {"edge_reduction": 0.4}
    short = checked_config({"samples": {"paper": required}})
    # A number of states that is not given is another for stresses, and so no default of the key.
    assert short.samples["paper"].settings() == shipped.samples["paper"].settings()
    assert short.model_dump(exclude={"samples"}) == shipped.model_dump(exclude={"samples"})


def test_four_keys_of_a_sample_are_enough():
    config = checked_config({"samples": {"mine": SAMPLE}})
    sample = config.samples["mine"]
    assert (sample.boundary, sample.initial_solid_fraction) == ("walls", 0.16)
    assert (sample.sampling, sample.allow_unrepresentative) == ("random", False)
    assert sample.contact.model_dump() == {"law": "linear", "normal_stiffness": 1e6}
    assert sample.loading.plain() == {
        "target": "edge_reduction",
        "value": 0.4,
        "states": 15,
        "approach_solid_fraction": 0.55,
        "unloading": False,
    }
    assert sample.loading.quality == "standard"
    assert sample.ranks == 1
    assert config.energy_split.model_dump() == {"bins": 20, "confidence": 0.95, "resamples": 2000}
    assert config.thermodynamics.ultimate_alpha == 2.6
    assert config.thermodynamics.hardening_exponent == 2.0


def test_a_number_of_seeds_counts_from_1():
    assert sample_of(seeds=3).seeds == [1, 2, 3]
    assert sample_of(seeds=1).seeds == [1]


def test_a_list_of_seeds_is_kept_in_its_order():
    assert sample_of(seeds=[7, 0, 3]).seeds == [7, 0, 3]


def test_number_that_yaml_reads_as_text_is_converted():
    typed = "{law: linear, normal_stiffness: 1e6}"
    assert yaml.safe_load(typed)["normal_stiffness"] == "1e6"
    assert sample_of(contact=yaml.safe_load(typed)).contact.normal_stiffness == 1e6
    assert sample_of(grains="1e3").grains == 1000
    assert sample_of(seeds=["1e1", "2"]).seeds == [10, 2]
    assert sample_of(loading={"mean_stress": "1e5"}).loading.mean_stress == [1e5]


@pytest.mark.parametrize(
    ("loading", "target"),
    [
        ({"edge_reduction": 0.4}, ("edge_reduction", 0.4)),
        ({"volume_reduction": 0.78}, ("volume_reduction", 0.78)),
        ({"solid_fraction": 0.7}, ("solid_fraction", 0.7)),
        ({"mean_stress": 1e5}, ("mean_stress", [1e5])),
        ({"mean_stress": {"from": 1, "to": 100, "states": 3}}, ("mean_stress", [1, 10, 100])),
    ],
)
def test_every_target_is_one_of_its_own(loading, target):
    assert sample_of(loading=loading).loading.target == target


def test_law_of_the_contact_decides_its_keys():
    assert sample_of(contact=HERTZ).contact.model_dump() == HERTZ


def test_form_of_the_grading_decides_its_keys():
    assert sample_of(grading=FRACTAL).grading.model_dump() == FRACTAL
    assert sample_of(grading=UNIFORM).grading.model_dump() == UNIFORM


def test_what_is_given_is_plain_values_that_are_valid_again():
    config = checked_config({"samples": {"mine": SAMPLE}})
    assert checked_config(config.model_dump(exclude_unset=True)) == config


def test_raw_configuration_is_left_as_it_was():
    raw = {"samples": {"mine": deepcopy(SAMPLE)}}
    checked_config(raw)
    assert raw == {"samples": {"mine": SAMPLE}}


def test_refined_sample_differs_in_its_strain_steps_and_seeds_only():
    sample = sample_of(seeds=[5, 3, 9], refined_seeds=2)
    expected = sample.settings()
    expected |= {"strain_step": expected["strain_step"] / 2, "seeds": [5, 3]}
    assert sample.settings(refinement=2) == expected


@pytest.mark.parametrize(("seeds", "refined"), [(16, 4), (4, 4), (2, 2), ([7, 3, 5], 3)])
def test_four_seeds_are_refined_or_all_where_there_are_fewer(seeds, refined):
    sample = sample_of(seeds=seeds)
    assert sample.refined_seeds == sample.settings()["refined_seeds"] == refined
    assert sample.settings(refinement=2)["seeds"] == sample.seeds[:refined]


@pytest.mark.parametrize(("seeds", "refined"), [(2, 0), (2, 2), ([7, 3, 5], 3)])
def test_as_many_seeds_as_there_are_may_be_refined(seeds, refined):
    assert sample_of(seeds=seeds, refined_seeds=refined).refined_seeds == refined


@pytest.mark.parametrize(
    ("quality", "step", "tolerance"),
    [("draft", 6.8e-3, 1e-6), ("standard", 1.7e-3, 1e-6), ("fine", 4.25e-4, 1e-7)],
)
def test_quality_sets_the_strain_step_and_the_tolerance(quality, step, tolerance):
    settings = sample_of(loading={**LOADING, "quality": quality}).settings()
    asked = settings["quality"], settings["strain_step"], settings["state_tolerance"]
    assert asked == (quality, step, tolerance)


# --- documented ----------------------------------------------------------------------------------


def keys_and_words(model):
    """Return the keys of a section and of all below it, and the words that they may hold."""
    keys, words = set(model.model_fields), set()
    below = [field.annotation for field in model.model_fields.values()]
    while below:
        kind = below.pop()
        if isinstance(kind, str):
            words.add(kind)
        elif hasattr(kind, "model_fields"):
            more_keys, more_words = keys_and_words(kind)
            keys, words = keys | more_keys, words | more_words
        below += getattr(kind, "__args__", ())
    return keys, words


def test_every_key_and_every_word_that_one_may_hold_is_documented():
    page = (SHIPPED.parent / "docs" / "configuration.md").read_text(encoding="utf-8")
    keys, words = keys_and_words(Config)
    assert {"alpha", "poisson_ratio", "weight", "mean_stress", "dpi"} <= keys
    assert {"weibull", "mixture", "um", "diameter", "hertz", "fine", "mass_quantiles"} <= words
    code = " ".join(re.findall(r"`([^`]+)`", re.sub(r"```\w*", "`", page)))
    named = set(re.findall(r"\w+|-", code))
    assert not (keys | words) - named
