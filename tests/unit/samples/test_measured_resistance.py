"""The resistance from a laboratory's curve: parameters that made it come back."""

import numpy as np
import pytest

from branchcrush.branches.crushing_forms import crushing_forms
from branchcrush.branches.mixing import mixing_path
from branchcrush.crushing.compression_fit import elastic_strain_family
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.evolution import evolve
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.mixtures import single
from branchcrush.packings.contact_laws import contact_law
from branchcrush.samples.measured_resistance import resistance_results

QUARTZ = contact_law("hertz", young_modulus=70e9, poisson_ratio=0.17)
# Equal spheres, and a fractal of a few sizes down to a tenth: quick, since single sizes are few.
SIZES = np.geomspace(0.1e-3, 1e-3, 12)
BEFORE, ULTIMATE = single(1e-3), Grading(radii=SIZES, weights=SIZES**-2.6)
STRESS = np.geomspace(1e6, 5e7, 16)
K0, SHARE = 0.4, 0.8
EPS, B = 0.010, 1.0


@pytest.fixture(scope="module")
def strain():
    """Strains of a material whose parameters are known, by the exact evolution."""
    path = mixing_path(BEFORE, ULTIMATE, QUARTZ)
    form = crushing_forms(path, BEFORE, ULTIMATE, exponent=3.0)["moving_jamming"]
    # p = s H/3 (eps/3)^(3/2) of affine motion.
    law = PowerLawElasticity(SHARE * path.modulus[0] / 3.0 / 3.0**1.5, 1.5)
    limit = elastic_strain_family(path.crushing, path.contact_diameter, lambda b: -2.0 * b / 3.0)
    pressure = (1.0 + 2.0 * K0) / 3.0 * STRESS
    exact = evolve(pressure, form, law, limit.resistance(EPS, B), "stress").strain
    return exact + np.random.default_rng(3).normal(0.0, 5e-4, STRESS.size)


def results(strain, **changes):
    keys = {
        "law": QUARTZ,
        "lateral_stress_ratio": K0,
        "share_of_affine": SHARE,
        "initial_void_ratio": 0.7,
    }
    return resistance_results(
        STRESS[: strain.size], strain, BEFORE, ULTIMATE, **{**keys, **changes}
    )


@pytest.fixture(scope="module")
def found(strain):
    return results(strain)


def test_known_parameters_lie_in_their_intervals(found):
    _, _, summary = found
    assert summary["elastic_strain_low"] < EPS < summary["elastic_strain_high"]
    assert summary["strength_exponent_low"] < B < summary["strength_exponent_high"]
    assert summary["elastic_strain_determined"] and summary["strength_exponent_determined"]
    assert summary["better_resistance"] == "elastic_strain_limit"
    assert summary["elastic_strain_limit_residual"] == pytest.approx(5e-4, rel=0.5)


def test_tables_hold_the_points_and_smooth_lines_in_void_ratios_too(found, strain):
    curve, line, _ = found
    np.testing.assert_allclose(curve["mean_stress_Pa"], 0.6 * STRESS)
    np.testing.assert_allclose(curve["void_ratio"], 1.7 * (1.0 - strain) - 1.0)
    assert len(line) == 200
    fitted = line["void_ratio_elastic_strain_limit"]
    at = np.interp(curve["mean_stress_Pa"], line["mean_stress_Pa"], fitted)
    np.testing.assert_allclose(at, curve["void_ratio_elastic_strain_limit"], atol=2e-3)


def test_what_the_test_has_and_the_model_has_not_is_said(found):
    said = "\n".join(found[2]["sentences"])
    # Equal frictionless spheres jam at 0.640.
    assert "jam at a void ratio of 0.563, the test began at 0.700" in said
    assert "(1 + 2 K0)/3 = 0.600 of the axial one with K0 = 0.4" in said
    assert "before they crush is not in the model" in said
    # 2^(-2/3)
    assert "would give 0.63 of the elastic strain" in said


def test_without_a_void_ratio_there_are_strains_alone_and_isotropic_is_not_called_otherwise(strain):
    curve, line, summary = results(strain, initial_void_ratio=None, lateral_stress_ratio=1.0)
    assert "void_ratio" not in curve and "volumetric_strain_critical_energy" in line
    assert summary["initial_void_ratio"] is None
    assert not any("isotropic" in line for line in summary["sentences"])


def test_a_curve_that_ends_too_early_is_said_to_determine_nothing(strain):
    _, _, summary = results(strain[:5])
    assert not summary["elastic_strain_determined"]
    assert any("they are not determined. Load further" in line for line in summary["sentences"])


def test_a_curve_that_cannot_be_fitted_says_why():
    curve, line, summary = results(np.array([0.01, 0.02, 0.03]))
    assert "4 points" in summary["reason"]
    assert curve == line == {"reason": [summary["reason"]]}
