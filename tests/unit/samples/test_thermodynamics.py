"""The crushing model on paths whose elastic law is known, and on those that have none."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import AdmissibilityError, FitError
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.samples.thermodynamics import FIXED_CRUSHING, crushing_curves, measured_elasticity
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
