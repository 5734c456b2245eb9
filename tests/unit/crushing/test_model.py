"""The crushing law: derivatives taken by differences, moments of known lengths, and refusals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.model import (
    CrushingLaw,
    admissibility_problem,
    reference_energy,
    theta,
)
from branchcrush.errors import AdmissibilityError, BranchcrushError

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


# --- branch lengths and theta --------------------------------------------------------------------


@quick
@given(
    crushing=st.floats(0, 1),
    initial=st.floats(0.1, 10),
    ratio=st.floats(0.01, 1),
    n=st.floats(1, 5),
    l_r=st.floats(1e-4, 10),
)
def test_the_reference_length_cancels(crushing, initial, ratio, n, l_r):
    moments = (initial, ratio * initial)
    psi_r = reference_energy(3.0, initial, n, l_r)
    law = CrushingLaw(theta(*moments), 1e-3, 2.0)
    # Eq. 14 with the moment of Eq. 15.
    moment = (1 - crushing) * moments[0] + crushing * moments[1]
    assert_allclose(psi_r * moment / l_r**n, law.free_energy(crushing, 3.0), rtol=1e-12)


def test_the_reference_energy_is_the_energy_over_the_mean_split():
    lengths, weights = np.array([1.0, 2.0, 4.0]), np.array([0.5, 0.3, 0.2])
    split = (lengths / 2.0) ** 3
    psi_r = reference_energy(7.0, weights @ lengths**3, exponent=3, reference_length=2.0)
    assert_allclose(psi_r, 7.0 / (weights @ split), rtol=1e-14)
    assert_allclose(psi_r * (weights @ split), 7.0, rtol=1e-14)


def test_theta_is_the_share_of_the_moment_that_is_lost():
    assert_allclose(theta(5.0, 2.0), 0.6, rtol=1e-15)
    assert theta(5.0, 5.0) == 0.0


def test_an_ultimate_grading_that_is_coarser_is_told_in_words_with_what_to_change():
    with pytest.raises(AdmissibilityError) as raised:
        theta(2e-6, 3e-6)
    message = str(raised.value)
    assert "the ultimate grading is coarser than the initial one" in message
    assert "1.5 times as large" in message
    assert "crushing would create energy" in message
    assert "Raise thermodynamics.ultimate_alpha" in message
    assert "a smaller grading.min" in message
    assert admissibility_problem(2e-6, 3e-6) == message
    assert issubclass(AdmissibilityError, BranchcrushError)


def test_an_ultimate_grading_that_is_as_fine_or_finer_is_no_problem():
    assert admissibility_problem(2e-6, 2e-6) is None
    assert admissibility_problem(2e-6, 1e-9) is None


@pytest.mark.parametrize(
    "moments", [(np.nan, 1), (1, np.nan), (np.inf, 1), (1, np.inf), (1, 0), (0, 0), (1, -1)]
)
def test_unusable_moments_are_refused(moments):
    with pytest.raises(AdmissibilityError, match="positive and finite"):
        theta(*moments)


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, np.inf])
def test_critical_energy_and_hardening_must_be_positive_and_finite(wrong):
    for parameters in ((wrong, 2.0), (1e-3, wrong)):
        with pytest.raises(ValueError, match="positive and finite"):
            CrushingLaw(0.6, *parameters)
