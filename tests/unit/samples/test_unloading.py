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


def way_back(solid_fraction, stress, carries_load):
    """Return the path with another way back, of states before its last."""
    rows = PATH.iloc[[3]].assign(
        solid_fraction=solid_fraction, mean_stress_Pa=stress, carries_load=carries_load
    )
    return pd.concat([PATH[:4], rows, PATH[4:]], ignore_index=True)


def test_stress_is_compared_only_where_the_way_in_was_loaded():
    # Below 0.64, the first loaded state on the way in, there is nothing to compare with.
    lower = way_back(0.63, 0.9, True)
    found = unloading_summary([lower], JAMMING)
    assert found["stress_lost_share"] == pytest.approx(1 / 4)


def test_states_without_load_lose_no_stress():
    loose = way_back(0.65, 0.0, False)
    found = unloading_summary([loose], JAMMING)
    assert found["stress_lost_share"] == pytest.approx(1 / 4)


def test_share_of_the_stored_energy_is_of_what_was_given_up():
    # Half of 8 J stays: 4 J of work back of 4 J given up.
    kept = PATH.copy()
    kept.loc[4, ["elastic_energy_J", "work_J"]] = [4.0, 6.0]
    found = unloading_summary([kept], JAMMING)
    assert found["energy_returned_share"] == pytest.approx(4 / 4)
    assert found["work_returned_share"] == pytest.approx(4 / 10)


def test_shares_are_means_of_the_packings():
    other = PATH.copy()
    other.loc[4, "work_J"] = 8.0
    grown = JAMMING.assign(jamming_solid_fraction_unloading=0.65)
    jamming = pd.concat([JAMMING, grown])
    found = unloading_summary([PATH, other], jamming)
    assert found["work_returned_share"] == pytest.approx((6 / 10 + 2 / 10) / 2)
    assert found["energy_returned_share"] == pytest.approx((6 / 8 + 2 / 8) / 2)
    assert found["residual_solid_fraction"] == pytest.approx(0.02)
