"""The configuration: what a user reads when it is wrong."""

from copy import deepcopy

import pytest

from branchcrush.config.schema import checked_config
from branchcrush.errors import ConfigError

UNIFORM = {"form": "uniform", "basis": "number", "size": "radius", "unit": "m"}
UNIFORM |= {"min": 1e-5, "max": 1e-3}
FRACTAL = {**UNIFORM, "form": "fractal", "alpha": 2.6}
LOADING = {"edge_reduction": 0.4}
SAMPLE = {"grading": UNIFORM, "grains": 100, "loading": LOADING, "seeds": 2}
# What a user never typed: the library's own words and addresses, and names of Python's classes.
INTERNALS = ["pydantic", "http", "grading.uniform", "grading.fractal", "[key]", "type=", "tag"]
INTERNALS += ["instance of", "extract fields", "Value error", "function-", "Config", "  "]
INTERNALS += ["contact.linear", "contact.hertz", "Input should", "None", "True", "datetime"]
infinity, nan = float("inf"), float("nan")


def config_with(path, value):
    """Return a valid configuration but for one key."""
    raw = {"samples": {"mine": deepcopy(SAMPLE)}}
    *sections, last = path.split(".")
    here = raw
    for section in sections:
        here = here.setdefault(section, {"law": "linear"} if section == "contact" else {})
    here[last] = value
    return raw


def message_of(raw):
    with pytest.raises(ConfigError) as refused:
        checked_config(raw)
    message = str(refused.value)
    assert not [words for words in INTERNALS if words in message], message
    return message


