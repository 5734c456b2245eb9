"""The elastic law of a sample on paths whose law is known, and on those that have none."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import FitError
from branchcrush.samples.elastic_law import measured_elasticity

JAMMING, MODULUS, EXPONENT = 0.64, 300e6, 1.5


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


def test_elastic_law_of_exact_energies_is_found():
    measured = measured_elasticity([PATH, PATH])
    found = [measured.law.modulus, measured.law.exponent]
    assert_allclose(found, [MODULUS, EXPONENT], rtol=1e-4)
    assert_allclose(measured.jamming, JAMMING, rtol=1e-6)
    assert_allclose(measured.r_squared, 1.0, rtol=1e-9)
    assert measured.on_path


def test_it_is_known_up_to_the_densest_state_of_any_seed():
    shorter = path_of([0.16, 0.55, *np.linspace(0.57, 0.71, 12)])
    assert_allclose(measured_elasticity([shorter, PATH]).largest, 1 - JAMMING / 0.74, rtol=1e-5)


def test_path_that_begins_above_jamming_says_so():
    assert not measured_elasticity([path_of([0.16, *np.linspace(0.66, 0.74, 10)])]).on_path


@pytest.mark.parametrize("phi", [[0.16, 0.3, 0.4, 0.5, 0.6], [0.16, 0.55, 0.66, 0.68]])
def test_path_that_carries_load_in_too_few_states_is_no_data(phi):
    with pytest.raises(FitError, match="no elastic law in the loading path"):
        measured_elasticity([path_of(phi)])
