"""The forms that a sample has: numbers known by other means, and what is said of them."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.branches.crushing_forms import crushing_forms
from branchcrush.config.crushing import Thermodynamics
from branchcrush.crushing.admissibility import admissibility, force_over_stress
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.yield_line import compression_line
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import mixture, single
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.samples.crushing_model import resistance_of
from branchcrush.samples.forms_of_sample import degenerate, forms_of, untested

NO_NUMBERS = pd.DataFrame({"reason": ["no contacts"]})
LINEAR, HERTZ = LinearContact(1e6), HertzContact(70e9)
LIMIT = {"resistance": "elastic_strain"}


def forms_from(initial, ultimate, exponent=3.0, law=LINEAR, **keys):
    settings = Thermodynamics(**keys).model_dump()
    return forms_of(initial, ultimate, exponent, law, NO_NUMBERS, settings)


def resistance(forms, law, **keys):
    return resistance_of(forms, law, Thermodynamics(**LIMIT, **keys).model_dump())


@pytest.fixture(scope="module")
def mixtures():
    """Diameters from 1 to 2 mm, toward a fractal of 0.2 to 2 mm."""
    return forms_from(uniform(0.5e-3, 1e-3), fractal(0.1e-3, 1e-3, 2.6))


@pytest.fixture(scope="module")
def wide():
    return forms_from(uniform(5e-6, 1e-3), fractal(5e-6, 1e-3, 2.6), exponent=3.1)


def test_compression_line_of_mixtures_at_a_constant_elastic_strain(mixtures):
    # Prototype with other nodes: void ratio, and stress over that of yield.
    form, law = mixtures.made["moving_jamming"], PowerLawElasticity(1e9, 1.0)
    limit, at = resistance(mixtures, LINEAR), np.array([0.0, 0.1, 0.2, 0.3, 0.4, 0.5])
    line = compression_line(form, at, law, limit, mixtures.path.solid_fraction[0])
    known = [0.516, 0.454, 0.396, 0.346, 0.307, 0.291]
    np.testing.assert_allclose(line.void_ratio, known, atol=1e-3)
    known = [1.0, 1.15, 1.38, 1.74, 2.55, 3.83]
    np.testing.assert_allclose(line.stress / line.stress[0], known, atol=0.01)


def test_driving_force_of_mixtures_and_the_resistance_that_it_implies(mixtures):
    form, law = mixtures.made["moving_jamming"], PowerLawElasticity(1e9, 1.0)
    at = np.array([0.02, 0.1, 0.2, 0.3, 0.35, 0.45, 0.5, 0.55, 0.6])
    force = force_over_stress(form, law, 0.0125, at) * form.jamming.value(at)
    known = [0.41, 0.40, 0.38, 0.32, 0.27, 0.09, 0.04, 0.0, -0.03]
    np.testing.assert_allclose(force, known, atol=0.01)
    limit = resistance(mixtures, LINEAR)
    implied = limit.critical_force(np.array([0.0, 0.1, 0.2, 0.3, 0.35]), form, law)
    np.testing.assert_allclose(implied[1:] / implied[0], [1.08, 1.18, 1.23, 1.19], atol=0.015)
    found = admissibility(form, law, limit, 0.1)
    assert found.costs == ((pytest.approx(0.545, abs=0.002), 1.0),)
    assert "the densest mixture is at C = 0.55" in found.sentences[0]


@pytest.mark.parametrize(
    ("law", "strength", "power"),
    [(LINEAR, 1.0, 0.0), (LINEAR, 2.0, -1.0), (LINEAR, 0.5, 0.5), (HERTZ, 1.5, -1.0)],
)
def test_elastic_strain_of_crushing_goes_with_the_size_at_contacts(mixtures, law, strength, power):
    limit = resistance(mixtures, law, strength_exponent=strength, elastic_strain=0.02)
    diameter = mixtures.path.contact_diameter
    expected = 0.02 * (diameter / diameter[0]) ** power
    form, elastic = mixtures.made["paper"], PowerLawElasticity(1.0, 1.0)
    found = limit.yield_strain(mixtures.path.crushing, form, elastic)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_the_published_gap_is_denser(mixtures):
    published = forms_from(uniform(0.5e-3, 1e-3), fractal(0.1e-3, 1e-3, 2.6), rod_gap=0.7654)
    assert published.path.solid_fraction[0] == pytest.approx(0.6549, abs=3e-4)
    assert mixtures.path.solid_fraction[0] == pytest.approx(0.6515, abs=3e-4)


def test_a_form_whose_energy_rises_says_from_which_exponent_on_it_would_not(mixtures):
    (sentence,) = mixtures.sentences["density"]
    words, number = sentence.split(" from ")
    assert words == "This form would be admissible with an exponent n of the energy split"
    exponent = float(number.removesuffix(" on."))
    pair, at = (uniform(0.5e-3, 1e-3), fractal(0.1e-3, 1e-3, 2.6)), np.linspace(0.0, 0.99, 100)
    below, above = (
        crushing_forms(mixtures.path, *pair, n)["density"].factor.log_slope(at).max()
        for n in (exponent - 0.05, exponent + 0.05)
    )
    assert below > 0.0 > above


def test_forms_that_are_missing_say_why(mixtures):
    assert mixtures.missing == {"measured_contacts": "no contacts"}
    assert "measured_contacts" not in mixtures.made


def test_limiting_densities_are_left_out_where_mixtures_jam_looser():
    # Two sizes at their densest.
    dense = mixture([single(1e-3), single(0.1e-3)], [0.7, 0.3], "mass")
    looser = forms_from(dense, fractal(0.1e-3, 1e-3, 2.0))
    assert "jam looser" in looser.missing["tengattini"]
    assert "coarser" in looser.missing["paper"]
    assert not {"paper", "tengattini"} & set(looser.made)


def test_a_grading_that_is_the_ultimate_one_already():
    gouge = fractal(0.2e-3, 1e-3, 2.6)
    numbers = pd.DataFrame(
        {"state": 0, "mean_radius_m": [0.2e-3, 0.5e-3, 1e-3], "contact_number": [2.0, 7.0, 12.0]}
    )
    same = forms_of(gouge, gouge, 3.0, LINEAR, numbers, Thermodynamics().model_dump())
    # Nothing is asked of an exponent, and no power tells how limiting densities rise.
    assert same.sentences == {}
    assert list(same.missing) == ["tengattini"]
    assert "hardly denser up to C = 1/2" in same.missing["tengattini"]
    law, limit = PowerLawElasticity(1e9, 1.5), resistance(same, LINEAR)
    for form in same.made.values():
        found = admissibility(form, law, limit, 0.2)
        assert found.admissible and found.sentences[0].startswith("Crushing changes nothing")


def test_sizes_farther_apart_than_was_tested_are_told_with_their_stiffness(wide, mixtures):
    told = untested(wide, LINEAR)
    assert told.startswith("The largest grains are 200 times the smallest; beyond 20 no form is")
    assert "and up to 630 times beyond: with one stiffness of all contacts" in told
    assert untested(mixtures, LINEAR) is None


def test_the_hard_case_is_admissible_up_to_where_fines_carry_load(wide):
    form, law = wide.made["moving_jamming"], PowerLawElasticity(5e8, 1.5)
    found = admissibility(form, law, resistance(wide, LINEAR), 0.2)
    assert 0.55 < found.costs[0][0] < 0.6
    assert "fines begin to carry load" in found.sentences[0]


def test_a_degenerate_share_is_told(wide):
    theta = float(wide.made["paper"].factor.theta)
    assert theta > 0.99 and "all but 9e-06 of the elastic energy" in degenerate(theta)
    assert degenerate(0.99) is None
