"""Energies of gradings beside each other, and the compression line, in closed form."""

import numpy as np
import pytest

from branchcrush.crushing.curves import LinearCurve, TabulatedCurve
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.energy_ratios import (
    ratio_at_equal_strain,
    ratio_at_equal_stress,
    ratio_at_equal_total_strain,
)
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import CriticalEnergy, ElasticStrainLimit
from branchcrush.crushing.yield_line import compression_line

STIFFER = ModelForm(TabulatedCurve((0.0, 0.5, 1.0), (1.0, 4.0, 8.0)), LinearCurve(-0.2))
AT = np.array([0.0, 0.5, 1.0])


@pytest.mark.parametrize(("exponent", "power"), [(1.0, -1.0), (1.5, -2.0 / 3.0), (2.0, -0.5)])
def test_at_equal_stress_a_stiffer_network_stores_less(exponent, power):
    law = PowerLawElasticity(3e8, exponent)
    ratio = ratio_at_equal_stress(STIFFER, AT, law, 2e6)
    np.testing.assert_allclose(ratio, np.array([1.0, 4.0, 8.0]) ** power, rtol=1e-12)


def test_at_equal_strain_it_stores_more():
    np.testing.assert_allclose(ratio_at_equal_strain(STIFFER, AT), [1.0, 4.0, 8.0])


def test_at_equal_solid_fraction_the_jamming_point_is_farther_away():
    # j = 1, 1.1, 1.2; eps_e = 1 - j 0.85 = 0.15, 0.065 and none.
    law = PowerLawElasticity(3e8, 1.0)
    ratio = ratio_at_equal_total_strain(STIFFER, AT, law, 0.15)
    np.testing.assert_allclose(ratio, [1.0, 4.0 / 1.1 * (0.065 / 0.15) ** 2, 0.0], atol=1e-12)


def test_compression_line_of_a_limit_of_elastic_strain():
    law, limit = PowerLawElasticity(1e9, 1.0), ElasticStrainLimit(0.01, LinearCurve(0.5))
    line = compression_line(STIFFER, AT, law, limit, 0.64)
    np.testing.assert_allclose(line.elastic_strain, [0.01, 0.0075, 0.005])
    np.testing.assert_allclose(line.stress, [1e7, 3e7, 4e7])
    density = 0.64 * np.array([1.0, 1.1, 1.2])
    np.testing.assert_allclose(line.void_ratio, (1.0 - line.elastic_strain) / density - 1.0)


def test_no_compression_line_where_nothing_yields():
    line = compression_line(
        ModelForm(LinearCurve(-0.5)), AT, PowerLawElasticity(1e9, 1.0), CriticalEnergy(1e5, 2), 0.6
    )
    assert np.isnan(line.stress).all() and np.isnan(line.void_ratio).all()
