"""What crushing releases, from moments of known lengths, and what is refused in which words."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.crushing.law import CrushingLaw
from branchcrush.crushing.model import admissibility_problem, reference_energy, theta
from branchcrush.errors import AdmissibilityError, BranchcrushError

quick = settings(max_examples=50, deadline=None)  # a busy machine must not fail a test


@quick
@given(
    crushing=st.floats(0, 1),
    initial=st.floats(0.1, 10),
    ratio=st.floats(0.01, 1),
    n=st.floats(1, 5),
    l_r=st.floats(1e-4, 10),
)
def test_the_reference_length_cancels(crushing, initial, ratio, n, l_r):
    moments = (initial, ratio * initial)
    psi_r = reference_energy(3.0, initial, n, l_r)
    law = CrushingLaw(theta(*moments), 1e-3, 2.0)
    # Eq. 14 with the moment of Eq. 15.
    moment = (1 - crushing) * moments[0] + crushing * moments[1]
    assert_allclose(psi_r * moment / l_r**n, law.free_energy(crushing, 3.0), rtol=1e-12)


def test_the_reference_energy_is_the_energy_over_the_mean_split():
    lengths, weights = np.array([1.0, 2.0, 4.0]), np.array([0.5, 0.3, 0.2])
    split = (lengths / 2.0) ** 3
    psi_r = reference_energy(7.0, weights @ lengths**3, exponent=3, reference_length=2.0)
    assert_allclose(psi_r, 7.0 / (weights @ split), rtol=1e-14)
    assert_allclose(psi_r * (weights @ split), 7.0, rtol=1e-14)


def test_theta_is_the_share_of_the_moment_that_is_lost():
    assert_allclose(theta(5.0, 2.0), 0.6, rtol=1e-15)
    assert theta(5.0, 5.0) == 0.0


def test_an_ultimate_grading_that_is_coarser_is_told_in_words_with_what_to_change():
    with pytest.raises(AdmissibilityError) as raised:
        theta(2e-6, 3e-6)
    message = str(raised.value)
    assert "the ultimate grading is coarser than the initial one" in message
    assert "1.5 times as large" in message
    assert "crushing would create energy" in message
    assert "Raise thermodynamics.ultimate_alpha" in message
    assert "a smaller grading.min" in message
    assert admissibility_problem(2e-6, 3e-6) == message
    assert issubclass(AdmissibilityError, BranchcrushError)


def test_an_ultimate_grading_that_is_as_fine_or_finer_is_no_problem():
    assert admissibility_problem(2e-6, 2e-6) is None
    assert admissibility_problem(2e-6, 1e-9) is None


@pytest.mark.parametrize(
    "moments", [(np.nan, 1), (1, np.nan), (np.inf, 1), (1, np.inf), (1, 0), (0, 0), (1, -1)]
)
def test_unusable_moments_are_refused(moments):
    with pytest.raises(AdmissibilityError, match="positive and finite"):
        theta(*moments)
