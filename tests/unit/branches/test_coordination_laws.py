"""Relations of the coordination number: lattices, identities, and a prefactor that is known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.branches.coordination_laws import (
    JAMMING_PREFACTOR,
    field,
    gray,
    jamming_law,
    jamming_law_fit,
    smith,
)
from branchcrush.statistics.intervals import Interval

# Solid fractions of the simple cubic and of the closest packing of equal spheres.
CUBIC, CLOSEST = np.pi / 6, np.pi / 18**0.5


def jamming_prefactor(above, number, **options):
    found = jamming_law_fit(above, number, **options)
    return Interval(*(found[f"prefactor{part}"] for part in ("", "_low", "_high")))


def void_ratio(solid_fraction):
    return 1.0 / solid_fraction - 1.0


def states(rng, prefactor, number=12, noise=0.0):
    """Return distances from jamming and the contact numbers there, of one seed."""
    above = rng.uniform(0.004, 0.09, number)
    return above, 6.0 + prefactor * np.sqrt(above) + noise * rng.standard_normal(number)


# --- historic relations --------------------------------------------------------------------------


def test_smith_goes_through_the_simple_cubic_and_the_closest_packing():
    # He mixed the two lattices in such parts that the void ratio is right.
    assert_allclose(smith(void_ratio(np.array([CUBIC, CLOSEST]))), [6.0, 12.0], atol=2e-3)


def test_field_is_twelve_times_the_solid_fraction():
    solid_fraction = np.linspace(0.3, 1.0, 15)
    assert_allclose(field(void_ratio(solid_fraction)), 12.0 * solid_fraction, rtol=1e-14)


def test_gray_times_the_porosity_is_pi():
    solid_fraction = np.linspace(0.3, 0.9, 15)
    porosity = 1.0 - solid_fraction
    assert_allclose(gray(void_ratio(solid_fraction)) * porosity, np.pi, rtol=1e-14)


@pytest.mark.parametrize("law", [smith, field, gray])
def test_looser_packings_have_fewer_contacts_by_every_historic_relation(law):
    number = law(np.linspace(0.4, 1.0, 20))
    assert np.all(np.diff(number) < 0)
    assert law([0.5, 0.7]).tolist() == [law(0.5), law(0.7)]
    # All three agree within one or two where they were measured.
    assert 6.0 < law(0.65) < 9.0


# --- jamming law ---------------------------------------------------------------------------------


def test_jamming_law_is_isostatic_at_jamming_and_rises_with_the_root():
    above = np.array([0.0, 0.01, 0.04, 0.09])
    assert_allclose(jamming_law(above, 5.0), [6.0, 6.5, 7.0, 7.5], rtol=1e-14)
    # Of nearly equal frictionless spheres, O'Hern and others.
    assert jamming_law(1.0) == 6.0 + JAMMING_PREFACTOR == pytest.approx(13.8)


@settings(deadline=None, max_examples=60)
@given(st.floats(0.1, 30.0), st.integers(1, 6), st.integers(0, 2**32))
def test_prefactor_of_exact_states_is_recovered(prefactor, seeds, state):
    rng = np.random.default_rng(state)
    above, number = zip(
        *(states(rng, prefactor, rng.integers(1, 9)) for _ in range(seeds)), strict=True
    )
    found = jamming_prefactor(above, number, resamples=50, rng=rng)
    assert_allclose(found.estimate, prefactor, rtol=1e-10)
    if seeds == 1:
        assert np.isnan([found.low, found.high]).all()
    else:
        assert_allclose([found.low, found.high], prefactor, rtol=1e-9)


def test_prefactor_is_that_of_least_squares_over_all_states():
    rng = np.random.default_rng(0)
    above, number = zip(*(states(rng, 8.0, n, 0.3) for n in (3, 20, 7)), strict=True)
    root = np.sqrt(np.concatenate(above))
    expected = np.linalg.lstsq(root[:, None], np.concatenate(number) - 6.0, rcond=None)[0][0]
    found = jamming_prefactor(above, number, rng=rng)
    assert found.estimate == pytest.approx(expected, rel=1e-12)
    backwards = jamming_prefactor(above[::-1], number[::-1], rng=rng)
    assert backwards.estimate == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("outside", [-0.02, 0.0, 0.0029, 0.1001, 0.4, np.nan])
@pytest.mark.filterwarnings("error")
def test_states_too_near_or_too_far_from_jamming_do_not_count(outside):
    above = np.array([0.01, outside, 0.05])
    number = np.array([6.8, 1e6, 6.0 + 8.0 * 0.05**0.5])
    assert jamming_prefactor([above], [number], rng=None).estimate == pytest.approx(8.0)


def test_states_at_both_ends_of_the_range_count():
    above = np.array([0.003, 0.1])
    for k, prefactor in enumerate((9.0, 4.0)):
        here = above[[k]]
        found = jamming_prefactor([here], [6.0 + prefactor * np.sqrt(here)], rng=None)
        assert found.estimate == pytest.approx(prefactor)


@pytest.mark.parametrize("seeds", [1, 3])
@pytest.mark.filterwarnings("error")
def test_without_a_state_in_the_range_there_is_no_prefactor(seeds):
    above = [np.array([0.001, 0.3]), np.empty(0), np.array([0.2])][:seeds]
    number = [np.full(x.size, 7.0) for x in above]
    found = jamming_prefactor(above, number, resamples=20, rng=np.random.default_rng(0))
    assert np.isnan(found).all()


def test_a_seed_without_states_in_the_range_leaves_the_others():
    rng = np.random.default_rng(2)
    above, number = states(rng, 8.0)
    empty = np.array([0.5])
    found = jamming_prefactor([above, empty], [number, empty], resamples=50, rng=rng)
    assert found.estimate == pytest.approx(8.0)


def test_a_jamming_point_of_its_own_for_each_seed_does_not_bias_the_prefactor():
    # Solid fractions are shared, jamming points are not: a common phi_J would blur the root.
    rng = np.random.default_rng(5)
    jamming = rng.normal(0.64, 0.003, 8)
    above = [np.linspace(0.66, 0.72, 7) - point for point in jamming]
    number = [6.0 + 7.8 * np.sqrt(x) for x in above]
    found = jamming_prefactor(above, number, rng=rng)
    assert_allclose(found, 7.8, rtol=1e-9)


def test_interval_covers_the_prefactor_of_packings_that_scatter_about_it():
    rng = np.random.default_rng(20)
    trials, covered = 200, 0
    for _ in range(trials):
        seeds = [states(rng, prefactor, noise=0.05) for prefactor in rng.normal(8.0, 0.4, 12)]
        above, number = zip(*seeds, strict=True)
        found = jamming_prefactor(above, number, resamples=300, rng=rng)
        covered += found.low <= 8.0 <= found.high
    assert 0.88 <= covered / trials <= 0.99
