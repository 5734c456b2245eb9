"""Who breaks and who survives, of invented runs whose answers are counted by hand."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.packings.network import COLUMNS, WALL_COLUMNS
from branchcrush.samples.crushed_exponents import overshoots
from branchcrush.samples.crushed_roc import foretellers, grains_at_risk
from branchcrush.samples.crushed_survival import first_grains, hazards, survival_curves, survivals

OPTIONS = {"confidence": 0.95, "resamples": 50}
NO_WALLS = pd.DataFrame({name: [] for name in WALL_COLUMNS})


def chain(*states):
    """Grains in a row, each touching the next; of each state: numbers, radii, stresses."""
    grains, contacts = [], []
    for state, (numbers, radii, stresses) in enumerate(states):
        grains.append(
            pd.DataFrame(
                {
                    "state": state,
                    "grain": numbers,
                    "generation": [int(number >= 10) for number in numbers],
                    "radius_m": radii,
                    "strength_Pa": 10.0,
                    "stress_Pa": stresses,
                }
            )
        )
        ends = np.arange(len(numbers) - 1)
        made = {"state": state, "i": ends, "j": ends + 1, "overlap_m": 0.1}
        contacts.append(pd.DataFrame({**made, "normal_force_N": 1.0 + ends, "energy_J": 1.0}))
    return pd.concat(grains), pd.concat(contacts)[list(COLUMNS)]


def run():
    # Grain 1 of four breaks into 10 and 11, of which 11 is not above the limit of 1.
    return chain(
        ([0, 1, 2, 3], [1.0, 1.0, 2.0, 1.0], [1.0, 9.0, 5.0, 9.0]),
        ([0, 2, 3, 10, 11], [1.0, 2.0, 1.0, 0.6, 0.4], [1.0, 8.0, 3.0, 2.0, 9.0]),
        ([0, 3, 10, 11], [1.0, 1.0, 0.6, 0.4], [0.0, 0.0, 0.0, 0.0]),
    )


def test_who_is_at_risk_and_who_breaks():
    seed = grains_at_risk(*run(), NO_WALLS, limit=1.0)
    assert seed["grain"].tolist() == [0, 1, 2, 3, 0, 2, 3, 10]
    assert seed.loc[seed["broke"], "grain"].tolist() == [1, 2]
    assert seed["contacts"].tolist() == [1, 2, 2, 1, 1, 2, 2, 2]
    # Of the contacts 0-1, 1-2, 2-3 with forces 1, 2, 3.
    assert seed["largest_force"].tolist()[:4] == [1, 2, 3, 3]
    assert_allclose(seed["share_smaller"][:4], [0, 0, 1, 0])


def test_areas_compare_grains_of_one_state():
    seed = grains_at_risk(*run(), NO_WALLS, limit=1.0)
    areas, curves = foretellers([seed, seed], **OPTIONS)
    area = areas[areas["among"] == "all"].set_index("foreteller")["area"]
    # Stress: 9 against 1, 5, 9 is 2.5/3; 8 against 1, 3, 2 is 1.
    assert_allclose(area["stress"], (2.5 / 3 + 1.0) / 2)
    assert_allclose(area["stress_over_strength"], area["stress"])
    assert_allclose(area["weakness"], 0.5)
    # Radius: 1 against 1, 2, 1 is 1/3; 2 against 1, 1, 0.6 is 1.
    assert_allclose(area["radius"], (1 / 3 + 1.0) / 2)
    # Contacts: 2 against 1, 2, 1 is 2.5/3; 2 against 1, 2, 2 is 2/3.
    assert_allclose(area["contacts"], (2.5 / 3 + 2 / 3) / 2)
    assert areas["breakages"].tolist()[0] == 4
    assert curves["found"].dropna().between(0, 1).all()


def test_no_breakage_has_no_area():
    seed = grains_at_risk(*chain(*[([0, 1], [1.0, 1.0], [1.0, 2.0])] * 2), NO_WALLS, limit=1.0)
    areas, _ = foretellers([seed], **OPTIONS)
    assert areas["area"].isna().all()
    assert set(areas["direction"]) == {"undecided"}
    assert hazards([seed], 1.0, **OPTIONS).empty


def test_hazards_count_breakages_over_grains_at_risk():
    seed = grains_at_risk(*run(), NO_WALLS, limit=1.0)
    table = hazards([seed, seed], 1.0, **OPTIONS)
    by_radius = table[(table["group"] == "all") & (table["by"] == "radius")]
    assert by_radius["low"].tolist() == [1.0, 2.0, 4.0]
    assert by_radius["at_risk"].tolist() == [2, 10, 4]
    assert by_radius["breakages"].tolist() == [0, 2, 2]
    assert_allclose(by_radius["hazard"], [0.0, 0.2, 0.5])
    # None of two broke: that says nothing of the error.
    assert np.isnan(by_radius["hazard_low"].iloc[0])


def test_first_grains_left_are_counted_and_kaplan_meiers_steps_known():
    grains, _ = run()
    phi = pd.Series([0.60, 0.65, 0.70])
    first = first_grains(grains, pd.Series({0: 1.0, 1: 2.0, 2: 2.0, 3: 4.0}), phi)
    assert first["survived"].tolist() == [True, False, False, True]
    assert first["solid_fraction"].tolist() == [0.70, 0.65, 0.70, 0.70]
    table = survivals([first], **OPTIONS)
    by_contacts = table[table["by"] == "contacts"]
    assert by_contacts["first_grains"].tolist() == [3, 1]
    assert by_contacts["survivors"].tolist() == [1, 1]
    # One of four, then one of the three that are left.
    left = survival_curves([first.assign(radius_m=1.0)])["left"]
    assert_allclose(left, [3 / 4, 3 / 4 * 2 / 3])


def test_overshoot_by_hand():
    broken = pd.DataFrame(
        {"radius_m": [0.6, 1.2], "stress_Pa": [11.0, 13.0], "strength_Pa": [10.0, 10.0]}
    )
    table = overshoots([broken], 1.0, 1.0, **OPTIONS)
    assert table["breakages"].tolist() == [2, 1, 1]
    assert table["mean_overshoot"].tolist() == pytest.approx([0.2, 0.1, 0.3])
    assert table["below"].tolist() == [0, 0, 0]
