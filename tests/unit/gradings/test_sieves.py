"""Openings of sieves by the names of standards: from their published tables."""

import pytest

from branchcrush.errors import GradingError
from branchcrush.gradings.sieves import is_nominal, opening_of, size_of_phi


@pytest.mark.parametrize(
    ("name", "series", "inches", "opening"),
    [
        (4, "astm_e11", False, 4.75),
        (10, "astm_e11", False, 2.0),
        (40, "astm_e11", False, 0.425),
        (200, "astm_e11", False, 0.075),
        (0.375, "astm_e11", False, 9.5),
        (3, "astm_e11", False, 75.0),
        (4, "astm_e11", True, 100.0),
        (9, "tyler_mesh", False, 2.0),
        (28, "tyler_mesh", False, 0.6),
        (200, "tyler_mesh", False, 0.075),
    ],
)
def test_opening_is_that_of_the_standard(name, series, inches, opening):
    assert opening_of(name, series, inches) == opening


def test_unknown_sieve_is_refused_with_the_nearest():
    with pytest.raises(GradingError, match="no sieve of number 41; the nearest are 40 and 45"):
        opening_of(41, "astm_e11")


def test_phi_is_the_negative_logarithm_of_millimetres():
    assert [size_of_phi(phi) for phi in (-2.0, 0.0, 1.0, 4.0)] == [4.0, 1.0, 0.5, 0.0625]
    with pytest.raises(GradingError, match="no grain"):
        size_of_phi(50.0)


def test_usual_openings_are_nominal():
    assert all(map(is_nominal, (0.063, 0.075, 0.5, 1.0, 2.0, 4.75, 31.5, 125.0)))
    assert not any(map(is_nominal, (0.3e-4, 1.5, 3.0, 60.0)))
