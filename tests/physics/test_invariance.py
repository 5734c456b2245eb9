"""What must not matter does not: units of force, length and time, and where and when it runs."""

import functools

import numpy as np
import pandas as pd
import pytest

from branchcrush.statistics.power_law import power_law_fit

# Binary fractions of a cell of edge 8, so that every edge on the way is a short decimal and
# exact: 20 approach steps of 2^-3 to 5.5, then 24 steps of 2^-5 to 4.75.
EDGE, APPROACH, TARGETS, STRAIN_STEP = 8.0, 5.5, (5.125, 4.75), 6.34e-3
BOUNDARIES = ["walls", "periodic"]
STIFFNESS = {"linear": 1.0e6, "hertz": 1.0e9}


@pytest.fixture(scope="module")
def loaded(random_grains, compressed, tmp_path_factory):
    """Return a function that compresses one packing, its lengths in some unit."""

    @functools.cache
    def run(boundary, *, length=1.0, where="run", targets=TARGETS, **variables):
        positions, radii, edge = random_grains(60, 5, periodic=boundary == "periodic")
        unit = EDGE / edge * length
        loading = {
            "approach_edge": APPROACH * length,
            "targets": [target * length for target in targets],
            "strain_step": STRAIN_STEP,
        }
        return compressed(
            (positions * unit, radii * unit, EDGE * length),
            tmp_path_factory.mktemp("loaded") / where,
            boundary=boundary,
            **{**loading, **variables},
        )

    return run


def assert_same_contacts(one, other):
    pd.testing.assert_frame_equal(
        one.contacts[["state", "i", "j"]], other.contacts[["state", "i", "j"]]
    )
    pd.testing.assert_frame_equal(
        one.walls[["state", "i", "wall"]], other.walls[["state", "i", "wall"]]
    )


def test_the_edges_on_the_way_are_short_decimals(loaded):
    edges = np.cbrt(loaded("walls").steps["volume_m3"])
    np.testing.assert_allclose(edges, APPROACH - np.arange(25) / 32, rtol=1e-15)


def exponent(run):
    last = run.at("contacts", -1)
    return power_law_fit(last["radius_i_m"] + last["radius_j_m"], last["energy_J"]).exponent


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_twice_the_stiffness_doubles_every_force_and_leaves_the_packing_as_it_is(loaded, boundary):
    # Mass, dashpots and time step follow the stiffness: a factor of two is exact to the last bit.
    soft, stiff = loaded(boundary), loaded(boundary, stiffness=2.0e6)
    assert soft.path["carries_load"].iloc[-1]
    assert_same_contacts(soft, stiff)
    for table in ("contacts", "walls"):
        one, other = getattr(soft, table), getattr(stiff, table)
        np.testing.assert_array_equal(other["overlap_m"], one["overlap_m"])
        np.testing.assert_array_equal(other["normal_force_N"], 2.0 * one["normal_force_N"])
    np.testing.assert_array_equal(stiff.contacts["energy_J"], 2.0 * soft.contacts["energy_J"])
    # The account of work is kept with 15 digits a step.
    np.testing.assert_allclose(stiff.path["work_J"], 2.0 * soft.path["work_J"], rtol=1e-13)
    assert exponent(stiff) == exponent(soft)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("length", [2.0, 2.0**-10])
def test_lengths_in_another_binary_unit_scale_every_overlap_exactly(loaded, boundary, length):
    one, other = loaded(boundary), loaded(boundary, length=length)
    assert_same_contacts(one, other)
    for name in ("overlap_m", "branch_length_m", "normal_force_N"):
        np.testing.assert_array_equal(other.contacts[name], length * one.contacts[name])
    np.testing.assert_array_equal(other.walls["overlap_m"], length * one.walls["overlap_m"])
    np.testing.assert_array_equal(other.contacts["energy_J"], length**2 * one.contacts["energy_J"])
    np.testing.assert_allclose(exponent(other), exponent(one), rtol=0, atol=1e-12)


