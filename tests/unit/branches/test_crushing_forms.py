"""The forms of the crushing model for two gradings, against numbers known by other means."""

from dataclasses import replace

import numpy as np
import pytest

from branchcrush.branches import mixing
from branchcrush.branches.crushing_forms import FORM_LABELS, crushing_forms
from branchcrush.branches.mixing import mixing_path
from branchcrush.branches.nodes import CELLS
from branchcrush.branches.parking import parking_contacts
from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import mixture, single
from branchcrush.packings.contact_laws import HertzContact, LinearContact

# Of diameters from 1 to 2 mm, and from 0.2 to 2 mm.
COARSE = uniform(0.5e-3, 1.0e-3, "number")
FINE = fractal(0.1e-3, 1.0e-3, 2.6)
LINEAR, HERTZ = LinearContact(1e6), HertzContact(70e9)
CRUSHING = np.array([0.0, 1 / 8, 1 / 4, 3 / 8, 1 / 2, 3 / 4, 1.0])


@pytest.fixture(scope="module")
def path():
    return mixing_path(COARSE, FINE, LINEAR, crushing=CRUSHING)


def test_jamming_points_of_the_mixtures(path):
    # Of a rod map of its own, with other nodes.
    known = [0.65149, 0.68615, 0.72079, 0.75101, 0.76504, 0.75969, 0.74335]
    np.testing.assert_allclose(path.solid_fraction, known, atol=2e-4)


def test_stiffness_of_the_mixtures(path):
    known = [1.0, 1.20, 1.53, 2.26, 3.83, 4.73, 4.90]
    np.testing.assert_allclose(path.modulus / path.modulus[0], known, atol=0.01)
    hertz = mixing_path(COARSE, FINE, HERTZ, crushing=CRUSHING)
    known = [1.0, 1.04, 1.16, 1.45, 2.03, 2.10, 1.86]
    np.testing.assert_allclose(hertz.modulus / hertz.modulus[0], known, atol=0.01)


def test_fines_of_a_mixture_carry_load_late(path):
    assert path.bearing_number[0] == pytest.approx(0.95, abs=0.01)
    assert path.bearing_number[1] == pytest.approx(0.24, abs=0.05)
    assert path.finest[1] > 0.3e-3 > path.finest[-1]


def test_a_grading_mixed_with_itself_stays(path):
    same = mixing_path(COARSE, COARSE, LINEAR, crushing=np.array([0.0, 0.4, 1.0]))
    for values in (same.solid_fraction, same.modulus, same.contact_diameter, same.bearing_mass):
        np.testing.assert_allclose(values, values[0], rtol=1e-9)


def test_parking_needs_half_the_radii_that_rods_take(monkeypatch):
    sizes = []

    def parked(radius, share):
        sizes.append(radius.size)
        return parking_contacts(radius, share)

    monkeypatch.setattr(mixing, "parking_contacts", parked)
    at = np.array([0.0, 0.3, 1.0])
    found = mixing_path(COARSE, FINE, LINEAR, network="parking", crushing=at)
    assert max(sizes) < CELLS * 2
    # With twice as many radii of each grading.
    known = [1.0, 1.3278, 4.7119]
    np.testing.assert_allclose(found.modulus / found.modulus[0], known, rtol=5e-4)


def test_driving_force_ends_just_below_the_densest_mixture():
    moving = crushing_forms(mixing_path(COARSE, FINE, LINEAR), COARSE, FINE, 3.0)["moving_jamming"]
    law, strain = PowerLawElasticity(1e9, 1.0), 0.0125
    before, after = (
        float(moving.driving_force(moving.total_strain(strain, at), at, law)) for at in (0.5, 0.6)
    )
    assert before > 0.0 > after
    # Over the pressure, without the factor j of the volume.
    for at, known in ((0.1, 0.40), (0.2, 0.38), (0.3, 0.32), (0.4, 0.19), (0.5, 0.04)):
        force = moving.driving_force(moving.total_strain(strain, at), at, law)
        stress = moving.stress(moving.total_strain(strain, at), at, law)
        assert force * moving.jamming.value(at) / stress == pytest.approx(known, abs=0.015)