@pytest.mark.parametrize(
    ("path", "value", "shown", "allowed"),
    [
        ("samples.mine.grading.form", "gaussian", "'gaussian'", "'fractal'"),
        ("samples.mine.grading.unit", "ft", "'ft'", "must be 'm', 'cm', 'mm', 'um' or 'inch'"),
        ("samples.mine.grading.min", -1.0, "-1 m", "a number above 0 m"),
        ("samples.mine.grading.min", 0, "0 m", "a number above 0 m"),
        ("samples.mine.grading.max", nan, "nan", "a number above 0 m"),
        ("samples.mine.grading.max", infinity, "inf", "a number above 0 m"),
        ("samples.mine.grading.max", "inf", "'inf'", "a number above 0 m"),
        ("samples.mine.grading.max", "large", "'large'", "a number above 0 m"),
        ("samples.mine.grading.max", None, "nothing", "a number above 0 m"),
        ("samples.mine.grading.max", True, "true", "a number above 0 m"),
        ("samples.mine.grading.max", 10**400, "1" + 96 * "0" + "...", "a number above 0 m"),
        ("samples.mine.grading.max", 2e3, "2000 m", "from 1e-09 m to 1000 m"),
        ("samples.mine.grading", "uniform", "'uniform'", "a section"),
        ("samples.mine.grading", None, "nothing", "a section"),
        ("samples.mine.sampling", "all", "'all'", "'mass_quantiles'"),
        ("samples.mine.grains", 1, "1", "a whole number from 2 to"),
        ("samples.mine.grains", 2.5, "2.5", "a whole number"),
        ("samples.mine.grains", nan, "nan", "a whole number"),
        ("samples.mine.grains", True, "true", "a whole number"),
        ("samples.mine.grains", {"a": [None]}, "{a: [nothing]}", "a whole number"),
        ("samples.mine.allow_unrepresentative", 1, "1", "true or false"),
        ("samples.mine.boundary", "wall", "'wall'", "'walls' or 'periodic'"),
        ("samples.mine.initial_solid_fraction", 0.5, "0.5", "above 0 and at most 0.4"),
        ("samples.mine.initial_solid_fraction", nan, "nan", "above 0 and at most 0.4"),
        ("samples.mine.contact.normal_stiffness", 0.0, "0 N/m", "1e-09 to 1e+15 N/m"),
        ("samples.mine.contact.normal_stiffness", nan, "nan", "1e-09 to 1e+15 N/m"),
        ("samples.mine.contact.normal_stiffness", infinity, "inf", "1e-09 to 1e+15 N/m"),
        ("samples.mine.contact.normal_stiffness", 5e-324, "4.94066e-324 N/m", "1e-09 to 1e+15"),
        ("samples.mine.contact.law", "elastic", "'elastic'", "'linear' or 'hertz'"),
        ("samples.mine.contact", 1e6, "1e+06", "a section"),
        ("samples.mine.loading.edge_reduction", 1, "1", "below 1"),
        ("samples.mine.loading.edge_reduction", nan, "nan", "below 1"),
        ("samples.mine.loading.states", 0, "0", "a whole number from 1 to 1000"),
        ("samples.mine.loading.quality", "best", "'best'", "'draft', 'standard' or 'fine'"),
        ("samples.mine.loading.unloading", "on", "'on'", "true or false"),
        ("samples.mine.loading.mean_stress", nan, "nan", "a stress in Pa"),
        ("samples.mine.loading", None, "nothing", "a section"),
        ("samples.mine.loading", [1], "[1]", "a section"),
        ("samples.mine.seeds", 0, "0", "a whole number from 1 to 1000, or a list"),
        ("samples.mine.seeds", 1001, "1001", "a whole number from 1 to 1000, or a list"),
        ("samples.mine.seeds", True, "true", "list"),
        ("samples.mine.seeds", "all", "'all'", "list"),
        ("samples.mine.seeds", [], "[]", "list"),
        ("samples.mine.seeds", [1, 1], "[1, 1]", "once"),
        ("samples.mine.refined_seeds", -1, "-1", "a whole number from 0"),
        ("samples.mine.ranks", 0, "0 processes", "a whole number from 1 to 1024 processes"),
        ("samples.mine.ranks", 1.5, "1.5 processes", "a whole number from 1 to 1024 processes"),
        ("samples.mine", None, "nothing", "a section"),
        ("samples", None, "nothing", "a section"),
        ("samples", [1], "[1]", "a section"),
        ("samples", {}, "{}", "at least one sample"),
        ("energy_split.bins", 2, "2", "from 3 to 200"),
        ("energy_split.confidence", 95, "95", "below 1 (a share: 0.4 is 40 %)"),
        ("energy_split.resamples", "many", "'many'", "a whole number"),
        ("energy_split", None, "nothing", "a section"),
        ("thermodynamics.ultimate_alpha", 3, "3", "below 3"),
        ("thermodynamics.critical_energy", infinity, "inf", "J/m3"),
        ("thermodynamics.critical_energy", -1, "-1 J/m3", "J/m3"),
        ("thermodynamics.form", "papers", "'papers'", "'moving_jamming', 'paper'"),
        ("thermodynamics.network", "rod", "'rod'", "'rods' or 'parking'"),
        ("thermodynamics.rod_gap", 0, "0", "above 0 and at most 10"),
        ("thermodynamics.resistance", "strain", "'strain'", "'critical_energy' or"),
        ("thermodynamics.elastic_strain", 0.5, "0.5", "above 0 and below 0.5"),
        ("thermodynamics.strength_exponent", -1, "-1", "from 0 to 10"),
        ("figures.dpi", 5, "5 dots per inch", "from 50 to 1200 dots per inch"),
    ],
)
def test_message_names_the_key_its_value_and_what_is_allowed(path, value, shown, allowed):
    message = message_of(config_with(path, value)).splitlines()[0]
    assert message.startswith(f"config: {path} = {shown}: ")
    assert allowed in message.removeprefix(f"config: {path} = {shown}: ")


@pytest.mark.parametrize(
    ("key", "value", "choice", "other"),
    [
        ("elastic_strain", 0.02, "resistance: critical_energy", "elastic_strain"),
        ("strength_exponent", 0.5, "resistance: critical_energy", "elastic_strain"),
        ("critical_energy", 3e5, "resistance: elastic_strain", "critical_energy"),
        ("hardening_exponent", 1.5, "resistance: elastic_strain", "critical_energy"),
        ("pressure_exponent", 0.3, "elasticity: hertz", "pressure_dependent"),
    ],
)
def test_a_key_without_effect_is_refused_where_it_is_given(key, value, choice, other):
    chooser, chosen = choice.split(": ")
    raw = config_with(f"thermodynamics.{chooser}", chosen)
    checked_config(raw)
    raw["thermodynamics"][key] = value
    assert message_of(raw) == (
        f"config: thermodynamics.{key} = {value:g}: has no effect with {choice}: leave it out, or "
        f"say {chooser}: {other}"
    )
    raw["thermodynamics"][chooser] = other
    assert getattr(checked_config(raw).thermodynamics, key) == value


