"""The jamming point of stresses made from a law with a known one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.errors import FitError
from branchcrush.loading.jamming import jamming_point

EXPONENTS = [1.0, 1.5]


def synthetic(jammed, exponent, curvature=0.0, states=12, reach=0.06, modulus=1e7):
    """Return solid fraction, stress and which states are loaded, two of them below jamming."""
    phi = np.r_[jammed - 0.02, jammed - 0.01, jammed + np.linspace(0.002, reach, states)]
    above = np.maximum(phi - jammed, 0.0)
    return phi, modulus * (above + curvature * above**2) ** exponent, phi > jammed


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("curvature", [-3.0, -0.5, 0.0, 0.5, 3.0, 12.0])
def test_a_power_law_is_carried_on_to_zero(exponent, curvature):
    point = jamming_point(*_mixed(synthetic(0.64, exponent, curvature), exponent))
    assert_allclose(point.solid_fraction, 0.64, rtol=0, atol=1e-9)


def _mixed(path, exponent):
    phi, stress, loaded = path
    return phi, stress, exponent, loaded


@settings(deadline=None)
@given(
    st.floats(0.4, 0.8),
    st.sampled_from(EXPONENTS),
    st.floats(-2.0, 10.0),
    st.floats(1e-3, 1e12),
)
def test_neither_the_place_nor_the_unit_of_stress_matters(jammed, exponent, curvature, modulus):
    phi, stress, loaded = synthetic(jammed, exponent, curvature, modulus=modulus)
    point = jamming_point(phi, stress, exponent, loaded)
    assert_allclose(point.solid_fraction, jammed, rtol=0, atol=1e-8)


def test_without_curvature_there_is_no_uncertainty():
    phi, stress, loaded = synthetic(0.64, 1.0)
    assert jamming_point(phi, stress, 1.0, loaded).uncertainty < 1e-9


# Student's t with two degrees of freedom of one standard deviation: (2p - 1)/sqrt(2p(1 - p)).
ONE = 0.8413447460685429
STUDENT_OF_TWO = (2 * ONE - 1) / (2 * ONE * (1 - ONE)) ** 0.5


def scattered(residuals, step=0.005):
    """Return fraction and stress of states at 1, 2, ... steps above 0.64, off a line."""
    number = np.arange(1, len(residuals) + 1)
    return 0.64 + step * number, 1e6 * (number + np.array(residuals))


def test_four_states_have_the_uncertainty_of_the_line_through_them():
    # Residuals that leave the fit alone: s^2 = 4 x 0.1^2/2. At 0, 2.5 from the mean of 1 to 4, the
    # line of slope 1 is known to s^2 (1/4 + 2.5^2/5).
    phi, stress = scattered([0.1, -0.1, -0.1, 0.1])
    point = jamming_point(phi, stress, 1.0, np.ones(4, dtype=bool))
    assert_allclose(point.solid_fraction, 0.64, rtol=0, atol=1e-12)
    deviation = (0.02 * (1 / 4 + 6.25 / 5)) ** 0.5
    assert_allclose(point.uncertainty, STUDENT_OF_TWO * deviation * 0.005, rtol=1e-6)


def test_five_states_have_the_uncertainty_of_the_parabola_through_them():
    # Residuals as the cubic polynomial of five points leave line and parabola alone: s^2 = 0.1/2.
    # At 0, 3 from their middle, the parabola is known to s^2 (1/5 + 3^2/10 + (3^2 - 2)^2/14).
    phi, stress = scattered(0.1 * np.array([-1.0, 2.0, 0.0, -2.0, 1.0]))
    point = jamming_point(phi, stress, 1.0, np.ones(5, dtype=bool))
    assert_allclose(point.solid_fraction, 0.64, rtol=0, atol=1e-12)
    deviation = (0.05 * (1 / 5 + 9 / 10 + 49 / 14)) ** 0.5
    assert_allclose(point.uncertainty, STUDENT_OF_TWO * deviation * 0.005, rtol=1e-6)


def test_the_way_from_loose_to_loaded_bounds_the_uncertainty():
    phi, stress = scattered([0.1, -0.1, -0.1, 0.1])
    # The first loaded state is at 0.645, the last loose one a thousandth below.
    path = np.append(phi, 0.644), np.append(stress, 0.0)
    point = jamming_point(*path, 1.0, path[1] > 0)
    # The line vanishes at 0.64, where it was loose still.
    assert_allclose(point, (0.644, 0.001, 4), rtol=1e-9)


def test_the_place_where_it_was_last_loose_is_as_uncertain_as_it_is_far_from_the_line():
    phi, stress = scattered([0.0, 0.0, 0.0, 0.0])
    point = jamming_point(np.append(phi, 0.641), np.append(stress, 0.0), 1.0, [True] * 4 + [False])
    assert_allclose(point, (0.641, 0.001, 4), rtol=1e-9)


def test_leaving_out_the_curvature_is_part_of_the_uncertainty():
    # Exact data: the standard error is nothing, half of the other is all.
    phi, stress, loaded = synthetic(0.64, 1.0, 5.0)
    point = jamming_point(phi, stress, 1.0, loaded)
    near = loaded & (phi <= phi[2] + 0.04)
    slope, offset = np.polyfit(phi[near], stress[near], 1)
    assert_allclose(point.uncertainty, abs(-offset / slope - 0.64) / 2, rtol=1e-5)
    assert point.states == near.sum()


def test_only_states_near_jamming_count():
    phi, stress, loaded = synthetic(0.64, 1.0, states=30, reach=0.2)
    near = phi <= phi[loaded][0] + 0.04
    stress[~near] *= 7.0
    point = jamming_point(phi, stress, 1.0, loaded)
    assert_allclose(point.solid_fraction, 0.64, rtol=0, atol=1e-9)
    assert point.states == (near & loaded).sum()


def test_four_states_are_taken_however_far_apart():
    phi = 0.64 + np.array([0.01, 0.06, 0.11, 0.16])
    point = jamming_point(phi, 1e6 * (phi - 0.64), 1.0, np.ones(4, dtype=bool))
    assert_allclose(point.solid_fraction, 0.64, rtol=0, atol=1e-12)
    assert point.states == 4


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_the_order_of_the_states_does_not_matter(exponent):
    phi, stress, loaded = synthetic(0.64, exponent, 2.0)
    stress *= np.random.default_rng(1).uniform(0.98, 1.02, phi.size)
    order = np.random.default_rng(2).permutation(phi.size)
    expected = jamming_point(phi, stress, exponent, loaded)
    for mixed in (order, slice(None, None, -1)):
        assert jamming_point(phi[mixed], stress[mixed], exponent, loaded[mixed]) == expected


def test_lists_are_taken():
    phi, stress, loaded = synthetic(0.64, 1.0)
    assert jamming_point(list(phi), list(stress), 1.0, list(loaded)) == jamming_point(
        phi, stress, 1.0, loaded
    )


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("states", [6, 20])
@pytest.mark.parametrize("curvature", [0.0, 4.0])
def test_the_uncertainty_covers_the_true_point_in_noise(exponent, states, curvature):
    # One standard deviation is to hold 68 % of the time, and two 95 %; with the half-difference of
    # the straight line it may hold more often, and must not hold less.
    rng, runs = np.random.default_rng(4), 400
    phi, stress, loaded = synthetic(0.64, exponent, curvature, states=states, reach=0.042)
    off, width = np.empty(runs), np.empty(runs)
    for run in range(runs):
        root = np.maximum(stress, 0.0) ** (1 / exponent)
        noisy = root + rng.normal(0.0, 0.01 * root.max(), phi.size) * loaded
        point = jamming_point(phi, np.maximum(noisy, 0.0) ** exponent, exponent, loaded)
        off[run], width[run] = abs(point.solid_fraction - 0.64), point.uncertainty
    assert (off <= width).mean() > 0.62
    assert (off <= 2 * width).mean() > 0.90
    # Nor more often than that without a reason: a second standard deviation would hold 95 %.
    assert (off <= width).mean() < (0.80 if curvature == 0.0 else 0.96)
    # Not by being useless.
    assert np.median(width) < 0.02
    # And where the fit has enough to go by, wide and off go together.
    if states == 20:
        assert np.median(width) < 4 * np.median(off)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_the_uncertainty_of_a_line_holds_as_often_as_one_standard_deviation(exponent):
    # Four states have no second fit: what is left is the standard error, by Student's t.
    rng, runs = np.random.default_rng(5), 4000
    phi, loaded = 0.64 + 0.01 * np.arange(1, 5), np.ones(4, dtype=bool)
    held = 0
    for noise in rng.normal(0.0, 0.01, (runs, 4)):
        stress = (np.arange(1, 5) + noise) ** exponent
        point = jamming_point(phi, stress, exponent, loaded)
        held += abs(point.solid_fraction - 0.64) <= point.uncertainty
    # Three standard deviations of a share of 0.683 among so many.
    assert held / runs == pytest.approx(0.683, abs=3 * (0.683 * 0.317 / runs) ** 0.5)


@pytest.mark.parametrize("states", [0, 1, 3])
def test_fewer_than_four_loaded_states_are_refused(states):
    phi = np.linspace(0.60, 0.70, 8)
    loaded = np.arange(8) >= 8 - states
    carry = "state carries" if states == 1 else "states carry"
    with pytest.raises(FitError, match=rf"^{states} {carry} load; 4 are needed"):
        jamming_point(phi, np.maximum(phi - 0.6, 0.0), 1.0, loaded)


@pytest.mark.parametrize("states", [4, 9])
def test_a_falling_stress_is_refused(states):
    phi = np.linspace(0.64, 0.67, states)
    with pytest.raises(FitError, match="does not rise"):
        jamming_point(phi, 1e6 * (0.70 - phi), 1.0, np.ones(states, dtype=bool))


def test_a_stress_that_falls_at_first_leaves_what_is_known_of_the_way():
    # Last loose at 0.62, loaded from 0.64 on: between the two, whatever its stress does.
    phi = np.array([0.60, 0.62, 0.64, 0.65, 0.66, 0.67, 0.68])
    stress = np.array([0.0, 0.0, 9.0, 7.0, 5.0, 4.0, 3.0])
    point = jamming_point(phi, stress, 1.0, stress > 0)
    assert point.solid_fraction == pytest.approx(0.63)
    assert point.uncertainty == pytest.approx(0.01)
