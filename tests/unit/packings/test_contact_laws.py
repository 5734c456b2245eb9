"""Contact laws: closed forms, and an energy that is the integral of the force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import quad

from branchcrush.packings.contact_laws import (
    HertzContact,
    LinearContact,
    contact_law,
    reduced_radius,
)

LAWS = [LinearContact, HertzContact]
stiffnesses = st.floats(1e-3, 1e12)
radii = st.floats(1e-6, 1e3)
shares = st.floats(1e-8, 0.5)


def test_linear_force_is_stiffness_times_overlap_whatever_the_radius():
    law = LinearContact(1e6)
    assert law.force(2e-6, 1e-3) == law.force(2e-6, 1.0) == 2.0
    assert law.energy(2.0, 1e-3) == law.energy(2.0, 1.0) == 2e-6


def test_hertz_force_is_that_of_the_textbook():
    # Johnson's F = 4/3 E* sqrt(R*) overlap^(3/2): two like spheres of 1 mm, glass, 1 micrometre.
    young, poisson = 70e9, 0.2
    modulus = 1.0 / (2.0 * (1.0 - poisson**2) / young)
    law = HertzContact.of_material(young, poisson)
    assert_allclose(law.stiffness, 4.0 / 3.0 * modulus, rtol=1e-15)
    force = 4.0 / 3.0 * modulus * (0.5e-3) ** 0.5 * 1e-9
    assert_allclose(law.force(1e-6, 0.5e-3), force, rtol=1e-14)
    assert_allclose(law.energy(force, 0.5e-3), 0.4 * force * 1e-6, rtol=1e-14)


def test_hertz_radius_of_contact_and_overlap_go_together():
    # a^2 = R* overlap and F = 4 E* a^3/(3 R*): another way to the same force.
    law, reduced, overlap = HertzContact(3e9), 2e-4, 5e-6
    contact_radius = np.sqrt(reduced * overlap)
    assert_allclose(law.force(overlap, reduced), 3e9 * contact_radius**3 / reduced, rtol=1e-14)


def test_no_overlap_is_no_force():
    for law in LAWS:
        assert law(1e6).force(0.0, 1.0) == law(1e6).energy(0.0, 1.0) == 0.0
    # Rounding may leave a listed contact just open; a power of 3/2 would not be a number.
    assert HertzContact(1e6).force(-1e-20, 1.0) == 0.0


@pytest.mark.parametrize("law", LAWS)
@given(stiffness=stiffnesses, reduced=radii, share=shares)
def test_energy_is_the_integral_of_the_force(law, stiffness, reduced, share):
    law, overlap = law(stiffness), share * reduced
    work, _ = quad(lambda x: law.force(x * overlap, reduced), 0.0, 1.0, epsabs=0, epsrel=1e-11)
    assert_allclose(law.energy(law.force(overlap, reduced), reduced), work * overlap, rtol=1e-9)


@pytest.mark.parametrize("law", LAWS)
@given(stiffness=stiffnesses, reduced=radii, share=shares, factor=st.floats(1.01, 100.0))
def test_force_and_energy_grow_with_their_powers(law, stiffness, reduced, share, factor):
    law, overlap = law(stiffness), share * reduced
    one, other = law.force(overlap, reduced), law.force(factor * overlap, reduced)
    assert_allclose(other, factor**law.exponent * one, rtol=1e-12)
    energies = law.energy(other, reduced), law.energy(one, reduced)
    assert_allclose(energies[0], factor ** (law.exponent + 1.0) * energies[1], rtol=1e-12)


@pytest.mark.parametrize("law", LAWS)
@given(stiffness=stiffnesses, reduced=radii, share=shares, factor=st.floats(1e-3, 1e3))
def test_stiffness_scales_force_and_energy(law, stiffness, reduced, share, factor):
    overlap, soft, stiff = share * reduced, law(stiffness), law(factor * stiffness)
    force = soft.force(overlap, reduced)
    assert_allclose(stiff.force(overlap, reduced), factor * force, rtol=1e-13)
    assert_allclose(
        stiff.energy(factor * force, reduced), factor * soft.energy(force, reduced), rtol=1e-12
    )


@given(radii, radii)
def test_reduced_radius_is_the_inverse_of_the_sum_of_curvatures(one, other):
    reduced = reduced_radius(one, other)
    assert_allclose(1.0 / reduced, 1.0 / one + 1.0 / other, rtol=1e-13)
    assert reduced == reduced_radius(other, one)
    assert reduced <= min(one, other)


def test_a_plane_wall_is_a_sphere_without_end():
    assert_allclose(reduced_radius(2e-3, 1e12), 2e-3, rtol=1e-14)


@pytest.mark.parametrize("law", LAWS)
def test_arrays_are_taken_element_by_element(law):
    law, overlap, reduced = law(2e6), np.array([0.0, 1e-6, 3e-5]), np.array([1e-3, 2e-3, 5e-4])
    force = law.force(overlap, reduced)
    assert_array_equal(force, [law.force(*pair) for pair in zip(overlap, reduced, strict=True)])
    energy = law.energy(force, reduced)
    assert_array_equal(energy, [law.energy(*pair) for pair in zip(force, reduced, strict=True)])


def test_a_config_section_names_the_law():
    assert contact_law("linear", normal_stiffness=3.0) == LinearContact(3.0)
    hertz = contact_law("hertz", young_modulus=3.0, poisson_ratio=0.5)
    assert hertz == HertzContact.of_material(3.0, 0.5)
    assert (hertz.name, LinearContact(1.0).name) == ("hertz", "linear")
