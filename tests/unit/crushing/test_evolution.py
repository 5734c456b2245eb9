"""Histories of crushing: closed forms, the balance of energy, jumps and locks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.crushing.curves import LinearCurve, TabulatedCurve
from branchcrush.crushing.elasticity import PowerLawElasticity, pressure_dependent
from branchcrush.crushing.evolution import evolve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.interpolated_elasticity import InterpolatedElasticity
from branchcrush.crushing.resistance import CriticalEnergy, ElasticStrainLimit
from branchcrush.crushing.yield_line import YieldLine

PAPER = ModelForm(LinearCurve(0.6))
AT = (0.0, 1 / 8, 1 / 4, 3 / 8, 1 / 2, 3 / 4, 1.0)
MOVING = ModelForm(
    TabulatedCurve(AT, (1.0, 1.20, 1.53, 2.26, 3.83, 4.73, 4.90)),
    TabulatedCurve(AT, (0.6515, 0.6862, 0.7208, 0.7510, 0.7650, 0.7597, 0.7434)),
)


@pytest.mark.parametrize(
    ("exponent", "end", "crushing", "stress", "stored", "dissipated"),
    [
        (
            1.0,
            0.1,
            0.42264973081037427,
            0.07464101615137755,
            3.732050807568878e-3,
            7.320508075688773e-4,
        ),
        (1.5, 0.2, 0.517378256129888, 0.06167728828111, None, None),
        (2.0, 0.2, 0.209430584957905, 0.034973665961010, None, None),
    ],
)
def test_closed_forms_of_the_paper_form(exponent, end, crushing, stress, stored, dissipated):
    law = PowerLawElasticity(1.0, exponent)
    path = evolve([end], PAPER, law, CriticalEnergy(1e-3, 2.0))
    assert path.crushing[-1] == pytest.approx(crushing, rel=1e-12)
    assert path.stress[-1] == pytest.approx(stress, rel=1e-12)
    if stored is not None:
        assert path.stored[-1] == pytest.approx(stored, rel=1e-12)
        assert path.dissipated[-1] == pytest.approx(dissipated, rel=1e-12)
    yield_strain = ((exponent + 1.0) * 1e-3 / 0.6) ** (1.0 / (exponent + 1.0))
    assert path.events[0].kind == "yield"
    assert path.events[0].strain == pytest.approx(yield_strain, rel=1e-12)


def test_history_does_not_matter_beyond_the_largest_strain():
    law, resistance = PowerLawElasticity(1.0, 1.5), CriticalEnergy(1e-3, 2.0)
    straight = evolve([0.3], PAPER, law, resistance)
    steps = evolve([0.1, 0.02, 0.2, 0.0, 0.15, 0.3], PAPER, law, resistance)
    assert steps.crushing[-1] == pytest.approx(straight.crushing[-1], rel=1e-12)
    assert steps.dissipated[-1] == pytest.approx(straight.dissipated[-1], rel=1e-11)
    assert steps.crushing[1] == steps.crushing[0] and steps.crushing[4] == steps.crushing[2]


def test_stress_control_reaches_the_stresses_that_were_asked_for():
    law, stresses = PowerLawElasticity(1e9, 1.0), [5e6, 2e7, 1e7, 0.0, 8e7]
    for resistance in (ElasticStrainLimit(0.0125), CriticalEnergy(5e6, 2.0)):
        path = evolve(stresses, MOVING, law, resistance, control="stress")
        np.testing.assert_allclose(path.stress, stresses, rtol=1e-9, atol=1e-3)


def test_strain_and_stress_control_meet():
    law, resistance = PowerLawElasticity(1e9, 1.0), CriticalEnergy(5e6, 2.0)
    strained = evolve([0.1, 0.13], MOVING, law, resistance)
    pressed = evolve(strained.stress, MOVING, law, resistance, control="stress")
    np.testing.assert_allclose(pressed.strain, strained.strain, rtol=1e-9)
    np.testing.assert_allclose(pressed.crushing, strained.crushing, rtol=1e-9)


LIMIT = ElasticStrainLimit(0.0125)


def test_a_limit_of_elastic_strain_is_held():
    law = PowerLawElasticity(1e9, 1.5)
    path = evolve(np.linspace(0.02, 0.14, 9), MOVING, law, LIMIT)
    np.testing.assert_allclose(path.elastic_strain, 0.0125, rtol=1e-10)
    assert (np.diff(path.crushing) > 0).all()


def test_crushing_locks_where_it_would_cost_energy():
    law = PowerLawElasticity(1e9, 1.0)
    path = evolve([0.1, 0.3], MOVING, law, ElasticStrainLimit(0.0125))
    assert path.events[-1].kind == "lock"
    locked = path.crushing[-1]
    # Just below the densest of the gradings, at C = 1/2 of the table.
    assert 0.45 < locked <= 0.5
    at_limit = MOVING.total_strain(0.0125, locked + np.array([-1e-3, 1e-3]))
    force = MOVING.driving_force(at_limit, locked + np.array([-1e-3, 1e-3]), law)
    assert force[0] > 0.0 >= force[1]


@pytest.mark.parametrize("control", ["strain", "stress"])
def test_crushing_that_comes_to_its_last_c_is_complete_and_no_lock(control):
    # By the paper's form more crushing sets energy free at every C.
    law = PowerLawElasticity(1e9, 1.0)
    path = evolve([0.02 if control == "strain" else 2e7] * 2, PAPER, law, LIMIT, control)
    assert [event.kind for event in path.events][-1] == "complete"
    assert "lock" not in [event.kind for event in path.events]
    assert path.crushing[-1] == pytest.approx(1.0, abs=1e-9)


def test_a_constant_critical_energy_jumps_and_the_jump_is_booked():
    # Half of it hardens, then the driving force rises: the paper's form with two slopes.
    energy = TabulatedCurve((0.0, 0.2, 0.4, 0.6, 1.0), (1.0, 0.95, 0.9, 0.5, 0.4))
    law, form = PowerLawElasticity(1.0, 1.0), ModelForm(energy)
    path = evolve([0.2, 0.45], form, law, CriticalEnergy(2e-3, 0.5))
    jump = next(event for event in path.events if event.kind == "jump")
    released = form.free_energy(jump.strain, jump.crushing, law) - form.free_energy(
        jump.strain, jump.crushing_after, law
    )
    assert jump.crushing_after > jump.crushing
    assert jump.dissipated == pytest.approx(float(released), rel=1e-9)
    assert np.isfinite(path.work).all()
    np.testing.assert_allclose(path.work, path.stored + path.dissipated, rtol=1e-10)


def test_plastic_work_exceeds_dissipation_by_what_the_stiffer_grading_stores():
    # At a held elastic strain e of a linear law: stress g M e, energy M e^2/2 times g/j, so that
    # plastic work less dissipation is M e^2/2 times the integral of (g/j) d(ln j + ln g).
    law, limit = PowerLawElasticity(1e9, 1.0), 0.0125
    moving = evolve([0.1], MOVING, law, ElasticStrainLimit(limit))
    to = np.linspace(0.0, moving.crushing[-1], 20001)
    g, j = MOVING.factor.value(to), MOVING.jamming.value(to)
    more = 0.5e9 * limit**2 * np.trapezoid(g / j, np.log(g * j))
    assert more > 0.0
    assert moving.compaction[-1] - moving.dissipated[-1] == pytest.approx(more, rel=1e-6)
    fixed = evolve([0.2], PAPER, law, CriticalEnergy(1e5, 2.0))
    assert fixed.compaction[-1] == 0.0


@settings(max_examples=25, deadline=None)
@given(
    history=st.lists(st.floats(0.0, 0.16), min_size=1, max_size=6),
    exponent=st.floats(1.0, 2.2),
    critical=st.floats(1e5, 2e7),
    hardening=st.sampled_from([0.0, 0.5, 1.0, 2.0, 3.0]),
    moving=st.booleans(),
    control=st.sampled_from(["strain", "stress"]),
)
def test_work_is_stored_or_dissipated(history, exponent, critical, hardening, moving, control):
    law, form = PowerLawElasticity(1e9, exponent), MOVING if moving else PAPER
    load = np.array(history) if control == "strain" else 1e9 * np.array(history) ** (exponent + 1)
    path = evolve(load, form, law, CriticalEnergy(critical, hardening), control)
    assert np.isfinite(path.work).all()
    scale = max(np.abs(path.work).max(), 1.0)
    np.testing.assert_allclose(path.work, path.stored + path.dissipated, atol=1e-10 * scale)
    assert (np.diff(path.crushing, prepend=0.0) >= 0.0).all()
    assert (np.diff(path.dissipated, prepend=0.0) >= -1e-12 * scale).all()


@pytest.mark.parametrize("control", ["strain", "stress"])
def test_crushing_locks_where_the_driving_force_stays_below_the_resistance(control):
    # Next to the densest grading the force has a peak at some strain, and that sinks.
    law, resistance = PowerLawElasticity(1e9, 1.5), CriticalEnergy(4e5, 2.0)
    load = np.array([0.05, 0.02, 0.15, 0.2, 0.3])
    load = load if control == "strain" else 2e8 * load
    path = evolve(load, MOVING, law, resistance, control)
    assert [event.kind for event in path.events] == ["yield", "lock"]
    np.testing.assert_allclose(path.work, path.stored + path.dissipated, rtol=1e-10)
    locked = path.crushing[-1]
    strains = MOVING.total_strain(np.geomspace(1e-4, 0.3, 100_001), locked)
    peak = resistance.excess(strains, locked, MOVING, law).max()
    assert peak == pytest.approx(0.0, abs=1e-8)


def test_what_yields_at_once_balances_too():
    # The driving force is above the resistance at every strain that is looked at.
    law, resistance = PowerLawElasticity(1e9, 0.1), CriticalEnergy(1.0, 2.0)
    path = evolve([0.01, 0.0, 0.05], MOVING, law, resistance)
    assert path.events[0].strain == pytest.approx(1e-8, rel=1e-6)
    np.testing.assert_allclose(path.work, path.stored + path.dissipated, rtol=1e-10)


DEM = InterpolatedElasticity(
    (0.0143, 0.0334, 0.0523, 0.0709, 0.1074, 0.1429, 0.1774, 0.1944),
    (9.60e3, 5.33e4, 1.42e5, 2.86e5, 7.66e5, 1.543e6, 2.625e6, 3.307e6),
)


@settings(max_examples=8, deadline=None)
@given(
    law=st.sampled_from([DEM, pressure_dependent(5e7, 1 / 3, 1e6, onset_strain=0.01)]),
    history=st.lists(st.floats(0.0, 0.24), min_size=1, max_size=5),
    critical=st.floats(1e5, 2e6),
    hardening=st.sampled_from([0.0, 0.5, 2.0]),
    form=st.sampled_from([PAPER, MOVING]),
    control=st.sampled_from(["strain", "stress"]),
)
def test_work_is_stored_or_dissipated_with_any_law(
    law, history, critical, hardening, form, control
):
    load = np.array(history) if control == "strain" else 1e8 * np.array(history)
    path = evolve(load, form, law, CriticalEnergy(critical, hardening), control)
    scale = max(np.abs(path.work).max(), 1.0)
    # To rounding; but where the yield line reaches a measured state as steeply as a root its
    # quadrature is good to 2e-6.
    limit = 5e-6 if law is DEM else 1e-10
    np.testing.assert_allclose(path.work, path.stored + path.dissipated, atol=limit * scale)
    assert (np.diff(path.crushing, prepend=0.0) >= 0.0).all()


@pytest.mark.parametrize("critical", [471920.0, 472500.0, 480000.0])
@pytest.mark.parametrize("control", ["strain", "stress"])
def test_crushing_halts_where_the_first_of_two_peaks_no_longer_reaches_the_resistance(
    critical, control
):
    # The force of a law that passes measured states has a peak on either side of one. Once the
    # first is too low, the load rises by a step, in which nothing is dissipated.
    load = [0.1745] if control == "strain" else [1.745e7]
    path = evolve(load, MOVING, DEM, CriticalEnergy(critical, 0.0), control)
    np.testing.assert_allclose(path.work, path.stored + path.dissipated, rtol=1e-10)
    line = YieldLine(MOVING, DEM, CriticalEnergy(480000.0, 0.0), control)
    (after,) = line.halts
    before = np.nextafter(after, 0.0)
    assert line.load_at(after) > 1.005 * line.load_at(before)
    assert path.crushing[0] > 0.46


def test_limits_of_strain_pass_the_states_of_a_measured_law():
    # The limit falls with C from beyond the last state to the first: kinks all along.
    limit = ElasticStrainLimit(0.2, LinearCurve(0.95))
    path = evolve([0.15, 0.21, 0.24, 0.1, 0.28], MOVING, DEM, limit)
    assert path.crushing[-1] > 0.3
    np.testing.assert_allclose(path.work, path.stored + path.dissipated, rtol=1e-10)


@pytest.mark.parametrize("load", [[], [[0.1]], [np.nan], [np.inf]])
def test_no_history(load):
    with pytest.raises(ValueError, match="one row of finite numbers"):
        evolve(load, PAPER, PowerLawElasticity(1.0, 1.0), CriticalEnergy(1.0, 2.0))


def test_no_negative_stress():
    with pytest.raises(ValueError, match="must not be below 0"):
        evolve([-1.0], PAPER, PowerLawElasticity(1.0, 1.0), CriticalEnergy(1.0, 2.0), "stress")


@pytest.mark.parametrize(("load", "control"), [(0.6, "strain"), (10.0, "stress")])
def test_no_elastic_law_is_meant_for_such_a_load(load, control):
    with pytest.raises(ValueError, match="elastic strain"):
        evolve([load], PAPER, PowerLawElasticity(1.0, 1.0), CriticalEnergy(1e9, 2.0), control)
