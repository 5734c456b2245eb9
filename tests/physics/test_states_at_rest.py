"""Every saved state of a random packing, searched anew for contacts and weighed anew.

Nothing here but the positions and radii of the particle dump goes into the forces: overlaps are
found by measuring every pair of grains through every face of the cell.
"""

import itertools

import numpy as np
import pytest

STIFFNESS = 1.0e6
GRAINS = 120
# Coordinates are a few millimetres and doubles: an overlap is known to 1e-18 m or so.
OVERLAP_ERROR = 1e-17
FORCE_ERROR = STIFFNESS * OVERLAP_ERROR
FACES = [(axis, side, f"{'-+'[side]}{'xyz'[axis]}") for axis in range(3) for side in (0, 1)]


@pytest.fixture(scope="module", params=["walls", "periodic"])
def packing(request, random_grains, compressed, frames, tmp_path_factory):
    placed = random_grains(GRAINS, 1, periodic=request.param == "periodic")
    edge = placed[2]
    run = compressed(
        placed,
        tmp_path_factory.mktemp("random") / "run",
        boundary=request.param,
        approach_edge=0.68 * edge,
        final_edge=0.60 * edge,
        steps=32,
        steps_per_state=4,
    )
    particles = frames(run.folder / "particles.dump.gz")
    pairs = frames(run.folder / "pairs.dump.gz")
    assert len(particles) == len(pairs) == len(run.path) == 10
    return run, particles, pairs


class Search:
    """The contacts of one frame of the particle dump."""

    def __init__(self, frame, periodic):
        lower, upper = frame.bounds.T
        place, radius = frame.vectors("x", "y", "z"), frame.columns["radius"]
        self.net = np.zeros_like(place)
        self.pairs, self.walls = {}, {}
        images = itertools.product((-1, 0, 1), repeat=3) if periodic else [(0, 0, 0)]
        for image in images:
            vector = place[:, None] - place[None, :] - np.array(image) * (upper - lower)
            distance = np.linalg.norm(vector, axis=-1)
            overlap = radius[:, None] + radius[None, :] - distance
            # Both orders of a pair are met: each once with its image and once with the opposite.
            for i, j in np.argwhere((overlap > 0) & ~np.eye(len(radius), dtype=bool)):
                self.net[i] += STIFFNESS * overlap[i, j] * vector[i, j] / distance[i, j]
                if i < j:
                    assert (i, j) not in self.pairs, "the cell is too small for one image a pair"
                    self.pairs[i, j] = overlap[i, j]
        for axis, side, name in [] if periodic else FACES:
            gap = (place[:, axis] - lower[axis], upper[axis] - place[:, axis])[side]
            for i in np.flatnonzero(radius - gap > 0):
                self.net[i, axis] += STIFFNESS * (radius - gap)[i] * (1, -1)[side]
                self.walls[i, name] = (radius - gap)[i]

    def energy(self):
        overlaps = np.array([*self.pairs.values(), *self.walls.values()])
        return STIFFNESS * np.sum(overlaps**2) / 2.0


@pytest.fixture(scope="module")
def searched(packing):
    """Return for each state its row of the path, contacts, walls, frame and search."""
    run, particles, _ = packing
    periodic = run.variables["boundary"] == "periodic"
    return [
        (row, run.at("contacts", n), run.at("walls", n), frame, Search(frame, periodic))
        for (n, row), frame in zip(run.path.iterrows(), particles, strict=True)
    ]


def test_the_path_goes_from_loose_to_loaded(packing):
    path = packing[0].path
    assert not path["carries_load"].iloc[0]
    assert path["carries_load"].iloc[-2:].all()
    assert path["coordination_number"].iloc[-1] > 5.0


def test_the_cell_has_the_edges_asked_for(packing):
    run, particles, _ = packing
    first = np.ptp(particles[0].bounds[0])
    approach, final = run.variables["approach_edge"], run.variables["final_edge"]
    edges = [first, *(approach + (final - approach) * np.arange(9) / 8)]
    measured = [np.ptp(frame.bounds, axis=1) for frame in particles]
    # LAMMPS hands numbers on with 15 digits.
    np.testing.assert_allclose(measured, np.outer(edges, np.ones(3)), rtol=4e-15)
    np.testing.assert_allclose(run.path["volume_m3"], np.prod(measured, axis=1), rtol=1e-14)
    np.testing.assert_allclose(run.path["linear_strain"], 1 - np.array(edges) / first, atol=1e-14)
    np.testing.assert_allclose(
        run.path["volumetric_strain"], 1 - np.array(edges) ** 3 / first**3, atol=1e-14
    )


