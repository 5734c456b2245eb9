"""What the page is given of a packing: numbers that come back, states that fit, what is said."""

import base64
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.study.viewer import viewer_data
from branchcrush.study.viewer_states import (
    compression_grains,
    dumped_grains,
    packing_view,
    viewer_states,
)
from tests.unit.study.viewed import CUBE, state

PERIODIC, WALLS = [True] * 3, [False] * 3


def unpacked(packed, number=0):
    """Return the columns of a state as the script of the page takes them apart."""
    row = packed.header["states"][number]
    words = np.frombuffer(base64.b64decode(packed.data), dtype="<u2").astype(float)
    at = row["offset"]

    def take(count):
        nonlocal at
        at += count
        return words[at - count : at]

    def index(count):
        return take(count) + (65536 * take(count) if row["wide"] else 0)

    def decoded(name, count):
        code, scale = take(count), packed.header["scales"][name]
        if scale is None:
            return np.zeros(count)
        ratio = np.log(scale[1] / scale[0])
        return np.where(code > 0, scale[0] * np.exp(ratio * (code - 1) / 65534), 0.0)

    n, m, w = row["grains"], row["contacts"], row["walls"]
    return {
        "positions": np.stack([(2 * take(n) / 65535 - 1) * row["span_m"] for _ in range(3)], 1),
        "radius": decoded("radius", n),
        "energy": decoded("energy", n),
        "pressure": decoded("pressure", n),
        "generation": take(n),
        "i": index(m),
        "j": index(m),
        "force": decoded("force", m),
        "wall_grain": index(w),
        "wall_direction": np.stack([2 * take(w) / 65535 - 1 for _ in range(3)], 1),
        "wall_force": decoded("force", w),
    }


def random_state(seed, grains, contacts, number=0, walls=3, cell=CUBE):
    rng = np.random.default_rng(seed)
    directions = rng.normal(size=(walls, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    energy = 10 ** rng.uniform(-14, -3, grains) * (rng.random(grains) > 0.2)
    return state(
        1e3 * rng.uniform(-0.5, 0.5, (grains, 3)) @ cell,
        10 ** rng.uniform(-2.3, 0, grains),
        number=number,
        pairs=rng.integers(0, grains, (contacts, 2)),
        force=10 ** rng.uniform(-6, 3, contacts),
        walls=np.column_stack(
            [rng.integers(0, grains, walls), directions, rng.random(walls) + 0.1]
        ),
        generation=rng.integers(0, 5, grains),
        energy=energy,
        pressure=1e6 * rng.random(grains),
        cell=cell,
    )


# Triclinic cells as LAMMPS has them, from flat to long.
edges = st.tuples(*3 * [st.floats(1e-3, 20e-3)])
tilts = st.tuples(*3 * [st.floats(-10e-3, 10e-3)])


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**31), st.integers(1, 60), st.integers(0, 90), edges, tilts)
def test_every_number_comes_back_within_its_step(seed, grains, contacts, edges, tilts):
    cell = np.diag(edges)
    cell[1, 0], cell[2, 0], cell[2, 1] = tilts
    states = [random_state(seed + k, grains + k, contacts, k, cell=cell) for k in range(3)]
    packed = viewer_data(states, periodic=[True, False, True])
    assert packed.header["periodic"] == [True, False, True]
    for k, known in enumerate(states):
        back = unpacked(packed, k)
        assert packed.header["states"][k]["cell_m"] == cell.tolist()
        # Steps of the range that the corners of the cell have.
        step = np.abs(cell).sum(axis=0).max() / 65535
        np.testing.assert_allclose(back["positions"], known.positions, atol=1.01 * step / 2)
        np.testing.assert_allclose(back["wall_direction"], known.wall_direction, atol=1.6e-5)
        for name in ("radius", "energy", "pressure", "force", "wall_force"):
            # Half a step of a range of at most 14 decades.
            np.testing.assert_allclose(back[name], getattr(known, name), rtol=5e-4)
        for name in ("i", "j", "wall_grain", "generation"):
            np.testing.assert_array_equal(back[name], getattr(known, name))


