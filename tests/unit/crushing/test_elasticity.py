"""Elastic laws in closed form: a power of the strain, and a modulus that grows with pressure."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.crushing.elasticity import PowerLawElasticity, pressure_dependent

quick = settings(max_examples=50, deadline=None)  # a busy machine must not fail a test
elasticities = st.builds(
    PowerLawElasticity, st.floats(0.3, 3.0), st.floats(0.5, 3.0), st.floats(-0.05, 0.1)
)


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


@pytest.mark.parametrize(("exponent", "power"), [(0.0, 1.0), (1 / 3, 1.5), (0.5, 2.0), (0.75, 4.0)])
def test_a_modulus_that_grows_with_pressure_is_a_power_law(exponent, power):
    law = pressure_dependent(2e8, exponent, 1e5)
    assert law.exponent == pytest.approx(power, rel=1e-14)
    pressures = np.array([1e3, 1e5, 4e5, 1e7])
    at = law.strain_at_pressure(pressures)
    assert_allclose(law.stiffness(at), 2e8 * (pressures / 1e5) ** exponent, rtol=1e-12)
    assert_allclose(law.pressure(at), pressures, rtol=1e-12)


def test_the_square_root_law_of_soils_by_hand():
    # p = p_0 (K_0 eps/2 p_0)^2 = 1e5 * 10^2, Psi = p eps/3.
    law = pressure_dependent(2e8, 0.5, 1e5, onset_strain=0.02)
    assert_allclose(law.pressure(0.03), 1e7, rtol=1e-12)
    assert_allclose(law.energy(0.03), 1e5 / 3, rtol=1e-12)
    assert law.knots.tolist() == [0.02]


@pytest.mark.parametrize(
    "wrong", [(0.0, 0.5, 1e5), (1e8, 1.0, 1e5), (1e8, -0.1, 1e5), (1e8, 0.5, np.inf)]
)
def test_no_such_modulus(wrong):
    with pytest.raises(ValueError, match="from 0 to below 1"):
        pressure_dependent(*wrong)