@pytest.mark.parametrize(("seeds", "most"), [(3, 3), ([7, 2], 2)])
def test_more_refined_seeds_than_seeds_are_refused(seeds, most):
    config = config_with("samples.mine.seeds", seeds)
    config["samples"]["mine"]["refined_seeds"] = 4
    assert message_of(config) == (
        f"config: samples.mine.refined_seeds = 4: must be at most {most}, the number of seeds, of "
        "which so many run again; lower it, raise seeds, or leave it out"
    )


def test_seeds_that_are_wrong_say_nothing_of_refined_ones():
    config = config_with("samples.mine.seeds", 0)
    config["samples"]["mine"]["refined_seeds"] = 4
    assert message_of(config).startswith("config: samples.mine.seeds = 0: ")
    assert "refined_seeds" not in message_of(config)


@pytest.mark.parametrize("seed", [-2, 2**32])
def test_seed_of_a_list_is_named_by_its_place(seed):
    message = message_of(config_with("samples.mine.seeds", [1, seed]))
    assert message.startswith(f"config: samples.mine.seeds.1 = {seed}: ")
    assert "a whole number from 0 to 4294967295" in message


@pytest.mark.parametrize(
    ("key", "value", "shown"), [("poisson_ratio", 0.6, "0.6"), ("young_modulus", 0, "0 Pa")]
)
def test_keys_of_a_hertz_contact_have_their_own_bounds(key, value, shown):
    hertz = {"law": "hertz", "young_modulus": 7e10, "poisson_ratio": 0.5}
    checked_config(config_with("samples.mine.contact", hertz))
    message = message_of(config_with("samples.mine.contact", {**hertz, key: value}))
    assert message.startswith(f"config: samples.mine.contact.{key} = {shown}: must be a number")


@pytest.mark.parametrize(("word", "near"), [("fractl", "fractal"), ("sieves", "sieve")])
def test_misspelt_word_is_answered_with_the_nearest_one(word, near):
    message = message_of(config_with("samples.mine.grading.form", word))
    assert message.endswith(f"; did you mean '{near}'?")


@pytest.mark.parametrize(
    ("path", "missing"),
    [
        ("samples.mine.grading", "max"),
        ("samples.mine.grading", "basis"),
        ("samples.mine.grading", "size"),
        ("samples.mine.grading", "unit"),
        ("samples.mine.grading", "form"),
        ("samples.mine", "grains"),
        ("samples.mine", "grading"),
        ("samples.mine", "loading"),
        ("samples.mine", "seeds"),
    ],
)
def test_missing_key_is_named(path, missing):
    raw = {"samples": {"mine": deepcopy(SAMPLE)}}
    here = raw
    for section in path.split("."):
        here = here[section]
    del here[missing]
    message = message_of(raw)
    assert message.startswith(f"config: {path}.{missing}: missing; must be ")
    assert "\n" not in message


def test_fractal_grading_without_its_dimension_is_refused():
    raw = config_with("samples.mine.grading.form", "fractal")
    expected = "missing; must be a number above 0 and at most 6"
    assert message_of(raw) == f"config: samples.mine.grading.alpha: {expected}"


def test_configuration_without_samples_is_refused():
    assert message_of({}) == "config: samples: missing; give it a value"


