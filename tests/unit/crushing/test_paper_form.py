"""The paper's form: closed forms through histories, and what is refused in which words."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.crushing.admissibility import least_hardening_exponent
from branchcrush.crushing.curves import LinearCurve
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.evolution import evolve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.paper_form import admissibility_problem, reference_energy
from branchcrush.crushing.resistance import CriticalEnergy

THETA, CRITICAL_ENERGY = 0.6, 1e-3
PAPER, EINAV = ModelForm(LinearCurve(THETA)), CriticalEnergy(CRITICAL_ENERGY, 2.0)

quick = settings(max_examples=20, deadline=None)  # a busy machine must not fail a test
exponents = st.floats(0.5, 3.0)


# --- closed forms --------------------------------------------------------------------------------


@quick
@given(exponent=exponents, stretch=st.floats(1.0, 3.0))
def test_stress_of_a_power_law_beyond_yield(exponent, stretch):
    onset = ((exponent + 1) * CRITICAL_ENERGY / THETA) ** (1 / (exponent + 1))
    strain = min(stretch * onset, 0.45)
    strain = max(strain, onset)
    expected = (1 - THETA) * strain**exponent + THETA * onset ** ((exponent + 1) / 2) * strain ** (
        (exponent - 1) / 2
    )
    path = evolve([strain], PAPER, PowerLawElasticity(1.0, exponent), EINAV)
    assert_allclose(path.stress, expected, rtol=1e-11)


@pytest.mark.parametrize("hardening", [1.5, 2.0, 3.0])
def test_crushing_and_its_dissipation_for_any_hardening(hardening):
    # C = 1 - (Psi_y/Psi_0)^(1/s), and the integral of E_c0/(1 - C)^s over C.
    path = evolve([0.1], PAPER, PowerLawElasticity(1.0, 1.0), CriticalEnergy(1e-3, hardening))
    crushing = 1.0 - (1e-3 / THETA / 0.005) ** (1.0 / hardening)
    assert_allclose(path.crushing, crushing, rtol=1e-12)
    lost = 1e-3 * ((1.0 - crushing) ** (1.0 - hardening) - 1.0) / (hardening - 1.0)
    assert_allclose(path.dissipated, lost, rtol=1e-11)


def test_dissipation_where_the_hardening_is_one_is_a_logarithm():
    path = evolve([0.1], PAPER, PowerLawElasticity(1.0, 1.0), CriticalEnergy(1e-3, 1.0))
    assert_allclose(path.dissipated, -1e-3 * np.log(1.0 - path.crushing), rtol=1e-11)


def test_unloading_is_elastic_and_reloading_resumes_where_it_left():
    law = PowerLawElasticity(1.0, 1.0)
    path = evolve([0.1, 0.04, 0.0, 0.1, 0.2], PAPER, law, EINAV)
    softened = (1 - THETA * path.crushing[0]) * np.array([0.1, 0.04, 0.0, 0.1])
    assert_allclose(path.stress[:4], softened, rtol=1e-12)
    assert_array_equal(path.dissipated[:4], path.dissipated[0])
    assert_allclose(path.crushing[4], evolve([0.2], PAPER, law, EINAV).crushing[0], rtol=1e-12)


def test_without_release_there_is_no_crushing():
    path = evolve([0.1, 0.4], ModelForm(LinearCurve(0.0)), PowerLawElasticity(1.0, 1.5), EINAV)
    assert_array_equal(path.crushing, 0.0)
    assert_array_equal(path.dissipated, 0.0)
    assert_allclose(path.work, np.array([0.1, 0.4]) ** 2.5 / 2.5, rtol=1e-12)


@quick
@given(share=st.floats(0.05, 0.99), exponent=exponents, surplus=st.sampled_from([-0.05, 0.05]))
def test_stress_rises_at_onset_if_the_resistance_hardens_enough(share, exponent, surplus):
    bound = share * (1 + 1 / exponent)
    form, law = ModelForm(LinearCurve(share)), PowerLawElasticity(1.0, exponent)
    onset = ((exponent + 1) * CRITICAL_ENERGY / share) ** (1 / (exponent + 1))
    assert_allclose(least_hardening_exponent(form, law, onset), bound, rtol=1e-6)
    resistance = CriticalEnergy(CRITICAL_ENERGY, bound * (1 + surplus))
    if onset < 0.4:
        path = evolve(onset * np.array([1.0, 1.0 + 1e-6]), form, law, resistance)
        assert np.sign(np.diff(path.stress)[0]) == np.sign(surplus)


# --- moments -------------------------------------------------------------------------------------


def test_the_reference_energy_is_the_energy_over_the_mean_split():
    lengths, weights = np.array([1.0, 2.0, 4.0]), np.array([0.5, 0.3, 0.2])
    split = (lengths / 2.0) ** 3
    psi_r = reference_energy(7.0, weights @ lengths**3, exponent=3, reference_length=2.0)
    assert_allclose(psi_r, 7.0 / (weights @ split), rtol=1e-14)


@pytest.mark.parametrize("length", [1e-4, 0.3, 10.0])
def test_the_reference_length_cancels(length):
    # Eq. 14 with the moment of Eq. 15, theta = 1 - 2/5 as above.
    psi_r = reference_energy(3.0, 5.0, 2.7, length)
    moment = 0.75 * 5.0 + 0.25 * 2.0
    energy = ModelForm(LinearCurve(THETA)).factor.value(0.25) * 3.0
    assert_allclose(psi_r * moment / length**2.7, energy, rtol=1e-12)


def test_an_ultimate_grading_that_is_coarser_is_told_in_words_with_what_to_change():
    message = admissibility_problem(2e-6, 3e-6)
    assert "the ultimate grading is coarser than the initial one" in message
    assert "1.5 times as large" in message
    assert "crushing would create energy" in message
    assert "Raise thermodynamics.ultimate_alpha" in message
    assert "a smaller grading.min" in message


def test_an_ultimate_grading_that_is_as_fine_or_finer_is_no_problem():
    assert admissibility_problem(2e-6, 2e-6) is None
    assert admissibility_problem(2e-6, 1e-9) is None


@pytest.mark.parametrize(
    "moments", [(np.nan, 1), (1, np.nan), (np.inf, 1), (1, np.inf), (1, 0), (0, 0), (1, -1)]
)
def test_unusable_moments_are_refused(moments):
    assert "positive and finite" in admissibility_problem(*moments)
