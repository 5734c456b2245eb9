"""The law through measured energies: derivatives, inverses, and what it does beyond its states."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.crushing.interpolated_elasticity import InterpolatedElasticity

# Means of 16 packings between walls: strain from jamming, energy per volume there [J/m3].
STRAIN = (0.0143, 0.0334, 0.0523, 0.0709, 0.0892, 0.1074, 0.1252, 0.1429, 0.1603, 0.1774, 0.1944)
ENERGY = (9.60e3, 5.33e4, 1.42e5, 2.86e5, 4.89e5, 7.66e5, 1.109e6, 1.543e6, 2.054e6, 2.625e6)
MEASURED = InterpolatedElasticity(STRAIN, (*ENERGY, 3.307e6))
LAWS = (
    MEASURED,
    InterpolatedElasticity((0.01, 0.02, 0.05), (1e3, 5e3, 4.5e4)),
    InterpolatedElasticity((0.1, 0.2, 0.4, 0.8), (1.0, 4.0, 20.0, 90.0)),
)
quick = settings(max_examples=60, deadline=None)  # a busy machine must not fail a test
laws = st.sampled_from(LAWS)


@st.composite
def places(draw):
    """A law and a strain between two of its states, before the first, or beyond the last."""
    law = draw(laws)
    ends = [0.2 * law.strain[0], *law.strain, min(1.5 * law.strain[-1], 0.9)]
    piece = draw(st.integers(0, len(ends) - 2))
    share = draw(st.floats(0.1, 0.9))
    width = ends[piece + 1] - ends[piece]
    return law, ends[piece] + share * width, 0.01 * width


@quick
@given(place=places())
def test_pressure_and_stiffness_are_slopes(place):
    law, strain, step = place
    # Central differences of the sixth order.
    at, weights = strain + step * np.arange(-3, 4), np.array([-1, 9, -45, 0, 45, -9, 1]) / 60
    assert_allclose(law.pressure(strain), weights @ law.energy(at) / step, rtol=1e-8)
    assert_allclose(law.stiffness(strain), weights @ law.pressure(at) / step, rtol=1e-7)


@quick
@given(place=places())
def test_inverses(place):
    law, strain, _ = place
    assert_allclose(law.strain_at_energy(law.energy(strain)), strain, rtol=1e-12)
    assert_allclose(law.strain_at_pressure(law.pressure(strain)), strain, rtol=1e-12)


@pytest.mark.parametrize("law", LAWS)
def test_energies_are_met_and_the_pressure_rises_without_a_jump(law):
    assert_allclose(law.energy(law.strain), law.energy_at, rtol=1e-13)
    assert_allclose(law.strain_at_energy(law.energy_at), law.strain, rtol=1e-12)
    strain = np.linspace(0.0, 1.2 * law.strain[-1], 5001)
    pressure = law.pressure(strain)
    assert pressure[0] == 0.0 and (np.diff(pressure) > 0).all()
    at = np.array(law.strain)
    assert_allclose(law.pressure(at * (1 - 1e-13)), law.pressure(at * (1 + 1e-13)), rtol=1e-11)


def test_a_power_law_is_met_exactly():
    law = InterpolatedElasticity((0.1, 0.2, 0.4), (0.1**2.5, 0.2**2.5, 0.4**2.5))
    strain = np.array([0.01, 0.15, 0.3, 0.45])
    assert_allclose(law.energy(strain), strain**2.5, rtol=1e-13)
    assert_allclose(law.pressure(strain), 2.5 * strain**1.5, rtol=1e-13)
    assert_allclose(law.stiffness(strain), 3.75 * strain**0.5, rtol=1e-12)
    assert_allclose(law.strain_at_pressure(2.5 * strain**1.5), strain, rtol=1e-13)


def test_nothing_is_carried_up_to_jamming():
    for result in (MEASURED.energy, MEASURED.pressure, MEASURED.stiffness):
        assert result([-0.1, 0.0]).tolist() == [0.0, 0.0]
    assert MEASURED.strain_at_energy(0.0) == MEASURED.strain_at_pressure(0.0) == 0.0
    assert MEASURED.knots.tolist() == [0.0, *STRAIN]


def test_beyond_the_last_state_it_is_the_power_law_of_the_last_state():
    last = STRAIN[-1]
    exponent = MEASURED.pressure(last) * last / 3.307e6
    assert 2.0 < exponent < 3.0
    assert_allclose(MEASURED.energy(0.3), 3.307e6 * (0.3 / last) ** exponent, rtol=1e-12)
    first = MEASURED.pressure(STRAIN[0]) * STRAIN[0] / 9.60e3
    assert_allclose(MEASURED.energy(0.004), 9.60e3 * (0.004 / STRAIN[0]) ** first, rtol=1e-12)


@pytest.mark.parametrize(
    ("strain", "energy"),
    [
        ((), ()),
        ((0.1, 0.2), (1.0, 4.0)),
        ((0.1, 0.2, 0.3), (1.0, 4.0)),
        ((0.0, 0.2, 0.3), (1.0, 4.0, 9.0)),
        ((0.1, 0.1, 0.3), (1.0, 4.0, 9.0)),
        ((0.1, 0.2, 0.3), (0.0, 4.0, 9.0)),
        ((0.1, 0.2, 0.3), (4.0, 1.0, 9.0)),
        ((0.1, 0.2, np.nan), (1.0, 4.0, 9.0)),
    ],
)
def test_other_states_are_refused(strain, energy):
    with pytest.raises(ValueError, match="needs 3 or more states"):
        InterpolatedElasticity(strain, energy)


def test_a_pressure_that_begins_with_a_step_is_refused():
    strain = np.array([0.1, 0.2, 0.3])
    with pytest.raises(ValueError, match=r"mean the power 1\.20 of the strain next to jamming"):
        InterpolatedElasticity(tuple(strain.tolist()), tuple((strain**1.2).tolist()))


@pytest.mark.parametrize(
    ("energy", "where"),
    [
        ((1.0, 1.5, 2.0, 2.5), "0.1"),
        ((1.0, 6.0, 15.0, 17.0), "0.2"),
        ((1.0, 30.0, 31.0, 90.0), "0.1"),
    ],
)
def test_a_pressure_that_falls_is_refused_and_where_is_said(energy, where):
    with pytest.raises(ValueError, match=f"would not rise from a strain of {where}"):
        InterpolatedElasticity((0.1, 0.2, 0.3, 0.4), energy)
