"""Predicted branch lengths: exact ones of simple gradings, and distances that are known."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.stats import ks_2samp

from branchcrush.branches import predictions as length_predictions
from branchcrush.branches.coordination_models import MODELS
from branchcrush.branches.lengths import random_contact_moment, random_contact_shares
from branchcrush.branches.predictions import (
    binned_predictions,
    distances,
    fine_edges,
    grading_nodes,
    lumped,
    mean_length,
    mode_length,
    pair_shares,
    predictions,
)
from branchcrush.errors import FitError
from branchcrush.gradings.forms import (
    fractal,
    fuller,
    lognormal,
    loguniform,
    normal,
    uniform,
    weibull,
)
from branchcrush.gradings.mixtures import from_radii, mixture, single


@st.composite
def gradings(draw):
    """Return gradings of every form, of ratios to 200; by number, by mass or of single radii."""
    ratio = draw(st.floats(1.01, 200.0))
    by = draw(st.sampled_from(["number", "mass"]))
    seed = draw(st.integers(0, 2**32))
    whole = uniform(1.0, ratio, by)
    forms = {
        "uniform": lambda: whole,
        "loguniform": lambda: loguniform(1.0, ratio, by),
        "normal": lambda: normal((1.0 + ratio) / 2, (ratio - 1.0) / 6, 1.0, ratio, by),
        # Cut far beyond their tails.
        "lognormal": lambda: lognormal(1.0, 1.0 + draw(st.floats(0.05, 1.0)), 0.01, 100.0, by),
        "weibull": lambda: weibull(1.0, draw(st.floats(1.0, 4.0)), 0.05, 20.0, by),
        "fractal": lambda: fractal(1.0, ratio, draw(st.floats(2.0, 2.9))),
        "fuller": lambda: fuller(1.0, ratio, draw(st.floats(0.3, 1.0))),
        "few radii": lambda: from_radii(whole.rvs(20, seed)),
        "many radii": lambda: from_radii(whole.rvs(700, seed)),
        "mixed": lambda: mixture([whole, single(1.0 + ratio)], [3.0, 1.0], by),
        "mixed with many": lambda: mixture([whole, from_radii(whole.rvs(150, seed))], [1, 1], by),
    }
    return forms[draw(st.sampled_from(sorted(forms)))]()


def uniform_edges(bins=40):
    return np.linspace(2.0, 6.0, bins + 1)


def triangle_shares(edges):
    """Return the exact shares of sums of two radii that are uniform from 1 to 3."""
    below = np.where(edges <= 4.0, (edges - 2.0) ** 2 / 8.0, 1.0 - (6.0 - edges) ** 2 / 8.0)
    return np.diff(below)


# --- nodes ---------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=120)
@given(gradings())
def test_nodes_have_the_moments_of_their_grading(grading):
    radius, share = grading_nodes(grading)
    assert share.sum() == pytest.approx(1.0, rel=1e-12)
    assert np.all(share > 0)
    # However many single radii there are.
    assert radius.size <= 2 * length_predictions._CELLS + length_predictions._SINGLE
    smallest, largest = grading.support()
    assert np.all((radius >= smallest * (1 - 1e-12)) & (radius <= largest * (1 + 1e-12)))
    assert share @ radius == pytest.approx(grading.moment(1), rel=1e-9)
    assert share @ radius**2 == pytest.approx(grading.moment(2), rel=3e-3)
    assert share @ radius**3 == pytest.approx(grading.moment(3), rel=5e-3)


@settings(deadline=None, max_examples=60)
@given(gradings(), st.floats(0.01, 0.99))
def test_nodes_follow_both_cumulative_curves(grading, level):
    radius, share = grading_nodes(grading)
    mass = share * radius**3 / (share @ radius**3)
    for weight, quantile, cumulative in (
        (share, grading.number_ppf, grading.number_cdf),
        (mass, grading.mass_ppf, grading.mass_cdf),
    ):
        # A cell may be on either side, and a single radius steps.
        here = float(quantile(level))
        below = weight[radius < here * (1 - 1e-9)].sum()
        upto = weight[radius <= here * (1 + 1e-9)].sum()
        assert below <= level + 0.011
        assert upto >= min(level, float(cumulative(here))) - 0.011


def test_single_radii_beside_a_continuous_part_keep_their_shares():
    grading = mixture([uniform(1.0, 2.0), from_radii([1.5, 3.0])], [3.0, 1.0], by="number")
    radius, share = grading_nodes(grading)
    for size in (1.5, 3.0):
        assert_allclose(share[radius == size].max(), 0.125, rtol=1e-12)
    assert share[(radius != 1.5) & (radius != 3.0)].sum() == pytest.approx(0.75, rel=1e-12)


def test_coarse_grains_few_by_number_have_nodes_as_well():
    radius, _ = grading_nodes(fractal(1.0, 200.0, 2.6))
    # Half the mass is in grains above this radius: fewer than 1 in 10 000 by number.
    assert (radius > fractal(1.0, 200.0, 2.6).mass_ppf(0.5)).sum() >= 95


@pytest.mark.parametrize("fines", [101, 699, 5000])
def test_one_heavy_grain_among_many_fines_keeps_its_radius(fines):
    radius, share = grading_nodes(from_radii([*np.linspace(1.0, 1.5, fines), 200.0]))
    assert radius.max() == 200.0
    assert share[radius.argmax()] == pytest.approx(1 / (fines + 1), rel=1e-9)


def test_a_long_tail_of_no_grains_has_no_part_in_the_moments():
    grading = lognormal(1.0, 1.2, 0.01, 100.0)
    radius, share = grading_nodes(grading)
    for order in (1, 2, 3):
        assert share @ radius**order == pytest.approx(grading.moment(order), rel=1e-3)


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
    found = distances(counts, shares, np.linspace(1.0, 3.5, 251))
    assert found["kolmogorov_smirnov"] == pytest.approx(shift / 100, abs=1e-12)
    assert found["mean_length_m"] == pytest.approx(1.5 + shift / 100, rel=1e-12)


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
    counts, shares = rng.integers(1, 9, (2, length_predictions._BINS))
    edges = fine_edges(1.0, 4.0)
    metres, millimetres = (distances(counts, shares, edges * unit) for unit in (1.0, 1e3))
    assert millimetres["kolmogorov_smirnov"] == metres["kolmogorov_smirnov"]
    for name in ("mean_length_m", "mode_length_m"):
        assert millimetres[name] == pytest.approx(1e3 * metres[name], rel=1e-12)
