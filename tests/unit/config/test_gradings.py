"""Sections of the configuration that describe a grading: what is valid, and what is refused how."""

from copy import deepcopy
from typing import Literal, get_args, get_origin

import pytest
from pydantic import TypeAdapter, ValidationError

from branchcrush.config.build import grading_of, size_fits
from branchcrush.config.fields import Section
from branchcrush.config.gradings import (
    DensityGrading,
    GradingSection,
    HistogramGrading,
    RadiiGrading,
    SieveGrading,
    grading_data_files,
)
from branchcrush.config.messages import problem
from branchcrush.config.units import UNITS
from branchcrush.files.declared import DEFAULTS, WORDS

SIZES = {"size": "diameter", "unit": "mm"}
ENDS = {**SIZES, "basis": "mass", "min": 0.5, "max": 4.0}
NO_SIZES = {"d10": None, "d50": None, "d90": None}
VALID = {
    "uniform": ENDS,
    "loguniform": ENDS,
    "normal": {**ENDS, "mean": 2.0, "standard_deviation": 0.5},
    "lognormal": {**ENDS, **NO_SIZES, "median": 2.0, "geometric_standard_deviation": 1.5},
    "weibull": {**ENDS, **NO_SIZES, "scale": 2.0, "shape": 1.5},
    "fractal": {**ENDS, "basis": "number", "alpha": 2.6},
    "fuller": {**ENDS, "exponent": 0.5},
    "single": {**SIZES, "value": 2.0},
    "sieve": {**SIZES, "basis": "mass", "file": "sand.csv", "min": None, "max": 3.0},
    "density": {**SIZES, "basis": "number", "file": "sand.csv", "min": 1.0, "max": None},
    "histogram": {**SIZES, "basis": "number", "file": "sand.csv", "sizes": "lower", "max": 9.0},
    "radii": {**SIZES, "basis": "number", "file": "sand.csv"},
}
VALID = {form: {"form": form, **keys} for form, keys in VALID.items()}
VALID["mixture"] = {
    "form": "mixture",
    "basis": "number",
    "components": [
        {"weight": 1.0, "grading": VALID["single"]},
        {"weight": 2.0, "grading": VALID["sieve"]},
    ],
}
TABLES = ("sieve", "density", "histogram")
every_form = pytest.mark.parametrize("form", VALID)
# Gradings that have no file to read.
FORMULAS = [form for form in VALID if form not in (*TABLES, "radii", "mixture")]


class Root(Section):
    grading: GradingSection


def checked(section):
    return Root.model_validate({"grading": section}).grading


def section_with(form, **keys):
    """Return a valid section but for some keys; None leaves one out."""
    section = {**deepcopy(VALID[form]), **keys}
    return {key: value for key, value in section.items() if value is not None}


def message_of(section):
    with pytest.raises(ValidationError) as refused:
        checked(section)
    (detail,) = refused.value.errors()
    return problem(detail, Root)


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


# --- curves through sizes ------------------------------------------------------------------------

NOTHING = dict.fromkeys(["median", "geometric_standard_deviation", "scale", "shape"])


def through(form, **keys):
    return section_with(form, **{**NOTHING, "min": 0.1, "max": 9.0, "unit": "mm", **keys})


def test_three_sizes_make_the_lognormal_of_their_regression():
    # Even in the logarithm: the median is 2, and sigma_g^1.28155 = 2.
    section = checked(through("lognormal", d10=1.0, d50=2.0, d90=4.0)).model_dump(exclude_none=True)
    direct = section_with(
        "lognormal",
        min=0.1,
        max=9.0,
        median=2.0,
        geometric_standard_deviation=2 ** (1 / 1.2815515655),
    )
    made, expected = (grading_of(part) for part in (section, checked(direct).model_dump()))
    shares = [0.01, 0.1, 0.5, 0.9, 0.99]
    assert made.mass_ppf(shares) == pytest.approx(expected.mass_ppf(shares), rel=1e-8)


