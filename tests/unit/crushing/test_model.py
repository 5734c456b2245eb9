"""Crushing against closed forms, energy balance, and derivatives taken by differences."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.crushing.elasticity import PowerLawElasticity, fit_elasticity
from branchcrush.crushing.model import CrushingLaw, reference_energy, theta
from branchcrush.crushing.path import crushing_path
from branchcrush.errors import AdmissibilityError, BranchcrushError

THETA, CRITICAL_ENERGY, HARDENING = 0.6, 1e-3, 2.0
EINAV = CrushingLaw(THETA, CRITICAL_ENERGY, HARDENING)

quick = settings(max_examples=50, deadline=None)  # a busy machine must not fail a test
shares = st.floats(0.05, 0.99)
exponents = st.floats(0.5, 3.0)
hardenings = st.floats(0.8, 4.0)
critical_energies = st.floats(1e-4, 1e-2)
strain_paths = st.lists(st.floats(-0.1, 0.5), min_size=1, max_size=12)
laws = st.builds(CrushingLaw, shares, critical_energies, hardenings)
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


# --- energy balance and irreversibility -----------------------------------------------------------


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


# --- derivatives of the free energy ---------------------------------------------------------------


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


# --- branch lengths and theta ---------------------------------------------------------------------


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
    law = CrushingLaw(theta(*moments), CRITICAL_ENERGY, HARDENING)
    # Eq. 14 with the moment of Eq. 15.
    moment = (1 - crushing) * moments[0] + crushing * moments[1]
    assert_allclose(psi_r * moment / l_r**n, law.free_energy(crushing, 3.0), rtol=1e-12)


def test_the_reference_energy_is_the_energy_over_the_mean_split():
    lengths, weights = np.array([1.0, 2.0, 4.0]), np.array([0.5, 0.3, 0.2])
    split = (lengths / 2.0) ** 3
    psi_r = reference_energy(7.0, weights @ lengths**3, n=3, l_r=2.0)
    assert_allclose(psi_r, 7.0 / (weights @ split), rtol=1e-14)
    assert_allclose(psi_r * (weights @ split), 7.0, rtol=1e-14)


def test_theta_is_the_share_of_the_moment_that_is_lost():
    assert_allclose(theta(5.0, 2.0), 0.6, rtol=1e-15)
    assert theta(5.0, 5.0) == 0.0


def test_a_growing_moment_is_refused_with_its_values():
    with pytest.raises(AdmissibilityError, match=r"moment 1\.5, ultimate moment 2\.5.*Choose"):
        theta(1.5, 2.5)
    assert issubclass(AdmissibilityError, BranchcrushError)


@pytest.mark.parametrize(
    "moments", [(np.nan, 1), (1, np.nan), (np.inf, 1), (1, 0), (0, 0), (1, -1)]
)
def test_unusable_moments_are_refused(moments):
    with pytest.raises(AdmissibilityError, match="positive and finite"):
        theta(*moments)


@pytest.mark.parametrize("share", [-0.1, 1.1, np.nan])
def test_inadmissible_theta_is_refused(share):
    with pytest.raises(AdmissibilityError, match="between 0 and 1"):
        crushing_path([0.1], PowerLawElasticity(1.0, 1.0), share, CRITICAL_ENERGY, HARDENING)


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, np.inf])
def test_parameters_must_be_positive_and_finite(wrong):
    for build in (
        lambda: PowerLawElasticity(wrong, 1.0),
        lambda: PowerLawElasticity(1.0, wrong),
        lambda: CrushingLaw(THETA, wrong, HARDENING),
        lambda: CrushingLaw(THETA, CRITICAL_ENERGY, wrong),
    ):
        with pytest.raises(ValueError, match="positive and finite"):
            build()


@pytest.mark.parametrize("strain", [[], 0.1, [[0.1]], [0.1, np.nan]])
def test_a_strain_path_is_one_row_of_finite_numbers(strain):
    with pytest.raises(ValueError, match="one row of finite numbers"):
        path_of(strain, PowerLawElasticity(1.0, 1.0), EINAV)


# --- elasticity and its fit -----------------------------------------------------------------------


@quick
@given(elasticity=elasticities, beyond=st.floats(1e-3, 1.0))
def test_elasticity_inverts_and_differentiates(elasticity, beyond):
    strain = elasticity.onset_strain + beyond
    found = elasticity.strain_at_energy(elasticity.energy(strain))
    assert_allclose(found - elasticity.onset_strain, beyond, rtol=1e-12, atol=1e-15)
    ends = elasticity.energy(strain + 1e-4 * beyond * np.array([-1, 1]))
    assert_allclose(elasticity.pressure(strain), np.diff(ends)[0] / (2e-4 * beyond), rtol=1e-6)


def test_elasticity_carries_nothing_below_the_onset():
    elasticity = PowerLawElasticity(2.0, 1.5, onset_strain=0.1)
    assert_array_equal(elasticity.pressure([-1.0, 0.1]), 0.0)
    assert_array_equal(elasticity.energy([-1.0, 0.1]), 0.0)
    assert elasticity.strain_at_energy(0.0) == 0.1
    assert_allclose(elasticity.energy(0.5), 2.0 * 0.4**2.5 / 2.5, rtol=1e-14)


def energies_along(phi, jamming, elasticity):
    return phi / jamming * elasticity.energy(1 - jamming / phi)  # per current volume


@settings(quick, max_examples=20)
@given(
    jamming=st.floats(0.2, 0.8),
    elasticity=st.builds(PowerLawElasticity, st.floats(1e-3, 1e9), st.floats(0.5, 3.5)),
    first=st.floats(0.001, 0.02),
    span=st.floats(0.05, 0.5),
    loaded=st.integers(4, 30),
    loose=st.integers(0, 4),
)
def test_the_fit_recovers_exact_data(jamming, elasticity, first, span, loaded, loose):
    phi = jamming * (1 + np.linspace(first, first + span, loaded))
    phi = np.concatenate([jamming * np.linspace(0.6, 0.99, loose), phi])[::-1]
    law, found = fit_elasticity(phi, energies_along(phi, jamming, elasticity))
    assert_allclose(
        [law.modulus, law.exponent, found, 1 + law.onset_strain],
        [elasticity.modulus, elasticity.exponent, jamming, 1.0],
        rtol=1e-8,
    )


def test_the_fit_bears_noise_and_stray_contacts_below_jamming():
    rng = np.random.default_rng(1)
    phi = np.linspace(0.60, 0.85, 30)
    energy = energies_along(phi, 0.66, PowerLawElasticity(5.0, 1.5))
    energy = energy * np.exp(0.05 * rng.normal(size=30)) + rng.exponential(1e-6, size=30)
    law, jamming = fit_elasticity(phi, energy)
    assert_allclose(jamming, 0.66, rtol=0.01)
    assert_allclose(law.exponent, 1.5, rtol=0.2)
    assert_allclose(law.pressure(0.15), 5.0 * 0.15**1.5, rtol=0.05)


@pytest.mark.parametrize("seed", [2, 9, 101])  # noise with more than one valley
def test_the_fit_is_the_best_of_all_valleys(seed):
    phi = np.linspace(0.5, 0.8, 20)
    energy = energies_along(phi, 0.66, PowerLawElasticity(5.0, 1.5))
    energy += np.random.default_rng(seed).exponential(3e-3 * energy.max(), 20)

    def misfit(jamming, exponent, modulus=None):
        curve = np.sqrt(energies_along(phi, jamming, PowerLawElasticity(1.0, exponent)))
        root = np.sqrt(modulus) if modulus else curve @ np.sqrt(energy) / (curve @ curve)
        return np.sum((root * curve - np.sqrt(energy)) ** 2)

    law, jamming = fit_elasticity(phi, energy)
    trials = [misfit(j, m) for j in np.linspace(0.55, 0.7, 31) for m in np.linspace(1, 4, 13)]
    assert misfit(jamming, law.exponent, law.modulus) <= min(trials)


def test_the_fit_needs_four_loaded_states():
    phi = np.array([0.50, 0.55, 0.60, 0.66, 0.70, 0.75, 0.75])
    with pytest.raises(ValueError, match="3 states carry load, the fit needs 4"):
        fit_elasticity(phi, energies_along(phi, 0.64, PowerLawElasticity(1.0, 1.0)))
    with pytest.raises(ValueError, match="0 states carry load"):
        fit_elasticity(phi, np.zeros(7))


@pytest.mark.parametrize(
    "energy",
    [
        np.ones(9),
        np.linspace(2, 1, 9),
        np.exp(50 * np.linspace(0.66, 0.8, 9)),
        np.append(1e-6 * np.arange(8), 1.0),
        energies_along(np.linspace(0.66, 0.8, 9), 0.03, PowerLawElasticity(1.0, 8.0)),
    ],
    ids=["constant", "falling", "exponential", "one state carries all", "far from jamming"],
)
def test_the_fit_refuses_what_is_no_power_law(energy):
    with pytest.raises(ValueError, match="no power law"):
        fit_elasticity(np.linspace(0.66, 0.8, 9), energy)


@pytest.mark.parametrize(
    ("phi", "energy"),
    [
        ([0.6, 0.7], [1.0]),
        ([[0.6, 0.7]], [[1.0, 2.0]]),
        ([0.6, np.nan], [0.0, 1.0]),
        ([0.6, 0.7], [0.0, np.inf]),
        ([0.6, 0.7], [-1.0, 1.0]),
        ([0.0, 0.7], [0.0, 1.0]),
    ],
)
def test_the_fit_refuses_unusable_states(phi, energy):
    with pytest.raises(ValueError, match="each state needs"):
        fit_elasticity(phi, energy)
