"""What the seeds realise of a grading, beside the target and what crushing leads to."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import single
from branchcrush.gradings.size_fits import fit_sizes
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


def test_rods_tell_who_carries_load():
    _, report = grading_results(single(1e-3), 10, 0.6, [np.ones(10)], ultimate_alpha=2.6)
    # Of equal spheres 0.95 carry load, with six contacts each, at 0.640.
    assert report["rods"] == {
        "jamming_solid_fraction": pytest.approx(0.640, abs=1e-3),
        "load_bearing_by_number": pytest.approx(0.95, abs=0.01),
        "load_bearing_by_mass": pytest.approx(0.95, abs=0.01),
        "finest_load_bearing_diameter_m": pytest.approx(2e-3),
        "coordination_number": pytest.approx(5.71, abs=0.03),
    }


def test_single_size_has_no_ultimate_grading():
    table, _ = grading_results(single(1.0), 10, 0.6, [np.ones(10)], ultimate_alpha=2.6)
    assert not [name for name in table if "ultimate" in name]


def test_curves_through_sizes_are_reported_with_what_they_miss():
    # ln D90 is 3 ln(1.2) above where D10 and D50 lead to: a sixth is missed at each end, a third
    # at D50.
    fit = fit_sizes("lognormal", {10.0: 1.0, 50.0: 2.0, 90.0: 4.0 * 1.2**3})
    _, report = grading_results(
        single(1.0), 2, 0.6, [np.ones(2)], ultimate_alpha=2.6, fits={"grading": fit}
    )
    told = report["size_fits"]["grading"]
    assert told["curve"] == "lognormal"
    assert told["given_m"] == {"D10": 1.0, "D50": 2.0, "D90": 4.0 * 1.2**3}
    expected = {"D10": 1.2**-0.5, "D50": 1.2, "D90": 1.2**-0.5}
    for name, factor in expected.items():
        assert told["misfit_percent"][name] == pytest.approx(100 * (factor - 1), rel=1e-6)
    assert told["root_mean_square_misfit_percent"] == pytest.approx(
        100 * np.log(1.2) * np.sqrt(0.5), rel=1e-6
    )
    assert "size_fits" not in grading_results(single(1.0), 2, 0.6, [[1.0]], ultimate_alpha=2.6)[1]
