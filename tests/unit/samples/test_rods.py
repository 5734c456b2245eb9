"""What rods that push say along a loading: by the strain of each state from jamming."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import single
from branchcrush.samples.rods import rods_along_path


def path_of(above, phi=0.7):
    states = {"state": range(3, 3 + len(above)), "solid_fraction": phi}
    return pd.DataFrame({**states, "solid_fraction_above_jamming": above})


def test_equal_spheres_follow_the_jamming_law_of_the_map():
    rods = rods_along_path(single(1.0), path_of([-0.001, 0.0, 0.035]))
    assert rods["state"].tolist() == [3, 4, 5]
    # At a strain of 0.05 the map is at 0.64 / 0.95, and 95 % or so carry load.
    mechanical = rods["rods_coordination_number"] / (1.0 - rods["rods_rattler_fraction"])
    expected = [6.0, 6.0, 6.0 + 7.8 * np.sqrt(0.64 / 0.95 - 0.64)]
    np.testing.assert_allclose(mechanical, expected, rtol=1e-4)


def test_rattlers_become_fewer():
    rods = rods_along_path(uniform(0.005, 1.0), path_of([0.005, 0.05, 0.1]))
    assert (np.diff(rods["rods_rattler_fraction"]) < 0).all()
    assert (np.diff(rods["rods_coordination_number"]) > 0).all()


@pytest.mark.parametrize("above", [float("nan"), 0.6])
def test_no_strain_no_numbers(above):
    assert rods_along_path(single(1.0), path_of([above])).iloc[0, 1:].isna().all()