def test_grains_beyond_65536_are_counted_in_two_words():
    grains = 70_000
    known = random_state(1, grains, 50)
    known = replace(known, i=np.full(50, grains - 1), j=np.arange(50) + 65_530)
    back = unpacked(viewer_data([known], periodic=WALLS))
    np.testing.assert_array_equal(back["i"], known.i)
    np.testing.assert_array_equal(back["j"], known.j)


@settings(max_examples=30, deadline=None)
@given(st.integers(1, 12), st.integers(1, 40), st.integers(1, 300), st.integers(1200, 20_000))
def test_the_page_keeps_its_limit_and_says_what_is_left_out(number, grains, contacts, limit):
    states = [random_state(k, grains, contacts, k) for k in range(number)]
    header, data = viewer_data(states, periodic=PERIODIC, limit_bytes=limit)
    assert len(data) <= limit
    kept = [row["state"] for row in header["states"]]
    assert kept[-1] == number - 1
    everything = len(kept) == number and header["states"][-1]["contacts"] == contacts
    assert everything == (not header["notes"])
    if 1 < len(kept) < number:
        assert kept[0] == 0
        assert f"{len(kept)} of {number} states" in header["notes"][0]


def test_of_a_state_that_is_too_large_the_strongest_contacts_stay():
    known = random_state(3, 20, 400)
    packed = viewer_data([known], periodic=PERIODIC, limit_bytes=2000)
    force = unpacked(packed)["force"]
    assert 0 < force.size < 400
    assert force.min() == pytest.approx(np.sort(known.force)[-force.size], rel=5e-4)
    assert f"the {force.size} strongest of its 400 contacts" in packed.header["notes"][0]


def test_grains_beyond_every_limit_give_a_reason_in_place_of_numbers():
    header, data = viewer_data([random_state(3, 500, 4)], periodic=PERIODIC, limit_bytes=1000)
    assert (data, list(header)) == ("", ["reason"])
    assert "500 grains are more than a page can hold" in header["reason"]
    assert viewer_data([], periodic=PERIODIC).header == {"reason": "no state was saved"}


def test_all_that_cannot_be_drawn_is_named_at_once():
    bad = random_state(0, 4, 2)
    bad.positions[0, 0] = np.nan
    bad.radius[1] = 0.0
    bad.force[0] = np.inf
    with pytest.raises(ValueError) as error:
        viewer_data([bad], periodic=PERIODIC)
    for told in ("state 0: positions", "force holds a number", "radius must be above 0"):
        assert told in str(error.value)


def tables():
    """Two grains in three states; the second presses on the wall at +x in the last."""
    path = {
        "state": np.arange(3),
        "leg": np.array(["loading", "loading", "unloading"]),
        "volume_m3": np.array([8.0, 1.0, 1.0]),
        "solid_fraction": np.array([0.1, 0.7, 0.6]),
        "mean_stress_Pa": np.array([0.0, 3.0, 1.0]),
    }
    contacts = {"state": [1], "i": [0], "j": [1], "overlap_m": [0.1], "normal_force_N": [6.0]}
    contacts |= {"energy_J": [0.5]}
    walls = {"state": [1], "i": [1], "overlap_m": [0.2], "normal_force_N": [5.0]}
    walls |= {"direction_x": [1.0], "direction_y": [0.0], "direction_z": [0.0]}
    return path, contacts, walls


def test_states_hold_what_the_tables_say():
    path, contacts, walls = tables()
    packing = (np.zeros((2, 3)), np.array([0.5, 0.25]), 2.0)
    end = {"x_m": [-0.1, 0.4], "y_m": [0, 0], "z_m": [0, 0], "radius_m": [0.5, 0.25]}
    grains = compression_grains(packing, end, path)
    loose, last = viewer_states(grains, path, contacts, walls, contact_exponent=1.0)
    assert (loose.state, last.state) == (0, 1)
    assert (loose.label, last.label) == ("placed at random", "end of the approach")
    np.testing.assert_allclose([loose.cell, last.cell], [2.0 * np.eye(3), np.eye(3)])
    assert loose.force.size == 0 and loose.generation is None
    # Half of the contact, and all of what the wall holds, F delta / 2.
    np.testing.assert_allclose(last.energy, [0.25, 0.25 + 0.5])
    volume = 4 / 3 * np.pi * 0.5**3
    assert last.pressure[0] == pytest.approx(6.0 * 0.45 / 3 / volume)
    assert (last.i[0], last.j[0], last.wall_grain[0]) == (0, 1, 1)
    assert last.wall_direction.tolist() == [[1.0, 0.0, 0.0]]
    np.testing.assert_allclose(last.positions[1], [0.4, 0, 0])