def test_grains_keep_their_radii(packing):
    _, particles, _ = packing
    for frame in particles:
        np.testing.assert_array_equal(frame.columns["id"], np.arange(1, GRAINS + 1))
        np.testing.assert_array_equal(frame.columns["radius"], particles[0].columns["radius"])


def test_no_grain_is_outside(packing):
    run, particles, _ = packing
    for frame in particles:
        lower, upper = frame.bounds.T
        place = frame.vectors("x", "y", "z")
        assert ((place >= lower) & (place <= upper)).all()
    assert (run.path["escaped"] == 0).all()


def test_contacts_are_those_found_from_the_positions_each_once(searched):
    for _, contacts, _, _, search in searched:
        listed = list(zip(contacts["i"], contacts["j"], strict=True))
        assert len(listed) == len(set(listed))
        # Two grains that only just touch may do so in one order of rounding and not in another.
        clear = {pair for pair, overlap in search.pairs.items() if overlap > OVERLAP_ERROR}
        assert clear <= set(listed)
        listed_clear = set(
            zip(
                *contacts[contacts["overlap_m"] > OVERLAP_ERROR][["i", "j"]].to_numpy().T,
                strict=True,
            )
        )
        assert listed_clear <= set(search.pairs)


def test_overlaps_and_forces_are_those_found_from_the_positions(searched):
    for _, contacts, _, frame, search in searched:
        found = [search.pairs.get((i, j), 0.0) for i, j in contacts[["i", "j"]].to_numpy()]
        found = np.array(found, dtype=float)
        radius = frame.columns["radius"]
        np.testing.assert_array_equal(contacts["radius_i_m"], radius[contacts["i"]])
        np.testing.assert_array_equal(contacts["radius_j_m"], radius[contacts["j"]])
        np.testing.assert_allclose(contacts["overlap_m"], found, rtol=0, atol=OVERLAP_ERROR)
        np.testing.assert_allclose(
            contacts["normal_force_N"], STIFFNESS * found, rtol=0, atol=FORCE_ERROR
        )
        np.testing.assert_allclose(
            contacts["energy_J"], STIFFNESS * found**2 / 2.0, rtol=1e-9, atol=FORCE_ERROR**2
        )


def test_wall_contacts_have_the_sides_and_forces_found_from_the_positions(searched):
    for _, _, walls, _, search in searched:
        listed = dict(
            zip(zip(walls["i"], walls["wall"], strict=True), walls["overlap_m"], strict=True)
        )
        assert len(listed) == len(walls)
        assert listed.keys() == search.walls.keys()
        np.testing.assert_allclose(
            [listed[key] for key in search.walls],
            list(search.walls.values()),
            rtol=0,
            atol=OVERLAP_ERROR,
        )
        np.testing.assert_allclose(
            walls["normal_force_N"], STIFFNESS * walls["overlap_m"], rtol=0, atol=FORCE_ERROR
        )


def test_all_six_walls_are_pressed_or_none_in_a_periodic_cell(packing):
    run, *_ = packing
    walls = {"walls": {name for *_, name in FACES}, "periodic": set()}[run.variables["boundary"]]
    assert set(run.at("walls", -1)["wall"]) == walls


def test_the_forces_found_from_the_positions_balance_on_every_grain(searched):
    for row, contacts, _, frame, search in searched:
        # Twenty forces at most act on a grain, each known to FORCE_ERROR.
        np.testing.assert_allclose(
            search.net, frame.vectors("fx", "fy", "fz"), rtol=0, atol=20 * FORCE_ERROR
        )
        if row["carries_load"]:
            net = np.linalg.norm(search.net, axis=1)
            assert net.mean() <= 1e-6 * contacts["normal_force_N"].mean()
            np.testing.assert_allclose(
                row["unbalanced_force_ratio"],
                net.mean() / contacts["normal_force_N"].mean(),
                rtol=1e-3,
            )


def test_every_saved_state_is_at_rest(packing):
    assert (packing[0].path["unbalanced_force_ratio"] <= 1e-6).all()


def test_stress_of_the_branches_is_that_of_the_boundary(packing):
    path = packing[0].path
    loaded = path[path["carries_load"]]
    np.testing.assert_allclose(loaded["mean_stress_Pa"], loaded["boundary_stress_Pa"], rtol=1e-6)