@pytest.mark.parametrize("size", ["radius", "diameter"])
@pytest.mark.parametrize("basis", ["number", "mass"])
def test_sizes_are_radii_or_diameters_by_number_or_by_mass_as_declared(size, basis):
    # 10 % and 90 % of a Weibull of scale 1 and shape 2, hardly cut.
    sizes = {"d10": 0.324592846, "d90": 1.517427129}
    keys = through("weibull", size=size, basis=basis, min=1e-4, max=6.0, **sizes)
    grading = grading_of(checked(keys).model_dump(exclude_none=True))
    shares = (grading.number_cdf if basis == "number" else grading.mass_cdf)(
        [factor * (1.0 if size == "radius" else 0.5) * 1e-3 for factor in (0.324592846, 1.0)]
    )
    assert shares == pytest.approx([0.1, 0.632120559], abs=1e-6)


def test_d50_is_the_median_of_a_lognormal():
    keys = {"d50": 2.0, "geometric_standard_deviation": 1.5}
    section = checked(through("lognormal", **keys)).model_dump(exclude_none=True)
    direct = section_with("lognormal", min=0.1, max=9.0)
    assert grading_of(section).mass_ppf(0.3) == grading_of(checked(direct).model_dump()).mass_ppf(
        0.3
    )


@pytest.mark.parametrize(
    ("form", "keys", "given"),
    [
        ("lognormal", {}, "none is given"),
        ("lognormal", {"d50": 1.0}, "d50 is given"),
        ("lognormal", {"d10": 1.0, "d50": 2.0, "geometric_standard_deviation": 2.0}, "are given"),
        ("lognormal", {"d10": 1.0, "d50": 2.0, "median": 2.0}, "median and d10 and d50 are given"),
        ("weibull", {"d50": 1.0, "shape": 2.0}, "shape and d50 are given"),
        ("weibull", {"scale": 1.0, "d10": 0.5, "d90": 2.0}, "scale and d10 and d90 are given"),
    ],
)
def test_too_few_or_too_many_keys_for_a_curve_are_refused_with_all_ways(form, keys, given):
    message = message_of(through(form, **keys))
    assert message.startswith("grading: must have ")
    assert "two or three of d10, d50, d90" in message and message.endswith(given)


def test_sizes_that_do_not_grow_are_named():
    message = message_of(through("weibull", d50=2.0, d90=2.0))
    assert message == "grading.d90 = 2 mm: must be above d50 2 mm"


def test_missing_ends_are_asked_for_with_advice():
    # D50 = 2 and D90 = 4, so 1 % and 99 % are at 2 * 2^(2.32635/1.28155) and its like: 7.04, 0.568.
    message = message_of(through("lognormal", d50=2.0, d90=4.0, min=None, max=None))
    assert message.startswith("grading: must have min, the smallest grain and max, the largest")
    assert message.endswith("so for example min: 0.568, max: 7.04")
    message = message_of(through("lognormal", d50=200.0, d90=400.0, unit="um", min=50.0, max=None))
    assert message.endswith("coarser than 704 um, so for example max: 704")


def test_ends_that_miss_a_curve_through_sizes_are_refused():
    message = message_of(through("lognormal", d10=1.0, d90=1.1, min=5.0, max=9.0))
    assert message.startswith("grading: with median 1.04881 mm only 0 of the distribution")


def test_a_curve_that_misses_its_sizes_is_refused():
    message = message_of(through("lognormal", d10=0.1, d50=2.0, d90=2.2))
    assert message.startswith(
        "grading: no lognormal curve passes near these sizes: given D10 = 0.1"
    )


def test_the_fit_is_told_in_diameters_of_metres_also_of_a_part():
    section = checked(through("lognormal", size="radius", d10=1.0, d50=2.0, d90=4.4)).model_dump(
        exclude_none=True
    )
    (fit,) = size_fits(section).values()
    assert fit.given == pytest.approx((2e-3, 4e-3, 8.8e-3))
    # A third and two thirds of ln(sqrt(4.4)/2).
    assert fit.misfits == pytest.approx([1.1 ** (k / 6) - 1 for k in (-1, 2, -1)], rel=1e-6)
    parts = [{"weight": 1.0, "grading": VALID["single"]}, {"weight": 1.0, "grading": section}]
    assert list(size_fits({"form": "mixture", "basis": "mass", "components": parts})) == [
        "grading.components.1.grading"
    ]
    assert size_fits(VALID["lognormal"]) == {}


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
