"""Predicted branch lengths: exact ones of simple gradings, and distances that are known."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.stats import ks_2samp

from branchcrush.branches.coordination_models import MODELS
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.predictions import (
    PREDICTIONS,
    binned_predictions,
    distances,
    fine_edges,
    lumped,
    mean_length,
    mode_length,
    pair_shares,
    predictions,
)
from branchcrush.branches.random_contacts import random_contact_moment, random_contact_shares
from branchcrush.errors import FitError
from branchcrush.gradings.forms import lognormal, loguniform, uniform
from branchcrush.gradings.mixtures import from_radii, single


def uniform_edges(bins=40):
    return np.linspace(2.0, 6.0, bins + 1)


def triangle_shares(edges):
    """Return the exact shares of sums of two radii that are uniform from 1 to 3."""
    below = np.where(edges <= 4.0, (edges - 2.0) ** 2 / 8.0, 1.0 - (6.0 - edges) ** 2 / 8.0)
    return np.diff(below)


def test_narrow_bins_begin_and_end_a_thousandth_of_the_largest_radius_beyond():
    edges = fine_edges(1.0, 2.0)
    assert edges.size == 998
    assert_allclose(edges[[0, -1]], [1.998, 4.002], rtol=1e-14)
    assert_allclose(np.diff(edges), 2.004 / 997, rtol=1e-10)


# --- pairs ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [1.1, 3.0, 200.0])
@pytest.mark.parametrize("form", [uniform, loguniform])
def test_grains_that_touch_by_their_number_have_the_lengths_of_random_contacts(form, ratio):
    grading = form(1.0, ratio)
    edges = np.linspace(2.0, 2.0 * ratio, 41)
    radius, share = grading_nodes(grading)
    found, expected = pair_shares(radius, share, edges), random_contact_shares(grading, edges)
    assert np.abs(np.cumsum(found - expected)).max() < 0.005


def test_pairs_of_a_uniform_grading_are_a_triangle():
    radius, share = grading_nodes(uniform(1.0, 3.0))
    found = pair_shares(radius, share, uniform_edges())
    assert np.abs(np.cumsum(found - triangle_shares(uniform_edges()))).max() < 0.005


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 30), st.integers(0, 2**32), st.floats(1e-6, 1e6))
def test_mean_length_of_pairs_is_twice_the_mean_radius_of_an_end(grains, seed, scale):
    rng = np.random.default_rng(seed)
    radius, touched = rng.uniform(1.0, 5.0, grains), rng.exponential(size=grains)
    edges = fine_edges(1.0, 5.0)
    shares = pair_shares(radius, touched * scale, edges)
    assert shares.sum() == pytest.approx(1.0, rel=1e-12)
    expected = 2.0 * np.average(radius, weights=touched)
    assert mean_length(shares, edges) == pytest.approx(expected, abs=np.diff(edges)[0])


def test_two_sizes_have_three_lengths_of_binomial_shares():
    shares = pair_shares(np.array([1.0, 4.0]), np.array([9.0, 1.0]), [1.9, 2.1, 4.9, 5.1, 8.1])
    assert_allclose(shares, [0.81, 0.0, 0.18, 0.01], rtol=1e-12)


# --- predictions ---------------------------------------------------------------------------------


def test_every_model_predicts_longer_branches_than_random_contacts_of_a_wide_grading():
    grading, edges = uniform(0.005, 1.0), fine_edges(0.005, 1.0)
    found = predictions(grading, edges)
    assert list(found) == ["random_contact", *MODELS]
    lengths = {name: mean_length(found[name].shares, edges) for name in found}
    eq4 = lengths.pop("random_contact")
    assert eq4 == pytest.approx(random_contact_moment(grading, 1), rel=1e-3)
    assert min(lengths.values()) > 1.2 * eq4
    # Measured near jamming: 1.45 to 1.47 of the largest radius.
    assert 1.40 < lengths["self_consistent"] < 1.50


@pytest.mark.parametrize("name", ["random_contact", *MODELS])
def test_equal_spheres_have_one_length(name):
    edges = fine_edges(0.25, 0.25)
    found = predictions(single(0.25), edges)[name]
    assert found.shares.max() == pytest.approx(1.0, rel=1e-12)
    inside = found.shares.argmax()
    assert edges[inside] < 0.5 < edges[inside + 1]


def test_all_lengths_lie_inside_the_narrow_bins():
    for grading in (uniform(1.0, 200.0), from_radii([1.0, 7.0]), single(3.0)):
        edges = fine_edges(*grading.support())
        for prediction in predictions(grading, edges).values():
            assert prediction.shares.sum() == pytest.approx(1.0, rel=1e-9)


def test_a_model_that_does_not_hold_is_left_out(monkeypatch):
    def refused(radius, share):
        raise FitError("no")

    monkeypatch.setitem(MODELS, "surface", replace(MODELS["surface"], contacts=refused))
    found = predictions(uniform(1.0, 2.0), uniform_edges())
    assert list(found) == ["random_contact", *(name for name in MODELS if name != "surface")]


def test_predictions_in_wide_bins_are_the_sums_of_the_narrow_ones():
    edges = fine_edges(1.0, 3.0)
    models = predictions(uniform(1.0, 3.0), edges)
    wide = edges[[0, 300, 301, 800, 997]]
    found = binned_predictions(models, wide)
    assert list(found) == list(MODELS)
    for name, shares in found.items():
        expected = np.add.reduceat(models[name].shares, [0, 300, 301, 800])
        assert_allclose(shares, expected, rtol=1e-9, atol=1e-12)


def test_a_long_empty_tail_does_not_change_what_is_predicted():
    edges = np.linspace(0.5, 5.0, 100)
    short, long = (predictions(lognormal(1.0, 1.2, 0.2, end), edges) for end in (3.0, 100.0))
    for name in short:
        assert np.abs(np.cumsum(short[name].shares - long[name].shares)).max() < 0.01


# --- groups --------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=60)
@given(st.integers(1, 600), st.integers(1, 60), st.integers(0, 2**32), st.booleans())
def test_groups_keep_all_contacts_and_the_order_of_radii(grains, cells, seed, repeated):
    rng = np.random.default_rng(seed)
    radius = rng.uniform(1.0, 5.0, grains)
    radius = np.round(radius) if repeated else radius
    contacts = rng.poisson(radius**2)
    found, touched = lumped(radius, contacts, cells)
    assert found.size <= max(cells, 1)
    assert touched.sum() == contacts.sum()
    assert np.all(np.diff(found) >= 0)
    assert radius.min() * (1 - 1e-12) <= found[0] and found[-1] <= radius.max() * (1 + 1e-12)


def test_few_radii_are_groups_of_their_own():
    rng = np.random.default_rng(0)
    radius = rng.choice([1.0, 2.0, 5.0], 1000)
    contacts = rng.integers(0, 9, 1000)
    found, touched = lumped(radius, contacts)
    assert found.tolist() == [1.0, 2.0, 5.0]
    assert_array_equal(touched, [contacts[radius == value].sum() for value in found])


def test_groups_of_many_grains_have_the_lengths_of_every_pair():
    rng = np.random.default_rng(1)
    radius = rng.uniform(0.005, 1.0, 1500)
    contacts = rng.poisson(10.0 * radius**2)
    edges = fine_edges(0.005, 1.0)
    all_pairs = pair_shares(radius, contacts, edges)
    grouped = pair_shares(*lumped(radius, contacts), edges)
    assert np.abs(np.cumsum(all_pairs - grouped)).max() < 0.005


# --- distances -----------------------------------------------------------------------------------


def test_a_distribution_is_at_no_distance_from_itself_whatever_its_scale():
    counts = np.random.default_rng(0).integers(0, 50, 30)
    assert distances(counts, counts / counts.sum(), np.arange(31.0))["kolmogorov_smirnov"] < 1e-15
    assert distances(counts, 7.0 * counts, np.arange(31.0))["kolmogorov_smirnov"] < 1e-15


@pytest.mark.parametrize("shift", [0, 1, 13, 50, 100])
def test_flat_distributions_are_as_far_apart_as_they_are_shifted(shift):
    counts, shares = np.zeros(250), np.zeros(250)
    counts[:100], shares[shift : shift + 100] = 1, 0.01
    shares[shift + 30 : shift + 60] += 1e-9
    found = distances(counts, shares, np.linspace(1.0, 3.5, 251))
    assert found["kolmogorov_smirnov"] == pytest.approx(shift / 100, abs=1e-7)
    # A tenth of the range, 25 bins, fits into the 30 slightly higher ones at six places.
    assert found["mode_length_m"] == pytest.approx(1.45 + shift / 100, rel=1e-9)
    assert found["mean_length_m"] == pytest.approx(1.5 + shift / 100, rel=1e-8)


def test_distance_of_drawn_lengths_is_that_of_two_samples():
    rng = np.random.default_rng(2)
    edges = fine_edges(0.5, 1.0)
    first, second = rng.triangular(1.0, 1.4, 2.0, 5000), rng.triangular(1.0, 1.6, 2.0, 7000)
    counts = [np.histogram(lengths, edges)[0] for lengths in (first, second)]
    found = distances(counts[0], counts[1] / 7000, edges)["kolmogorov_smirnov"]
    # Inside a bin the curves may part by a little more.
    assert found == pytest.approx(ks_2samp(first, second).statistic, abs=0.004)


@pytest.mark.parametrize(("low", "high"), [(1.0, 3.0), (0.005, 1.0), (1.0, 1.2)])
def test_mode_of_random_contacts_of_a_uniform_grading_is_the_sum_of_both_ends(low, high):
    edges = fine_edges(low, high)
    mode = mode_length(random_contact_shares(uniform(low, high), edges), edges)
    assert mode == pytest.approx(low + high, abs=2 * np.diff(edges)[0])


def test_mode_is_where_most_branches_are_though_one_bin_sticks_out():
    rng = np.random.default_rng(3)
    edges = fine_edges(0.5, 1.0)
    counts = np.histogram(rng.triangular(1.0, 1.7, 2.0, 20_000), edges)[0]
    counts[50] += 200
    assert mode_length(counts, edges) == pytest.approx(1.7 - 0.02, abs=0.06)


def test_mode_of_one_length_is_that_length():
    edges = fine_edges(1.0, 2.0)
    counts = np.histogram([3.0] * 8 + [2.0] * 3, edges)[0]
    assert mode_length(counts, edges) == pytest.approx(3.0, abs=np.diff(edges)[0])


def test_units_leave_the_distance_and_scale_the_lengths():
    rng = np.random.default_rng(4)
    counts, shares = rng.integers(1, 9, (2, 997))
    edges = fine_edges(1.0, 4.0)
    metres, millimetres = (distances(counts, shares, edges * unit) for unit in (1.0, 1e3))
    assert millimetres["kolmogorov_smirnov"] == metres["kolmogorov_smirnov"]
    for name in ("mean_length_m", "mode_length_m"):
        assert millimetres[name] == pytest.approx(1e3 * metres[name], rel=1e-12)


def test_mode_is_the_middle_of_the_tenth_of_the_range_with_most_branches():
    # 100 bins: 3 in each of the bins 60 to 69, 2 in 70 to 79, 1 in the others. A fifth of the range
    # would have its middle at 70, a twentieth at 62.5 or more.
    shares = np.ones(100)
    shares[60:70], shares[70:80] = 3.0, 2.0
    assert mode_length(shares, np.linspace(0.0, 100.0, 101)) == pytest.approx(65.0)


def test_of_two_modes_as_high_the_shorter_length_is_given():
    shares = np.zeros(100)
    shares[[20, 80]] = 1.0
    # All tenths with the bin 20 in them: their middles are from 16 to 25.
    assert mode_length(shares, np.linspace(0.0, 100.0, 101)) == pytest.approx(20.5)


def test_every_prediction_has_a_look_of_its_own():
    assert list(PREDICTIONS) == ["random_contact", *MODELS, "configuration"]
    for part in ("label", "color", "marker"):
        assert len({getattr(look, part) for look in PREDICTIONS.values()}) == len(PREDICTIONS)
    assert PREDICTIONS["parking"] == ("random parking", "#3a7d44", "o")
    assert PREDICTIONS["rods"] == ("rods that push", "#14a0bd", "X")
