"""The jamming law fitted to states that obey it, and the isostatic number between walls."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.branches.coordination_laws import (
    isostatic_number,
    jamming_law,
    jamming_law_fit,
)
from branchcrush.packings.network import Network

NONE, INDEX = np.array([]), np.array([], dtype=int)
PHI = np.array([0.005, 0.01, 0.02, 0.05, 0.09])


def generator():
    return np.random.default_rng(5)


def contacts_only(grains, i, j, wall=INDEX):
    return Network(np.ones(grains), i, j, NONE, NONE, NONE, np.asarray(wall), NONE, NONE)


def test_complete_graph_between_walls_lacks_a_share_of_six():
    i, j = np.triu_indices(5, k=1)
    assert isostatic_number(contacts_only(5, i, j)) == 6.0
    # Five wall contacts of five grains, and one of a sixth, a rattler.
    assert isostatic_number(contacts_only(6, i, j, [0, 1, 2, 3, 4, 5])) == 5.0
    assert np.isnan(isostatic_number(contacts_only(3, INDEX, INDEX)))


def test_isostatic_number_is_where_forces_are_as_many_as_equations():
    # Each grain held by three walls and by one contact more than that: M* + W* = 3 N*.
    grains = 8
    rng = np.random.default_rng(0)
    wall = np.repeat(np.arange(grains), 2)
    i = np.arange(grains)
    network = contacts_only(grains, i, (i + 1) % grains, wall)  # a ring: M* = N*, W* = 2 N*
    assert not network.rattlers.any()
    coordination = (2 * grains + wall.size) / grains
    assert_allclose(isostatic_number(network), coordination)
    shuffled = replace(network, wall_grain=rng.permutation(wall))
    assert_allclose(isostatic_number(shuffled), coordination)


@pytest.mark.parametrize("prefactor", [5.0, 7.8])
def test_states_on_the_law_give_it_back(prefactor):
    above = [PHI * factor for factor in (0.8, 1.0, 1.1)]
    number = [jamming_law(x, prefactor) for x in above]
    fit = jamming_law_fit(above, number, rng=generator())
    for part in ("", "_low", "_high"):
        assert_allclose(fit[f"prefactor{part}"], prefactor)
        assert_allclose(fit[f"exponent{part}"], 0.5)
    assert_allclose(fit["free_prefactor"], prefactor)
    assert (fit["states"], fit["states_not_above"]) == (15, 0)


@pytest.mark.parametrize("exponent", [0.3, 0.5, 0.8])
def test_another_exponent_is_found(exponent):
    fit = jamming_law_fit([PHI], [6.0 + 9.0 * PHI**exponent], rng=None)
    assert_allclose(fit["exponent"], exponent)
    assert_allclose(fit["free_prefactor"], 9.0)
    assert np.isnan(fit["exponent_low"])


def test_isostatic_number_between_walls_mends_exponent_and_prefactor():
    least = 5.5 - 0.5 * PHI
    number = least + 7.8 * np.sqrt(PHI)
    with_six = jamming_law_fit([PHI], [number], rng=None)
    mended = jamming_law_fit([PHI], [number], isostatic=[least], rng=None)
    assert_allclose([mended["prefactor"], mended["exponent"]], [7.8, 0.5])
    assert with_six["prefactor"] < 7.0 and with_six["exponent"] > 0.55


def test_states_below_isostatic_count_for_the_prefactor_and_are_told():
    number = np.append(5.9, jamming_law(PHI[1:]))
    fit = jamming_law_fit([PHI], [number], rng=None)
    assert fit["states_not_above"] == 1
    assert_allclose(fit["exponent"], 0.5)
    assert fit["prefactor"] < 7.8


@pytest.mark.parametrize("above", [[], [0.2, 0.3], [np.nan]])
def test_no_state_in_the_range_gives_no_law_and_no_warning(above):
    fit = jamming_law_fit([above], [np.full(len(above), 7.0)], rng=None)
    assert fit["states"] == 0
    assert np.isnan([fit["prefactor"], fit["exponent"], fit["free_prefactor"]]).all()


@pytest.mark.parametrize("number", [3, 7, 13])
@pytest.mark.parametrize("distance", [0.0041, 0.013, 0.05, 0.07])
def test_states_at_one_distance_give_a_prefactor_alone(distance, number):
    fit = jamming_law_fit([[distance] * number], [np.linspace(7.0, 7.6, number)], rng=None)
    assert np.isfinite(fit["prefactor"]) and np.isnan(fit["exponent"])


def test_interval_covers_the_law():
    inside = 0
    for trial in range(40):
        rng = np.random.default_rng(trial)
        # What varies is a packing's own, not each state's.
        own = 7.8 + 0.5 * rng.standard_normal(12)
        number = [6.0 + a * np.sqrt(PHI) for a in own]
        fit = jamming_law_fit([PHI] * 12, number, resamples=300, rng=rng)
        inside += fit["prefactor_low"] <= 7.8 <= fit["prefactor_high"]
    # 95 % each: fewer than 31 of 40 has a chance below 1e-4.
    assert inside >= 31
