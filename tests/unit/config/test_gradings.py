"""Sections of the configuration that describe a grading: what is valid, and what is refused how."""

from typing import Literal, get_args, get_origin

import pytest
from pydantic import TypeAdapter, ValidationError

from branchcrush.config.build import grading_of
from branchcrush.config.gradings import (
    DensityGrading,
    GradingSection,
    HistogramGrading,
    RadiiGrading,
    SieveGrading,
    grading_data_files,
)
from branchcrush.config.units import UNITS
from branchcrush.files.declared import DEFAULTS, WORDS
from tests.unit.config.sections import (
    FORMULAS,
    NO_SIZES,
    TABLES,
    VALID,
    checked,
    every_form,
    message_of,
    section_with,
)

# --- valid ---------------------------------------------------------------------------------------


@every_form
def test_every_form_is_valid_and_plain_again(form):
    section = checked(VALID[form])
    assert section.form == form
    plain = {key: value for key, value in VALID[form].items() if value is not None}
    if form != "mixture":
        assert section.model_dump(exclude_none=True) == plain
    assert TypeAdapter(GradingSection).validate_python(section.model_dump()) == section


@pytest.mark.parametrize("form", FORMULAS)
def test_every_formula_makes_a_grading_of_its_sizes(form):
    section = checked(VALID[form]).model_dump()
    smallest, largest = grading_of(section).support()
    expected = (1e-3, 1e-3) if form == "single" else (0.25e-3, 2e-3)
    assert (smallest, largest) == pytest.approx(expected, rel=1e-14)


def test_bounds_of_a_table_may_be_left_out():
    for form in TABLES:
        section = checked(section_with(form, min=None, max=None))
        assert (section.min, section.max) == (None, None)


def test_centre_of_a_distribution_may_lie_outside_its_bounds():
    assert checked(section_with("normal", mean=5.0)).mean == 5.0


# --- refused -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("form", "key"), [(form, key) for form in VALID for key in VALID[form] if key != "form"]
)
def test_every_key_but_the_bounds_of_a_table_is_required(form, key):
    if (form in TABLES and key in ("min", "max")) or key in NO_SIZES:
        return
    if form in ("lognormal", "weibull") and key not in ("size", "unit", "basis"):
        assert message_of(section_with(form, **{key: None})).startswith("grading: must have ")
        return
    assert message_of(section_with(form, **{key: None})).startswith(f"grading.{key}: missing")


@every_form
def test_unknown_key_is_refused(form):
    assert message_of(section_with(form, radius_max=1.0)).startswith("grading.radius_max: unknown")


def test_unknown_form_is_refused_with_all_forms():
    message = message_of({**VALID["uniform"], "form": "gaussian"})
    assert message.startswith("grading.form = 'gaussian'")
    assert all(f"'{form}'" in message for form in VALID)


@pytest.mark.parametrize(
    ("form", "keys", "expected"),
    [
        ("uniform", {"unit": "ft"}, "grading.unit = 'ft'"),
        ("sieve", {"values": "retained"}, "grading.values = 'retained'"),
        ("sieve", {"openings": "mesh"}, "grading.openings = 'mesh'"),
        ("sieve", {"columns": [1]}, "grading.columns = [1]: must be a list of two"),
        ("sieve", {"columns": [1, 2, 3]}, "grading.columns = [1, 2, 3]: must be a list of two"),
        ("sieve", {"columns": {"size": 1, "finer": 2}}, "grading.columns = {size: 1, finer: 2}"),
        ("sieve", {"columns": [0, 1]}, "grading.columns = [0, 1]"),
        ("sieve", {"sheet": True}, "grading.sheet = true: must be the name of a sheet"),
        ("density", {"per": "mm"}, "grading.per = 'mm'"),
        ("histogram", {"sizes": "centres"}, "grading.sizes = 'centres'"),
        ("histogram", {"scale": "ln"}, "grading.scale = 'ln'"),
        ("uniform", {"size": "width"}, "grading.size = 'width'"),
        ("uniform", {"basis": "volume"}, "grading.basis = 'volume'"),
        ("fractal", {"basis": "mass"}, "grading.basis = 'mass'"),
        ("fuller", {"basis": "number"}, "grading.basis = 'number'"),
        ("sieve", {"basis": "number"}, "grading.basis = 'number'"),
        ("radii", {"basis": "mass"}, "grading.basis = 'mass'"),
        ("sieve", {"size": "radius"}, "grading.size = 'radius'"),
        ("single", {"basis": "mass"}, "grading.basis: unknown key"),
        ("single", {"value": 0.0}, "grading.value = 0"),
        ("uniform", {"min": -1.0}, "grading.min = -1"),
        ("uniform", {"max": float("inf")}, "grading.max = inf"),
        ("normal", {"mean": 0.0}, "grading.mean = 0"),
        ("normal", {"standard_deviation": 0.0}, "grading.standard_deviation = 0"),
        ("lognormal", {"geometric_standard_deviation": 1.0}, "grading.geometric_standard_dev"),
        ("weibull", {"shape": 0.0}, "grading.shape = 0"),
        ("fractal", {"alpha": 0.0}, "grading.alpha = 0"),
        ("fuller", {"exponent": 0.0}, "grading.exponent = 0"),
        ("radii", {"file": ""}, "grading.file = ''"),
    ],
)
def test_value_out_of_its_range_is_refused(form, keys, expected):
    assert message_of(section_with(form, **keys)).startswith(expected)


