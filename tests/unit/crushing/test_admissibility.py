"""What of a form can be: where it costs energy, leaps, snaps, softens and has gaps."""

import numpy as np
import pytest

from branchcrush.crushing.admissibility import (
    admissibility,
    force_over_stress,
    least_hardening_exponent,
    yielding_strain,
)
from branchcrush.crushing.curves import LinearCurve, TabulatedCurve
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.evolution import evolve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.leaps import load_leaps
from branchcrush.crushing.resistance import CriticalEnergy, ElasticStrainLimit
from branchcrush.crushing.yield_line import YieldLine

LINEAR = PowerLawElasticity(1e9, 1.0)
PAPER = ModelForm(LinearCurve(0.6))
AT = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
# Densest at 0.6, as stiff all along.
DENSEST = ModelForm(
    LinearCurve(0.0), TabulatedCurve(AT, (0.640, 0.680, 0.710, 0.720, 0.710, 0.690))
)
# Denser all along, and suddenly stiffer between 0.4 and 0.6.
STIFFER = ModelForm(
    TabulatedCurve(AT, (1.0, 1.1, 1.2, 900.0, 910.0, 920.0)),
    TabulatedCurve(AT, (0.64, 0.66, 0.68, 0.70, 0.72, 0.74)),
)


def test_a_form_that_is_admissible_has_nothing_to_tell():
    found = admissibility(PAPER, LINEAR, CriticalEnergy(1e5, 2.0), 0.2)
    assert found.admissible and found.hardens_at_onset
    assert (found.costs, found.leaps, found.snaps, found.sentences) == ((), (), (), ())


def test_energy_is_set_free_up_to_the_densest_mixture():
    found = admissibility(DENSEST, LINEAR, ElasticStrainLimit(0.0125), 0.2)
    assert not found.admissible
    ((begin, end),) = found.costs
    assert (begin, end) == (pytest.approx(0.6, abs=1e-6), 1.0)
    assert found.sentences == (
        "From C = 0.6 on crushing would cost elastic energy: the densest mixture is at C = 0.6, "
        "and more fines loosen it.",
        # No stiffer, at one elastic strain: at one stress.
        "C snaps from 0 to 0.6 at 12.5 MPa, by itself.",
    )


def test_energy_is_not_set_free_where_fines_begin_to_carry_load():
    found = admissibility(STIFFER, LINEAR, ElasticStrainLimit(0.0125), 0.2)
    (begin, end), *others = found.costs
    assert not others and 0.4 < begin < end < 0.6
    # There (ln j)' (1 - eps_e/2) = (ln S)' eps_e/2.
    for at in (begin, end):
        moved = float(STIFFER.jamming.log_slope(at)) * (1.0 - 0.0125 / 2.0)
        assert moved == pytest.approx(float(STIFFER.factor.log_slope(at)) * 0.0125 / 2, rel=1e-5)
    assert f"From C = {begin:.3g} to {end:.3g} crushing would cost" in found.sentences[0]
    assert "fines begin to carry load" in found.sentences[0]


def test_energy_that_grows_with_crushing_is_told_from_the_first():
    found = admissibility(ModelForm(LinearCurve(-0.2)), LINEAR, CriticalEnergy(1e5, 2.0), 0.1)
    assert found.costs == ((0.0, 1.0),)
    assert "at equal strain more is stored as C grows" in found.sentences[0]


@pytest.mark.parametrize("form", [ModelForm(LinearCurve(0.0)), ModelForm(LinearCurve(1e-13))])
def test_a_form_in_which_nothing_changes_says_so(form):
    found = admissibility(form, LINEAR, ElasticStrainLimit(0.0125), 0.2)
    assert found.sentences == (
        "Crushing changes nothing in this form: the grading is the ultimate one already.",
    )


def test_a_resistance_below_the_bound_snaps_from_the_onset():
    # The paper's form softens at once below s = theta (1 + 1/m) = 1.2: at C = 0, where p_y is
    # the modulus times the root of 2 E_c0/(theta A).
    found = admissibility(PAPER, LINEAR, CriticalEnergy(1e5, 1.0), 0.2)
    (snap,) = found.snaps
    assert snap.crushing == pytest.approx(0.0, abs=1e-6)
    assert snap.load == pytest.approx(1e9 * np.sqrt(2e5 / 0.6e9), rel=1e-6)
    assert not found.hardens_at_onset and not found.leaps
    # It holds the load again where (1 - 0.6 C)^2 = 1 - C at C = 5/9.
    assert snap.crushing_after == pytest.approx(5.0 / 9.0, rel=1e-6)
    assert found.sentences == ("C snaps from 0 to 0.556 at 18.3 MPa, by itself.",)


