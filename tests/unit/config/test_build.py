"""The objects that a job works with, made of plain settings: gradings and samples."""

import math
import typing

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.config.build import FORMS, grading_of
from branchcrush.config.gradings import GradingSection
from branchcrush.config.sample import sample_of
from branchcrush.config.schema import checked_config
from branchcrush.errors import GradingError
from branchcrush.gradings.forms import uniform
from branchcrush.loading.targets import Loading

OPENING, PERCENT = [0.063, 0.5, 2.0, 8.0], [0.0, 12.5, 60.0, 100.0]
SAND = "0.063,0\n0.5,12.5\n2,60\n8,100\n"
MM = {"size": "radius", "unit": "mm"}
ENDS = {**MM, "min": 1.0, "max": 4.0}


def normal_cdf(deviations):
    return 0.5 * math.erfc(-deviations / math.sqrt(2.0))


def share_up_to_one_deviation(most):
    """Share below +1 of a normal distribution that is cut at -most and +most deviations."""
    return (normal_cdf(1.0) - normal_cdf(-most)) / (normal_cdf(most) - normal_cdf(-most))


# A section, a radius [m], and the share finer than that, by hand.
KNOWN = [
    ({"form": "uniform", **ENDS}, 2.5e-3, 0.5),
    ({"form": "loguniform", **ENDS}, 2e-3, 0.5),
    (
        {"form": "normal", "mean": 2.5, "standard_deviation": 0.5, **ENDS},
        3e-3,
        share_up_to_one_deviation(3.0),
    ),
    (
        {"form": "lognormal", "median": 2.0, "geometric_standard_deviation": 1.5, **ENDS},
        3e-3,
        share_up_to_one_deviation(math.log(2.0) / math.log(1.5)),
    ),
    (
        {"form": "weibull", "scale": 2.0, "shape": 1.0, **ENDS},  # exponential
        2e-3,
        (math.exp(-0.5) - math.exp(-1.0)) / (math.exp(-0.5) - math.exp(-2.0)),
    ),
    ({"form": "fractal", "alpha": 2.0, **ENDS}, 2e-3, (1 - 1 / 4) / (1 - 1 / 16)),
    ({"form": "fuller", "exponent": 0.5, **ENDS}, 2.25e-3, 0.5),
    ({"form": "single", "value": 2.0, **MM}, 2e-3, 1.0),
]
# Of the forms that have only one.
BASES = {"fractal": ["number"], "fuller": ["mass"]}
SECTIONS = [{"basis": "mass", **section} for section, *_ in KNOWN]
SIZES = {"min", "max", "mean", "standard_deviation", "median", "scale", "value"}
any_section = pytest.mark.parametrize("section", SECTIONS, ids=[s["form"] for s in SECTIONS])


@pytest.fixture
def written(tmp_path):
    """Return a function that writes text to a file and returns its path."""

    def write(content):
        path = tmp_path / "sand.csv"
        path.write_text(content)
        return path

    return write


# --- gradings ------------------------------------------------------------------------------------


@any_section
@pytest.mark.parametrize(("unit", "factor"), [("m", 1e-3), ("um", 1e3)])
@pytest.mark.parametrize(("size", "times"), [("radius", 1.0), ("diameter", 2.0)])
def test_unit_and_size_say_how_to_read_the_numbers(section, unit, factor, size, times):
    same = {
        key: value * factor * times if key in SIZES else value for key, value in section.items()
    }
    grading, other = grading_of(section), grading_of({**same, "unit": unit, "size": size})
    radius = np.linspace(1e-3, 4e-3, 12)
    assert_allclose(other.support(), grading.support(), rtol=1e-14)
    assert_allclose(other.mass_cdf(radius + 1e-9), grading.mass_cdf(radius + 1e-9), atol=1e-12)
    assert_allclose(other.moment(3), grading.moment(3), rtol=1e-12)


@pytest.mark.parametrize(("section", "radius", "share"), KNOWN, ids=[s["form"] for s, *_ in KNOWN])
def test_share_finer_is_that_of_the_form_on_its_basis(section, radius, share):
    finer = {
        basis: getattr(grading_of({**section, "basis": basis}), f"{basis}_cdf")(radius)
        for basis in BASES.get(section["form"], ("number", "mass"))
    }
    assert_allclose(list(finer.values()), share, rtol=1e-9)


def test_sieve_file_gives_diameters(written):
    section = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm"}
    grading = grading_of({**section, "file": str(written(SAND)), "min": None, "max": None})
    assert_allclose(grading.mass_cdf(np.array(OPENING) / 2000), np.array(PERCENT) / 100, atol=1e-12)
    cut = grading_of({**section, "file": str(written(SAND)), "min": 0.5, "max": 2.0})
    assert_allclose(cut.support(), (0.25e-3, 1e-3), rtol=1e-14)


def test_sieve_file_that_is_cut_need_not_run_to_its_ends(written):
    section = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm", "min": 0.1}
    grading = grading_of({**section, "file": str(written("0.1,5\n1,50\n4,95\n")), "max": 4.0})
    assert_allclose(grading.support(), (0.05e-3, 2e-3), rtol=1e-14)
    # Half of the 90 % that are left.
    assert_allclose(grading.mass_cdf(0.5e-3), 0.5, rtol=1e-12)


def test_density_file_is_cut_where_the_section_says(written):
    section = {"form": "density", "basis": "number", "file": str(written("1,1\n3,1\n")), **MM}
    grading = grading_of({**section, "max": 2.0})
    assert_allclose(grading.support(), (1e-3, 2e-3), rtol=1e-14)
    assert_allclose(grading.number_cdf(1.25e-3), 0.25, rtol=1e-12)


