"""Names of samples: any that a folder can have, and that results have not already."""

from copy import deepcopy

import pytest

from branchcrush.config.schema import checked_config
from branchcrush.errors import ConfigError

UNIFORM = {"form": "uniform", "basis": "number", "size": "radius", "unit": "m"}
UNIFORM |= {"min": 1e-5, "max": 1e-3}
FRACTAL = {**UNIFORM, "form": "fractal", "alpha": 2.6}
LOADING = {"edge_reduction": 0.4}
SAMPLE = {"grading": UNIFORM, "grains": 100, "loading": LOADING, "seeds": 2}


def message_of(raw):
    with pytest.raises(ConfigError) as refused:
        checked_config(raw)
    return str(refused.value)


@pytest.mark.parametrize(
    "name", ["uniform", "fractal", "loading", "grading", "contact", "grains", "samples", "a.b"]
)
def test_sample_may_have_any_name_and_is_named_in_full(name):
    raw = {"samples": {name: {**deepcopy(SAMPLE), "loading": {**LOADING, "stats": 1}}}}
    expected = f"config: samples.{name}.loading.stats: unknown key; did you mean states?"
    assert message_of(raw) == expected
    raw = {"samples": {name: {**deepcopy(SAMPLE), "grains": 1}}}
    assert message_of(raw).startswith(f"config: samples.{name}.grains = 1: ")
    raw = {"samples": {name: {**deepcopy(SAMPLE), "grading": {**FRACTAL, "alpha": -1}}}}
    assert message_of(raw).startswith(f"config: samples.{name}.grading.alpha = -1: ")
    assert list(checked_config({"samples": {name: SAMPLE}}).samples) == [name]


@pytest.mark.parametrize(
    "name",
    ["two words", "../up", "-first", "", "a/b", "a{b}", "line\n", "ä"],
)
def test_sample_name_that_cannot_name_a_folder_is_refused(name):
    message = message_of({"samples": {name: SAMPLE}})
    assert f" = {name!r}: a name must " in message


def test_sample_name_that_is_no_text_or_too_long_is_refused():
    message = message_of({"samples": {2024: SAMPLE}})
    assert message == "config: samples.2024 = 2024: a name must be text: put it in quotes"
    assert "1 to 100 letters" in message_of({"samples": {"a" * 101: SAMPLE}})
    assert list(checked_config({"samples": {"a" * 100: SAMPLE}}).samples) == ["a" * 100]


def test_name_kept_for_the_convergence_study_is_refused():
    message = message_of({"samples": {"mine-refined": SAMPLE}})
    assert message.startswith("config: samples.mine-refined = 'mine-refined': ")
    assert "must not end in -refined" in message


@pytest.mark.parametrize(
    "name",
    [
        "figures",
        "findings",
        "comparison.csv",
        "config.json",
        "coordination.csv",
        "datapackage.json",
        "exponents.csv",
        "findings.csv",
        "report.html",
        "preview.txt",
    ],
)
def test_name_of_what_results_hold_for_all_samples_is_refused(name):
    message = message_of({"samples": {name: SAMPLE}})
    assert message.endswith(f": a name must not be {name}, which results has for all samples")
