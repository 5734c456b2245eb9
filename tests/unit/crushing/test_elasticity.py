"""The power law of elasticity, and its fit to paths that follow one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.crushing.elasticity import PowerLawElasticity, fit_elasticity

quick = settings(max_examples=50, deadline=None)  # a busy machine must not fail a test
elasticities = st.builds(
    PowerLawElasticity, st.floats(0.3, 3.0), st.floats(0.5, 3.0), st.floats(-0.05, 0.1)
)


def energies_along(phi, jamming, elasticity):
    return phi / jamming * elasticity.energy(1 - jamming / phi)  # per current volume


# --- the law -------------------------------------------------------------------------------------


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


@pytest.mark.parametrize("wrong", [0.0, -1.0, np.nan, np.inf])
def test_modulus_and_exponent_must_be_positive_and_finite(wrong):
    for parameters in ((wrong, 1.0), (1.0, wrong)):
        with pytest.raises(ValueError, match="positive and finite"):
            PowerLawElasticity(*parameters)


# --- the fit -------------------------------------------------------------------------------------


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
