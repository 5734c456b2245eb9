"""What crushing did to a packing whose every number is known."""

import numpy as np
import pytest

from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.breakage import einav_breakage
from branchcrush.gradings.forms import fractal
from branchcrush.gradings.mixtures import from_radii
from branchcrush.packings.contact_laws import HertzContact
from branchcrush.samples.crushed_path import PARTS, crushed_path
from branchcrush.samples.crushed_sizes import number_exponent
from tests.unit.samples.crushed_runs import BROKEN, RADIUS, SAMPLE, SOLID, STRAIN, control, run


@pytest.fixture(scope="module")
def states():
    return crushed_path(*run(), control(), SAMPLE)


def test_the_loose_packing_is_left_out_and_all_others_kept(states):
    assert states["state"].tolist() == [1, 2, 3, 4, 5]


def test_elastic_strain_is_known_of_energy_and_stress_alone(states):
    assert np.isnan(states["elastic_strain"].iloc[0])  # no load
    assert states["elastic_strain"].iloc[1:].to_numpy() == pytest.approx(STRAIN)
    hertz = crushed_path(*run(), control(), SAMPLE._replace(law=HertzContact(1e9)))
    assert hertz["elastic_strain"].iloc[-1] == pytest.approx(1.25 * STRAIN)


def test_work_counts_from_the_last_state_before_a_breakage_and_its_shares_add_up(states):
    path, _, _ = run()
    assert states["work_since_breakage_J"].isna().tolist() == [True, True, False, False, False]
    work = path["work_J"].iloc[-1] - path["work_J"].iloc[2]
    assert states["work_since_breakage_J"].iloc[-1] == pytest.approx(work)
    # 3 mJ are lost after state 2, in parts of 0.5, 0.3 and 0.2; the first 1 mJ was before.
    assert states["released_by_parents_since_breakage_J"].iloc[-1] == pytest.approx(1.5e-3)
    assert states["avalanches_since_breakage_J"].iloc[-1] == pytest.approx(0.9e-3)
    assert states["rearrangement_since_breakage_J"].iloc[-1] == pytest.approx(0.6e-3)
    shares = states[[f"{part}_share" for part in PARTS]].iloc[2:].sum(axis=1)
    assert shares.to_numpy() == pytest.approx(1.0)


def test_breakage_is_of_the_share_that_is_halved(states):
    half = from_radii([RADIUS, RADIUS / 2.0, *[RADIUS / 2.0] * 7])  # half of the mass in eighths
    way = (from_radii([RADIUS]), half, 2.6, RADIUS)
    assert states["einav_breakage"].iloc[-1] == pytest.approx(einav_breakage(*way, 0.125e-3))
    assert states["einav_breakage_down_to_0"].iloc[-1] == pytest.approx(einav_breakage(*way))
    # ln 2 of half of the mass over the way to a power law down to nothing, 1/(3 - alpha).
    assert states["einav_breakage_down_to_0"].iloc[-1] == pytest.approx(0.5 * np.log(2.0) * 0.4)
    assert states["percent_finer_half"].tolist() == pytest.approx(
        [100.0 * n / 80 for n in BROKEN[1:]]
    )


def test_c_by_contacts_is_of_the_measured_cubes(states):
    path = states["crushing_by_contacts"].to_numpy()
    assert np.isnan(path[0]) and path[1] == 0.0
    # Half of the branches have an eighth of the cube.
    last = random_contact_moment(fractal(0.125e-3, RADIUS, 2.6), 3.0) / (2 * RADIUS) ** 3
    assert path[-1] == pytest.approx(0.5 * 0.875 / (1.0 - last))


def test_beside_the_control_at_equal_solid_fraction(states):
    told = states.set_index("state")
    ratio = told["mean_stress_Pa"] / (1e9 * 0.08)
    assert told.loc[5, "stress_over_control"] == pytest.approx(ratio[5])
    # E goes as p V eps: the strain of the control is 0.08.
    assert told.loc[5, "energy_over_control"] == pytest.approx(ratio[5] * STRAIN / 0.08)
    assert np.isnan(told.loc[1, "stress_over_control"])  # the control carries no load there


def test_compaction_is_the_work_of_the_stress_on_the_moving_jamming_volume():
    path, grains, branches = run()
    path["mean_stress_Pa"] = np.where(path["state"] > 1, 2e6, 0.0)
    states = crushed_path(path, grains, branches, control(), SAMPLE)
    moved = SOLID / states["jamming_by_rods"]
    assert np.isnan(states["compaction_work_J"].iloc[1])
    assert states["compaction_work_J"].iloc[-1] == pytest.approx(
        2e6 * (moved.iloc[1] - moved.iloc[-1])
    )


def test_where_no_grain_breaks_there_is_no_split_and_no_breakage():
    states = crushed_path(*run(broken=(0,) * 6), control(), SAMPLE)
    assert states[[f"{part}_share" for part in PARTS]].isna().all(axis=None)
    assert states["einav_breakage"].to_numpy() == pytest.approx(0.0, abs=1e-12)
    assert states["compaction_work_J"].iloc[:-1].isna().all()
    assert states["jamming_by_rods"].to_numpy() == pytest.approx(0.640, abs=1e-3)


def test_a_limit_above_every_grain_leaves_out_what_has_no_way_to_go():
    states = crushed_path(*run(), control(), SAMPLE._replace(limit=2e-3))
    for name in ("einav_breakage", "crushing_by_random_contacts", "crushing_by_contacts"):
        assert states[name].isna().all()
    assert states["einav_breakage_down_to_0"].iloc[-1] > 0.0


@pytest.mark.parametrize("alpha", [1.5, 2.5])
def test_the_exponent_of_a_power_law_of_numbers_is_found(alpha):
    sizes = np.arange(1, 50_001) ** (-1.0 / alpha)  # the k-th largest
    assert number_exponent(sizes, 0.015, 0.15) == pytest.approx(alpha, abs=0.05)
    assert np.isnan(number_exponent(sizes, 0.1, 0.15))  # too narrow
