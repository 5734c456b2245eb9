"""Breakage between two measured gradings: the numbers of a case worked by hand, and sentences."""

import numpy as np
import pytest

from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import mixture, single
from branchcrush.gradings.tables import from_percent_finer
from branchcrush.samples.measured import breakage_results, grading_curves, ultimate_of

# Sieves [mm] and percent finer of a test.
BEFORE = {0.125: 0, 0.25: 2, 0.5: 20, 1: 75, 2: 100}
AFTER = {0.02: 0, 0.063: 2, 0.125: 6, 0.25: 15, 0.5: 38, 1: 82, 2: 100}
ULTIMATE = {"ultimate_alpha": 2.6, "ultimate_smallest": 1e-5}


def straight(curve):
    """Return a grading whose curve is straight between sieves on the usual chart."""
    sizes, percent = np.array(list(curve)), np.array(list(curve.values()), float)
    between = np.union1d(np.geomspace(sizes[0], sizes[-1], 60), sizes)
    return from_percent_finer(
        between / 2e3, np.interp(np.log(between), np.log(sizes), percent), None, None
    )


@pytest.fixture(scope="module")
def results():
    return breakage_results(straight(BEFORE), straight(AFTER), **ULTIMATE)


def test_three_measures_of_one_test(results):
    assert results["hardin_breakage"] == pytest.approx(0.135, abs=0.001)
    assert results["einav_breakage"] == pytest.approx(0.526, abs=0.001)
    assert results["crushing_parameter"] == pytest.approx(0.9945, abs=0.0003)


def test_the_smallest_size_decides_and_a_sentence_says_so(results):
    # The way to the ultimate grading by means of ln D: 1/0.4 down to 0, less r ln(1/r)/(1 - r)
    # with r = 0.01^0.4 down to a hundredth.
    low, high = np.log(list(BEFORE))[:-1], np.log(list(BEFORE))[1:]
    mean = np.sum((low + high) / 2 * np.diff(list(BEFORE.values()))) / 100
    to_zero = mean - np.log(2) + 1 / 0.4
    ratio = 0.01**0.4
    to_a_hundredth = to_zero - ratio * np.log(100) / (1 - ratio)
    assert results["einav_breakage_down_to_0"] == pytest.approx(
        results["einav_breakage"] * to_a_hundredth / to_zero, abs=2e-4
    )
    assert any("decides B: 0.526 with 0.02 mm, 0.21" in line for line in results["sentences"])


def test_the_paper_s_parameter_is_said_to_be_saturated(results):
    assert any(
        line.startswith("C is 0.994") and "saturated" in line for line in results["sentences"]
    )
    # 0.2 of the mass that became half as large: not nearly all of the grains.
    half = mixture([single(1e-3), single(0.5e-3)], [0.8, 0.2], "mass")
    mild = breakage_results(single(1e-3), half, ultimate_alpha=2.6, ultimate_smallest=1e-5)
    assert not any("saturated" in line for line in mild["sentences"])


def test_jamming_and_stiffness_are_those_of_mixtures_by_rods():
    # Toward fractal 2.6 of ratio 10, by a quarter and wholly: mixtures of a published rod map.
    coarse, fine = uniform(0.5e-3, 1e-3), fractal(0.1e-3, 1e-3, 2.6)
    quarter = mixture([coarse, fine], [0.75, 0.25], "mass")
    found = breakage_results(coarse, quarter, ultimate_alpha=2.6, ultimate_smallest=0.1e-3)
    assert found["jamming_solid_fraction_before"] == pytest.approx(0.65149, abs=2e-4)
    assert found["jamming_solid_fraction_after"] == pytest.approx(0.72079, abs=2e-4)
    assert found["jamming_solid_fraction_ultimate"] == pytest.approx(0.74335, abs=2e-4)
    assert found["stiffness_ratio_linear_after"] == pytest.approx(1.53, abs=0.02)
    assert found["stiffness_ratio_linear_ultimate"] == pytest.approx(4.90, abs=0.05)
    assert found["stiffness_ratio_hertz_after"] == pytest.approx(1.16, abs=0.02)
    assert found["stiffness_ratio_hertz_ultimate"] == pytest.approx(1.86, abs=0.03)
    # By mass a mixture is by its share on the way.
    assert found["einav_breakage"] == pytest.approx(0.25, abs=1e-6)


def test_an_ultimate_grading_down_to_nothing_has_no_jamming_point():
    found = breakage_results(
        straight(BEFORE), straight(AFTER), ultimate_alpha=2.6, ultimate_smallest=0.0
    )
    assert found["jamming_solid_fraction_ultimate"] is None
    assert found["einav_breakage"] == found["einav_breakage_down_to_0"]
    assert found["crushing_parameter"] == pytest.approx(0.99, abs=0.01)


def test_without_a_grading_after_the_test_there_is_no_breakage():
    found = breakage_results(straight(BEFORE), None, **ULTIMATE)
    assert found["hardin_breakage"] is found["einav_breakage"] is None
    assert found["jamming_solid_fraction_after"] is None
    assert found["jamming_solid_fraction_before"] > 0.6
    assert found["sentences"][0].startswith("No grading after the test is given")


def test_what_is_odd_is_said():
    turned = breakage_results(straight(AFTER), straight(BEFORE), **ULTIMATE)
    assert any("are they exchanged?" in line for line in turned["sentences"])
    silt = breakage_results(
        uniform(10e-6, 30e-6), uniform(5e-6, 30e-6), ultimate_alpha=2.6, ultimate_smallest=1e-7
    )
    assert silt["hardin_breakage"] is None
    assert any("there is no B_r" in line for line in silt["sentences"])
    beyond = breakage_results(
        single(1e-3), single(0.2e-3), ultimate_alpha=2.6, ultimate_smallest=0.5e-3
    )
    assert any("is finer than the ultimate one" in line for line in beyond["sentences"])


def test_curves_stand_side_by_side_and_what_is_not_known_is_left_out():
    ultimate = ultimate_of(straight(BEFORE), 2.6, 1e-5)
    table = grading_curves({"before": straight(BEFORE), "after": None, "ultimate": ultimate})
    assert list(table) == [
        "diameter_m",
        "percent_finer_by_mass_before",
        "percent_finer_by_mass_ultimate",
    ]
    at = np.interp(0.5e-3, table["diameter_m"], table["percent_finer_by_mass_before"])
    assert at == pytest.approx(20, abs=0.3)
    # (D^0.4 - d^0.4)/(2^0.4 - d^0.4)
    fine = np.interp(0.5e-3, table["diameter_m"], table["percent_finer_by_mass_ultimate"])
    expected = 100 * (0.5**0.4 - 0.02**0.4) / (2**0.4 - 0.02**0.4)
    assert fine == pytest.approx(expected, abs=0.3)
