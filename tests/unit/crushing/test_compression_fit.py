"""The resistance from a compression curve: known parameters come back, and silence does not."""

import numpy as np
import pytest

from branchcrush.crushing.compression_fit import (
    critical_energy_family,
    elastic_strain_family,
    fit_resistance,
)
from branchcrush.crushing.compression_line import (
    InterpolatedCriticalEnergy,
    compression_line,
)
from branchcrush.crushing.curves import LinearCurve, TabulatedCurve
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.evolution import evolve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import CriticalEnergy, ElasticStrainLimit
from branchcrush.errors import FitError

# A jamming point that moves to its densest at C = 0.7, and a network that grows stiffer.
KNOWN = np.linspace(0.0, 1.0, 11)
DENSITY = 0.65 + 0.4 * KNOWN * (1.4 - KNOWN)
FORM = ModelForm(
    TabulatedCurve(tuple(KNOWN), tuple(1.0 + 2.0 * KNOWN**2)),
    TabulatedCurve(tuple(KNOWN), tuple(DENSITY)),
)
LAW = PowerLawElasticity(4e9, 1.5)
LIMITS = elastic_strain_family(KNOWN, 1.0 - 0.7 * KNOWN, lambda b: -2.0 * b / 3.0)
ENERGIES = critical_energy_family(1e4, 1e8)


def yield_pressure(resistance):
    strain = resistance.yield_strain(0.0, FORM, LAW)
    return float(FORM.stress(FORM.total_strain(strain, 0.0), 0.0, LAW))


def made(family, scale, exponent, scatter=0.0, seed=1, beyond=8.0, points=24):
    """Return the pressures and strains of a test of known parameters, by the exact evolution."""
    resistance = family.resistance(scale, exponent)
    begins = yield_pressure(resistance)
    pressure = np.geomspace(begins / 5.0, begins * beyond, points)
    strain = evolve(pressure, FORM, LAW, resistance, "stress").strain
    return pressure, strain + np.random.default_rng(seed).normal(0.0, scatter, points)


def test_below_the_beginning_of_crushing_all_strain_is_elastic():
    resistance = ElasticStrainLimit(0.01)
    pressure = np.array([0.1, 0.5, 0.99]) * yield_pressure(resistance)
    line = compression_line(pressure, FORM, LAW, resistance)
    assert line.crushing.tolist() == [0.0, 0.0, 0.0]
    np.testing.assert_allclose(line.strain, (pressure / 4e9) ** (2 / 3), rtol=1e-12)


def test_on_the_line_a_state_yields_at_its_own_void_ratio_and_pressure():
    # e = (1 - eps_e)/phi_J - 1 and p = S p_0(eps_e), with an elastic strain that stays.
    crushing = np.array([0.1, 0.3, 0.5])
    pressure = (1.0 + 2.0 * crushing**2) * 4e9 * 0.01**1.5
    line = compression_line(pressure, FORM, LAW, ElasticStrainLimit(0.01))
    np.testing.assert_allclose(line.crushing, crushing, atol=2e-3)
    density = 0.65 + 0.4 * crushing * (1.4 - crushing)
    void_ratio = (1.0 - line.strain) / 0.65 - 1.0
    np.testing.assert_allclose(void_ratio, (1.0 - 0.01) / density - 1.0, atol=1e-3)


@pytest.mark.parametrize(
    "resistance",
    [
        LIMITS.resistance(0.01, 1.0),
        LIMITS.resistance(0.02, 3.0),
        InterpolatedCriticalEnergy(2e6, 2.0),
    ],
)
def test_the_line_is_that_of_the_exact_evolution(resistance):
    pressure = np.geomspace(0.2, 20.0, 13) * yield_pressure(resistance)
    exactly = CriticalEnergy(2e6, 2.0) if hasattr(resistance, "energy") else resistance
    exact = evolve(pressure, FORM, LAW, exactly, "stress")
    line = compression_line(pressure, FORM, LAW, resistance)
    np.testing.assert_allclose(line.crushing, exact.crushing, atol=2e-3)
    np.testing.assert_allclose(line.strain, exact.strain, atol=5e-4)


def test_crushing_goes_no_farther_than_it_sets_energy_free():
    line = compression_line([1e7, 1e8, 1e9], FORM, LAW, ElasticStrainLimit(0.01))
    assert 0.5 < line.crushing[1] == line.crushing[2] < 0.7


