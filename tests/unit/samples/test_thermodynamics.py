"""The crushing model on paths whose elastic law is known, and on those that have none."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.errors import AdmissibilityError, FitError
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.samples.thermodynamics import (
    FIXED_CRUSHING,
    crushing_curves,
    crushing_results,
    measured_elasticity,
)
from branchcrush.statistics.intervals import Interval

JAMMING, MODULUS, EXPONENT = 0.64, 300e6, 1.5
INITIAL, ULTIMATE = uniform(1e-4, 1e-3), fractal(1e-4, 1e-3, 2.6)
CUBIC = Interval(3.0, 2.9, 3.1)


def path_of(solid_fraction, jamming=JAMMING):
    """Return a path with the energy of A eps^m exactly, per volume at jamming."""
    phi = np.asarray(solid_fraction)
    strain = np.maximum(1 - jamming / phi, 0.0)
    energy = MODULUS / (EXPONENT + 1) * strain ** (EXPONENT + 1)
    volume = 1e-6 / phi
    return pd.DataFrame(
        {
            "state": range(phi.size),
            "solid_fraction": phi,
            "volume_m3": volume,
            "elastic_energy_J": energy * volume * phi / jamming,
        }
    )


PATH = path_of([0.16, 0.55, *np.linspace(0.57, 0.74, 15)])


def curves_of(paths, initial=INITIAL, ultimate=ULTIMATE, critical_energy=2e5):
    return crushing_curves(paths, CUBIC, initial, ultimate, 1e-3, critical_energy, 2.0)


def test_elastic_law_of_exact_energies_is_found():
    elasticity, jamming, r_squared = measured_elasticity([PATH, PATH])
    assert_allclose([elasticity.modulus, elasticity.exponent], [MODULUS, EXPONENT], rtol=1e-4)
    assert_allclose(jamming, JAMMING, rtol=1e-6)
    assert_allclose(r_squared, 1.0, rtol=1e-9)


def test_curves_end_where_the_path_ends_and_conserve_energy():
    curves, summary = curves_of([PATH])
    path = curves[curves["path"] == "crushing"]
    assert_allclose(path["volumetric_strain"].max(), 1 - JAMMING / 0.74, rtol=1e-6)
    assert_allclose(summary["largest_strain"], 1 - JAMMING / 0.74, rtol=1e-6)
    kept = path["free_energy_J_per_m3"] + path["dissipated_J_per_m3"]
    assert_allclose(path["work_J_per_m3"], kept, rtol=1e-8, atol=1e-6)
    fixed = curves[curves["path"] == "fixed"]
    assert sorted(fixed["crushing"].unique()) == list(FIXED_CRUSHING)
    assert (summary["yields_on_path"], summary["jamming_on_path"]) == (True, True)


def test_theta_is_the_share_of_the_moment_that_crushing_would_release():
    _, summary = curves_of([PATH])
    ratio = summary["ultimate_moment"] / summary["initial_moment"]
    assert_allclose(summary["theta"], 1 - ratio, rtol=1e-12)
    assert 0.9 < summary["theta"] < 1


def test_resistance_beyond_the_path_is_never_reached():
    curves, summary = curves_of([PATH], critical_energy=1e12)
    assert not summary["yields_on_path"]
    assert (curves.loc[curves["path"] == "crushing", "crushing"] == 0).all()


def test_path_that_begins_above_jamming_says_so():
    late = path_of([0.16, *np.linspace(0.66, 0.74, 10)])
    _, summary = curves_of([late])
    assert not summary["jamming_on_path"]


def test_grains_of_one_size_have_nothing_finer_to_crush_to():
    with pytest.raises(FitError, match="single size have no finer grading"):
        curves_of([PATH], ultimate=None)


@pytest.mark.parametrize("phi", [[0.16, 0.3, 0.4, 0.5, 0.6], [0.16, 0.55, 0.66, 0.68]])
def test_path_that_carries_load_in_too_few_states_is_no_data(phi):
    with pytest.raises(FitError, match="no elastic law in the loading path"):
        curves_of([path_of(phi)])


def test_ultimate_grading_of_longer_branches_is_not_admissible():
    with pytest.raises(AdmissibilityError):
        curves_of([PATH], initial=ULTIMATE, ultimate=INITIAL)


# --- by hand -------------------------------------------------------------------------------------


def moment(power, low=1e-4, high=1e-3):
    """Return <R^k> of radii that are uniform by number."""
    return (high ** (power + 1) - low ** (power + 1)) / ((power + 1) * (high - low))


# <l^3> = 2 <R^3> + 6 <R> <R^2> of two radii drawn alike.
CUBE_OF_LENGTH = 2 * moment(3) + 6 * moment(1) * moment(2)
LARGEST = 1 - JAMMING / 0.74


@pytest.fixture(scope="module")
def result():
    return crushing_curves([PATH], CUBIC, INITIAL, ULTIMATE, 9e-4, 2e5, 2.0)


@pytest.mark.parametrize("kind", ["crushing", "fixed"])
def test_reference_energy_is_that_of_the_initial_grading(result, kind):
    curves, summary = result
    rows = curves[curves["path"] == kind]
    expected = rows["elastic_energy_J_per_m3"] * 9e-4**3 / CUBE_OF_LENGTH
    assert_allclose(rows["reference_energy_J_per_m3"], expected, rtol=1e-9)
    assert_allclose(summary["initial_moment"], CUBE_OF_LENGTH, rtol=1e-9)
    assert summary["reference_length_m"] == 9e-4


def test_strain_goes_to_the_densest_state_of_any_seed_and_some_of_the_way_back():
    shorter = path_of([0.16, 0.55, *np.linspace(0.57, 0.71, 12)])
    curves, summary = curves_of([shorter, PATH])
    strain = curves.loc[curves["path"] == "crushing", "volumetric_strain"].to_numpy()
    assert_allclose(summary["largest_strain"], LARGEST, rtol=1e-5)
    assert strain[0] == 0.0
    assert_allclose([strain.max(), strain[-1]], [LARGEST, 0.6 * LARGEST], rtol=1e-5)
    turn = int(np.argmax(strain))
    assert (np.diff(strain[: turn + 1]) > 0).all()
    assert (np.diff(strain[turn:]) < 0).all()
    for _, rows in curves[curves["path"] == "fixed"].groupby("crushing"):
        assert_allclose(rows["volumetric_strain"].iloc[[0, -1]], [0.0, LARGEST], rtol=1e-5)


def test_stress_at_fixed_crushing_is_what_is_left_of_the_elastic_one(result):
    curves, summary = result
    for crushing in FIXED_CRUSHING:
        rows = curves[(curves["path"] == "fixed") & (curves["crushing"] == crushing)]
        left = 1 - summary["theta"] * crushing
        strain = rows["volumetric_strain"]
        assert_allclose(rows["stress_Pa"], left * MODULUS * strain**1.5, rtol=1e-3, atol=1.0)
        energy = MODULUS / 2.5 * strain**2.5
        assert_allclose(rows["free_energy_J_per_m3"], left * energy, rtol=1e-3, atol=1.0)
        assert_allclose(
            rows["driving_force_J_per_m3"], summary["theta"] * energy, rtol=1e-3, atol=1.0
        )


def test_crushing_begins_where_the_released_energy_meets_the_critical_one(result):
    _, summary = result
    # theta A eps^(m+1)/(m+1) = E_c0.
    strain = (2.5 * 2e5 / (summary["theta"] * MODULUS)) ** (1 / 2.5)
    assert_allclose(summary["yield_strain"], strain, rtol=1e-3)
    assert_allclose(summary["yield_stress_Pa"], MODULUS * strain**1.5, rtol=1e-3)
    # At the largest strain (1 - C)^2 theta Psi_0 = E_c0.
    energy = MODULUS / 2.5 * LARGEST**2.5
    expected = 1 - (2e5 / (summary["theta"] * energy)) ** 0.5
    assert_allclose(summary["crushing_at_end"], expected, rtol=1e-3)
    assert_allclose(
        summary["least_hardening_exponent"], summary["theta"] * (1 + 1 / 1.5), rtol=1e-4
    )
    assert summary["hardens_at_onset"]


def test_softer_resistance_than_the_elastic_law_needs_does_not_harden():
    _, summary = crushing_curves([PATH], CUBIC, INITIAL, ULTIMATE, 1e-3, 2e5, 1.0)
    assert not summary["hardens_at_onset"]


# --- the rule ------------------------------------------------------------------------------------

FIT = replace(EnergySplitFit.without("-"), reason=None, exponent=CUBIC, reference_length=9e-4)
MODEL = {"ultimate_alpha": 2.6, "critical_energy": 2e5, "hardening_exponent": 2.0}


def whole(path):
    """Return a path with the columns of the certificate."""
    return path.assign(leg="loading", carries_load=path["elastic_energy_J"] > 0)


def certificate_of(*paths, certified=True):
    parts = [path.assign(seed=k, certified=certified) for k, path in enumerate(paths)]
    return pd.concat(parts, ignore_index=True)


def test_model_takes_the_fit_and_the_certified_seeds(result):
    # A seed whose end is not certified, and which went further.
    other = whole(path_of([0.16, 0.55, *np.linspace(0.57, 0.80, 15)]))
    certificate = certificate_of(whole(PATH), other)
    certificate.loc[certificate.index[-1], "certified"] = False
    curves, summary = crushing_results(FIT, certificate, [whole(PATH), other], INITIAL, **MODEL)
    assert summary == result[1]
    assert curves.equals(result[0])


def test_model_without_a_fit_says_why_the_fit_is_not_there():
    paths = [whole(PATH)]
    nothing = EnergySplitFit.without("branches of one length")
    curves, summary = crushing_results(nothing, certificate_of(*paths), paths, INITIAL, **MODEL)
    assert (curves, summary) == (
        {"reason": ["branches of one length"]},
        {"reason": "branches of one length"},
    )


def test_model_that_is_not_admissible_says_so():
    paths = [whole(PATH)]
    coarse = {**MODEL, "ultimate_alpha": 0.5}
    fine = fractal(1e-4, 1e-3, 2.9)
    curves, summary = crushing_results(FIT, certificate_of(*paths), paths, fine, **coarse)
    assert list(curves) == list(summary) == ["reason"]
    assert "moment" in summary["reason"] or "coarser" in summary["reason"]
