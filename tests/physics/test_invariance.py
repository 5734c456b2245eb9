"""What must not matter does not: units of force, length and time, and where and when it runs."""

import functools

import numpy as np
import pandas as pd
import pytest

from branchcrush.energy_split import power_law_fit

# Binary fractions of a cell of edge 8, so that every edge on the way is a short decimal and
# exact: 40 approach steps of 2^-4 to 5.5, then 24 steps of 2^-5 to 4.75.
EDGE, APPROACH, FINAL, STEPS = 8.0, 5.5, 4.75, 24
BOUNDARIES = ["walls", "periodic"]


@pytest.fixture(scope="module")
def loaded(random_grains, compressed, tmp_path_factory):
    """Return a function that compresses one packing, its lengths in some unit."""

    @functools.cache
    def run(boundary, *, length=1.0, where="run", **variables):
        positions, radii, edge = random_grains(60, 4, periodic=boundary == "periodic")
        unit = EDGE / edge * length
        loading = {"approach_edge": APPROACH * length, "final_edge": FINAL * length}
        steps = {"approach_steps": 40, "steps": STEPS, "steps_per_state": 12}
        return compressed(
            (positions * unit, radii * unit, EDGE * length),
            tmp_path_factory.mktemp("loaded") / where,
            boundary=boundary,
            **{**loading, **steps, **variables},
        )

    return run


def assert_same_contacts(one, other):
    pd.testing.assert_frame_equal(
        one.contacts[["state", "i", "j"]], other.contacts[["state", "i", "j"]]
    )
    pd.testing.assert_frame_equal(
        one.walls[["state", "i", "wall"]], other.walls[["state", "i", "wall"]]
    )


def exponent(run):
    last = run.at("contacts", -1)
    return power_law_fit(last["radius_i_m"] + last["radius_j_m"], last["energy_J"]).exponent


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_twice_the_stiffness_doubles_every_force_and_leaves_the_packing_as_it_is(loaded, boundary):
    # Mass, dashpots and time step follow the stiffness: a factor of two is exact to the last bit.
    soft, stiff = loaded(boundary), loaded(boundary, normal_stiffness=2.0e6)
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


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_lengths_in_another_decimal_unit_leave_the_exponent(loaded, boundary):
    # A factor of 1000 is not exact in binary, and a packing on its way to jamming amplifies
    # rounding until contacts differ: along a whole path n of 120 grains moved by 0.01 to 2. After
    # one approach step and two loading steps it moved by 2e-7 at most in 24 runs, 1e-13 mostly.
    steps = {"approach_steps": 1, "steps": 2, "steps_per_state": 2}
    metres, millimetres = loaded(boundary, **steps), loaded(boundary, length=1000.0, **steps)
    np.testing.assert_allclose(exponent(millimetres), exponent(metres), rtol=0, atol=1e-6)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_mass_and_time_are_fictitious(loaded, boundary):
    # Mass goes with the square of time_scale; a power of two is exact, whatever its physics.
    slow, fast = loaded(boundary), loaded(boundary, time_scale=2.0**-3)
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
    for table in ("path", "contacts", "walls"):
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
        loading = {"approach_edge": 0.7 * edge, "final_edge": 0.6 * edge, "approach_steps": 4}
        run = compressed(
            (moved, radii, edge), tmp_path / name, **loading, steps=4, steps_per_state=4
        )
        paths.append(run.path)
    assert not paths[0].equals(paths[1])