# A factor of 1000 is not exact in binary, and a packing on its way to jamming amplifies rounding
# until contacts differ: along a whole path n of 120 grains moved by 0.01 to 2. After one approach
# step and two loading steps, every one taken to rest, work moved by 1e-10 at most in 15 of 16
# packings, and by 5e-6 in one (seed 4 between walls).
SHORT = {
    "approach_steps": 1,
    "targets": (4.75,),
    "strain_step": 0.08,
    "step_tolerance": 1e-10,
    "state_tolerance": 1e-10,
    "step_evaluations": 400_000,
}


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("law", STIFFNESS)
def test_lengths_in_another_decimal_unit_leave_the_exponent(loaded, law, boundary):
    given = {"law": law, "stiffness": STIFFNESS[law], **SHORT}
    metres, millimetres = loaded(boundary, **given), loaded(boundary, length=1000.0, **given)
    assert len(metres.steps) == 3
    np.testing.assert_allclose(exponent(millimetres), exponent(metres), rtol=0, atol=1e-6)
    # A linear force goes with length, a Hertz force with its square; the stiffness is the same.
    power = {"linear": 1.0, "hertz": 2.0}[law]
    one, other = (run.path.iloc[-1] for run in (metres, millimetres))
    assert other["contact_law_error"] < 1e-12
    for name, dimension in (
        ("mean_normal_force_N", power),
        ("mean_stress_Pa", power - 2.0),
        ("elastic_energy_J", power + 1.0),
        ("work_J", power + 1.0),
        ("median_overlap_ratio", 0.0),
    ):
        np.testing.assert_allclose(other[name], 1000.0**dimension * one[name], rtol=1e-6)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_ten_times_the_stiffness_gives_ten_times_the_hertz_forces(loaded, boundary):
    # Masses go with K^(2/3) F^(1/3): another stiffness differs by rounding, so the path is short.
    soft, stiff = (
        loaded(boundary, law="hertz", stiffness=stiffness, **SHORT).path.iloc[-1]
        for stiffness in (1.0e9, 1.0e10)
    )
    assert soft["carries_load"]
    for name in ("mean_normal_force_N", "mean_stress_Pa", "elastic_energy_J", "work_J"):
        np.testing.assert_allclose(stiff[name], 10.0 * soft[name], rtol=1e-6)


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("law", STIFFNESS)
def test_mass_and_time_are_fictitious(loaded, law, boundary):
    # Mass goes with the square of time_scale; a power of two is exact, whatever its physics. The
    # dashpots' rate is a short decimal with this radius, which nothing else depends on.
    given = {"law": law, "stiffness": STIFFNESS[law], "largest_radius": 0.9375}
    given["approach_steps"] = 8
    slow, fast = loaded(boundary, **given), loaded(boundary, time_scale=2.0**-3, **given)
    pd.testing.assert_frame_equal(slow.contacts, fast.contacts, check_exact=True)
    pd.testing.assert_frame_equal(slow.walls, fast.walls, check_exact=True)
    np.testing.assert_array_equal(slow.path["work_J"], fast.path["work_J"])


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_the_same_packing_gives_the_same_bytes_from_any_folder(
    loaded, boundary, tmp_path, monkeypatch
):
    first = loaded(boundary)
    monkeypatch.chdir(tmp_path)
    second = loaded(boundary, where="elsewhere_and_longer/run")
    for table in ("path", "contacts", "walls", "steps"):
        one, other = (getattr(run, table).to_csv().encode() for run in (first, second))
        assert one == other
    for dump in ("particles.dump.gz", "pairs.dump.gz"):
        assert (first.folder / dump).read_bytes() == (second.folder / dump).read_bytes()


def test_another_packing_gives_another_path(random_grains, compressed, tmp_path):
    # The comparisons above can fail: one grain moved by one part in 10^9 is enough.
    positions, radii, edge = random_grains(60, 4, periodic=False)
    paths = []
    for name, shift in (("placed", 0.0), ("shifted", 1e-9 * edge)):
        moved = positions.copy()
        moved[-1, 0] += shift
        loading = {"approach_edge": 0.7 * edge, "targets": [0.6 * edge], "approach_steps": 4}
        run = compressed((moved, radii, edge), tmp_path / name, **loading, strain_step=0.04)
        paths.append(run.path)
    assert not paths[0].equals(paths[1])
