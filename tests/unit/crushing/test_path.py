"""Paths against closed forms, the balance of energy, and what crushing may never do."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.law import CrushingLaw
from branchcrush.crushing.path import crushing_path
from branchcrush.errors import AdmissibilityError

THETA, CRITICAL_ENERGY, HARDENING = 0.6, 1e-3, 2.0
EINAV = CrushingLaw(THETA, CRITICAL_ENERGY, HARDENING)

quick = settings(max_examples=50, deadline=None)  # a busy machine must not fail a test
shares = st.floats(0.05, 0.99)
exponents = st.floats(0.5, 3.0)
strain_paths = st.lists(st.floats(-0.1, 0.5), min_size=1, max_size=12)
laws = st.builds(CrushingLaw, shares, st.floats(1e-4, 1e-2), st.floats(0.8, 4.0))
elasticities = st.builds(PowerLawElasticity, st.floats(0.3, 3.0), exponents, st.floats(-0.05, 0.1))


def path_of(strain, elasticity, law):
    return crushing_path(strain, elasticity, law.theta, law.critical_energy, law.hardening_exponent)


def assert_balanced(path, rtol=1e-8):
    rounding = rtol * np.abs(path.work).max() + 1e-300
    assert_allclose(path.work, path.stored + path.dissipated, rtol=rtol, atol=rounding)


class StiffeningElasticity:
    """Psi_0 = eps^2/2 + 3 eps^4: not a power law, and with the inverse in closed form."""

    def pressure(self, strain):
        return np.maximum(strain, 0) + 12 * np.maximum(strain, 0) ** 3

    def energy(self, strain):
        return np.maximum(strain, 0) ** 2 / 2 + 3 * np.maximum(strain, 0) ** 4

    def strain_at_energy(self, energy):
        return np.sqrt((np.sqrt(0.25 + 12 * np.asarray(energy)) - 0.5) / 6)


# --- closed forms, s = 2, A = 1 ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("exponent", "yield_strain", "strain", "crushing", "stress"),
    [
        (1.0, 0.05773502691896258, 0.1, 0.42264973081037427, 0.07464101615137755),
        (1.5, 0.11166459711038097, 0.2, 0.517378256129888, 0.06167728828111),
        (2.0, 0.17099759466766973, 0.2, 0.209430584957905, 0.034973665961010),
    ],
)
def test_closed_forms(exponent, yield_strain, strain, crushing, stress):
    elasticity = PowerLawElasticity(1.0, exponent)
    path = path_of([yield_strain / 2, strain], elasticity, EINAV)
    assert_allclose(EINAV.yield_strain(elasticity), yield_strain, rtol=1e-12)
    assert_allclose(path.crushing, [0.0, crushing], rtol=1e-12)
    assert_allclose(path.stress, [(yield_strain / 2) ** exponent, stress], rtol=1e-12)


def test_closed_energies_of_the_linear_law():
    path = path_of([0.1], PowerLawElasticity(1.0, 1.0), EINAV)
    assert_allclose(path.dissipated, [7.320508075688773e-4], rtol=1e-12)
    assert_allclose(path.stored, [3.732050807568878e-3], rtol=1e-12)
    assert_allclose(path.work, [4.464101615137755e-3], rtol=1e-12)
    assert_allclose(path.driving_force, [3e-3], rtol=1e-12)
    assert_allclose(path.resistance, [3e-3], rtol=1e-12)


@quick
@given(exponent=exponents, stretch=st.floats(1.0, 20.0))
def test_stress_of_a_power_law_beyond_yield(exponent, stretch):
    elasticity = PowerLawElasticity(1.0, exponent)
    onset = ((exponent + 1) * CRITICAL_ENERGY / THETA) ** (1 / (exponent + 1))
    strain = stretch * onset
    expected = (1 - THETA) * strain**exponent + THETA * onset ** ((exponent + 1) / 2) * strain ** (
        (exponent - 1) / 2
    )
    assert_allclose(path_of([strain], elasticity, EINAV).stress, expected, rtol=1e-12)


# --- energy balance ------------------------------------------------------------------------------


@quick
@given(elasticity=elasticities, law=laws, strain=strain_paths)
def test_work_is_stored_plus_dissipated_on_any_path(elasticity, law, strain):
    assert_balanced(path_of(strain, elasticity, law))


@pytest.mark.parametrize("hardening", [0.8, 1.0, 1.0 + 1e-9, 2.0, 3.5])
@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
@pytest.mark.parametrize(
    "strain",
    [
        np.linspace(0.0, 0.5, 40),
        [0.3, 0.0],
        [0.3, 0.1, 0.25, 0.0, 0.4, -0.1, 0.5, 0.5],
        [-0.05, 0.02, 0.45],
    ],
    ids=["loading", "unloading", "reloading", "from below the onset"],
)
def test_work_is_stored_plus_dissipated(strain, exponent, hardening):
    law = CrushingLaw(THETA, CRITICAL_ENERGY, hardening)
    path = path_of(strain, PowerLawElasticity(1.0, exponent), law)
    assert path.dissipated[-1] > 0
    assert_balanced(path, rtol=1e-10)


@quick
@given(law=laws, strain=strain_paths)
def test_any_elastic_energy_will_do(law, strain):
    assert_balanced(path_of(strain, StiffeningElasticity(), law))


def test_work_agrees_with_fine_trapezia():
    strain = np.concatenate([np.linspace(0, 0.2, 4001), np.linspace(0.2, 0.05, 2001)])
    path = path_of(strain, PowerLawElasticity(1.0, 1.5), EINAV)
    trapezia = np.sum((path.stress[1:] + path.stress[:-1]) / 2 * np.diff(strain))
    assert_allclose(path.work[-1], trapezia, rtol=1e-6)


# --- irreversibility -----------------------------------------------------------------------------


@quick
@given(elasticity=elasticities, law=laws, strain=strain_paths)
def test_crushing_never_decreases_and_waits_for_the_largest_energy(elasticity, law, strain):
    path = path_of(strain, elasticity, law)
    assert np.all(np.diff(path.crushing) >= 0)
    assert np.all(np.diff(path.dissipated) >= 0)
    assert np.all((path.crushing >= 0) & (path.crushing < 1))
    largest = np.maximum.accumulate(path.elastic_energy)
    waiting = np.flatnonzero(path.elastic_energy[1:] <= largest[:-1])
    assert_array_equal(path.crushing[waiting + 1], path.crushing[waiting])


@quick
@given(elasticity=elasticities, law=laws, strain=strain_paths)
def test_the_driving_force_never_exceeds_the_resistance(elasticity, law, strain):
    path = path_of(strain, elasticity, law)
    excess = path.driving_force - path.resistance
    assert np.all(excess <= 1e-12 * path.resistance)
    growing = np.diff(path.crushing, prepend=0.0) > 0  # and y dC = 0: it grows only on the surface
    assert_allclose(excess[growing], 0.0, atol=1e-12 * path.resistance.max())


def test_unloading_is_elastic_and_reloading_resumes_where_it_left():
    elasticity = PowerLawElasticity(1.0, 1.0)
    path = path_of([0.1, 0.04, 0.0, 0.1, 0.2], elasticity, EINAV)
    softened = (1 - THETA * path.crushing[0]) * np.array([0.1, 0.04, 0.0, 0.1])
    assert_allclose(path.stress[:4], softened, rtol=1e-14)
    assert_array_equal(path.dissipated[:4], path.dissipated[0])
    assert_allclose(path.crushing[4], path_of([0.2], elasticity, EINAV).crushing[0], rtol=1e-14)


def test_without_release_there_is_no_crushing():
    path = crushing_path([0.1, 0.5], PowerLawElasticity(1.0, 1.5), 0.0, CRITICAL_ENERGY, 2.0)
    assert_array_equal(path.crushing, 0.0)
    assert_array_equal(path.dissipated, 0.0)
    assert_allclose(path.work, path.elastic_energy, rtol=1e-12)
    assert np.isinf(CrushingLaw(0.0, CRITICAL_ENERGY, 2.0).yield_energy)


@quick
@given(share=shares, exponent=exponents, surplus=st.sampled_from([-0.05, -0.01, 0.01, 0.05]))
def test_stress_rises_at_onset_if_the_resistance_hardens_enough(share, exponent, surplus):
    bound = share * (1 + 1 / exponent)
    law = CrushingLaw(share, CRITICAL_ENERGY, bound * (1 + surplus))
    assert_allclose(law.least_hardening_exponent(exponent), bound, rtol=1e-14)
    elasticity = PowerLawElasticity(1.0, exponent, onset_strain=0.03)
    onset = law.yield_strain(elasticity)
    strain = onset + (onset - 0.03) * np.array([0.0, 1e-6])
    rise = np.diff(path_of(strain, elasticity, law).stress)[0]
    assert np.sign(rise) == np.sign(surplus)


# --- refused -------------------------------------------------------------------------------------


@pytest.mark.parametrize("share", [-0.1, 1.1, np.nan])
def test_inadmissible_theta_is_refused(share):
    with pytest.raises(AdmissibilityError, match="between 0 and 1"):
        crushing_path([0.1], PowerLawElasticity(1.0, 1.0), share, CRITICAL_ENERGY, HARDENING)


@pytest.mark.parametrize("strain", [[], 0.1, [[0.1]], [0.1, np.nan]])
def test_a_strain_path_is_one_row_of_finite_numbers(strain):
    with pytest.raises(ValueError, match="one row of finite numbers"):
        path_of(strain, PowerLawElasticity(1.0, 1.0), EINAV)