def test_a_state_without_positions_is_left_out_and_the_loose_one_is_filled_in():
    path, contacts, walls = tables()
    grains = {
        "state": np.repeat([0, 1, 2], 2),
        "generation": np.array([0, 0, 0, 1, 0, 1]),
        **{
            name: np.array([np.nan] * 2 + [0.0, 0.4, np.nan, 0.0]) for name in ("x_m", "y_m", "z_m")
        },
        "radius_m": np.array([0.5, 0.25] * 3),
    }
    loose = np.full((2, 3), 0.7)
    states = viewer_states(grains, path, contacts, walls, contact_exponent=1.5, loose=loose)
    assert [some.state for some in states] == [0, 1]
    np.testing.assert_array_equal(states[0].positions, loose)
    assert states[1].generation.tolist() == [0, 1]
    said = viewer_data(states, periodic=WALLS, saved_states=3).header["notes"]
    assert said == ["Positions are known of 2 of 3 saved states."]


def test_dumps_give_every_state_or_the_last():
    frames = [{name: np.full(2, float(k)) for name in ("x", "y", "z", "radius")} for k in range(3)]
    assert dumped_grains(frames, [0, 1, 2])["x_m"].tolist() == [0, 0, 1, 1, 2, 2]
    assert dumped_grains(frames[2:], [0, 1, 2])["state"].tolist() == [2, 2]
    with pytest.raises(ValueError, match="0 frames of 3"):
        dumped_grains([], [0, 1, 2])


def test_a_packing_of_another_code_has_the_cells_and_frames_that_were_read():
    path, contacts, walls = tables()
    packing = (np.zeros((2, 3)), np.array([0.5, 0.25]), 2.0)
    end = {"x_m": [-0.1, 0.4], "y_m": [0, 0], "z_m": [0, 0], "radius_m": [0.5, 0.25]}
    grains = compression_grains(packing, end, path)
    tilted = np.array([np.diag([2.0, 2.0, k + 1.0]) + 0.5 * np.eye(3, k=-1) for k in range(3)])
    reading = {"cells_m": tilted.tolist(), "periodic": [True, True, False]}
    view = packing_view(
        grains, path, contacts, walls, contact_exponent=1.0, periodic=False, reading=reading
    )
    header = view["header"]
    assert header["periodic"] == [True, True, False]
    assert [row["label"] for row in header["states"]] == ["first frame", "densest frame"]
    assert [row["cell_m"] for row in header["states"]] == tilted[:2].tolist()
    assert header["notes"] == ["Positions are known of 2 of 3 saved states."]


def test_one_frame_of_another_code_is_drawn_once():
    path, contacts, walls = tables()
    path = {name: column[1:2] for name, column in path.items()} | {"state": np.array([0])}
    one = [{**table, "state": [0]} for table in (contacts, walls)]
    packing = (np.zeros((2, 3)), np.array([0.5, 0.25]), 1.0)
    end = {"x_m": [-0.1, 0.4], "y_m": [0, 0], "z_m": [0, 0], "radius_m": [0.5, 0.25]}
    reading = {"cells_m": [np.eye(3)], "periodic": [False] * 3}
    grains = compression_grains(packing, end, path)
    (only,) = viewer_states(grains, path, *one, contact_exponent=1.0, reading=reading)
    assert (only.label, only.radius.tolist()) == ("first frame", [0.5, 0.25])
    assert (only.force.size, only.wall_force.size) == (1, 1)