def test_a_form_that_hardens_at_onset_may_snap_farther_on():
    # Little is lost up to C = 0.4, and nearly half between there and 0.6.
    form = ModelForm(TabulatedCurve((0.0, 0.2, 0.4, 0.6, 1.0), (1.0, 0.95, 0.9, 0.5, 0.4)))
    found = admissibility(form, LINEAR, CriticalEnergy(1e5, 2.0), 0.4)
    assert found.hardens_at_onset and found.snaps[0].crushing > 0.1


def test_a_constant_resistance_leaps_to_the_end_at_one_strain():
    found = admissibility(PAPER, LINEAR, CriticalEnergy(1e5, 0.0), 0.2)
    (leap,) = found.leaps
    assert (leap.crushing, leap.load) == (0.0, pytest.approx(np.sqrt(2e5 / 0.6e9), rel=1e-9))
    assert leap.crushing_after == pytest.approx(1.0, abs=1e-9)
    assert not found.admissible


def test_a_limit_of_elastic_strain_leaves_a_jamming_point_that_stays_undecided():
    found = admissibility(PAPER, LINEAR, ElasticStrainLimit(0.01), 0.2)
    assert [leap.load for leap in found.leaps] == [pytest.approx(0.01)]
    assert "C leaps from 0 to 1 at a strain of 0.01, by itself." in found.sentences


def test_snaps_are_the_jumps_of_a_history():
    form = ModelForm(TabulatedCurve((0.0, 0.2, 0.4, 0.6, 1.0), (1.0, 0.95, 0.9, 0.5, 0.4)))
    law, resistance = PowerLawElasticity(1.0, 1.0), CriticalEnergy(2e-3, 2.0)
    for control in ("strain", "stress"):
        leaps = load_leaps(YieldLine(form, law, resistance, control), 0.49)
        assert leaps
        path = evolve([1.001 * leaps[-1].load], form, law, resistance, control)
        jumps = [event for event in path.events if event.kind == "jump"]
        for jump, leap in zip(jumps, leaps, strict=True):
            assert leap.crushing == pytest.approx(jump.crushing, abs=1e-6)
            assert leap.crushing_after == pytest.approx(jump.crushing_after, abs=1e-6)


def test_an_elastic_domain_that_is_not_convex_is_told_with_its_strain():
    # Twice as stiff at C = 1, a fifth denser: the force falls from some strain on.
    form = ModelForm(LinearCurve(-6.0), LinearCurve(-0.2))
    found = admissibility(form, LINEAR, CriticalEnergy(1e5, 1.0), 0.3)
    # At C = 0 the bracket 0.2 (1 - eps/2) - 6 eps/2 is 0 at eps = 0.2/3.1.
    assert found.gap_from == 0.0
    assert "From C = 0 on the elastic domain is not convex: beyond" in found.sentences[-1]


def test_the_least_hardening_of_a_moving_jamming_point_by_hand():
    # j = 1 + C/5 and g = 1: at one stress E_C goes as j'/j^2, whose logarithm falls by 2/5.
    form = ModelForm(LinearCurve(0.0), LinearCurve(-0.2))
    assert least_hardening_exponent(form, LINEAR, 0.02) == pytest.approx(-0.4, rel=1e-6)


def test_yielding_strain_is_that_of_the_onset_where_some_never_yield():
    resistance = CriticalEnergy(1e5, 2.0)
    onset = np.sqrt(2e5 / 0.6e9)
    at = np.array([0.0, 0.5, 0.999999999])
    np.testing.assert_allclose(yielding_strain(PAPER, LINEAR, resistance, 0.2, at), onset)
    own = yielding_strain(PAPER, LINEAR, resistance, 0.2, at[:2])
    np.testing.assert_allclose(own, [onset, 2.0 * onset], rtol=1e-9)


def test_force_over_stress_of_the_paper_form_by_hand():
    # theta Psi_0/((1 - theta C) p_0) with Psi_0/p_0 = eps/2.
    force = force_over_stress(PAPER, LINEAR, 0.1, np.array([0.0, 0.5]))
    np.testing.assert_allclose(force, [0.03, 0.03 / 0.7], rtol=1e-12)
