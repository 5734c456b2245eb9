"""What the seeds realise of a grading, beside the target and what crushing leads to."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import single
from branchcrush.samples.grading import grading_results


def test_target_realised_and_ultimate_stand_side_by_side():
    grading = uniform(1.0, 2.0)
    radii = [[1.0, 2.0], [1.5, 2.0]]
    table, report = grading_results(grading, 2, 0.7, radii, ultimate_alpha=2.6)
    radius = table["diameter_m"] / 2.0
    assert_allclose(table["percent_finer_by_number_target"], 100 * (radius - 1.0), atol=1e-9)
    # Of each pair half of the grains are finer than anything between 1.5 and 2.
    between = (radius > 1.5) & (radius < 2.0 * (1 - 1e-12))
    assert_allclose(table["percent_finer_by_number_realised"][between], 50.0)
    finer = fractal(1.0, 2.0, 2.6).number_cdf(radius)
    assert_allclose(table["percent_finer_by_number_ultimate"], 100 * finer, atol=1e-9)
    standing = report["representativity"]
    assert (standing["grains"], standing["verdict"]) == (2, "refuse")


def test_box_is_that_of_the_solid_fraction_at_the_end():
    # 1000 grains of radius 1: the box is (1000 (4/3) pi / phi)^(1/3).
    _, report = grading_results(single(1.0), 1000, 0.5, [np.ones(1000)], ultimate_alpha=2.6)
    edge = (1000 * 4 / 3 * np.pi / 0.5) ** (1 / 3)
    assert report["representativity"]["box_edge"] == pytest.approx(edge, rel=1e-12)


def test_single_size_has_no_ultimate_grading():
    table, _ = grading_results(single(1.0), 10, 0.6, [np.ones(10)], ultimate_alpha=2.6)
    assert not [name for name in table if "ultimate" in name]
