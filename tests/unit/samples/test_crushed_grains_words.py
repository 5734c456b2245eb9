"""Sentences on the grains of a crushing, of tables that are written by hand."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.samples.crushed_grains_words import grains_sentences

SUMMARY = {
    "seeds": [1, 2],
    "comminution_limit_m": 0.25e-3,
    "breakages": 12,
    "breakages_seen_in_a_state": 10,
}


def interval(name, estimate, low, high):
    return {name: estimate, f"{name}_low": low, f"{name}_high": high}


def tables(few=(0.5, 0.4, 0.6), many=(0.1, 0.0, 0.2), below=0, exponent=2.5):
    of_hazards = [
        {"group": "large", "by": "contacts", "low": low, **interval("hazard", *share)}
        for low, share in ((4, few), (12, many))
    ]
    left = [
        {"by": "radius", **interval("share", *share)}
        for share in ((0.123, 0.1, 0.2), (1.0, np.nan, np.nan))
    ]
    split = {"solid_fraction": 0.7, "broken_mass_fraction": 0.25} | (
        interval("exponent", exponent, 2.4, 2.6) | interval("control_exponent", 3.0, 2.9, 3.1)
    )
    return {
        "areas": pd.DataFrame({"among": ["bearing"], "foreteller": ["radius"], "breakages": [0]}),
        "hazards": pd.DataFrame(of_hazards),
        "survivors": pd.DataFrame(left),
        "exponents": pd.DataFrame([split]),
        "overshoots": pd.DataFrame(
            [{"median_overshoot": 0.15, "overshoot_90": 0.7, "below": below}]
        ),
    }


def said(**given):
    return " ".join(grains_sentences(SUMMARY, tables(**given)))


def test_shares_are_told_in_whole_percent_with_their_interval():
    text = said()
    assert "50 % (40 to 60 %) with 4 to 5 contacts, 10 % (0 to 20 %) with 12 to 19" in text
    # All are left in every seed, which tells no interval, though there are two seeds.
    assert "12 % (10 to 20 %) of the smallest third and 100 % (no interval) of the largest" in text
    assert "one seed" not in text


@pytest.mark.parametrize(
    ("many", "verdict"),
    [
        ((0.1, 0.0, 0.2), "they are shielded"),
        ((0.9, 0.8, 1.0), "they are not shielded"),
        ((0.5, 0.3, 0.7), "is not decided"),
        ((0.0, np.nan, np.nan), "is not decided"),
    ],
)
def test_shielding_is_told_where_the_intervals_part(many, verdict):
    assert f"12 to 19: {'whether' if 'decided' in verdict else 'large'}" in said(many=many)
    assert verdict in said(many=many)


@pytest.mark.parametrize(("below", "words"), [(0, "none below it"), (3, "3 below it")])
def test_how_many_broke_below_their_strength_is_told(below, words):
    assert f"70 %), {words}" in said(below=below)


def test_exponents_differ_where_their_intervals_part_and_unknown_ones_are_not_told():
    assert "n is 2.50 (2.40 to 2.60), that of" in said() and "they differ." in said()
    assert "No state of the crushing bears an exponent" in said(exponent=np.nan)


def test_where_no_grain_broke_nothing_else_is_told():
    (line,) = grains_sentences({**SUMMARY, "breakages_seen_in_a_state": 0}, {})
    assert line.startswith("No grain broke between saved states")