@pytest.mark.parametrize(
    ("path", "near"),
    [
        ("samples.mine.grians", "grains"),
        ("samples.mine.laoding", "loading"),
        ("samples.mine.grading.maxx", "max"),
        ("samples.mine.loading.stats", "states"),
        ("samples.mine.contact.normal_stifness", "normal_stiffness"),
        ("samples.mine.allow_unrepresentativ", "allow_unrepresentative"),
        ("enrgy_split", "energy_split"),
        ("energy_split.bin", "bins"),
        ("thermodynamics.ultimate_alfa", "ultimate_alpha"),
        ("thermodynamics.netwrok", "network"),
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
    assert message.endswith("unknown key; allowed: size, unit, min, max, form, basis")


def test_unknown_key_with_no_near_one_is_answered_with_all_that_are_allowed():
    message = message_of(config_with("samples.mine.contact.viscosity", 1))
    assert message.endswith(
        "samples.mine.contact.viscosity: unknown key; allowed: law, normal_stiffness"
    )
    message = message_of({"samples": {"mine": SAMPLE}, "plots": {}})
    assert message.endswith(
        "allowed: samples, energy_split, thermodynamics, measured, figures, keep_dumps"
    )


def test_sizes_out_of_order_are_refused_with_both():
    message = message_of(config_with("samples.mine.grading", {**UNIFORM, "min": 2e-3}))
    expected = "grading.max = 0.001 m: must be above min 0.002 m"
    assert message == f"config: samples.mine.{expected}"
    grading = {**FRACTAL, "min": 1e-3}
    assert "must be above" in message_of(config_with("samples.mine.grading", grading))


def test_sizes_out_of_order_are_named_besides_another_mistake():
    grading = {**FRACTAL, "min": 2e-3, "alpha": nan}
    first, second = message_of(config_with("samples.mine.grading", grading)).splitlines()
    assert "grading.max = 0.001 m" in first
    assert "grading.alpha = nan" in second


@pytest.mark.parametrize(
    ("loading", "which"),
    [
        ({}, "none is given"),
        ({"quality": "fine"}, "none is given"),
        ({"edge_reduction": None}, "none is given"),
        ({"edge_reduction": 0.4, "mean_stress": 1e5}, "edge_reduction and mean_stress are given"),
    ],
)
def test_a_loading_has_exactly_one_target(loading, which):
    message = message_of(config_with("samples.mine.loading", loading))
    assert message.startswith("config: samples.mine.loading: must have exactly one target of edge_")
    assert message.endswith(which)


def test_a_target_that_is_wrong_is_a_target_all_the_same():
    message = message_of(config_with("samples.mine.loading", {"edge_reduction": 40}))
    assert message.startswith("config: samples.mine.loading.edge_reduction = 40: ")
    assert "\n" not in message


def test_states_belong_to_strain_targets():
    message = message_of(config_with("samples.mine.loading", {"mean_stress": 1e5, "states": 3}))
    assert message.startswith("config: samples.mine.loading.states = 3: belongs to a strain target")


def test_path_that_ends_looser_than_where_its_steps_begin_is_refused():
    message = message_of(config_with("samples.mine.initial_solid_fraction", 0.1))
    assert message.startswith("config: samples.mine.loading.edge_reduction = 0.4: leads from ")
    # 0.1 / 0.6^3
    assert "initial_solid_fraction 0.1 to 0.463, which must be above" in message
    raw = config_with("samples.mine.loading", {**LOADING, "approach_solid_fraction": 0.16})
    assert message_of(raw) == (
        "config: samples.mine.loading.approach_solid_fraction = 0.16: must be above "
        "initial_solid_fraction 0.16"
    )
    for end in (0.1, 0.55):
        message = message_of(config_with("samples.mine.loading", {"solid_fraction": end}))
        assert f"loading.solid_fraction = {end}: must be above" in message


def test_path_that_ends_denser_than_grains_can_be_is_refused():
    message = message_of(config_with("samples.mine.loading", {"edge_reduction": 0.6}))
    assert "edge_reduction = 0.6: leads from initial_solid_fraction 0.16 to 2.5, which" in message
    assert message.endswith("at most 1.2")


def test_every_problem_has_a_line_of_its_own():
    raw = config_with("samples.mine.grains", 1)
    raw["figures"] = {"dpi": 1}
    raw["samples"]["other"] = {**deepcopy(SAMPLE), "grians": 100}
    keys = [line.split(":")[1].split("=")[0].strip() for line in message_of(raw).splitlines()]
    assert keys == ["samples.mine.grains", "samples.other.grians", "figures.dpi"]


@pytest.mark.parametrize("raw", [None, [], [1], "samples", 3])
def test_file_that_holds_no_keys_is_refused(raw):
    assert message_of(raw).startswith("config: ")