def test_density_form_is_that_of_the_mixture_itself(path):
    density = crushing_forms(path, COARSE, FINE, 2.5)["density"]
    for share in (0.2, 0.7):
        mixed = mixture([COARSE, FINE], [1.0 - share, share], "mass")
        # Branches per volume go as grains per volume, 1/<R^3>.
        energy = [
            random_contact_moment(grading, 2.5) / grading.moment(3) for grading in (COARSE, mixed)
        ]
        assert density.factor.value(share) == pytest.approx(energy[1] / energy[0], rel=1e-10)


def test_energy_of_two_sizes_by_hand():
    coarse, fine = single(1.0), single(0.5)
    two = mixing_path(coarse, fine, LINEAR, crushing=np.array([0.0, 0.5, 1.0]))
    forms = crushing_forms(two, coarse, fine, 2.0)
    assert float(forms["paper"].factor.value(1.0)) == pytest.approx(0.25)
    # Eight fine grains for the mass of a coarse one: 8 * (2 * 0.5)^2 against 2^2.
    assert float(forms["density"].factor.value(1.0)) == pytest.approx(2.0)
    # 1 + 8 grains in a half each: pairs of 4, 2.25 and 1, over 4 of one grain.
    halves = (0.25 * 4.0 + 2 * 0.5 * 4.0 * 2.25 + 16.0 * 1.0) / (0.5 + 4.0) / 4.0
    assert float(forms["density"].factor.value(0.5)) == pytest.approx(halves)
    assert float(forms["einav"].factor.value(1.0)) == pytest.approx(0.25)


def test_equal_contacts_are_no_contacts(path):
    forms = crushing_forms(path, COARSE, FINE, 3.0, contacts=lambda radius: 6.0 + 0.0 * radius)
    known = forms["density"].factor.value(CRUSHING)
    np.testing.assert_allclose(forms["measured_contacts"].factor.value(CRUSHING), known, rtol=1e-3)


def test_half_the_contacts_by_hand():
    coarse, fine = single(1.0), single(0.5)
    two = mixing_path(coarse, fine, LINEAR, crushing=np.array([0.0, 0.5, 1.0]))
    forms = crushing_forms(two, coarse, fine, 2.0, contacts=lambda radius: 6.0 * radius)
    # Eight fine grains for a coarse one, half of the contacts each, a quarter of the energy.
    assert float(forms["measured_contacts"].factor.value(1.0)) == pytest.approx(8 * 0.5 / 4)


def test_limiting_density_meets_the_path_at_half(path):
    limiting = crushing_forms(path, COARSE, FINE, 3.0)["tengattini"]
    known = path.solid_fraction[4] / path.solid_fraction[0]
    assert float(limiting.jamming.value(0.5)) == pytest.approx(known, rel=1e-9)


@pytest.mark.parametrize("half", [0.60, 0.64, 0.6400001, 0.6435])
def test_limiting_densities_that_would_not_rise_up_to_half_are_no_form(path, half):
    # Porosity 0.36: the power of 1 - C would be below 0, 0 or so small that all is left for C = 1.
    solid = np.array([0.64, 0.64, 0.64, 0.64, half, 0.65, 0.66])
    forms = crushing_forms(replace(path, solid_fraction=solid), COARSE, FINE, 3.0)
    assert "tengattini" not in forms and "einav" in forms


def test_forms_in_order(path):
    forms = crushing_forms(path, COARSE, FINE, 3.0, contacts=lambda radius: radius)
    assert list(forms) == list(FORM_LABELS)
    for form in forms.values():
        at = np.linspace(0.05, 0.95, 7)
        slope = np.log(form.factor.value(at + 1e-6) / form.factor.value(at - 1e-6)) / 2e-6
        np.testing.assert_allclose(form.factor.log_slope(at), slope, rtol=1e-4, atol=1e-5)
