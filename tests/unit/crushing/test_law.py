"""The crushing law: derivatives taken by differences, values by hand, and refusals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.law import CrushingLaw

quick = settings(max_examples=50, deadline=None)  # a busy machine must not fail a test
exponents = st.floats(0.5, 3.0)
laws = st.builds(CrushingLaw, st.floats(0.05, 0.99), st.floats(1e-4, 1e-2), st.floats(0.8, 4.0))


# --- derivatives of the free energy --------------------------------------------------------------


@quick
@given(law=laws, exponent=exponents, crushing=st.floats(0.0, 0.9), strain=st.floats(0.05, 0.5))
def test_stress_and_driving_force_are_derivatives_of_the_free_energy(
    law, exponent, crushing, strain
):
    elasticity, step = PowerLawElasticity(2.0, exponent, onset_strain=0.02), 1e-5

    def psi(strain, crushing):
        return law.free_energy(crushing, elasticity.energy(strain))

    slope = (psi(strain + step, crushing) - psi(strain - step, crushing)) / (2 * step)
    assert_allclose(law.stress(crushing, elasticity.pressure(strain)), slope, rtol=1e-6)
    slope = (psi(strain, crushing + step) - psi(strain, crushing - step)) / (2 * step)
    assert_allclose(law.driving_force(elasticity.energy(strain)), -slope, rtol=1e-8)


@quick
@given(law=laws, crushing=st.floats(0.01, 0.95))
def test_resistance_is_the_slope_of_the_dissipation(law, crushing):
    step = 1e-5
    ends = law.dissipated_energy([crushing - step, crushing + step])
    assert_allclose(law.resistance(crushing), np.diff(ends)[0] / (2 * step), rtol=1e-5)


# --- values by hand ------------------------------------------------------------------------------


def test_dissipation_of_known_hardening():
    # s = 1: -ln(1 - C); s = 2: 1/(1 - C) - 1; each times E_c0 = 3.
    assert_allclose(CrushingLaw(0.5, 3.0, 1.0).dissipated_energy(0.5), 3.0 * np.log(2.0))
    assert_allclose(CrushingLaw(0.5, 3.0, 2.0).dissipated_energy([0.0, 0.75]), [0.0, 9.0])


def test_crushing_begins_at_the_yield_energy_and_grows_with_the_largest():
    # theta Psi_0 over E_c0 is 1 at Psi_0 = 4, 8 at 32: C = 1 - 8^(-1/3) = 1/2.
    law = CrushingLaw(0.25, 1.0, 3.0)
    assert law.yield_energy == 4.0
    assert_allclose(law.equilibrium_crushing([0.0, 4.0, 32.0]), [0.0, 0.0, 0.5], atol=1e-15)
    assert_allclose(law.resistance(0.5), 8.0)
    # p = 2 eps^3, Psi_0 = eps^4/2 is 4 at the fourth root of 8.
    assert_allclose(law.yield_strain(PowerLawElasticity(2.0, 3.0)), 8.0**0.25)


def test_least_hardening_of_linear_and_hertzian_elasticity():
    assert CrushingLaw(0.6, 1.0, 2.0).least_hardening_exponent(1.0) == pytest.approx(1.2)
    assert CrushingLaw(0.6, 1.0, 2.0).least_hardening_exponent(1.5) == pytest.approx(1.0)


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, np.inf])
def test_critical_energy_and_hardening_must_be_positive_and_finite(wrong):
    for parameters in ((wrong, 2.0), (1e-3, wrong)):
        with pytest.raises(ValueError, match="positive and finite"):
            CrushingLaw(0.6, *parameters)
