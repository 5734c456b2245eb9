"""A valid section of every form of grading, and what a user reads of one that is refused."""

from copy import deepcopy

import pytest
from pydantic import ValidationError

from branchcrush.config.fields import Section
from branchcrush.config.gradings import (
    GradingSection,
)
from branchcrush.config.messages import problem

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