def test_stress_is_the_virial_of_the_forces_found_from_the_positions(packing, searched):
    _, _, pairs = packing
    for (row, _, _, frame, search), pair_frame in zip(searched, pairs, strict=True):
        if not row["carries_load"]:
            continue
        branch = pair_frame.vectors("branch_x", "branch_y", "branch_z")
        force = pair_frame.vectors("force_x", "force_y", "force_z")
        volume = np.prod(np.ptp(frame.bounds, axis=1))
        # A wall's branch ends where it touches the grain: radius less overlap from its centre.
        radius = frame.columns["radius"]
        at_walls = sum(STIFFNESS * d * (radius[i] - d) for (i, _), d in search.walls.items())
        stress = (np.sum(branch * force) + at_walls) / (3.0 * volume)
        np.testing.assert_allclose(row["mean_stress_Pa"], stress, rtol=1e-12)


def test_the_pair_dump_points_from_the_second_grain_to_the_first_and_pushes_the_first(packing):
    _, particles, pairs = packing
    frame, pair = particles[-1], pairs[-1]
    place, edge = frame.vectors("x", "y", "z"), np.ptp(frame.bounds[0])
    first, second = (pair.columns[name].astype(int) - 1 for name in ("id1", "id2"))
    branch = place[first] - place[second]
    if packing[0].variables["boundary"] == "periodic":
        branch -= edge * np.round(branch / edge)
    length = np.linalg.norm(branch, axis=1)
    dumped = pair.vectors("branch_x", "branch_y", "branch_z")
    np.testing.assert_allclose(dumped, branch, rtol=0, atol=OVERLAP_ERROR)
    np.testing.assert_allclose(pair.columns["branch"], length, rtol=1e-14)
    np.testing.assert_allclose(
        pair.vectors("force_x", "force_y", "force_z"),
        (pair.columns["force"] / length)[:, None] * branch,
        rtol=0,
        atol=1e-12 * pair.columns["force"].max(),
    )
    assert (pair.columns["force"] >= 0).all()


def test_elastic_energy_is_that_of_the_overlaps_found_from_the_positions(searched):
    for row, *_, search in searched:
        # d(k x^2 / 2) = k x dx: in an unloaded state the overlaps are near their rounding.
        overlaps = sum(search.pairs.values()) + sum(search.walls.values())
        error = STIFFNESS * overlaps * OVERLAP_ERROR
        np.testing.assert_allclose(row["elastic_energy_J"], search.energy(), rtol=1e-13, atol=error)


def test_work_is_stored_or_dissipated_and_dissipation_never_runs_backwards(packing):
    path = packing[0].path
    rounding = 1e-12 * path["work_J"].max()
    np.testing.assert_allclose(
        path["work_J"] - path["elastic_energy_J"], path["dissipated_J"], rtol=0, atol=rounding
    )
    assert (path["dissipated_J"] >= -rounding).all()
    assert (path["dissipated_J"].diff().iloc[1:] >= -rounding).all()
    # Rearrangements do dissipate: the account is not trivially closed.
    assert path["dissipated_J"].iloc[-1] > 0.01 * path["work_J"].iloc[-1]


@pytest.mark.parametrize("offset", [0.01, 0.05])
def test_a_fine_grain_caught_between_a_large_one_and_a_wall_stays_inside(
    compressed, tmp_path, offset
):
    # One strain step closes the gap to a fortieth of the fine grain's size.
    x = 1e-3 * np.array([-offset, 1.1])
    run = compressed(
        (np.column_stack([x, np.zeros((2, 2))]), 1e-3 * np.array([1, 0.02]), 2.3e-3),
        tmp_path / "run",
        approach_edge=2.25e-3,
        final_edge=2.001e-3,
        steps=1,
        steps_per_state=1,
    )
    # The large grain on the left wall, the fine one between it and the right wall: 3 contacts in
    # a row share what the diameters are too long by.
    overlap = 1e-3 * (2 * (1 + 0.02) - 2.001) / 3
    walls = run.at("walls", -1)
    assert list(zip(walls["i"], walls["wall"], strict=True)) == [(0, "-x"), (1, "+x")]
    np.testing.assert_allclose(walls["overlap_m"], overlap, rtol=1e-6)
    np.testing.assert_allclose(run.at("contacts", -1)["overlap_m"], overlap, rtol=1e-6)


def test_nothing_moves_in_a_saved_state(packing):
    path = packing[0].path
    loaded = path[path["carries_load"]]
    assert (loaded["inertial_number"] < 1e-4).all()
