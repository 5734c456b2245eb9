"""Contact numbers from the grading alone: what each model promises, checked by other means."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from scipy.stats import binom

from branchcrush.branches import coordination_models
from branchcrush.branches import predictions as length_predictions
from branchcrush.branches.coordination_models import (
    MODELS,
    PARKING_COVERAGE,
    mean_neighbour_contacts,
    parking_contacts,
    self_consistent_contacts,
    solid_angle,
    surface_contacts,
)
from branchcrush.branches.predictions import grading_nodes
from branchcrush.errors import FitError
from branchcrush.gradings.forms import fractal, lognormal, loguniform, normal, uniform
from branchcrush.gradings.mixtures import from_radii

SPHERE = 4.0 * np.pi
EQUAL = solid_angle(1.0, 1.0)
GRADINGS = {
    "narrow": normal(1.0, 0.05, 0.8, 1.2),
    "uniform": uniform(0.005, 1.0),
    "loguniform": loguniform(1.0, 20.0),
    "lognormal": lognormal(1.0, 1.8, 0.1, 10.0),
    "fractal": fractal(1.0, 200.0, 2.6),
    "two sizes": from_radii([1.0] * 9 + [1.5] * 4),
}


@pytest.fixture(params=GRADINGS)
def nodes(request):
    return grading_nodes(GRADINGS[request.param])


@st.composite
def few_radii(draw):
    """Return up to six radii within a factor of two, and their shares."""
    radius = draw(st.lists(st.floats(1.0, 2.0), min_size=1, max_size=6, unique=True))
    parts = draw(st.lists(st.floats(0.1, 1.0), min_size=len(radius), max_size=len(radius)))
    return np.array(radius), np.array(parts) / sum(parts)


def ends(share, found):
    """Return the shares of the ends of all contacts."""
    return share * found.contacts / (share @ found.contacts)


def mean_angle(radius, share, found):
    """Return the mean solid angle of a neighbour, seen from each grain."""
    return solid_angle(radius[:, None], radius) @ ends(share, found)


def stable_binomial(room, touching):
    """Return the mean of z if four or more, else 0, and the chance of that; by summing up."""
    expected, bearing = [], []
    for places in room:
        low = int(places)
        z = np.arange(4, low + 2)
        part = places - low
        chance = (1 - part) * binom.pmf(z, low, touching) + part * binom.pmf(z, low + 1, touching)
        expected.append(z @ chance)
        bearing.append(chance.sum())
    return np.array(expected), np.array(bearing)


# --- solid angle ---------------------------------------------------------------------------------


@pytest.mark.parametrize(("radius", "neighbour"), [(1.0, 1.0), (1.0, 0.2), (0.05, 1.0), (3.0, 2.0)])
def test_solid_angle_is_the_share_of_directions_that_hit_the_neighbour(radius, neighbour):
    # Even steps of the cosine are even steps of area. A ray from the centre misses the
    # neighbour's by the distance times the sine.
    cosine = (np.arange(400_000) + 0.5) / 200_000 - 1.0
    miss = (radius + neighbour) * np.sqrt(1.0 - cosine**2)
    hit = (cosine > 0) & (miss <= neighbour)
    assert solid_angle(radius, neighbour) == pytest.approx(SPHERE * hit.mean(), abs=SPHERE * 5e-6)


def test_twelve_neighbours_of_closest_packing_cover_0_80_of_the_sphere():
    # Each hides a cone of half angle 30 degrees, and centres are 60 degrees apart.
    covered = 12 * solid_angle(1.0, 1.0) / SPHERE
    assert covered == pytest.approx(6 * (1 - np.cos(np.pi / 6)), rel=1e-14)
    assert covered == pytest.approx(0.8038, abs=5e-5)


def test_huge_neighbour_covers_half_the_sphere_and_a_tiny_one_its_own_shadow():
    assert solid_angle(1.0, 1e9) == pytest.approx(2 * np.pi, rel=1e-4)
    assert solid_angle(1.0, 1e-3) == pytest.approx(np.pi * 1e-6, rel=3e-3)


# --- what all models share -----------------------------------------------------------------------


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("radius", [1e-6, 0.3, 200.0])
def test_equal_spheres_are_isostatic(name, radius):
    found = MODELS[name].contacts(np.array([radius]), np.ones(1))
    assert_allclose(found.contacts / found.load_bearing, 6.0, rtol=1e-9)
    assert 0.95 < found.load_bearing[0] <= 1.0


@pytest.mark.parametrize("name", MODELS)
def test_load_bearing_grains_have_six_contacts_on_average(name, nodes):
    radius, share = nodes
    contacts, bearing = MODELS[name].contacts(radius, share)
    assert share @ contacts == pytest.approx(6.0 * (share @ bearing), rel=1e-7)
    assert np.all((bearing >= 0) & (bearing <= 1) & (contacts >= 0))


@pytest.mark.parametrize("name", MODELS)
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
def test_a_radius_given_in_two_halves_is_one_radius(name, nodes):
    radius, share = nodes
    found = MODELS[name].contacts(radius, share)
    halves = MODELS[name].contacts(np.repeat(radius, 2), np.repeat(share / 2, 2))
    assert_allclose(halves.contacts, np.repeat(found.contacts, 2), rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("grading", ["uniform", "lognormal", "fractal"])
def test_how_finely_a_grading_is_cut_does_not_matter(name, grading, monkeypatch):
    numbers, lengths = [], []
    for cells in (100, 200):
        monkeypatch.setattr(length_predictions, "_CELLS", cells)
        radius, share = grading_nodes(GRADINGS[grading])
        found = MODELS[name].contacts(radius, share)
        numbers.append(share @ found.contacts)
        lengths.append(2.0 * ends(share, found) @ radius)
    assert numbers[0] == pytest.approx(numbers[1], rel=0.01)
    assert lengths[0] == pytest.approx(lengths[1], rel=0.01)


# --- each model ----------------------------------------------------------------------------------


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


def test_parked_neighbours_touch_with_one_probability(nodes):
    # Room from the result's own contacts, one probability for six on average: both come back.
    radius, share = nodes
    found = parking_contacts(radius, share)
    room = PARKING_COVERAGE * SPHERE / mean_angle(radius, share, found)
    assert np.all(found.contacts <= room)

    def excess(touching):
        expected, bearing = stable_binomial(room, touching)
        return share @ expected - 6.0 * (share @ bearing)

    touching = brentq(excess, 1.0 / room.max(), 1.0, xtol=1e-13)
    expected, bearing = stable_binomial(room, touching)
    assert_allclose(found.contacts, expected, rtol=1e-5, atol=1e-9)
    assert_allclose(found.load_bearing, bearing, rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize("places", [7.0, 8.0, 10.0, 7.5, 9.25])
def test_places_on_equal_spheres_are_taken_as_binomials_say(places, monkeypatch):
    monkeypatch.setattr(coordination_models, "PARKING_COVERAGE", places * EQUAL / SPHERE)
    found = parking_contacts(np.array([1.0]), np.ones(1))

    def stable(touching):
        return np.ravel(stable_binomial([places], touching))

    touching = brentq(lambda p: stable(p)[0] - 6.0 * stable(p)[1], 0.1, 1.0, xtol=1e-13)
    assert_allclose([found.contacts[0], found.load_bearing[0]], stable(touching), rtol=1e-6)


def test_fines_among_coarse_grains_are_mostly_rattlers():
    radius, share = grading_nodes(GRADINGS["uniform"])
    contacts, bearing = parking_contacts(radius, share)
    assert bearing[radius < 0.1].max() < 0.01
    assert bearing[radius > 0.9].min() > 0.99
    # Measured 3.9 near jamming, where Eq. 4 knows nothing of it and equal spheres have 6.
    assert 3.0 < share @ contacts < 4.5


def test_grains_without_room_for_six_neighbours_are_an_error(monkeypatch):
    monkeypatch.setattr(coordination_models, "PARKING_COVERAGE", 0.35)
    assert 0.35 * SPHERE / EQUAL < 6.0
    with pytest.raises(FitError, match="no room for six"):
        parking_contacts(np.array([1.0]), np.ones(1))


@pytest.mark.parametrize("ratio", [90.0, 170.0, 300.0])
@pytest.mark.parametrize("surface", [1e-8, 0.02, 0.15, 5.0])
def test_huge_grains_among_fines_carry_all_the_load_or_hardly_change_it(ratio, surface):
    # A huge grain has room for so many that few contacts on average need very unlikely ones.
    radius, share = np.array([1.0, ratio]), np.array([ratio**2, surface])
    contacts, bearing = parking_contacts(radius, share / share.sum())
    single, held = parking_contacts(np.ones(1), np.ones(1))
    coarse_alone = surface > 1.0
    # Without neighbours of the other size each is a packing of equal spheres.
    assert contacts[int(coarse_alone)] == pytest.approx(single[0], rel=1e-3)
    assert bearing[int(coarse_alone)] == pytest.approx(held[0], rel=5e-3)
    if coarse_alone:
        assert contacts[0] < 1e-9
    else:
        assert contacts[1] > 1e3


@pytest.mark.parametrize("ratio", [2e3, 1e5])
@pytest.mark.parametrize("alpha", [2.3, 2.6, 2.9])
def test_fractal_gradings_of_any_ratio_settle(ratio, alpha):
    radius, share = grading_nodes(fractal(1.0, ratio, alpha))
    for model in MODELS.values():
        contacts, bearing = model.contacts(radius, share)
        assert share @ contacts == pytest.approx(6.0 * (share @ bearing), rel=1e-6)
