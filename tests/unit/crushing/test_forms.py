"""Forms of the crushing model: values by hand, and a potential that its derivatives agree with."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.crushing.curves import LinearCurve, PorosityCurve, TabulatedCurve
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.forms import ModelForm

AT = (0.0, 0.2, 0.5, 0.8, 1.0)
MOVING = ModelForm(
    TabulatedCurve(AT, (2.0, 2.2, 3.0, 7.0, 8.0)), TabulatedCurve(AT, (0.65, 0.7, 0.76, 0.77, 0.74))
)
FORMS = {
    "paper": ModelForm(LinearCurve(0.6)),
    "releases less": ModelForm(LinearCurve(-0.4)),
    "porosity": ModelForm(LinearCurve(0.3), PorosityCurve(0.4, 0.7)),
    "moving": MOVING,
}


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
def test_the_paper_form_by_hand(exponent):
    law = PowerLawElasticity(2.0, exponent)
    form, power = ModelForm(LinearCurve(0.6)), exponent + 1.0
    energy = 2.0 * 0.1**power / power
    assert form.free_energy(0.1, 0.5, law) == pytest.approx(0.7 * energy, rel=1e-12)
    assert form.stress(0.1, 0.5, law) == pytest.approx(0.7 * 2.0 * 0.1**exponent, rel=1e-12)
    assert form.driving_force(0.1, 0.5, law) == pytest.approx(0.6 * energy, rel=1e-12)


@pytest.mark.parametrize("exponent", [1.0, 1.5])
def test_the_driving_force_of_a_moving_jamming_point_for_a_power_law(exponent):
    law, a = PowerLawElasticity(3.0, exponent), exponent + 1.0
    at = np.array([0.1, 0.3, 0.6, 0.9])
    strain = MOVING.total_strain(0.02, at)
    p = MOVING.stress(strain, at, law)
    moved = MOVING.jamming.log_slope(at)
    stiffer = MOVING.factor.log_slope(at)
    expected = p / MOVING.jamming.value(at) * (moved * (0.98 + 0.02 / a) - stiffer * 0.02 / a)
    np.testing.assert_allclose(MOVING.driving_force(strain, at, law), expected, rtol=1e-10)


@pytest.mark.parametrize("name", FORMS)
@settings(max_examples=40, deadline=None)
@given(
    elastic=st.floats(1e-3, 0.1),
    crushing=st.floats(0.01, 0.97),
    exponent=st.floats(1.0, 2.5),
)
def test_stress_and_driving_force_are_derivatives_of_the_free_energy(
    name, elastic, crushing, exponent
):
    form, law, step = FORMS[name], PowerLawElasticity(1e6, exponent), 1e-6
    if np.abs(form.knots - crushing).min() < 2 * step:
        crushing += 4 * step
    strain = float(form.total_strain(elastic, crushing))

    def psi(more_strain, more_crushing):
        return float(form.free_energy(strain + more_strain, crushing + more_crushing, law))

    by_strain = (psi(step, 0.0) - psi(-step, 0.0)) / (2 * step)
    by_crushing = (psi(0.0, -step) - psi(0.0, step)) / (2 * step)
    stress = float(form.stress(strain, crushing, law))
    assert by_strain == pytest.approx(stress, rel=1e-5)
    assert by_crushing == pytest.approx(
        float(form.driving_force(strain, crushing, law)), rel=1e-4, abs=1e-5 * stress
    )
    stiffness = (
        form.stress(strain + step, crushing, law) - form.stress(strain - step, crushing, law)
    ) / (2 * step)
    assert form.tangent_stiffness(strain, crushing, law) == pytest.approx(stiffness, rel=1e-4)


@pytest.mark.parametrize("name", FORMS)
def test_strains_there_and_back(name):
    form, at = FORMS[name], np.linspace(0.0, 0.99, 12)
    there = form.total_strain(0.03, at)
    np.testing.assert_allclose(form.elastic_strain(there, at), 0.03, rtol=1e-13)


def test_a_form_is_meant_as_far_as_its_curves_are_known():
    known = ModelForm(
        TabulatedCurve((0.0, 0.5), (1.0, 2.0)), TabulatedCurve((0.0, 0.7), (1.0, 1.1))
    )
    assert known.knots.tolist() == [0.0, 0.5]


def test_a_table_is_met_at_its_values_and_rises_where_they_do():
    curve = TabulatedCurve((0.0, 0.1, 0.5, 1.0), (2.0, 2.0, 6.0, 5.0))
    np.testing.assert_allclose(curve.value(curve.knots), [1.0, 1.0, 3.0, 2.5])
    between = curve.value(np.linspace(0.1, 0.5, 50))
    assert (np.diff(between) > 0).all() and (curve.value(np.linspace(0.0, 0.1, 9)) == 1.0).all()


@pytest.mark.parametrize(
    ("crushing", "values"),
    [
        ((0.0,), (1.0,)),
        ((0.1, 1.0), (1.0, 2.0)),
        ((0.0, 1.1), (1.0, 2.0)),
        ((0.0, 0.0, 1.0), (1.0, 1.0, 2.0)),
        ((0.0, 1.0), (1.0, 0.0)),
        ((0.0, 1.0), (1.0, np.nan)),
        ((0.0, 1.0), (1.0, 2.0, 3.0)),
    ],
)
def test_no_such_table(crushing, values):
    with pytest.raises(ValueError, match="rise from 0 to 1"):
        TabulatedCurve(crushing, values)