def test_density_file_is_by_its_basis(written):
    path = str(written("1,1\n3,1\n"))
    for basis in ("number", "mass"):
        section = {"form": "density", "basis": basis, "file": path, **MM}
        finer = getattr(grading_of(section), f"{basis}_cdf")(1.5e-3)
        assert_allclose(finer, 0.25, rtol=1e-12)


def test_radii_file_gives_its_grains(written):
    path = str(written("2\n4\n4\n"))
    section = {"form": "radii", "basis": "number", "file": path, "size": "diameter", "unit": "um"}
    radii, share = grading_of(section).discrete_part
    assert_allclose(radii, [1e-6, 2e-6], rtol=1e-14)
    assert_allclose(share, [1 / 3, 2 / 3], rtol=1e-14)


def test_mixture_is_made_of_sections(written):
    sizes = [{"form": "single", "value": value, **MM} for value in (1.0, 2.0)]
    components = [{"weight": w, "grading": g} for w, g in zip((3.0, 1.0), sizes, strict=True)]
    grading = grading_of({"form": "mixture", "basis": "mass", "components": components})
    assert_allclose(grading.mass_cdf(1.5e-3), 0.75, rtol=1e-14)
    assert_allclose(grading.number_cdf(1.5e-3), 24 / 25, rtol=1e-14)


def test_files_are_relative_to_the_working_directory(written, monkeypatch):
    path = written(SAND)
    monkeypatch.chdir(path.parent)
    section = {
        "form": "sieve",
        "basis": "mass",
        "size": "diameter",
        "unit": "m",
        "file": "sand.csv",
    }
    assert grading_of(section).support() == (0.0315, 4.0)


def test_message_of_a_wrong_file_names_it(written):
    path = str(written("1,0\n2,0\n4,100\n"))
    section = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm", "file": path}
    with pytest.raises(GradingError, match=r"sand\.csv: no grains are left"):
        grading_of({**section, "max": 1.5})


@pytest.mark.parametrize("section", [ENDS, {**MM, "file": "sand.csv"}])
def test_unknown_form_is_refused(section):
    with pytest.raises(GradingError, match="'sphere'"):
        grading_of({**section, "form": "sphere", "basis": "mass"})


# --- registry ------------------------------------------------------------------------------------


def forms_of_the_configuration():
    union, _ = typing.get_args(GradingSection)
    kinds = [kind.model_fields["form"].annotation for kind in typing.get_args(union)]
    return [form for kind in kinds for form in typing.get_args(kind)]


def test_every_form_of_the_configuration_makes_a_grading():
    assert sorted(FORMS) == sorted(forms_of_the_configuration())


def test_one_entry_adds_a_form(monkeypatch):
    monkeypatch.setitem(FORMS, "half", lambda values: uniform(values.radius("max") / 2, 4e-3))
    assert grading_of({"form": "half", **ENDS}).support() == (2e-3, 4e-3)


# --- samples -------------------------------------------------------------------------------------

HERTZ = {"law": "hertz", "young_modulus": 3.0, "poisson_ratio": 0.5}
SETTINGS = {
    "grading": SECTIONS[0],
    "sampling": "mass_quantiles",
    "grains": 120,
    "boundary": "walls",
    "initial_solid_fraction": 0.2,
    "contact": HERTZ,
    "loading": {"target": "solid_fraction", "value": 0.7, "states": 4, "unloading": True},
    "strain_step": 2e-3,
    "seeds": [7, 3],
    "refined_seeds": 1,
    "ranks": 2,
}


def test_sample_has_the_values_of_its_settings():
    sample = sample_of(SETTINGS)
    assert sample.grading.support() == (1e-3, 4e-3)
    assert (sample.sampling, sample.grains, sample.boundary) == ("mass_quantiles", 120, "walls")
    assert (sample.initial_solid_fraction, sample.strain_step) == (0.2, 2e-3)
    assert sample.loading == Loading("solid_fraction", 0.7, states=4, unloading=True)
    assert (sample.seeds, sample.refined_seeds, sample.ranks) == ((7, 3), 1, 2)
    # 2 E / (3 (1 - nu^2))
    assert (sample.law.name, sample.law.stiffness) == ("hertz", pytest.approx(8 / 3))


def test_sample_needs_no_seeds_and_ignores_what_only_the_report_says():
    few = {key: value for key, value in SETTINGS.items() if "seeds" not in key}
    sample = sample_of({**few, "quality": "fine", "allow_unrepresentative": True})
    assert (sample.seeds, sample.refined_seeds) == ((), 0)
    assert not hasattr(sample, "quality")


def test_settings_of_a_checked_configuration_are_those_of_a_sample():
    section = {"grading": SECTIONS[0], "grains": 90, "seeds": 3, "boundary": "periodic"}
    loading = {"mean_stress": [1e5, 1e6], "quality": "draft"}
    config = checked_config({"samples": {"mine": {**section, "loading": loading}}})
    sample = sample_of(config.samples["mine"].settings(refinement=2))
    assert (sample.periodic, sample.grains, sample.seeds) == (True, 90, (1, 2, 3))
    assert sample.loading.stresses == [1e5, 1e6]
    # Half of a draft's.
    assert sample.strain_step == pytest.approx(3.4e-3)
    assert sample.state_tolerance == 1e-6
    assert (sample.law.name, sample.law.stiffness) == ("linear", 1e6)


def test_sample_whose_file_is_missing_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sieve = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm", "file": "no.csv"}
    with pytest.raises(GradingError, match=r"no\.csv: there is no such file"):
        sample_of({**SETTINGS, "grading": sieve})
