"""Elastic laws from the energies of a path: exact data, noise, what is known beforehand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.crushing.elastic_fits import fit_elasticity, interpolated_elasticity
from branchcrush.crushing.elasticity import PowerLawElasticity

quick = settings(max_examples=50, deadline=None)  # a busy machine must not fail a test


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
    with pytest.raises(ValueError, match="of all packings 0 states carry load"):
        fit_elasticity(phi, np.zeros(7))
    with pytest.raises(ValueError, match="1 state carries load"):
        fit_elasticity([0.60, 0.70], [0.0, 1.0])


def test_one_state_of_many_packings_is_one_point_of_the_law():
    phi = np.concatenate([[0.60], 0.70 + 1e-4 * np.arange(8)])
    energy = 50.0 * phi / 0.64 * np.maximum(1.0 - 0.64 / phi, 0.0) ** 2
    with pytest.raises(
        ValueError, match=r"8 states carry load, .* 4 at solid fractions 0\.001 apart"
    ):
        fit_elasticity(phi, energy)
    phi = np.concatenate([phi, [0.71, 0.72, 0.73]])
    energy = 50.0 * phi / 0.64 * np.maximum(1.0 - 0.64 / phi, 0.0) ** 2
    assert fit_elasticity(phi, energy)[1] == pytest.approx(0.64, abs=1e-6)


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


@pytest.mark.parametrize(
    "known", [{"exponent": 1.5}, {"jamming": 0.64}, {"exponent": 1.5, "jamming": 0.64}]
)
def test_what_is_known_is_kept_and_the_rest_found(known):
    phi = np.array([0.60, 0.65, 0.66, 0.68, 0.71, 0.75])
    energy = energies_along(phi, 0.64, PowerLawElasticity(3.0, 1.5))
    law, jamming = fit_elasticity(phi, energy, **known)
    assert_allclose([law.modulus, law.exponent, jamming], [3.0, 1.5, 0.64], rtol=1e-9)
    assert known.get("exponent", law.exponent) == law.exponent
    assert known.get("jamming", jamming) == jamming


def test_a_fixed_exponent_has_the_modulus_of_least_squares():
    # One modulus, closed form: the root of the energy is its root times a curve.
    phi = np.array([0.65, 0.68, 0.70, 0.75])
    energy = energies_along(phi, 0.64, PowerLawElasticity(3.0, 1.6))
    law, _ = fit_elasticity(phi, energy, exponent=1.0, jamming=0.64)
    curve, root = np.sqrt(energies_along(phi, 0.64, PowerLawElasticity(1.0, 1.0))), np.sqrt(energy)
    assert law.exponent == 1.0
    assert_allclose(law.modulus, (curve @ root / (curve @ curve)) ** 2, rtol=1e-12)


def test_states_below_a_known_jamming_point_do_not_count():
    phi = np.array([0.60, 0.62, 0.66, 0.70, 0.75])
    energy = energies_along(phi, 0.59, PowerLawElasticity(3.0, 1.5))
    with pytest.raises(ValueError, match="3 states carry load, the fit needs 4"):
        fit_elasticity(phi, energy, jamming=0.64)


# --- through every state -------------------------------------------------------------------------


def test_the_law_goes_through_every_state():
    phi = np.array([0.75, 0.66, 0.60, 0.70])
    energy = energies_along(phi, 0.64, PowerLawElasticity(3.0, 1.5)) * [1.1, 1.0, 1.0, 0.95]
    law, left_out = interpolated_elasticity(phi, energy, 0.64)
    assert left_out == 0
    assert_allclose(energies_along(phi, 0.64, law), energy, rtol=1e-13)
    assert_allclose(law.strain, 1 - 0.64 / np.array([0.66, 0.70, 0.75]), rtol=1e-14)


def test_states_are_left_out_until_the_pressure_rises():
    phi = np.array([0.645, 0.66, 0.68, 0.70, 0.75])
    energy = energies_along(phi, 0.64, PowerLawElasticity(3.0, 1.5))
    energy[0] = 0.999 * energy[1]  # next to jamming, a packing that is about to rearrange
    law, left_out = interpolated_elasticity(phi, energy, 0.64)
    assert left_out == 1
    assert law.strain[0] == pytest.approx(1 - 0.64 / 0.66)


@pytest.mark.parametrize(
    ("energy", "reason"),
    [
        ([0.0, 0.0, 0.0, 2.0, 3.0], "needs 3 or more states"),
        ([5.0, 4.0, 3.0, 2.0, 1.0], "increase"),
        ([1.0, 5.0, 6.0, 7.0, 8.0], "would not rise"),
    ],
    ids=["few carry load", "falling", "pressure falls"],
)
def test_no_law_goes_through_such_states(energy, reason):
    with pytest.raises(ValueError, match=reason):
        interpolated_elasticity([0.66, 0.67, 0.68, 0.70, 0.75], energy, 0.64)


def test_no_law_without_states_above_jamming():
    with pytest.raises(ValueError, match=r"2 states lie above phi_J = 0\.6900, it needs 3"):
        interpolated_elasticity([0.66, 0.68, 0.70, 0.75], [1.0, 2.0, 3.0, 4.0], 0.69)
    with pytest.raises(ValueError, match=r"1 state lies above phi_J = 0\.7100"):
        interpolated_elasticity([0.66, 0.68, 0.70, 0.75], [1.0, 2.0, 3.0, 4.0], 0.71)
