"""Breakage from two gradings: closed forms, and the area between two curves as drawn."""

import numpy as np
import pytest

from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.breakage import crushing_parameter, einav_breakage, hardin_breakage
from branchcrush.gradings.forms import fractal
from branchcrush.gradings.mixtures import single
from branchcrush.gradings.tables import from_percent_finer

BEFORE = ([0.125, 0.25, 0.5, 1.0, 2.0], [0.0, 2.0, 20.0, 75.0, 100.0])
AFTER = ([0.02, 0.063, 0.125, 0.25, 0.5, 1.0, 2.0], [0.0, 2.0, 6.0, 15.0, 38.0, 82.0, 100.0])


def curve(diameter_mm, percent):
    """Return the grading of a sieve curve with straight lines between its points."""
    return from_percent_finer(0.5e-3 * np.array(diameter_mm), percent, straight=True)


def area_between(low, high=2.0):
    """Return the area between the two curves and beside the first one, over log10 D."""
    logs = np.linspace(np.log10(low), np.log10(high), 200_001)
    finer = [
        np.interp(logs, np.log10(diameter), np.array(percent) / 100.0)
        for diameter, percent in (BEFORE, AFTER)
    ]
    return np.trapezoid(finer[1] - finer[0], logs), np.trapezoid(1.0 - finer[0], logs)


def test_hardin_is_the_area_on_the_chart():
    broken, potential = area_between(0.074)
    measured = hardin_breakage(curve(*BEFORE), curve(*AFTER))
    assert measured == pytest.approx(broken / potential, rel=1e-6)
    assert measured == pytest.approx(0.135, abs=5e-4)


@pytest.mark.parametrize("smallest", [0.02, 1e-4])
def test_einav_is_the_share_of_the_area_to_the_ultimate_curve(smallest):
    broken, _ = area_between(1e-5)
    logs = np.linspace(np.log10(1e-5), np.log10(2.0), 400_001)
    diameter = np.maximum(10.0**logs, smallest)
    ultimate = (diameter**0.4 - smallest**0.4) / (2.0**0.4 - smallest**0.4)
    initial = np.interp(logs, np.log10(BEFORE[0]), np.array(BEFORE[1]) / 100.0)
    whole = np.trapezoid(ultimate - initial, logs)
    measured = einav_breakage(curve(*BEFORE), curve(*AFTER), 2.6, 1e-3, 0.5e-3 * smallest)
    assert measured == pytest.approx(broken / whole, rel=1e-5)


def test_einav_of_an_ultimate_curve_that_goes_on_to_nothing():
    finest = [einav_breakage(curve(*BEFORE), curve(*AFTER), 2.6, 1e-3, r) for r in (1e-18, 0.0)]
    assert finest[0] == pytest.approx(finest[1], rel=1e-4)
    assert finest[1] == pytest.approx(0.2181, abs=1e-4)


def test_a_grading_that_reached_its_ultimate_one():
    ultimate = fractal(0.1e-3, 1e-3, 2.5)
    assert einav_breakage(single(1e-3), ultimate, 2.5, 1e-3, 0.1e-3) == pytest.approx(1.0, abs=1e-9)
    assert einav_breakage(single(1e-3), single(1e-3), 2.5, 1e-3) == 0.0


def test_the_paper_measure_of_the_same_curves():
    gradings = curve(*BEFORE), curve(*AFTER), fractal(0.01e-3, 1e-3, 2.6)
    moments = [random_contact_moment(grading, 3.0) for grading in gradings]
    assert crushing_parameter(*moments) == pytest.approx(0.9945, abs=1e-4)


def test_what_cannot_be_measured():
    with pytest.raises(ValueError, match="none can break"):
        hardin_breakage(single(0.03e-3), single(0.02e-3))
    with pytest.raises(ValueError, match="no finer"):
        einav_breakage(single(0.001e-3), single(0.001e-3), 2.6, 1e-3)
    with pytest.raises(ValueError, match="alpha"):
        einav_breakage(single(1e-3), single(1e-3), 3.0, 1e-3)
    with pytest.raises(ValueError, match="undefined"):
        crushing_parameter(1.0, 0.5, 1.0)
