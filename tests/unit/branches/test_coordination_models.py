"""Contact numbers from the grading alone: what each model promises, checked by other means."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.branches.coordination import solid_angle
from branchcrush.branches.coordination_models import (
    MODELS,
    mean_neighbour_contacts,
    self_consistent_contacts,
    surface_contacts,
)
from branchcrush.branches.nodes import grading_nodes
from branchcrush.errors import FitError
from branchcrush.gradings.forms import fractal
from tests.unit.branches.model_gradings import GRADINGS, any_nodes, ends, mean_angle


@st.composite
def few_radii(draw):
    """Return up to six radii within a factor of two, and their shares."""
    radius = draw(st.lists(st.floats(1.0, 2.0), min_size=1, max_size=6, unique=True))
    parts = draw(st.lists(st.floats(0.1, 1.0), min_size=len(radius), max_size=len(radius)))
    return np.array(radius), np.array(parts) / sum(parts)


# --- what all models share -----------------------------------------------------------------------


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("radius", [1e-6, 0.3, 200.0])
def test_equal_spheres_are_isostatic(name, radius):
    found = MODELS[name].contacts(np.array([radius]), np.ones(1))
    assert_allclose(found.contacts / found.load_bearing, 6.0, rtol=1e-9)
    assert 0.95 < found.load_bearing[0] <= 1.0


@pytest.mark.parametrize("name", MODELS)
@any_nodes
def test_load_bearing_grains_have_six_contacts_on_average(name, nodes):
    radius, share = nodes
    contacts, bearing = MODELS[name].contacts(radius, share)
    assert share @ contacts == pytest.approx(6.0 * (share @ bearing), rel=1e-7)
    assert np.all((bearing >= 0) & (bearing <= 1) & (contacts >= 0))


@pytest.mark.parametrize("name", MODELS)
@any_nodes
def test_larger_grains_have_more_contacts(name, nodes):
    radius, share = nodes
    order = np.argsort(radius)
    contacts, bearing = MODELS[name].contacts(radius, share)
    assert np.all(np.diff(contacts[order]) >= -1e-9)
    assert np.all(np.diff(bearing[order]) >= -1e-9)


@pytest.mark.parametrize("name", MODELS)
@settings(deadline=None, max_examples=25)
@given(few_radii(), st.floats(1e-6, 1e3), st.randoms(use_true_random=False))
def test_unit_of_length_and_order_of_radii_do_not_matter(name, grading, unit, random):
    radius, share = grading
    order = list(range(radius.size))
    random.shuffle(order)
    try:
        found = MODELS[name].contacts(radius, share)
    except FitError:
        return
    other = MODELS[name].contacts(radius[order] * unit, share[order])
    assert_allclose(other.contacts, found.contacts[order], rtol=1e-5)
    assert_allclose(other.load_bearing, found.load_bearing[order], rtol=1e-5)


@pytest.mark.parametrize("name", MODELS)
@any_nodes
def test_a_radius_given_in_two_halves_is_one_radius(name, nodes):
    radius, share = nodes
    found = MODELS[name].contacts(radius, share)
    halves = MODELS[name].contacts(np.repeat(radius, 2), np.repeat(share / 2, 2))
    assert_allclose(halves.contacts, np.repeat(found.contacts, 2), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("grading", ["uniform", "lognormal", "fractal"])
def test_how_finely_a_grading_is_cut_does_not_matter(name, grading):
    numbers, lengths = [], []
    for cells in (100, 200):
        radius, share = grading_nodes(GRADINGS[grading], cells)
        found = MODELS[name].contacts(radius, share)
        numbers.append(share @ found.contacts)
        lengths.append(2.0 * ends(share, found) @ radius)
    assert numbers[0] == pytest.approx(numbers[1], rel=0.01)
    assert lengths[0] == pytest.approx(lengths[1], rel=0.01)


@pytest.mark.parametrize("ratio", [2e3, 1e5])
@pytest.mark.parametrize("alpha", [2.3, 2.6, 2.9])
def test_fractal_gradings_of_any_ratio_settle(ratio, alpha):
    radius, share = grading_nodes(fractal(1.0, ratio, alpha))
    for model in MODELS.values():
        contacts, bearing = model.contacts(radius, share)
        assert share @ contacts == pytest.approx(6.0 * (share @ bearing), rel=1e-6)


# --- each model ----------------------------------------------------------------------------------


@any_nodes
def test_neighbours_of_mean_radius_cover_the_same_of_every_grain(nodes):
    radius, share = nodes
    found = mean_neighbour_contacts(radius, share)
    covered = found.contacts * solid_angle(radius, share @ radius)
    assert_allclose(covered, covered[0], rtol=1e-12)
    assert np.all(found.load_bearing == 1.0)


def test_contacts_by_surface_start_at_three():
    # <R^2> is 3: three contacts and R^2 more.
    found = surface_contacts(np.array([1.0, 3.0, 1e-6]), np.array([0.75, 0.25, 0.0]))
    assert_allclose(found.contacts, [4.0, 12.0, 3.0], rtol=1e-9)


@any_nodes
def test_drawn_neighbours_cover_the_same_of_every_load_bearing_grain(nodes):
    radius, share = nodes
    found = self_consistent_contacts(radius, share)
    angle, held = mean_angle(radius, share, found), found.load_bearing > 0
    covered = found.contacts[held] * angle[held]
    assert_allclose(covered, covered[0], rtol=1e-6)
    # Those above the cut bear, those that would be below have nothing.
    assert found.contacts[held].min() >= 3.5 - 1e-6
    assert np.all(found.contacts[~held] == 0.0)
    assert np.all(covered[0] / angle[~held] < 3.5 + 1e-6)


def test_no_grain_with_enough_contacts_is_an_error():
    with pytest.raises(FitError, match=r"6\.5 contacts"):
        self_consistent_contacts(np.array([1.0]), np.ones(1), least=6.5)
