"""What holds crushing back at its end, C = 1, where it may be infinite."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from branchcrush.crushing.curves import LinearCurve, PorosityCurve
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import CriticalEnergy

LAW = PowerLawElasticity(1e9, 1.0)
# The slope of the second is infinite at C = 1.
FORMS = [ModelForm(LinearCurve(0.5)), ModelForm(LinearCurve(0.5), PorosityCurve(0.4, 0.5))]

pytestmark = pytest.mark.filterwarnings("error")


@pytest.mark.parametrize("form", FORMS)
def test_nothing_yields_at_the_end_of_a_resistance_that_hardens(form):
    resistance = CriticalEnergy(2e5, 2.0)
    assert_array_equal(resistance.resistance([0.0, 0.5, 1.0]), [2e5, 8e5, np.inf])
    assert_array_equal(resistance.excess([-0.1, 0.0, 0.3], 1.0, form, LAW), [-1.0, -1.0, -1.0])
    found = resistance.yield_strain([0.5, 1.0], form, LAW)
    assert np.isfinite(found[0]) and np.isinf(found[1])


def test_a_constant_resistance_holds_up_to_the_end():
    # theta A eps^2/2 is 0.25e9 * 0.01 at a strain of 0.1, whatever C is.
    resistance = CriticalEnergy(2e5, 0.0)
    assert_array_equal(resistance.resistance(1.0), 2e5)
    excess = resistance.excess([-0.1, 0.1], 1.0, FORMS[0], LAW)
    np.testing.assert_allclose(excess, [-1.0, 2.5e6 / 2e5 - 1.0], rtol=1e-12)


def test_a_jerk_at_the_end_leaves_no_number_undefined():
    resistance = CriticalEnergy(2e5, 0.0)
    excess = resistance.excess(FORMS[1].total_strain([-0.5, 0.1], 1.0), 1.0, FORMS[1], LAW)
    # Loose, the first; of the second the jamming point moves as steeply as can be.
    assert excess[0] == -1.0 and 1e6 < excess[1] < np.inf
