"""The way back against paths whose answer is known."""

import pandas as pd
import pytest

from branchcrush.samples.unloading import unloading_summary

PATH = pd.DataFrame(
    {
        "leg": ["loading", "loading", "loading", "unloading", "unloading"],
        "carries_load": [False, True, True, True, False],
        "solid_fraction": [0.60, 0.64, 0.68, 0.66, 0.62],
        "mean_stress_Pa": [0.0, 1.0, 3.0, 1.5, 0.0],
        "elastic_energy_J": [0.0, 1.0, 8.0, 3.0, 0.0],
        "work_J": [0.0, 2.0, 10.0, 5.0, 4.0],
    }
)
JAMMING = pd.DataFrame(
    {"jamming_solid_fraction_loading": [0.62], "jamming_solid_fraction_unloading": [0.63]}
)


def test_what_comes_back_and_what_stays():
    found = unloading_summary([PATH, PATH], JAMMING)
    assert found["work_returned_share"] == pytest.approx(6 / 10)
    assert found["energy_returned_share"] == pytest.approx(6 / 8)
    # At 0.66 the way in has a stress of 2.
    assert found["stress_lost_share"] == pytest.approx(1 / 4)
    assert found["residual_solid_fraction"] == pytest.approx(0.01)


def test_an_elastic_packing_returns_all():
    back = PATH.iloc[[0, 1]].assign(leg="unloading")[::-1]
    path = pd.concat([PATH[:3].assign(work_J=PATH["elastic_energy_J"]), back], ignore_index=True)
    path.loc[3:, "work_J"] = [1.0, 0.0]
    found = unloading_summary([path], JAMMING)
    assert found["work_returned_share"] == pytest.approx(1)
    assert found["energy_returned_share"] == pytest.approx(1)
    assert found["stress_lost_share"] == pytest.approx(0)


def test_there_is_nothing_to_tell_without_a_way_back():
    assert unloading_summary([PATH[:3]], JAMMING) is None


def test_a_packing_that_never_carried_load_has_nothing_to_return():
    loose = PATH.assign(carries_load=False, work_J=0.0, elastic_energy_J=0.0)
    assert unloading_summary([loose], JAMMING) is None
    assert unloading_summary([PATH, loose], JAMMING) == unloading_summary([PATH], JAMMING)