@pytest.mark.parametrize(
    "form", [form for form in VALID if "min" in VALID[form] and form != "single"]
)
@pytest.mark.parametrize(("low", "high"), [(3.0, 2.0), (2.0, 2.0)])
def test_bounds_in_the_wrong_order_are_named_with_their_unit(form, low, high):
    message = message_of(section_with(form, min=low, max=high))
    assert message == f"grading.max = 2 mm: must be above min {low:g} mm"


@pytest.mark.parametrize(
    ("form", "keys", "words"),
    [
        ("normal", {"mean": 9.0, "standard_deviation": 0.1}, ["mean 9 mm", "_deviation = 0.1 mm"]),
        ("lognormal", {"median": 900.0}, ["median 900 mm", "geometric_standard_deviation = 1.5:"]),
        ("weibull", {"scale": 0.001}, ["scale 0.001 mm", "shape = 1.5:"]),
    ],
)
def test_bounds_that_miss_the_distribution_are_refused(form, keys, words):
    message = message_of(section_with(form, **keys))
    for word in [*words, "min 0.5 mm", "max 4 mm", "at least 1e-06"]:
        assert word in message


# --- mixtures and tables -----------------------------------------------------------------------


def test_mixture_needs_two_parts_with_weights_and_holds_no_other():
    part = VALID["mixture"]["components"][0]
    message = message_of(section_with("mixture", components=[part]))
    assert message.startswith("grading.components = [{weight: 1, ")
    assert message.endswith("must be a list of 2 or more, each with a weight and a grading")
    for wrong, place in (
        ({**part, "weight": 0.0}, "weight"),
        ({**part, "grading": VALID["mixture"]}, "grading"),
        ({"weight": 1.0}, "grading"),
        ({**part, "grading": section_with("single", unit=None)}, "unit"),
    ):
        with pytest.raises(ValidationError) as refused:
            checked(section_with("mixture", components=[part, wrong]))
        (detail,) = refused.value.errors()
        assert detail["loc"][:4] == ("grading", "mixture", "components", 1)
        assert detail["loc"][-1] == place


def test_middles_of_channels_need_a_scale():
    section = section_with("histogram", sizes="middles")
    assert message_of(section).startswith("grading.scale = nothing: must be 'log' or 'linear'")
    assert checked({**section, "scale": "log"}).scale == "log"


def test_columns_may_be_named_in_any_order():
    for columns in ([3, "Passing"], {"value": "Passing", "opening": 3}):
        assert checked(section_with("sieve", columns=columns)).columns == [3, "Passing"]
    named = {"value": 1, "upper": 2, "lower": 3}
    assert checked(section_with("histogram", columns=named)).columns == [3, 2, 1]


@pytest.mark.parametrize("openings", ["phi", "astm_e11", "tyler_mesh"])
def test_openings_that_are_no_sizes_need_no_unit(openings):
    section = section_with("sieve", openings=openings, unit=None)
    assert checked(section).unit == "mm"
    assert checked({**section, "unit": "um"}).unit == "um"
    assert message_of({**section, "openings": "size"}).startswith("grading.unit: missing")


# --- words ---------------------------------------------------------------------------------------


def words_in(annotation):
    """Return the words of all Literals within an annotation."""
    if get_origin(annotation) is Literal:
        return set(get_args(annotation))
    return set().union(*(words_in(part) for part in get_args(annotation)))


FORMS_OF_FILES = (SieveGrading, DensityGrading, HistogramGrading, RadiiGrading)


@pytest.mark.parametrize("key", [*WORDS, "unit"])
def test_words_of_the_keys_of_tables_are_those_that_readers_know(key):
    fields = [form.model_fields[key] for form in FORMS_OF_FILES if key in form.model_fields]
    known = {**WORDS, "unit": tuple(UNITS)}[key]
    assert set().union(*(words_in(field.annotation) for field in fields)) == set(known)
    assert DEFAULTS.get(key, known[0]) in known


# --- files ---------------------------------------------------------------------------------------


def test_data_files_are_those_of_all_parts():
    sieve, radii = {"form": "sieve", "file": "a.csv"}, {"form": "radii", "file": "b/c.txt"}
    assert grading_data_files(sieve) == ["a.csv"]
    assert grading_data_files(VALID["uniform"]) == []
    parts = [{"weight": 1.0, "grading": part} for part in (sieve, VALID["uniform"], radii)]
    mixture = {"form": "mixture", "basis": "mass", "components": parts}
    assert grading_data_files(mixture) == ["a.csv", "b/c.txt"]