@pytest.mark.parametrize(
    ("family", "scale", "exponent"),
    [(LIMITS, 0.0125, 1.0), (LIMITS, 0.02, 3.0), (ENERGIES, 2e6, 1.5)],
)
def test_known_parameters_come_back_from_exact_strains(family, scale, exponent):
    fit = fit_resistance(*made(family, scale, exponent), FORM, LAW, family)
    assert fit.scale.estimate == pytest.approx(scale, rel=0.01)
    assert fit.exponent.estimate == pytest.approx(exponent, abs=0.03)
    assert fit.scale.determined and fit.exponent.determined
    assert fit.residual < 5e-4


def test_known_parameters_lie_in_their_intervals_as_often_as_these_say():
    hits = np.zeros(2)
    for seed in range(6):
        fit = fit_resistance(*made(LIMITS, 0.0125, 1.0, 2e-3, seed), FORM, LAW, LIMITS)
        hits += [
            fit.scale.low <= 0.0125 <= fit.scale.high,
            fit.exponent.low <= 1.0 <= fit.exponent.high,
        ]
        assert fit.residual == pytest.approx(2e-3, rel=0.4)
    # Of 6 with 95 %, fewer than 4 come by chance once in 400.
    assert (hits >= 4).all()


def test_intervals_grow_with_the_scatter():
    widths = []
    for scatter in (2.5e-4, 1e-3):
        scale = fit_resistance(*made(LIMITS, 0.0125, 1.0, scatter), FORM, LAW, LIMITS).scale
        widths.append(np.log(scale.high / scale.low))
    assert widths[1] / widths[0] == pytest.approx(4.0, rel=0.3)


def test_a_curve_that_ends_before_crushing_determines_nothing():
    pressure, strain = made(LIMITS, 0.0125, 1.0, 1e-4, beyond=0.9)
    fit = fit_resistance(pressure, strain, FORM, LAW, LIMITS)
    assert not fit.scale.determined and not fit.exponent.determined


def test_two_points_beyond_the_beginning_determine_no_two_parameters():
    pressure, strain = made(LIMITS, 0.0125, 1.0, points=6)
    few = slice(0, int(np.sum(pressure <= yield_pressure(LIMITS.resistance(0.0125, 1.0)))) + 2)
    fit = fit_resistance(pressure[few], strain[few], FORM, LAW, LIMITS)
    assert fit.crushed == 2
    assert not fit.scale.determined and not fit.exponent.determined


def test_an_exponent_that_changes_nothing_is_not_determined_and_the_scale_is():
    # Grains that carry load keep their size: no b can be told.
    same = elastic_strain_family(KNOWN, np.ones(11), lambda b: -2.0 * b / 3.0)
    fit = fit_resistance(*made(same, 0.0125, 1.0, 1e-3), FORM, LAW, same)
    assert not fit.exponent.determined


def test_where_crushing_locks_is_told():
    pressure, strain = made(LIMITS, 0.0125, 1.0, beyond=30.0)
    fit = fit_resistance(pressure, strain, FORM, LAW, LIMITS)
    exact = evolve(pressure, FORM, LAW, LIMITS.resistance(0.0125, 1.0), "stress").crushing
    locked = pressure[np.argmax(exact >= exact[-1] - 1e-6)]
    assert fit.locked == pytest.approx(locked, rel=0.25)
    free = fit_resistance(*made(LIMITS, 0.0125, 1.0, beyond=2.0), FORM, LAW, LIMITS)
    assert free.locked is None


@pytest.mark.parametrize(
    ("pressure", "strain"),
    [
        ([1e6, 2e6, 3e6], [0.1, 0.2, 0.3]),
        ([0.0, 1e6, 2e6, 3e6], [0.0, 0.1, 0.2, 0.3]),
        ([1e6, 3e6, 2e6, 4e6], [0.1, 0.2, 0.3, 0.4]),
        ([1e6, 2e6, 3e6, 4e6], [0.1, 0.2, 0.3, np.nan]),
        ([1e6, 2e6, 3e6, 4e6], [0.1, 0.2, 0.3]),
    ],
)
def test_numbers_that_are_no_compression_are_refused(pressure, strain):
    form = ModelForm(LinearCurve(0.0), FORM.jamming)
    with pytest.raises(FitError):
        fit_resistance(np.array(pressure), np.array(strain), form, LAW, LIMITS)
